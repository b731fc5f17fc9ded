//! The solution inside a step, as a polynomial that every method fills in.

use super::lanes::{Lanes, WIDTH};

/// Coefficients of the polynomial for one group of components.
pub type Coefficients = [Lanes; 8];

/// The start and the length of a step.
#[derive(Debug, Clone, Copy)]
pub struct Span {
    pub(super) start: f64,
    pub(super) length: f64,
}

/// The solution inside the last accepted step.
///
/// With `s = (t - start) / length` it is
/// `c0 + s (c1 + (1-s) (c2 + s (c3 + (1-s) (c4 + s (c5 + (1-s) (c6 + s c7))))))`.
/// with the last ones zero for methods of lower order. Outside the step it extrapolates.
#[derive(Debug, Clone, Copy)]
pub struct DenseStep<'a> {
    pub(super) coefficients: &'a [Coefficients],
    pub(super) span: Span,
    pub(super) dimension: usize,
}

impl DenseStep<'_> {
    /// The times at which the step starts and ends.
    pub fn interval(&self) -> (f64, f64) {
        (self.span.start, self.span.start + self.span.length)
    }

    /// Writes the state at time `t` to `out`, as many components as fit.
    pub fn evaluate(&self, t: f64, out: &mut [f64]) {
        let share = self.share(t);
        let count = self.dimension.min(out.len());
        for (out, group) in out[..count].chunks_mut(WIDTH).zip(self.coefficients) {
            for (lane, out) in out.iter_mut().enumerate() {
                *out = value(group, lane, share);
            }
        }
    }

    /// One component of the state at time `t`. Panics, like any index, if there is no such
    /// component.
    pub fn component(&self, component: usize, t: f64) -> f64 {
        value(&self.coefficients[component / WIDTH], component % WIDTH, self.share(t))
    }

    /// The time derivative of one component at time `t`. Panics, like any index, if there is no
    /// such component.
    pub fn derivative(&self, component: usize, t: f64) -> f64 {
        let group = &self.coefficients[component / WIDTH];
        slope(group, component % WIDTH, self.share(t)) / self.span.length
    }

    fn share(&self, t: f64) -> f64 {
        (t - self.span.start) / self.span.length
    }
}

/// The nested polynomial, from the inside outwards.
#[inline]
fn value(group: &Coefficients, lane: usize, s: f64) -> f64 {
    let (mut sum, factors) = (group[7][lane], [1.0 - s, s]);
    for k in (0..7).rev() {
        sum = group[k][lane] + factors[(k + 1) % 2] * sum;
    }
    sum
}

/// The derivative of the nested polynomial with respect to `s`, carried along with its value.
fn slope(group: &Coefficients, lane: usize, s: f64) -> f64 {
    let (factors, signs) = ([1.0 - s, s], [-1.0, 1.0]);
    let (mut sum, mut slope) = (group[7][lane], 0.0);
    for k in (0..7).rev() {
        let which = (k + 1) % 2;
        slope = signs[which] * sum + factors[which] * slope;
        sum = group[k][lane] + factors[which] * sum;
    }
    slope
}
