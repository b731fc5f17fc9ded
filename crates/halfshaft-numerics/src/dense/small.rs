//! Eigenvalues of small matrices, without a store on the heap.
//!
//! Householder reflections to Hessenberg form, then implicit QR steps with two shifts at once on the
//! part that is still whole. Source: J. G. F. Francis, "The QR transformation", *Comput. J.* 4 (1961),
//! 265-271 and 332-345; a subdiagonal entry is zero by the test of B. Smith et al., *Matrix Eigensystem
//! Routines* (1976).

use super::general::two_by_two;
use super::matrix::Matrix;
use crate::complex::Complex;

/// Largest order.
pub(super) const MOST: usize = 8;
/// QR steps for one eigenvalue, or a pair, at most.
const MOST_STEPS: usize = 60;
/// After as many steps in vain the shifts are moved.
const STALLED: usize = 10;

/// Rows of the matrix, of which the first few are in use.
type Rows = [[f64; MOST]; MOST];

/// All eigenvalues, conjugates adjacent, of a matrix of order [`MOST`] at most; `None` where the steps
/// do not converge.
pub(super) fn eigenvalues(matrix: &Matrix) -> Option<Vec<Complex>> {
    let order = matrix.rows();
    let mut rows: Rows = [[0.0; MOST]; MOST];
    for (row, values) in rows.iter_mut().zip(matrix.as_slice().chunks_exact(order)) {
        row[..order].copy_from_slice(values);
    }
    to_hessenberg(&mut rows, order);
    let mut values = Vec::with_capacity(order);
    let (mut high, mut steps) = (order, 0);
    while high > 0 {
        let low = (1..high).rev().find(|&at| is_split(&rows, at)).unwrap_or(0);
        match high - low {
            1 => values.push(Complex::from(rows[low][low])),
            2 => {
                let [a, b] = [rows[low], rows[low + 1]];
                values.extend(two_by_two(a[low], a[low + 1], b[low], b[low + 1]));
            }
            _ if steps == MOST_STEPS => return None,
            _ => {
                steps += 1;
                qr_step(&mut rows, (low, high), steps % STALLED == 0);
                continue;
            }
        }
        (high, steps) = (low, 0);
    }
    Some(values)
}

/// Whether the entry before the diagonal of a row is rounding beside its neighbours.
fn is_split(rows: &Rows, at: usize) -> bool {
    let beside = rows[at - 1][at - 1].abs() + rows[at][at].abs();
    rows[at][at - 1].abs() <= f64::EPSILON * beside
}

/// A reflection that turns a vector into a multiple of the first unit vector: `1 - v wᵀ`.
struct Reflection<const N: usize> {
    v: [f64; N],
    w: [f64; N],
}

impl<const N: usize> Reflection<N> {
    /// `None` where there is nothing to turn.
    fn of(x: [f64; N]) -> Option<Self> {
        let size = x.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
        if x[1..].iter().all(|x| *x == 0.0) {
            return None;
        }
        let mut v = x.map(|x| x / size);
        let length = v.iter().map(|x| x * x).sum::<f64>().sqrt().copysign(v[0]);
        let first = v[0] + length;
        v.iter_mut().skip(1).for_each(|x| *x /= first);
        v[0] = 1.0;
        let scale = first / length;
        Some(Self { v, w: v.map(|x| scale * x) })
    }

    fn rows(&self, rows: &mut Rows, from: usize, columns: std::ops::Range<usize>) {
        for column in columns {
            let sum: f64 = (0..N).map(|k| self.w[k] * rows[from + k][column]).sum();
            (0..N).for_each(|k| rows[from + k][column] -= self.v[k] * sum);
        }
    }

    fn columns(&self, rows: &mut Rows, from: usize, which: std::ops::Range<usize>) {
        for row in &mut rows[which] {
            let sum: f64 = (0..N).map(|k| self.w[k] * row[from + k]).sum();
            (0..N).for_each(|k| row[from + k] -= self.v[k] * sum);
        }
    }
}

/// Zeros below the subdiagonal.
fn to_hessenberg(rows: &mut Rows, order: usize) {
    for column in 0..order.saturating_sub(2) {
        let mut x = [0.0; MOST];
        for (x, row) in x.iter_mut().zip(&rows[column + 1..order]) {
            *x = row[column];
        }
        // Beyond the order the vector is zero, but rows and columns there must exist.
        let Some(reflection) = Reflection::of(x) else { continue };
        let count = order - column - 1;
        let below = &mut rows[column + 1..order];
        for at in column..order {
            let sum: f64 = reflection.w.iter().zip(&*below).map(|(w, row)| w * row[at]).sum();
            below.iter_mut().zip(&reflection.v).for_each(|(row, v)| row[at] -= v * sum);
        }
        for row in &mut rows[..order] {
            let sum: f64 = (0..count).map(|k| reflection.w[k] * row[column + 1 + k]).sum();
            (0..count).for_each(|k| row[column + 1 + k] -= reflection.v[k] * sum);
        }
        rows[column + 2..order].iter_mut().for_each(|row| row[column] = 0.0);
    }
}

