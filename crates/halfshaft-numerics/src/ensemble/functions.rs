//! Functions over lanes, of plain arithmetic so that all processors give the same numbers.

use std::f64::consts::{FRAC_2_PI, LN_2, LOG2_E};

use super::Lanes;

/// `π/2` to 106 digits of the binary system, as the sum of two numbers.
const QUARTER_HIGH: f64 = std::f64::consts::FRAC_PI_2;
const QUARTER_LOW: f64 = 6.123_233_995_736_766e-17;

/// Added to a number below 2^51 it leaves the nearest integer in the lowest bits.
const ROUNDER: f64 = 6_755_399_441_055_744.0;

/// Taylor coefficients of `sin x / x` and of `cos x` in `x²`: up to `π/4` the first one left out is
/// below the rounding.
const SINE: [f64; 9] = reciprocal_factorials(1);
const COSINE: [f64; 10] = reciprocal_factorials(0);

/// `(-1)^k / (first + 2 k)!`.
const fn reciprocal_factorials<const N: usize>(first: usize) -> [f64; N] {
    let mut out = [1.0; N];
    let mut k = 1;
    let mut factorial = 1.0;
    let mut sign = 1.0;
    while k < N {
        factorial *= ((first + 2 * k - 1) * (first + 2 * k)) as f64;
        sign = -sign;
        out[k] = sign / factorial;
        k += 1;
    }
    out
}

/// Sine and cosine of angles up to a million, within two units of the last place of one.
#[inline(always)]
pub fn sin_cos<L: Lanes>(angle: L) -> (L, L) {
    let rounder = L::splat(ROUNDER);
    let shifted = angle.mul_add(L::splat(FRAC_2_PI), rounder);
    let quarters = shifted - rounder;
    let rest = (-quarters).mul_add(L::splat(QUARTER_HIGH), angle);
    let rest = (-quarters).mul_add(L::splat(QUARTER_LOW), rest);
    let square = rest * rest;
    let sine = rest * horner(&SINE, square);
    let cosine = horner(&COSINE, square);
    // The quadrant is in the two lowest bits: odd ones exchange the two, the upper bit is the sign.
    let odd = |value: f64| value.to_bits() & 1 != 0;
    let first = shifted.select(shifted, |bits, _| odd(bits), cosine, sine);
    let second = shifted.select(shifted, |bits, _| odd(bits), sine, cosine);
    let signed =
        |value: f64, quadrant: u64| f64::from_bits(value.to_bits() ^ ((quadrant & 2) << 62));
    let first = first.zip(shifted, |value, bits| signed(value, bits.to_bits()));
    let second = second.zip(shifted, |value, bits| signed(value, bits.to_bits().wrapping_add(1)));
    (first, second)
}

/// `ln 2`, as the sum of two numbers.
const LN_2_HIGH: f64 = LN_2;
const LN_2_LOW: f64 = 2.319_046_813_846_3e-17;

/// Taylor coefficients of the exponential: up to `ln 2 / 2` the first one left out is below the rounding.
const EXPONENTIAL: [f64; 14] = {
    let mut out = [1.0; 14];
    let mut k = 1;
    while k < 14 {
        out[k] = out[k - 1] / k as f64;
        k += 1;
    }
    out
};

/// Beyond this a hyperbolic tangent is one.
const LARGEST_TANH: f64 = 20.0;

/// Hyperbolic tangent, within two units of the last place of one.
#[inline(always)]
pub fn tanh<L: Lanes>(x: L) -> L {
    let x = x.larger(L::splat(-LARGEST_TANH)).smaller(L::splat(LARGEST_TANH));
    let (rounder, double) = (L::splat(ROUNDER), x + x);
    let shifted = double.mul_add(L::splat(LOG2_E), rounder);
    let whole = shifted - rounder;
    let rest = (-whole).mul_add(L::splat(LN_2_HIGH), double);
    let rest = (-whole).mul_add(L::splat(LN_2_LOW), rest);
    let power = scaled(horner(&EXPONENTIAL, rest), shifted);
    let one = L::splat(1.0);
    (power - one) / (power + one)
}

