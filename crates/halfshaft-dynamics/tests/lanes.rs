//! Lines over lanes against exact solutions, published numbers and the integrator of single motions.

use std::f64::consts::PI;

use halfshaft_dynamics::lanes::{LaneError, LaneLine};
use halfshaft_dynamics::{Active, EquationsOfMotion, Motion};
use halfshaft_model::{Source, read_model};
use halfshaft_numerics::ensemble::{
    Finished, Instructions, Passage, Plan, Settings, Start, Starts, Task, Trajectory, by_series,
};
use halfshaft_numerics::observer::Silent;
use halfshaft_numerics::ode::dop853::{Dop853, Step};
use halfshaft_numerics::ode::{self, integrate};

fn equations(text: &str) -> EquationsOfMotion {
    let text = format!("format = 1\nname = \"test\"\n{text}");
    let (line, _) = read_model(Source::new("test.toml", &text), &[])
        .unwrap_or_else(|errors| panic!("{}", errors.plain()));
    EquationsOfMotion::new(&line).expect("is sound")
}

fn tight() -> Settings {
    Settings::with_tolerance(1e-15)
}

/// One motion from a state at time 0 to an end.
fn fly(
    equations: &EquationsOfMotion,
    active: &Active,
    state: &[f64],
    end: f64,
    settings: &Settings,
) -> Finished<usize> {
    let line = LaneLine::new(equations);
    let mut parameters = line.values(equations, active, 0.0).expect("the same line");
    line.settle(state, &mut parameters);
    let starts = Starts(vec![Start { time: 0.0, state: state.to_vec(), parameters, end }]);
    let out = by_series(&line, &starts, 1, settings, &Silent).expect("sound");
    out.into_iter().flatten().next().expect("is finished")
}

/// `x'' + 679 x - 0.679 x³ + 0.0952 x' = 15 cos(26.1 t)` as a line.
const DUFFING: &str = r#"
[[inertia]]
name = "j"
inertia = 1
[[shaft]]
name = "s"
from = "j"
to = "ground"
stiffness = 679
cubic = -0.679
damping = 0.0952
[[torque]]
name = "t"
on = "j"
amplitude = 15
"#;

// Source: Taylor series of 26 terms in arithmetic of 34 digits.
#[test]
fn a_forced_duffing_line_ends_where_it_should() {
    let equations = equations(DUFFING);
    let omega = 26.1;
    let active = Active::periodic(omega);
    let found = fly(&equations, &active, &[0.1, 0.0], 200.0 * 2.0 * PI / omega, &tight());
    assert!((found.state[0] + 2.056173482458339).abs() < 2e-12, "{found:?}");
    assert!((found.state[1] - 31.13948284909108).abs() < 5e-11, "{found:?}");
}

/// A geared, branched line with loops, an elastic mesh, dampers to ground, laws of many powers, dry friction.
const BRANCHED: &str = r#"
[[inertia]]
name = "a"
inertia = 0.5
[[inertia]]
name = "b"
inertia = 1.5
damping = 0.3
[[inertia]]
name = "c"
inertia = 2
[[inertia]]
name = "d"
inertia = 0.7
damping = 0.1
[[gear]]
name = "g"
input = "a"
output = "out"
ratio = -3
[[shaft]]
name = "out-b"
from = "out"
to = "b"
stiffness = 100
cubic = 40
damping = 1
[[shaft]]
name = "c-b"
from = "c"
to = "b"
stiffness = 250
quadratic = -30
septic = 3
damping = 2
friction = 7
friction_speed = 1.5
[[shaft]]
name = "b-d"
from = "b"
to = "d"
stiffness = 60
damping = 0.5
[[shaft]]
name = "loop"
from = "c"
to = "d"
stiffness = 35
cubic = 3
quintic = 20
damping = 0.2
[[gear]]
name = "mesh"
input = "a"
output = "c"
ratio = -3
stiffness = 80
damping = 0.4
[[torque]]
name = "t"
on = "a"
mean = 4
amplitude = 3
phase = "40 deg"
harmonics = [{ order = 2.5, amplitude = 1 }]
[[torque]]
name = "u"
on = "d"
amplitude = -2
order = 0.5
pulse = { shape = "half-sine", peak = 5, start = 0.1, duration = 1 }
[[torque]]
name = "v"
on = "b"
pulse = { shape = "ramp", peak = 3, start = 0.4, duration = 0.5 }
[[torque]]
name = "w"
on = "c"
pulse = { shape = "rectangle", peak = -4, start = 1.2, duration = 0.2 }
[[torque]]
name = "x"
on = "c"
pulse = { shape = "impulse", impulse = 2, start = 0.7 }
"#;

