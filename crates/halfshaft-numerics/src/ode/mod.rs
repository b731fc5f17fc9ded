//! Time integration of ordinary differential equations `y' = f(t, y)`.
//!
//! - [`System`] is what can be integrated, [`Linearised`] adds its Jacobian-vector products,
//!   [`Differentiated`] the whole Jacobian;
//! - [`OneStep`] is what takes one accepted step after another, with dense output on demand:
//!   [`dop853::Dop853`] for fine and [`dopri5::Dopri5`] for coarse tolerances,
//!   [`radau5::Radau5`] for stiff systems;
//! - [`integrate`] runs any of them to an end through break times and shows every step to an
//!   observer;
//! - [`periodic`] finds periodic orbits and their Floquet multipliers by shooting.

mod access;
mod control;
mod dense_step;
mod differentiated;
pub mod dop853;
pub mod dopri5;
mod driver;
mod first_step;
mod integrator;
mod lanes;
mod method;
mod norm;
mod one_step;
pub mod periodic;
pub mod radau5;
mod retake;
mod settings;
mod slopes;
mod stiffness;
mod stop;
mod variational;

pub use dense_step::DenseStep;
pub use differentiated::{ByColumns, ByDifferences, Differentiated};
pub use driver::{AcceptedStep, Finish, integrate};
pub use integrator::Integrator;
pub use one_step::{OneStep, Statistics, Step};
pub(crate) use settings::check_tolerances;
pub use settings::{Settings, Tolerance};
pub use stop::Stop;
pub use variational::Variational;

/// A system of ordinary differential equations `y' = f(t, y)`.
pub trait System {
    /// Number of components of the state, at least one and always the same.
    fn dimension(&self) -> usize;

    /// Writes `f(t, state)` to `rate`; both slices have the system's dimension.
    ///
    /// Mutable so that a system may keep scratch space; the result must depend on `t` and `state`
    /// alone. A rate that is not finite tells the integrator that its trial step was too long.
    fn derivative(&mut self, t: f64, state: &[f64], rate: &mut [f64]);
}

/// A system that also knows its linearisation.
pub trait Linearised: System {
    /// Writes the directional derivative `∂f/∂y(t, state) direction` to `out`.
    fn linearised(&mut self, t: f64, state: &[f64], direction: &[f64], out: &mut [f64]);
}

impl<S: System + ?Sized> System for &mut S {
    fn dimension(&self) -> usize {
        (**self).dimension()
    }

    #[inline]
    fn derivative(&mut self, t: f64, state: &[f64], rate: &mut [f64]) {
        (**self).derivative(t, state, rate);
    }
}

impl<S: Linearised + ?Sized> Linearised for &mut S {
    #[inline]
    fn linearised(&mut self, t: f64, state: &[f64], direction: &[f64], out: &mut [f64]) {
        (**self).linearised(t, state, direction, out);
    }
}

/// A system given by a closure; see [`function`].
#[derive(Debug, Clone)]
pub struct Function<F> {
    dimension: usize,
    derivative: F,
}

/// The system of the given dimension whose derivative is `derivative(t, state, rate)`.
pub fn function<F: FnMut(f64, &[f64], &mut [f64])>(dimension: usize, derivative: F) -> Function<F> {
    Function { dimension, derivative }
}

impl<F: FnMut(f64, &[f64], &mut [f64])> System for Function<F> {
    fn dimension(&self) -> usize {
        self.dimension
    }

    #[inline]
    fn derivative(&mut self, t: f64, state: &[f64], rate: &mut [f64]) {
        (self.derivative)(t, state, rate);
    }
}
