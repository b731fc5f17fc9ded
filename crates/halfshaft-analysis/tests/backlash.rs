//! Backlash under a mean torque over a wide range of speeds: no stable periodic response that sweeps
//! of the motion itself meet is missed, and jumps are where the branches say.
//!
//! Source of truth: the motion by the classical method of Runge and Kutta with fixed steps that end at
//! each contact, swept slowly up and down; it shares nothing with the program but the equations.

mod common;

use common::{line_of, resonance, some};
use halfshaft_model::question::QuestionText;
use halfshaft_results::{Branch, ResonanceResult, SpecialKind};

/// Angles and speeds.
type State = [f64; 4];

/// Steps a period.
const STEPS: usize = 240;
/// Periods for settling at each speed.
const SETTLING: usize = 150;
/// Periods for settling where it is slow.
const SLOWLY: usize = 4000;
/// Speeds of a sweep.
const SPEEDS: usize = 45;

/// Relative error of amplitudes by the fixed steps: they see turning points to the square of a step.
const AT_SAMPLES: f64 = 2e-4;

/// A line of at most two inertias with one gap.
struct Motion {
    /// Accelerations at angles and speeds, for a cosine of the harmonic torque and a side of the gap
    /// (-1, 0, 1): steps end at contacts, so all of a step is on one side.
    acceleration: fn(&State, f64, f64) -> [f64; 2],
    /// Twist across the gap.
    twist: fn(&State) -> f64,
    half_gap: f64,
    /// State from which sweeps begin.
    start: State,
}

impl Motion {
    fn rates(&self, state: &State, t: f64, frequency: f64, side: f64) -> State {
        let [a, b] = (self.acceleration)(state, (frequency * t).cos(), side);
        [state[2], state[3], a, b]
    }

    fn step(&self, state: &State, t: f64, h: f64, frequency: f64) -> State {
        let moved =
            |rate: &State, h: f64| -> State { std::array::from_fn(|k| state[k] + h * rate[k]) };
        let side = f64::from(self.side(state));
        let rates = |state: &State, t: f64| self.rates(state, t, frequency, side);
        let k1 = rates(state, t);
        let k2 = rates(&moved(&k1, 0.5 * h), t + 0.5 * h);
        let k3 = rates(&moved(&k2, 0.5 * h), t + 0.5 * h);
        let k4 = rates(&moved(&k3, h), t + h);
        std::array::from_fn(|k| state[k] + h / 6.0 * (k1[k] + 2.0 * (k2[k] + k3[k]) + k4[k]))
    }

    fn side(&self, state: &State) -> i32 {
        let x = (self.twist)(state);
        i32::from(x > self.half_gap) - i32::from(x < -self.half_gap)
    }

    /// One period from a phase of nothing; also the least and greatest twist on the way.
    fn period(&self, state: State, frequency: f64) -> (State, [f64; 2]) {
        let h = std::f64::consts::TAU / frequency / STEPS as f64;
        let mut now = state;
        let mut range = [f64::INFINITY, f64::NEG_INFINITY];
        for at in 0..STEPS {
            let (mut t, end) = (h * at as f64, h * (at + 1) as f64);
            let mut guard = 0;
            while t < end && guard < 8 {
                guard += 1;
                let (mut low, mut high) = (0.0, end - t);
                let next = self.step(&now, t, high, frequency);
                if self.side(&next) == self.side(&now) {
                    now = next;
                    break;
                }
                // The step ends just behind the contact.
                for _ in 0..45 {
                    let middle = 0.5 * (low + high);
                    let there = self.step(&now, t, middle, frequency);
                    if self.side(&there) == self.side(&now) {
                        low = middle;
                    } else {
                        high = middle;
                    }
                }
                now = self.step(&now, t, high, frequency);
                t += high;
            }
            let x = (self.twist)(&now);
            range = [range[0].min(x), range[1].max(x)];
        }
        (now, range)
    }