/// A number times two to the power of the integer in the lowest bits of another.
#[inline(always)]
fn scaled<L: Lanes>(value: L, bits: L) -> L {
    value.zip(bits, |value, whole| {
        f64::from_bits(value.to_bits().wrapping_add(whole.to_bits() << 52))
    })
}

/// A polynomial of ascending coefficients.
#[inline(always)]
fn horner<L: Lanes, const N: usize>(coefficients: &[f64; N], x: L) -> L {
    let mut sum = L::splat(coefficients[N - 1]);
    for k in (0..N - 1).rev() {
        sum = sum.mul_add(x, L::splat(coefficients[k]));
    }
    sum
}

/// The binary logarithm of positive numbers within 0.05: for lengths of steps. Of zero about -1023,
/// of what is not finite at least 1024.
#[inline(always)]
pub fn rough_log2<L: Lanes>(x: L) -> L {
    // The upper half of the bits, read as an integer, is the exponent with the mantissa behind the
    // point; half of the largest error of that chord is added.
    x.map(|value| {
        let upper = (value.to_bits() >> 32) as u32 as i32;
        f64::from(upper).mul_add(1.0 / 1_048_576.0, 0.043 - 1023.0)
    })
}

/// Two to the power of `x` (between -1000 and 1000, else cut off there) within 2e-3 of it, never zero.
#[inline(always)]
pub fn rough_exp2<L: Lanes>(x: L) -> L {
    let x = x.larger(L::splat(-1000.0)).smaller(L::splat(1000.0));
    let rounder = L::splat(ROUNDER);
    let shifted = x + rounder;
    let part = x - (shifted - rounder);
    scaled(horner(&[1.0, LN_2, 0.240_227, 0.055_504], part), shifted)
}

#[cfg(test)]
mod tests {
    use super::super::{Eight, Lanes};
    use super::{rough_exp2, rough_log2, sin_cos, tanh};

    fn for_many(mut check: impl FnMut(Eight, usize)) {
        for block in 0..4000 {
            let mut x = Eight::splat(0.0);
            for lane in 0..8 {
                x.set(lane, f64::from(8 * block + lane as i32) * 0.37 - 3000.0);
            }
            (0..8).for_each(|lane| check(x, lane));
        }
    }

    // Source: the standard library.
    #[test]
    fn sines_and_cosines_are_those_of_the_library() {
        for_many(|x, lane| {
            let (sin, cos) = sin_cos(x);
            let exact = x.get(lane).sin_cos();
            assert!((sin.get(lane) - exact.0).abs() < 2.5e-16, "{}", x.get(lane));
            assert!((cos.get(lane) - exact.1).abs() < 2.5e-16, "{}", x.get(lane));
        });
    }

    // Source: the standard library.
    #[test]
    fn hyperbolic_tangents_are_those_of_the_library() {
        for_many(|x, lane| {
            let x = x * Eight::splat(0.007);
            let exact = x.get(lane).tanh();
            assert!((tanh(x).get(lane) - exact).abs() < 4.5e-16, "{}", x.get(lane));
        });
        assert_eq!(tanh(Eight::splat(f64::INFINITY)).get(3), 1.0);
    }

    // Source: the standard library.
    #[test]
    fn logarithms_and_powers_are_near() {
        for_many(|x, lane| {
            let power = x * Eight::splat(0.1);
            let wanted = power.get(lane).exp2();
            if wanted.is_normal() {
                assert!((rough_exp2(power).get(lane) / wanted - 1.0).abs() < 2e-3);
                let back = rough_log2(Eight::splat(wanted)).get(lane);
                assert!((back - power.get(lane)).abs() < 0.05);
            }
        });
        assert!(rough_log2(Eight::splat(f64::NAN)).get(0) >= 1024.0);
        assert!(rough_log2(Eight::splat(f64::INFINITY)).get(0) >= 1024.0);
    }
}
