//! One root of a monotone piece, to the last bits.
//!
//! Laguerre's and Halley's iterations, kept inside the bracket: both converge cubically, and from
//! far away the first lands near the root where Newton's would creep. A step that leaves the
//! bracket or does not pay is replaced by halving, in turn on a linear and on a logarithmic scale,
//! so that no bracket, however wide, takes more than about 130 steps.

use super::horner;
use super::intervals::Node;

/// No bracket can be halved as often as this.
const HALVING_LIMIT: usize = 300;
/// A step must be at most this share of the one before, or the bracket is halved instead.
const SHRINKING: f64 = 0.5;
/// Halley's step is taken when the slope changes by less than this share on the way to the root.
const SLIGHT_BENDING: f64 = 0.25;
/// A step by at least this share of the root's size is never the last: what is left of it when the
/// root is subtracted may have lost digits.
const LONG_STEP: f64 = 0.1;
/// The error that remains after the last step, as a share of the root, is estimated to be below
/// this.
const LAST_BITS: f64 = 0.125 * f64::EPSILON;

/// The root between two nodes of opposite sign.
pub(super) fn refine(level: &[f64], lower: Node, upper: Node) -> f64 {
    let guess = starting_point(level, &lower, &upper);
    let mut bracket = Bracket { level, lower, upper };
    if bracket.contains(0.0) {
        if level[0] == 0.0 {
            return 0.0;
        }
        // Brackets of one sign can be halved on a logarithmic scale.
        bracket.shrink(0.0, level[0]);
    }
    bracket.iterate(guess)
}

/// An interval in which the sign changes once.
struct Bracket<'a> {
    level: &'a [f64],
    lower: Node,
    upper: Node,
}

impl Bracket<'_> {
    fn contains(&self, x: f64) -> bool {
        x > self.lower.x && x < self.upper.x
    }

    /// Moves the end with the same sign as the value to `x`.
    fn shrink(&mut self, x: f64, value: f64) {
        let lower_end = (value < 0.0) == (self.lower.sign < 0);
        let end = if lower_end { &mut self.lower } else { &mut self.upper };
        (end.x, end.value) = (x, value);
    }

    /// Steps of third order from the guess, or from the best place if it lies outside.
    fn iterate(&mut self, guess: f64) -> f64 {
        let order = (self.level.len() - 1) as f64;
        let mut x = self.first_place(guess);
        let mut previous = f64::INFINITY;
        for halvings in 1..HALVING_LIMIT {
            // Steps while they pay; each is at most half of the one before, so they come to an end.
            loop {
                let taylor = horner::taylor(self.level, x);
                if taylor[0] == 0.0 {
                    return x;
                }
                self.shrink(x, taylor[0]);
                let Proposal { step, to_come } = third_order_step(order, taylor);
                let (next, size) = (x - step, step.abs());
                let last = to_come <= LAST_BITS * next.abs() && size <= LONG_STEP * next.abs();
                if size <= f64::EPSILON * x.abs() || (last && self.contains(next)) {
                    return next.clamp(self.lower.x, self.upper.x);
                }
                if !(self.contains(next) && size <= SHRINKING * previous) {
                    break;
                }
                (previous, x) = (size, next);
            }
            // Either far from the root or so close that rounding decides the step.
            let (value, bound) = horner::value_and_bound(self.level, x);
            if value.abs() <= bound {
                return x;
            }
            (previous, x) = (f64::INFINITY, self.middle(halvings % 2 == 0));
            if !self.contains(x) {
                break;
            }
        }
        let lower_end = self.lower.value.abs() < self.upper.value.abs();
        if lower_end { self.lower.x } else { self.upper.x }
    }

    fn first_place(&self, guess: f64) -> f64 {
        if self.contains(guess) {
            return guess;
        }
        let beside = from_zero(self.level, self.lower.x + self.upper.x);
        if self.contains(beside) { beside } else { self.middle(false) }
    }

    /// The middle of the bracket, which does not contain zero inside, linear or logarithmic.
    fn middle(&self, logarithmic: bool) -> f64 {
        let (lower, upper) = (self.lower.x, self.upper.x);
        if logarithmic {
            // For numbers of one sign the order of the bit patterns is the order of the numbers.
            let bits = (lower.abs().to_bits() + upper.abs().to_bits()) / 2;
            f64::from_bits(bits).copysign(lower + upper)
        } else {
            lower + 0.5 * (upper - lower)
        }
    }
}

