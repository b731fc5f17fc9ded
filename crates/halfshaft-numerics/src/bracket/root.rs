//! Chandrupatla's search for a root.

use super::{Ending, Sample, check_tolerances, sample};
use crate::error::Error;

/// The numbers of the root search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RootSettings {
    /// The search ends when the bracket is narrower than this plus the relative part. Default 0.
    pub absolute_tolerance: f64,
    /// Share of the root's size that the bracket may keep. Default 4 units in the last place
    /// (8.9e-16); 2.2e-16 is the least that makes sense.
    pub relative_tolerance: f64,
    /// Most function values after the two at the ends. Default 200: more than three times what
    /// bisection alone needs for ordinary brackets.
    pub iteration_limit: usize,
}

impl Default for RootSettings {
    fn default() -> Self {
        Self {
            absolute_tolerance: 0.0,
            relative_tolerance: 4.0 * f64::EPSILON,
            iteration_limit: 200,
        }
    }
}

/// A root with the interval in which the sign changes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BracketedRoot {
    /// The end of the final interval with the smaller residual.
    pub value: f64,
    /// The function there.
    pub residual: f64,
    /// The final interval, lower end first; both ends equal if the function is exactly zero.
    pub interval: (f64, f64),
    /// Function values taken, besides those at the two given ends.
    pub iterations: usize,
    /// Why the search ended.
    pub ending: Ending,
}

/// A root of a continuous function between `a` and `b`, in either order.
///
/// T. R. Chandrupatla, *A new hybrid quadratic/bisection algorithm for finding the zero of a
/// nonlinear function without using derivatives*, Advances in Engineering Software 28 (1997) 145:
/// inverse quadratic interpolation where it is sure to be safe, otherwise bisection.
///
/// # Errors
///
/// [`Error::NotBracketed`] if the signs at the ends are equal, [`Error::NonFinite`] if an end is
/// not finite or the function returns NaN, [`Error::Setting`] for tolerances that are negative.
pub fn find_root(
    mut function: impl FnMut(f64) -> f64,
    a: f64,
    b: f64,
    settings: RootSettings,
) -> Result<BracketedRoot, Error> {
    check_tolerances(settings.absolute_tolerance, settings.relative_tolerance)?;
    let mut sample = |x| sample(&mut function, x);
    let mut search = RootSearch::new(sample(a)?, sample(b)?)?;
    for iterations in 0..settings.iteration_limit {
        match search.propose(settings) {
            Some(x) => search.take(sample(x)?),
            None => return Ok(search.result(iterations, Ending::Converged)),
        }
    }
    let ending = match search.propose(settings) {
        Some(_) => Ending::IterationLimit,
        None => Ending::Converged,
    };
    Ok(search.result(settings.iteration_limit, ending))
}

/// A bracket and the point to try next.
struct RootSearch {
    newest: Sample,
    /// The end with the other sign.
    opposite: Sample,
    /// How far to go from the newest towards the opposite end.
    share: f64,
}

impl RootSearch {
    fn new(opposite: Sample, newest: Sample) -> Result<Self, Error> {
        if opposite.y != 0.0 && newest.y != 0.0 && (opposite.y < 0.0) == (newest.y < 0.0) {
            return Err(Error::NotBracketed {
                lower: opposite.x,
                upper: newest.x,
                value_at_lower: opposite.y,
                value_at_upper: newest.y,
            });
        }
        Ok(Self { newest, opposite, share: 0.5 })
    }

    fn best(&self) -> Sample {
        if self.newest.y.abs() < self.opposite.y.abs() { self.newest } else { self.opposite }
    }

    /// Where to look next; nothing if the bracket is narrow enough.
    fn propose(&self, settings: RootSettings) -> Option<f64> {
        let best = self.best();
        let start = self.newest.x;
        let width = self.opposite.x - start;
        let tolerance = settings.absolute_tolerance + settings.relative_tolerance * best.x.abs();
        // Neighbouring numbers cannot be parted, whatever the tolerance.
        let middle = start + 0.5 * width;
        let inseparable = middle == start || middle == self.opposite.x;
        if best.y == 0.0 || width.abs() <= tolerance || inseparable {
            return None;
        }
        let least = (0.5 * tolerance / width.abs()).min(0.5);
        let x = start + self.share.clamp(least, 1.0 - least) * width;
        Some(if x == start || x == self.opposite.x { middle } else { x })
    }

    fn take(&mut self, next: Sample) {
        let third = if (next.y < 0.0) == (self.newest.y < 0.0) {
            self.newest
        } else {
            std::mem::replace(&mut self.opposite, self.newest)
        };
        self.newest = next;
        self.share = interpolated_share(next, self.opposite, third);
    }

    fn result(&self, iterations: usize, ending: Ending) -> BracketedRoot {
        let (best, a, b) = (self.best(), self.newest.x, self.opposite.x);
        let interval = if best.y == 0.0 { (best.x, best.x) } else { (a.min(b), a.max(b)) };
        BracketedRoot { value: best.x, residual: best.y, interval, iterations, ending }
    }
}

/// How far to go from `newest` towards `opposite`: by inverse quadratic interpolation if the three
/// points make it monotone (Chandrupatla's criterion), otherwise half-way.
fn interpolated_share(newest: Sample, opposite: Sample, third: Sample) -> f64 {
    let xi = (newest.x - opposite.x) / (third.x - opposite.x);
    let phi = (newest.y - opposite.y) / (third.y - opposite.y);
    if phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi {
        let (fa, fb, fc) = (newest.y, opposite.y, third.y);
        let stretch = (third.x - newest.x) / (opposite.x - newest.x);
        (fa / (fb - fa)) * (fc / (fb - fc)) + stretch * (fa / (fc - fa)) * (fb / (fc - fb))
    } else {
        0.5
    }
}
