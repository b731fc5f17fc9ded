//! A function over an interval as one polynomial, from its values at Chebyshev points.
//!
//! The points are those of Clenshaw and Curtis, twice as many as a polynomial needs: the coefficients
//! beyond its degree tell how far it is from the function (L. N. Trefethen, *Approximation Theory and
//! Approximation Practice* (2013), chapters 3, 4 and 8).

use std::f64::consts::PI;

use super::Polynomial;

/// Highest degree of a polynomial: powers up to it lose few digits where the coefficients fall off.
pub(super) const DEGREE: usize = 15;
/// Intervals between the points.
const PANELS: usize = 2 * DEGREE;
/// Coefficients beyond the degree, over the largest value, up to which the polynomial is the function.
const SAME: f64 = 2e-14;
/// Coefficients over the largest value that are rounding and nothing else.
const ROUNDING: f64 = 2e-16;

/// The points of `[from, to]`, ascending; the ends and the middle are exact.
pub(super) fn points(from: f64, to: f64) -> Vec<f64> {
    let (middle, half) = (f64::midpoint(from, to), 0.5 * (to - from));
    let mut points: Vec<f64> = (0..=PANELS).map(|k| middle - half * cosine(k)).collect();
    (points[0], points[DEGREE], points[PANELS]) = (from, middle, to);
    points
}

/// `cos(π k / PANELS)`, mirrored exactly about the middle.
fn cosine(k: usize) -> f64 {
    let turn = |k: usize| (PI * k as f64 / PANELS as f64).cos();
    match k % (2 * PANELS) {
        k if 2 * k == PANELS || 2 * k == 3 * PANELS => 0.0,
        k if 2 * k < PANELS => turn(k),
        k if k <= PANELS => -turn(PANELS - k),
        k => cosine(2 * PANELS - k),
    }
}

/// The polynomial, over the distance from the middle, through the values at [`points`]; `None` where the
/// function is not smooth enough for one.
pub(super) fn fitted(from: f64, to: f64, values: &[f64]) -> Option<Polynomial> {
    let largest = values.iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
    let series: Vec<f64> = (0..=PANELS).map(|degree| coefficient(values, degree)).collect();
    let (kept, beyond) = series.split_at(DEGREE + 1);
    if beyond.iter().any(|c| c.abs() > SAME * largest + rounding(from, to, values)) {
        return None;
    }
    let length = kept.iter().rposition(|c| c.abs() > ROUNDING * largest).map_or(0, |last| last + 1);
    let unit = through_ends(powers(&kept[..length]), values[0], values[PANELS]);
    let half = 0.5 * (to - from);
    let mut width = 1.0;
    let scaled = unit.iter().map(|c| {
        let scaled = c / width;
        width *= half;
        scaled
    });
    Some(Polynomial::new(scaled.collect::<Vec<f64>>()))
}

/// What the rounding of the arguments makes of the values, about.
fn rounding(from: f64, to: f64, values: &[f64]) -> f64 {
    let points = points(from, to);
    let steps = points.windows(2).zip(values.windows(2));
    let slopes = steps.map(|(x, v)| ((v[1] - v[0]) / (x[1] - x[0])).abs());
    4.0 * f64::EPSILON * from.abs().max(to.abs()) * slopes.fold(0.0, f64::max)
}

/// Coefficient of the Chebyshev polynomial of a degree.
fn coefficient(values: &[f64], degree: usize) -> f64 {
    let end = |k: usize| if k == 0 || k == PANELS { 0.5 } else { 1.0 };
    // The points ascend: the first of them is at the cosine of half a turn. From both ends to the middle,
    // so that what is odd or even comes out so.
    let sign = if degree.is_multiple_of(2) { 1.0 } else { -1.0 };
    let pair = |k: usize| end(k) * cosine(k * degree) * (sign * values[k] + values[PANELS - k]);
    let middle = cosine(DEGREE * degree) * values[DEGREE];
    let sum: f64 = (0..DEGREE).map(pair).sum();
    2.0 / PANELS as f64 * end(degree) * (sum + middle)
}

/// A Chebyshev series as powers.
fn powers(series: &[f64]) -> Vec<f64> {
    let mut result = vec![0.0; series.len().max(2)];
    let (mut before, mut here) = (vec![0.0; series.len() + 1], vec![0.0; series.len() + 1]);
    here[0] = 1.0;
    for (degree, factor) in series.iter().enumerate() {
        result.iter_mut().zip(&here).for_each(|(sum, c)| *sum += factor * c);
        // T₁ = x T₀, then T_{n+1} = 2 x T_n - T_{n-1}.
        let twice = if degree == 0 { 1.0 } else { 2.0 };
        let mut next: Vec<f64> = before.iter().map(|c| -c).collect();
        next.iter_mut().skip(1).zip(&here).for_each(|(sum, c)| *sum += twice * c);
        before = std::mem::replace(&mut here, next);
    }
    result
}

/// A polynomial on `[-1, 1]` moved, by rounding only, to given values at its ends: so pieces join.
fn through_ends(mut powers: Vec<f64>, first: f64, last: f64) -> Vec<f64> {
    let even: f64 = powers.iter().step_by(2).sum();
    let odd: f64 = powers.iter().skip(1).step_by(2).sum();
    powers[0] += f64::midpoint(first, last) - even;
    powers[1] += 0.5 * (last - first) - odd;
    powers
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(from: f64, to: f64, function: impl Fn(f64) -> f64) -> Option<Polynomial> {
        fitted(from, to, &points(from, to).into_iter().map(function).collect::<Vec<f64>>())
    }

    // Source: the polynomial itself.
    #[test]
    fn a_polynomial_comes_back() {
        let known = Polynomial::new([1.0, -2.0, 0.5, 3.0, 0.0, -0.25]);
        let found = of(-3.0, 1.0, |x| known.evaluate(x)).expect("of low degree").shifted(1.0);
        for (a, b) in found.coefficients().iter().zip(known.coefficients()) {
            assert!((a - b).abs() < 2e-13, "{found:?}");
        }
    }

    // Source: the exponential function.
    #[test]
    fn a_smooth_function_is_met_to_rounding_between_the_points() {
        let found = of(0.5, 2.0, f64::exp).expect("entire");
        for k in 0..100 {
            let x = 0.5 + 1.5 * f64::from(k) / 99.0;
            let (value, slope) = found.evaluate_with_slope(x - 1.25);
            assert!((value / x.exp() - 1.0).abs() < 4e-15, "{x}: {value}");
            assert!((slope / x.exp() - 1.0).abs() < 4e-13, "{x}: {slope}");
        }
    }

    #[test]
    fn kinks_and_narrow_peaks_are_no_polynomial() {
        assert!(of(-1.0, 2.0, f64::abs).is_none());
        assert!(of(-1.0, 1.0, |x| 1.0 / (1.0 + 25.0 * x * x)).is_none());
    }

    // Source: symmetry.
    #[test]
    fn what_is_odd_has_odd_powers_only() {
        let found = of(-1.5, 1.5, f64::sinh).expect("entire");
        assert!(found.coefficients().iter().step_by(2).all(|c| *c == 0.0), "{found:?}");
    }
}