    /// Where the motion settles: amplitude of the twist and periods, `None` where it does not repeat
    /// within four.
    fn settled(&self, state: &mut State, frequency: f64) -> Option<(f64, usize)> {
        for _ in 0..SETTLING {
            *state = self.period(*state, frequency).0;
        }
        let first = *state;
        let mut range = [f64::INFINITY, f64::NEG_INFINITY];
        for periods in 1..=4 {
            let (next, seen) = self.period(*state, frequency);
            *state = next;
            range = [range[0].min(seen[0]), range[1].max(seen[1])];
            // Angles of a free line drift; twist and speeds return.
            let away = |a: f64, b: f64| (a - b).abs();
            let back = away((self.twist)(&next), (self.twist)(&first))
                + away(next[2], first[2])
                + away(next[3], first[3]);
            if back < 1e-5 * (range[1] - range[0]) {
                return Some((0.5 * (range[1] - range[0]), periods));
            }
        }
        None
    }
}

/// Torque of a gap with stiffness `k` outside, on a side of it.
fn gap(x: f64, half: f64, k: f64, side: f64) -> f64 {
    if side == 0.0 { 0.0 } else { k * (x - side * half) }
}

fn asked(text: &str, channel: (f64, f64)) -> ResonanceResult {
    let range = format!("{}..{}", channel.0, channel.1);
    let question = QuestionText {
        method: some("harmonic-balance"),
        frequency: some(&range),
        ..QuestionText::default()
    };
    resonance(&line_of(text, &[]), &question)
}

/// Amplitudes of stable responses of some periods at a speed.
fn stable_at(branches: &[Branch], periods: usize, channel: &str, frequency: f64) -> Vec<f64> {
    let mut found = Vec::new();
    for branch in branches.iter().filter(|branch| branch.periods as usize == periods) {
        let speeds = branch.values("frequency");
        let amplitude = branch.values(&format!("{channel}.twist.amplitude"));
        let stable = branch.values("stable");
        for k in 1..speeds.len() {
            let (a, b) = (speeds[k - 1], speeds[k]);
            let inside = (a - frequency) * (b - frequency) <= 0.0 && a != b;
            if inside && (stable[k - 1] == 1.0 || stable[k] == 1.0) {
                let part = (frequency - a) / (b - a);
                found.push(amplitude[k - 1] + part * (amplitude[k] - amplitude[k - 1]));
            }
        }
    }
    found
}

/// Whether a stable response has an amplitude.
fn is_known(
    result: &ResonanceResult,
    channel: &str,
    frequency: f64,
    (amplitude, periods): (f64, usize),
) -> bool {
    let near = |value: &f64| (value / amplitude - 1.0).abs() < 5e-3;
    stable_at(&result.branches, periods, channel, frequency).iter().any(near)
}

/// Whether a branch loses or wins stability between two speeds.
fn changes_between(branches: &[Branch], low: f64, high: f64) -> bool {
    let kinds = [
        SpecialKind::Fold,
        SpecialKind::PeriodDoubling,
        SpecialKind::NeimarkSacker,
        SpecialKind::GrazingContact,
        SpecialKind::BranchPoint,
    ];
    branches.iter().flat_map(|branch| &branch.special_points).any(|point| {
        let at = point.value("frequency").unwrap_or(f64::NAN);
        kinds.contains(&point.kind) && at >= low && at <= high
    })
}

