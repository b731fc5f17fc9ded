//! What an integration in progress shows of itself.

use super::integrator::Integrator;
use super::method::Method;
use super::{DenseStep, OneStep, Settings, Statistics, Step, Stop, System};
use crate::error::Error;

impl<S, M> Integrator<S, M> {
    /// The time reached.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// The state at [`Integrator::time`].
    pub fn state(&self) -> &[f64] {
        &self.state[..self.dimension]
    }

    /// The derivative of the state at [`Integrator::time`].
    pub fn rate(&self) -> &[f64] {
        &self.rate[..self.dimension]
    }

    /// The time at which the last accepted step began; the time itself before the first step,
    /// after a reset and after a stop.
    pub fn previous_time(&self) -> f64 {
        self.span.start
    }

    /// The state at [`Integrator::previous_time`].
    pub fn previous_state(&self) -> &[f64] {
        &self.previous[..self.dimension]
    }

    /// The work done so far.
    pub fn statistics(&self) -> Statistics {
        self.statistics
    }

    /// Whether stability and not accuracy has held the steps back since the start or the last
    /// reset (Hairer & Wanner II, section IV.2): [`super::radau5`] would then take longer ones.
    /// Found after some twenty such steps; never true of that method itself.
    pub fn is_stiff(&self) -> bool {
        self.stiffness.is_found()
    }

    /// The settings in force.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The system.
    pub fn system(&self) -> &S {
        &self.system
    }

    /// The system, to be changed in ways that leave its right-hand side as it is; for others use
    /// [`Integrator::restart_with`].
    pub fn system_mut(&mut self) -> &mut S {
        &mut self.system
    }

    /// Gives the system back.
    pub fn into_system(self) -> S {
        self.system
    }
}

impl<S: System, M: Method<S>> OneStep for Integrator<S, M> {
    type System = S;

    fn step(&mut self, goal: f64) -> Result<Step, Stop> {
        Self::step(self, goal)
    }

    fn retake(&mut self, end: f64) -> Result<(), Stop> {
        Self::retake(self, end)
    }

    fn time(&self) -> f64 {
        Self::time(self)
    }

    fn state(&self) -> &[f64] {
        Self::state(self)
    }

    fn rate(&self) -> &[f64] {
        Self::rate(self)
    }

    fn previous_time(&self) -> f64 {
        Self::previous_time(self)
    }

    fn previous_state(&self) -> &[f64] {
        Self::previous_state(self)
    }

    fn dense(&mut self) -> DenseStep<'_> {
        Self::dense(self)
    }

    fn reset(&mut self, t: f64, state: &[f64]) -> Result<(), Error> {
        Self::reset(self, t, state)
    }

    fn restart_with(&mut self, change: &mut dyn FnMut(&mut S, &mut [f64])) -> Result<(), Error> {
        Self::restart_with(self, change)
    }

    fn statistics(&self) -> Statistics {
        Self::statistics(self)
    }

    fn is_stiff(&self) -> bool {
        Self::is_stiff(self)
    }

    fn system(&self) -> &S {
        Self::system(self)
    }

    fn system_mut(&mut self) -> &mut S {
        Self::system_mut(self)
    }

    fn into_system(self) -> S {
        Self::into_system(self)
    }
}
