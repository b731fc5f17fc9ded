//! A system together with its linearisation about the solution.

use super::{Linearised, Settings, System, Tolerance};
use crate::dense::Matrix;

/// The variational equation `Φ' = ∂f/∂y(t, y) Φ` beside `y' = f(t, y)`.
///
/// The state holds `y`, then the columns of `Φ` one after the other: `n + n²` numbers for a system
/// of dimension `n`. Started from the identity, `Φ` is the derivative of the solution with respect
/// to its initial state.
#[derive(Debug)]
pub struct Variational<'a, S> {
    system: &'a mut S,
}

impl<'a, S: Linearised> Variational<'a, S> {
    /// The variational equation of a system.
    pub fn new(system: &'a mut S) -> Self {
        Self { system }
    }

    /// The initial state `(y0, identity)`.
    pub fn initial_state(y0: &[f64]) -> Vec<f64> {
        let n = y0.len();
        let mut state = y0.to_vec();
        state.resize(n + n * n, 0.0);
        (0..n).for_each(|k| state[n + k * n + k] = 1.0);
        state
    }

    /// The settings of the plain system with tolerances for the entries of `Φ` added.
    ///
    /// `Φ_ij` has the unit of `y_i` over that of `y_j`, so its absolute tolerance is the relative
    /// one times the ratio of the two components' absolute tolerances.
    pub fn settings(plain: &Settings, dimension: usize) -> Settings {
        let of = |component| plain.absolute_tolerance.of(component);
        let mut tolerances: Vec<f64> = (0..dimension).map(of).collect();
        let entry = plain.relative_tolerance.max(f64::EPSILON);
        for column in 0..dimension {
            tolerances.extend((0..dimension).map(|row| entry * of(row) / of(column)));
        }
        Settings { absolute_tolerance: Tolerance::PerComponent(tolerances), ..plain.clone() }
    }

    /// The matrix `Φ` in a state of the variational equation of a system of the given dimension.
    /// Panics, like any index, if the state is too short.
    pub fn matrix(state: &[f64], dimension: usize) -> Matrix {
        Matrix::from_fn(dimension, dimension, |row, column| {
            state[dimension + column * dimension + row]
        })
    }
}

impl<S: Linearised> System for Variational<'_, S> {
    fn dimension(&self) -> usize {
        let n = self.system.dimension();
        n + n * n
    }

    fn derivative(&mut self, t: f64, state: &[f64], rate: &mut [f64]) {
        let n = self.system.dimension();
        let (y, columns) = state.split_at(n);
        let (y_rate, column_rates) = rate.split_at_mut(n);
        self.system.derivative(t, y, y_rate);
        for (column, out) in columns.chunks_exact(n).zip(column_rates.chunks_exact_mut(n)) {
            self.system.linearised(t, y, column, out);
        }
    }
}
