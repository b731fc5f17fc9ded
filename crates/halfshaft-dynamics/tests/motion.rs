//! The first-order system against independent forms of the same equations.

use halfshaft_dynamics::{Active, EquationsOfMotion, Motion};
use halfshaft_model::{Driveline, Source, embedded, read_model};
use halfshaft_numerics::ode::{Linearised, System};
use proptest::prelude::{prop_assert, proptest};

fn line(text: &str) -> Driveline {
    read_model(Source::new("test.toml", text), &[]).unwrap_or_else(|e| panic!("{}", e.plain())).0
}

/// A geared, branched, partly nonlinear line with loops, an elastic mesh, friction and dampers to
/// ground.
const BRANCHED: &str = r#"
format = 1
name = "branched"
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
pulse = { shape = "rectangle", peak = 5, start = 0.1, duration = 1 }
"#;

/// `M q'' = Q - D q' - Σ w (c x' + r(x') + p(x))` written out for groups, without the coordinates of the
/// motion.
fn accelerations(
    equations: &EquationsOfMotion,
    angles: &[f64],
    speeds: &[f64],
    external: &[f64],
) -> Vec<f64> {
    let mut torques = external.to_vec();
    for (torque, (damping, speed)) in
        torques.iter_mut().zip(equations.ground_damping.iter().zip(speeds))
    {
        *torque -= damping * speed;
    }
    for (index, connection) in equations.connections.iter().enumerate() {
        let (x, v) = (equations.twist(index, angles), equations.twist(index, speeds));
        let friction = if connection.name == "c-b" { 7.0 * (v / 1.5).tanh() } else { 0.0 };
        let carried = connection.law.torque(x) + connection.damping * v + friction;
        equations.add_direction(index, -carried, &mut torques);
    }
    torques.iter().zip(&equations.inertia).map(|(torque, inertia)| torque / inertia).collect()
}

/// Torques of [`BRANCHED`] on its groups (out, b, c, d) at a time inside the pulse.
fn external(time: f64, omega: f64) -> [f64; 4] {
    let phase = 40.0_f64.to_radians();
    let t = 4.0 + 3.0 * (omega * time + phase).cos() + (2.5 * omega * time).cos();
    let u = -2.0 * (0.5 * omega * time).cos() + 5.0;
    [-3.0 * t, 0.0, 0.0, u]
}

proptest! {
    // Source: Newton's law for each group, in coordinates that know no spanning tree.
    #[test]
    fn accelerations_agree_with_newtons_law_for_each_group(
        angles in proptest::collection::vec(-1.0..1.0_f64, 4),
        speeds in proptest::collection::vec(-5.0..5.0_f64, 4),
        time in 0.2..1.0_f64,
    ) {
        let line = line(BRANCHED);
        let equations = EquationsOfMotion::new(&line).expect("is sound");
        let omega = 7.0;
        let mut motion = Motion::new(&equations, Active::all(Some(omega)), false);
        motion.switch_pulses(time);
        let state = motion.state_of(&angles, &speeds);
        let mut rate = motion.zero_state();
        motion.derivative(time, &state, &mut rate);
        let exact = accelerations(&equations, &angles, &speeds, &external(time, omega));
        let expected = motion.state_of(&speeds, &exact);
        for (found, expected) in rate.iter().zip(&expected) {
            prop_assert!((found - expected).abs() < 1e-10 * (1.0 + expected.abs()));
        }
    }

    // Source: the coordinates and back: a state returns the angles and speeds that it was made of.
    #[test]
    fn coordinates_and_group_motions_are_inverse(
        angles in proptest::collection::vec(-9.0..9.0_f64, 4),
        speeds in proptest::collection::vec(-9.0..9.0_f64, 4),
    ) {
        let line = line(BRANCHED);
        let equations = EquationsOfMotion::new(&line).expect("is sound");
        let mut motion = Motion::new(&equations, Active::default(), false);
        let state = motion.state_of(&angles, &speeds);
        let kinematics = motion.kinematics(&state);
        for (found, expected) in kinematics.angles.iter().zip(&angles) {
            prop_assert!((found - expected).abs() < 1e-12);
        }
        for (index, twist) in kinematics.twists.iter().enumerate() {
            prop_assert!((twist - equations.twist(index, &angles)).abs() < 1e-12);
        }
        for (index, rate) in kinematics.rates.iter().enumerate() {
            prop_assert!((rate - equations.twist(index, &speeds)).abs() < 1e-12);
        }
    }

    // Source: central differences of the equations of motion.
    #[test]
    fn the_linearisation_is_the_derivative(
        state in proptest::collection::vec(-1.0..1.0_f64, 8),
        direction in proptest::collection::vec(-1.0..1.0_f64, 8),
    ) {
        let line = line(BRANCHED);
        let equations = EquationsOfMotion::new(&line).expect("is sound");
        let mut motion = Motion::new(&equations, Active::periodic(7.0), false);
        let mut exact = vec![0.0; 8];
        motion.linearised(0.3, &state, &direction, &mut exact);
        let h = 1e-5;
        let shifted = |sign: f64| -> Vec<f64> {
            state.iter().zip(&direction).map(|(s, d)| s + sign * h * d).collect()
        };
        let (mut up, mut down) = (vec![0.0; 8], vec![0.0; 8]);
        motion.derivative(0.3, &shifted(1.0), &mut up);
        motion.derivative(0.3, &shifted(-1.0), &mut down);
        for ((a, b), exact) in up.iter().zip(&down).zip(&exact) {
            prop_assert!(((a - b) / (2.0 * h) - exact).abs() < 1e-5 * (1.0 + exact.abs()));
        }
    }

    // Source: the power balance d(T + V)/dt = power of the torques - heat, at any state.
    #[test]
    fn power_in_is_energy_and_heat(
        angles in proptest::collection::vec(-1.0..1.0_f64, 4),
        speeds in proptest::collection::vec(-3.0..3.0_f64, 4),
    ) {
        let line = line(BRANCHED);
        let equations = EquationsOfMotion::new(&line).expect("is sound");
        let mut motion = Motion::new(&equations, Active::periodic(7.0), true);
        let state = motion.state_of(&angles, &speeds);
        let mut rate = motion.zero_state();
        motion.derivative(0.3, &state, &mut rate);
        let h = 1e-5;
        let mut energy = |sign: f64| {
            let moved: Vec<f64> = state.iter().zip(&rate).map(|(s, r)| s + sign * h * r).collect();
            motion.energy(&moved)
        };
        let change = (energy(1.0) - energy(-1.0)) / (2.0 * h);
        let n = 8;
        let size = rate[n].abs() + rate[n + 1].abs() + change.abs();
        prop_assert!((change - (rate[n] - rate[n + 1])).abs() < 1e-6 * (1.0 + size));
        prop_assert!(rate[n + 1] >= 0.0);
    }
}

