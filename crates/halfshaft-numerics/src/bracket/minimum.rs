//! Brent's search for a minimum.

use super::{Ending, Sample, check_tolerances, sample};
use crate::error::{Error, all_finite};

/// The numbers of the search for a minimum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MinimumSettings {
    /// The place of the minimum is sought to this plus the relative part. Default 1e-12.
    pub absolute_tolerance: f64,
    /// Share of its own size to which the place is sought. Default 1.5e-8, the root of the machine
    /// precision: near a minimum the function does not change visibly over less.
    pub relative_tolerance: f64,
    /// Most function values. Default 200.
    pub iteration_limit: usize,
}

impl Default for MinimumSettings {
    fn default() -> Self {
        Self { absolute_tolerance: 1e-12, relative_tolerance: 1.5e-8, iteration_limit: 200 }
    }
}

/// A minimum of a function on an interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Minimum {
    /// Where the least value was found.
    pub argument: f64,
    /// The least value.
    pub value: f64,
    /// The final interval, lower end first.
    pub interval: (f64, f64),
    /// Function values taken.
    pub iterations: usize,
    /// Why the search ended.
    pub ending: Ending,
}

/// A local minimum of a function between `a` and `b`, in either order.
///
/// R. P. Brent, *Algorithms for Minimization without Derivatives* (1973), chapter 5: golden-section
/// steps, and parabolic ones where they stay inside and shrink. A function with one minimum on the
/// interval gives that one; a monotone function gives a point within the tolerance of an end.
///
/// # Errors
///
/// [`Error::NonFinite`] if an end is not finite or the function returns NaN, [`Error::Setting`] for
/// tolerances that are negative.
pub fn find_minimum(
    mut function: impl FnMut(f64) -> f64,
    a: f64,
    b: f64,
    settings: MinimumSettings,
) -> Result<Minimum, Error> {
    check_tolerances(settings.absolute_tolerance, settings.relative_tolerance)?;
    all_finite("end of the interval", &[a, b])?;
    let mut sample = |x| sample(&mut function, x);
    let (lower, upper) = (a.min(b), a.max(b));
    let first = sample(lower + GOLDEN * (upper - lower))?;
    let mut search = MinimumSearch::new(lower, upper, first);
    for iterations in 1..=settings.iteration_limit.max(1) {
        let tolerance =
            settings.absolute_tolerance + settings.relative_tolerance * search.best.x.abs();
        if search.is_within(tolerance) {
            return Ok(search.result(iterations, Ending::Converged));
        }
        if iterations == settings.iteration_limit.max(1) {
            break;
        }
        let next = sample(search.propose(tolerance))?;
        search.take(next);
    }
    Ok(search.result(settings.iteration_limit.max(1), Ending::IterationLimit))
}

/// The smaller part of the golden section.
const GOLDEN: f64 = 0.381_966_011_250_105_1;

/// The state of Brent's search.
struct MinimumSearch {
    lower: f64,
    upper: f64,
    best: Sample,
    second: Sample,
    third: Sample,
    /// The last step, and the one before it.
    steps: (f64, f64),
}

impl MinimumSearch {
    fn new(lower: f64, upper: f64, first: Sample) -> Self {
        Self { lower, upper, best: first, second: first, third: first, steps: (0.0, 0.0) }
    }

    fn is_within(&self, tolerance: f64) -> bool {
        let middle = 0.5 * (self.lower + self.upper);
        (self.best.x - middle).abs() <= 2.0 * tolerance - 0.5 * (self.upper - self.lower)
    }

    /// The next place to look at, never closer than `tolerance` to the best one.
    fn propose(&mut self, tolerance: f64) -> f64 {
        let x = self.best.x;
        let step = match self.parabolic_step(tolerance) {
            Some(step) => {
                self.steps.1 = self.steps.0;
                let to_end = (x + step - self.lower).min(self.upper - x - step);
                let towards_middle = 0.5 * (self.lower + self.upper) - x;
                if to_end < 2.0 * tolerance { tolerance.copysign(towards_middle) } else { step }
            }
            None => {
                let middle = 0.5 * (self.lower + self.upper);
                let room = if x < middle { self.upper - x } else { self.lower - x };
                self.steps.1 = room;
                GOLDEN * room
            }
        };
        self.steps.0 = step;
        if step.abs() >= tolerance { x + step } else { x + tolerance.copysign(step) }
    }

    /// The step to the vertex of the parabola through the three best points, if it may be trusted:
    /// inside the interval and less than half of the step before last.
    fn parabolic_step(&self, tolerance: f64) -> Option<f64> {
        let (x, before_last) = (self.best, self.steps.1);
        if before_last.abs() <= tolerance {
            return None;
        }
        let r = (x.x - self.second.x) * (x.y - self.third.y);
        let q = (x.x - self.third.x) * (x.y - self.second.y);
        let numerator = (x.x - self.third.x) * q - (x.x - self.second.x) * r;
        let denominator = 2.0 * (q - r);
        let step = -numerator / denominator;
        let inside = x.x + step > self.lower && x.x + step < self.upper;
        (inside && step.abs() < 0.5 * before_last.abs()).then_some(step)
    }

    fn take(&mut self, next: Sample) {
        if next.y <= self.best.y {
            if next.x < self.best.x {
                self.upper = self.best.x;
            } else {
                self.lower = self.best.x;
            }
            (self.third, self.second, self.best) = (self.second, self.best, next);
            return;
        }
        if next.x < self.best.x {
            self.lower = next.x;
        } else {
            self.upper = next.x;
        }
        if next.y <= self.second.y || self.second.x == self.best.x {
            (self.third, self.second) = (self.second, next);
        } else if next.y <= self.third.y
            || self.third.x == self.best.x
            || self.third.x == self.second.x
        {
            self.third = next;
        }
    }

    fn result(&self, iterations: usize, ending: Ending) -> Minimum {
        Minimum {
            argument: self.best.x,
            value: self.best.y,
            interval: (self.lower, self.upper),
            iterations,
            ending,
        }
    }
}
