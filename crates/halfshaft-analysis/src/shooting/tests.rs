//! The motion by Taylor series against the integrator of order 8, and its variations against
//! differences.

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_model::{Source, read_model};
use halfshaft_numerics::ode::dop853::Dop853;
use halfshaft_numerics::ode::{Settings, Tolerance, integrate};

use super::flow::Flow;
use crate::equilibrium::RunningState;
use crate::verification::ElasticMotion;

/// Two inertias and a geared one behind a mesh with play; a cubic shaft, dry friction, a stop whose
/// damper acts in contact only. `{ground}` and `{damping}` are put in.
const LINE: &str = r#"
format = 1
name = "All laws"
[[inertia]]
name = "a"
inertia = 1.0
damping = {damping}
[[inertia]]
name = "b"
inertia = 0.7
[[inertia]]
name = "c"
inertia = 0.4
[[shaft]]
name = "cubic"
from = "a"
to = "b"
stiffness = 3
damping = 0.1
cubic = 2
friction = 0.2
friction_speed = 0.5
[[gear]]
name = "mesh"
input = "b"
output = "c"
ratio = -1.5
stiffness = 20
damping = 0.05
clearance = 0.1
[[shaft]]
name = "stop"
from = "a"
to = "b"
contact = 0.2
stiffness = 30
damping = 0.4
damping_acts = "in contact"
{ground}
[[torque]]
name = "drive"
on = "b"
mean = 0.3
amplitude = 1
order = 2
phase = 0.4
speed_power = 1
reference_speed = 1.2
[[torque]]
name = "load"
on = "a"
mean = -0.3
"#;

const HELD: &str = "[[shaft]]\nname = \"held\"\nfrom = \"a\"\nto = \"ground\"\nstiffness = 2\n";

fn equations(ground: &str, damping: &str) -> EquationsOfMotion {
    let text = LINE.replace("{ground}", ground).replace("{damping}", damping);
    let (line, _) = read_model(Source::new("test.toml", &text), &[])
        .unwrap_or_else(|found| panic!("{}", found.plain()));
    EquationsOfMotion::new(&line).expect("a sound line")
}

/// A state that is nothing special.
fn some_state(dimension: usize) -> Vec<f64> {
    (0..dimension).map(|k| 0.15 * (1.7 * k as f64 + 0.5).sin()).collect()
}

const FREQUENCY: f64 = 0.9;
const REFERENCE: f64 = 1.3;
const END: f64 = 4.0;

fn lines() -> [EquationsOfMotion; 3] {
    [equations(HELD, "0"), equations("", "0"), equations("", "0.3")]
}

// Source: the integrator of order 8 at a tight tolerance, held, free, and free with a damper to
// ground.
#[test]
fn the_motion_is_that_of_the_integrator() {
    for equations in lines() {
        let mut flow = Flow::new(&equations, REFERENCE);
        let state = some_state(flow.coordinates.dimension());
        let arrived = flow.run(&state, FREQUENCY, END, false, |_| {}).expect("arrives");
        let motion = ElasticMotion::new(&equations, FREQUENCY);
        let twists = motion.twists();
        let running = RunningState::of(&equations).speed;
        let scale = |k: usize| if k < twists { 1.0 } else { REFERENCE };
        let shift = |k: usize| if k < 2 * twists { 0.0 } else { running };
        let begin: Vec<f64> =
            state.iter().enumerate().map(|(k, x)| scale(k) * x + shift(k)).collect();
        let settings = Settings {
            relative_tolerance: 1e-12,
            absolute_tolerance: Tolerance::Uniform(1e-13),
            ..Settings::default()
        };
        let mut integrator = Dop853::new(motion, 0.0, &begin, settings).expect("starts");
        let going =
            |_: halfshaft_numerics::ode::AcceptedStep<'_, _>| std::ops::ControlFlow::Continue(());
        integrate(&mut integrator, END, &[], |_, _, _| {}, going).expect("goes on");
        for (k, (a, b)) in arrived.state.iter().zip(integrator.state()).enumerate() {
            let b = (b - shift(k)) / scale(k);
            assert!((a - b).abs() < 1e-9, "{k}: {a} {b}");
        }
    }
}

// Source: central differences of the motion itself; the damper in contact makes the torque jump.
#[test]
fn variations_are_the_differences_of_the_motion() {
    const STEP: f64 = 1e-6;
    for equations in lines() {
        let mut flow = Flow::new(&equations, REFERENCE);
        let state = some_state(flow.coordinates.dimension());
        let arrived = flow.run(&state, FREQUENCY, END, true, |_| {}).expect("arrives");
        let (matrix, by_frequency) = arrived.variation.expect("is wanted");
        let mut end = |state: &[f64], frequency: f64| {
            flow.run(state, frequency, END, false, |_| {}).expect("arrives").state
        };
        for column in 0..=state.len() {
            let moved = |sign: f64| {
                let mut state = state.clone();
                let mut frequency = FREQUENCY;
                match state.get_mut(column) {
                    Some(x) => *x += sign * STEP,
                    None => frequency += sign * STEP,
                }
                (state, frequency)
            };
            let ((up, fast), (down, slow)) = (moved(1.0), moved(-1.0));
            let (above, below) = (end(&up, fast), end(&down, slow));
            for row in 0..state.len() {
                let difference = (above[row] - below[row]) / (2.0 * STEP);
                let exact =
                    if column < state.len() { matrix[(row, column)] } else { by_frequency[row] };
                let size = exact.abs().max(1.0);
                assert!(
                    (difference - exact).abs() < 2e-7 * size,
                    "{row} {column}: {difference} {exact}"
                );
            }
        }
    }
}
