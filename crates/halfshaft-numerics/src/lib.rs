//! Mathematics of nonlinear oscillations that knows no driveline.
//!
//! Everything here speaks of numbers, functions and systems of equations; angles, torques and files
//! belong to the crates above. Nothing prints, nothing but [`ensemble`] starts threads, and nothing
//! reachable from input panics. The tour, from one unknown to periodic orbits:
//!
//! # One unknown
//!
//! [`polynomial`] finds *all* real roots of a polynomial, with the count certified by signs, also
//! when coefficients differ by a hundred powers of ten. [`bracket`] closes in on a root or a
//! minimum of any function on an interval.
//!
//! # Several unknowns
//!
//! [`dense`] holds the matrix type, linear systems and eigenvalues. [`newton`] solves small systems
//! of nonlinear equations, damped, and tells its whole history. [`pencil`] finds the lowest eigenvalues
//! of large symmetric systems on a graph.
//!
//! # Time
//!
//! [`ode`] integrates `y' = f(t, y)` by explicit methods of order 8 and 5, and by an implicit one for
//! stiff systems, all with dense output and through break times. [`ode::periodic`] finds periodic orbits with their Floquet multipliers.
//! [`ensemble`] runs thousands of trajectories side by side in vector registers and on all cores.
//!
//! # Periodic signals
//!
//! [`fourier`] takes harmonics, and extremes between the samples, from one sampled period.
//! [`harmonics`] holds truncated series and their products, for harmonic balance, and [`blocks`] the
//! bordered block systems that it leads to.
//!
//! # Conventions
//!
//! - The numbers of an algorithm stand in one settings struct, each with its meaning and default.
//! - [`Error`] means that nothing usable was produced. An iteration that ended early returns what
//!   it reached, with the reason.
//! - [`observer::Observer`] is how long computations, here and in the crates above, report progress
//!   and learn that they should end.

pub mod blocks;
pub mod bracket;
pub mod chain;
mod complex;
pub mod dense;
pub mod ensemble;
mod error;
pub mod fourier;
pub mod harmonics;
pub mod newton;
pub mod observer;
pub mod ode;
pub mod pencil;
pub mod polynomial;
mod small_list;

pub use complex::Complex;
pub use error::Error;
