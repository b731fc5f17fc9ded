//! Products of Taylor series over lanes, one power after the other (A. Griewank, A. Walther,
//! *Evaluating Derivatives* (2008), chapter 13).

use super::{Lanes, sin_cos};

/// Largest degree of the series.
pub const LARGEST_DEGREE: usize = 30;

/// `1 / k`; the entry of zero is never meant.
pub const RECIPROCALS: [f64; LARGEST_DEGREE + 2] = {
    let mut out = [1.0; LARGEST_DEGREE + 2];
    let mut k = 1;
    while k < out.len() {
        out[k] = 1.0 / k as f64;
        k += 1;
    }
    out
};

/// The last coefficient of a product of two series known to the same power:
/// `Σ a_j b_{k - j}` over `j = 0..=k`.
#[inline(always)]
pub fn product<L: Lanes>(a: &[L], b: &[L]) -> L {
    // Two sums, so that one is not waited for by the other. The newest coefficients of `a` come last.
    let (mut first, mut second) = (L::splat(0.0), L::splat(0.0));
    let (pairs, backwards) = (a.chunks_exact(2), b.rchunks_exact(2));
    let rest = (pairs.remainder(), backwards.remainder());
    for (a, b) in pairs.zip(backwards) {
        first = a[0].mul_add(b[1], first);
        second = a[1].mul_add(b[0], second);
    }
    if let ([a], [b]) = rest {
        first = a.mul_add(*b, first);
    }
    first + second
}

/// The last coefficient of the square of a series.
#[inline(always)]
pub fn square<L: Lanes>(a: &[L]) -> L {
    let half = a.len() / 2;
    let twice = product(&a[..half], &a[a.len() - half..]);
    let twice = twice + twice;
    if a.len().is_multiple_of(2) { twice } else { a[half].mul_add(a[half], twice) }
}

/// Value and slope at `x` of a polynomial of ascending coefficients.
#[inline(always)]
pub fn value_and_slope<L: Lanes>(coefficients: &[L], x: L) -> (L, L) {
    let (mut value, mut slope) = (L::splat(0.0), L::splat(0.0));
    for coefficient in coefficients.iter().rev() {
        slope = slope.mul_add(x, value);
        value = value.mul_add(x, *coefficient);
    }
    (value, slope)
}

/// Series of the cosine and the sine of `angle + speed τ` in `τ`.
#[inline(always)]
pub fn cosine_and_sine<L: Lanes>(angle: L, speed: L, cosine: &mut [L], sine: &mut [L]) {
    (sine[0], cosine[0]) = sin_cos(angle);
    for power in 1..cosine.len() {
        let factor = speed * L::splat(RECIPROCALS[power]);
        cosine[power] = -(factor * sine[power - 1]);
        sine[power] = factor * cosine[power - 1];
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Four, Lanes};
    use super::{cosine_and_sine, product, square, value_and_slope};

    // Source: the functions themselves, where the series have converged.
    #[test]
    fn series_are_the_functions() {
        let (mut cosine, mut sine) = ([Four::splat(0.0); 21], [Four::splat(0.0); 21]);
        let (angle, speed, t) = (0.3, 1.7, 0.4);
        cosine_and_sine(Four::splat(angle), Four::splat(speed), &mut cosine, &mut sine);
        let (value, slope) = value_and_slope(&cosine, Four::splat(t));
        let exact = (angle + speed * t).sin_cos();
        assert!((value.get(1) - exact.1).abs() < 1e-15);
        assert!((slope.get(2) + speed * exact.0).abs() < 1e-14);
        let squares: Vec<Four> = (1..=21).map(|count| square(&cosine[..count])).collect();
        let products: Vec<Four> =
            (1..=21).map(|count| product(&cosine[..count], &sine[..count])).collect();
        let of = |series: &[Four]| value_and_slope(series, Four::splat(t)).0.get(3);
        assert!((of(&squares) - exact.1 * exact.1).abs() < 1e-14);
        assert!((of(&products) - exact.1 * exact.0).abs() < 1e-14);
    }
}
