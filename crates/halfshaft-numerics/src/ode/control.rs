//! The length of the next step.

use crate::ode::Settings;

/// A step that would leave less than this share of itself to the goal is stretched to reach it.
const STRETCH: f64 = 1.01;
/// A step must move the time by at least this many units of its last place.
const LEAST_UNITS: f64 = 10.0;
/// Errors below this do not count as a trend.
const LEAST_TREND: f64 = 1e-2;
/// Growth of the step up to this factor is forgone by methods that factorise matrices.
const FORGONE: f64 = 1.2;

/// A step that is about to be tried.
#[derive(Debug, Clone, Copy)]
pub(super) struct Attempt {
    /// Signed length.
    pub(super) length: f64,
    /// Whether it ends exactly at the goal.
    pub(super) lands: bool,
}

/// Chooses step lengths from the errors of the steps before.
#[derive(Debug, Clone)]
pub(super) struct StepControl {
    safety: f64,
    smallest_factor: f64,
    largest_factor: f64,
    largest_step: f64,
    fixed: bool,
    /// Length that the error asks for, without sign; unknown before the first step.
    next: Option<f64>,
    /// Whether the last attempt was rejected.
    rejected: bool,
    /// The power of the step length with which the error falls.
    power: u32,
    /// Whether the trend of the errors is heeded as well.
    predictive: bool,
    /// Length and error of the last accepted step, for the trend.
    before: Option<(f64, f64)>,
}

impl StepControl {
    pub(super) fn new(settings: &Settings, power: u32, predictive: bool) -> Self {
        Self {
            safety: settings.safety,
            smallest_factor: settings.smallest_factor,
            largest_factor: settings.largest_factor,
            largest_step: settings.largest_step,
            fixed: settings.fixed_step.is_some(),
            next: settings.fixed_step,
            rejected: false,
            power,
            predictive,
            before: None,
        }
    }

    /// Forgets what the errors so far have taught.
    pub(super) fn reset(&mut self) {
        if !self.fixed {
            self.next = None;
        }
        self.rejected = false;
        self.before = None;
    }

    /// Whether the first step has still to be guessed.
    pub(super) fn needs_guess(&self) -> bool {
        self.next.is_none()
    }

    pub(super) fn set_guess(&mut self, length: f64) {
        self.next = Some(length);
    }

    /// Whether all steps are of one length and every error is accepted.
    pub(super) fn is_fixed(&self) -> bool {
        self.fixed
    }

    /// Whether no step has been accepted since the start or the last rejection.
    #[inline]
    pub(super) fn is_unsure(&self) -> bool {
        self.rejected || self.before.is_none()
    }

    /// The next attempt, with `remaining` (signed) to go.
    #[inline]
    pub(super) fn propose(&self, remaining: f64) -> Attempt {
        let length = self.wanted();
        if remaining.abs() <= STRETCH * length {
            Attempt { length: remaining, lands: true }
        } else {
            Attempt { length: length.copysign(remaining), lands: false }
        }
    }

    fn wanted(&self) -> f64 {
        self.next.unwrap_or(self.largest_step).min(self.largest_step)
    }

    /// Whether a step is lost in the rounding of the time.
    #[inline]
    pub(super) fn is_too_small(&self, attempt: Attempt, time: f64) -> bool {
        let least = LEAST_UNITS * f64::EPSILON * time.abs();
        attempt.length == 0.0 || (!attempt.lands && attempt.length.abs() <= least)
    }

    /// Takes note of an accepted step; `strain` is what the error counts for beyond itself.
    #[inline]
    pub(super) fn accept(&mut self, attempt: Attempt, error: f64, strain: f64) {
        if self.fixed {
            return;
        }
        let most = if self.rejected { 1.0 } else { self.largest_factor };
        let length = attempt.length.abs();
        let mut factor = self.factor(error * strain);
        if self.predictive {
            factor = self.predicted(length, error, factor);
        }
        let next = length * factor.min(most);
        // A step cut short to land on the goal says nothing against the length wanted before.
        let wanted = self.wanted();
        self.next = Some(if length < wanted { next.max(wanted) } else { next });
        self.rejected = false;
    }

    pub(super) fn reject(&mut self, attempt: Attempt, error: f64) {
        self.next = Some(attempt.length.abs() * self.factor(error).min(self.safety));
        self.rejected = true;
    }

    /// The factor that the trend from the step before allows, if that is smaller (Gustafsson;
    /// Hairer & Wanner II, section IV.8). A little growth is forgone: it would cost a factorisation.
    fn predicted(&mut self, length: f64, error: f64, factor: f64) -> f64 {
        let mut result = factor;
        if let Some((before, error_before)) = self.before {
            let trend = error * error / error_before;
            let allowed = self.safety * length / (before * root(trend, self.power));
            result = factor.min(allowed.max(self.smallest_factor));
        }
        self.before = Some((length, error.max(LEAST_TREND)));
        if (1.0..=FORGONE).contains(&result) { 1.0 } else { result }
    }

    /// `safety / error^(1/power)` within its limits; the least if the error is not a number.
    #[inline]
    fn factor(&self, error: f64) -> f64 {
        let factor = self.safety / root(error, self.power);
        if factor.is_nan() {
            self.smallest_factor
        } else {
            factor.clamp(self.smallest_factor, self.largest_factor)
        }
    }
}

/// `value^(1/power)`, by square roots where they do.
#[inline]
fn root(value: f64, power: u32) -> f64 {
    match power {
        8 => value.sqrt().sqrt().sqrt(),
        4 => value.sqrt().sqrt(),
        _ => value.powf(1.0 / f64::from(power)),
    }
}
