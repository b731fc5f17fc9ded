//! Eigenvalues of a Hessenberg matrix by implicit QR steps with two shifts at once.

use super::{LINE, Square, sum, two_by_two};
use crate::complex::Complex;

/// QR steps for one eigenvalue, or a pair, at most.
const MOST_STEPS: usize = 60;
/// After as many steps in vain the shifts are moved.
const STALLED: usize = 10;

impl Square<'_> {
    /// Eigenvalues of a Hessenberg matrix.
    #[inline(always)]
    pub(super) fn values<const FUSED: bool>(&mut self) -> Option<Vec<Complex>> {
        let mut values = Vec::with_capacity(self.order);
        let (mut high, mut steps) = (self.order, 0);
        while high > 0 {
            let low = (1..high).rev().find(|&at| self.is_split(at)).unwrap_or(0);
            if low > 0 {
                self.set(low, low - 1, 0.0);
            }
            match high - low {
                1 => values.push(Complex::from(self.at(low, low))),
                2 => {
                    let [a, b] = [0, 1].map(|k| self.at(low, low + k));
                    let [c, d] = [0, 1].map(|k| self.at(low + 1, low + k));
                    values.extend(two_by_two(a, b, c, d));
                }
                _ if steps == MOST_STEPS => return None,
                _ => {
                    steps += 1;
                    self.qr_step::<FUSED>((low, high), steps % STALLED == 0);
                    continue;
                }
            }
            (high, steps) = (low, 0);
        }
        Some(values)
    }

    /// Whether the entry before the diagonal of a row is rounding beside its neighbours.
    #[inline(always)]
    fn is_split(&self, at: usize) -> bool {
        let beside = self.at(at - 1, at - 1).abs() + self.at(at, at).abs();
        self.at(at, at - 1).abs() <= f64::EPSILON * beside
    }

    /// One implicit QR step with both shifts of the last two rows on a part of at least three.
    #[inline(always)]
    fn qr_step<const FUSED: bool>(&mut self, (low, high): (usize, usize), moved: bool) {
        let (p, q) = (high - 2, high - 1);
        let mut bulge = self.first_bulge((low, high), moved);
        for at in low..p {
            if let Some((v, w)) = reflection_of_three(bulge) {
                self.reflect_rows::<FUSED>(at, high, v, w);
                self.reflect_columns::<FUSED, 3>(at, low..high.min(at + 4), v, w);
            }
            if at > low {
                self.set(at + 1, at - 1, 0.0);
                self.set(at + 2, at - 1, 0.0);
            }
            let last = if at + 3 < high { self.at(at + 3, at) } else { 0.0 };
            bulge = [self.at(at + 1, at), self.at(at + 2, at), last];
        }
        if let Some((v, w)) = reflection_of_three([bulge[0], bulge[1], 0.0]) {
            let (first, second) = self.rows[p * self.stride..].split_at_mut(self.stride);
            for (x, y) in first[p - 1..high].iter_mut().zip(&mut second[p - 1..high]) {
                let along = w[0] * *x + w[1] * *y;
                (*x, *y) = (*x - v[0] * along, *y - v[1] * along);
            }
            self.reflect_columns::<FUSED, 2>(p, low..high, [v[0], v[1]], [w[0], w[1]]);
            self.set(q, p - 1, 0.0);
        }
    }

    /// The first column of the square with both shifts, which the step begins with.
    #[inline(always)]
    fn first_bulge(&self, (low, high): (usize, usize), moved: bool) -> [f64; 3] {
        let (p, q) = (high - 2, high - 1);
        let (sum, product) = if moved {
            let shift = self.at(q, p).abs() + self.at(p, p - 1).abs();
            (1.5 * shift, shift * shift)
        } else {
            let [a, b] = [self.at(p, p), self.at(q, q)];
            (a + b, a * b - self.at(p, q) * self.at(q, p))
        };
        let [a, b] = [self.at(low, low), self.at(low, low + 1)];
        let [c, d] = [self.at(low + 1, low), self.at(low + 1, low + 1)];
        [a * a + b * c - sum * a + product, c * (a + d - sum), c * self.at(low + 2, low + 1)]
    }

    /// Three rows from number `at` on, in whole lines: what lies before them is zero and stays so,
    /// what lies beyond `high` is of no use any more.
    #[inline(always)]
    fn reflect_rows<const FUSED: bool>(
        &mut self,
        at: usize,
        high: usize,
        v: [f64; 3],
        w: [f64; 3],
    ) {
        let (from, to) = (at.saturating_sub(1) / LINE, high.div_ceil(LINE));
        let (first, rest) = self.rows[at * self.stride..].split_at_mut(self.stride);
        let (second, third) = rest.split_at_mut(self.stride);
        let lines = |row| &mut <[f64]>::as_chunks_mut::<LINE>(row).0[from..to];
        let rows = lines(first).iter_mut().zip(lines(second)).zip(lines(third));
        for ((a, b), c) in rows {
            for lane in 0..LINE {
                let [x, y, z] = [a[lane], b[lane], c[lane]];
                let along = sum::<FUSED>(w[2], z, sum::<FUSED>(w[1], y, w[0] * x));
                a[lane] = sum::<FUSED>(-v[0], along, x);
                b[lane] = sum::<FUSED>(-v[1], along, y);
                c[lane] = sum::<FUSED>(-v[2], along, z);
            }
        }
    }

    /// `N` columns from number `at` on of some rows.
    #[inline(always)]
    fn reflect_columns<const FUSED: bool, const N: usize>(
        &mut self,
        at: usize,
        which: std::ops::Range<usize>,
        v: [f64; N],
        w: [f64; N],
    ) {
        let stride = self.stride;
        for row in self.rows[which.start * stride..which.end * stride].chunks_exact_mut(stride) {
            let Some(x) = row[at..].first_chunk_mut::<N>() else { return };
            let mut along = w[0] * x[0];
            for k in 1..N {
                along = sum::<FUSED>(w[k], x[k], along);
            }
            for k in 0..N {
                x[k] = sum::<FUSED>(-v[k], along, x[k]);
            }
        }
    }
}

/// The `v` and `w` of the reflection `1 - v wᵀ` that does so with a vector of three.
#[inline(always)]
fn reflection_of_three(x: [f64; 3]) -> Option<([f64; 3], [f64; 3])> {
    if x[1] == 0.0 && x[2] == 0.0 {
        return None;
    }
    let [mut x, mut y, mut z] = x;
    let mut square = x * x + y * y + z * z;
    if !(1e-200..1e200).contains(&square) {
        let size = x.abs().max(y.abs()).max(z.abs());
        (x, y, z) = (x / size, y / size, z / size);
        square = x * x + y * y + z * z;
    }
    let length = square.sqrt().copysign(x);
    let first = x + length;
    let (inverse, scale) = (1.0 / first, first / length);
    let v = [1.0, y * inverse, z * inverse];
    Some((v, [scale, scale * v[1], scale * v[2]]))
}
