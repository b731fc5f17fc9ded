//! The polynomial law `T = k1 x + k2 x² + k3 x³ + k5 x⁵ + k7 x⁷`.
//!
//! Symbols: `x` twist in rad, `T` torque in N·m. Energy `V = ∫ T dx`. Equation (1) of Han and
//! He has `k1` and `k3` of it.

use halfshaft_numerics::polynomial::Polynomial;

/// Coefficients of a torque law by ascending power of the twist.
#[derive(Clone, Debug, PartialEq)]
pub struct PolynomialLaw {
    /// Coefficient of `x^i` at index `i`; the constant is zero.
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

    /// Potential energy `∫ T dx` from zero to `x`, J.
    #[inline]
    pub fn energy(&self, x: f64) -> f64 {
        let mut sum = 0.0;
        for power in (0..Self::COUNT).rev() {
            sum = sum * x + self.coefficients[power] / POWERS[power + 1];
        }
        sum * x
    }

    /// Whether only `k1` differs from zero.
    pub fn is_linear(&self) -> bool {
        self.coefficients[2..].iter().all(|k| *k == 0.0)
    }
}

/// The powers as numbers.
const POWERS: [f64; PolynomialLaw::COUNT + 1] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0];

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
