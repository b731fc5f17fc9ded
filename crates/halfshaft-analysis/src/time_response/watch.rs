//! Where the modes of a motion end inside a step of its integration.
//!
//! Borders are looked at on a grid of the step and at the turning points between, on the dense output;
//! the first that is passed is then met exactly by shorter steps of the integrator itself.

use std::sync::Arc;

use halfshaft_dynamics::{Border, Modes, Motion};
use halfshaft_numerics::bracket::{RootSettings, find_root};
use halfshaft_numerics::ode::{DenseStep, OneStep, Stop};

/// Parts of a step at whose ends borders are looked at.
const PARTS: usize = 10;
/// A border is met when it is missed by less than this part of the time.
const MET: f64 = 1e-14;
/// Steps to meet it at most.
const MOST_TRIES: usize = 6;
/// A border within this part of its largest value over the step has been set on.
const ON: f64 = 1e-12;

/// Watches the borders of a motion's modes.
pub(super) struct Watch<'l> {
    motion: Motion<'l>,
    borders: Vec<Border>,
    state: Vec<f64>,
    rate: Vec<f64>,
    /// Value and slope of each border at each end of a part.
    seen: Vec<Vec<(f64, f64)>>,
}

/// A border about to be passed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Passage {
    pub(super) border: Border,
    pub(super) time: f64,
    at: usize,
}

impl<'l> Watch<'l> {
    /// Watches a motion that is in its modes at time `t`.
    pub(super) fn new(motion: Motion<'l>, t: f64) -> Self {
        let dimension = motion.zero_state().len();
        let borders = motion.borders(t);
        Self {
            motion,
            borders,
            state: vec![0.0; dimension],
            rate: vec![0.0; dimension],
            seen: Vec::new(),
        }
    }

    /// Takes over modes and pulses as they are from time `t` on.
    pub(super) fn follow(&mut self, modes: &Arc<Modes>, t: f64) {
        self.motion.set_modes(Arc::clone(modes));
        self.motion.switch_pulses(t);
        self.borders = self.motion.borders(t);
    }

    /// Values and slopes of all borders at a time of the step.
    fn look(&mut self, dense: &DenseStep<'_>, time: f64) -> Vec<(f64, f64)> {
        dense.evaluate(time, &mut self.state);
        for (component, rate) in self.rate.iter_mut().enumerate() {
            *rate = dense.derivative(component, time);
        }
        let mut out = vec![(0.0, 0.0); self.borders.len()];
        self.motion.distances(time, (&self.state, &self.rate), &self.borders, &mut out);
        out
    }

    fn value(&mut self, dense: &DenseStep<'_>, at: usize, time: f64) -> f64 {
        self.look(dense, time)[at].0
    }

    /// The first border that is passed in the step.
    pub(super) fn first(
        &mut self,
        dense: &DenseStep<'_>,
        (from, to): (f64, f64),
    ) -> Option<Passage> {
        if self.borders.is_empty() {
            return None;
        }
        let time = |part: usize| {
            if part == PARTS { to } else { from + (to - from) * part as f64 / PARTS as f64 }
        };
        self.seen = (0..=PARTS).map(|part| self.look(dense, time(part))).collect();
        let scales: Vec<f64> = (0..self.borders.len())
            .map(|at| self.seen.iter().fold(0.0_f64, |most, seen| most.max(seen[at].0.abs())))
            .collect();
        for part in 0..PARTS {
            let ends = (time(part), time(part + 1));
            let here: Vec<(usize, f64)> = (0..self.borders.len())
                .filter_map(|at| Some((at, self.passage(dense, at, part, ends, ON * scales[at])?)))
                .collect();
            if let Some((at, time)) = here.into_iter().min_by(|a, b| a.1.total_cmp(&b.1)) {
                return Some(Passage { border: self.borders[at], time, at });
            }
        }
        None
    }

    /// When a border is passed in a part of the step.
    fn passage(
        &mut self,
        dense: &DenseStep<'_>,
        at: usize,
        part: usize,
        (from, to): (f64, f64),
        on: f64,
    ) -> Option<f64> {
        let ((mut value, slope), (end, end_slope)) = (self.seen[part][at], self.seen[part + 1][at]);
        let mut from = from;
        if value <= on {
            // Just set on; it counts from where it has left the border.
            if end > on {
                return None;
            }
            if slope > 0.0 && end_slope < 0.0 {
                let turn = self.turn(dense, at, (from, to))?;
                (from, value) = (turn, self.value(dense, at, turn));
            }
            if value <= on {
                return (end < -on).then_some(from);
            }
        }
        if end >= 0.0 {
            // It may dip below between.
            let dips = slope < 0.0 && end_slope > 0.0;
            let turn = dips.then(|| self.turn(dense, at, (from, to))).flatten()?;
            if self.value(dense, at, turn) >= 0.0 {
                return None;
            }
            return self.root(dense, at, (from, turn));
        }
        self.root(dense, at, (from, to))
    }

    fn root(&mut self, dense: &DenseStep<'_>, at: usize, (from, to): (f64, f64)) -> Option<f64> {
        let root = find_root(|time| self.value(dense, at, time), from, to, RootSettings::default());
        root.ok().map(|root| root.value)
    }

    /// Where the slope of a border changes its sign.
    fn turn(&mut self, dense: &DenseStep<'_>, at: usize, (from, to): (f64, f64)) -> Option<f64> {
        let slope = |time| self.look(dense, time)[at].1;
        find_root(slope, from, to, RootSettings::default()).ok().map(|root| root.value)
    }

    /// Shortens the last step so that it ends on the border: the state there is one of full order.
    pub(super) fn meet(
        &mut self,
        integrator: &mut dyn OneStep<System = Motion<'l>>,
        mut passage: Passage,
    ) -> Result<Passage, Stop> {
        let (from, to) = (integrator.previous_time(), integrator.time());
        let least = from + MET * (to - from).max(from.abs());
        passage.time = passage.time.clamp(least, to);
        for _ in 0..MOST_TRIES {
            integrator.retake(passage.time)?;
            let (value, slope) = self.at_end(integrator, passage);
            let step = -value / slope;
            if !step.is_finite() || step.abs() <= MET * passage.time.abs().max(to - from) {
                break;
            }
            let next = (passage.time + step).clamp(least, to);
            if next == passage.time {
                break;
            }
            passage.time = next;
        }
        integrator.retake(passage.time)?;
        Ok(passage)
    }

    /// Value and slope of a border at the end of the last step.
    fn at_end(
        &mut self,
        integrator: &mut dyn OneStep<System = Motion<'l>>,
        passage: Passage,
    ) -> (f64, f64) {
        let (state, rate) = (integrator.state().to_vec(), integrator.rate().to_vec());
        let mut out = vec![(0.0, 0.0); self.borders.len()];
        self.motion.distances(passage.time, (&state, &rate), &self.borders, &mut out);
        let (value, slope) = out[passage.at];
        if !slope.is_nan() {
            return (value, slope);
        }
        // What friction is needed moves with the state: its slope by a difference inside the step.
        let back = 1e-3 * (passage.time - integrator.previous_time());
        let before = self.value(&integrator.dense(), passage.at, passage.time - back);
        (value, (value - before) / back)
    }
}
