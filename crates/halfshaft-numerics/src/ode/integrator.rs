//! The integrator that all one-step methods share: accepting, rejecting, landing, retaking.

use super::control::{Attempt, StepControl};
use super::dense_step::{Coefficients, Span};
use super::lanes::{WIDTH, groups, padded_copy};
use super::method::{Method, Trial};
use super::norm::ErrorScale;
use super::stiffness::Stiffness;
use super::{DenseStep, Settings, Statistics, Step, Stop, System, first_step};
use crate::error::{Error, all_finite, has_length};

/// An integration in progress: a time, a state, and the step that led there.
///
/// Its names are [`super::dop853::Dop853`], [`super::dopri5::Dopri5`] and
/// [`super::radau5::Radau5`], after the method `M`.
#[derive(Debug, Clone)]
pub struct Integrator<S, M> {
    pub(super) system: S,
    pub(super) dimension: usize,
    pub(super) time: f64,
    /// State, its derivative, and both at the start of the last step: all padded.
    pub(super) state: Vec<f64>,
    pub(super) rate: Vec<f64>,
    pub(super) previous: Vec<f64>,
    pub(super) previous_rate: Vec<f64>,
    /// Scratch for the state and derivative at the end of an attempt.
    pub(super) trial: Vec<f64>,
    pub(super) trial_rate: Vec<f64>,
    /// The last accepted step; of length zero before the first.
    pub(super) span: Span,
    /// Where the last accepted step ended before it was retaken.
    pub(super) furthest: f64,
    pub(super) method: M,
    coefficients: Vec<Coefficients>,
    pub(super) dense_is_ready: bool,
    pub(super) scale: ErrorScale,
    control: StepControl,
    pub(super) settings: Settings,
    pub(super) statistics: Statistics,
    pub(super) stiffness: Stiffness,
}

impl<S: System, M: Method<S>> Integrator<S, M> {
    /// Starts at time `t0` with state `y0`. Evaluates the right-hand side once.
    ///
    /// # Errors
    ///
    /// [`Error::Length`] if the state has not the dimension of the system or none at all,
    /// [`Error::NonFinite`] for a time or state that is not finite, and what
    /// [`Settings::validate`] finds.
    pub fn new(system: S, t0: f64, y0: &[f64], settings: Settings) -> Result<Self, Error> {
        let dimension = system.dimension();
        has_length("state", dimension.max(1), y0.len())?;
        settings.validate(dimension)?;
        all_finite("start time", &[t0])?;
        all_finite("state", y0)?;
        let state = padded_copy(y0, 0.0);
        let zeros = vec![0.0; state.len()];
        let mut integrator = Self {
            system,
            dimension,
            time: t0,
            previous: state.clone(),
            previous_rate: zeros.clone(),
            coefficients: vec![Coefficients::default(); state.len() / WIDTH],
            state,
            rate: zeros.clone(),
            trial: zeros.clone(),
            trial_rate: zeros,
            span: Span { start: t0, length: 0.0 },
            furthest: t0,
            method: M::new(dimension),
            dense_is_ready: false,
            scale: M::scale(&settings, dimension),
            control: StepControl::new(&settings, M::ERROR_POWER, M::PREDICTIVE),
            settings,
            statistics: Statistics::default(),
            stiffness: Stiffness::default(),
        };
        integrator.evaluate_rate();
        Ok(integrator)
    }

    /// Takes one accepted step towards `t_end`, forwards or backwards in time, never past it and,
    /// when it gets there, to it exactly.
    ///
    /// A step cut short by `t_end` does not shorten the ones after it.
    ///
    /// # Errors
    ///
    /// The reason why no step could be accepted. The state stays the last accepted one.
    pub fn step(&mut self, t_end: f64) -> Result<Step, Stop> {
        if t_end == self.time {
            return Ok(Step::Reached);
        }
        self.prepare(t_end)?;
        loop {
            let attempt = self.control.propose(t_end - self.time);
            self.check(attempt).map_err(|stop| self.stopped(stop))?;
            let span = Span { start: self.time, length: attempt.length };
            let end_time = if attempt.lands { t_end } else { span.start + span.length };
            let error = self.attempt(span, end_time);
            if error <= 1.0 && self.accepts(span, end_time) {
                self.control.accept(attempt, error, self.method.strain());
                self.watch_stiffness();
                return Ok(if attempt.lands { Step::Reached } else { Step::Advanced });
            }
            self.statistics.rejected += 1;
            // An error that passes although the end is not finite must shorten the step as well.
            let finite = error > 1.0;
            if finite && self.control.is_fixed() {
                let stop = Stop::StepTooSmall { time: self.time, step: span.length };
                return Err(self.stopped(stop));
            }
            self.control.reject(attempt, if finite { error } else { f64::NAN });
            let next = self.control.propose(t_end - self.time);
            if !finite && (self.control.is_fixed() || self.control.is_too_small(next, self.time)) {
                return Err(self.stopped(Stop::NonFinite { time: self.time }));
            }
        }
    }

