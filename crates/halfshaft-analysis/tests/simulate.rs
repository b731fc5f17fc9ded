//! `simulate`: time histories against exact solutions, references and the energy balance.

#![allow(clippy::needless_pass_by_value, reason = "options are made in place")]

mod common;

use common::{assert_close, chain, driveline, history, line_of, oscillator, some};
use halfshaft_dynamics::{Active, EquationsOfMotion, Motion};
use halfshaft_model::question::{QuestionText, Verb};
use halfshaft_numerics::ode::Settings;
use halfshaft_numerics::ode::dop853::Dop853;
use halfshaft_results::{HistoryResult, Reason};

fn simulate(line: &halfshaft_model::Driveline, text: QuestionText) -> HistoryResult {
    history(line, Verb::Simulate, &text)
}

fn at(result: &HistoryResult, channel: &str, time: f64) -> f64 {
    result.table().interpolate(channel, time).unwrap_or_else(|| panic!("{channel} at {time}"))
}

// Source: the definition of the order: halving the step divides the error by 2⁸. The equations
// are those of the driveline of Table 1 with the softening shaft, forced; the reference is the same
// integration at a 16 times finer step.
#[test]
fn the_order_of_convergence_is_eight() {
    let line = driveline(&["engine torque.amplitude=400"]);
    let equations = EquationsOfMotion::new(&line).expect("is sound");
    let end_state = |steps: u32| {
        let motion =
            Motion::new(&equations, Active { frequency: Some(20.0), ..Active::all(None) }, false);
        let motion = {
            let mut m = motion;
            m.switch_pulses(1.0);
            m
        };
        let start = {
            let mut s = motion.zero_state();
            s[0] = 0.3;
            s
        };
        let settings = Settings { fixed_step: Some(0.5 / f64::from(steps)), ..Settings::default() };
        let mut integrator = Dop853::new(motion, 0.0, &start, settings).expect("starts");
        while integrator.time() < 0.5 {
            integrator.step(0.5).expect("steps");
        }
        integrator.state().to_vec()
    };
    let reference = end_state(1024);
    let error = |steps: u32| {
        let state = end_state(steps);
        state.iter().zip(&reference).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    };
    let order = (error(32) / error(64)).log2();
    assert!((order - 8.0).abs() < 0.4, "order {order}, errors {} {}", error(32), error(64));
}

// Source: energy balance: initial + work - heat = stored, closed to a few times the tolerance.
#[test]
fn the_energy_balance_closes_to_the_tolerance() {
    for (tolerance, settings) in [(1e-6, []), (1e-9, []), (1e-12, [])] {
        let line = driveline(&settings);
        let text = QuestionText {
            tolerance: some(&tolerance.to_string()),
            frequency: some("22 rad/s"),
            start: some("equilibrium"),
            duration: some("4s"),
            ..QuestionText::default()
        };
        let result = simulate(&line, text);
        let energy = result.metrics.energy_balance.expect("an integration");
        let bound = 20.0 * tolerance;
        assert!(energy.relative_residual < bound, "{tolerance:e}: {energy:?}");
        assert!(energy.dissipated > 0.0);
        assert!(result.header.warnings.is_empty(), "{:?}", result.header.warnings);
    }
}

// Source: conservation: an undamped line that nothing drives keeps its energy; the drift is bounded
// by 100 machine epsilons times the steps at the tightest tolerance.
#[test]
fn an_undamped_line_keeps_its_energy() {
    let line = oscillator(&["spring.damping=0", "excitation.amplitude=1e-300"]);
    let text = QuestionText {
        tolerance: some("1e-14"),
        initial: vec!["spring.twist=2 rad".to_owned()],
        duration: some("20s"),
        ..QuestionText::default()
    };
    let result = simulate(&line, text);
    let energy = result.metrics.energy_balance.expect("an integration");
    let drift = (energy.stored / energy.initial - 1.0).abs();
    let bound = 100.0 * f64::EPSILON * result.metrics.steps as f64;
    assert!(drift < bound, "{drift:e} against {bound:e}");
}