// Source: the definition of the matrices: K and C are the derivatives of the group torques.
#[test]
fn tangent_matrices_are_derivatives_of_the_torques() {
    let line = line(BRANCHED);
    let equations = EquationsOfMotion::new(&line).expect("is sound");
    let angles = [0.3, -0.2, 0.5, 0.1];
    let connections = equations.connections.len();
    let twists: Vec<f64> = (0..connections).map(|index| equations.twist(index, &angles)).collect();
    let stiffness = equations.tangent_stiffness(&twists);
    // The friction is left out of the damping, so its slope at rest is added.
    let mut damping = equations.damping_matrix();
    let mut direction = [0.0; 4];
    equations.add_direction(1, 1.0, &mut direction);
    for row in 0..4 {
        for column in 0..4 {
            damping[(row, column)] += 7.0 / 1.5 * direction[row] * direction[column];
        }
    }
    let none = [0.0; 4];
    for column in 0..4 {
        let h = 1e-6;
        let mut up = angles;
        let mut down = angles;
        up[column] += h;
        down[column] -= h;
        let a = accelerations(&equations, &up, &none, &none);
        let b = accelerations(&equations, &down, &none, &none);
        let mut moving = none;
        moving[column] = 1e-6;
        let still = accelerations(&equations, &angles, &none, &none);
        let c = accelerations(&equations, &angles, &moving, &none);
        for row in 0..4 {
            let mass = equations.inertia[row];
            let slope = -mass * (a[row] - b[row]) / (2.0 * h);
            assert!((stiffness[(row, column)] - slope).abs() < 1e-5);
            let slope = -mass * (c[row] - still[row]) / 1e-6;
            assert!((damping[(row, column)] - slope).abs() < 1e-6);
        }
    }
}

// Source: rigid-body motion of the embedded driveline: all angles in their gear ratios, no twist.
#[test]
fn the_rigid_body_motion_twists_nothing() {
    let (line, _) = read_model(embedded::example(), &[]).expect("is sound");
    let equations = EquationsOfMotion::new(&line).expect("is sound");
    let rigid = equations.rigid.as_ref().expect("is free");
    assert!(equations.twist(0, &rigid.speeds).abs() < 1e-15);
    let total = 0.328 * 5.71 * 5.71 + 81.6;
    assert!((rigid.inertia - total).abs() < 1e-12 * total);
    // The road load balances the engine.
    let mean = equations.excitation.mean(equations.groups());
    assert!(rigid.torque(&mean).abs() < 1e-9);
}

// Source: the definition: the amplitude at Ω is (Ω / reference)^power times the written one, and its
// slope is its central difference.
#[test]
fn growing_torques_have_their_amplitude_and_slope() {
    let text = BRANCHED.replace("phase = \"40 deg\"", "speed_power = 2.5\nreference_speed = 4");
    let equations = EquationsOfMotion::new(&line(&text)).expect("is sound");
    let excitation = &equations.excitation;
    assert_eq!(excitation.growing().map(|source| source.name.as_str()), Some("t"));
    let at = |frequency: f64| excitation.harmonic(4, 1.0, frequency)[0].0;
    // The torque acts on the fast side, where 3 N·m are -9 N·m at the group.
    assert!((at(4.0) + 9.0).abs() < 1e-12);
    assert!((at(6.0) + 9.0 * 1.5_f64.powf(2.5)).abs() < 1e-12);
    let slope = (at(6.001) - at(5.999)) / 0.002;
    assert!((excitation.harmonic_slope(4, 1.0, 6.0)[0].0 - slope).abs() < 1e-6);
    // The other torque does not grow.
    assert_eq!(excitation.harmonic(4, 0.5, 3.0), excitation.harmonic(4, 0.5, 30.0));
}
