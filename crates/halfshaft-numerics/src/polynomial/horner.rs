//! Horner's rule, alone, with its rounding bound, and with derivatives.
//!
//! Products and sums stay separate: a fused multiply-add is a library call on processors for which
//! the program was not specially compiled, and costs more than it saves.

/// Largest relative error of one rounding.
const UNIT_ROUNDOFF: f64 = 0.5 * f64::EPSILON;

/// `p(x)`.
#[inline]
pub(super) fn value(coefficients: &[f64], x: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

/// `p(x)` and the running bound of its rounding error (Higham, algorithm 5.1).
#[inline]
pub(super) fn value_and_bound(coefficients: &[f64], x: f64) -> (f64, f64) {
    let Some((&leading, rest)) = coefficients.split_last() else {
        return (0.0, 0.0);
    };
    let size = x.abs();
    let mut sum = leading;
    let mut bound = 0.5 * leading.abs();
    for &c in rest.iter().rev() {
        sum = sum * x + c;
        bound = bound * size + sum.abs();
    }
    (sum, UNIT_ROUNDOFF * (2.0 * bound - sum.abs()))
}

/// `p(x)` and `p'(x)`.
#[inline]
pub(crate) fn value_and_slope(coefficients: &[f64], x: f64) -> (f64, f64) {
    let (mut value, mut slope) = (0.0, 0.0);
    for &c in coefficients.iter().rev() {
        slope = slope * x + value;
        value = value * x + c;
    }
    (value, slope)
}

/// The Taylor coefficients `p(x)`, `p'(x)`, `p''(x) / 2`, `p'''(x) / 6`.
#[inline]
pub(super) fn taylor(coefficients: &[f64], x: f64) -> [f64; 4] {
    let mut t = [0.0; 4];
    for &c in coefficients.iter().rev() {
        t[3] = t[3] * x + t[2];
        t[2] = t[2] * x + t[1];
        t[1] = t[1] * x + t[0];
        t[0] = t[0] * x + c;
    }
    t
}
