//! Damped eigenvalues, two for each undamped mode.
//!
//! In modal coordinates `η'' + Γ η' + Λ η = 0` with `Γ = Φᵀ C Φ`. Where `Γ` is diagonal every
//! mode is a quadratic of its own. Else the first-order matrix gives the eigenvalues, and each
//! is given to the mode that moves most in its eigenvector. Where only the lowest modes are known, what
//! couples them to the others is made up for by inverse iteration ([`super::refined`]). Modal damping
//! and loss factors add `2 ζ ω` and `η ω` to each mode.

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_numerics::Complex;
use halfshaft_numerics::dense::{Matrix, eigen};

use super::elastic::ElasticMode;
use super::refined::refined;
use super::sparse::{elastic_count, rigid_shape};
use crate::error::{AnalysisError, Doing};

/// Damped eigenvalues of the modes, and of the rigid-body motion where there is one.
pub(crate) struct DampedPairs {
    pub(crate) elastic: Vec<[Complex; 2]>,
    pub(crate) rigid: Option<[Complex; 2]>,
}

/// Coupling below this part of the diagonal counts as none: it moves an eigenvalue by its square.
const UNCOUPLED: f64 = 1e-10;

/// Damped eigenvalues of a line about an equilibrium whose undamped modes are given: all of them, or
/// the lowest.
pub(crate) fn damped(
    equations: &EquationsOfMotion,
    modes: &[ElasticMode],
    twists: &[f64],
) -> Result<DampedPairs, AnalysisError> {
    let rigid = rigid_shape(equations);
    let modal = projected(equations, modes, twists, rigid.as_deref());
    let mut pairs = if is_diagonal(&modal) {
        let pair = |index: usize, stiffness: f64| quadratic(modal[(index, index)], stiffness);
        DampedPairs {
            elastic: modes.iter().enumerate().map(|(i, m)| pair(i, m.eigenvalue)).collect(),
            rigid: rigid.map(|_| pair(modes.len(), 0.0)),
        }
    } else {
        coupled(&modal, modes, rigid.is_some())?
    };
    if modes.len() < elastic_count(equations) || equations.massless().is_some() {
        // Damping couples to the modes that are left out as well, and moves massless nodes.
        refined(equations, twists, modes, &mut pairs.elastic);
    }
    for (mode, pair) in modes.iter().zip(&mut pairs.elastic) {
        let ratio = equations.modal_damping + loss(equations, mode, twists) / 2.0;
        if ratio > 0.0 {
            let further = 2.0 * ratio * mode.frequency();
            *pair = quadratic(further - (pair[0] + pair[1]).re, (pair[0] * pair[1]).re);
        }
    }
    Ok(pairs)
}

/// Loss factor of a mode: those of the connections by their shares of the strain energy.
pub(crate) fn loss(equations: &EquationsOfMotion, mode: &ElasticMode, twists: &[f64]) -> f64 {
    if mode.eigenvalue <= 0.0 {
        return 0.0;
    }
    let connections = equations.connections.iter().zip(twists).zip(&mode.twists);
    let lost: f64 = connections
        .filter(|((connection, _), _)| connection.loss_factor > 0.0)
        .map(|((connection, x), twist)| {
            connection.loss_factor * connection.law.stiffness(*x) * twist * twist
        })
        .sum();
    lost / mode.eigenvalue
}

/// `Φᵀ C Φ` over the elastic modes and, last, the rigid-body motion.
fn projected(
    equations: &EquationsOfMotion,
    modes: &[ElasticMode],
    twists: &[f64],
    rigid: Option<&[f64]>,
) -> Matrix {
    let count = modes.len() + usize::from(rigid.is_some());
    let mut matrix = Matrix::zeros(count, count);
    for (index, connection) in equations.connections.iter().enumerate() {
        let damping = connection.damping_at(twists[index]);
        if damping != 0.0 {
            // The rigid-body motion twists nothing.
            let part: Vec<f64> = modes.iter().map(|mode| mode.twists[index]).collect();
            matrix.add_square(damping, &part);
        }
    }
    let shapes = || modes.iter().map(|mode| mode.shape.as_slice()).chain(rigid);
    for (group, damping) in equations.ground_damping.iter().enumerate().filter(|(_, d)| **d != 0.0)
    {
        let part: Vec<f64> = shapes().map(|shape| shape[group]).collect();
        matrix.add_square(*damping, &part);
    }
    matrix
}