// Source: exact solution of the damped linear oscillator released from rest.
#[test]
fn a_linear_line_follows_its_exact_solution() {
    let line = driveline(&["half-shaft.cubic=0", "engine torque.mean=0", "road load.pulse.peak=0"]);
    let text = QuestionText {
        initial: vec!["half-shaft.twist=0.4 rad".to_owned()],
        tolerance: some("1e-12"),
        duration: some("2s"),
        ..QuestionText::default()
    };
    let result = simulate(&line, text);
    let (jm, jl) = (0.328 * 5.71 * 5.71, 81.6);
    let j = jm * jl / (jm + jl);
    let (decay, omega2): (f64, f64) = (90.0 / (2.0 * j), 6420.0 / j);
    let omega = (omega2 - decay * decay).sqrt();
    for time in [0.1, 0.5, 1.0, 2.0] {
        let (sin, cos) = (omega * time).sin_cos();
        let exact = 0.4 * (-decay * time).exp() * (cos + decay / omega * sin);
        assert!((at(&result, "half-shaft.twist", time) - exact).abs() < 1e-11);
        let rate = -0.4 * (-decay * time).exp() * omega2 / omega * sin;
        assert!((at(&result, "half-shaft.twist_rate", time) - rate).abs() < 1e-10);
        let torque = 6420.0 * exact + 90.0 * rate;
        assert!((at(&result, "half-shaft.torque", time) - torque).abs() < 1e-7);
    }
    // Nothing acts from outside, so the line as a whole stays where it was.
    let together =
        jm * at(&result, "half-shaft flange.angle", 1.0) + jl * at(&result, "vehicle.angle", 1.0);
    assert!(together.abs() < 1e-10);
}

// Source: reference transients, "Geared line" (tolerance 1e-11 or better): Modelica's example
// Rotational.First, whose damper of 10 N·m·s/rad acts from inertia 2 to ground.
#[test]
fn the_geared_line_agrees_with_the_reference() {
    let text = "format = 1\nname = \"x\"\n[[inertia]]\nname = \"motor\"\ninertia = 0.1\n\
        [[gear]]\nname = \"g\"\ninput = \"motor\"\noutput = \"two\"\nratio = 10\n\
        [[inertia]]\nname = \"two\"\ninertia = 2\n[[inertia]]\nname = \"load\"\ninertia = 2\n\
        [[shaft]]\nname = \"s\"\nfrom = \"two\"\nto = \"load\"\nstiffness = 1e4\n\
        [[torque]]\nname = \"t\"\non = \"motor\"\namplitude = 10\nphase = \"-90 deg\"\n";
    let line = line_of(text, &["two.damping=10"]);
    let result = simulate(
        &line,
        QuestionText {
            frequency: some("5 Hz"),
            duration: some("1s"),
            tolerance: some("1e-12"),
            ..QuestionText::default()
        },
    );
    let expected = [
        (0.1, 0.429_616_205, 0.494_685_357),
        (0.25, 0.187_570_452, 0.240_268_635),
        (0.5, 0.371_995_049, 0.472_063_857),
        (0.75, 0.122_782_843, 0.159_685_818),
        (1.0, -0.112_249_309, -0.138_145_28),
    ];
    for (time, two, load) in expected {
        assert!((at(&result, "two.speed", time) - two).abs() < 1e-9, "two at {time}");
        assert!((at(&result, "load.speed", time) - load).abs() < 1e-9, "load at {time}");
        assert_close(
            at(&result, "motor.speed", time),
            10.0 * at(&result, "two.speed", time),
            1e-13,
        );
    }
}

// Source: reference transients, "Forced Duffing": 200 periods, 34-digit Taylor.
#[test]
fn the_forced_duffing_oscillator_agrees_with_the_taylor_reference() {
    let line =
        oscillator(&["spring.stiffness=679", "spring.damping=0.0952", "excitation.amplitude=15"]);
    let end = 200.0 * std::f64::consts::TAU / 26.1;
    let result = simulate(
        &line,
        QuestionText {
            frequency: some("26.1"),
            duration: some(&format!("{end:?}")),
            step: some(&format!("{:?}", end / 10.0)),
            initial: vec!["spring.twist=0.1".to_owned()],
            tolerance: some("1e-13"),
            ..QuestionText::default()
        },
    );
    let last = |channel: &str| *result.values(channel).last().expect("has samples");
    assert!((last("spring.twist") + 2.056_173_482_458_339).abs() < 1e-9);
    assert!((last("spring.twist_rate") - 31.139_482_849_108_91).abs() < 3e-8);
}

// Source: theory 6 (figures 15 and 16): 0.564 068 and 2.951 076 by tight integration from rest,
// measured from 500 s to 700 s.
#[test]
fn steady_amplitudes_of_figures_15_and_16_are_reproduced() {
    for (frequency, expected) in [("26.56", 0.564_068), ("26.06", 2.951_076)] {
        let result = simulate(
            &oscillator(&["excitation.amplitude=15"]),
            QuestionText {
                frequency: some(frequency),
                duration: some("700s"),
                record: some("500s..700s"),
                ..QuestionText::default()
            },
        );
        assert_close(result.metrics.channels["spring.twist"].amplitude, expected, 1e-6);
    }
}

