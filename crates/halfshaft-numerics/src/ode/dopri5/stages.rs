//! The stages of one step, its error and its polynomial.

use super::tableau::{A1, A2, A3, A4, A5, B, C, D4, E, STAGES};
use crate::ode::dense_step::{Coefficients, Span};
use crate::ode::lanes::{Lanes, WIDTH, groups, weighted};
use crate::ode::method::{Method, Trial};
use crate::ode::norm::ErrorScale;
use crate::ode::slopes::Slopes;
use crate::ode::{Statistics, System};

/// Last stage before the end of the step.
const BEFORE_LAST: usize = 5;
/// Stage that holds the derivative at the end of the step.
const LAST: usize = 6;

/// The method of Dormand and Prince of order 5.
#[derive(Debug, Clone)]
pub struct Stages {
    dimension: usize,
    slopes: Slopes<STAGES>,
    end_rate: Vec<f64>,
}

impl<S: System> Method<S> for Stages {
    const ERROR_POWER: u32 = 5;
    const STABLE_TO: f64 = 3.25;

    fn new(dimension: usize) -> Self {
        let end_rate = vec![0.0; crate::ode::lanes::padded(dimension)];
        Self { dimension, slopes: Slopes::new(dimension), end_rate }
    }

    /// The error needs the derivative at the end, which is the first stage of the next step.
    #[inline]
    fn attempt(
        &mut self,
        system: &mut S,
        trial: &Trial<'_>,
        end: &mut [f64],
        work: &mut Statistics,
    ) -> f64 {
        let (span, state) = (trial.span, trial.state);
        self.slopes.keep(0, trial.rate);
        self.slopes.stage(system, span, state, (1, C[1]), &A1);
        self.slopes.stage(system, span, state, (2, C[2]), &A2);
        self.slopes.stage(system, span, state, (3, C[3]), &A3);
        self.slopes.stage(system, span, state, (4, C[4]), &A4);
        self.slopes.stage(system, span, state, (BEFORE_LAST, C[BEFORE_LAST]), &A5);
        self.slopes.advance(span.length, state, &B, end);
        let dimension = self.dimension;
        system.derivative(trial.end_time, &end[..dimension], &mut self.end_rate[..dimension]);
        self.slopes.keep(LAST, &self.end_rate);
        work.evaluations += LAST;
        if trial.is_controlled { self.error(trial, end) } else { 0.0 }
    }

    #[inline]
    fn end_rate(&mut self, _: &mut S, _: f64, _: &[f64], rate: &mut [f64], _: &mut Statistics) {
        self.slopes.write(LAST, rate);
    }

    fn accepted(&mut self, _: Span, _: &[f64]) {}

    fn stiffness(&self, length: f64, end: &[f64], rate: &[f64], scale: &ErrorScale) -> f64 {
        self.slopes.stiffness(BEFORE_LAST, length, end, rate, scale)
    }

    fn write_dense(
        &mut self,
        _: &mut S,
        span: Span,
        (start, end): (&[f64], &[f64]),
        coefficients: &mut [Coefficients],
        _: &mut Statistics,
    ) {
        let states = groups(start).iter().zip(groups(end));
        for ((all, slopes), (start, end)) in
            coefficients.iter_mut().zip(self.slopes.groups()).zip(states)
        {
            let highest = weighted(slopes, &D4);
            *all = Coefficients::default();
            for lane in 0..WIDTH {
                let change = end[lane] - start[lane];
                let at_start = span.length * slopes[0][lane] - change;
                all[0][lane] = start[lane];
                all[1][lane] = change;
                all[2][lane] = at_start;
                all[3][lane] = change - span.length * slopes[LAST][lane] - at_start;
                all[4][lane] = span.length * highest[lane];
            }
        }
    }
}

impl Stages {
    /// Root mean square of the difference of the two solutions in units of the tolerance.
    #[inline]
    fn error(&self, trial: &Trial<'_>, end: &[f64]) -> f64 {
        let mut sum = Lanes::default();
        let tolerances = groups(&trial.scale.absolute).iter();
        let states = groups(trial.state).iter().zip(groups(end));
        for ((slopes, (start, end)), absolute) in
            self.slopes.groups().iter().zip(states).zip(tolerances)
        {
            let scale = trial.scale.of(absolute, start, end);
            let error = weighted(slopes, &E);
            for lane in 0..WIDTH {
                let share = error[lane] / scale[lane];
                sum[lane] += share * share;
            }
        }
        let sum: f64 = sum.iter().sum();
        trial.span.length.abs() * (sum / self.dimension as f64).sqrt()
    }
}
