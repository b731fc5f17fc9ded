//! A step of the method: its matrices, its error, its polynomial.

use super::constants::Constants;
use super::newton::{Ending, Factors, MOST, Stages};
use crate::dense::Matrix;
use crate::ode::dense_step::{Coefficients, Span};
use crate::ode::lanes::{WIDTH, padded};
use crate::ode::method::{Method, Trial};
use crate::ode::norm::ErrorScale;
use crate::ode::{Differentiated, Settings, Statistics};

/// Contraction up to which the Jacobian serves for the next step as well.
const FAST: f64 = 1e-3;
/// An error is taken for no less than this, so that rounding makes no steps.
const LEAST_ERROR: f64 = 1e-10;

/// The Radau IIA method with three stages.
#[derive(Debug, Clone)]
pub struct Collocation {
    dimension: usize,
    constants: Constants,
    jacobian: Matrix,
    /// Whether the Jacobian may be used, and whether it belongs to the state at the start.
    is_usable: bool,
    is_fresh: bool,
    /// Whether a step was tried since the last one was accepted.
    is_pending: bool,
    factors: Option<Factors>,
    stages: Stages,
    /// The last accepted step: its length and its polynomial `s (c1 + (1-s) (c2 + s c3))`.
    last: Option<f64>,
    polynomial: [Vec<f64>; 3],
    /// The error, padded, with space to compute it.
    error: Vec<f64>,
    defect: Vec<f64>,
    argument: Vec<f64>,
}

impl<S: Differentiated> Method<S> for Collocation {
    const ERROR_POWER: u32 = 4;
    const PREDICTIVE: bool = true;

    fn new(dimension: usize) -> Self {
        let zeros = vec![0.0; dimension];
        Self {
            dimension,
            constants: Constants::new(),
            jacobian: Matrix::zeros(dimension, dimension),
            is_usable: false,
            is_fresh: false,
            is_pending: false,
            factors: None,
            stages: Stages::new(dimension),
            last: None,
            polynomial: std::array::from_fn(|_| zeros.clone()),
            error: vec![0.0; padded(dimension)],
            defect: zeros.clone(),
            argument: zeros,
        }
    }

    fn scale(settings: &Settings, dimension: usize) -> ErrorScale {
        let weaker = |tolerance: f64| 0.1 * tolerance.cbrt().powi(2);
        let asked = settings.relative_tolerance;
        let relative = weaker(asked);
        let absolute: Vec<f64> = (0..dimension)
            .map(|component| {
                let value = settings.absolute_tolerance.of(component);
                if asked > 0.0 { relative * (value / asked) } else { weaker(value) }
            })
            .collect();
        ErrorScale::new(relative, &absolute)
    }

    fn attempt(
        &mut self,
        system: &mut S,
        trial: &Trial<'_>,
        end: &mut [f64],
        work: &mut Statistics,
    ) -> f64 {
        if self.is_pending && !self.is_fresh {
            self.is_usable = false;
        }
        self.is_pending = true;
        loop {
            self.prepare(system, trial, work);
            self.predict(trial.span.length);
            let Some(factors) = &self.factors else { return f64::INFINITY };
            match self.stages.solve(system, &self.constants, factors, trial, work) {
                Ending::Converged => break,
                Ending::NonFinite => return f64::NAN,
                Ending::TooSlow if self.is_fresh => return f64::INFINITY,
                Ending::TooSlow => self.is_usable = false,
            }
        }
        let states = trial.state.iter().zip(&self.stages.increments[2]);
        for (end, (state, increment)) in end.iter_mut().zip(states) {
            *end = state + increment;
        }
        if trial.is_controlled { self.estimate(system, trial, work) } else { 0.0 }
    }

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

    fn accepted(&mut self, span: Span, _: &[f64]) {
        self.is_pending = false;
        self.is_fresh = false;
        self.is_usable = self.stages.contraction <= FAST;
        self.last = Some(span.length);
        let [first, second, _] = self.constants.nodes;
        let [a, b, change] = &self.stages.increments;
        let [c1, c2, c3] = &mut self.polynomial;
        for i in 0..self.dimension {
            let inner = |z: f64, node: f64| (z / node - change[i]) / (1.0 - node);
            let (p, q) = (inner(a[i], first), inner(b[i], second));
            c1[i] = change[i];
            c3[i] = (q - p) / (second - first);
            c2[i] = p - first * c3[i];
        }
    }

