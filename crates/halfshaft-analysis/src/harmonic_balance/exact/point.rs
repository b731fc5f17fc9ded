//! An orbit on a branch with its direction, and the lengths by which branches are measured.

use halfshaft_numerics::dense::Matrix;

use super::super::stability::Stability;
use super::touch::Turns;
use crate::shooting::{Lost, Orbit, Plane, Shooter, Swing};

/// What tells orbits of one kind from those of another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in super::super) struct Kind {
    /// Order of the fundamental.
    pub(in super::super) base: f64,
    /// Periods of the excitation.
    pub(in super::super) periods: u32,
    /// Whether orbits mirror themselves after half a period.
    pub(in super::super) mirrored: bool,
}

/// An orbit on a branch.
#[derive(Clone, Debug)]
pub(super) struct Point {
    pub(super) orbit: Orbit,
    /// Direction of the branch, of unit length in the metric of the point.
    pub(super) tangent: Vec<f64>,
    pub(super) tangent_p: f64,
    /// Swing of the state over the orbit: what changes of it are measured by.
    pub(super) size: f64,
    /// Sign of the determinant of the equations bordered by the branch's own direction: it changes
    /// where another branch crosses.
    pub(super) orientation: f64,
    pub(super) stability: Stability,
    pub(super) turns: Turns,
}

impl Point {
    /// Running parameter.
    pub(super) fn p(&self) -> f64 {
        self.orbit.frequency
    }

    pub(super) fn state(&self) -> &[f64] {
        &self.orbit.state
    }

    /// The point with the direction reversed where `sign` is negative.
    pub(super) fn oriented(mut self, sign: f64) -> Self {
        if sign < 0.0 {
            self.tangent.iter_mut().for_each(|x| *x = -*x);
            self.tangent_p = -self.tangent_p;
            // The border row changes its sign with the direction, and the determinant with it.
            self.orientation = -self.orientation;
        }
        self
    }
}

/// Lengths by which states and the parameter are measured.
#[derive(Clone, Copy, Debug)]
pub(super) struct Metric {
    pub(super) size: f64,
    pub(super) span: f64,
}

impl Metric {
    pub(super) fn dot(&self, (u, p): (&[f64], f64), (v, q): (&[f64], f64)) -> f64 {
        let sum: f64 = u.iter().zip(v).map(|(x, y)| x * y).sum();
        sum / (self.size * self.size) + p * q / (self.span * self.span)
    }

    pub(super) fn norm(&self, u: &[f64], p: f64) -> f64 {
        self.dot((u, p), (u, p)).sqrt()
    }

    /// The step from one point to another, and its length.
    pub(super) fn step(&self, from: &Point, to: &Point) -> (Vec<f64>, f64, f64) {
        let d: Vec<f64> = to.state().iter().zip(from.state()).map(|(b, a)| b - a).collect();
        let d_p = to.p() - from.p();
        let length = self.norm(&d, d_p);
        (d, d_p, length)
    }
}

/// A plane across a direction through a place.
pub(super) struct Across {
    row: Vec<f64>,
    corner: f64,
    target: f64,
}

impl Across {
    pub(super) fn new(
        metric: &Metric,
        reference: f64,
        (along, along_p): (&[f64], f64),
        (state, p): (&[f64], f64),
    ) -> Self {
        let row: Vec<f64> = along.iter().map(|x| x / (metric.size * metric.size)).collect();
        let by_p = along_p / (metric.span * metric.span);
        let held: f64 = row.iter().zip(state).map(|(r, x)| r * x).sum();
        Self { row, corner: by_p * reference, target: held + by_p * p }
    }

    pub(super) fn plane(&self) -> Plane<'_> {
        Plane { row: &self.row, corner: self.corner, target: self.target }
    }
}

/// An orbit as a point of a branch whose direction is near `along`; without one the parameter rises.
pub(super) fn point_of(
    shooter: &mut Shooter<'_>,
    orbit: Orbit,
    span: f64,
    mirrored: bool,
    along: Option<(&[f64], f64)>,
    turns: &Turns,
) -> Result<Point, Lost> {
    let reference = shooter.reference();
    let none = vec![0.0; orbit.state.len()];
    let (row, row_p) = along.unwrap_or((&none, 1.0));
    let (mut tangent, by_reference) = shooter.tangent(&orbit, row, row_p / reference)?;
    let mut tangent_p = by_reference * reference;
    let coordinates = shooter.coordinates();
    let tree = shooter.equations().network.tree.iter().map(|edge| edge.shaft).collect();
    let mut swing = Swing::new(tree, coordinates.reference);
    let mut turns = turns.cleared();
    shooter.watch(&orbit, |step| {
        swing.see(step);
        turns.see(step);
    })?;
    let metric = Metric { size: swing.size().max(f64::MIN_POSITIVE.sqrt()), span };
    let length = metric.norm(&tangent, tangent_p);
    let facing = metric.dot((&tangent, tangent_p), (row, row_p));
    let scale = if facing < 0.0 { -1.0 / length } else { 1.0 / length };
    tangent.iter_mut().for_each(|x| *x *= scale);
    tangent_p *= scale;
    let bordered =
        shooter.bordered(&orbit.matrix, &orbit.by_frequency, &tangent, tangent_p / reference);
    let orientation = determinant_sign(bordered);
    let stability = Stability::of(orbit.multipliers()?, mirrored);
    Ok(Point { orbit, tangent, tangent_p, size: metric.size, orientation, stability, turns })
}

/// Sign of a determinant by elimination with row exchanges.
fn determinant_sign(mut matrix: Matrix) -> f64 {
    let n = matrix.rows();
    let mut sign = 1.0;
    for column in 0..n {
        let size = |row: usize| matrix[(row, column)].abs();
        let best = (column..n).max_by(|a, b| size(*a).total_cmp(&size(*b))).unwrap_or(column);
        if best != column {
            sign = -sign;
            for k in 0..n {
                let held = matrix[(column, k)];
                matrix[(column, k)] = matrix[(best, k)];
                matrix[(best, k)] = held;
            }
        }
        let pivot = matrix[(column, column)];
        if pivot == 0.0 {
            return 0.0;
        }
        sign *= pivot.signum();
        for row in column + 1..n {
            let factor = matrix[(row, column)] / pivot;
            for k in column..n {
                let above = matrix[(column, k)];
                matrix[(row, k)] -= factor * above;
            }
        }
    }
    sign
}

#[cfg(test)]
mod tests {
    use super::*;

    // Source: determinants by hand; a row exchange changes the sign.
    #[test]
    fn signs_of_determinants() {
        assert_eq!(determinant_sign(Matrix::from_rows([[0.0, 2.0], [3.0, 1.0]])), -1.0);
        assert_eq!(determinant_sign(Matrix::from_rows([[1.0, 2.0], [3.0, 1.0]])), -1.0);
        assert_eq!(determinant_sign(Matrix::from_rows([[1.0, 0.5], [0.5, 1.0]])), 1.0);
        assert_eq!(determinant_sign(Matrix::from_rows([[1.0, 1.0], [1.0, 1.0]])), 0.0);
    }
}