/// Sweeps up and down and holds what is met against the branches.
fn hold_against_sweeps(text: &str, channel: &str, range: (f64, f64), motion: &Motion) {
    let result = asked(text, range);
    let amplitudes = format!("{channel}.twist.amplitude");
    let all = result.branches.iter().flat_map(|branch| branch.values(&amplitudes));
    let largest = all.copied().fold(0.0, f64::max);
    let mut compared = 0;
    let mut jumps = 0;
    for up in [true, false] {
        let mut state = motion.start;
        let mut last: Option<(f64, f64, usize)> = None;
        for at in 0..SPEEDS {
            let part = (at as f64 + 0.37) / SPEEDS as f64;
            let part = if up { part } else { 1.0 - part };
            let frequency = range.0 + part * (range.1 - range.0);
            let Some(mut met) = motion.settled(&mut state, frequency) else {
                last = None;
                continue;
            };
            if !is_known(&result, channel, frequency, met) {
                // Next to the end of stability motions settle slowly.
                for _ in 0..SLOWLY {
                    state = motion.period(state, frequency).0;
                }
                let Some(late) = motion.settled(&mut state, frequency) else {
                    last = None;
                    continue;
                };
                met = late;
            }
            let (amplitude, periods) = met;
            if periods <= 2 {
                assert!(
                    is_known(&result, channel, frequency, met),
                    "up {up}, {frequency}: the motion settles to {amplitude} every {periods} periods, \
                     the branches have {:?}",
                    stable_at(&result.branches, periods, channel, frequency)
                );
                compared += 1;
            }
            if let Some((speed, before, same)) = last
                && (same != periods || (amplitude - before).abs() > 0.15 * largest)
            {
                // A step in speed is a push: it may throw the motion off up to a step early.
                let (low, high) = (speed.min(frequency), speed.max(frequency));
                let (low, high) = (2.0 * low - high, 2.0 * high - low);
                assert!(
                    changes_between(&result.branches, low, high),
                    "up {up}: jump in {low}..{high} from {before} every {same} to {amplitude} every \
                     {periods}"
                );
                jumps += 1;
            }
            last = Some((frequency, amplitude, periods));
        }
    }
    assert!(compared > SPEEDS, "{compared}");
    assert!(jumps > 0);
    hold_at_samples(&result, channel, motion);
}

/// At speeds of samples the motion's own amplitude is that of a sample, far more precisely than between
/// them.
fn hold_at_samples(result: &ResonanceResult, channel: &str, motion: &Motion) {
    let mut speeds: Vec<f64> = Vec::new();
    for branch in result.branches.iter().filter(|branch| branch.periods == 1) {
        let stable = branch.values("stable");
        let all =
            branch.values("frequency").iter().zip(stable).filter(|(_, stable)| **stable == 1.0);
        speeds.extend(all.map(|(speed, _)| *speed).step_by(9));
    }
    speeds.sort_by(f64::total_cmp);
    let mut state = motion.start;
    let mut held = 0;
    for frequency in speeds {
        let Some((amplitude, 1)) = motion.settled(&mut state, frequency) else { continue };
        let known = stable_at(&result.branches, 1, channel, frequency);
        let near = |value: &f64| (value / amplitude - 1.0).abs() < AT_SAMPLES;
        held += usize::from(known.iter().any(near));
    }
    assert!(held >= 6, "{held}");
}

// One inertia held through a gap of 2 rad, pressed to one side by a mean torque.
#[test]
fn a_held_inertia_in_a_gap() {
    let text = "format = 1\nname = \"x\"\n[[inertia]]\nname = \"a\"\ninertia = 1\ndamping = 0.1\n\
                [[shaft]]\nname = \"s\"\nfrom = \"a\"\nto = \"ground\"\nstiffness = 1\n\
                clearance = \"2 rad\"\n[[torque]]\nname = \"t\"\non = \"a\"\nmean = 0.3\n\
                amplitude = 0.2\n";
    let motion = Motion {
        acceleration: |s, cosine, side| {
            [0.3 + 0.2 * cosine - gap(s[0], 1.0, 1.0, side) - 0.1 * s[2], 0.0]
        },
        twist: |s| s[0],
        half_gap: 1.0,
        start: [1.3, 0.0, 0.0, 0.0],
    };
    hold_against_sweeps(text, "s", (0.4, 1.4), &motion);
}

