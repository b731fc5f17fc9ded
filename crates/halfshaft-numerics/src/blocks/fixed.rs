//! The kernels on blocks whose order is known when they are compiled.
//!
//! Loops run over whole rows, entries that must not change taken against zeros: a row of a few
//! numbers is one or two registers wide, and a loop over a part of it costs more than the rest.

use super::kernel::exchange;

/// Factorises in place as [`super::kernel::plain`] does.
#[inline(always)]
pub(super) fn factorise<const N: usize>(
    a: &mut [f64],
    pivots: &mut [usize],
    sign: &mut f64,
) -> bool {
    for k in 0..N {
        if !exchange(a, N, k, pivots, sign) {
            return false;
        }
        let rows = a.as_chunks_mut::<N>().0;
        let mut upper = rows[k];
        let inverse = 1.0 / upper[k];
        upper[..=k].fill(0.0);
        for row in &mut rows[k + 1..] {
            let factor = row[k] * inverse;
            for (entry, upper) in row.iter_mut().zip(&upper) {
                *entry -= factor * upper;
            }
            row[k] = factor;
        }
    }
    true
}

/// Solves `A X = R` in place for `C` right-hand sides, rows exchanged before.
#[inline(always)]
pub(super) fn solve<const N: usize, const C: usize>(lu: &[f64], r: &mut [f64]) {
    let (lu, r) = (lu.as_chunks::<N>().0, r.as_chunks_mut::<C>().0);
    for row in 1..N {
        let mut sum = r[row];
        for (factor, done) in lu[row][..row].iter().zip(&r[..row]) {
            subtract(*factor, done, &mut sum);
        }
        r[row] = sum;
    }
    for row in (0..N).rev() {
        let mut sum = r[row];
        for (factor, done) in lu[row][row + 1..].iter().zip(&r[row + 1..N]) {
            subtract(*factor, done, &mut sum);
        }
        let inverse = 1.0 / lu[row][row];
        r[row] = sum.map(|value| value * inverse);
    }
}

/// The same for one right-hand side, column by column: a row at a time each sum would wait for the
/// one before.
#[inline(always)]
pub(super) fn solve_one<const N: usize>(lu: &[f64], r: &mut [f64]) {
    let lu = lu.as_chunks::<N>().0;
    let Some(r) = r.first_chunk_mut::<N>() else { return };
    let inverse: [f64; N] = std::array::from_fn(|k| 1.0 / lu[k][k]);
    for k in 0..N {
        let known = r[k];
        for row in k + 1..N {
            r[row] -= lu[row][k] * known;
        }
    }
    for k in (0..N).rev() {
        let known = r[k] * inverse[k];
        r[k] = known;
        for row in 0..k {
            r[row] -= lu[row][k] * known;
        }
    }
}

/// `out -= A B` with `A` of rows of `N` and `B` `N` by `C`.
#[inline(always)]
pub(super) fn subtract_product<const N: usize, const C: usize>(
    a: &[f64],
    b: &[f64],
    out: &mut [f64],
) {
    let b = b.as_chunks::<C>().0;
    for (row, target) in a.as_chunks::<N>().0.iter().zip(out.as_chunks_mut::<C>().0) {
        let mut sum = *target;
        for (factor, source) in row.iter().zip(b) {
            subtract(*factor, source, &mut sum);
        }
        *target = sum;
    }
}

/// `out -= A b`.
#[inline(always)]
pub(super) fn subtract_vector<const N: usize>(a: &[f64], b: &[f64], out: &mut [f64]) {
    let Some(b) = b.first_chunk::<N>() else { return };
    for (row, target) in a.as_chunks::<N>().0.iter().zip(out) {
        *target -= dot(row, b);
    }
}

#[inline(always)]
fn subtract<const C: usize>(factor: f64, x: &[f64; C], y: &mut [f64; C]) {
    for (y, x) in y.iter_mut().zip(x) {
        *y -= factor * x;
    }
}

/// Sum of products by halves, quarters and so on.
#[inline(always)]
fn dot<const N: usize>(x: &[f64; N], y: &[f64; N]) -> f64 {
    let mut sums = [0.0; 4];
    for (at, (x, y)) in x.iter().zip(y).enumerate() {
        sums[at % 4] += x * y;
    }
    (sums[0] + sums[2]) + (sums[1] + sums[3])
}
