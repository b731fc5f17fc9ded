//! The implicit Radau IIA method of order 5 with three stages, for stiff systems.
//!
//! E. Hairer, G. Wanner, *Solving Ordinary Differential Equations II*, 2nd ed. (1996), section
//! IV.8: simplified Newton's method on the stage increments, taken apart into one real system and
//! one pair; embedded error estimate of order 3 filtered by the real one; step control with the
//! trend of the errors (Gustafsson); dense output by the collocation polynomial, of order 3 inside
//! the step. The method is stable for all decaying motions and damps the fastest entirely.
//!
//! Since the error is estimated with an order far below that of the method, the tolerance `r` of the
//! settings counts here as `0.1 r^(2/3)`, relative and absolute in the same ratio: that brings the
//! true errors near `r` (section IV.8). A Jacobian serves as long as Newton's method converges fast,
//! the factors as long as the step length stays.
//!
//! `constants` holds the numbers, `newton` solves the equations, `collocation` is the method.

mod collocation;
mod constants;
mod newton;

use super::integrator::Integrator;

/// An integration by the implicit method of order 5, of a [`super::Differentiated`] system.
pub type Radau5<S> = Integrator<S, collocation::Collocation>;