    /// The solution inside the last accepted step; constant before the first one, after a reset
    /// and after a stop.
    ///
    /// The first call after a step of the method of order 8 evaluates the right-hand side three
    /// times; the other methods have all they need.
    pub fn dense(&mut self) -> DenseStep<'_> {
        if !self.dense_is_ready {
            self.dense_is_ready = true;
            self.prepare_dense();
        }
        let length = if self.span.length == 0.0 { 1.0 } else { self.span.length };
        DenseStep {
            coefficients: &self.coefficients,
            span: Span { start: self.span.start, length },
            dimension: self.dimension,
        }
    }

    /// Continues from another time and state, as after a discontinuity: the derivative is evaluated
    /// anew, and the step length guessed anew at the next step.
    ///
    /// # Errors
    ///
    /// [`Error::Length`] or [`Error::NonFinite`] for a state that does not fit; nothing has changed
    /// then.
    pub fn reset(&mut self, t: f64, state: &[f64]) -> Result<(), Error> {
        has_length("state", self.dimension, state.len())?;
        all_finite("start time", &[t])?;
        all_finite("state", state)?;
        self.time = t;
        self.state[..self.dimension].copy_from_slice(state);
        self.previous.copy_from_slice(&self.state);
        self.span = Span { start: t, length: 0.0 };
        self.furthest = t;
        self.dense_is_ready = false;
        self.control.reset();
        self.method.forget();
        self.stiffness = Stiffness::default();
        self.evaluate_rate();
        Ok(())
    }

    /// Lets the caller change the system and the state, then resets at the present time.
    ///
    /// # Errors
    ///
    /// [`Error::NonFinite`] if the new state is not finite; the state has not changed then.
    pub fn restart_with(&mut self, change: impl FnOnce(&mut S, &mut [f64])) -> Result<(), Error> {
        let mut state = self.state().to_vec();
        change(&mut self.system, &mut state);
        self.reset(self.time, &state)
    }

    fn evaluate_rate(&mut self) {
        let (state, rate) = (&self.state[..self.dimension], &mut self.rate[..self.dimension]);
        self.system.derivative(self.time, state, rate);
        self.statistics.evaluations += 1;
    }

    /// Guesses the first step if it is still unknown.
    fn prepare(&mut self, t_end: f64) -> Result<(), Stop> {
        if !t_end.is_finite() {
            return Err(Stop::NonFinite { time: self.time });
        }
        if !self.control.needs_guess() {
            return Ok(());
        }
        if !self.rate.iter().all(|rate| rate.is_finite()) {
            return Err(Stop::NonFinite { time: self.time });
        }
        let guess = match self.settings.first_step {
            Some(length) => length,
            None => {
                let remaining = t_end - self.time;
                let start = first_step::Start {
                    time: self.time,
                    state: &self.state,
                    rate: &self.rate,
                    power: M::ERROR_POWER,
                };
                let largest = self.settings.largest_step.min(remaining.abs());
                let direction = remaining.signum();
                self.statistics.evaluations += 1;
                first_step::guess(&mut self.system, &start, direction, &self.scale, largest)
            }
        };
        self.control.set_guess(guess);
        Ok(())
    }

    /// Whether a step may be tried at all.
    #[inline]
    fn check(&self, attempt: Attempt) -> Result<(), Stop> {
        let limit = self.settings.step_limit;
        if self.statistics.accepted + self.statistics.rejected >= limit {
            return Err(Stop::StepLimit { time: self.time, limit });
        }
        if self.control.is_too_small(attempt, self.time) {
            return Err(Stop::StepTooSmall { time: self.time, step: attempt.length });
        }
        Ok(())
    }

    /// Forgets the last step, whose stages the attempts in vain have overwritten.
    pub(super) fn stopped(&mut self, stop: Stop) -> Stop {
        self.previous.copy_from_slice(&self.state);
        self.span = Span { start: self.time, length: 0.0 };
        self.furthest = self.time;
        self.dense_is_ready = false;
        self.method.forget();
        stop
    }

    /// Computes the trial state at the end of a step and returns its error, zero for fixed steps.
    #[inline]
    fn attempt(&mut self, span: Span, end_time: f64) -> f64 {
        self.dense_is_ready = false;
        let trial = Trial {
            span,
            end_time,
            state: &self.state,
            rate: &self.rate,
            scale: &self.scale,
            is_controlled: !self.control.is_fixed(),
            is_unsure: self.control.is_unsure(),
        };
        self.method.attempt(&mut self.system, &trial, &mut self.trial, &mut self.statistics)
    }

    /// Evaluates the derivative at the end of the trial; whether that and the state are finite.
    #[inline]
    pub(super) fn is_trial_finite(&mut self, time: f64) -> bool {
        let (end, rate) = (&self.trial, &mut self.trial_rate);
        self.method.end_rate(&mut self.system, time, end, rate, &mut self.statistics);
        let finite = |values: &[f64]| values.iter().all(|value| value.is_finite());
        finite(&self.trial) && finite(&self.trial_rate)
    }

    /// Moves to the trial state, provided that it and its derivative are finite.
    #[inline]
    fn accepts(&mut self, span: Span, time: f64) -> bool {
        if !self.is_trial_finite(time) {
            return false;
        }
        // The state becomes the previous one, the trial the state, the oldest the next trial.
        std::mem::swap(&mut self.previous, &mut self.state);
        std::mem::swap(&mut self.state, &mut self.trial);
        std::mem::swap(&mut self.previous_rate, &mut self.rate);
        std::mem::swap(&mut self.rate, &mut self.trial_rate);
        self.method.accepted(span, &self.rate);
        self.time = time;
        self.furthest = time;
        self.span = span;
        self.statistics.accepted += 1;
        true
    }

    #[inline]
    fn watch_stiffness(&mut self) {
        if M::STABLE_TO < f64::INFINITY && self.stiffness.is_due() {
            let size =
                self.method.stiffness(self.span.length, &self.state, &self.rate, &self.scale);
            self.stiffness.note(size > M::STABLE_TO);
        }
    }

    fn prepare_dense(&mut self) {
        if self.span.length == 0.0 {
            for (group, state) in self.coefficients.iter_mut().zip(groups(&self.state)) {
                *group = Coefficients::default();
                group[0] = *state;
            }
            return;
        }
        self.method.write_dense(
            &mut self.system,
            self.span,
            (&self.previous, &self.state),
            &mut self.coefficients,
            &mut self.statistics,
        );
    }
}
