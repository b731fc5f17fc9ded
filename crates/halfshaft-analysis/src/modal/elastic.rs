//! Undamped modes in the space of motions that are no rigid-body motion.
//!
//! With `μ = sqrt(M)` and `u` the rigid-body motion scaled by `μ` to length one, the
//! Householder reflection `H` that carries `u` to the first axis makes
//! `H M^(-1/2) K M^(-1/2) H` vanish in its first row and column. The rest is a symmetric
//! matrix without the zero eigenvalue, so the rigid-body frequency is zero by construction
//! and costs the others no digits.

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_numerics::dense::{Matrix, dot, symmetric_eigen};

use super::{chain, sparse};
use crate::error::{AnalysisError, Doing};

/// One undamped mode.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ElasticMode {
    /// Square of the natural frequency, s⁻²; negative where the equilibrium is unstable.
    pub(crate) eigenvalue: f64,
    /// Motion of each group with `φᵀ M φ = 1`.
    pub(crate) shape: Vec<f64>,
    /// Twist of each connection in the same scale.
    pub(crate) twists: Vec<f64>,
}

/// Degrees of freedom up to which all modes are computed where nobody says how many.
pub(crate) const ALL_UP_TO: usize = 400;

/// Undamped natural frequencies about given twists, ascending, rad/s; 0 where an equilibrium is unstable.
pub(crate) fn natural_frequencies(
    equations: &EquationsOfMotion,
    twists: &[f64],
) -> Result<Vec<f64>, AnalysisError> {
    if !is_special(equations)
        && let Some(values) = chain::eigenvalues(equations, twists)
    {
        return Ok(values.iter().map(|value| value.sqrt()).collect());
    }
    let modes = lowest_modes(equations, twists, sparse::elastic_count(equations))?;
    Ok(modes.iter().map(ElasticMode::frequency).collect())
}

/// Massless nodes, and bars with consistent inertia, are for the sparse solver alone.
fn is_special(equations: &EquationsOfMotion) -> bool {
    equations.massless().is_some()
        || equations.connections.iter().any(|connection| connection.inertance != 0.0)
}

/// The lowest `count` elastic modes about given twists, ascending.
pub(crate) fn lowest_modes(
    equations: &EquationsOfMotion,
    twists: &[f64],
    count: usize,
) -> Result<Vec<ElasticMode>, AnalysisError> {
    // A dense problem is solved whole, a long line by as many vectors as are wanted.
    if is_special(equations) || equations.groups() > ALL_UP_TO {
        return sparse::lowest(equations, twists, count);
    }
    if let Some(modes) = chain::lowest(equations, twists, count) {
        return Ok(modes);
    }
    let mut modes = ElasticSpace::new(equations).modes(equations, twists)?;
    modes.truncate(count);
    Ok(modes)
}

impl ElasticMode {
    /// Natural frequency, rad/s; 0 where the equilibrium is unstable in it.
    pub(crate) fn frequency(&self) -> f64 {
        self.eigenvalue.max(0.0).sqrt()
    }
}

/// The motions of a line that are orthogonal to its rigid-body motion.
pub(crate) struct ElasticSpace {
    root_inertia: Vec<f64>,
    /// Householder vector of length `sqrt(2)`: `H = 1 - h hᵀ`; `None` for a line at ground.
    reflection: Option<Vec<f64>>,
}

impl ElasticSpace {
    /// The elastic motions of a line.
    pub(crate) fn new(equations: &EquationsOfMotion) -> Self {
        let root_inertia: Vec<f64> = equations.inertia.iter().map(|m| m.sqrt()).collect();
        let reflection = equations.rigid.as_ref().map(|rigid| {
            let length = rigid.inertia.sqrt();
            let unit: Vec<f64> =
                root_inertia.iter().zip(&rigid.speeds).map(|(m, r)| m * r / length).collect();
            householder(unit)
        });
        Self { root_inertia, reflection }
    }

    /// Undamped modes about given twists, by ascending eigenvalue.
    pub(crate) fn modes(
        &self,
        equations: &EquationsOfMotion,
        twists: &[f64],
    ) -> Result<Vec<ElasticMode>, AnalysisError> {
        let matrix = self.reduced(&equations.tangent_stiffness(twists));
        let eigen = symmetric_eigen(&matrix).doing("computing natural frequencies")?;
        let mode = |(index, eigenvalue): (usize, &f64)| {
            let shape = self.shape(&eigen.vectors.column(index));
            let twists = (0..equations.connections.len())
                .map(|connection| equations.twist(connection, &shape))
                .collect();
            ElasticMode { eigenvalue: *eigenvalue, shape, twists }
        };
        Ok(zeros_told(eigen.values).iter().enumerate().map(mode).collect())
    }

    /// `M^(-1/2) matrix M^(-1/2)` without the rigid-body motion.
    fn reduced(&self, matrix: &Matrix) -> Matrix {
        let n = self.root_inertia.len();
        let mut scaled = Matrix::from_fn(n, n, |row, column| {
            matrix[(row, column)] / (self.root_inertia[row] * self.root_inertia[column])
        });
        let Some(h) = &self.reflection else { return scaled };
        // H A H = A - h wᵀ - w hᵀ with p = A h and w = p - (hᵀ p / 2) h.
        let p: Vec<f64> = (0..n).map(|row| dot(scaled.row(row), h)).collect();
        let half = dot(h, &p) / 2.0;
        let w: Vec<f64> = p.iter().zip(h).map(|(p, h)| p - half * h).collect();
        for row in 0..n {
            for column in 0..n {
                scaled[(row, column)] -= h[row] * w[column] + w[row] * h[column];
            }
        }
        Matrix::from_fn(n - 1, n - 1, |row, column| scaled[(row + 1, column + 1)])
    }

    /// Group motion of a vector of the reduced space.
    fn shape(&self, reduced: &[f64]) -> Vec<f64> {
        let mut scaled = reduced.to_vec();
        if let Some(h) = &self.reflection {
            scaled.insert(0, 0.0);
            let along = dot(h, &scaled);
            for (value, h) in scaled.iter_mut().zip(h) {
                *value -= along * h;
            }
        }
        scaled.iter().zip(&self.root_inertia).map(|(value, m)| value / m).collect()
    }
}

/// Eigenvalues with those at zero that are only not zero by rounding: free play has no stiffness.
fn zeros_told(mut values: Vec<f64>) -> Vec<f64> {
    let largest = values.iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
    #[expect(clippy::cast_precision_loss, reason = "a size")]
    let rounding = 4.0 * f64::EPSILON * values.len() as f64 * largest;
    values.iter_mut().filter(|value| value.abs() <= rounding).for_each(|value| *value = 0.0);
    values
}

/// Vector `h` with `(1 - h hᵀ) unit` along the first axis.
fn householder(mut unit: Vec<f64>) -> Vec<f64> {
    // Adding with equal signs avoids cancellation; then |unit ± e1|² = 2 (1 + |unit_1|).
    let first = unit[0];
    unit[0] += if first < 0.0 { -1.0 } else { 1.0 };
    let length = (1.0 + first.abs()).sqrt();
    unit.iter_mut().for_each(|value| *value /= length);
    unit
}