// Source: an impulse P on an inertia changes its speed by P/J; half-sine, rectangle and impulse of
// equal angular impulse leave the same momentum behind.
#[test]
fn pulses_change_the_momentum_by_their_angular_impulse() {
    let pulse = |shape: &str| {
        let text = chain(&[2.0, 3.0], &[100.0], None, 1.0)
            + &format!(
                "[[torque]]\nname = \"t\"\non = \"n1\"\npulse = {{ {shape}, start = 0.2 }}\n"
            );
        let result = simulate(
            &line_of(&text, &[]),
            QuestionText {
                duration: some("3s"),
                tolerance: some("1e-12"),
                ..QuestionText::default()
            },
        );
        let energy = result.metrics.energy_balance.expect("an integration");
        assert!(energy.relative_residual < 1e-10, "{energy:?}");
        2.0 * at(&result, "n0.speed", 3.0) + 3.0 * at(&result, "n1.speed", 3.0)
    };
    let peak = std::f64::consts::PI / 2.0 * 6.0 / 0.1;
    assert_close(
        pulse(&format!("shape = \"half-sine\", peak = {peak}, duration = 0.1")),
        6.0,
        1e-10,
    );
    assert_close(pulse("shape = \"rectangle\", peak = 60, duration = 0.1"), 6.0, 1e-10);
    assert_close(pulse("shape = \"impulse\", impulse = 6"), 6.0, 1e-12);
    // A ramp of 0.1 s to 2 N·m that stays: 0.1 N·m·s and then 2.7 s of 2 N·m.
    let ramp = pulse("shape = \"ramp\", peak = 2, duration = 0.1");
    assert_close(ramp, 0.1 + 2.0 * 2.7, 1e-10);
}

// Source: the definition of an impulse as the limit of short rectangles.
#[test]
fn an_impulse_inside_the_run_is_the_limit_of_short_rectangles() {
    let run = |pulse: &str| {
        let text = chain(&[2.0], &[], Some(50.0), 0.0)
            + &format!("[[torque]]\nname = \"t\"\non = \"n0\"\npulse = {{ {pulse} }}\n");
        let result = simulate(
            &line_of(&text, &[]),
            QuestionText { duration: some("2s"), ..QuestionText::default() },
        );
        at(&result, "held.twist", 2.0)
    };
    let impulse = run("shape = \"impulse\", impulse = 3, start = 0.5");
    let omega = 5.0_f64;
    assert_close(impulse, 3.0 / (2.0 * omega) * (omega * 1.5).sin(), 1e-9);
    let short = run("shape = \"rectangle\", peak = 3e4, duration = 1e-4, start = 0.49995");
    assert_close(short, impulse, 1e-6);
}

// Source: calculus: the mean, minimum and maximum of cos over part of its period, wherever the steps
// of the integration fall.
#[test]
fn what_is_measured_begins_and_ends_with_the_record() {
    let text = chain(&[2.0], &[], Some(50.0), 0.0);
    let (from, to, omega) = (0.505_f64, 0.895_f64, 5.0_f64);
    let result = simulate(
        &line_of(&text, &[]),
        QuestionText {
            duration: some("2s"),
            record: some("0.505..0.895"),
            initial: vec!["n0.angle=1".to_owned()],
            tolerance: some("1e-12"),
            ..QuestionText::default()
        },
    );
    let metrics = &result.metrics.channels["n0.angle"];
    let mean = ((omega * to).sin() - (omega * from).sin()) / omega / (to - from);
    assert!((metrics.mean - mean).abs() < 1e-8, "{} {mean}", metrics.mean);
    assert!((metrics.maximum - (omega * to).cos()).abs() < 1e-9);
    assert!((metrics.minimum + 1.0).abs() < 1e-9);
}

// Source: Newton's law: an impulse P changes the speed by P/J at once; a sample of that very time is
// the state after it, wherever in the history it stands.
#[test]
fn a_sample_at_the_time_of_an_impulse_is_the_state_after_it() {
    for start in [0.0, 0.25] {
        let text = chain(&[2.0], &[], Some(50.0), 0.0)
            + &format!(
                "[[torque]]\nname = \"t\"\non = \"n0\"\n\
                 pulse = {{ shape = \"impulse\", impulse = 3, start = {start} }}\n"
            );
        let text_of =
            QuestionText { duration: some("1s"), step: some("0.125s"), ..QuestionText::default() };
        let result = simulate(&line_of(&text, &[]), text_of);
        assert_eq!(result.values("time").len(), 9);
        assert_close(at(&result, "n0.speed", start), 1.5, 1e-12);
    }
}