/// Motions of a line through the breaks of its pulses.
struct Pulsed<'l> {
    line: &'l LaneLine,
    equations: &'l EquationsOfMotion,
    active: Active,
    start: &'l [f64],
    breaks: Vec<f64>,
    end: f64,
}

impl Pulsed<'_> {
    fn next(&self, time: f64) -> Plan {
        let next = self.breaks.iter().find(|at| **at > time).copied();
        Plan::to(next.unwrap_or(self.end).min(self.end))
    }
}

impl Task for Pulsed<'_> {
    type Memory = ();

    fn begin(&self, _: usize, trajectory: &mut Trajectory<'_>) -> ((), Plan) {
        let values = self.line.values(self.equations, &self.active, 0.0).expect("the same line");
        trajectory.parameters.copy_from_slice(&values);
        trajectory.state.copy_from_slice(self.start);
        self.line.settle(trajectory.state, trajectory.parameters);
        ((), self.next(0.0))
    }

    fn arrived(&self, (): &mut (), trajectory: &mut Trajectory<'_>) -> Option<Plan> {
        if trajectory.time >= self.end {
            return None;
        }
        self.line.over_break(self.equations, &self.active, trajectory).expect("the same line");
        Some(self.next(trajectory.time))
    }
}

// Source: the integrator of order 8 on the same line, through the same breaks.
#[test]
fn a_branched_line_moves_as_the_single_motion_does() {
    let equations = equations(BRANCHED);
    let active = Active::all(Some(7.0));
    let line = LaneLine::new(&equations);
    let motion = Motion::new(&equations, active, false);
    let start = motion.state_of(&[0.4, -0.2, 0.1, 0.3], &[1.0, 0.5, -2.0, 0.1]);
    let breaks = equations.excitation.breaks();
    let mut single = Dop853::new(motion, 0.0, &start, ode::Settings::with_tolerance(1e-13))
        .expect("sound settings");
    let at_break = |t: f64, motion: &mut Motion<'_>, state: &mut [f64]| {
        motion.switch_pulses(t);
        motion.apply_impulses(t, state);
    };
    let end = 3.0;
    integrate(&mut single, end, &breaks, at_break, |_| std::ops::ControlFlow::Continue(()))
        .expect("is smooth");
    let task = Pulsed { line: &line, equations: &equations, active, start: &start, breaks, end };
    let found = by_series(&line, &task, 1, &tight(), &Silent).expect("sound");
    let found = found[0].as_ref().expect("is finished");
    for (found, expected) in found.state.iter().zip(single.state()) {
        assert!((found - expected).abs() < 1e-10, "{found} {expected}");
    }
}

/// Backlash with spring and damper outside the gap.
const BACKLASH: &str = r#"
[[inertia]]
name = "j"
inertia = 5
[[shaft]]
name = "s"
from = "j"
to = "ground"
stiffness = 20000
damping = 50
clearance = 0.7853981633974483
"#;

// Source: reference numbers of two independent programs at tolerance 1e-11 or better, nine digits; they
// are those of a gap of no width.
#[test]
fn a_closed_gap_is_the_published_motion() {
    let equations = equations(&BACKLASH.replace("0.7853981633974483", "0"));
    let times = [0.05, 0.1, 0.2, 0.3, 0.5, 0.75, 1.0];
    let angles = [
        -1.22431277,
        0.954144403,
        0.579302627,
        0.351555956,
        0.129290253,
        -0.036931011,
        0.0105182589,
    ];
    for (time, angle) in times.iter().zip(angles) {
        let start = [0.5 * PI, 0.0];
        let found = fly(&equations, &Active::default(), &start, *time, &tight());
        assert!((found.state[0] - angle).abs() < 6e-9, "{time}: {}", found.state[0]);
    }
}

