//! The motion of a line without its angle as a whole, which periodic responses leave open.

use halfshaft_dynamics::{Active, EquationsOfMotion, Motion};
use halfshaft_numerics::ode::{Linearised, System};

/// Twists of the spanning tree and their rates; for a free line with dampers to ground also its
/// speed as a whole, which they couple to the twists.
#[derive(Clone, Debug)]
pub(crate) struct ElasticMotion<'l> {
    motion: Motion<'l>,
    /// Number of tree twists.
    twists: usize,
    /// Whether the speed of the whole belongs to the state.
    with_speed: bool,
    full: Vec<f64>,
    full_rate: Vec<f64>,
    full_direction: Vec<f64>,
}

impl<'l> ElasticMotion<'l> {
    /// The motion under the mean torques and the harmonics at excitation speed `frequency`.
    pub(crate) fn new(equations: &'l EquationsOfMotion, frequency: f64) -> Self {
        let motion = Motion::new(equations, Active::periodic(frequency), false);
        let dimension = motion.dimension();
        let with_speed = equations.rigid.as_ref().is_some_and(|rigid| rigid.ground_damping > 0.0);
        Self {
            twists: motion.tree_twists(),
            motion,
            with_speed,
            full: vec![0.0; dimension],
            full_rate: vec![0.0; dimension],
            full_direction: vec![0.0; dimension],
        }
    }

    /// Number of tree twists: they come first in the state, their rates follow.
    pub(crate) fn twists(&self) -> usize {
        self.twists
    }
}

/// Copies the elastic part of a state to the places of the full one.
fn spread(elastic: &[f64], twists: usize, with_speed: bool, full: &mut [f64]) {
    let n = full.len() / 2;
    full[..twists].copy_from_slice(&elastic[..twists]);
    full[n..n + twists].copy_from_slice(&elastic[twists..2 * twists]);
    if with_speed {
        full[2 * n - 1] = elastic[2 * twists];
    }
}

/// The reverse of [`spread`].
fn gather(full: &[f64], twists: usize, with_speed: bool, elastic: &mut [f64]) {
    let n = full.len() / 2;
    elastic[..twists].copy_from_slice(&full[..twists]);
    elastic[twists..2 * twists].copy_from_slice(&full[n..n + twists]);
    if with_speed {
        elastic[2 * twists] = full[2 * n - 1];
    }
}

impl System for ElasticMotion<'_> {
    fn dimension(&self) -> usize {
        2 * self.twists + usize::from(self.with_speed)
    }

    fn derivative(&mut self, t: f64, state: &[f64], rate: &mut [f64]) {
        spread(state, self.twists, self.with_speed, &mut self.full);
        self.motion.derivative(t, &self.full, &mut self.full_rate);
        gather(&self.full_rate, self.twists, self.with_speed, rate);
    }
}

impl Linearised for ElasticMotion<'_> {
    fn linearised(&mut self, t: f64, state: &[f64], direction: &[f64], out: &mut [f64]) {
        spread(state, self.twists, self.with_speed, &mut self.full);
        spread(direction, self.twists, self.with_speed, &mut self.full_direction);
        let (full, direction) = (&self.full, &self.full_direction);
        self.motion.linearised(t, full, direction, &mut self.full_rate);
        gather(&self.full_rate, self.twists, self.with_speed, out);
    }
}
