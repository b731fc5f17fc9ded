//! What a batch asks of a method.

use super::{Lanes, Passage};

/// A method that steps all lanes at once.
pub(super) trait Stepper<L: Lanes> {
    /// Whether [`Stepper::inside`] knows the state inside a step; else a step ends at every look.
    const LOOKS_INSIDE: bool;

    fn dimension(&self) -> usize;
    fn parameters(&self) -> usize;

    /// The times of the lanes.
    fn time(&self) -> L;

    /// Puts a trajectory into a lane.
    fn set(&mut self, lane: usize, time: f64, state: &[f64], parameters: &[f64]);

    /// Reads the trajectory of a lane.
    fn get(&self, lane: usize, state: &mut [f64], parameters: &mut [f64]);

    /// One step of every lane towards its goal, never past it, and exactly to it in the end. Returns
    /// zero for lanes that could be stepped, one for those whose step is too small, two for those that
    /// are not finite.
    fn step(&mut self, goal: L) -> L;

    /// The states at times within the last steps.
    fn inside(&mut self, time: L, state: &mut [L]);

    /// The passages at the ends of the last steps.
    fn passes(&self) -> &[Pass];
}

/// Puts the numbers of a trajectory into a lane.
#[inline(always)]
pub(super) fn put<L: Lanes>(lane: usize, from: &[f64], to: &mut [L]) {
    to.iter_mut().zip(from).for_each(|(to, value)| to.set(lane, *value));
}

/// Reads the numbers of a trajectory from a lane.
#[inline(always)]
pub(super) fn take<L: Lanes>(lane: usize, from: &[L], to: &mut [f64]) {
    to.iter_mut().zip(from).for_each(|(value, from)| *value = from.get(lane));
}

/// A passage of one lane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pass {
    pub(super) lane: usize,
    pub(super) passage: Passage,
}