/// `[x, v, 1]` after time `t` of `x' = v, v' = -k x - c v + f`, by the matrix exponential.
fn moved(state: [f64; 2], [k, c, f]: [f64; 3], t: f64) -> [f64; 2] {
    let halvings = 10 + (t.abs() * (1.0 + k + c)).log2().max(0.0) as u32;
    let h = t / 2.0_f64.powi(halvings as i32);
    let matrix = [[0.0, h, 0.0], [-k * h, -c * h, f * h], [0.0; 3]];
    let unit = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let times = |a: [[f64; 3]; 3], b: [[f64; 3]; 3]| -> [[f64; 3]; 3] {
        std::array::from_fn(|i| {
            std::array::from_fn(|j| (0..3).map(|l| a[i][l] * b[l][j]).sum::<f64>())
        })
    };
    // exp(A) - 1, doubled by e² - 1 = (e - 1)² + 2 (e - 1), so that nothing is lost to the one.
    let mut term = matrix;
    let mut change = matrix;
    for power in 2..12 {
        term = times(term, matrix).map(|row| row.map(|value| value / f64::from(power)));
        for (row, more) in change.iter_mut().zip(term) {
            row.iter_mut().zip(more).for_each(|(value, more)| *value += more);
        }
    }
    for _ in 0..halvings {
        let square = times(change, change);
        for (row, square) in change.iter_mut().zip(square) {
            row.iter_mut().zip(square).for_each(|(value, square)| *value = 2.0 * *value + square);
        }
    }
    let of = |row: usize| -> f64 {
        let state = [state[0], state[1], 1.0];
        (0..3).map(|j| (change[row][j] + unit[row][j]) * state[j]).sum()
    };
    [of(0), of(1)]
}

/// The exact motion of an oscillator with a gap between `-half` and `half`, from piece to piece, with
/// the times of the passages, found by halving.
fn exact_backlash(
    mut state: [f64; 2],
    (k, c, half): (f64, f64, f64),
    in_gap: f64,
    end: f64,
) -> ([f64; 2], Vec<f64>) {
    let (mut time, mut passages) = (0.0, Vec::new());
    let mut piece = if state[0] > half { 1 } else { i32::from(state[0] > -half) - 1 };
    loop {
        let law = match piece {
            0 => [0.0, in_gap, 0.0],
            side => [k, c, k * half * f64::from(side)],
        };
        let inside = |x: f64| match piece {
            0 => x > -half && x < half,
            1 => x > half,
            _ => x < -half,
        };
        // Small enough that no excursion is missed; the first look is just behind the passage.
        let look = 1e-4;
        let mut to = 1e-9;
        while inside(moved(state, law, to)[0]) && time + to < end {
            to += look;
        }
        if time + to >= end {
            return (moved(state, law, end - time), passages);
        }
        let (mut low, mut high) = ((to - look).max(0.0), to);
        for _ in 0..80 {
            let middle = f64::midpoint(low, high);
            if inside(moved(state, law, middle)[0]) { low = middle } else { high = middle }
        }
        state = moved(state, law, high);
        time += high;
        passages.push(time);
        let up = state[1] > 0.0;
        state[0] = if (piece == 0) == up { half } else { -half };
        if piece == 1 {
            state[0] = half;
        }
        piece += if up { 1 } else { -1 };
    }
}

/// Passages of a trajectory.
struct Listed(Starts);

impl Task for Listed {
    type Memory = Vec<Passage>;

    fn begin(&self, index: usize, trajectory: &mut Trajectory<'_>) -> (Vec<Passage>, Plan) {
        (Vec::new(), self.0.begin(index, trajectory).1)
    }

    fn passed(&self, memory: &mut Vec<Passage>, passage: &Passage) {
        memory.push(*passage);
    }
}

// Source: the exact solution of the piecewise linear equation by matrix exponentials.
#[test]
fn backlash_is_the_exact_piecewise_linear_motion() {
    for acts in ["always", "in contact"] {
        let text = format!("{BACKLASH}damping_acts = \"{acts}\"\n");
        let equations = equations(&text);
        let line = LaneLine::new(&equations);
        let values = line.values(&equations, &Active::default(), 0.0).expect("the same line");
        let starts: Vec<[f64; 2]> =
            (0..11).map(|k| [0.3 * f64::from(k) - 1.4, 7.0 * f64::from(k) - 31.0]).collect();
        let end = 0.6;
        let start = |state: &[f64; 2]| {
            let mut parameters = values.clone();
            line.settle(state, &mut parameters);
            Start { time: 0.0, state: state.to_vec(), parameters, end }
        };
        let task = Listed(Starts(starts.iter().map(start).collect()));
        let found = by_series(&line, &task, starts.len(), &tight(), &Silent).expect("sound");
        let half = PI / 8.0;
        let in_gap = if acts == "always" { 10.0 } else { 0.0 };
        for (start, found) in starts.iter().zip(found.iter().flatten()) {
            let (state, passages) = exact_backlash(*start, (4000.0, 10.0, half), in_gap, end);
            assert!((found.state[0] - state[0]).abs() < 1e-9, "{acts} {start:?}: {found:?}");
            assert!((found.state[1] - state[1]).abs() < 1e-8, "{acts} {start:?}: {found:?}");
            assert_eq!(found.memory.len(), passages.len(), "{acts} {start:?}");
            for (passage, exact) in found.memory.iter().zip(&passages) {
                assert!((passage.time - exact).abs() < 1e-12, "{acts} {start:?}");
            }
        }
    }
}

