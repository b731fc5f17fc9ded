//! Truncated Fourier series of periodic signals, and products of such series.
//!
//! A signal over the phase `θ` is `x(θ) = a_0 + Σ_j a_j cos jθ + b_j sin jθ` with the orders `j` of a
//! [`HarmonicSet`]; its coefficients lie in one list `[a_0, a_1, b_1, ...]`. [`Sampler`] takes them to
//! samples and back (alternating frequency-time), [`add_product`] gives the matrix that multiplies a
//! series by another signal. Source: T. M. Cameron, J. H. Griffin, J. Appl. Mech. 56 (1989) 149; the
//! product matrix is the Galerkin projection of `k(θ) x(θ)` written out by the addition theorems.

mod product;
mod sampler;
mod set;

pub use product::add_product;
pub use sampler::{Sampler, Spectrum};
pub use set::HarmonicSet;
