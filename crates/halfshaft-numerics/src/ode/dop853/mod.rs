//! The explicit Runge-Kutta pair of Dormand and Prince of order 8(5,3), with dense output.
//!
//! E. Hairer, S. P. Nørsett, G. Wanner, *Solving Ordinary Differential Equations I*, 2nd ed.
//! (1993): the method is that of section II.5, the error estimate and the dense output are those of
//! their program DOP853. One file for each part: `tableau` (coefficients), `lanes` (arithmetic),
//! `stages`, `norm` (error), `control` and `first_step` (step length), `dense_output`.
//!
//! ```
//! use halfshaft_numerics::ode::{self, Settings, dop853::{Dop853, Step}};
//!
//! let decay = ode::function(1, |_, y: &[f64], rate: &mut [f64]| rate[0] = -y[0]);
//! let mut integrator = Dop853::new(decay, 0.0, &[1.0], Settings::default())?;
//! while integrator.step(2.0)? == Step::Advanced {}
//! assert!((integrator.state()[0] - (-2.0_f64).exp()).abs() < 1e-9);
//! # Ok::<(), halfshaft_numerics::Error>(())
//! ```

mod access;
mod control;
mod dense_output;
mod first_step;
mod lanes;
mod norm;
mod stages;
pub(crate) mod tableau;
#[cfg(test)]
mod tableau_tests;

pub use dense_output::DenseStep;

use super::{Settings, Stop, System};
use crate::error::{Error, all_finite, has_length};
use control::{Attempt, StepControl};
use dense_output::Coefficients;
use lanes::padded_copy;
use norm::ErrorScale;
use stages::{Span, Stages};

/// What a call of [`Dop853::step`] did.
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
    /// Evaluations of the right-hand side.
    pub evaluations: usize,
    /// Steps that met the tolerance.
    pub accepted: usize,
    /// Steps that were tried in vain.
    pub rejected: usize,
}

/// An integration in progress: a time, a state, and the step that led there.
#[derive(Debug, Clone)]
pub struct Dop853<S> {
    system: S,
    dimension: usize,
    time: f64,
    /// State, its derivative, and the state before: all padded.
    state: Vec<f64>,
    rate: Vec<f64>,
    previous: Vec<f64>,
    /// Scratch for the state and derivative at the end of an attempt.
    trial: Vec<f64>,
    trial_rate: Vec<f64>,
    /// The last accepted step; of length zero before the first.
    span: Span,
    stages: Stages,
    coefficients: Vec<Coefficients>,
    dense_is_ready: bool,
    scale: ErrorScale,
    control: StepControl,
    settings: Settings,
    statistics: Statistics,
}

impl<S: System> Dop853<S> {
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
        let absolute: Vec<f64> =
            (0..dimension).map(|component| settings.absolute_tolerance.of(component)).collect();
        let state = padded_copy(y0, 0.0);
        let zeros = vec![0.0; state.len()];
        let stages = Stages::new(dimension);
        let mut integrator = Self {
            system,
            dimension,
            time: t0,
            previous: state.clone(),
            state,
            rate: zeros.clone(),
            trial: zeros.clone(),
            trial_rate: zeros,
            span: Span { start: t0, length: 0.0 },
            coefficients: vec![Coefficients::default(); stages.slopes().len()],
            stages,
            dense_is_ready: false,
            scale: ErrorScale {
                absolute: padded_copy(&absolute, 1.0),
                relative: settings.relative_tolerance,
                dimension,
            },
            control: StepControl::new(&settings),
            settings,
            statistics: Statistics::default(),
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
            let error = self.attempt(span);
            if error <= 1.0 && self.accepts(span, t_end, attempt.lands) {
                self.control.accept(attempt, error);
                return Ok(if attempt.lands { Step::Reached } else { Step::Advanced });
            }
            self.statistics.rejected += 1;
            // An error that passes although the end is not finite must shorten the step as well.
            let finite = error > 1.0;
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
    /// The first call after a step evaluates the right-hand side three times.
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

    /// Takes the last accepted step again from its beginning, but only to `end` inside it, as one step of
    /// full order.
    ///
    /// # Errors
    ///
    /// [`Stop::NonFinite`] where that is not finite.
    pub fn retake(&mut self, end: f64) -> Result<(), Stop> {
        let start = self.span.start;
        self.state.copy_from_slice(&self.previous);
        self.time = start;
        self.evaluate_rate();
        let span = Span { start, length: end - start };
        self.attempt(span);
        if !self.accepts(span, end, true) {
            return Err(self.stopped(Stop::NonFinite { time: start }));
        }
        self.statistics.accepted -= 1;
        Ok(())
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
        self.dense_is_ready = false;
        self.control.reset();
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
                let start =
                    first_step::Start { time: self.time, state: &self.state, rate: &self.rate };
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
    fn stopped(&mut self, stop: Stop) -> Stop {
        self.previous.copy_from_slice(&self.state);
        self.span = Span { start: self.time, length: 0.0 };
        self.dense_is_ready = false;
        stop
    }

    /// Computes the trial state at the end of a step and returns its error, zero for fixed steps.
    #[inline]
    fn attempt(&mut self, span: Span) -> f64 {
        self.dense_is_ready = false;
        self.stages.run(&mut self.system, span, &self.state, &self.rate, &mut self.trial);
        self.statistics.evaluations += Stages::TRIED;
        if self.control.is_fixed() {
            return 0.0;
        }
        self.scale.of_step(span.length, self.stages.slopes(), &self.state, &self.trial)
    }

    /// Moves to the trial state, provided that it and its derivative are finite.
    #[inline]
    fn accepts(&mut self, span: Span, t_end: f64, lands: bool) -> bool {
        let time = if lands { t_end } else { span.start + span.length };
        let dimension = self.dimension;
        self.system.derivative(time, &self.trial[..dimension], &mut self.trial_rate[..dimension]);
        self.statistics.evaluations += 1;
        let finite = |values: &[f64]| values.iter().all(|value| value.is_finite());
        if !(finite(&self.trial) && finite(&self.trial_rate)) {
            return false;
        }
        // The state becomes the previous one, the trial the state, the oldest the next trial.
        std::mem::swap(&mut self.previous, &mut self.state);
        std::mem::swap(&mut self.state, &mut self.trial);
        std::mem::swap(&mut self.rate, &mut self.trial_rate);
        self.stages.keep_last(&self.rate);
        self.time = time;
        self.span = span;
        self.statistics.accepted += 1;
        true
    }

    fn prepare_dense(&mut self) {
        if self.span.length == 0.0 {
            for (group, state) in self.coefficients.iter_mut().zip(lanes::groups(&self.state)) {
                *group = Coefficients::default();
                group[0] = *state;
            }
            return;
        }
        self.stages.run_dense(&mut self.system, self.span, &self.previous);
        self.statistics.evaluations += Stages::DENSE;
        dense_output::write_coefficients(
            &mut self.coefficients,
            self.stages.slopes(),
            self.span.length,
            &self.previous,
            &self.state,
        );
    }
}