/// A step of a method of third order.
struct Proposal {
    /// To be subtracted; infinite or NaN at a stationary point.
    step: f64,
    /// About the error that remains after the step; infinite while far from the root.
    to_come: f64,
}

/// With `r = p/p'` and the Taylor coefficients `a2 = p''/2p'`, `a3 = p'''/6p'`: Laguerre's
/// `n r / (1 + √((n-1) (n-1 - 2 n r a2)))`, or Newton's `r` where the radicand is of no use, while
/// the slope changes much between here and the root. After that Halley's `r / (1 - r a2)`, which
/// needs no root and leaves the error `(a2² - a3) r³` (W. Gander, Am. Math. Monthly 92 (1985) 131).
#[inline]
fn third_order_step(order: f64, [value, slope, second, third]: [f64; 4]) -> Proposal {
    let inverse = 1.0 / slope;
    let newton = value * inverse;
    let half_bending = newton * (second * inverse);
    if half_bending.abs() < 0.5 * SLIGHT_BENDING {
        let twisting = (newton * newton * (third * inverse)).abs();
        let to_come = newton.abs() * (half_bending * half_bending + twisting);
        return Proposal { step: newton / (1.0 - half_bending), to_come };
    }
    let radicand = (order - 1.0) * (order - 1.0 - 2.0 * order * half_bending);
    // An infinite radicand would make a step of zero, as if the root were here.
    let usable = (0.0..f64::INFINITY).contains(&radicand);
    let step = if usable { order * newton / (1.0 + radicand.sqrt()) } else { newton };
    Proposal { step, to_come: f64::INFINITY }
}

/// A guess from the nearest extrema; NaN without one.
#[inline]
fn starting_point(level: &[f64], lower: &Node, upper: &Node) -> f64 {
    match (lower.stationary, upper.stationary) {
        (true, true) => {
            let (low, high) = (lower.value.abs(), upper.value.abs());
            let width = upper.x - lower.x;
            if low <= high {
                lower.x + width * inverse_smooth_step(low / (low + high))
            } else {
                upper.x - width * inverse_smooth_step(high / (low + high))
            }
        }
        (true, false) => lower.x + parabolic_distance(level, lower),
        (false, true) => upper.x - parabolic_distance(level, upper),
        (false, false) => f64::NAN,
    }
}

/// How far from an extremum the parabola that fits there is zero.
#[inline]
fn parabolic_distance(level: &[f64], extremum: &Node) -> f64 {
    let [_, _, half_curvature, _] = horner::taylor(level, extremum.x);
    (extremum.value / half_curvature).abs().sqrt()
}

/// A guess between zero and an end: where the tangent at zero leads, but no further than where, if
/// the end is the bound of all roots, the leading term takes over.
fn from_zero(level: &[f64], end: f64) -> f64 {
    let furthest = 0.25 * end;
    let linear = -level[0] / level[1];
    if linear * furthest > 0.0 && linear.abs() < furthest.abs() { linear } else { furthest }
}

/// `t` in [0, 1/2] with `3 t² - 2 t³ ≈ s`, for `s` in [0, 1/2]: exact at both ends.
fn inverse_smooth_step(s: f64) -> f64 {
    let w = (s / 3.0).sqrt();
    w * (1.0 + w * (1.0 / 3.0 + 0.533 * w))
}
