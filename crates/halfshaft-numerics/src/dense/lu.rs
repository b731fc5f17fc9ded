//! Linear systems by elimination with row exchanges.

use super::bridge::LargeLu;
use super::matrix::Matrix;
use crate::error::{Error, has_length};

/// Up to this order the elimination below is faster than the library's set-up.
const SMALL_ORDER: usize = 32;

/// A factorised square matrix, ready for any number of right-hand sides.
#[derive(Debug, Clone)]
pub struct Lu {
    factors: Factors,
}

#[derive(Debug, Clone)]
enum Factors {
    Small(SmallLu),
    Large(LargeLu),
}

impl Lu {
    /// Factorises `matrix`.
    ///
    /// # Errors
    ///
    /// [`Error::NotSquare`], or [`Error::Singular`] if a pivot is exactly zero or not finite.
    pub fn new(matrix: &Matrix) -> Result<Self, Error> {
        let order = matrix.order("solving a linear system")?;
        let factors = if order <= SMALL_ORDER {
            Factors::Small(SmallLu::new(matrix, order)?)
        } else {
            Factors::Large(LargeLu::new(matrix, order)?)
        };
        Ok(Self { factors })
    }

    /// Replaces the right-hand side by the solution.
    ///
    /// # Errors
    ///
    /// [`Error::Length`] if the right-hand side does not fit.
    pub fn solve_in_place(&self, right: &mut [f64]) -> Result<(), Error> {
        let order = match &self.factors {
            Factors::Small(lu) => lu.exchanges.len(),
            Factors::Large(lu) => lu.order(),
        };
        has_length("right-hand side", order, right.len())?;
        match &self.factors {
            Factors::Small(lu) => lu.solve(right),
            Factors::Large(lu) => lu.solve(right),
        }
        Ok(())
    }
}

/// The solution `x` of `matrix x = right`.
///
/// # Errors
///
/// [`Error::NotSquare`], [`Error::Length`], or [`Error::Singular`] if a pivot is exactly zero or
/// not finite.
pub fn solve(matrix: &Matrix, right: &[f64]) -> Result<Vec<f64>, Error> {
    let order = matrix.order("solving a linear system")?;
    has_length("right-hand side", order, right.len())?;
    let mut solution = right.to_vec();
    match (matrix.as_slice(), right) {
        (&[a], &[r]) => solution[0] = r / pivot(a, 1, 0)?,
        (&[a, b, c, d], &[r, s]) => {
            let (x, y) = solve_two([a, b, c, d], [r, s])?;
            solution.copy_from_slice(&[x, y]);
        }
        _ => Lu::new(matrix)?.solve_in_place(&mut solution)?,
    }
    Ok(solution)
}

/// Two equations, the larger entry of the first column as pivot.
fn solve_two([a, b, c, d]: [f64; 4], [r, s]: [f64; 2]) -> Result<(f64, f64), Error> {
    let ([a, b, r], [c, d, s]) =
        if a.abs() >= c.abs() { ([a, b, r], [c, d, s]) } else { ([c, d, s], [a, b, r]) };
    let factor = c / pivot(a, 2, 0)?;
    let y = (s - factor * r) / pivot(d - factor * b, 2, 1)?;
    Ok(((r - b * y) / a, y))
}

fn pivot(value: f64, dimension: usize, column: usize) -> Result<f64, Error> {
    if value != 0.0 && value.is_finite() {
        Ok(value)
    } else {
        Err(Error::Singular { dimension, column })
    }
}

/// Row-wise elimination in place: unit lower triangle below, upper triangle on and above the
/// diagonal.
#[derive(Debug, Clone)]
struct SmallLu {
    factors: Matrix,
    /// The row that was exchanged with row `k` at step `k`.
    exchanges: Vec<usize>,
}

impl SmallLu {
    fn new(matrix: &Matrix, order: usize) -> Result<Self, Error> {
        let mut factors = matrix.clone();
        let mut exchanges = Vec::with_capacity(order);
        for k in 0..order {
            let mut best = k;
            for row in k + 1..order {
                if factors[(row, k)].abs() > factors[(best, k)].abs() {
                    best = row;
                }
            }
            exchanges.push(best);
            let entries = factors.as_mut_slice();
            if best != k {
                let (upper, lower) = entries.split_at_mut(best * order);
                upper[k * order..(k + 1) * order].swap_with_slice(&mut lower[..order]);
            }
            let (upper, lower) = entries.split_at_mut((k + 1) * order);
            let pivot_row = &upper[k * order..];
            let pivot = pivot(pivot_row[k], order, k)?;
            for row in lower.chunks_exact_mut(order) {
                let factor = row[k] / pivot;
                row[k] = factor;
                for (entry, above) in row[k + 1..].iter_mut().zip(&pivot_row[k + 1..]) {
                    *entry -= factor * above;
                }
            }
        }
        Ok(Self { factors, exchanges })
    }

    fn solve(&self, x: &mut [f64]) {
        let order = x.len();
        for (k, &other) in self.exchanges.iter().enumerate() {
            x.swap(k, other);
        }
        for k in 1..order {
            x[k] -= dot(&self.factors.row(k)[..k], &x[..k]);
        }
        for k in (0..order).rev() {
            let row = self.factors.row(k);
            x[k] = (x[k] - dot(&row[k + 1..], &x[k + 1..])) / row[k];
        }
    }
}

/// The inner product of two vectors; of different lengths as far as the shorter goes.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
