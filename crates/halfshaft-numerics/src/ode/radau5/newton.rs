//! The equations of a step and their solution by a simplified Newton method.

use super::constants::{Constants, STAGES};
use crate::dense::{Lu, Matrix};
use crate::ode::lanes::{WIDTH, groups};
use crate::ode::method::Trial;
use crate::ode::{Statistics, System};

/// Most iterations.
pub(super) const MOST: usize = 7;
/// A contraction that is no faster than this is none.
const DIVERGES: f64 = 0.99;

/// How the iteration ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Ending {
    Converged,
    /// It would not converge in time.
    TooSlow,
    /// A right-hand side or a correction was not finite.
    NonFinite,
}

/// The matrices `λ/h - J` of a step, factorised: the real one and the pair as one of twice the size.
#[derive(Debug, Clone)]
pub(super) struct Factors {
    pub(super) length: f64,
    pub(super) real: Lu,
    pair: Lu,
}

impl Factors {
    /// Factorises for a step length; nothing if a matrix is singular or not finite.
    pub(super) fn new(constants: &Constants, length: f64, jacobian: &Matrix) -> Option<Self> {
        let n = jacobian.rows();
        let entry = |shift: f64, i: usize, j: usize| {
            if i == j { shift / length - jacobian[(i, j)] } else { -jacobian[(i, j)] }
        };
        let (alpha, beta) = constants.pair;
        let real = Matrix::from_fn(n, n, |i, j| entry(constants.real, i, j));
        let pair = Matrix::from_fn(2 * n, 2 * n, |i, j| match (i < n, j < n) {
            (true, true) => entry(alpha, i, j),
            (false, false) => entry(alpha, i - n, j - n),
            (true, false) => f64::from(u8::from(i + n == j)) * beta / length,
            (false, true) => -f64::from(u8::from(i == j + n)) * beta / length,
        });
        Some(Self { length, real: Lu::new(&real).ok()?, pair: Lu::new(&pair).ok()? })
    }
}

/// The unknowns of a step and the space to solve for them.
#[derive(Debug, Clone)]
pub(super) struct Stages {
    dimension: usize,
    /// Increments of the state at the stages.
    pub(super) increments: [Vec<f64>; STAGES],
    /// The same, transformed.
    unknowns: [Vec<f64>; STAGES],
    slopes: [Vec<f64>; STAGES],
    argument: Vec<f64>,
    real: Vec<f64>,
    pair: Vec<f64>,
    /// Limit of `θ / (1 - θ)` from the step before, for the first iteration.
    reach: f64,
    /// Contraction of the last iteration.
    pub(super) contraction: f64,
    pub(super) iterations: usize,
}

impl Stages {
    pub(super) fn new(dimension: usize) -> Self {
        let zeros = vec![0.0; dimension];
        let three = || std::array::from_fn(|_| zeros.clone());
        Self {
            dimension,
            increments: three(),
            unknowns: three(),
            slopes: three(),
            argument: zeros.clone(),
            real: zeros.clone(),
            pair: vec![0.0; 2 * dimension],
            reach: 1.0,
            contraction: 0.0,
            iterations: 0,
        }
    }

    pub(super) fn forget(&mut self) {
        self.reach = 1.0;
    }

