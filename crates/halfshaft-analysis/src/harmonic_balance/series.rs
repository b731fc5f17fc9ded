//! Taylor series in time of the tangent stiffness and damping of a connection along an orbit.

use halfshaft_dynamics::laws::{Friction, Piece};
use halfshaft_numerics::harmonics::HarmonicSet;

/// Highest power of time that has a place.
pub(super) const MOST: usize = 40;

/// Coefficients by power of time.
pub(super) type Series = [f64; MOST + 1];

/// How far series go, and when a step's last terms are nothing beside its first.
#[derive(Clone, Copy, Debug)]
pub(super) struct Truncation {
    /// Highest power of time that is kept, at most [`MOST`].
    pub(super) degree: usize,
    pub(super) rounding: f64,
}

impl Truncation {
    /// For few columns, where the series of the tangents cost more than those of the columns.
    pub(super) const SHORT: Self = Self { degree: 20, rounding: 1e-12 };
    /// For many: a power of time costs as much as any other, and a step grows faster than their
    /// number.
    pub(super) const LONG: Self = Self { degree: MOST, rounding: 1e-11 };
}

/// Taylor coefficients in time of the waves of a set of harmonics, the same for all twists.
pub(super) struct Waves {
    /// Of the cosine and the sine of each order.
    series: Vec<(Series, Series)>,
    degree: usize,
}

impl Waves {
    pub(super) fn new(set: &HarmonicSet) -> Self {
        Self { series: vec![([0.0; MOST + 1], [0.0; MOST + 1]); set.orders().len()], degree: 0 }
    }

    /// Expands them about time `t`, with a fundamental of `speed`.
    #[inline(always)]
    pub(super) fn about(&mut self, set: &HarmonicSet, speed: f64, t: f64, degree: usize) {
        self.degree = degree;
        let (sin1, cos1) = (speed * t).sin_cos();
        let (mut sine, mut cosine) = (0.0, 1.0);
        let mut at = 0;
        for ((order, _), (cosines, sines)) in set.places().zip(&mut self.series) {
            while at < order {
                (sine, cosine) = (sine * cos1 + cosine * sin1, cosine * cos1 - sine * sin1);
                at += 1;
            }
            let nu = order as f64 * speed;
            // Each two powers on the sign changes.
            let (mut c, mut s) = (cosine, sine);
            for (power, (cosines, sines)) in
                cosines.iter_mut().zip(sines).enumerate().take(degree + 1)
            {
                (*cosines, *sines) = (c, s);
                let factor = nu * INVERSE[power + 1];
                (c, s) = (-factor * s, factor * c);
            }
        }
    }

    /// The series of a twist with the given coefficients.
    #[inline(always)]
    pub(super) fn sum(&self, set: &HarmonicSet, coefficients: &[f64], out: &mut Series) {
        let (known, beyond) = out.split_at_mut(self.degree + 1);
        beyond.fill(0.0);
        self.sums::<1>(set, coefficients.as_chunks().0, known.as_chunks_mut().0);
    }

    /// The series of several twists side by side, as many terms as `out` has rows.
    #[inline(always)]
    pub(super) fn sums<const N: usize>(
        &self,
        set: &HarmonicSet,
        coefficients: &[[f64; N]],
        out: &mut [[f64; N]],
    ) {
        out.fill([0.0; N]);
        for ((order, place), (cosines, sines)) in set.places().zip(&self.series) {
            if order == 0 {
                out[0] = coefficients[place];
                continue;
            }
            let (a, b) = (&coefficients[place], &coefficients[place + 1]);
            for (out, (cosine, sine)) in out.iter_mut().zip(cosines.iter().zip(sines)) {
                for lane in 0..N {
                    out[lane] += a[lane] * cosine + b[lane] * sine;
                }
            }
        }
    }
}

/// `1 / k`.
pub(super) const INVERSE: [f64; MOST + 2] = {
    let mut list = [0.0; MOST + 2];
    let mut k = 1;
    while k < list.len() {
        list[k] = 1.0 / k as f64;
        k += 1;
    }
    list
};