// Source: reference numbers of two independent programs, nine digits; their damping acts in contact.
#[test]
fn a_clearance_with_cubic_contact_is_the_published_motion() {
    let equations = equations(
        r#"
[[inertia]]
name = "a"
inertia = 0.3
[[inertia]]
name = "b"
inertia = 126
[[shaft]]
name = "s"
from = "a"
to = "b"
stiffness = 5000
cubic = 20000
damping = 65
clearance = 0.02
damping_acts = "in contact"
[[torque]]
name = "t"
on = "a"
mean = 100
"#,
    );
    let times = [0.01, 0.02, 0.05, 0.1];
    let twists = [0.0152564184, 0.0276905704, 0.0301299188, 0.0299200711];
    for (time, twist) in times.iter().zip(twists) {
        let found = fly(&equations, &Active::shock(), &[0.0; 4], *time, &tight());
        assert!((found.state[0] - twist).abs() < 6e-11, "{time}: {}", found.state[0]);
    }
}

// Source: the single motion of each line; lanes and instructions may not change a bit.
#[test]
fn lines_of_one_build_with_other_values_move_side_by_side() {
    let lines: Vec<EquationsOfMotion> = (0..21)
        .map(|k| {
            let stiffness = 5000.0 + 200.0 * f64::from(k);
            let gap = 0.02 + 0.001 * f64::from(k);
            equations(&format!(
                "[[inertia]]\nname = \"a\"\ninertia = 0.3\n[[inertia]]\nname = \"b\"\ninertia = 4\n\
                 [[shaft]]\nname = \"s\"\nfrom = \"a\"\nto = \"b\"\nstiffness = {stiffness}\n\
                 damping = 3\nclearance = {gap}\n[[torque]]\nname = \"t\"\non = \"a\"\n\
                 mean = 20\namplitude = 60\n"
            ))
        })
        .collect();
    let line = LaneLine::new(&lines[0]);
    let active = Active::periodic(90.0);
    let start = |equations: &EquationsOfMotion| {
        let state = vec![0.0; 4];
        let mut parameters = line.values(equations, &active, 0.0).expect("one build");
        line.settle(&state, &mut parameters);
        Start { time: 0.0, state, parameters, end: 1.0 }
    };
    let starts = Starts(lines.iter().map(start).collect());
    let run = |lanes: usize, instructions: Instructions| {
        let settings = Settings { lanes: Some(lanes), instructions: Some(instructions), ..tight() };
        by_series(&line, &starts, lines.len(), &settings, &Silent).expect("sound")
    };
    let expected = run(1, Instructions::Plain);
    for instructions in Instructions::available() {
        for &lanes in instructions.widths() {
            assert_eq!(run(lanes, instructions), expected, "{instructions:?} {lanes}");
        }
    }
    for (equations, found) in lines.iter().zip(expected.iter().flatten()) {
        assert!(found.memory > 3, "{found:?}");
        let motion = Motion::new(equations, active, false);
        let settings = ode::Settings::with_tolerance(1e-13);
        let mut single = Dop853::new(motion, 0.0, &[0.0; 4], settings).expect("sound");
        while single.step(1.0).expect("goes on") == Step::Advanced {}
        // The single motion steps across the kinks.
        assert!((found.state[0] - single.state()[0]).abs() < 1e-8);
    }
}

// Source: the contract in the documentation.
#[test]
fn what_cannot_run_side_by_side_is_refused() {
    let line = LaneLine::new(&equations(DUFFING));
    let other = |text: String| line.values(&equations(&text), &Active::default(), 0.0);
    let refused = |text: String| {
        assert!(matches!(other(text.clone()), Err(LaneError::OtherBuild { .. })), "{text}");
    };
    assert!(other(DUFFING.replace("-0.679", "3.5")).is_ok());
    // A lower power of the law is a zero.
    assert!(other(DUFFING.replace("cubic = -0.679\n", "")).is_ok());
    refused(DUFFING.replace("cubic", "quadratic"));
    refused(format!("{DUFFING}harmonics = [{{ order = 2, amplitude = 1 }}]\n"));
    refused(DUFFING.replace("inertia = 1\n", "inertia = 1\ndamping = 2\n"));
    refused(BACKLASH.to_string());
    refused(DUFFING.replace("damping = 0.0952", "friction = 2\nfriction_speed = 0.1"));
}
