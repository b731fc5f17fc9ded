//! The table of branches.

use halfshaft_results::Branch;

use super::super::Grid;
use super::coexisting::periods_words;
use crate::reading::{Reading, bounds};
use crate::words::{capital, plain};

/// Every branch with where it lies, what it was found from and why it ends; nothing where there is
/// one only, of which the sentences have told all.
pub(super) fn grid(reading: &Reading<'_>) -> Grid {
    let branches = &reading.result.branches;
    if branches.len() < 2 {
        return Grid::default();
    }
    let swing = reading.swing_column();
    let range = |branch: &Branch, name: &str| bounds(branch.values(name).iter().copied());
    let (x, unit) = (&reading.x.column, reading.x.unit.as_str());
    let ends: Vec<Option<(f64, f64)>> = branches.iter().map(|branch| range(branch, x)).collect();
    let swings = branches.iter().map(|branch| Some(range(branch, &swing)?.1));
    Grid::new("Responses")
        .words("no.", (1..=branches.len()).map(|number| number.to_string()))
        .words("kind", branches.iter().map(kind))
        .numbers("from", unit, 6, ends.iter().map(|ends| Some(ends.as_ref()?.0)))
        .numbers("to", unit, 6, ends.iter().map(|ends| Some(ends.as_ref()?.1)))
        .numbers("largest swing", "rad", 5, swings)
        .words("stable", branches.iter().map(stable))
        .words("found from", branches.iter().map(|branch| plain(&branch.origin)))
        .words("ends", branches.iter().map(end))
        .without_empty_columns()
}

fn kind(branch: &Branch) -> String {
    let detached = branch.is_detached();
    match (branch.periods, detached) {
        (0 | 1, true) => "Detached".to_owned(),
        (0 | 1, false) => "Main".to_owned(),
        (periods, true) => format!("Detached, of {}", periods_words(periods)),
        (periods, false) => capital(&format!("of {}", periods_words(periods))),
    }
}

fn stable(branch: &Branch) -> &'static str {
    let values = branch.values("stable");
    match values.iter().filter(|value| **value != 0.0).count() {
        _ if values.is_empty() => "",
        0 => "no",
        count if count == values.len() => "yes",
        _ => "in part",
    }
}

fn end(branch: &Branch) -> String {
    if branch.closed { "closes on itself".to_owned() } else { plain(&branch.ends) }
}
