//! Newton's method for small dense systems, damped so that a poor start does no harm.
//!
//! The iteration is that of P. Deuflhard, *Newton Methods for Nonlinear Problems* (2004), section
//! 3.3: a step is accepted if the *simplified* correction at the new point, computed with the old
//! Jacobian, is shorter than the step itself. That test compares unknowns with unknowns, so it does
//! not care how the equations are scaled; the unknowns are weighed by their own size
//! ([`Settings::typical`]).
//!
//! What happened is data: [`Report`] holds every iteration and the reason for the end.

mod convergence;

pub use convergence::{Convergence, Iteration, Report};

use crate::dense::{Lu, Matrix};
use crate::error::{Error, all_finite, has_length, setting};
use convergence::ConvergenceTest;

/// The numbers of the method.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// Converged when a full correction is shorter than this, each unknown measured by the larger
    /// of its own and its typical size. Default 1e-10.
    pub step_tolerance: f64,
    /// Converged when no residual is larger than this. Default 0: only the correction decides.
    pub residual_tolerance: f64,
    /// Most Jacobians to factorise. Default 30.
    pub iteration_limit: usize,
    /// The damping factor starts at 1 and is halved down to this before giving up. Default 1e-4.
    pub smallest_damping: f64,
    /// The size below which an unknown counts as small, one for each; empty means 1 for all.
    pub typical: Vec<f64>,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            step_tolerance: 1e-10,
            residual_tolerance: 0.0,
            iteration_limit: 30,
            smallest_damping: 1e-4,
            typical: Vec::new(),
        }
    }
}

impl Settings {
    /// Checks every number.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] with the field that is out of range, [`Error::Length`] if `typical` is
    /// neither empty nor of length `dimension`.
    pub fn validate(&self, dimension: usize) -> Result<(), Error> {
        let positive = "must be positive and finite";
        let tolerance = self.step_tolerance;
        setting("step_tolerance", tolerance, tolerance > 0.0 && tolerance.is_finite(), positive)?;
        let residual = self.residual_tolerance;
        setting("residual_tolerance", residual, residual >= 0.0, "must not be negative")?;
        let damping = self.smallest_damping;
        let within = damping > 0.0 && damping <= 1.0;
        setting("smallest_damping", damping, within, "must lie above 0 and not above 1")?;
        if !self.typical.is_empty() {
            has_length("typical sizes", dimension, self.typical.len())?;
        }
        match self.typical.iter().find(|size| !(**size > 0.0 && size.is_finite())) {
            Some(&size) => setting("typical", size, false, positive),
            None => Ok(()),
        }
    }
}

/// The point that was reached, with the account of how.
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    /// The unknowns: converged, or the best point so far.
    pub unknowns: Vec<f64>,
    /// What happened.
    pub report: Report,
}

/// Solves `F(x) = 0` for as many equations as unknowns, from a starting point.
///
/// `residual(x, out)` writes `F(x)`; `jacobian(x, out)` writes `∂F_i/∂x_j` into row `i`, column `j`
/// of a matrix that comes filled with zeros. A residual that is not finite at a trial point counts
/// as a step that was too long.
///
/// Failing to converge is not an error: the report says why the iteration ended.
///
/// # Errors
///
/// [`Error::Setting`] or [`Error::Length`] for settings that do not fit, [`Error::NonFinite`] if
/// the starting point or the residual there is not finite.
pub fn solve(
    mut residual: impl FnMut(&[f64], &mut [f64]),
    mut jacobian: impl FnMut(&[f64], &mut Matrix),
    start: &[f64],
    settings: &Settings,
) -> Result<Solution, Error> {
    settings.validate(start.len())?;
    all_finite("starting point", start)?;
    let mut point = Point { x: start.to_vec(), residual: vec![0.0; start.len()] };
    residual(&point.x, &mut point.residual);
    all_finite("residual at the starting point", &point.residual)?;

    let mut test = ConvergenceTest::new(settings, &point.residual);
    let mut matrix = Matrix::zeros(start.len(), start.len());
    while test.goes_on() {
        matrix.as_mut_slice().fill(0.0);
        jacobian(&point.x, &mut matrix);
        let Ok(factors) = Lu::new(&matrix) else {
            test.end(Convergence::SingularJacobian);
            break;
        };
        let Some(step) = point.correction(&factors) else {
            test.end(Convergence::SingularJacobian);
            break;
        };
        match damped_step(&point, &step, &factors, &mut residual, settings) {
            Some(trial) => {
                test.accept(&trial);
                point = trial.point;
            }
            None => test.end(Convergence::Stalled),
        }
    }
    Ok(Solution { unknowns: point.x, report: test.report() })
}

/// A point with its residual.
#[derive(Debug, Clone)]
struct Point {
    x: Vec<f64>,
    residual: Vec<f64>,
}

impl Point {
    /// `-J⁻¹ F(x)`, unless it is not finite.
    fn correction(&self, factors: &Lu) -> Option<Vec<f64>> {
        let mut step: Vec<f64> = self.residual.iter().map(|r| -r).collect();
        factors.solve_in_place(&mut step).ok()?;
        step.iter().all(|s| s.is_finite()).then_some(step)
    }
}

/// A step that was accepted.
struct Trial {
    point: Point,
    damping: f64,
    /// Length of the full correction from which the step was taken.
    step: f64,
    /// Length of the simplified correction that remains.
    remaining: f64,
}

/// The longest of the steps 1, 1/2, 1/4, ... of the correction after which less of it remains.
fn damped_step(
    from: &Point,
    correction: &[f64],
    factors: &Lu,
    residual: &mut impl FnMut(&[f64], &mut [f64]),
    settings: &Settings,
) -> Option<Trial> {
    let step = weighted_norm(correction, &from.x, &settings.typical);
    let mut damping = 1.0;
    while damping >= settings.smallest_damping {
        let x: Vec<f64> = from.x.iter().zip(correction).map(|(x, s)| x + damping * s).collect();
        let mut point = Point { residual: vec![0.0; x.len()], x };
        residual(&point.x, &mut point.residual);
        let left = point.correction(factors);
        if let Some(left) = left {
            let remaining = weighted_norm(&left, &from.x, &settings.typical);
            // A correction of rounding size need not shrink any more.
            let tiny = damping == 1.0 && remaining.max(step) <= settings.step_tolerance;
            if tiny || remaining <= (1.0 - 0.25 * damping) * step {
                return Some(Trial { point, damping, step, remaining });
            }
        }
        damping *= 0.5;
    }
    None
}

/// Root mean square of the entries, each divided by the larger of `|x|` and its typical size.
fn weighted_norm(step: &[f64], x: &[f64], typical: &[f64]) -> f64 {
    let square = |(i, (s, x)): (usize, (&f64, &f64))| {
        let size = x.abs().max(typical.get(i).copied().unwrap_or(1.0));
        (s / size) * (s / size)
    };
    let sum: f64 = step.iter().zip(x).enumerate().map(square).sum();
    (sum / step.len().max(1) as f64).sqrt()
}
