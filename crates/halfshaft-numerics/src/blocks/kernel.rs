//! Dense kernels on row-major slices: factorisation with partial pivoting, solves, products.

use super::fixed;

/// From this order on blocks are left to the library.
const LARGE: usize = 64;
/// So many right-hand sides or columns are worth its preparations.
const MANY: usize = 8;

/// Factorises the `n` by `n` matrix in place; `false` where a pivot vanishes or is not finite.
/// `sign` is multiplied by the sign of the determinant. `N` is `n` where that is known before, else 0.
#[inline(always)]
pub(super) fn factorise<const N: usize>(
    a: &mut [f64],
    n: usize,
    pivots: &mut [usize],
    sign: &mut f64,
) -> bool {
    if N > 0 {
        fixed::factorise::<N>(a, pivots, sign)
    } else if n < LARGE {
        plain(a, n, pivots, sign)
    } else {
        super::large::factorise(a, n, pivots, sign)
    }
}

/// The same a column at a time.
#[inline(always)]
pub(super) fn plain(a: &mut [f64], n: usize, pivots: &mut [usize], sign: &mut f64) -> bool {
    for k in 0..n {
        if !exchange(a, n, k, pivots, sign) {
            return false;
        }
        let (upper, lower) = a.split_at_mut((k + 1) * n);
        let pivot_row = &upper[k * n..];
        let inverse = 1.0 / pivot_row[k];
        for row in lower.chunks_exact_mut(n) {
            let factor = row[k] * inverse;
            row[k] = factor;
            if factor != 0.0 {
                for (entry, upper) in row[k + 1..].iter_mut().zip(&pivot_row[k + 1..n]) {
                    *entry -= factor * upper;
                }
            }
        }
    }
    true
}

/// Brings the largest entry of column `k` on and below the diagonal into row `k`; `false` where it
/// vanishes or is not finite. `sign` is multiplied by that of the exchange and of the pivot.
#[inline(always)]
pub(super) fn exchange(
    a: &mut [f64],
    n: usize,
    k: usize,
    pivots: &mut [usize],
    sign: &mut f64,
) -> bool {
    let mut best = k;
    let mut largest = a[k * n + k].abs();
    for row in k + 1..n {
        let size = a[row * n + k].abs();
        if size > largest {
            largest = size;
            best = row;
        }
    }
    if !(largest > 0.0 && largest.is_finite()) {
        return false;
    }
    pivots[k] = best;
    if best != k {
        *sign = -*sign;
        let (upper, lower) = a.split_at_mut(best * n);
        upper[k * n..(k + 1) * n].swap_with_slice(&mut lower[..n]);
    }
    if a[k * n + k] < 0.0 {
        *sign = -*sign;
    }
    true
}

/// Solves `A X = R` in place for `columns` right-hand sides (row-major, `n` by `columns`). Where `N` is
/// `n`, there is one or there are as many.
#[inline(always)]
pub(super) fn solve<const N: usize>(
    lu: &[f64],
    n: usize,
    pivots: &[usize],
    r: &mut [f64],
    columns: usize,
) {
    for k in 0..n {
        let best = pivots[k];
        if best != k {
            let (upper, lower) = r.split_at_mut(best * columns);
            upper[k * columns..(k + 1) * columns].swap_with_slice(&mut lower[..columns]);
        }
    }
    match (N > 0, columns) {
        (true, 1) => return fixed::solve_one::<N>(lu, r),
        (true, _) => return fixed::solve::<N, N>(lu, r),
        (false, 1) => return solve_one(lu, n, r),
        (false, _) => {}
    }
    if n >= LARGE && columns >= MANY {
        return super::large::solve(lu, n, r, columns);
    }
    for row in 1..n {
        let (done, rest) = r.split_at_mut(row * columns);
        for k in 0..row {
            let factor = lu[row * n + k];
            if factor != 0.0 {
                axpy(-factor, &done[k * columns..(k + 1) * columns], &mut rest[..columns]);
            }
        }
    }
    for row in (0..n).rev() {
        let (upper, done) = r.split_at_mut((row + 1) * columns);
        let target = &mut upper[row * columns..];
        for k in row + 1..n {
            let from = (k - row - 1) * columns;
            axpy(-lu[row * n + k], &done[from..from + columns], target);
        }
        let inverse = 1.0 / lu[row * n + row];
        target.iter_mut().for_each(|value| *value *= inverse);
    }
}

