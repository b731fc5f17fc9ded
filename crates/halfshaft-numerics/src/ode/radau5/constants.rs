//! The method's numbers: E. Hairer, G. Wanner, *Solving Ordinary Differential Equations II*, 2nd
//! ed. (1996), table IV.5.6 and section IV.8.

use crate::Complex;
use crate::dense::{Lu, Matrix};

/// Stages of a step.
pub(super) const STAGES: usize = 3;

/// What the equations of a step are made of.
#[derive(Debug, Clone)]
pub(super) struct Constants {
    /// Times of the stages in the step.
    pub(super) nodes: [f64; STAGES],
    /// Weights of the stage increments in the error estimate.
    pub(super) error: [f64; STAGES],
    /// The real eigenvalue of the inverse of the coefficient matrix.
    pub(super) real: f64,
    /// The complex one: real and imaginary part.
    pub(super) pair: (f64, f64),
    /// Columns: the real eigenvector, real and imaginary part of the complex one.
    pub(super) transform: [[f64; STAGES]; STAGES],
    /// The inverse of the transform.
    pub(super) inverse: [[f64; STAGES]; STAGES],
}

/// The coefficient matrix.
pub(super) fn coefficients() -> [[f64; STAGES]; STAGES] {
    let root = 6.0_f64.sqrt();
    [
        [(88.0 - 7.0 * root) / 360.0, (296.0 - 169.0 * root) / 1800.0, (-2.0 + 3.0 * root) / 225.0],
        [(296.0 + 169.0 * root) / 1800.0, (88.0 + 7.0 * root) / 360.0, (-2.0 - 3.0 * root) / 225.0],
        [(16.0 - root) / 36.0, (16.0 + root) / 36.0, 1.0 / 9.0],
    ]
}

impl Constants {
    pub(super) fn new() -> Self {
        let root = 6.0_f64.sqrt();
        let (nine, three) = (9.0_f64.cbrt(), 3.0_f64.sqrt());
        // Eigenvalues of the coefficient matrix: the roots of its characteristic polynomial.
        let real = (6.0 + nine * (nine - 1.0)) / 30.0;
        let pair =
            Complex::new((12.0 - nine * (nine - 1.0)) / 60.0, nine * (nine + 1.0) * three / 60.0);
        // The matrix is real, so of the two conjugate eigenvalues either will do; this one makes
        // the imaginary part of its inverse positive.
        let inverse_pair = Complex::from(1.0) / pair.conjugate();
        let (first, second) = (eigenvector(Complex::from(real)), eigenvector(pair.conjugate()));
        let transform = std::array::from_fn(|k| [first[k].re, second[k].re, second[k].im]);
        Self {
            nodes: [(4.0 - root) / 10.0, (4.0 + root) / 10.0, 1.0],
            error: [(-13.0 - 7.0 * root) / 3.0, (-13.0 + 7.0 * root) / 3.0, -1.0 / 3.0],
            real: 1.0 / real,
            pair: (inverse_pair.re, inverse_pair.im),
            transform,
            inverse: inverse(&transform),
        }
    }
}

/// The eigenvector of the coefficient matrix whose last entry is 1, from the first two rows.
fn eigenvector(value: Complex) -> [Complex; STAGES] {
    let [[a, b, c], [d, e, f], _] = coefficients().map(|row| row.map(Complex::from));
    let (a, e) = (a - value, e - value);
    let determinant = a * e - b * d;
    [(b * f - c * e) / determinant, (c * d - a * f) / determinant, Complex::from(1.0)]
}

/// The inverse of a matrix that is known to have one.
fn inverse(matrix: &[[f64; STAGES]; STAGES]) -> [[f64; STAGES]; STAGES] {
    let mut result = [[0.0; STAGES]; STAGES];
    let Ok(lu) = Lu::new(&Matrix::from_rows(*matrix)) else { return result };
    for column in 0..STAGES {
        let mut unit = [0.0; STAGES];
        unit[column] = 1.0;
        if lu.solve_in_place(&mut unit).is_ok() {
            (0..STAGES).for_each(|row| result[row][column] = unit[row]);
        }
    }
    result
}

#[cfg(test)]
mod tests {
    use super::{Constants, STAGES, coefficients};

    /// Source of truth: collocation, `Σ_j a_ij c_j^(k-1) = c_i^k / k` for k = 1..3, at the Radau
    /// nodes (Hairer & Wanner II, section IV.5).
    #[test]
    fn the_coefficients_are_those_of_collocation() {
        let nodes = Constants::new().nodes;
        for (row, node) in coefficients().iter().zip(nodes) {
            for k in 1..=3 {
                let sum: f64 = row.iter().zip(nodes).map(|(a, c)| a * c.powi(k - 1)).sum();
                assert!((sum - node.powi(k) / f64::from(k)).abs() < 1e-15);
            }
        }
    }

    /// Source of truth: `A T Λ = T` with the block diagonal Λ of the inverse, and `T⁻¹ T = 1`.
    #[test]
    fn the_transform_takes_the_matrix_to_blocks() {
        let Constants { real, pair: (alpha, beta), transform, inverse, .. } = Constants::new();
        let blocks = [[real, 0.0, 0.0], [0.0, alpha, beta], [0.0, -beta, alpha]];
        let product = |a: &[[f64; STAGES]; STAGES], b: &[[f64; STAGES]; STAGES]| {
            std::array::from_fn::<[f64; STAGES], STAGES, _>(|i| {
                std::array::from_fn(|j| (0..STAGES).map(|k| a[i][k] * b[k][j]).sum())
            })
        };
        let back = product(&product(&coefficients(), &transform), &blocks);
        let identity = product(&inverse, &transform);
        for i in 0..STAGES {
            for j in 0..STAGES {
                assert!((back[i][j] - transform[i][j]).abs() < 1e-14, "{back:?}");
                let unit = f64::from(u8::from(i == j));
                assert!((identity[i][j] - unit).abs() < 1e-14, "{identity:?}");
            }
        }
    }
}