// Two free inertias through a mesh with play and a ratio of two; the torques balance.
#[test]
fn a_free_pair_through_a_mesh_with_play() {
    let text = "format = 1\nname = \"x\"\n[[inertia]]\nname = \"a\"\ninertia = 0.25\n[[inertia]]\n\
                name = \"b\"\ninertia = 2\n[[gear]]\nname = \"g\"\ninput = \"a\"\noutput = \"b\"\n\
                ratio = 2\nstiffness = 4\ndamping = 0.15\nclearance = 0.4\n[[torque]]\nname = \"t\"\n\
                on = \"a\"\nmean = 0.2\namplitude = 0.15\n[[torque]]\nname = \"l\"\non = \"b\"\n\
                mean = -0.4\n";
    // The mesh lies at the output: its twist is half the input's angle less the output's.
    let motion = Motion {
        acceleration: |s, cosine, side| {
            let (x, v) = (s[0] / 2.0 - s[1], s[2] / 2.0 - s[3]);
            let torque = gap(x, 0.2, 4.0, side) + 0.15 * v;
            [(0.2 + 0.15 * cosine - torque / 2.0) / 0.25, (torque - 0.4) / 2.0]
        },
        twist: |s| s[0] / 2.0 - s[1],
        half_gap: 0.2,
        start: [0.6, 0.0, 0.0, 0.0],
    };
    hold_against_sweeps(text, "g", (0.8, 4.0), &motion);
}

// The same pair with a damper that acts in contact only: torque jumps where the teeth part.
#[test]
fn a_mesh_whose_damper_acts_in_contact_only() {
    let text = "format = 1\nname = \"x\"\n[[inertia]]\nname = \"a\"\ninertia = 1\n[[inertia]]\n\
                name = \"b\"\ninertia = 3\n[[gear]]\nname = \"g\"\ninput = \"a\"\noutput = \"b\"\n\
                ratio = 1\nstiffness = 3\ndamping = 0.3\ndamping_acts = \"in contact\"\n\
                clearance = 0.3\n[[torque]]\nname = \"t\"\non = \"a\"\nmean = 0.25\n\
                amplitude = 0.3\n[[torque]]\nname = \"l\"\non = \"b\"\nmean = -0.25\n";
    let motion = Motion {
        acceleration: |s, cosine, side| {
            let (x, v) = (s[0] - s[1], s[2] - s[3]);
            let damping = if side == 0.0 { 0.0 } else { 0.3 * v };
            let torque = gap(x, 0.15, 3.0, side) + damping;
            [0.25 + 0.3 * cosine - torque, (torque - 0.25) / 3.0]
        },
        twist: |s| s[0] - s[1],
        half_gap: 0.15,
        start: [0.25, 0.0, 0.0, 0.0],
    };
    hold_against_sweeps(text, "g", (0.7, 3.5), &motion);
}

// A held inertia with a second one behind play, both vibrating.
#[test]
fn a_held_inertia_with_another_behind_play() {
    let text = "format = 1\nname = \"x\"\n[[inertia]]\nname = \"a\"\ninertia = 1\n[[inertia]]\n\
                name = \"b\"\ninertia = 0.3\ndamping = 0.03\n[[shaft]]\nname = \"h\"\nfrom = \"a\"\n\
                to = \"ground\"\nstiffness = 1\ndamping = 0.08\n[[shaft]]\nname = \"s\"\n\
                from = \"a\"\nto = \"b\"\nstiffness = 1.5\ndamping = 0.05\nclearance = 0.6\n\
                [[torque]]\nname = \"t\"\non = \"a\"\nmean = 0.1\namplitude = 0.2\n[[torque]]\n\
                name = \"l\"\non = \"b\"\nmean = -0.1\n";
    let motion = Motion {
        acceleration: |s, cosine, side| {
            let (x, v) = (s[0] - s[1], s[2] - s[3]);
            let torque = gap(x, 0.3, 1.5, side) + 0.05 * v;
            [0.1 + 0.2 * cosine - s[0] - 0.08 * s[2] - torque, (torque - 0.1 - 0.03 * s[3]) / 0.3]
        },
        twist: |s| s[0] - s[1],
        half_gap: 0.3,
        start: [0.0, -0.35, 0.0, 0.0],
    };
    hold_against_sweeps(text, "s", (0.4, 3.0), &motion);
}
