//! Eigenvalues of matrices of middle order, without vectors.
//!
//! Balancing by powers of two, Householder reflections to Hessenberg form, then implicit QR steps with
//! two shifts at once on the part that is still whole; nothing outside that part is kept up. Sources:
//! B. N. Parlett, C. Reinsch, "Balancing a matrix", *Numer. Math.* 13 (1969) 293-304; J. G. F. Francis,
//! "The QR transformation", *Comput. J.* 4 (1961), 265-271 and 332-345; a subdiagonal entry is zero by
//! the test of B. Smith et al., *Matrix Eigensystem Routines* (1976).
//!
//! A library takes blocks of shifts from here on, which pays for larger orders only.

mod balance;
mod francis;
#[cfg(test)]
mod tests;

use super::general::two_by_two;
use super::matrix::Matrix;
use crate::complex::Complex;

/// Largest order that is faster here than in the library.
pub(super) const MOST: usize = 200;
/// Numbers in a line of the cache: rows begin with one.
const LINE: usize = 8;

/// All eigenvalues, conjugates adjacent, of a square matrix; `None` where the steps do not converge.
pub(super) fn eigenvalues(matrix: &Matrix) -> Option<Vec<Complex>> {
    let order = matrix.rows();
    // A multiple of the page would put a column in few places of the cache.
    let stride = (order.div_ceil(LINE) | 1) * LINE;
    let mut store = vec![0.0_f64; order * stride + LINE];
    let from = store.as_ptr().align_offset(LINE * size_of::<f64>());
    let from = if from < LINE { from } else { 0 };
    let rows = &mut store[from..from + order * stride];
    for (row, values) in rows.chunks_exact_mut(stride).zip(matrix.as_slice().chunks_exact(order)) {
        row[..order].copy_from_slice(values);
    }
    let unit = unit(matrix);
    if unit != 1.0 {
        rows.iter_mut().for_each(|x| *x /= unit);
    }
    let square = Square { rows, stride, order };
    let arch = pulp::Arch::new();
    let mut values = if matches!(arch, pulp::Arch::Scalar) {
        arch.dispatch(Work::<false>(square))
    } else {
        arch.dispatch(Work::<true>(square))
    }?;
    if unit != 1.0 {
        values.iter_mut().for_each(|value| *value = value.scaled(unit));
    }
    Some(values)
}

/// The power of two by which a matrix is measured whose entries have no squares.
fn unit(matrix: &Matrix) -> f64 {
    let size = matrix.as_slice().iter().fold(0.0_f64, |size, x| size.max(x.abs()));
    if size == 0.0 || !size.is_finite() || (1e-70..1e70).contains(&size) {
        return 1.0;
    }
    size.log2().floor().clamp(-1000.0, 1000.0).exp2()
}

/// A square matrix row by row, rows `stride` apart with zeros at their ends.
struct Square<'r> {
    rows: &'r mut [f64],
    stride: usize,
    order: usize,
}

/// All of it as work that runs with the widest instructions of the processor; `FUSED` where it
/// multiplies and adds in one.
struct Work<'r, const FUSED: bool>(Square<'r>);

impl<const FUSED: bool> pulp::NullaryFnOnce for Work<'_, FUSED> {
    type Output = Option<Vec<Complex>>;

    #[inline(always)]
    fn call(self) -> Self::Output {
        let Self(mut square) = self;
        square.balance();
        square.reduce::<FUSED>();
        square.values::<FUSED>()
    }
}

impl Square<'_> {
    #[inline(always)]
    fn at(&self, row: usize, column: usize) -> f64 {
        self.rows[row * self.stride + column]
    }

    #[inline(always)]
    fn set(&mut self, row: usize, column: usize, value: f64) {
        self.rows[row * self.stride + column] = value;
    }

    /// To Hessenberg form: zeros below the subdiagonal.
    #[inline(always)]
    fn reduce<const FUSED: bool>(&mut self) {
        let (order, stride) = (self.order, self.stride);
        // The reflection `1 - v wᵀ`, what it takes from the left and from the right.
        let mut v = vec![0.0; stride];
        let (mut w, mut left, mut right) = (v.clone(), v.clone(), v.clone());
        for column in 0..order.saturating_sub(2) {
            let below = self.rows.iter().skip((column + 1) * stride + column).step_by(stride);
            v[column + 1..order].iter_mut().zip(below).for_each(|(v, x)| *v = *x);
            v[..=column].fill(0.0);
            let Some(scale) = reflection(&mut v[column + 1..order]) else { continue };
            w.iter_mut().zip(&v).for_each(|(w, v)| *w = scale * v);
            // Whole lines: before the column the vectors are zero.
            let from = column / LINE * LINE;
            left[from..].fill(0.0);
            for (at, row) in self.rows.chunks_exact(stride).enumerate() {
                right[at] = both::<FUSED>(&row[from..], &w[from..], w[at], &mut left[from..]);
            }
            let common: f64 = w.iter().zip(&right).map(|(w, right)| w * right).sum();
            left[from..].iter_mut().zip(&v[from..]).for_each(|(left, v)| *left -= common * v);
            for (at, row) in self.rows.chunks_exact_mut(stride).enumerate() {
                let parts = left[from..].iter().zip(&v[from..]);
                for (x, (left, along)) in row[from..].iter_mut().zip(parts) {
                    *x = sum::<FUSED>(-right[at], *along, sum::<FUSED>(-v[at], *left, *x));
                }
            }
            (column + 2..order).for_each(|at| self.set(at, column, 0.0));
        }
    }
}

/// Makes of a vector the `v` of the reflection `1 - s v vᵀ` that turns it into a multiple of the first
/// unit vector; gives `s`, or `None` where there is nothing to turn.
#[inline(always)]
fn reflection(x: &mut [f64]) -> Option<f64> {
    let size = x.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
    if x[1..].iter().all(|x| *x == 0.0) {
        return None;
    }
    x.iter_mut().for_each(|x| *x /= size);
    let length = x.iter().map(|x| x * x).sum::<f64>().sqrt().copysign(x[0]);
    let first = x[0] + length;
    x[1..].iter_mut().for_each(|x| *x /= first);
    x[0] = 1.0;
    Some(first / length)
}

/// `row · w`, and adds `factor row` to `out`; all of the same whole number of lines.
#[inline(always)]
fn both<const FUSED: bool>(row: &[f64], w: &[f64], factor: f64, out: &mut [f64]) -> f64 {
    let mut parts = [0.0_f64; LINE];
    let lines = row.as_chunks::<LINE>().0.iter().zip(w.as_chunks::<LINE>().0);
    for ((x, w), out) in lines.zip(out.as_chunks_mut::<LINE>().0) {
        for lane in 0..LINE {
            parts[lane] = sum::<FUSED>(x[lane], w[lane], parts[lane]);
            out[lane] = sum::<FUSED>(factor, x[lane], out[lane]);
        }
    }
    parts.iter().sum()
}

/// `a b + c`.
#[inline(always)]
fn sum<const FUSED: bool>(a: f64, b: f64, c: f64) -> f64 {
    // Without the instruction `mul_add` is a slow call.
    if FUSED { a.mul_add(b, c) } else { a * b + c }
}
