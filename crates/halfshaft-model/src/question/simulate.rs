//! The options of `simulate`.

use serde::Serialize;

use super::channel::InitialValue;
use super::kinds::Start;
use crate::format::words;

/// How a motion in time takes dry friction.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum DryFriction {
    /// It sticks, breaks away and slides.
    #[default]
    Exact,
    /// Smoothed by the friction speed, as in harmonic balance.
    Smoothed,
}

impl DryFriction {
    /// All ways with their names.
    pub const ALL: [(&'static str, Self); 2] =
        [("exact", Self::Exact), ("smoothed", Self::Smoothed)];
    /// The names alone.
    pub const WORDS: [&'static str; Self::ALL.len()] = words(&Self::ALL);
}

/// Which integrator takes the steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum IntegratorChoice {
    /// The explicit one of order 8, an implicit one from where the equations are stiff.
    #[default]
    Automatic,
    /// Dormand and Prince, order 8.
    Dop853,
    /// Dormand and Prince, order 5.
    Dopri5,
    /// Radau IIA, order 5, implicit.
    Radau5,
}

impl IntegratorChoice {
    /// All choices with their names.
    pub const ALL: [(&'static str, Self); 4] = [
        ("automatic", Self::Automatic),
        ("dop853", Self::Dop853),
        ("dopri5", Self::Dopri5),
        ("radau5", Self::Radau5),
    ];
    /// The names alone.
    pub const WORDS: [&'static str; Self::ALL.len()] = words(&Self::ALL);
}

// What a question leaves at its default is not among the settings that answers list.
fn is_zero(value: &f64) -> bool {
    *value == 0.0
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde hands a reference")]
fn is_exact(friction: &DryFriction) -> bool {
    *friction == DryFriction::Exact
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde hands a reference")]
fn is_automatic(choice: &IntegratorChoice) -> bool {
    *choice == IntegratorChoice::Automatic
}

/// Settings of `simulate`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SimulateQuestion {
    /// End of the time history, s.
    pub duration: f64,
    /// What the initial values are set upon.
    pub start: Start,
    /// Values that differ from `start` at time 0.
    pub initial: Vec<InitialValue>,
    /// Excitation speed Ω, rad/s; without it torques of an order are silent. At the start, where it moves.
    pub frequency: Option<f64>,
    /// Rate at which Ω moves, rad/s²: a run-up, or a run-down below zero.
    #[serde(skip_serializing_if = "is_zero")]
    pub acceleration: f64,
    /// Channel whose order spectra are told; `None` for the torque of the first nonlinear shaft.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub orders: Option<String>,
    /// Whether dry friction sticks and slides exactly, or is smoothed.
    #[serde(skip_serializing_if = "is_exact")]
    pub friction: DryFriction,
    /// Which integrator takes the steps.
    #[serde(skip_serializing_if = "is_automatic")]
    pub integrator: IntegratorChoice,
    /// Output step, s; `None` for a two-thousandth of what is recorded.
    pub step: Option<f64>,
    /// Relative tolerance of the integration.
    pub tolerance: f64,
    /// Times of which the history is kept and measured, s; `None` for all.
    pub record: Option<(f64, f64)>,
}

impl Default for SimulateQuestion {
    fn default() -> Self {
        Self {
            duration: 5.0,
            start: Start::Rest,
            initial: Vec::new(),
            frequency: None,
            acceleration: 0.0,
            friction: DryFriction::Exact,
            orders: None,
            integrator: IntegratorChoice::Automatic,
            step: None,
            tolerance: 1e-10,
            record: None,
        }
    }
}
