//! The stage derivatives of an explicit step, with the space to compute them in.

use super::System;
use super::dense_step::Span;
use super::lanes::{Lanes, Term, WIDTH, advanced, groups, groups_mut, padded, weighted};
use super::norm::ErrorScale;

/// The derivatives at all stages of a step, group by group.
#[derive(Debug, Clone)]
pub(super) struct Slopes<const STAGES: usize> {
    dimension: usize,
    slopes: Vec<[Lanes; STAGES]>,
    argument: Vec<f64>,
    rate: Vec<f64>,
}

impl<const STAGES: usize> Slopes<STAGES> {
    pub(super) fn new(dimension: usize) -> Self {
        let length = padded(dimension);
        Self {
            dimension,
            slopes: vec![[Lanes::default(); STAGES]; length / WIDTH],
            argument: vec![0.0; length],
            rate: vec![0.0; length],
        }
    }

    /// The derivatives, group by group.
    #[inline(always)]
    pub(super) fn groups(&self) -> &[[Lanes; STAGES]] {
        &self.slopes
    }

    /// Keeps a derivative that is already known.
    #[inline(always)]
    pub(super) fn keep(&mut self, stage: usize, rate: &[f64]) {
        for (slopes, rate) in self.slopes.iter_mut().zip(groups(rate)) {
            slopes[stage] = *rate;
        }
    }

    /// Writes one of the derivatives out.
    #[inline(always)]
    pub(super) fn write(&self, stage: usize, rate: &mut [f64]) {
        for (rate, slopes) in groups_mut(rate).iter_mut().zip(&self.slopes) {
            *rate = slopes[stage];
        }
    }

    /// Evaluates the right-hand side where a row of the tableau says, and keeps it. The state is
    /// padded.
    #[inline(always)]
    pub(super) fn stage<S: System, const N: usize>(
        &mut self,
        system: &mut S,
        span: Span,
        state: &[f64],
        (stage, node): (usize, f64),
        row: &[Term; N],
    ) {
        let arguments = groups_mut(&mut self.argument).iter_mut();
        for ((argument, start), slopes) in arguments.zip(groups(state)).zip(&self.slopes) {
            *argument = advanced(start, span.length, &weighted(slopes, row));
        }
        let time = span.start + node * span.length;
        let (argument, rate) = (&self.argument[..self.dimension], &mut self.rate[..self.dimension]);
        system.derivative(time, argument, rate);
        for (slopes, rate) in self.slopes.iter_mut().zip(groups(&self.rate)) {
            slopes[stage] = *rate;
        }
    }

    /// Writes the state at the end of the step. Both states are padded.
    #[inline(always)]
    pub(super) fn advance<const N: usize>(
        &self,
        length: f64,
        state: &[f64],
        row: &[Term; N],
        end: &mut [f64],
    ) {
        for ((end, start), slopes) in
            groups_mut(end).iter_mut().zip(groups(state)).zip(&self.slopes)
        {
            *end = advanced(start, length, &weighted(slopes, row));
        }
    }

    /// `|h| |f(end) - f(last)| / |end - last|`, where `last` is the argument of the stage computed
    /// last: about `|h λ|` for the eigenvalue λ of largest modulus if that dominates what sets the
    /// two arguments apart (Hairer & Wanner II, section IV.2).
    ///
    /// A component counts in units of what it is and does in a step. Without units an oscillation
    /// of frequency ω, whose speeds exceed its displacements by ω, would seem to have λ = ω².
    pub(super) fn stiffness(
        &self,
        stage: usize,
        length: f64,
        end: &[f64],
        rate: &[f64],
        scale: &ErrorScale,
    ) -> f64 {
        let (mut rates, mut states) = (0.0, 0.0);
        for component in 0..self.dimension {
            let (y, f) = (end[component], rate[component]);
            let unit = scale.absolute[component] + y.abs() + (length * f).abs();
            let slope = self.slopes[component / WIDTH][stage][component % WIDTH];
            let (of_rate, of_state) = ((f - slope) / unit, (y - self.argument[component]) / unit);
            rates += of_rate * of_rate;
            states += of_state * of_state;
        }
        if states > 0.0 { length.abs() * (rates / states).sqrt() } else { 0.0 }
    }
}
