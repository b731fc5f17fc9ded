//! One step of a batch by an explicit Runge-Kutta pair.

use std::marker::PhantomData;

use super::functions::{rough_exp2, rough_log2};
use super::pairs::{Coefficients, LARGEST_STAGES, weighted};
use super::stepper::{Pass, Stepper, put, take};
use super::{LaneSystem, Lanes, Settings};

/// A step that would leave less than this share of itself to the goal is stretched to reach it.
const STRETCH: f64 = 1.01;
/// A step must move the time by at least this share of it.
const LEAST_SHARE: f64 = 4.0 * f64::EPSILON;
/// Share of the step length at which the error would just pass that is really used.
const SAFETY: f64 = 0.9;
/// Limits of the ratio of two steps that follow each other.
const SMALLEST_FACTOR: f64 = 1.0 / 3.0;
const LARGEST_FACTOR: f64 = 6.0;
/// A first step without any hint, as a share of the unit of time.
const SMALL_STEP: f64 = 1e-6;

/// The trajectories of a batch.
pub(super) struct RungeKutta<'s, Y, P, L> {
    system: &'s Y,
    pair: PhantomData<P>,
    relative: f64,
    absolute: Vec<f64>,
    largest_step: f64,
    fixed: bool,
    time: L,
    state: Vec<L>,
    parameters: Vec<L>,
    /// Length of the next step; zero where it has still to be guessed.
    next: L,
    /// Whether any lane has its next step still to be guessed.
    fresh: bool,
    /// Stage derivatives of each component; of stage 0 at all times.
    slopes: Vec<[L; LARGEST_STAGES]>,
    argument: Vec<L>,
    rate: Vec<L>,
}

impl<'s, Y: LaneSystem, P: Coefficients, L: Lanes> RungeKutta<'s, Y, P, L> {
    pub(super) fn new(system: &'s Y, settings: &Settings) -> Self {
        let dimension = system.dimension();
        let zero = L::splat(0.0);
        let zeros = vec![zero; dimension];
        Self {
            system,
            pair: PhantomData,
            relative: settings.relative_tolerance,
            absolute: (0..dimension).map(|k| settings.absolute_tolerance.of(k)).collect(),
            largest_step: settings.fixed_step.unwrap_or(settings.largest_step),
            fixed: settings.fixed_step.is_some(),
            time: zero,
            state: zeros.clone(),
            parameters: vec![zero; system.parameters()],
            next: zero,
            fresh: true,
            slopes: vec![[zero; LARGEST_STAGES]; dimension],
            argument: zeros.clone(),
            rate: zeros,
        }
    }

    /// Inverse of the tolerance of a component of such sizes.
    #[inline(always)]
    fn inverse(&self, component: usize, a: L, b: L) -> L {
        let size = a.abs().larger(b.abs());
        let absolute = L::splat(self.absolute[component]);
        L::splat(1.0) / size.mul_add(L::splat(self.relative), absolute)
    }

    /// Derivatives and first steps of lanes that have just got their trajectories (Hairer et al.,
    /// section II.4).
    #[inline(always)]
    fn start(&mut self) {
        let zero = L::splat(0.0);
        let fresh = |next: f64, _: f64| next == 0.0;
        self.system.derivative(self.time, &self.parameters, &self.state, &mut self.rate);
        let (mut size, mut speed) = (zero, zero);
        for (component, slopes) in self.slopes.iter_mut().enumerate() {
            slopes[0] = self.next.select(zero, fresh, self.rate[component], slopes[0]);
        }
        for component in 0..self.state.len() {
            let state = self.state[component];
            let inverse = self.inverse(component, state, state);
            size = size.larger((state * inverse).abs());
            speed = speed.larger((self.slopes[component][0] * inverse).abs());
        }
        let small = L::splat(SMALL_STEP);
        let short = size * L::splat(0.01) / speed;
        let short = size.smaller(speed).select(
            L::splat(1e-5),
            |size, least| size < least || !size.is_finite(),
            small,
            short,
        );
        let short = short.smaller(L::splat(self.largest_step));
        for (component, argument) in self.argument.iter_mut().enumerate() {
            *argument = self.slopes[component][0].mul_add(short, self.state[component]);
        }
        self.system.derivative(self.time + short, &self.parameters, &self.argument, &mut self.rate);
        let mut bending = speed;
        for component in 0..self.state.len() {
            let state = self.state[component];
            let change = self.rate[component] - self.slopes[component][0];
            let inverse = self.inverse(component, state, state);
            bending = bending.larger((change * inverse).abs() / short);
        }
        let power = (rough_log2(bending) + L::splat(7.0)) * L::splat(-1.0 / P::POWER);
        let longer = rough_exp2(power).smaller(short * L::splat(100.0));
        let guess = longer.smaller(L::splat(self.largest_step));
        self.next = self.next.select(zero, fresh, guess, self.next);
        self.fresh = false;
    }

