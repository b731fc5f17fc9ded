//! What a one-step method supplies to the integrator that all methods share.

use super::dense_step::{Coefficients, Span};
use super::norm::ErrorScale;
use super::{Settings, Statistics, System};

/// A step that is about to be computed. Vectors are padded.
#[derive(Debug)]
pub struct Trial<'a> {
    pub(super) span: Span,
    /// The time at the end, which may differ from start and length by rounding.
    pub(super) end_time: f64,
    pub(super) state: &'a [f64],
    pub(super) rate: &'a [f64],
    pub(super) scale: &'a ErrorScale,
    /// Whether the error has to be estimated.
    pub(super) is_controlled: bool,
    /// Whether nothing is known of the length: the first step, or one after a rejection.
    pub(super) is_unsure: bool,
}

/// One-step methods; each knows how to compute a step, its error and what lies inside it.
pub trait Method<S: System> {
    /// The power of the step length with which the estimated error falls.
    const ERROR_POWER: u32;
    /// Whether the step control heeds the trend of the errors.
    const PREDICTIVE: bool = false;
    /// Value of [`Self::stiffness`] from which on a step is at the limit of stability.
    const STABLE_TO: f64 = f64::INFINITY;

    /// Space for a system of so many components.
    fn new(dimension: usize) -> Self;

    /// What errors are measured by.
    fn scale(settings: &Settings, dimension: usize) -> ErrorScale {
        ErrorScale::from_settings(settings, dimension)
    }

    /// Writes the state at the end of the step; returns its error in units of the tolerance, zero
    /// where it need not be known. NaN tells that something was not finite, infinity that the step
    /// was too long for the method.
    fn attempt(
        &mut self,
        system: &mut S,
        trial: &Trial<'_>,
        end: &mut [f64],
        work: &mut Statistics,
    ) -> f64;

    /// Writes the derivative at the end of the step that was just tried.
    fn end_rate(
        &mut self,
        system: &mut S,
        time: f64,
        end: &[f64],
        rate: &mut [f64],
        work: &mut Statistics,
    );

    /// The step was accepted; `rate` is the derivative at its end.
    fn accepted(&mut self, span: Span, rate: &[f64]);

    /// What the error of the last step should count for beyond itself when the next is chosen.
    fn strain(&self) -> f64 {
        1.0
    }

    /// About `|h λ|` of the eigenvalue of largest modulus, from the step that was just accepted.
    fn stiffness(&self, _length: f64, _end: &[f64], _rate: &[f64], _scale: &ErrorScale) -> f64 {
        0.0
    }

    /// Writes the polynomial of the last accepted step between the states at its `ends`.
    fn write_dense(
        &mut self,
        system: &mut S,
        span: Span,
        ends: (&[f64], &[f64]),
        coefficients: &mut [Coefficients],
        work: &mut Statistics,
    );

    /// Forgets all earlier steps: the next is taken as the first one.
    fn forget(&mut self) {}
}
