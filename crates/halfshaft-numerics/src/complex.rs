//! Complex numbers, as far as eigenvalues need them.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// A complex number `re + i im`.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Complex {
    /// Real part.
    pub re: f64,
    /// Imaginary part.
    pub im: f64,
}

impl Complex {
    /// `re + i im`.
    pub const fn new(re: f64, im: f64) -> Self {
        Self { re, im }
    }

    /// `modulus (cos argument + i sin argument)`.
    pub fn from_polar(modulus: f64, argument: f64) -> Self {
        let (sin, cos) = argument.sin_cos();
        Self { re: modulus * cos, im: modulus * sin }
    }

    /// The modulus `|z|`, without overflow on the way.
    pub fn modulus(self) -> f64 {
        self.re.hypot(self.im)
    }

    /// The argument of `z` in (-π, π].
    pub fn argument(self) -> f64 {
        self.im.atan2(self.re)
    }

    /// `re - i im`.
    pub fn conjugate(self) -> Self {
        Self { re: self.re, im: -self.im }
    }

    /// `exp(z)`.
    pub fn exp(self) -> Self {
        Self::from_polar(self.re.exp(), self.im)
    }

    /// `factor z` for a real factor.
    pub fn scaled(self, factor: f64) -> Self {
        Self { re: factor * self.re, im: factor * self.im }
    }
}

impl From<f64> for Complex {
    fn from(re: f64) -> Self {
        Self { re, im: 0.0 }
    }
}

impl Add for Complex {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { re: self.re + other.re, im: self.im + other.im }
    }
}

impl Sub for Complex {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self { re: self.re - other.re, im: self.im - other.im }
    }
}

impl Neg for Complex {
    type Output = Self;

    fn neg(self) -> Self {
        Self { re: -self.re, im: -self.im }
    }
}

impl Mul for Complex {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Self {
            re: self.re * other.re - self.im * other.im,
            im: self.re * other.im + self.im * other.re,
        }
    }
}

impl Div for Complex {
    type Output = Self;

    /// Smith's rule: the larger part of the divisor is divided out first, so that its square
    /// cannot overflow.
    fn div(self, divisor: Self) -> Self {
        if divisor.re.abs() >= divisor.im.abs() {
            let ratio = divisor.im / divisor.re;
            let size = divisor.re + ratio * divisor.im;
            Self { re: (self.re + ratio * self.im) / size, im: (self.im - ratio * self.re) / size }
        } else {
            let ratio = divisor.re / divisor.im;
            let size = divisor.im + ratio * divisor.re;
            Self { re: (ratio * self.re + self.im) / size, im: (ratio * self.im - self.re) / size }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Complex;
    use std::f64::consts::PI;

    fn near(a: Complex, b: Complex) -> bool {
        (a - b).modulus() <= 1e-15 * (1.0 + b.modulus())
    }

    /// Source of truth: the field axioms and Euler's formula.
    #[test]
    fn arithmetic_obeys_the_field_axioms() {
        let (a, b) = (Complex::new(1.5, -2.0), Complex::new(-0.25, 3.0));
        assert!(near((a * b) / b, a));
        assert!(near((a * b) / a, b));
        assert!(near((a + b) - b, a));
        assert!(near(a * a.conjugate(), Complex::from(a.modulus().powi(2))));
        assert!(near(-a + a, Complex::default()));
        assert!(near(Complex::new(0.0, PI).exp(), Complex::from(-1.0)));
        assert!(near(Complex::from_polar(a.modulus(), a.argument()), a));
        assert_eq!(a.scaled(2.0), a + a);
    }

    /// Source of truth: exact quotient (2e300 + 2e300 i) / (1e300 + 1e300 i) = 2.
    #[test]
    fn division_does_not_overflow() {
        let quotient = Complex::new(2e300, 2e300) / Complex::new(1e300, 1e300);
        assert!(near(quotient, Complex::from(2.0)));
    }
}