    /// All stages of a step and the state at its end, in `argument`.
    #[inline(always)]
    fn stages(&mut self, length: L, end: L) {
        for stage in 1..P::STAGES {
            for (component, argument) in self.argument.iter_mut().enumerate() {
                let slope = weighted(&self.slopes[component], P::row(stage));
                *argument = length.mul_add(slope, self.state[component]);
            }
            let node = P::nodes()[stage];
            let time = if node < 1.0 { length.mul_add(L::splat(node), self.time) } else { end };
            self.system.derivative(time, &self.parameters, &self.argument, &mut self.rate);
            for (slopes, rate) in self.slopes.iter_mut().zip(&self.rate) {
                slopes[stage] = *rate;
            }
        }
    }

    /// The error of the step, at most one where it is accepted.
    #[inline(always)]
    fn error(&self, length: L) -> L {
        let mut squares = [L::splat(0.0); 2];
        for (component, slopes) in self.slopes.iter().enumerate() {
            let inverse = self.inverse(component, self.state[component], self.argument[component]);
            for (part, sum) in squares.iter_mut().enumerate().take(P::PARTS) {
                let error = P::error(part, slopes) * inverse;
                *sum = error.mul_add(error, *sum);
            }
        }
        P::norm(length, squares, self.state.len() as f64)
    }
}

impl<Y: LaneSystem, P: Coefficients, L: Lanes> Stepper<L> for RungeKutta<'_, Y, P, L> {
    const LOOKS_INSIDE: bool = false;

    fn dimension(&self) -> usize {
        self.state.len()
    }

    fn parameters(&self) -> usize {
        self.parameters.len()
    }

    #[inline(always)]
    fn time(&self) -> L {
        self.time
    }

    fn set(&mut self, lane: usize, time: f64, state: &[f64], parameters: &[f64]) {
        self.time.set(lane, time);
        put(lane, state, &mut self.state);
        put(lane, parameters, &mut self.parameters);
        self.next.set(lane, 0.0);
        self.fresh = true;
    }

    fn get(&self, lane: usize, state: &mut [f64], parameters: &mut [f64]) {
        take(lane, &self.state, state);
        take(lane, &self.parameters, parameters);
    }

    #[inline(always)]
    fn step(&mut self, goal: L) -> L {
        if self.fresh {
            self.start();
        }
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        let largest = L::splat(self.largest_step);
        let wanted = if self.fixed { largest } else { self.next.smaller(largest) };
        let remaining = goal - self.time;
        let lands = |remaining: f64, wanted: f64| remaining <= STRETCH * wanted;
        let end = remaining.select(wanted, lands, goal, self.time + wanted);
        let length = remaining.select(wanted, lands, remaining, wanted);
        self.stages(length, end);
        let error = if self.fixed { zero } else { self.error(length) };
        let passes = |error: f64, one: f64| error <= one;
        let power = rough_log2(error) * L::splat(-1.0 / P::POWER);
        let factor = rough_exp2(power) * L::splat(SAFETY);
        let factor = factor.larger(L::splat(SMALLEST_FACTOR)).smaller(L::splat(LARGEST_FACTOR));
        let shrunk = factor.smaller(L::splat(SAFETY));
        // A step cut short to land says nothing against the length wanted before.
        let accepted = (length * factor).larger(wanted);
        let accepted = length.select(wanted, |a, b| a < b, accepted, length * factor);
        self.next = error.select(one, passes, accepted, length * shrunk);
        for (component, state) in self.state.iter_mut().enumerate() {
            *state = error.select(one, passes, self.argument[component], *state);
            let slopes = &mut self.slopes[component];
            slopes[0] = error.select(one, passes, slopes[P::STAGES - 1], slopes[0]);
        }
        self.time = error.select(one, passes, end, self.time);
        let least = self.time.abs() * L::splat(LEAST_SHARE);
        let small = self.next.select(least, |next, least| next > least, zero, one);
        // A state that is not finite has a derivative that is not.
        let check = self.slopes.iter().fold(zero, |sum, slopes| slopes[0].mul_add(zero, sum));
        let finite = |check: f64, zero: f64| check == zero;
        check.select(zero, finite, small, L::splat(2.0))
    }

    #[inline(always)]
    fn inside(&mut self, _: L, state: &mut [L]) {
        state.copy_from_slice(&self.state);
    }

    #[inline(always)]
    fn passes(&self) -> &[Pass] {
        &[]
    }
}
