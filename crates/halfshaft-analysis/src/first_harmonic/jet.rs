//! Complex numbers with their first two derivatives by the circular frequency.
//!
//! The condensation of a line is written once for any [`Scalar`]: with plain complex numbers where
//! only values are wanted, with jets where folds are located.

use std::ops::{Add, Div, Mul, Sub};

use halfshaft_numerics::Complex;

/// What the condensation reckons with.
pub(super) trait Scalar:
    Copy + Default + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// The value `f` with its derivatives, as far as they are kept.
    fn of(value: Complex, first: Complex, second: Complex) -> Self;

    /// The value alone.
    fn value(self) -> Complex;

    /// `factor · self` for a real factor.
    fn times(self, factor: f64) -> Self;
}

impl Scalar for Complex {
    #[inline]
    fn of(value: Complex, _: Complex, _: Complex) -> Self {
        value
    }

    #[inline]
    fn value(self) -> Complex {
        self
    }

    #[inline]
    fn times(self, factor: f64) -> Self {
        self.scaled(factor)
    }
}

/// `f`, `df/dν`, `d²f/dν²`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Jet {
    pub(super) value: Complex,
    pub(super) first: Complex,
    pub(super) second: Complex,
}

impl Scalar for Jet {
    #[inline]
    fn of(value: Complex, first: Complex, second: Complex) -> Self {
        Self { value, first, second }
    }

    #[inline]
    fn value(self) -> Complex {
        self.value
    }

    #[inline]
    fn times(self, factor: f64) -> Self {
        Self {
            value: self.value.scaled(factor),
            first: self.first.scaled(factor),
            second: self.second.scaled(factor),
        }
    }
}

impl Add for Jet {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            value: self.value + other.value,
            first: self.first + other.first,
            second: self.second + other.second,
        }
    }
}

impl Sub for Jet {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self {
            value: self.value - other.value,
            first: self.first - other.first,
            second: self.second - other.second,
        }
    }
}

impl Mul for Jet {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Self {
            value: self.value * other.value,
            first: self.first * other.value + self.value * other.first,
            second: self.second * other.value
                + (self.first * other.first).scaled(2.0)
                + self.value * other.second,
        }
    }
}

impl Div for Jet {
    type Output = Self;

    fn div(self, divisor: Self) -> Self {
        // q d = n, differentiated twice.
        let value = self.value / divisor.value;
        let first = (self.first - value * divisor.first) / divisor.value;
        let rest = self.second - (first * divisor.first).scaled(2.0) - value * divisor.second;
        Self { value, first, second: rest / divisor.value }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(a: Complex, b: Complex) {
        assert!((a - b).modulus() < 1e-13 * (1.0 + b.modulus()), "{a:?} {b:?}");
    }

    // Source: derivatives by hand of ν², i ν + 3 and of their product and quotient at ν = 2.
    #[test]
    fn products_and_quotients_have_the_derivatives_of_calculus() {
        let real = Complex::from;
        let square = Jet::of(real(4.0), real(4.0), real(2.0));
        let (i, zero) = (Complex::new(0.0, 1.0), Complex::default());
        let line = Jet::of(Complex::new(3.0, 2.0), i, zero);
        let product = square * line; // i ν³ + 3 ν²
        near(product.value, Complex::new(12.0, 8.0));
        near(product.first, Complex::new(12.0, 12.0));
        near(product.second, Complex::new(6.0, 12.0));
        let back = product / line;
        near(back.value, square.value);
        near(back.first, square.first);
        near(back.second, square.second);
        let sum = (square + line) - line.times(1.0);
        assert_eq!(sum, square);
    }
}
