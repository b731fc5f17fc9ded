//! How many responses coexist over a plane.

use halfshaft_numerics::Complex;
use halfshaft_results::ResponseCount;

use super::drive::Drive;
use super::family::Family;
use super::limbs::{Gathered, Seen};
use super::problem::{Point, Problem};
use super::responses::Finder;
use super::rest::Rest;

/// What the shaft sees of the rest along a row, for the lines it is the same for.
struct Column {
    rest: Rest,
    drive: Drive,
    seen: Vec<Option<Seen<Complex>>>,
}

/// Numbers of responses at all pairs of parameters and excitation speeds; none where the line cannot
/// be had.
pub(super) fn count(family: &Family<'_>, speeds: &[f64], parameters: &[f64]) -> ResponseCount {
    let mut column: Option<Column> = None;
    let mut rows = Vec::with_capacity(parameters.len());
    for parameter in parameters {
        let Some(problem) = family.at(*parameter) else {
            rows.push(vec![0; speeds.len()]);
            continue;
        };
        // The rest of the line does not know most parameters.
        let kept = column.take().and_then(|column| column.reused(&problem));
        let current = kept.unwrap_or_else(|| Column::new(&problem, speeds));
        rows.push(row(&problem, speeds, &current.seen));
        column = Some(current);
    }
    ResponseCount { frequency: speeds.to_vec(), parameter: parameters.to_vec(), count: rows }
}

fn row(problem: &Problem, speeds: &[f64], seen: &[Option<Seen<Complex>>]) -> Vec<u32> {
    let finder = Finder::new(problem);
    let damping = problem.law.damping;
    let one = |(speed, seen): (&f64, &Option<Seen<Complex>>)| {
        let Some(Seen { alpha, beta, gamma }) = *seen else { return 0 };
        let nu = problem.order * speed;
        let alpha = alpha + beta * Complex::new(0.0, nu * damping);
        finder.count(problem, &Point { nu, alpha, beta, gamma })
    };
    speeds.iter().zip(seen).map(one).collect()
}

impl Column {
    fn new(problem: &Problem, speeds: &[f64]) -> Self {
        let mut work = Gathered::default();
        let mut at = |speed: &f64| {
            let nu = problem.order * speed;
            (nu > 0.0).then(|| problem.rest.value(nu, &problem.drive, &mut work)).flatten()
        };
        Self {
            seen: speeds.iter().map(&mut at).collect(),
            rest: problem.rest.clone(),
            drive: problem.drive.clone(),
        }
    }

    /// The same for another line, where only the size of the drive differs, if that.
    fn reused(mut self, problem: &Problem) -> Option<Self> {
        if self.rest != problem.rest {
            return None;
        }
        if self.drive == problem.drive {
            return Some(self);
        }
        let factor = problem.drive.factor_over(&self.drive)?;
        for seen in self.seen.iter_mut().flatten() {
            seen.gamma = seen.gamma.scaled(factor);
        }
        self.drive = problem.drive.clone();
        Some(self)
    }
}
