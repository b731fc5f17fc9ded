//! Systems with their whole Jacobian, which implicit methods need.

use super::{Linearised, System};
use crate::dense::Matrix;

/// A system that knows its Jacobian.
pub trait Differentiated: System {
    /// Writes `∂f/∂y(t, state)` to every entry of `out`, a square matrix of the system's dimension.
    ///
    /// An inexact Jacobian slows an implicit method down but does not spoil its results.
    fn jacobian(&mut self, t: f64, state: &[f64], out: &mut Matrix);
}

impl<S: Differentiated + ?Sized> Differentiated for &mut S {
    fn jacobian(&mut self, t: f64, state: &[f64], out: &mut Matrix) {
        (**self).jacobian(t, state, out);
    }
}

/// A system whose Jacobian is made of its products with the unit vectors.
#[derive(Debug, Clone)]
pub struct ByColumns<S> {
    system: S,
    direction: Vec<f64>,
    column: Vec<f64>,
}

impl<S: Linearised> ByColumns<S> {
    /// The same system with its Jacobian.
    pub fn new(system: S) -> Self {
        let zeros = vec![0.0; system.dimension()];
        Self { system, direction: zeros.clone(), column: zeros }
    }

    /// Gives the system back.
    pub fn into_inner(self) -> S {
        self.system
    }
}

impl<S: System> System for ByColumns<S> {
    fn dimension(&self) -> usize {
        self.system.dimension()
    }

    #[inline]
    fn derivative(&mut self, t: f64, state: &[f64], rate: &mut [f64]) {
        self.system.derivative(t, state, rate);
    }
}

impl<S: Linearised> Differentiated for ByColumns<S> {
    fn jacobian(&mut self, t: f64, state: &[f64], out: &mut Matrix) {
        for k in 0..state.len() {
            self.direction[k] = 1.0;
            self.system.linearised(t, state, &self.direction, &mut self.column);
            self.direction[k] = 0.0;
            write_column(out, k, &self.column);
        }
    }
}

/// A system whose Jacobian is made of forward differences: one evaluation for each component and
/// one more.
#[derive(Debug, Clone)]
pub struct ByDifferences<S> {
    system: S,
    moved: Vec<f64>,
    here: Vec<f64>,
    there: Vec<f64>,
}

/// Size of a component below which it is moved no less: Hairer & Wanner II, section IV.8.
const SMALLEST_SIZE: f64 = 1e-5;

impl<S: System> ByDifferences<S> {
    /// The same system with its Jacobian.
    pub fn new(system: S) -> Self {
        let zeros = vec![0.0; system.dimension()];
        Self { system, moved: zeros.clone(), here: zeros.clone(), there: zeros }
    }

    /// Gives the system back.
    pub fn into_inner(self) -> S {
        self.system
    }
}

impl<S: System> System for ByDifferences<S> {
    fn dimension(&self) -> usize {
        self.system.dimension()
    }

    #[inline]
    fn derivative(&mut self, t: f64, state: &[f64], rate: &mut [f64]) {
        self.system.derivative(t, state, rate);
    }
}

impl<S: System> Differentiated for ByDifferences<S> {
    fn jacobian(&mut self, t: f64, state: &[f64], out: &mut Matrix) {
        self.system.derivative(t, state, &mut self.here);
        self.moved.copy_from_slice(state);
        for (k, &value) in state.iter().enumerate() {
            self.moved[k] = value + (f64::EPSILON * value.abs().max(SMALLEST_SIZE)).sqrt();
            // The difference that was really made, after rounding.
            let change = self.moved[k] - value;
            self.system.derivative(t, &self.moved, &mut self.there);
            self.moved[k] = value;
            for (there, here) in self.there.iter_mut().zip(&self.here) {
                *there = (*there - here) / change;
            }
            write_column(out, k, &self.there);
        }
    }
}

fn write_column(out: &mut Matrix, column: usize, values: &[f64]) {
    for (row, value) in values.iter().enumerate() {
        out[(row, column)] = *value;
    }
}
