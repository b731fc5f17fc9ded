//! Factorisation of large dense blocks: as many columns at once as the processor's caches like.
//!
//! The same elimination with row exchanges as for small blocks, in panels of [`WIDTH`] columns: the
//! rest of the matrix is passed through once a panel in place of once a column, with the widest
//! instructions of the processor. G. Golub, C. Van Loan, *Matrix Computations* (2013), algorithm 3.4.1.

/// Columns of a panel.
const WIDTH: usize = 8;

struct Elimination<'e> {
    a: &'e mut [f64],
    n: usize,
    pivots: &'e mut [usize],
    sign: &'e mut f64,
}

/// Factorises the `n` by `n` matrix in place; `false` where a pivot vanishes or is not finite.
/// `sign` is multiplied by the sign of the determinant.
pub(super) fn factorise(a: &mut [f64], n: usize, pivots: &mut [usize], sign: &mut f64) -> bool {
    pulp::Arch::new().dispatch(Elimination { a, n, pivots, sign })
}

impl pulp::NullaryFnOnce for Elimination<'_> {
    type Output = bool;

    #[inline(always)]
    fn call(self) -> bool {
        let Self { a, n, pivots, sign } = self;
        for from in (0..n).step_by(WIDTH) {
            let to = (from + WIDTH).min(n);
            if !panel(a, n, (from, to), pivots, sign) {
                return false;
            }
            if to == n {
                break;
            }
            let (upper, lower) = a.split_at_mut(to * n);
            let upper = &mut upper[from * n..];
            upper_rows(upper, n, from, to);
            for row in lower.chunks_exact_mut(n) {
                subtract(row, upper, n, from, to);
            }
        }
        true
    }
}

/// Eliminates the columns of one panel, in these columns only; rows are exchanged as a whole.
#[inline(always)]
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

/// The panel's rows to the right of it.
#[inline(always)]
fn upper_rows(upper: &mut [f64], n: usize, from: usize, to: usize) {
    for row in 1..to - from {
        let (above, own) = upper.split_at_mut(row * n);
        for p in 0..row {
            let factor = own[from + p];
            let source = &above[p * n + to..(p + 1) * n];
            for (entry, value) in own[to..n].iter_mut().zip(source) {
                *entry -= factor * value;
            }
        }
    }
}

/// Subtracts the panel's share from one row below it, to the right of it.
#[inline(always)]
fn subtract(row: &mut [f64], upper: &[f64], n: usize, from: usize, to: usize) {
    let (factors, rest) = row.split_at_mut(to);
    let factors = &factors[from..];
    let mut rows = upper.chunks_exact(n).map(|row| &row[to..]);
    if factors.len() < WIDTH {
        for (factor, source) in factors.iter().zip(rows) {
            rest.iter_mut().zip(source).for_each(|(entry, value)| *entry -= factor * value);
        }
        return;
    }
    let mut next = || rows.next().unwrap_or(&[]);
    let [u0, u1, u2, u3, u4, u5, u6, u7] = std::array::from_fn(|_| next());
    let count = rest.len();
    let [u0, u1, u2, u3] = [u0, u1, u2, u3].map(|u: &[f64]| &u[..count]);
    let [u4, u5, u6, u7] = [u4, u5, u6, u7].map(|u: &[f64]| &u[..count]);
    for at in 0..count {
        let first =
            factors[0] * u0[at] + factors[1] * u1[at] + factors[2] * u2[at] + factors[3] * u3[at];
        let second =
            factors[4] * u4[at] + factors[5] * u5[at] + factors[6] * u6[at] + factors[7] * u7[at];
        rest[at] -= first + second;
    }
}

#[cfg(test)]
mod tests {
    use super::super::kernel;
    use super::*;

    // Source: the same elimination a column at a time.
    #[test]
    fn panels_change_nothing_but_the_rounding() {
        for n in [1, 7, 8, 9, 40, 83] {
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
