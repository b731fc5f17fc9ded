//! Roots and minima of functions of one variable on an interval.
//!
//! [`find_root`] closes in on a change of sign, [`find_minimum`] on a least value; both need
//! nothing but function values and say how wide the final interval is.

mod minimum;
mod root;

pub use minimum::{Minimum, MinimumSettings, find_minimum};
pub use root::{BracketedRoot, RootSettings, find_root};

use crate::error::{Error, all_finite, setting};

/// Why a search on an interval ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Ending {
    /// The interval is as narrow as asked for, or the function is exactly zero.
    Converged,
    /// The limit of iterations came first; the result is the best point so far.
    IterationLimit,
}

/// A point of the function's graph.
#[derive(Debug, Clone, Copy)]
struct Sample {
    x: f64,
    y: f64,
}

fn sample(function: &mut impl FnMut(f64) -> f64, x: f64) -> Result<Sample, Error> {
    all_finite("place in a bracket", &[x])?;
    let y = function(x);
    if y.is_nan() {
        return Err(Error::NonFinite { quantity: "function value in a bracket", value: y });
    }
    Ok(Sample { x, y })
}

fn check_tolerances(absolute: f64, relative: f64) -> Result<(), Error> {
    let requirement = "must not be negative";
    setting("absolute_tolerance", absolute, absolute >= 0.0, requirement)?;
    setting("relative_tolerance", relative, relative >= 0.0, requirement)
}