fn is_diagonal(matrix: &Matrix) -> bool {
    let n = matrix.rows();
    // Damping is not negative: where the diagonal is zero, so is the rest.
    let damped = (0..n).filter(|i| matrix[(*i, *i)] != 0.0);
    damped.into_iter().all(|i| {
        (0..n).filter(|j| *j != i).all(|j| {
            let size = (matrix[(i, i)] * matrix[(j, j)]).abs().sqrt();
            matrix[(i, j)].abs() <= UNCOUPLED * size.max(f64::MIN_POSITIVE)
        })
    })
}

/// Roots of `λ² + damping λ + stiffness = 0`, without cancellation.
fn quadratic(damping: f64, stiffness: f64) -> [Complex; 2] {
    let half = damping / 2.0;
    let discriminant = half * half - stiffness;
    if discriminant < 0.0 {
        let imaginary = (-discriminant).sqrt();
        return [Complex::new(-half, imaginary), Complex::new(-half, -imaginary)];
    }
    let fast = -(half + discriminant.sqrt());
    let slow = if fast == 0.0 { 0.0 } else { stiffness / fast };
    [Complex::from(slow), Complex::from(fast)]
}

fn coupled(
    modal: &Matrix,
    modes: &[ElasticMode],
    has_rigid: bool,
) -> Result<DampedPairs, AnalysisError> {
    // State: elastic displacements, then all speeds, the rigid one last.
    let (n, speeds) = (modes.len(), modal.rows());
    let matrix = Matrix::from_fn(n + speeds, n + speeds, |row, column| {
        if row < n {
            return if column == n + row { 1.0 } else { 0.0 };
        }
        let speed = row - n;
        if column < n {
            return if column == speed { -modes[speed].eigenvalue } else { 0.0 };
        }
        -modal[(speed, column - n)]
    });
    let solution = eigen(&matrix).doing("computing damped frequencies")?;
    let mut slots: Vec<Vec<Complex>> = vec![Vec::new(); speeds];
    for (value, vector) in candidates(&solution.values, &solution.vectors) {
        // A rigid-body motion has one eigenvalue besides zero, an elastic mode has two.
        let room = |mode: usize| {
            let full = if mode < n { 2 } else { 1 };
            let needed = if value.im == 0.0 { 1 } else { 2 };
            slots[mode].len() + needed <= full
        };
        let share = |mode: &usize| vector[n + *mode].modulus();
        let best =
            (0..speeds).filter(|mode| room(*mode)).max_by(|a, b| share(a).total_cmp(&share(b)));
        if let Some(mode) = best {
            slots[mode].push(value);
            if value.im != 0.0 {
                slots[mode].push(value.conjugate());
            }
        }
    }
    let pair = |slot: &Vec<Complex>| {
        let at = |index: usize| slot.get(index).copied().unwrap_or_default();
        let (a, b) = (at(0), at(1));
        if a.im == 0.0 && b.re > a.re { [b, a] } else { [a, b] }
    };
    Ok(DampedPairs {
        elastic: slots[..n].iter().map(pair).collect(),
        rigid: has_rigid
            .then(|| [Complex::default(), slots[n].first().copied().unwrap_or_default()]),
    })
}

/// Eigenvalues with one of each conjugate pair, those of the clearest eigenvectors first.
fn candidates<'v>(
    values: &[Complex],
    vectors: &'v [Vec<Complex>],
) -> Vec<(Complex, &'v Vec<Complex>)> {
    let mut list: Vec<(Complex, &Vec<Complex>)> =
        values.iter().copied().zip(vectors).filter(|(value, _)| value.im >= 0.0).collect();
    let clarity = |(value, vector): &(Complex, &Vec<Complex>)| {
        let largest = vector.iter().map(|entry| entry.modulus()).fold(0.0, f64::max);
        // Oscillating pairs need two free places, so they choose first.
        (value.im != 0.0, largest)
    };
    list.sort_by(|a, b| {
        let (a, b) = (clarity(a), clarity(b));
        b.0.cmp(&a.0).then(b.1.total_cmp(&a.1))
    });
    list
}

#[cfg(test)]
mod tests {
    use super::*;

    // Source: Vieta's formulas.
    #[test]
    fn quadratic_pairs_satisfy_vieta_also_when_overdamped() {
        for (damping, stiffness) in [(0.1, 679.0), (1e6, 1.0), (2.0, 1.0), (3.0, 0.0), (0.0, 4.0)] {
            let [a, b] = quadratic(damping, stiffness);
            let (sum, product) = (a + b, a * b);
            assert!((sum.re + damping).abs() <= 1e-14 * damping.max(1.0));
            assert!((product.re - stiffness).abs() <= 1e-14 * stiffness.max(1.0));
            assert!(sum.im.abs() < 1e-14 && product.im.abs() < 1e-10);
        }
    }
}
