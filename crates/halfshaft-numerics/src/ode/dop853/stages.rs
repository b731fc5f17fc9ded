//! The stages of one step: where the right-hand side is evaluated, and what is made of it.

use super::tableau::{
    A1, A2, A3, A4, A5, A6, A7, A8, A9, A10, A11, A13, A14, A15, B, B3, C, D4, D5, D6, D7, E5,
    STAGES, Term,
};
use crate::ode::dense_step::{Coefficients, Span};
use crate::ode::lanes::{WIDTH, groups, weighted};
use crate::ode::method::{Method, Trial};
use crate::ode::norm::ErrorScale;
use crate::ode::slopes::Slopes;
use crate::ode::{Statistics, System};

/// Last stage before the end of the step.
const BEFORE_LAST: usize = 11;
/// Stage that holds the derivative at the end of the step.
const LAST: usize = 12;
/// Right-hand sides per tried step, not counting the one at its end.
const TRIED: usize = 11;
/// Right-hand sides for the dense output.
const DENSE: usize = 3;

/// The method of Dormand and Prince of order 8.
#[derive(Debug, Clone)]
pub struct Stages {
    dimension: usize,
    slopes: Slopes<STAGES>,
}

impl<S: System> Method<S> for Stages {
    const ERROR_POWER: u32 = 8;
    const STABLE_TO: f64 = 6.1;

    fn new(dimension: usize) -> Self {
        Self { dimension, slopes: Slopes::new(dimension) }
    }

    #[inline]
    fn attempt(
        &mut self,
        system: &mut S,
        trial: &Trial<'_>,
        end: &mut [f64],
        work: &mut Statistics,
    ) -> f64 {
        self.slopes.keep(0, trial.rate);
        self.stage(system, trial.span, trial.state, 1, &A1);
        self.stage(system, trial.span, trial.state, 2, &A2);
        self.stage(system, trial.span, trial.state, 3, &A3);
        self.stage(system, trial.span, trial.state, 4, &A4);
        self.stage(system, trial.span, trial.state, 5, &A5);
        self.stage(system, trial.span, trial.state, 6, &A6);
        self.stage(system, trial.span, trial.state, 7, &A7);
        self.stage(system, trial.span, trial.state, 8, &A8);
        self.stage(system, trial.span, trial.state, 9, &A9);
        self.stage(system, trial.span, trial.state, 10, &A10);
        self.stage(system, trial.span, trial.state, BEFORE_LAST, &A11);
        work.evaluations += TRIED;
        self.slopes.advance(trial.span.length, trial.state, &B, end);
        if trial.is_controlled { self.error(trial, end) } else { 0.0 }
    }

    #[inline]
    fn end_rate(
        &mut self,
        system: &mut S,
        time: f64,
        end: &[f64],
        rate: &mut [f64],
        work: &mut Statistics,
    ) {
        system.derivative(time, &end[..self.dimension], &mut rate[..self.dimension]);
        work.evaluations += 1;
    }

    #[inline]
    fn accepted(&mut self, _: Span, rate: &[f64]) {
        self.slopes.keep(LAST, rate);
    }

    fn stiffness(&self, length: f64, end: &[f64], rate: &[f64], scale: &ErrorScale) -> f64 {
        self.slopes.stiffness(BEFORE_LAST, length, end, rate, scale)
    }

    /// Computes the three stages that only the dense output needs, then the polynomial.
    fn write_dense(
        &mut self,
        system: &mut S,
        span: Span,
        (start, end): (&[f64], &[f64]),
        coefficients: &mut [Coefficients],
        work: &mut Statistics,
    ) {
        self.stage(system, span, start, 13, &A13);
        self.stage(system, span, start, 14, &A14);
        self.stage(system, span, start, 15, &A15);
        work.evaluations += DENSE;
        self.write_coefficients(coefficients, span.length, start, end);
    }
}

impl Stages {
    #[inline(always)]
    fn stage<S: System, const N: usize>(
        &mut self,
        system: &mut S,
        span: Span,
        state: &[f64],
        stage: usize,
        row: &[Term; N],
    ) {
        self.slopes.stage(system, span, state, (stage, C[stage]), row);
    }

    /// The error of a step; accepted if at most one, NaN if not finite.
    ///
    /// With the norms `e5`, `e3` of the two estimates it is `|h| e5² / √(e5² + 0.01 e3²)`, which
    /// behaves like the power 8 of the step length (Hairer et al., section II.10).
    #[inline]
    fn error(&self, trial: &Trial<'_>, end: &[f64]) -> f64 {
        let (mut fifth, mut third) = ([0.0; WIDTH], [0.0; WIDTH]);
        let tolerances = groups(&trial.scale.absolute).iter();
        let states = groups(trial.state).iter().zip(groups(end));
        for ((slopes, (start, end)), absolute) in
            self.slopes.groups().iter().zip(states).zip(tolerances)
        {
            let scale = trial.scale.of(absolute, start, end);
            let (e5, b, b3) = (weighted(slopes, &E5), weighted(slopes, &B), weighted(slopes, &B3));
            for lane in 0..WIDTH {
                let inverse = 1.0 / scale[lane];
                let (five, three) = (e5[lane] * inverse, (b[lane] - b3[lane]) * inverse);
                fifth[lane] += five * five;
                third[lane] += three * three;
            }
        }
        let (fifth, third): (f64, f64) = (fifth.iter().sum(), third.iter().sum());
        if fifth == 0.0 {
            return 0.0;
        }
        let dimension = self.dimension as f64;
        trial.span.length.abs() * fifth / ((fifth + 0.01 * third) * dimension).sqrt()
    }

    /// Writes the polynomial of order 7 (Hairer et al., section II.6) for every group.
    fn write_coefficients(
        &self,
        coefficients: &mut [Coefficients],
        length: f64,
        start: &[f64],
        end: &[f64],
    ) {
        let states = groups(start).iter().zip(groups(end));
        for ((all, slopes), (start, end)) in
            coefficients.iter_mut().zip(self.slopes.groups()).zip(states)
        {
            let high = [
                weighted(slopes, &D4),
                weighted(slopes, &D5),
                weighted(slopes, &D6),
                weighted(slopes, &D7),
            ];
            for lane in 0..WIDTH {
                let change = end[lane] - start[lane];
                let at_start = length * slopes[0][lane] - change;
                let at_end = change - length * slopes[LAST][lane] - at_start;
                let low = [start[lane], change, at_start, at_end];
                for (k, value) in low.into_iter().enumerate() {
                    all[k][lane] = value;
                    all[k + 4][lane] = length * high[k][lane];
                }
            }
        }
    }
}
