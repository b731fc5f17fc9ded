//! Detached responses that live between two frequencies of a grid.
//!
//! A closed branch too narrow for the grid shows before and after as a local minimum of the
//! equation's left side over the amplitude, just above zero. Where that minimum has a least value
//! over the frequency between three neighbours of the grid, it is followed down; if it passes zero
//! the frequency is added to the grid, and the branch is found from there. For polynomial laws only.

use halfshaft_numerics::bracket::{MinimumSettings, find_minimum};

use super::problem::Problem;
use super::responses::Finder;

/// Minima of the left side above this part of `|γ|²` on the grid do not reach zero between.
const NEAR: f64 = 0.5;

/// The grid with a frequency in each narrow detached branch found between its own.
pub(super) fn with_births(problem: &Problem, finder: &Finder, nus: Vec<f64>) -> Vec<f64> {
    if !matches!(finder, Finder::Polynomial(_)) {
        return nus;
    }
    let rows: Vec<Vec<f64>> = nus.iter().map(|nu| values(problem, finder, *nu)).collect();
    let mut added = Vec::new();
    for (window, at) in rows.windows(3).zip(nus.windows(3)) {
        let [before, middle, after] = window else { continue };
        if before.len() != middle.len() || after.len() != middle.len() {
            continue;
        }
        for index in 0..middle.len() {
            let least = middle[index] <= before[index] && middle[index] <= after[index];
            if least && middle[index] < NEAR {
                added.extend(crossing(problem, finder, index, (at[0], at[2])));
            }
        }
    }
    let mut nus = nus;
    nus.extend(added);
    nus.sort_by(f64::total_cmp);
    nus.dedup();
    nus
}

fn values(problem: &Problem, finder: &Finder, nu: f64) -> Vec<f64> {
    finder.approaches(problem, nu).iter().map(|approach| approach.value).collect()
}

/// A frequency at which a minimum is below zero.
fn crossing(
    problem: &Problem,
    finder: &Finder,
    index: usize,
    (from, to): (f64, f64),
) -> Option<f64> {
    let mut below = None;
    let value = |nu: f64| match values(problem, finder, nu).get(index) {
        Some(value) => *value,
        None => {
            // It has gone: below zero, which is what is looked for.
            below.get_or_insert(nu);
            0.0
        }
    };
    // What matters is what was met on the way.
    let _ = find_minimum(value, from, to, MinimumSettings::default());
    below
}
