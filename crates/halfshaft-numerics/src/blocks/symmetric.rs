//! Symmetric systems with one number a node and a pair of joined nodes.

use std::ops::{Add, Div, Mul, Sub};
use std::sync::Arc;

use super::pattern::Pattern;
use crate::complex::Complex;

/// Numbers that a symmetric system is made of: real, or complex without conjugation.
pub trait Scalar:
    Copy
    + Default
    + PartialEq
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + From<f64>
{
}

impl Scalar for f64 {}
impl Scalar for Complex {}

/// A symmetric matrix on a graph and, once factored, its `L D Lᵀ`.
///
/// Pivots are taken in the order of the pattern as they come, which is stable for definite matrices and
/// for the shifted ones of which only signs or resolvents away from eigenvalues are wanted. A pivot of
/// zero stands for one as small as rounding.
#[derive(Clone, Debug)]
pub struct SymmetricSystem<T> {
    pattern: Arc<Pattern>,
    /// By position.
    diagonal: Vec<T>,
    pairs: Vec<T>,
}

impl<T: Scalar> SymmetricSystem<T> {
    /// The zero matrix of a pattern.
    pub fn new(pattern: Arc<Pattern>) -> Self {
        let (nodes, pairs) = (pattern.nodes(), pattern.pairs());
        Self { pattern, diagonal: vec![T::default(); nodes], pairs: vec![T::default(); pairs] }
    }

    /// Makes all entries zero, which it is filled from again.
    pub fn clear(&mut self) {
        self.diagonal.fill(T::default());
        self.pairs.fill(T::default());
    }

    /// Adds to the diagonal at a node.
    #[inline]
    pub fn add(&mut self, node: usize, value: T) {
        let at = self.pattern.position(node);
        self.diagonal[at] = self.diagonal[at] + value;
    }

    /// Adds to both entries between two nodes that an edge of the pattern joins.
    #[inline]
    pub fn add_pair(&mut self, a: usize, b: usize, value: T) {
        let (a, b) = (self.pattern.position(a), self.pattern.position(b));
        let at = self.pattern.pair(a.min(b), a.max(b));
        self.pairs[at] = self.pairs[at] + value;
    }

    /// `L D Lᵀ` in the place of the matrix. Work grows with the number of nodes on a tree.
    pub fn factor(&mut self) {
        let pattern = Arc::clone(&self.pattern);
        for at in 0..pattern.nodes() {
            if self.diagonal[at] == T::default() {
                self.diagonal[at] = T::from(f64::MIN_POSITIVE.sqrt());
            }
            let pivot = self.diagonal[at];
            let (first, later) = (pattern.first(at), pattern.later(at));
            for (index, &row) in later.iter().enumerate() {
                let entry = self.pairs[first + index];
                let lower = entry / pivot;
                self.diagonal[row] = self.diagonal[row] - entry * lower;
                for (other, &column) in later.iter().enumerate().skip(index + 1) {
                    let place = pattern.pair(row, column);
                    self.pairs[place] = self.pairs[place] - self.pairs[first + other] * lower;
                }
            }
            for index in 0..later.len() {
                self.pairs[first + index] = self.pairs[first + index] / pivot;
            }
        }
    }

    /// Solves with the factors; `x` is by node, the right side on entry.
    pub fn solve(&self, x: &mut [T], work: &mut Vec<T>) {
        let pattern = &*self.pattern;
        work.clear();
        work.extend((0..pattern.nodes()).map(|at| x[pattern.node(at)]));
        for at in 0..work.len() {
            let (value, first) = (work[at], pattern.first(at));
            for (index, &row) in pattern.later(at).iter().enumerate() {
                work[row] = work[row] - self.pairs[first + index] * value;
            }
        }
        for at in (0..work.len()).rev() {
            let first = pattern.first(at);
            let mut value = work[at] / self.diagonal[at];
            for (index, &row) in pattern.later(at).iter().enumerate() {
                value = value - self.pairs[first + index] * work[row];
            }
            work[at] = value;
            x[pattern.node(at)] = value;
        }
    }
}

impl SymmetricSystem<f64> {
    /// Number of negative pivots of a factored matrix: its negative eigenvalues (Sylvester).
    pub fn negative(&self) -> usize {
        self.diagonal.iter().filter(|pivot| **pivot < 0.0).count()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dense::{Matrix, dot, solve, symmetric_eigen};

    /// A graph with a loop and a branch, filled with numbers of no pattern.
    fn sample() -> (Vec<(usize, usize)>, Matrix) {
        let edges = vec![(0, 1), (1, 2), (2, 3), (3, 0), (3, 4), (4, 5), (1, 6)];
        let mut matrix = Matrix::zeros(7, 7);
        for (index, (a, b)) in edges.iter().enumerate() {
            let value = 1.0 + 0.37 * f64::from(u32::try_from(index).expect("few"));
            for (row, column, sign) in
                [(*a, *a, 1.0), (*b, *b, 1.0), (*a, *b, -1.0), (*b, *a, -1.0)]
            {
                matrix[(row, column)] += sign * value;
            }
        }
        (edges, matrix)
    }

    fn system(edges: &[(usize, usize)], matrix: &Matrix, shift: f64) -> SymmetricSystem<f64> {
        let pattern = Arc::new(Pattern::new(7, edges.iter().copied()));
        let mut system = SymmetricSystem::new(pattern);
        for node in 0..7 {
            system.add(node, matrix[(node, node)] - shift);
        }
        edges.iter().for_each(|(a, b)| system.add_pair(*a, *b, matrix[(*a, *b)]));
        system.factor();
        system
    }

    // Source: a dense elimination with pivoting, and dense eigenvalues.
    #[test]
    fn solutions_and_signs_are_those_of_the_dense_matrix() {
        let (edges, matrix) = sample();
        let eigenvalues = symmetric_eigen(&matrix).expect("is symmetric").values;
        for shift in [-0.5, 0.3, 1.7, 2.9, 5.5, 20.0] {
            let factored = system(&edges, &matrix, shift);
            let below = eigenvalues.iter().filter(|value| **value < shift).count();
            assert_eq!(factored.negative(), below, "{shift}");
            let right: Vec<f64> = (0..7).map(|n| f64::from(n * n % 5) - 1.3).collect();
            let mut found = right.clone();
            factored.solve(&mut found, &mut Vec::new());
            let shifted =
                Matrix::from_fn(7, 7, |i, j| matrix[(i, j)] - if i == j { shift } else { 0.0 });
            let expected = solve(&shifted, &right).expect("is regular");
            for (found, expected) in found.iter().zip(&expected) {
                assert!((found - expected).abs() < 1e-12 * (1.0 + expected.abs()), "{shift}");
            }
            assert!((dot(shifted.row(2), &found) - right[2]).abs() < 1e-11);
        }
    }
}
