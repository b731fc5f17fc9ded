//! What is told of the smallest shocks from one response to another.

use halfshaft_results::{BasinsResult, ShockSearch, SmallestShock};

use super::{Account, Grid};
use crate::words::{counted, plain, quantity};

/// So many pairs of responses are told one by one; of more only the smallest from each.
const MOST_TOLD: usize = 6;

pub(crate) fn account(result: &BasinsResult) -> Account {
    let mut account = Account::default();
    let Some(search) = &result.shock_search else { return account };
    let all = result.shocks.len() <= MOST_TOLD;
    let shocks = result.shocks.iter();
    let told: Vec<&SmallestShock> = if all {
        shocks.collect()
    } else {
        shocks.filter(|own| is_smallest(result, own)).collect()
    };
    account.text(told.into_iter().map(|shock| sentence(shock, search)));
    account.grid(table(result));
    account.note(format!(
        "A shock is an impulse of torque on the {}. All moments and both directions were tried, {} a period \
         and more where it mattered, up to {}: {} in all.",
        plain(&search.node),
        counted(search.phases, "moment", "moments"),
        quantity(search.largest_impulse, 4, "N·m·s"),
        counted(search.motions, "motion", "motions")
    ));
    account
}

/// Whether none is smaller from the same response.
fn is_smallest(result: &BasinsResult, shock: &SmallestShock) -> bool {
    let size = |shock: &SmallestShock| shock.impulse.map_or(f64::INFINITY, f64::abs);
    let others = || result.shocks.iter().filter(|other| other.from == shock.from);
    let first = others().min_by(|a, b| size(a).total_cmp(&size(b)));
    first.is_some_and(|first| first == shock)
}

fn sentence(shock: &SmallestShock, search: &ShockSearch) -> String {
    let (from, node) = (shock.from + 1, plain(&shock.node));
    let Some(impulse) = shock.impulse else {
        let to = shock.to.map_or("any other".to_owned(), |to| format!("response {}", to + 1));
        let most = quantity(search.largest_impulse, 4, "N·m·s");
        return format!(
            "No shock up to {most} on the {node} was found that throws the line from response {from} to {to}."
        );
    };
    let to =
        shock.to.map_or("beyond all measure".to_owned(), |to| format!("to response {}", to + 1));
    let impulse = quantity(impulse, 5, "N·m·s");
    let phase = shock.phase.map_or_else(String::new, |phase| {
        format!(" at {} of the excitation", quantity(phase.to_degrees(), 4, "°"))
    });
    format!("Smallest shock from response {from} {to}: {impulse} on the {node}{phase}.")
}

fn table(result: &BasinsResult) -> Grid {
    let all = &result.shocks;
    Grid::new("Smallest shock from each response to each other")
        .figures("from", all.iter().map(|shock| format!("response {}", shock.from + 1)))
        .figures(
            "to",
            all.iter().map(|shock| match shock.to {
                Some(to) => format!("response {}", to + 1),
                None => "beyond all measure".to_owned(),
            }),
        )
        .numbers("impulse", "N·m·s", 6, all.iter().map(|shock| shock.impulse))
        .numbers("phase", "°", 5, all.iter().map(|shock| shock.phase.map(f64::to_degrees)))
        .numbers("time", "s", 5, all.iter().map(|shock| shock.time))
}
