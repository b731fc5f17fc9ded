//! The matrix that multiplies a series by a signal and keeps the orders of the set.

use super::{HarmonicSet, Spectrum};

/// Adds `scale` times the matrix of `x ↦ k x` to `out` (row-major, `set.coefficients()` squared),
/// where `k` has the given spectrum up to twice the highest order of the set.
///
/// By the addition theorems: the mean of `k cos iθ cos jθ` is half of that of
/// `k cos (i-j)θ + k cos (i+j)θ`, and so on.
pub fn add_product(set: &HarmonicSet, k: &Spectrum, scale: f64, out: &mut [f64]) {
    let m = set.coefficients();
    for (i, row) in set.places() {
        let i_signed = i.cast_signed();
        for (j, column) in set.places() {
            let (difference, sum) = (i_signed - j.cast_signed(), (i + j).cast_signed());
            if j == 0 {
                let weight = if i == 0 { scale } else { 2.0 * scale };
                out[row * m + column] += weight * k.cosine(i_signed);
                if i > 0 {
                    out[(row + 1) * m + column] += weight * k.sine(i_signed);
                }
                continue;
            }
            if i == 0 {
                out[row * m + column] += scale * k.cosine(sum);
                out[row * m + column + 1] += scale * k.sine(sum);
                continue;
            }
            let (c_minus, c_plus) = (scale * k.cosine(difference), scale * k.cosine(sum));
            let (s_minus, s_plus) = (scale * k.sine(difference), scale * k.sine(sum));
            out[row * m + column] += c_minus + c_plus;
            out[row * m + column + 1] += s_plus - s_minus;
            out[(row + 1) * m + column] += s_plus + s_minus;
            out[(row + 1) * m + column + 1] += c_minus - c_plus;
        }
    }
}