/// Solves `L U x = r` in place, rows exchanged before.
#[inline(always)]
fn solve_one(lu: &[f64], n: usize, r: &mut [f64]) {
    for row in 1..n {
        let (done, rest) = r.split_at_mut(row);
        rest[0] -= dot(&lu[row * n..row * n + row], done);
    }
    for row in (0..n).rev() {
        let (upper, done) = r.split_at_mut(row + 1);
        let own = &lu[row * n..(row + 1) * n];
        upper[row] = (upper[row] - dot(&own[row + 1..], done)) / own[row];
    }
}

/// Sum of products, in eight sums that the processor adds to side by side.
#[inline(always)]
pub(super) fn dot(x: &[f64], y: &[f64]) -> f64 {
    let mut sums = [0.0; 8];
    let (mut left, mut right) = (x.chunks_exact(8), y.chunks_exact(8));
    for (x, y) in (&mut left).zip(&mut right) {
        for ((sum, x), y) in sums.iter_mut().zip(x).zip(y) {
            *sum += x * y;
        }
    }
    let rest: f64 = left.remainder().iter().zip(right.remainder()).map(|(x, y)| x * y).sum();
    let [a, b, c, d, e, f, g, h] = sums;
    ((a + e) + (b + f)) + ((c + g) + (d + h)) + rest
}

/// Solves `Aᵀ x = r` in place.
#[inline(always)]
pub(super) fn solve_transposed(lu: &[f64], n: usize, pivots: &[usize], r: &mut [f64]) {
    for k in 0..n {
        r[k] /= lu[k * n + k];
        let value = r[k];
        for j in k + 1..n {
            r[j] -= lu[k * n + j] * value;
        }
    }
    for k in (0..n).rev() {
        let value = r[k];
        for j in 0..k {
            r[j] -= lu[k * n + j] * value;
        }
    }
    for k in (0..n).rev() {
        r.swap(k, pivots[k]);
    }
}

#[inline(always)]
pub(super) fn axpy(factor: f64, x: &[f64], y: &mut [f64]) {
    for (y, x) in y.iter_mut().zip(x) {
        *y += factor * x;
    }
}

/// `out -= A B` with `A` `rows` by `inner` and `B` `inner` by `columns`. Where `N` is `inner`, there is
/// one column or there are as many.
#[inline(always)]
pub(super) fn subtract_product<const N: usize>(
    a: &[f64],
    b: &[f64],
    inner: usize,
    columns: usize,
    out: &mut [f64],
) {
    match (N > 0, columns) {
        (true, 1) => return fixed::subtract_vector::<N>(a, b, out),
        (true, _) => return fixed::subtract_product::<N, N>(a, b, out),
        (false, _) => {}
    }
    if columns == 1 {
        for (row, target) in a.chunks_exact(inner).zip(out) {
            *target -= dot(row, b);
        }
        return;
    }
    if inner >= LARGE && columns >= MANY {
        return super::large::subtract_product(a, b, inner, columns, out);
    }
    for (row, target) in a.chunks_exact(inner).zip(out.chunks_exact_mut(columns)) {
        for (factor, source) in row.iter().zip(b.chunks_exact(columns)) {
            if *factor != 0.0 {
                axpy(-factor, source, target);
            }
        }
    }
}

/// `out -= Aᵀ x` with `A` `x.len()` by `out.len()`.
#[inline(always)]
pub(super) fn subtract_transposed(a: &[f64], x: &[f64], out: &mut [f64]) {
    for (row, factor) in a.chunks_exact(out.len()).zip(x) {
        axpy(-factor, row, out);
    }
}
