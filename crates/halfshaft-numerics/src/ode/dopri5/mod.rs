//! The explicit Runge-Kutta pair of Dormand and Prince of order 5(4), with dense output of order 4.
//!
//! E. Hairer, S. P. Nørsett, G. Wanner, *Solving Ordinary Differential Equations I*, 2nd ed.
//! (1993), sections II.5 and II.6. Six evaluations a step: for coarse tolerances, and for motions
//! interrupted so often that the long steps of [`super::dop853`] do not pay.

mod stages;
mod tableau;
#[cfg(test)]
mod tableau_tests;

use super::integrator::Integrator;

/// An integration by the method of order 5.
pub type Dopri5<S> = Integrator<S, stages::Stages>;
