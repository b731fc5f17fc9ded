//! The explicit Runge-Kutta pair of Dormand and Prince of order 8(5,3), with dense output.
//!
//! E. Hairer, S. P. Nørsett, G. Wanner, *Solving Ordinary Differential Equations I*, 2nd ed.
//! (1993): the method is that of section II.5, the error estimate and the dense output are those of
//! their program DOP853. `tableau` holds the coefficients, `stages` what is made of them.
//!
//! ```
//! use halfshaft_numerics::ode::{self, Settings, dop853::{Dop853, Step}};
//!
//! let decay = ode::function(1, |_, y: &[f64], rate: &mut [f64]| rate[0] = -y[0]);
//! let mut integrator = Dop853::new(decay, 0.0, &[1.0], Settings::default())?;
//! while integrator.step(2.0)? == Step::Advanced {}
//! assert!((integrator.state()[0] - (-2.0_f64).exp()).abs() < 1e-9);
//! # Ok::<(), halfshaft_numerics::Error>(())
//! ```

mod stages;
pub(crate) mod tableau;
#[cfg(test)]
mod tableau_tests;

use super::integrator::Integrator;
pub use super::{DenseStep, Statistics, Step};

/// An integration by the method of order 8.
pub type Dop853<S> = Integrator<S, stages::Stages>;
