//! Eigenvalues of symmetric matrices.

use super::bridge;
use super::matrix::Matrix;
use crate::error::{Error, all_finite};

/// Eigenvalues and orthonormal eigenvectors of a symmetric matrix.
#[derive(Debug, Clone, PartialEq)]
pub struct SymmetricEigen {
    /// The eigenvalues, ascending.
    pub values: Vec<f64>,
    /// The eigenvectors in the columns, in the order of the values, orthonormal.
    pub vectors: Matrix,
}

/// Eigenvalues and eigenvectors of a symmetric matrix, of which only the lower triangle is read.
///
/// # Errors
///
/// [`Error::NotSquare`], [`Error::NonFinite`], or [`Error::EigenvaluesNotConverged`].
pub fn symmetric_eigen(matrix: &Matrix) -> Result<SymmetricEigen, Error> {
    matrix.order("symmetric eigenvalues")?;
    all_finite("matrix entry", matrix.as_slice())?;
    match *matrix.as_slice() {
        [] => Ok(SymmetricEigen { values: Vec::new(), vectors: Matrix::zeros(0, 0) }),
        [a] => Ok(SymmetricEigen { values: vec![a], vectors: Matrix::identity(1) }),
        [a, _, b, d] => Ok(two_by_two(a, b, d)),
        _ => {
            let (values, vectors) = bridge::symmetric(matrix)?;
            Ok(SymmetricEigen { values, vectors })
        }
    }
}

/// One Jacobi rotation diagonalises `[[a, b], [b, d]]`: `t = tan φ` is the smaller root of
/// `t² + 2 θ t - 1 = 0` with `θ = (d - a) / (2 b)` (Golub & Van Loan, *Matrix Computations*, 8.5).
fn two_by_two(a: f64, b: f64, d: f64) -> SymmetricEigen {
    let tangent = if b == 0.0 {
        0.0
    } else {
        let theta = 0.5 * d / b - 0.5 * a / b;
        1.0_f64.copysign(theta) / (theta.abs() + theta.hypot(1.0))
    };
    let cos = 1.0 / tangent.hypot(1.0);
    let sin = tangent * cos;
    let (first, second) = (a - tangent * b, d + tangent * b);
    // Columns (cos, -sin) and (sin, cos) belong to `first` and `second`.
    if first <= second {
        SymmetricEigen {
            values: vec![first, second],
            vectors: Matrix::from_rows([[cos, sin], [-sin, cos]]),
        }
    } else {
        SymmetricEigen {
            values: vec![second, first],
            vectors: Matrix::from_rows([[sin, cos], [cos, -sin]]),
        }
    }
}
