//! Root bounds, and polynomials whose plain evaluation would overflow or underflow.

use super::{Root, intervals};

/// Coefficients within 2^±this (about 1e±99) need no scaling.
const SAFE_EXPONENT: i32 = 330;
/// No term of the polynomial may pass 2^this anywhere inside the root bound.
const SAFE_TERM_EXPONENT: i32 = 900;
/// Roots of the two halves of a scaled polynomial that agree to this are one root.
const SEAM: f64 = 1e-14;

/// A power of two beyond every root's modulus, unless evaluating there might overflow.
///
/// Twice Fujiwara's bound `2 max |c[n-k] / c[n]|^(1/k)`, with each quotient rounded up to a power
/// of two (M. Fujiwara, Tôhoku Math. J. 10 (1916) 167). Doubled, so that the leading term outweighs
/// all others together by three to one and the sign there is beyond doubt. First and last
/// coefficient are not zero.
pub(super) fn safe_root_bound(coefficients: &[f64]) -> Option<f64> {
    let (&leading, rest) = coefficients.split_last()?;
    let top = exponent(leading);
    let mut bound = i32::MIN;
    for (distance, &c) in rest.iter().rev().enumerate() {
        if c != 0.0 {
            // |c / leading| < 2^excess
            let excess = exponent(c) - top + 1;
            bound = bound.max(ceiling_of_quotient(excess, distance as i32 + 1));
        }
    }
    bound += 2;
    let safe = coefficients.iter().enumerate().all(|(power, &c)| {
        let e = exponent(c);
        c == 0.0
            || (e.abs() <= SAFE_EXPONENT && e + bound.max(0) * power as i32 <= SAFE_TERM_EXPONENT)
    });
    safe.then(|| power_of_two(bound))
}

/// Roots of a polynomial whose coefficients differ by more than plain evaluation can bear.
///
/// With `x = s y`, `s` chosen so that the first and last coefficients become equal in size, the
/// roots with `|y| ≤ 1` are those of the scaled polynomial `q(y)`, and the others are the
/// reciprocals of the small roots of the reversed polynomial `uⁿ q(1/u)`. On the unit interval
/// neither can overflow, and what underflows is negligible beside their constant terms.
pub(super) fn wild_roots(coefficients: &[f64]) -> Vec<Root> {
    let (Some(&constant), Some(&leading)) = (coefficients.first(), coefficients.last()) else {
        return Vec::new();
    };
    let degree = coefficients.len() as i32 - 1;
    let scale = (exponent(constant) - exponent(leading)) / degree;
    let exponent_at = |power: usize, c: f64| exponent(c) + scale * power as i32;
    let largest = coefficients
        .iter()
        .enumerate()
        .filter(|(_, c)| **c != 0.0)
        .map(|(power, &c)| exponent_at(power, c))
        .max()
        .unwrap_or(0);
    let shift = exponent(constant).max(largest - SAFE_TERM_EXPONENT);
    let mut scaled: Vec<f64> = coefficients
        .iter()
        .enumerate()
        .map(|(power, &c)| times_power_of_two(c, scale * power as i32 - shift))
        .collect();

    let mut roots = intervals::roots_within(&scaled, 2.0);
    roots.retain(|root| root.value.abs() <= 1.0 + SEAM);
    scaled.reverse();
    let outer = intervals::roots_within(&scaled, 2.0);
    roots.extend(
        outer
            .into_iter()
            .filter(|root| root.value.abs() <= 1.0)
            .map(|root| Root { value: 1.0 / root.value, ..root }),
    );
    roots.sort_by(|a, b| a.value.total_cmp(&b.value));
    roots.dedup_by(|b, a| (b.value - a.value).abs() <= 2.0 * SEAM * a.value.abs());
    for root in &mut roots {
        root.value = times_power_of_two(root.value, scale);
    }
    roots.retain(|root| root.value.is_finite() && root.value != 0.0);
    roots
}

/// `e` with `2^e ≤ |x| < 2^(e+1)`, for `x` neither zero nor subnormal.
fn exponent(x: f64) -> i32 {
    ((x.to_bits() >> 52) & 0x7ff) as i32 - 1023
}

/// `2^e`, saturating at the ends of the normal range.
fn power_of_two(e: i32) -> f64 {
    f64::from_bits(((e.clamp(-1022, 1023) + 1023) as u64) << 52)
}

/// `x 2^e` for any `e`; in three factors, because `2^e` itself may leave the range.
fn times_power_of_two(x: f64, e: i32) -> f64 {
    let third = e / 3;
    x * power_of_two(third) * power_of_two(third) * power_of_two(e - 2 * third)
}

/// `⌈a / b⌉` for positive `b`.
fn ceiling_of_quotient(a: i32, b: i32) -> i32 {
    a.div_euclid(b) + i32::from(a.rem_euclid(b) != 0)
}
