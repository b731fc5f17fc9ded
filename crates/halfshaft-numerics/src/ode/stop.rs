//! Why an integration could not go on.

/// Why an integration ended before its goal.
///
/// The integrator keeps the last accepted state, so what was computed until then is not lost.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum Stop {
    /// As many steps as allowed were tried.
    #[error("the limit of {limit} steps was reached at t = {time}")]
    StepLimit {
        /// Time of the last accepted state.
        time: f64,
        /// The limit from the settings.
        limit: usize,
    },
    /// The tolerance asks for steps that the time cannot resolve: usually a singularity of the
    /// solution, or a right-hand side with a jump.
    #[error("the step of {step:e} became too small at t = {time}")]
    StepTooSmall {
        /// Time of the last accepted state.
        time: f64,
        /// Length of the step that would have been tried next.
        step: f64,
    },
    /// The right-hand side or the state ceased to be finite, however short the step.
    #[error("the solution is no longer finite beyond t = {time}")]
    NonFinite {
        /// Time of the last accepted state.
        time: f64,
    },
    /// A step cannot be taken again to a time outside it.
    #[error("t = {end} is not inside the last step, from {start} to {time}")]
    OutsideStep {
        /// Where the step began.
        start: f64,
        /// Where it ended.
        time: f64,
        /// The time that was asked for.
        end: f64,
    },
}
