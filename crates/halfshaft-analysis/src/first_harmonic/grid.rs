//! The grid of a response over a range of frequencies: *all* responses at each of them.

use super::path::Place;
use super::problem::Problem;
use super::responses::{Finder, Response};

/// The grid: frequencies with all their responses.
pub(super) struct Grid {
    pub(super) nus: Vec<f64>,
    pub(super) rows: Vec<Vec<Known>>,
    pub(super) open: usize,
}

/// A response of the grid.
#[derive(Clone, Copy)]
pub(super) struct Known {
    pub(super) response: Response,
    /// Whether a branch came by.
    pub(super) passed: bool,
}

impl Grid {
    /// All responses at ascending frequencies. Ends early where that is asked for.
    pub(super) fn new(
        problem: &Problem,
        finder: &Finder,
        mut nus: Vec<f64>,
        cancelled: &dyn Fn() -> bool,
    ) -> Self {
        let (mut rows, mut open) = (Vec::with_capacity(nus.len()), 0);
        for nu in &nus {
            if cancelled() {
                break;
            }
            let found = finder.all(problem, *nu);
            open += found.open;
            let known = |response| Known { response, passed: false };
            rows.push(found.list.into_iter().map(known).collect());
        }
        nus.truncate(rows.len());
        Self { nus, rows, open }
    }

    pub(super) fn largest(&self) -> f64 {
        let all = self.rows.iter().flatten();
        all.map(|known| known.response.amplitude()).fold(0.0, f64::max)
    }

    /// The known response nearest to a place on its frequency.
    pub(super) fn nearest(&self, row: usize, place: &Place) -> Option<usize> {
        let distance = |known: &Known| {
            (known.response.twist - place.twist).modulus()
                + (known.response.at.mean - place.at.mean).abs()
        };
        let size = place.twist.modulus() + place.at.mean.abs();
        let (index, known) = self.rows[row]
            .iter()
            .enumerate()
            .min_by(|(_, a), (_, b)| distance(a).total_cmp(&distance(b)))?;
        (distance(known) <= 1e-5 * size).then_some(index)
    }
}