    /// Solves for the increments, starting from those that are there.
    pub(super) fn solve<S: System>(
        &mut self,
        system: &mut S,
        constants: &Constants,
        factors: &Factors,
        trial: &Trial<'_>,
        work: &mut Statistics,
    ) -> Ending {
        let tolerance = tolerance(trial.scale.relative);
        transform(&constants.inverse, &self.increments, &mut self.unknowns);
        let mut reach = self.reach.max(f64::EPSILON).powf(0.8);
        self.contraction = 0.0;
        let mut before = 0.0;
        for iteration in 1..=MOST {
            self.iterations = iteration;
            self.evaluate(system, constants, trial);
            work.evaluations += STAGES;
            let size = self.correct(constants, factors, trial);
            if !size.is_finite() {
                return Ending::NonFinite;
            }
            if iteration > 1 {
                self.contraction = size / before;
                let rest = i32::try_from(MOST - iteration).unwrap_or(0);
                reach = self.contraction / (1.0 - self.contraction);
                let predicted = reach * size * self.contraction.powi(rest);
                // At the limit of rounding the corrections no longer shrink.
                if size > 0.0 && (self.contraction >= DIVERGES || predicted > tolerance) {
                    return Ending::TooSlow;
                }
            }
            before = size;
            transform(&constants.transform, &self.unknowns, &mut self.increments);
            if size == 0.0 || reach * size <= tolerance {
                self.reach = if size == 0.0 { self.reach } else { reach };
                return Ending::Converged;
            }
        }
        Ending::TooSlow
    }

    /// The derivatives at the stages.
    fn evaluate<S: System>(&mut self, system: &mut S, constants: &Constants, trial: &Trial<'_>) {
        for stage in 0..STAGES {
            let states = trial.state.iter().zip(&self.increments[stage]);
            for (argument, (state, increment)) in self.argument.iter_mut().zip(states) {
                *argument = state + increment;
            }
            let time = trial.span.start + constants.nodes[stage] * trial.span.length;
            system.derivative(time, &self.argument, &mut self.slopes[stage]);
        }
    }

    /// Corrects the unknowns; returns the size of the correction in units of the tolerance.
    fn correct(&mut self, constants: &Constants, factors: &Factors, trial: &Trial<'_>) -> f64 {
        let n = self.dimension;
        let length = trial.span.length;
        let (real, alpha, beta) =
            (constants.real / length, constants.pair.0 / length, constants.pair.1 / length);
        let inverse = &constants.inverse;
        for i in 0..n {
            let slopes = [self.slopes[0][i], self.slopes[1][i], self.slopes[2][i]];
            let [u, v, w] = [self.unknowns[0][i], self.unknowns[1][i], self.unknowns[2][i]];
            self.real[i] = product(&inverse[0], &slopes) - real * u;
            self.pair[i] = product(&inverse[1], &slopes) - (alpha * v + beta * w);
            self.pair[n + i] = product(&inverse[2], &slopes) - (alpha * w - beta * v);
        }
        let solved = factors.real.solve_in_place(&mut self.real).is_ok()
            && factors.pair.solve_in_place(&mut self.pair).is_ok();
        if !solved {
            return f64::NAN;
        }
        let mut sum = 0.0;
        let tolerances = groups(&trial.scale.absolute).iter().zip(groups(trial.state));
        for (group, (absolute, state)) in tolerances.enumerate() {
            let scale = trial.scale.of(absolute, state, state);
            for (lane, scale) in scale.iter().enumerate().take(n - group * WIDTH) {
                let i = group * WIDTH + lane;
                for (unknowns, change) in
                    self.unknowns.iter_mut().zip([self.real[i], self.pair[i], self.pair[n + i]])
                {
                    unknowns[i] += change;
                    sum += (change / scale) * (change / scale);
                }
            }
        }
        (sum / (STAGES * n) as f64).sqrt()
    }
}

/// Share of the tolerance of a step to which its equations are solved.
fn tolerance(relative: f64) -> f64 {
    let least = if relative > 0.0 { 10.0 * f64::EPSILON / relative } else { 0.0 };
    let share = if relative > 0.0 { relative.sqrt().min(0.03) } else { 1e-4 };
    least.max(share)
}

fn product(a: &[f64; STAGES], b: &[f64; STAGES]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// `to = matrix from`, component by component.
fn transform(
    matrix: &[[f64; STAGES]; STAGES],
    from: &[Vec<f64>; STAGES],
    to: &mut [Vec<f64>; STAGES],
) {
    for i in 0..from[0].len() {
        let values = [from[0][i], from[1][i], from[2][i]];
        for (row, to) in matrix.iter().zip(to.iter_mut()) {
            to[i] = product(row, &values);
        }
    }
}
