//! Taking the last step again, but shorter: to end a step exactly where something happens.

use super::dense_step::Span;
use super::integrator::Integrator;
use super::method::{Method, Trial};
use super::{Stop, System};

impl<S: System, M: Method<S>> Integrator<S, M> {
    /// Takes the last accepted step again from its beginning, but only to `end`, as one step of the
    /// method: the state there has the full order, not that of the dense output, and is what a new
    /// integrator would find that starts there with a step of this length.
    ///
    /// May be repeated with any `end` inside the step as it was first accepted. Afterwards the time
    /// is `end`, [`Integrator::previous_time`] still the beginning, and [`Integrator::dense`] covers
    /// the shorter step. The system must be as it was.
    ///
    /// # Errors
    ///
    /// [`Stop::OutsideStep`] if `end` is not inside the step, after which nothing has changed.
    /// [`Stop::NonFinite`] or [`Stop::StepTooSmall`] if the shorter step cannot be taken, which the
    /// longer one makes unlikely: the integrator then stands where it stood, as after a stop.
    pub fn retake(&mut self, end: f64) -> Result<(), Stop> {
        let span = Span { start: self.span.start, length: end - self.span.start };
        let whole = self.furthest - span.start;
        let share = span.length / whole;
        if !(share > 0.0 && share <= 1.0) {
            let (start, time) = (span.start, self.furthest);
            return Err(Stop::OutsideStep { start, time, end });
        }
        self.method.forget();
        self.dense_is_ready = false;
        let trial = Trial {
            span,
            end_time: end,
            state: &self.previous,
            rate: &self.previous_rate,
            scale: &self.scale,
            is_controlled: false,
            is_unsure: true,
        };
        let error =
            self.method.attempt(&mut self.system, &trial, &mut self.trial, &mut self.statistics);
        if error > 0.0 {
            let stop = Stop::StepTooSmall { time: span.start, step: span.length };
            return Err(self.stopped(stop));
        }
        if error.is_nan() || !self.is_trial_finite(end) {
            return Err(self.stopped(Stop::NonFinite { time: span.start }));
        }
        std::mem::swap(&mut self.state, &mut self.trial);
        std::mem::swap(&mut self.rate, &mut self.trial_rate);
        self.method.accepted(span, &self.rate);
        (self.time, self.span) = (end, span);
        Ok(())
    }
}
