//! A guess of the first step length (Hairer et al., section II.4).

use super::lanes::padded;
use super::norm::ErrorScale;
use crate::ode::System;

/// Below this a norm says nothing about the length.
const SMALL_NORM: f64 = 1e-5;
/// Length to start from where the norms say nothing.
const SMALL_STEP: f64 = 1e-6;

/// The state at the start with its derivative, both padded.
pub(super) struct Start<'a> {
    pub(super) time: f64,
    pub(super) state: &'a [f64],
    pub(super) rate: &'a [f64],
    /// The power of the step length with which the method's error falls.
    pub(super) power: u32,
}

/// A first step, without sign, such that its error is a small share of the tolerance if the second
/// derivative is typical of all. Evaluates the right-hand side once, after a short Euler step in
/// the given direction (1 or -1).
pub(super) fn guess<S: System>(
    system: &mut S,
    start: &Start<'_>,
    direction: f64,
    scale: &ErrorScale,
    largest: f64,
) -> f64 {
    let size = scale.norm(start.state, start.state);
    let speed = scale.norm(start.rate, start.state);
    let short =
        if size < SMALL_NORM || speed < SMALL_NORM { SMALL_STEP } else { 0.01 * size / speed }
            .min(largest);

    let (dimension, length) = (scale.dimension, padded(scale.dimension));
    let (mut moved, mut change) = (vec![0.0; length], vec![0.0; length]);
    for ((moved, state), rate) in moved.iter_mut().zip(start.state).zip(start.rate) {
        *moved = state + direction * short * rate;
    }
    let time = start.time + direction * short;
    system.derivative(time, &moved[..dimension], &mut change[..dimension]);
    for (change, rate) in change.iter_mut().zip(start.rate) {
        *change -= rate;
    }
    let bending = scale.norm(&change, start.state) / short;
    let fastest = speed.max(bending);
    let longer = if fastest <= 1e-15 {
        SMALL_STEP.max(1e-3 * short)
    } else {
        (0.01 / fastest).powf(1.0 / f64::from(start.power))
    };
    // A bending that is not finite leaves the short step; the error control shortens it further.
    let guess = if longer.is_nan() { short } else { (100.0 * short).min(longer) };
    guess.min(largest)
}
