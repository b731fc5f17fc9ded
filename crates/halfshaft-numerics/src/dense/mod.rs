//! Dense linear algebra: a plain matrix type and the few factorisations that the analyses use.
//!
//! Orders one and two have closed forms, small systems an elimination of their own; everything else
//! goes to the library `faer`, one thread, behind these functions: no other crate sees its types.
//!
//! - [`Matrix`]: row-major storage, products, transpose;
//! - [`dot`], [`solve`] and [`Lu`]: inner products, linear systems;
//! - [`symmetric_eigen`]: real eigenvalues with orthonormal vectors;
//! - [`eigenvalues`], [`eigen`]: eigenvalues of any real matrix, with or without vectors.

mod bridge;
mod general;
mod lu;
mod matrix;
mod middle;
mod small;
mod symmetric;

pub use general::{Eigen, eigen, eigenvalues};
pub use lu::{Lu, dot, solve};
pub use matrix::Matrix;
pub use symmetric::{SymmetricEigen, symmetric_eigen};

pub use crate::complex::Complex;
