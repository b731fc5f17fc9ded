//! The polynomial law `T = k0 + k1 x + k2 x² + k3 x³ + k5 x⁵ + k7 x⁷`.
//!
//! Symbols: `x` twist in rad, `T` torque in N·m, `k0` the preload. Energy `V = ∫ T dx`. Equation (1)
//! of Han and He has `k1` and `k3` of it.

use halfshaft_numerics::polynomial::Polynomial;

use super::describing::DescribingFunction;

/// Coefficients of a torque law by ascending power of the twist.
#[derive(Clone, Debug, PartialEq)]
pub struct PolynomialLaw {
    /// Coefficient of `x^i` at index `i`; the constant is a preload.
    coefficients: [f64; Self::COUNT],
}

impl PolynomialLaw {
    /// Number of coefficients: powers 0 to 7.
    pub const COUNT: usize = 8;

    /// A law of the given coefficients, ascending from the constant.
    pub fn new(coefficients: [f64; Self::COUNT]) -> Self {
        Self { coefficients }
    }

    /// The coefficients, ascending from the constant.
    pub fn coefficients(&self) -> &[f64; Self::COUNT] {
        &self.coefficients
    }

    /// The law as a polynomial of the twist.
    pub fn polynomial(&self) -> Polynomial {
        Polynomial::new(self.coefficients)
    }

    /// Torque at twist `x`, N·m.
    #[inline]
    pub fn torque(&self, x: f64) -> f64 {
        self.coefficients.iter().rev().fold(0.0, |sum, k| sum * x + k)
    }

    /// Tangent stiffness `dT/dx` at twist `x`, N·m/rad.
    #[inline]
    pub fn stiffness(&self, x: f64) -> f64 {
        let mut sum = 0.0;
        for power in (1..Self::COUNT).rev() {
            sum = sum * x + POWERS[power] * self.coefficients[power];
        }
        sum
    }

    /// `d²T/dx²` at twist `x`, N·m/rad².
    #[inline]
    pub fn curvature(&self, x: f64) -> f64 {
        let mut sum = 0.0;
        for power in (2..Self::COUNT).rev() {
            sum = sum * x + POWERS[power] * POWERS[power - 1] * self.coefficients[power];
        }
        sum
    }

    /// Potential energy `∫ T dx` from zero to `x`, J.
    #[inline]
    pub fn energy(&self, x: f64) -> f64 {
        let mut sum = 0.0;
        for power in (0..Self::COUNT).rev() {
            sum = sum * x + self.coefficients[power] / POWERS[power + 1];
        }
        sum * x
    }

    /// Whether the tangent stiffness is the same everywhere: a preload and `k1` only.
    pub fn is_linear(&self) -> bool {
        self.coefficients[2..].iter().all(|k| *k == 0.0)
    }

    /// Whether `T(-x) = -T(x)`.
    pub fn is_odd(&self) -> bool {
        self.coefficients.iter().step_by(2).all(|k| *k == 0.0)
    }

    /// The describing function, in closed form: with `a_n` the Taylor coefficients about the mean,
    /// `⟨T⟩ = Σ a_2n A^2n ⟨cos^2n⟩` and `gain = 2 Σ a_2n+1 A^2n ⟨cos^2n+2⟩`.
    pub fn describing_function(&self, mean: f64, amplitude: f64) -> DescribingFunction {
        let taylor = self.about(mean);
        let square = amplitude * amplitude;
        let mut result = DescribingFunction::default();
        // A^(2n) and A^(2n - 1).
        let (mut even, mut odd) = (1.0, 0.0);
        for n in 0..Self::COUNT / 2 {
            let (low, high) = (2 * n, 2 * n + 1);
            let (cosine, next) = (EVEN_COSINES[n], EVEN_COSINES[n + 1]);
            result.mean_torque += taylor[low] * even * cosine;
            result.gain += 2.0 * taylor[high] * even * next;
            result.mean_by_mean += POWERS[high] * taylor[high] * even * cosine;
            result.mean_by_amplitude += POWERS[low] * taylor[low] * odd * cosine;
            if high + 1 < Self::COUNT {
                result.gain_by_mean += 2.0 * POWERS[high + 1] * taylor[high + 1] * even * next;
            }
            result.gain_by_amplitude += 2.0 * POWERS[low] * taylor[high] * odd * next;
            odd = even * amplitude;
            even *= square;
        }
        result
    }

    /// Taylor coefficients about `x0`, by repeated synthetic division.
    fn about(&self, x0: f64) -> [f64; Self::COUNT] {
        let mut taylor = self.coefficients;
        if x0 != 0.0 {
            for first in 0..Self::COUNT - 1 {
                for power in (first..Self::COUNT - 1).rev() {
                    taylor[power] += x0 * taylor[power + 1];
                }
            }
        }
        taylor
    }
}

/// The powers as numbers.
const POWERS: [f64; PolynomialLaw::COUNT + 1] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0];

/// Averages of `cos^2n φ`: `(2n)! / (4^n n!²)`.
const EVEN_COSINES: [f64; 5] = [1.0, 0.5, 0.375, 0.3125, 0.273_437_5];

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::{any, prop_assert, proptest};

    fn law() -> PolynomialLaw {
        PolynomialLaw::new([0.0, 6420.0, 50.0, -642.0, 0.0, 12.0, 0.0, -1.5])
    }

    // Source: the law is odd but for k2, and written out by hand.
    #[test]
    fn the_law_is_the_written_polynomial() {
        let x = 0.7_f64;
        let by_hand =
            6420.0 * x + 50.0 * x.powi(2) - 642.0 * x.powi(3) + 12.0 * x.powi(5) - 1.5 * x.powi(7);
        assert!((law().torque(x) - by_hand).abs() < 1e-12 * by_hand.abs());
    }

    // Source: the gain of k1 x + k3 x³ is k1 + (3/4) k3 A², as in any book.
    #[test]
    fn a_cubic_law_has_three_quarters_of_its_coefficient() {
        let law = PolynomialLaw::new([0.0, 5.0, 0.0, 8.0, 0.0, 0.0, 0.0, 0.0]);
        let found = law.describing_function(0.0, 0.5);
        assert!((found.gain - (5.0 + 0.75 * 8.0 * 0.25)).abs() < 1e-14);
    }

    proptest! {
        // Source: central differences of energy and torque, whose error falls as h².
        #[test]
        fn derivatives_agree_with_differences(x in -2.0..2.0_f64, _seed in any::<u8>()) {
            let h = 1e-4;
            let slope = (law().torque(x + h) - law().torque(x - h)) / (2.0 * h);
            prop_assert!((slope - law().stiffness(x)).abs() < 1e-4 * 6420.0);
            let slope = (law().energy(x + h) - law().energy(x - h)) / (2.0 * h);
            prop_assert!((slope - law().torque(x)).abs() < 1e-4 * 6420.0);
        }
    }
}