/// One implicit QR step with both shifts of the last two rows on a part of at least three.
fn qr_step(h: &mut Rows, (low, high): (usize, usize), moved: bool) {
    let (p, q) = (high - 2, high - 1);
    let (sum, product) = if moved {
        let shift = h[q][p].abs() + h[p][p - 1].abs();
        (1.5 * shift, shift * shift)
    } else {
        (h[p][p] + h[q][q], h[p][p] * h[q][q] - h[p][q] * h[q][p])
    };
    let (a, b) = (h[low], h[low + 1]);
    let mut bulge = [
        a[low] * a[low] + a[low + 1] * b[low] - sum * a[low] + product,
        b[low] * (a[low] + b[low + 1] - sum),
        b[low] * h[low + 2][low + 1],
    ];
    for at in low..high - 2 {
        if let Some(reflection) = Reflection::of(bulge) {
            reflection.rows(h, at, at.saturating_sub(1).max(low)..high);
            reflection.columns(h, at, low..high.min(at + 4));
        }
        if at > low {
            (h[at + 1][at - 1], h[at + 2][at - 1]) = (0.0, 0.0);
        }
        bulge = [h[at + 1][at], h[at + 2][at], if at + 3 < high { h[at + 3][at] } else { 0.0 }];
    }
    if let Some(reflection) = Reflection::of([bulge[0], bulge[1]]) {
        reflection.rows(h, p, p - 1..high);
        reflection.columns(h, p, low..high);
        h[q][p - 1] = 0.0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A matrix with given real eigenvalues and pairs, mixed by shears of integers.
    fn mixed(blocks: &[(f64, f64)]) -> Matrix {
        let order: usize = blocks.iter().map(|(_, im)| if *im == 0.0 { 1 } else { 2 }).sum();
        let mut a = Matrix::zeros(order, order);
        let mut at = 0;
        for (re, im) in blocks {
            a[(at, at)] = *re;
            if *im != 0.0 {
                (a[(at, at + 1)], a[(at + 1, at)], a[(at + 1, at + 1)]) = (*im, -*im, *re);
            }
            at += if *im == 0.0 { 1 } else { 2 };
        }
        for (k, factor) in [(1, 2.0), (2, -1.0), (3, 3.0), (5, -2.0), (4, 1.0)] {
            let (i, j) = (k % order, (k * 3 + 1) % order);
            if i == j {
                continue;
            }
            // Row operation and its inverse on the columns.
            for c in 0..order {
                a[(i, c)] += factor * a[(j, c)];
            }
            for r in 0..order {
                a[(r, j)] -= factor * a[(r, i)];
            }
        }
        a
    }

    fn sorted(mut list: Vec<Complex>) -> Vec<Complex> {
        list.sort_by(|a, b| (a.re, a.im).partial_cmp(&(b.re, b.im)).unwrap());
        list
    }

    // Source: similar matrices have the eigenvalues of the blocks they were made of.
    #[test]
    fn mixed_blocks_keep_their_eigenvalues() {
        let lists: [&[(f64, f64)]; 6] = [
            &[(1.0, 0.0), (2.0, 0.0), (-3.0, 0.0)],
            &[(0.5, 0.25), (0.9, 0.0)],
            &[(0.97, 0.2), (-0.4, 0.9)],
            &[(1e6, 0.0), (0.5, 0.1), (1e-5, 0.0)],
            &[(0.1, 0.2), (0.3, 0.4), (0.5, 0.6), (0.7, 0.8)],
            &[(-1.0, 0.0), (1.0, 0.0), (0.0, 1.0), (4.0, 0.0), (0.25, 3.0)],
        ];
        for blocks in lists {
            let found = sorted(eigenvalues(&mixed(blocks)).unwrap());
            let largest = found.iter().map(|z| z.modulus()).fold(0.0, f64::max);
            let wanted = blocks.iter().flat_map(|(re, im)| {
                let pair = [Complex::new(*re, *im), Complex::new(*re, -*im)];
                pair.into_iter().take(if *im == 0.0 { 1 } else { 2 })
            });
            for (found, wanted) in found.iter().zip(sorted(wanted.collect())) {
                let off = (*found - wanted).modulus();
                assert!(off < 2e-13 * largest.max(1.0), "{blocks:?}: {found:?} for {wanted:?}");
            }
        }
    }

    // Source: the library's routine on the same matrices; a permutation, which plain shifts never move.
    #[test]
    fn agrees_with_the_library() {
        let cycle = Matrix::from_fn(4, 4, |i, j| if (i + 1) % 4 == j { 1.0 } else { 0.0 });
        let wild = |order: usize| {
            Matrix::from_fn(order, order, |i, j| ((7 * i * i + 3 * j + 5 * i * j) as f64).sin())
        };
        for matrix in [cycle, wild(3), wild(5), wild(6), wild(7), wild(8)] {
            let (own, other) = (
                sorted(eigenvalues(&matrix).unwrap()),
                sorted(super::super::bridge::general(&matrix, false).unwrap().0),
            );
            for a in &own {
                let near = other.iter().map(|b| (*a - *b).modulus()).fold(f64::INFINITY, f64::min);
                assert!(near < 1e-12, "{a:?} in {other:?}");
            }
            let sum: f64 = own.iter().map(|z| z.re).sum();
            let trace: f64 = (0..matrix.rows()).map(|k| matrix[(k, k)]).sum();
            assert!((sum - trace).abs() < 1e-12);
        }
    }
}
