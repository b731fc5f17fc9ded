//! The stages of one step: where the right-hand side is evaluated, and what is made of it.

use super::lanes::{Slopes, WIDTH, advanced, groups, groups_mut, padded, weighted};
use super::tableau::{A1, A2, A3, A4, A5, A6, A7, A8, A9, A10, A11, A13, A14, A15, B, C, Term};
use crate::ode::System;

/// Stage that holds the derivative at the end of the step.
const LAST: usize = 12;

/// The stage derivatives of a step, with the space to compute them in.
#[derive(Debug, Clone)]
pub(super) struct Stages {
    dimension: usize,
    slopes: Vec<Slopes>,
    argument: Vec<f64>,
    rate: Vec<f64>,
}

/// The start and the length of a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Span {
    pub(super) start: f64,
    pub(super) length: f64,
}

impl Stages {
    /// Right-hand sides per tried step, not counting the one at its end.
    pub(super) const TRIED: usize = 11;
    /// Right-hand sides for the dense output.
    pub(super) const DENSE: usize = 3;

    pub(super) fn new(dimension: usize) -> Self {
        let length = padded(dimension);
        Self {
            dimension,
            slopes: vec![Slopes::default(); length / WIDTH],
            argument: vec![0.0; length],
            rate: vec![0.0; length],
        }
    }

    /// The stage derivatives, group by group.
    pub(super) fn slopes(&self) -> &[Slopes] {
        &self.slopes
    }

    /// Computes stages 1 to 11 from `state` and its derivative `rate`, then the state of order 8 at
    /// the end. All vectors are padded.
    #[inline]
    pub(super) fn run<S: System>(
        &mut self,
        system: &mut S,
        span: Span,
        state: &[f64],
        rate: &[f64],
        end: &mut [f64],
    ) {
        self.keep(0, rate);
        self.stage(system, span, state, 1, &A1);
        self.stage(system, span, state, 2, &A2);
        self.stage(system, span, state, 3, &A3);
        self.stage(system, span, state, 4, &A4);
        self.stage(system, span, state, 5, &A5);
        self.stage(system, span, state, 6, &A6);
        self.stage(system, span, state, 7, &A7);
        self.stage(system, span, state, 8, &A8);
        self.stage(system, span, state, 9, &A9);
        self.stage(system, span, state, 10, &A10);
        self.stage(system, span, state, 11, &A11);
        for ((end, start), slopes) in
            groups_mut(end).iter_mut().zip(groups(state)).zip(&self.slopes)
        {
            *end = advanced(start, span.length, &weighted(slopes, &B));
        }
    }

    /// Keeps the derivative at the end of an accepted step for the dense output.
    pub(super) fn keep_last(&mut self, rate: &[f64]) {
        self.keep(LAST, rate);
    }

    /// Computes the three stages that only the dense output needs.
    pub(super) fn run_dense<S: System>(&mut self, system: &mut S, span: Span, state: &[f64]) {
        self.stage(system, span, state, 13, &A13);
        self.stage(system, span, state, 14, &A14);
        self.stage(system, span, state, 15, &A15);
    }

    fn keep(&mut self, stage: usize, rate: &[f64]) {
        for (slopes, rate) in self.slopes.iter_mut().zip(groups(rate)) {
            slopes[stage] = *rate;
        }
    }

    /// Evaluates the right-hand side where a row of the tableau says, and keeps it.
    #[inline(always)]
    fn stage<S: System, const N: usize>(
        &mut self,
        system: &mut S,
        span: Span,
        state: &[f64],
        stage: usize,
        row: &[Term; N],
    ) {
        let arguments = groups_mut(&mut self.argument).iter_mut();
        for ((argument, start), slopes) in arguments.zip(groups(state)).zip(&self.slopes) {
            *argument = advanced(start, span.length, &weighted(slopes, row));
        }
        let time = span.start + C[stage] * span.length;
        let (argument, rate) = (&self.argument[..self.dimension], &mut self.rate[..self.dimension]);
        system.derivative(time, argument, rate);
        for (slopes, rate) in self.slopes.iter_mut().zip(groups(&self.rate)) {
            slopes[stage] = *rate;
        }
    }
}
