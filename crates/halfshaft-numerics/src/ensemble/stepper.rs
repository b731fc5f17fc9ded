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

/// A passage of one lane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pass {
    pub(super) lane: usize,
    pub(super) passage: Passage,
}
