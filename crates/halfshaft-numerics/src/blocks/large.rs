//! The kernels of large dense blocks, by the library of dense linear algebra.
//!
//! The same elimination with row exchanges as for small blocks, in panels of [`WIDTH`] columns: the
//! rest of the matrix is passed through once a panel in place of once a column, as a product of
//! matrices. G. Golub, C. Van Loan, *Matrix Computations* (2013), algorithm 3.4.1.

use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::{
    solve_unit_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::prelude::{Reborrow, ReborrowMut};
use faer::{Accum, MatMut, MatRef, Par};

/// Columns of a panel.
const WIDTH: usize = 24;

/// Factorises the `n` by `n` matrix in place; `false` where a pivot vanishes or is not finite.
/// `sign` is multiplied by the sign of the determinant.
pub(super) fn factorise(a: &mut [f64], n: usize, pivots: &mut [usize], sign: &mut f64) -> bool {
    for from in (0..n).step_by(WIDTH) {
        let to = (from + WIDTH).min(n);
        if !panel(a, n, (from, to), pivots, sign) {
            return false;
        }
        let whole = MatMut::from_row_major_slice_mut(&mut *a, n, n);
        let (_, right) = whole.split_at_col_mut(from);
        let (_, below) = right.split_at_row_mut(from);
        let width = to - from;
        let (own, mut upper, lower, rest) = below.split_at_mut(width, width);
        solve_unit_lower_triangular_in_place(own.rb(), upper.rb_mut(), Par::Seq);
        matmul(rest, Accum::Add, lower.rb(), upper.rb(), -1.0, Par::Seq);
    }
    true
}

/// Eliminates the columns of one panel, in these columns only; rows are exchanged as a whole.
fn panel(
    a: &mut [f64],
    n: usize,
    (from, to): (usize, usize),
    pivots: &mut [usize],
    sign: &mut f64,
) -> bool {
    for k in from..to {
        if !super::kernel::exchange(a, n, k, pivots, sign) {
            return false;
        }
        let (upper, lower) = a.split_at_mut((k + 1) * n);
        let pivot = &upper[k * n + k..k * n + to];
        let inverse = 1.0 / pivot[0];
        for row in lower.chunks_exact_mut(n) {
            let row = &mut row[k..to];
            row[0] *= inverse;
            let factor = row[0];
            for (entry, upper) in row[1..].iter_mut().zip(&pivot[1..]) {
                *entry -= factor * upper;
            }
        }
    }
    true
}

/// Solves `L U X = R` in place for many right-hand sides, rows exchanged before.
pub(super) fn solve(lu: &[f64], n: usize, r: &mut [f64], columns: usize) {
    let lu = MatRef::from_row_major_slice(lu, n, n);
    let mut r = MatMut::from_row_major_slice_mut(r, n, columns);
    solve_unit_lower_triangular_in_place(lu, r.rb_mut(), Par::Seq);
    solve_upper_triangular_in_place(lu, r.rb_mut(), Par::Seq);
}

/// `out -= A B` with `A` `rows` by `inner` and `B` `inner` by `columns`.
pub(super) fn subtract_product(
    a: &[f64],
    b: &[f64],
    inner: usize,
    columns: usize,
    out: &mut [f64],
) {
    let rows = a.len() / inner;
    let a = MatRef::from_row_major_slice(a, rows, inner);
    let b = MatRef::from_row_major_slice(b, inner, columns);
    let out = MatMut::from_row_major_slice_mut(out, rows, columns);
    matmul(out, Accum::Add, a, b, -1.0, Par::Seq);
}

#[cfg(test)]
mod tests {
    use super::super::kernel;
    use super::*;

    // Source: the same loops a row at a time.
    #[test]
    fn products_and_solves_are_those_of_small_blocks() {
        let n = 67;
        let entry = |k: usize| (0.7 * (k * k) as f64 + 0.3).sin();
        let mut lu: Vec<f64> = (0..n * n).map(entry).collect();
        assert!(kernel::plain(&mut lu, n, &mut vec![0; n], &mut 1.0));
        let b: Vec<f64> = (0..n * n).map(|k| entry(k + 5)).collect();
        let near = |x: &[f64], y: &[f64]| x.iter().zip(y).all(|(x, y)| (x - y).abs() < 1e-11);
        let (mut x, y) = (b.clone(), b.clone());
        solve(&lu, n, &mut x, n);
        let none: Vec<usize> = (0..n).collect();
        for (at, column) in (0..n).map(|at| (at, y.iter().skip(at).step_by(n).copied())) {
            let mut column: Vec<f64> = column.collect();
            kernel::solve::<0>(&lu, n, &none, &mut column, 1);
            let own: Vec<f64> = x.iter().skip(at).step_by(n).copied().collect();
            assert!(near(&column, &own));
        }
        let mut z = b.clone();
        subtract_product(&lu, &b, n, n, &mut z);
        for column in 0..n {
            let of = |m: &[f64]| m.iter().skip(column).step_by(n).copied().collect::<Vec<_>>();
            let mut out = of(&b);
            kernel::subtract_product::<0>(&lu, &of(&b), n, 1, &mut out);
            assert!(near(&out, &of(&z)));
        }
    }

    // Source: the same elimination a column at a time.
    #[test]
    fn panels_change_nothing_but_the_rounding() {
        for n in [1, 23, 24, 25, 40, 83] {
            let entry = |k: usize| (0.7 * (k * k) as f64 + 0.3).sin();
            let mut a: Vec<f64> = (0..n * n).map(entry).collect();
            let mut b = a.clone();
            let (mut p, mut q) = (vec![0; n], vec![0; n]);
            let (mut s, mut t) = (1.0, 1.0);
            assert!(factorise(&mut a, n, &mut p, &mut s));
            assert!(kernel::plain(&mut b, n, &mut q, &mut t));
            assert_eq!((p, s), (q, t));
            let off = a.iter().zip(&b).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
            assert!(off < 1e-10, "{n}: {off:e}");
        }
        let mut zero = vec![0.0; 100];
        assert!(!factorise(&mut zero, 10, &mut [0; 10], &mut 1.0));
    }
}
