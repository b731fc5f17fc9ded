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
    /// The impulse that is still to come, N·m·s.
    shock: Option<f64>,
}

/// How a motion begins.
#[derive(Clone, Debug)]
pub(super) struct Beginning {
    /// State at time 0.
    pub(super) state: Vec<f64>,
    /// Time and size of an impulse within the first period, s and N·m·s.
    pub(super) shock: Option<(f64, f64)>,
}

/// Motions from many states at time 0.
pub(super) struct Settle<'s, F> {
    pub(super) line: &'s LaneLine,
    pub(super) frame: &'s Frame,
    /// Parameters of the line at the excitation speed.
    pub(super) parameters: &'s [f64],
    /// The beginning of each motion.
    pub(super) begin: F,
    /// Jump of each rate by an impulse of 1 N·m·s.
    pub(super) jumps: &'s [f64],
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

impl<F: Fn(usize) -> Beginning + Sync> Task for Settle<'_, F> {
    type Memory = Memory;

    fn begin(&self, index: usize, trajectory: &mut Trajectory<'_>) -> (Memory, Plan) {
        let Beginning { state, shock } = (self.begin)(index);
        trajectory.time = 0.0;
        trajectory.state.copy_from_slice(&state);
        trajectory.parameters.copy_from_slice(self.parameters);
        let mut memory =
            Memory { outcome: Outcome::Undecided, period: 0, recent: vec![], shock: None };
        let plan = match shock {
            Some((time, impulse)) if time > 0.0 => {
                memory.shock = Some(impulse);
                Plan::to(time)
            }
            shock => {
                self.strike(shock.map_or(0.0, |(_, impulse)| impulse), trajectory.state);
                self.on()
            }
        };
        self.line.settle(trajectory.state, trajectory.parameters);
        (memory, plan)
    }

    fn arrived(&self, memory: &mut Memory, trajectory: &mut Trajectory<'_>) -> Option<Plan> {
        // The only other goal is the end.
        let impulse = memory.shock.take()?;
        self.strike(impulse, trajectory.state);
        self.line.settle(trajectory.state, trajectory.parameters);
        Some(self.on())
    }

    fn watched(&self, memory: &mut Memory, _: f64, state: &[f64]) -> Option<f64> {
        memory.period += 1;
        memory.outcome = self.judge(memory, state);
        let next = (memory.period + 1) as f64 * self.period;
        (memory.outcome == Outcome::Undecided).then_some(next)
    }
}

impl<F> Settle<'_, F> {
    /// To the end, with a look whenever a period begins.
    fn on(&self) -> Plan {
        Plan { goal: self.most_periods as f64 * self.period, watch: self.period }
    }

    /// Adds what an impulse does to the rates.
    fn strike(&self, impulse: f64, state: &mut [f64]) {
        let half = state.len() / 2;
        let rates = state[half..].iter_mut().zip(self.jumps);
        rates.for_each(|(rate, jump)| *rate += impulse * jump);
    }

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
