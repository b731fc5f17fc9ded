//! Polynomials of one variable and all their real roots.
//!
//! A [`Polynomial`] keeps its coefficients in ascending order, `p(x) = c0 + c1 x + c2 x² + ...`.
//! [`Polynomial::real_roots`] finds *every* real root, with the count settled by the sign of the
//! polynomial at its stationary points rather than by a starting guess.
//!
//! Up to degree 9 a polynomial needs no heap memory; there is no upper limit, but rounding makes
//! roots of high degrees (beyond about 20) uncertain whatever the method.

mod chebyshev;
mod first_exit;
mod horner;
mod intervals;
mod refine;
mod roots;
mod sampled;
mod scaling;

pub use first_exit::first_exit;
pub(crate) use horner::value_and_slope;
pub use sampled::{SampleError, Sampled, sampled};

use crate::small_list::SmallList;

/// Coefficients kept in place: enough for degree 9.
const INLINE_COEFFICIENTS: usize = 10;

/// A polynomial with real coefficients, in ascending order of powers.
#[derive(Debug, Clone)]
pub struct Polynomial {
    coefficients: SmallList<f64, INLINE_COEFFICIENTS>,
}

/// How a polynomial meets zero at a root.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Multiplicity {
    /// The sign changes: a root of multiplicity one, or of any odd multiplicity.
    Simple,
    /// The polynomial touches zero without changing sign, as far as rounding can tell: a root of
    /// even multiplicity, or two roots too close to be told apart.
    Double,
}

/// A real root of a polynomial.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Root {
    /// Where the polynomial is zero.
    pub value: f64,
    /// Whether it passes through zero there or touches it.
    pub multiplicity: Multiplicity,
}

impl Polynomial {
    /// The polynomial `Σ coefficients[k] xᵏ`; trailing zeros are dropped.
    ///
    /// Takes an array, a slice or a vector. An empty list is the zero polynomial.
    pub fn new(coefficients: impl AsRef<[f64]>) -> Self {
        let kept = without_trailing_zeros(coefficients.as_ref());
        Self { coefficients: SmallList::from_slice(kept) }
    }

    /// The coefficients `c0, c1, ...`, the last of them not zero; empty for the zero polynomial.
    pub fn coefficients(&self) -> &[f64] {
        self.coefficients.as_slice()
    }

    /// The highest power with a coefficient that is not zero; 0 for every constant, zero included.
    pub fn degree(&self) -> usize {
        self.coefficients().len().saturating_sub(1)
    }

    /// Whether every coefficient is zero.
    pub fn is_zero(&self) -> bool {
        self.coefficients().is_empty()
    }

    /// `p(x)` by Horner's rule.
    #[inline]
    pub fn evaluate(&self, x: f64) -> f64 {
        horner::value(self.coefficients(), x)
    }

    /// `p(x)` and a bound of the rounding error in it.
    ///
    /// The bound is the running one of Higham, *Accuracy and Stability of Numerical Algorithms*,
    /// 2nd ed., algorithm 5.1; it holds while nothing overflows or underflows.
    pub fn evaluate_with_error_bound(&self, x: f64) -> (f64, f64) {
        horner::value_and_bound(self.coefficients(), x)
    }

    /// `p(x)` and `p'(x)` in one pass.
    #[inline]
    pub fn evaluate_with_slope(&self, x: f64) -> (f64, f64) {
        value_and_slope(self.coefficients(), x)
    }

    /// `p'`.
    pub fn derivative(&self) -> Self {
        let mut result = SmallList::new();
        for (power, coefficient) in self.coefficients().iter().enumerate().skip(1) {
            result.push(coefficient * power as f64);
        }
        Self { coefficients: result }
    }

    /// The antiderivative that is zero at `x = 0`.
    pub fn antiderivative(&self) -> Self {
        let mut result = SmallList::new();
        for (power, coefficient) in self.coefficients().iter().enumerate() {
            if power == 0 {
                result.push(0.0);
            }
            result.push(coefficient / (power + 1) as f64);
        }
        Self { coefficients: result }
    }