// Source: uniform acceleration: the angle of a free line under a mean torque is a t²/2, and after
// many turns the twist has lost no digit.
#[test]
fn long_runs_of_a_turning_line_keep_the_digits_of_the_twist() {
    let text = chain(&[2.0, 3.0], &[1000.0], None, 40.0)
        + "[[torque]]\nname = \"t\"\non = \"n0\"\nmean = 50\n";
    let result = simulate(
        &line_of(&text, &[]),
        QuestionText {
            duration: some("100s"),
            tolerance: some("1e-12"),
            ..QuestionText::default()
        },
    );
    let mean_angle = 0.5 * (50.0 / 5.0) * 100.0 * 100.0;
    let angle = 0.4 * at(&result, "n0.angle", 100.0) + 0.6 * at(&result, "n1.angle", 100.0);
    assert_close(angle, mean_angle, 1e-11);
    assert_close(at(&result, "s0.twist", 100.0), 3.0 * 10.0 / 1000.0, 1e-11);
}

// Source: a shaft wound past its capacity by a steady overload runs away; the answer says so.
#[test]
fn a_runaway_ends_with_a_reason_and_what_was_reached() {
    let line = driveline(&["gearbox.ratio=1.79"]);
    let result = simulate(&line, QuestionText { duration: some("10s"), ..QuestionText::default() });
    assert_ne!(result.header.termination.reason, Reason::Completed);
    let detail = result.header.termination.detail.clone().expect("says why");
    assert!(detail.contains("runs away"), "{detail}");
    assert_eq!(result.header.termination.reason, Reason::RunsAway);
    let warnings = result.header.warnings.join("; ");
    assert!(warnings.contains("needs 8688 N·m on the half-shaft"), "{warnings}");
    assert!(!warnings.contains("energy"), "{warnings}");
    assert!(result.values("time").len() > 10);
    assert!(result.values("time").len() == result.values("half-shaft.twist").len());
}

// Source: the channels' definitions; initial values are met exactly and leave the rest alone.
#[test]
fn initial_values_are_met_and_leave_the_rest_alone() {
    let text = chain(&[2.0, 3.0, 4.0], &[1000.0, 500.0], None, 1.0);
    let start = |initial: &[&str]| {
        simulate(
            &line_of(&text, &[]),
            QuestionText {
                duration: some("0.01s"),
                initial: initial.iter().map(|s| (*s).to_owned()).collect(),
                ..QuestionText::default()
            },
        )
    };
    let result = start(&["s1.twist=0.3 rad", "s0.twist_rate=2 rad/s"]);
    assert_close(at(&result, "s1.twist", 0.0), 0.3, 1e-15);
    assert_eq!(at(&result, "s0.twist", 0.0), 0.0);
    assert_close(at(&result, "s0.twist_rate", 0.0), 2.0, 1e-15);
    assert_eq!(at(&result, "s1.twist_rate", 0.0), 0.0);
    let momentum = 2.0 * at(&result, "n0.speed", 0.0)
        + 3.0 * at(&result, "n1.speed", 0.0)
        + 4.0 * at(&result, "n2.speed", 0.0);
    assert!(momentum.abs() < 1e-14);
    let result = start(&["n1.speed=100 rpm"]);
    assert_close(at(&result, "n1.speed", 0.0), 100.0 * std::f64::consts::PI / 30.0, 1e-14);
    assert!(at(&result, "n0.speed", 0.0).abs() < 1e-14);
    let result = start(&["n1.angle=1 rad", "s0.twist=0.5 rad"]);
    assert_close(at(&result, "n1.angle", 0.0), 1.0, 1e-14);
    assert_close(at(&result, "s0.twist", 0.0), 0.5, 1e-14);
}

// Source: effort is part of the promise: steps of an 8th-order method per period of vibration.
#[test]
fn the_effort_stays_within_bounds() {
    let result = simulate(
        &oscillator(&[]),
        QuestionText { frequency: some("26"), duration: some("100s"), ..QuestionText::default() },
    );
    let periods = 100.0 * 26.06 / std::f64::consts::TAU;
    let per_period = result.metrics.steps as f64 / periods;
    assert!(per_period < 25.0, "{per_period} steps a period at 1e-10");
    assert!(result.metrics.evaluations < 16 * (result.metrics.steps + 10));
}