    /// Each iteration beyond the first makes the next step a little shorter.
    fn strain(&self) -> f64 {
        let most = 2.0 * MOST as f64;
        ((most + self.stages.iterations as f64) / (most + 1.0)).powi(4)
    }

    fn write_dense(
        &mut self,
        _: &mut S,
        _: Span,
        (start, _): (&[f64], &[f64]),
        coefficients: &mut [Coefficients],
        _: &mut Statistics,
    ) {
        let [c1, c2, c3] = &self.polynomial;
        for i in 0..self.dimension {
            let group = &mut coefficients[i / WIDTH];
            let values = [start[i], c1[i], c2[i], c3[i], 0.0, 0.0, 0.0, 0.0];
            for (all, value) in group.iter_mut().zip(values) {
                all[i % WIDTH] = value;
            }
        }
    }

    fn forget(&mut self) {
        self.is_usable = false;
        self.is_fresh = false;
        self.is_pending = false;
        self.factors = None;
        self.last = None;
        self.stages.forget();
    }
}

impl Collocation {
    /// Makes sure of a Jacobian and of factors for the step length.
    fn prepare<S: Differentiated>(
        &mut self,
        system: &mut S,
        trial: &Trial<'_>,
        work: &mut Statistics,
    ) {
        if !self.is_usable {
            let state = &trial.state[..self.dimension];
            system.jacobian(trial.span.start, state, &mut self.jacobian);
            work.jacobians += 1;
            (self.is_usable, self.is_fresh) = (true, true);
            self.factors = None;
        }
        let length = trial.span.length;
        if self.factors.as_ref().is_none_or(|factors| factors.length != length) {
            self.factors = Factors::new(&self.constants, length, &self.jacobian);
            work.factorisations += 1;
        }
    }

    /// Starts the increments from the polynomial of the last step, prolonged; from zero without.
    fn predict(&mut self, length: f64) {
        let [c1, c2, c3] = &self.polynomial;
        for (increments, node) in self.stages.increments.iter_mut().zip(self.constants.nodes) {
            let Some(last) = self.last else {
                increments.fill(0.0);
                continue;
            };
            let s = 1.0 + node * length / last;
            for (i, increment) in increments.iter_mut().enumerate() {
                // `s (c1 + ...) - c1`, written so that little is lost for short steps.
                *increment = (s - 1.0) * (c1[i] - s * (c2[i] + s * c3[i]));
            }
        }
    }

    /// The embedded error, filtered so that decayed motions do not count; where nothing is known of
    /// the step length, filtered once more.
    fn estimate<S: Differentiated>(
        &mut self,
        system: &mut S,
        trial: &Trial<'_>,
        work: &mut Statistics,
    ) -> f64 {
        let n = self.dimension;
        let [a, b, c] = &self.stages.increments;
        let [wa, wb, wc] = self.constants.error;
        for i in 0..n {
            self.defect[i] = (wa * a[i] + wb * b[i] + wc * c[i]) / trial.span.length;
            self.error[i] = self.defect[i] + trial.rate[i];
        }
        let error = self.filtered(trial);
        if error < 1.0 || !trial.is_unsure || !error.is_finite() {
            return error;
        }
        for (argument, (state, error)) in
            self.argument.iter_mut().zip(trial.state.iter().zip(&self.error))
        {
            *argument = state + error;
        }
        system.derivative(trial.span.start, &self.argument, &mut self.error[..n]);
        work.evaluations += 1;
        for (error, defect) in self.error.iter_mut().zip(&self.defect) {
            *error += defect;
        }
        self.filtered(trial)
    }

    /// Solves for the error by the real factors; returns its size in units of the tolerance.
    fn filtered(&mut self, trial: &Trial<'_>) -> f64 {
        let Some(factors) = &self.factors else { return f64::NAN };
        if factors.real.solve_in_place(&mut self.error[..self.dimension]).is_err() {
            return f64::NAN;
        }
        let size = trial.scale.norm(&self.error, trial.state);
        if size.is_nan() { size } else { size.max(LEAST_ERROR) }
    }
}
