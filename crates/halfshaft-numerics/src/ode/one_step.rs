//! The interface that all integrators share.

use super::{DenseStep, Stop, System};
use crate::error::Error;

/// What a call of [`OneStep::step`] did.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Step {
    /// One step was accepted; the goal is still ahead.
    Advanced,
    /// The time is exactly the goal: after one accepted step, or none if it was so before.
    Reached,
}

/// Counts of the work done.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Statistics {
    /// Evaluations of the right-hand side, not counting those that a Jacobian takes.
    pub evaluations: usize,
    /// Steps that met the tolerance.
    pub accepted: usize,
    /// Steps that were tried in vain.
    pub rejected: usize,
    /// Jacobians evaluated; none by explicit methods.
    pub jacobians: usize,
    /// Pairs of matrices factorised; none by explicit methods.
    pub factorisations: usize,
}

/// An integration in progress by any one-step method: a time, a state, and the step that led there.
///
/// The integrators offer the same as methods of their own; the trait is for code that takes any.
/// It can be used as `dyn OneStep<System = S>`.
pub trait OneStep {
    /// The system that is integrated.
    type System: System;

    /// Takes one accepted step towards `goal`; see [`super::Integrator::step`].
    ///
    /// # Errors
    ///
    /// The reason why no step could be accepted. The state stays the last accepted one.
    fn step(&mut self, goal: f64) -> Result<Step, Stop>;

    /// Takes the last accepted step again, but only to `end`; see [`super::Integrator::retake`].
    ///
    /// # Errors
    ///
    /// [`Stop::OutsideStep`], after which nothing has changed, or the reason why the shorter step
    /// could not be taken.
    fn retake(&mut self, end: f64) -> Result<(), Stop>;

    /// The time reached.
    fn time(&self) -> f64;

    /// The state at [`OneStep::time`].
    fn state(&self) -> &[f64];

    /// The derivative of the state at [`OneStep::time`].
    fn rate(&self) -> &[f64];

    /// The time at which the last accepted step began; see [`super::Integrator::previous_time`].
    fn previous_time(&self) -> f64;

    /// The state at [`OneStep::previous_time`].
    fn previous_state(&self) -> &[f64];

    /// The solution inside the last accepted step.
    fn dense(&mut self) -> DenseStep<'_>;

    /// Continues from another time and state, as after a discontinuity.
    ///
    /// # Errors
    ///
    /// [`Error::Length`] or [`Error::NonFinite`] for a state that does not fit; nothing has changed
    /// then.
    fn reset(&mut self, t: f64, state: &[f64]) -> Result<(), Error>;

    /// Lets the caller change the system and the state, then resets at the present time.
    ///
    /// # Errors
    ///
    /// [`Error::NonFinite`] if the new state is not finite; the state has not changed then.
    fn restart_with(
        &mut self,
        change: &mut dyn FnMut(&mut Self::System, &mut [f64]),
    ) -> Result<(), Error>;

    /// The work done so far.
    fn statistics(&self) -> Statistics;

    /// Whether stability and not accuracy has held the steps back since the start or the last
    /// reset: an implicit method would then take longer ones. Never true of implicit methods.
    fn is_stiff(&self) -> bool;

    /// The system.
    fn system(&self) -> &Self::System;

    /// The system, to be changed in ways that leave its right-hand side as it is; for others use
    /// [`OneStep::restart_with`].
    fn system_mut(&mut self) -> &mut Self::System;

    /// Gives the system back.
    fn into_system(self) -> Self::System
    where
        Self: Sized;
}
