//! What an integration in progress shows of itself.

use super::{Dop853, Statistics};
use crate::ode::Settings;

impl<S> Dop853<S> {
    /// The time reached.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// The state at [`Dop853::time`].
    pub fn state(&self) -> &[f64] {
        &self.state[..self.dimension]
    }

    /// The derivative of the state at [`Dop853::time`].
    pub fn rate(&self) -> &[f64] {
        &self.rate[..self.dimension]
    }

    /// The time at which the last accepted step began; the time itself before the first step,
    /// after a reset and after a stop.
    pub fn previous_time(&self) -> f64 {
        self.span.start
    }

    /// The state at [`Dop853::previous_time`].
    pub fn previous_state(&self) -> &[f64] {
        &self.previous[..self.dimension]
    }

    /// The work done so far.
    pub fn statistics(&self) -> Statistics {
        self.statistics
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
    /// [`Dop853::restart_with`].
    pub fn system_mut(&mut self) -> &mut S {
        &mut self.system
    }

    /// Gives the system back.
    pub fn into_system(self) -> S {
        self.system
    }
}
