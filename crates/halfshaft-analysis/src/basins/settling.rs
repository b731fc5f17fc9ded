//! Many motions, each followed until it is caught by a response, repeats, or grows beyond all measure.

use halfshaft_dynamics::lanes::LaneLine;
use halfshaft_numerics::ensemble::{Plan, Task, Trajectory};

use super::frame::Frame;

/// A response that catches what comes near.
#[derive(Clone, Debug)]
pub(super) struct Trap {
    /// Its states at the beginning of each period of the excitation.
    pub(super) states: Vec<Vec<f64>>,
    /// Distance from which on everything stays.
    pub(super) radius: f64,
}

/// How a motion ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Outcome {
    /// Not yet, or not in the time that was given.
    Undecided,
    /// Caught by the response of this number.
    Caught(usize),
    /// It repeats after so many periods of the excitation.
    Repeats(u32),
    /// It grew beyond all measure.
    Escaped,
}

/// What is kept of a motion.
#[derive(Clone, Debug)]
pub(super) struct Memory {
    pub(super) outcome: Outcome,
    /// Periods passed.
    period: usize,
    /// The last states at the beginning of a period, in turn, where repetition is looked for.
    recent: Vec<Vec<f64>>,
}

/// Motions from many states at time 0.
pub(super) struct Settle<'s, F> {
    pub(super) line: &'s LaneLine,
    pub(super) frame: &'s Frame,
    /// Parameters of the line at the excitation speed.
    pub(super) parameters: &'s [f64],
    /// State of each motion at time 0.
    pub(super) start: F,
    pub(super) traps: &'s [Trap],
    /// Period of the excitation, s.
    pub(super) period: f64,
    /// Periods after which a motion is given up.
    pub(super) most_periods: usize,
    /// Size at which a motion counts as grown beyond all measure.
    pub(super) most_size: f64,
    /// Whether a motion ends where it repeats.
    pub(super) repeating: bool,
}

/// Periods of a repetition at most.
pub(super) const MOST_MULTIPLE: usize = 12;
/// A motion repeats when its state comes back to this distance.
const REPEATS: f64 = 1e-4;
/// Periods that pass before a repetition counts: what decays slowly seems to repeat.
const SETTLING: usize = 20;

impl<F: Fn(usize) -> Vec<f64> + Sync> Task for Settle<'_, F> {
    type Memory = Memory;

    fn begin(&self, index: usize, trajectory: &mut Trajectory<'_>) -> (Memory, Plan) {
        trajectory.time = 0.0;
        trajectory.state.copy_from_slice(&(self.start)(index));
        trajectory.parameters.copy_from_slice(self.parameters);
        self.line.settle(trajectory.state, trajectory.parameters);
        let memory = Memory { outcome: Outcome::Undecided, period: 0, recent: Vec::new() };
        (memory, Plan { goal: self.most_periods as f64 * self.period, watch: self.period })
    }

    fn watched(&self, memory: &mut Memory, _: f64, state: &[f64]) -> Option<f64> {
        memory.period += 1;
        memory.outcome = self.judge(memory, state);
        let next = (memory.period + 1) as f64 * self.period;
        (memory.outcome == Outcome::Undecided).then_some(next)
    }
}

impl<F> Settle<'_, F> {
    fn judge(&self, memory: &mut Memory, state: &[f64]) -> Outcome {
        let size = self.frame.size(state);
        if size.is_nan() || size > self.most_size {
            return Outcome::Escaped;
        }
        for (number, trap) in self.traps.iter().enumerate() {
            if trap.states.iter().any(|own| self.frame.distance(own, state) < trap.radius) {
                return Outcome::Caught(number);
            }
        }
        if self.repeating && memory.period > SETTLING {
            let back = |back: &usize| {
                let earlier = memory.recent.len().checked_sub(*back).map(|at| &memory.recent[at]);
                earlier.is_some_and(|earlier| self.frame.distance(earlier, state) < REPEATS)
            };
            if let Some(periods) = (1..=MOST_MULTIPLE).find(back) {
                return Outcome::Repeats(u32::try_from(periods).unwrap_or(u32::MAX));
            }
            if memory.recent.len() == MOST_MULTIPLE {
                memory.recent.remove(0);
            }
            memory.recent.push(state.to_vec());
        }
        Outcome::Undecided
    }
}
