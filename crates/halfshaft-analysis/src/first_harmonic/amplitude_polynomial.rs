//! All amplitudes under an odd polynomial law: the roots of one polynomial in `z = a²`.
//!
//! The gain is `k1 + 3/4 k3 z + 5/8 k5 z² + 35/64 k7 z³`, so that with `W(z) = α_c + β gain(z)`
//! the equation `z |W(z)|² - |γ|² = 0` has degree 3, 5 or 7 and a certified list of roots.

use halfshaft_numerics::Complex;
use halfshaft_numerics::polynomial::{Multiplicity, Polynomial};

use super::problem::Point;
use super::shaft_law::ShaftLaw;

/// Means of `cos^(2n)`, doubled, for `n` from 1 to 4: gain of `x^(2n - 1)`.
const GAINS: [f64; 4] = [1.0, 3.0 / 4.0, 5.0 / 8.0, 35.0 / 64.0];

/// Coefficients of the polynomial.
type Coefficients = [f64; 8];

/// The gain of an odd polynomial law over `z = a²`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct AmplitudePolynomial {
    gains: [f64; 4],
    /// Degree of the gain in `z`.
    degree: usize,
}

/// A local minimum of the equation's left side, over `|γ|²`, where that is above zero: two
/// responses are born when it reaches zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Approach {
    /// Amplitude, rad.
    pub(super) amplitude: f64,
    /// Least value over `|γ|²`.
    pub(super) value: f64,
}

impl AmplitudePolynomial {
    /// Of a shaft whose law is an odd polynomial without friction, its mean at zero.
    pub(super) fn of(law: &ShaftLaw) -> Option<Self> {
        let polynomial = law.law.polynomial().filter(|_| law.symmetric && law.is_plain())?;
        let k = polynomial.coefficients();
        let gains = [1, 3, 5, 7].map(|power| k[power]);
        let mut own = [0.0; 4];
        for (own, (k, gain)) in own.iter_mut().zip(gains.iter().zip(GAINS)) {
            *own = k * gain;
        }
        let degree = own.iter().rposition(|gain| *gain != 0.0).unwrap_or(0);
        Some(Self { gains: own, degree })
    }

    /// Coefficients in `z`, ascending, and their number.
    #[inline]
    fn coefficients(&self, point: &Point<Complex>) -> (Coefficients, usize) {
        let Point { alpha, beta, gamma, .. } = point;
        let first = *alpha + beta.scaled(self.gains[0]);
        let mut parts = [first; 4];
        for (part, gain) in parts.iter_mut().zip(self.gains).skip(1) {
            *part = beta.scaled(gain);
        }
        let mut out = [0.0; 8];
        for i in 0..=self.degree {
            for j in 0..=self.degree {
                out[1 + i + j] += parts[i].re * parts[j].re + parts[i].im * parts[j].im;
            }
        }
        out[0] = -(gamma.re * gamma.re + gamma.im * gamma.im);
        (out, 2 * self.degree + 2)
    }

    /// All amplitudes, ascending, and whether two of them are too close to be told apart.
    pub(super) fn amplitudes(&self, point: &Point<Complex>) -> (Vec<f64>, bool) {
        let (coefficients, count) = self.coefficients(point);
        let roots = Polynomial::new(&coefficients[..count]).real_roots();
        let positive = roots.into_iter().filter(|root| root.value > 0.0);
        let mut double = false;
        let amplitudes = positive
            .map(|root| {
                double |= root.multiplicity == Multiplicity::Double;
                root.value.sqrt()
            })
            .collect();
        (amplitudes, double)
    }

    /// How many amplitudes there are, without finding them where signs decide: by Descartes' rule,
    /// and for a cubic by its discriminant. Equals the length of
    /// [`AmplitudePolynomial::amplitudes`].
    #[inline]
    pub(super) fn count(&self, point: &Point<Complex>) -> u32 {
        let (c, count) = self.coefficients(point);
        if c[0] == 0.0 {
            return 0;
        }
        if count == 4 {
            if c[2] >= 0.0 || c[1] <= 0.0 {
                return 1;
            }
            if let Some(positive) = cubic_discriminant_is_positive(-c[0], c[1], c[2], c[3]) {
                return if positive { 3 } else { 1 };
            }
        } else if c[1..count].iter().all(|c| *c >= 0.0) {
            return u32::from(c[1..count].iter().any(|c| *c > 0.0));
        }
        #[expect(clippy::cast_possible_truncation, reason = "seven roots at most")]
        {
            self.amplitudes(point).0.len() as u32
        }
    }

    /// The local minima above zero of the equation's left side over the amplitude.
    pub(super) fn approaches(&self, point: &Point<Complex>) -> Vec<Approach> {
        let (coefficients, count) = self.coefficients(point);
        let polynomial = Polynomial::new(&coefficients[..count]);
        let slope = polynomial.derivative();
        let bend = slope.derivative();
        let stationary = slope.real_roots().into_iter().map(|root| root.value);
        stationary
            .filter(|z| *z > 0.0 && bend.evaluate(*z) > 0.0)
            .map(|z| Approach {
                amplitude: z.sqrt(),
                value: polynomial.evaluate(z) / -coefficients[0],
            })
            .filter(|approach| approach.value > 0.0)
            .collect()
    }
}

/// Whether `c3 z³ + c2 z² + c1 z - c0` has a positive discriminant; `None` where rounding leaves
/// that open.
#[inline]
fn cubic_discriminant_is_positive(c0: f64, c1: f64, c2: f64, c3: f64) -> Option<bool> {
    let terms = [
        -18.0 * c3 * c2 * c1 * c0,
        4.0 * c2 * c2 * c2 * c0,
        c2 * c2 * c1 * c1,
        -4.0 * c3 * c1 * c1 * c1,
        -27.0 * c3 * c3 * c0 * c0,
    ];
    let (mut sum, mut size) = (0.0, 0.0);
    for term in terms {
        sum += term;
        size += term.abs();
    }
    (sum.abs() > 1e-12 * size && size.is_finite()).then_some(sum > 0.0)
}
