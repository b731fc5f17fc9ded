//! What is told of periodic responses found by harmonic balance or by the first harmonic: any number
//! of branches, with special points of every kind.
//!
//! The closed form of one mode has an account of its own in `resonance`.

use halfshaft_results::ResonanceResult;

use super::{Account, verification};
use crate::reading::Reading;

mod branches;
mod coexisting;
mod effort;
mod losses;
mod special;
mod stability;
mod swing;

#[cfg(test)]
pub(crate) use coexisting::most_coexisting;
pub(crate) use coexisting::{periods_words, unstable_gaps};
pub(crate) use losses::told as losses;

/// The whole account.
pub(crate) fn account(result: &ResonanceResult) -> Account {
    let reading = Reading::of(result);
    let mut account = Account::default();
    if result.branches.is_empty() {
        account.text(["No periodic response was found in the range.".to_owned()]);
        account.text([effort::told(&reading)]);
        return account;
    }
    account.text([swing::told(&reading)]);
    account.text(super::jumps::told(result));
    account.text(losses::told(&reading));
    account.text(coexisting::told(&reading));
    for id in crate::figures::resonance::ids(result) {
        account.figure(id);
    }
    account.text(stability::told(&reading));
    let points = special::grid(&reading);
    if points.rows() > 0 {
        account.note(special::explanations(&reading));
    }
    account.grid(points);
    account.list(special::remarks(&reading));
    account.text(losses::twins(&reading));
    account.grid(branches::grid(&reading));
    account.append(verification::account(result));
    account.text([effort::told(&reading)]);
    account
}
