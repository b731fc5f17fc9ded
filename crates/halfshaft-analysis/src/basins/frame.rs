//! States as lanes see them, and how far they are apart.

use halfshaft_dynamics::EquationsOfMotion;

use crate::equilibrium::RunningState;
use crate::harmonic_balance::Response;
use crate::shooting::Coordinates;

/// The components of a state and their sizes.
///
/// Lanes have the twists of the spanning tree and, for a free line, the mean angle, then the rates of
/// these. How far the whole has turned is no part of where it is.
#[derive(Clone, Debug)]
pub(super) struct Frame {
    coordinates: Coordinates,
    /// Number of coordinates, and of tree twists among them.
    all: usize,
    twists: usize,
    /// Whether the speed of the whole is part of the state.
    with_speed: bool,
    /// Steady speed of the whole, rad/s.
    running: f64,
    /// Size of each component; infinite for what is no part of the state.
    pub(super) sizes: Vec<f64>,
}

impl Frame {
    /// The frame of a line; sizes are those of its responses.
    pub(super) fn new(
        equations: &EquationsOfMotion,
        coordinates: Coordinates,
        responses: &[Response],
    ) -> Self {
        let (all, twists) = (equations.groups(), equations.network.tree.len());
        let with_speed = coordinates.dimension() > 2 * twists;
        let running = RunningState::of(equations).speed;
        let mut frame = Self {
            coordinates,
            all,
            twists,
            with_speed,
            running,
            sizes: vec![f64::INFINITY; 2 * all],
        };
        for (index, edge) in equations.network.tree.iter().enumerate() {
            let shaft = &equations.connections[edge.shaft].name;
            let of = |channel: &str| {
                let value = |response: &Response, word: &str| {
                    let name = format!("{shaft}.{channel}.{word}");
                    response.values.get(&name).copied().unwrap_or(0.0).abs()
                };
                let swing = |response: &Response| value(response, "amplitude");
                responses.iter().map(swing).fold(0.0, f64::max)
            };
            frame.sizes[index] = of("twist");
            frame.sizes[all + index] = of("twist_rate");
        }
        if with_speed {
            frame.sizes[2 * all - 1] =
                frame.sizes[all..all + twists].iter().copied().fold(0.0, f64::max);
        }
        // What no response moves is measured by what the others do.
        for half in [0..twists, all..all + twists] {
            let largest = frame.sizes[half.clone()].iter().copied().fold(0.0, f64::max);
            let floor = if largest > 0.0 { 1e-3 * largest } else { 1.0 };
            frame.sizes[half].iter_mut().for_each(|size| *size = size.max(floor));
        }
        frame
    }

    /// A state of shooting as lanes see it.
    pub(super) fn lanes(&self, state: &[f64]) -> Vec<f64> {
        let mut out = vec![0.0; 2 * self.all];
        out[..self.twists].copy_from_slice(&state[..self.twists]);
        let rates = &state[self.twists..2 * self.twists];
        for (out, rate) in out[self.all..].iter_mut().zip(rates) {
            *out = self.coordinates.reference * rate;
        }
        if self.all > self.twists {
            let beyond = if self.with_speed { state[2 * self.twists] } else { 0.0 };
            out[2 * self.all - 1] = self.running + self.coordinates.reference * beyond;
        }
        out
    }

    /// The reverse of [`Frame::lanes`].
    pub(super) fn shooting(&self, lanes: &[f64]) -> Vec<f64> {
        let mut state = vec![0.0; self.coordinates.dimension()];
        state[..self.twists].copy_from_slice(&lanes[..self.twists]);
        for (rate, out) in state[self.twists..2 * self.twists].iter_mut().zip(&lanes[self.all..]) {
            *rate = out / self.coordinates.reference;
        }
        if self.with_speed {
            let beyond = lanes[2 * self.all - 1] - self.running;
            state[2 * self.twists] = beyond / self.coordinates.reference;
        }
        state
    }

    /// Distance of two states, each component over its size.
    pub(super) fn distance(&self, a: &[f64], b: &[f64]) -> f64 {
        let parts = a.iter().zip(b).zip(&self.sizes);
        parts.map(|((a, b), size)| ((a - b) / size).powi(2)).sum::<f64>().sqrt()
    }

    /// Size of a state.
    pub(super) fn size(&self, state: &[f64]) -> f64 {
        state.iter().zip(&self.sizes).map(|(x, size)| (x / size).powi(2)).sum::<f64>().sqrt()
    }

    /// A state moved by `by` along a direction, each component over its size.
    pub(super) fn moved(&self, state: &[f64], direction: &[f64], by: f64) -> Vec<f64> {
        let finite = |size: f64| if size.is_finite() { size } else { 0.0 };
        let parts = state.iter().zip(direction).zip(&self.sizes);
        parts.map(|((x, d), size)| x + by * d * finite(*size)).collect()
    }
}