/// The tangent stiffness `P'(x - origin)` of a piece of a law along the twist `x`.
#[inline(always)]
pub(super) fn stiffness(piece: &Piece, x: &Series, degree: usize, out: &mut Series) {
    out.fill(0.0);
    let coefficients = piece.torque.coefficients();
    let mut shifted = *x;
    shifted[0] -= piece.origin;
    let mut powers = coefficients.iter().enumerate().skip(1).rev();
    if let Some((power, k)) = powers.next() {
        out[0] = power as f64 * k;
    }
    for (power, k) in powers {
        *out = product(out, &shifted, degree);
        out[0] += power as f64 * k;
    }
}

/// The slope of regularised friction along the rate of twist, given the twist.
pub(super) fn friction_slope(friction: &Friction, x: &Series, degree: usize, out: &mut Series) {
    let mut w = [0.0; MOST + 1];
    for power in 0..degree {
        w[power] = (power + 1) as f64 * x[power + 1] / friction.speed_rad_s;
    }
    // tanh' = (1 - tanh²) w'.
    let mut tanh = [0.0; MOST + 1];
    let mut slope = [0.0; MOST + 1];
    tanh[0] = w[0].tanh();
    slope[0] = (1.0 - tanh[0]) * (1.0 + tanh[0]);
    for k in 0..degree {
        let mut sum = 0.0;
        for i in 0..=k {
            sum += slope[i] * (k - i + 1) as f64 * w[k - i + 1];
        }
        tanh[k + 1] = sum * INVERSE[k + 1];
        slope[k + 1] = -(0..=k + 1).map(|i| tanh[i] * tanh[k + 1 - i]).sum::<f64>();
    }
    let scale = friction.torque_nm / friction.speed_rad_s;
    out.iter_mut().zip(slope).for_each(|(out, slope)| *out = scale * slope);
}

#[inline(always)]
fn product(a: &Series, b: &Series, degree: usize) -> Series {
    let mut out = [0.0; MOST + 1];
    let length = 1 + b.iter().rposition(|value| *value != 0.0).unwrap_or(0);
    let last = 1 + a.iter().rposition(|value| *value != 0.0).unwrap_or(0);
    for (i, factor) in a[..last].iter().enumerate() {
        let room = (degree + 1).saturating_sub(i).min(length);
        for (out, value) in out[i..i + room].iter_mut().zip(&b[..room]) {
            *out += factor * value;
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(series: &Series, t: f64) -> f64 {
        series.iter().rev().fold(0.0, |sum, c| sum * t + c)
    }

    // Source: the functions themselves, at a time at which the series has converged.
    #[test]
    fn expansions_are_the_functions() {
        let set = HarmonicSet::all(3);
        let x = [0.3, 1.0, -0.4, 0.0, 0.2, 0.05, -0.1];
        let (speed, t, dt) = (2.0, 0.7, 0.08);
        let mut series = [0.0; MOST + 1];
        let mut waves = Waves::new(&set);
        waves.about(&set, speed, t, MOST);
        waves.sum(&set, &x, &mut series);
        let exact = set.evaluate(&x, speed * (t + dt));
        assert!((value(&series, dt) - exact.0).abs() < 1e-14);
        let piece = Piece {
            from: f64::NEG_INFINITY,
            to: f64::INFINITY,
            origin: 0.1,
            torque: halfshaft_numerics::polynomial::Polynomial::new([0.0, 3.0, 0.0, -2.0]),
        };
        let mut k = [0.0; MOST + 1];
        stiffness(&piece, &series, MOST, &mut k);
        let by_hand = 3.0 - 6.0 * (exact.0 - 0.1).powi(2);
        assert!((value(&k, dt) - by_hand).abs() < 1e-13);
        let friction = Friction { torque_nm: 2.0, speed_rad_s: 5.0 };
        let mut slope = [0.0; MOST + 1];
        friction_slope(&friction, &series, MOST, &mut slope);
        let by_hand = friction.slope(speed * exact.1);
        assert!((value(&slope, dt) - by_hand).abs() < 1e-9, "{} {by_hand}", value(&slope, dt));
    }
}