    /// `q(d) = p(x0 + d)`: the Taylor coefficients of `p` about `x0`.
    pub fn shifted(&self, x0: f64) -> Self {
        let mut result = self.coefficients.clone();
        let taylor = result.as_mut_slice();
        // Repeated synthetic division by (x - x0): each pass leaves one more coefficient.
        for first in 0..taylor.len().saturating_sub(1) {
            for power in (first..taylor.len() - 1).rev() {
                taylor[power] += x0 * taylor[power + 1];
            }
        }
        Self { coefficients: result }
    }

    /// `factor p(x)`.
    pub fn scaled(&self, factor: f64) -> Self {
        let mut result = self.coefficients.clone();
        result.as_mut_slice().iter_mut().for_each(|coefficient| *coefficient *= factor);
        Self::new(result.as_slice())
    }

    /// `p(x) + q(x)`.
    pub fn add(&self, other: &Self) -> Self {
        let (long, short) = if self.coefficients().len() >= other.coefficients().len() {
            (self, other)
        } else {
            (other, self)
        };
        let mut result = long.coefficients.clone();
        for (sum, term) in result.as_mut_slice().iter_mut().zip(short.coefficients()) {
            *sum += term;
        }
        Self::new(result.as_slice())
    }

    /// `p(x) q(x)`.
    pub fn multiply(&self, other: &Self) -> Self {
        if self.is_zero() || other.is_zero() {
            return Self::new([]);
        }
        let mut result = SmallList::filled(self.degree() + other.degree() + 1);
        let product = result.as_mut_slice();
        for (i, a) in self.coefficients().iter().enumerate() {
            for (j, b) in other.coefficients().iter().enumerate() {
                product[i + j] += a * b;
            }
        }
        Self { coefficients: result }
    }

    /// All real roots in ascending order, each multiple root once.
    ///
    /// The number of roots is decided by the signs of the polynomial at its stationary points,
    /// which are found in the same way from the derivative: between neighbours the polynomial is
    /// monotone, so a change of sign brackets exactly one root. A stationary point where `|p|` is
    /// below [`Polynomial::ZERO_FACTOR`] rounding bounds counts as a root there: `Double` if the
    /// sign is the same on both sides, otherwise (a flat crossing, such as a triple root) `Simple`.
    ///
    /// Each simple root is accurate to the last bits that its conditioning allows. Coefficients
    /// may differ by hundreds of powers of ten.
    ///
    /// The list is empty for the zero polynomial, of which every number is a root (ask
    /// [`Polynomial::is_zero`]), and for coefficients that are not finite. Roots beyond the range
    /// of `f64` are left out.
    pub fn real_roots(&self) -> Vec<Root> {
        roots::all(self.coefficients())
    }

    /// The real roots with `a ≤ x ≤ b`, in ascending order; see [`Polynomial::real_roots`].
    ///
    /// A root that misses an end by a few units in its last place counts as lying on that end.
    pub fn real_roots_in(&self, a: f64, b: f64) -> Vec<Root> {
        let mut found = self.real_roots();
        found.retain_mut(|root| {
            let slack = END_SLACK * root.value.abs();
            let inside = a - slack <= root.value && root.value <= b + slack && a <= b;
            if inside {
                root.value = root.value.clamp(a, b);
            }
            inside
        });
        found
    }

    /// A value counts as zero at a stationary point within this many rounding bounds.
    ///
    /// More than one, because coefficients usually carry a few rounding errors of their own: a
    /// load computed to lie exactly at the top of a characteristic must not lose its root.
    pub const ZERO_FACTOR: f64 = 8.0;
}

/// Share of its own size by which a root may miss the end of an interval.
const END_SLACK: f64 = 4.0 * f64::EPSILON;

impl PartialEq for Polynomial {
    fn eq(&self, other: &Self) -> bool {
        self.coefficients() == other.coefficients()
    }
}

fn without_trailing_zeros(coefficients: &[f64]) -> &[f64] {
    let length = coefficients.iter().rposition(|&c| c != 0.0).map_or(0, |last| last + 1);
    &coefficients[..length]
}
