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
    /// A size: the modulus to a factor of `sqrt(2)`.
    fn size(self) -> f64;

    /// The number times a real factor.
    fn scaled(self, factor: f64) -> Self;
}

impl Scalar for f64 {
    fn size(self) -> f64 {
        self.abs()
    }

    fn scaled(self, factor: f64) -> Self {
        self * factor
    }
}

impl Scalar for Complex {
    fn size(self) -> f64 {
        self.re.abs() + self.im.abs()
    }

    fn scaled(self, factor: f64) -> Self {
        Self { re: self.re * factor, im: self.im * factor }
    }
}

/// A symmetric matrix on a graph and, once factored, its `L D Lᵀ`.
///
/// Pivots are taken in the order of the pattern as they come, which is stable for definite matrices, and
/// enough for the signs of shifted ones. Of others some pivot may be small against its row:
/// [`SymmetricSystem::factor_strengthened`] raises it and says so, and one or two steps of iterative
/// refinement make up for it (X. S. Li and J. W. Demmel, *SuperLU_DIST*, ACM Trans. Math. Softw. 29,
/// 2003: static pivoting).
#[derive(Clone, Debug)]
pub struct SymmetricSystem<T> {
    pattern: Arc<Pattern>,
    /// By position; once factored, the inverses of the pivots.
    diagonal: Vec<T>,
    pairs: Vec<T>,
    /// The largest entry of each row, kept for its memory.
    rows: Vec<f64>,
}

/// Part of its row to which a small pivot is raised.
const RAISED: f64 = 1e-8;
/// Part of its row below which a pivot has lost digits that are worth refinement.
const WEAK: f64 = 1e-2;

impl<T: Scalar> SymmetricSystem<T> {
    /// The zero matrix of a pattern.
    pub fn new(pattern: Arc<Pattern>) -> Self {
        let (nodes, pairs) = (pattern.nodes(), pattern.pairs());
        let (diagonal, pairs) = (vec![T::default(); nodes], vec![T::default(); pairs]);
        Self { pattern, diagonal, pairs, rows: Vec::new() }
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

    /// `L D Lᵀ` in the place of the matrix. Work grows with the number of nodes on a tree. A pivot of
    /// zero stands for one as small as rounding.
    pub fn factor(&mut self) {
        self.eliminate(f64::EPSILON);
    }

    /// The same with small pivots raised to a hundred-millionth of their rows; whether some were small
    /// enough to call for iterative refinement.
    pub fn factor_strengthened(&mut self) -> bool {
        self.eliminate(RAISED)
    }

    /// Eliminates with pivots of at least `least` of the largest entry of their rows; whether one of
    /// them was weak.
    fn eliminate(&mut self, least: f64) -> bool {
        let pattern = Arc::clone(&self.pattern);
        let mut rows = std::mem::take(&mut self.rows);
        self.largest_of_rows(&mut rows);
        let mut weak = false;
        for (at, &largest) in rows.iter().enumerate() {
            let size = self.diagonal[at].size();
            weak |= size < WEAK * largest;
            if size < least * largest || largest == 0.0 {
                self.diagonal[at] = T::from((least * largest).max(f64::MIN_POSITIVE.sqrt()));
            }
            let inverse = T::from(1.0) / self.diagonal[at];
            let (first, later) = (pattern.first(at), pattern.later(at));
            for (index, &row) in later.iter().enumerate() {
                let lower = self.pairs[first + index] * inverse;
                self.diagonal[row] = self.diagonal[row] - self.pairs[first + index] * lower;
                for (other, &column) in later.iter().enumerate().skip(index + 1) {
                    let place = pattern.pair(row, column);
                    self.pairs[place] = self.pairs[place] - self.pairs[first + other] * lower;
                }
            }
            for index in 0..later.len() {
                self.pairs[first + index] = self.pairs[first + index] * inverse;
            }
            self.diagonal[at] = inverse;
        }
        self.rows = rows;
        weak
    }

    /// The largest entry of each row before elimination.
    fn largest_of_rows(&self, rows: &mut Vec<f64>) {
        rows.clear();
        rows.extend(self.diagonal.iter().map(|entry| entry.size()));
        for at in 0..self.pattern.nodes() {
            for (index, &row) in self.pattern.later(at).iter().enumerate() {
                let size = self.pairs[self.pattern.first(at) + index].size();
                rows[at] = rows[at].max(size);
                rows[row] = rows[row].max(size);
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
            let mut value = work[at] * self.diagonal[at];
            for (index, &row) in pattern.later(at).iter().enumerate() {
                value = value - self.pairs[first + index] * work[row];
            }
            work[at] = value;
            x[pattern.node(at)] = value;
        }
    }
}

impl SymmetricSystem<Complex> {
    /// Sets all entries to those of a sum of real matrices on the same pattern, each with its factor.
    pub fn set_sum(&mut self, parts: &[(&SymmetricSystem<f64>, Complex)]) {
        self.clear();
        for (part, factor) in parts {
            let add = |sums: &mut [Complex], entries: &[f64]| {
                for (sum, entry) in sums.iter_mut().zip(entries) {
                    *sum = *sum + factor.scaled(*entry);
                }
            };
            add(&mut self.diagonal, &part.diagonal);
            add(&mut self.pairs, &part.pairs);
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

    // Source: a chain of three whose first pivot is exactly zero, solved by hand: [0 1 0; 1 0 1; 0 1 2] x
    // = (1, 2, 3) has x = (1, 1, 1).
    #[test]
    fn pivots_of_zero_are_raised_and_refined_away() {
        let pattern = Arc::new(Pattern::new(3, [(0, 1), (1, 2)]));
        let mut system = SymmetricSystem::new(pattern);
        system.add(2, 2.0);
        system.add_pair(0, 1, 1.0);
        system.add_pair(1, 2, 1.0);
        assert!(system.factor_strengthened());
        let (mut x, mut work) = (vec![0.0; 3], Vec::new());
        for _ in 0..4 {
            let mut rest = vec![1.0 - x[1], 2.0 - x[0] - x[2], 3.0 - x[1] - 2.0 * x[2]];
            system.solve(&mut rest, &mut work);
            x.iter_mut().zip(&rest).for_each(|(x, step)| *x += step);
        }
        assert!(x.iter().all(|x| (x - 1.0).abs() < 1e-15), "{x:?}");
    }
}
