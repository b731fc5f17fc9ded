//! Values and slopes of power series in many numbers at once, by Horner's rule.

use super::structure::sum;

/// Powers of time that are summed at once.
pub(super) const TOGETHER: usize = 4;

/// The terms of as many powers as are summed at once, each of `size` numbers; `None` where there are
/// fewer.
#[inline(always)]
pub(super) fn split(terms: &[f64], size: usize) -> Option<[&[f64]; TOGETHER]> {
    if terms.len() != TOGETHER * size {
        return None;
    }
    let (low, high) = terms.split_at(2 * size);
    let ((first, second), (third, fourth)) = (low.split_at(size), high.split_at(size));
    Some([first, second, third, fourth])
}

/// A step of Horner's rule down to the next power, for values and their slopes.
#[inline(always)]
pub(super) fn horner<const FUSED: bool>(
    step: f64,
    values: &mut [f64],
    slopes: &mut [f64],
    terms: &[f64],
) {
    for ((value, slope), term) in values.iter_mut().zip(slopes).zip(terms) {
        *slope = sum::<FUSED>(step, *slope, *value);
        *value = sum::<FUSED>(step, *value, *term);
    }
}

/// Four such steps, down to the first of the powers.
#[inline(always)]
pub(super) fn horner_of_four<const FUSED: bool>(
    step: f64,
    values: &mut [f64],
    slopes: &mut [f64],
    [a, b, c, d]: [&[f64]; TOGETHER],
) {
    let terms = a.iter().zip(b).zip(c.iter().zip(d));
    for ((value, slope), ((a, b), (c, d))) in values.iter_mut().zip(slopes).zip(terms) {
        let (mut v, mut s) = (*value, *slope);
        for term in [d, c, b, a] {
            s = sum::<FUSED>(step, s, v);
            v = sum::<FUSED>(step, v, *term);
        }
        (*value, *slope) = (v, s);
    }
}
