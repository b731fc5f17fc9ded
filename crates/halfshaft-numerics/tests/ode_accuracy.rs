//! Accuracy, effort and robustness of the adaptive integrator.

mod reference;

use halfshaft_numerics::Error;
use halfshaft_numerics::ode::dop853::{Dop853, Statistics, Step};
use halfshaft_numerics::ode::{Settings, Stop, System, Tolerance, function};
use reference::{Chain, Duffing, Kepler, free_duffing};

fn run<S: System>(system: S, start: &[f64], t_end: f64, settings: Settings) -> Dop853<S> {
    let mut integrator = Dop853::new(system, 0.0, start, settings).expect("the arguments fit");
    while integrator.step(t_end).expect("the problem is harmless") == Step::Advanced {}
    assert_eq!(integrator.time(), t_end);
    integrator
}

fn driveline(tolerance: f64) -> (f64, Statistics) {
    let problem = Duffing::DRIVELINE;
    let settings = Settings::with_tolerance(tolerance);
    let t_end = 200.0 * problem.period();
    let integrator = run(problem, &Duffing::DRIVELINE_START, t_end, settings);
    let [x, v] = Duffing::DRIVELINE_AFTER_200;
    let state = integrator.state();
    // The speed is larger than the displacement by the frequency.
    let error = (state[0] - x).abs().max((state[1] - v).abs() / problem.frequency);
    (error, integrator.statistics())
}

/// Source of truth: a Taylor integration with 34 digits, see [`Duffing::DRIVELINE_AFTER_200`].
#[test]
fn two_hundred_periods_of_a_forced_oscillation() {
    for (tolerance, most) in [(1e-6, 1e-4), (1e-9, 5e-8), (1e-12, 5e-11), (1e-13, 1e-11)] {
        let (error, _) = driveline(tolerance);
        assert!(error < most, "tolerance {tolerance:e}: error {error:e}");
    }
}

/// Source of truth: the effort of two other implementations of the same pair on this problem: 2841
/// steps (a prototype) and 2838 (differential-equations 0.7), 12 evaluations each.
#[test]
fn the_effort_is_that_of_the_published_program() {
    let (_, work) = driveline(1e-9);
    assert!((2800..2880).contains(&work.accepted), "{work:?}");
    assert!(work.rejected < 30, "{work:?}");
    // Without dense output: twelve for each step, eleven for a rejected one, two to start.
    assert_eq!(work.evaluations, 12 * work.accepted + 11 * work.rejected + 2);
}

/// Source of truth: the energy of the free oscillation is constant; and its exact solution.
#[test]
fn energy_drifts_by_no_more_than_the_tolerance_allows() {
    let problem = Duffing { damping: 0.0, stiffness: 1.0, cubic: 0.7, force: 0.0, frequency: 0.0 };
    let start = [1.5, 0.0];
    let tolerance = 1e-12;
    let settings = Settings::with_tolerance(tolerance);
    let mut integrator = Dop853::new(problem, 0.0, &start, settings).expect("fits");
    let before = problem.energy(&start);
    let t_end = 500.0;
    while integrator.time() < t_end {
        integrator.step(t_end).expect("harmless");
        let drift = problem.energy(integrator.state()) / before - 1.0;
        // At most one tolerance for each step: no faster than linear in time.
        let steps = integrator.statistics().accepted as f64;
        assert!(drift.abs() < tolerance * steps, "drift {drift:e} after {steps} steps");
    }
    let exact = free_duffing(1.0, 0.7, 1.5, t_end);
    assert!((integrator.state()[0] - exact[0]).abs() < 1e-8);
}

/// Source of truth: going back leads to where it came from.
#[test]
fn reversal_returns_to_the_start() {
    let settings = Settings::with_tolerance(1e-12);
    let mut integrator = run(Kepler, &Kepler::START, 20.0, settings.clone());
    while integrator.step(0.0).expect("harmless") == Step::Advanced {
        assert!(integrator.time() < integrator.previous_time());
    }
    for (a, b) in integrator.state().iter().zip(Kepler::START) {
        // An error of the energy lets the place on the ellipse run away with the square of time.
        assert!((a - b).abs() < 1e-8, "{a} against {b}");
    }
    // Dense output of a backward step: the exact ellipse passes the pericentre at time zero.
    let forwards = run(Kepler, &Kepler::START, integrator.previous_time(), settings);
    let mut state = [0.0; 4];
    let start = integrator.previous_time();
    integrator.dense().evaluate(start, &mut state);
    assert!((state[0] - forwards.state()[0]).abs() < 1e-9);
}

/// Source of truth: independent copies of one oscillator must move alike; dimensions that fill the
/// groups of components and that do not.
#[test]
fn every_dimension_is_treated_alike() {
    let settings = Settings::with_tolerance(1e-10);
    let exact = (7.0_f64.sin(), 7.0_f64.cos());
    for copies in [1, 2, 3, 5, 50] {
        let system = function(2 * copies + 1, move |_, y: &[f64], rate: &mut [f64]| {
            for k in 0..copies {
                rate[2 * k] = y[2 * k + 1];
                rate[2 * k + 1] = -y[2 * k];
            }
            rate[2 * copies] = -y[2 * copies];
        });
        let mut start = [0.0, 1.0].repeat(copies);
        start.push(1.0);
        let mut integrator = run(system, &start, 7.0, settings.clone());
        let mut dense = vec![0.0; 2 * copies + 1];
        integrator.dense().evaluate(7.0, &mut dense);
        for (state, tolerance) in [(integrator.state(), 1e-9), (&dense[..], 1e-8)] {
            for pair in state[..2 * copies].chunks(2) {
                assert!((pair[0] - exact.0).abs() < tolerance);
                assert!((pair[1] - exact.1).abs() < tolerance);
            }
            assert!((state[2 * copies] - (-7.0_f64).exp()).abs() < tolerance);
        }
    }
}

/// Source of truth: the balance of power: what the torque puts in, less what the dampers take out,
/// is the change of energy, integrated along as one more component.
#[test]
fn a_chain_keeps_its_power_balance() {
    let mut chain = Chain { inertias: 10, frequency: 4.6 };
    let dimension = chain.dimension();
    let system = function(dimension + 1, move |t, y: &[f64], rate: &mut [f64]| {
        chain.derivative(t, &y[..dimension], &mut rate[..dimension]);
        let speeds = &y[dimension / 2..dimension];
        let input = 5.0 * (chain.frequency * t).cos() * speeds[speeds.len() - 1];
        let ground: f64 = speeds.iter().map(|v| 0.05 * v * v).sum();
        let shafts: f64 = speeds.windows(2).map(|v| 0.5 * (v[1] - v[0]).powi(2)).sum();
        rate[dimension] = input - ground - shafts;
    });
    let integrator = run(system, &vec![0.0; dimension + 1], 30.0, Settings::with_tolerance(1e-11));
    let (angles, rest) = integrator.state().split_at(dimension / 2);
    let (speeds, work) = rest.split_at(dimension / 2);
    let twists = angles.windows(2).map(|x| x[1] - x[0]);
    let kinetic: f64 = speeds.iter().map(|v| 0.5 * v * v).sum();
    let elastic: f64 = twists.map(|x| 500.0 * x * x - 125.0 * x.powi(4)).sum();
    let energy = kinetic + elastic + 500.0 * angles[0] * angles[0];
    assert!(energy > 0.1, "the chain moves");
    assert!((energy - work[0]).abs() < 1e-8, "{energy} against {}", work[0]);
}

/// Source of truth: stated in the documentation of `step`: it lands on the goal exactly, and short
/// steps to land do not spoil the step length.
#[test]
fn landing_on_many_goals_costs_little_more_than_those_goals() {
    let problem = Duffing::DRIVELINE;
    let settings = Settings::with_tolerance(1e-9);
    let t_end = 20.0 * problem.period();
    let free = run(problem, &[0.1, 0.0], t_end, settings.clone()).statistics();
    let mut integrator = Dop853::new(problem, 0.0, &[0.1, 0.0], settings).expect("fits");
    let goals = 100;
    for k in 1..=goals {
        let goal = t_end * f64::from(k) / f64::from(goals);
        while integrator.step(goal).expect("harmless") == Step::Advanced {}
        assert_eq!(integrator.time(), goal);
        assert_eq!(integrator.step(goal), Ok(Step::Reached));
    }
    let work = integrator.statistics();
    assert!(work.accepted <= free.accepted + goals as usize + 10, "{work:?} against {free:?}");
}

/// Source of truth: the tolerance is met by each component in its own measure: a small component
/// beside a large one needs its own absolute tolerance.
#[test]
fn tolerances_per_component() {
    let system = || {
        function(4, |_, y: &[f64], rate: &mut [f64]| {
            rate.copy_from_slice(&[y[1], -y[0], y[3], -9.0 * y[2]]);
        })
    };
    let start = [1e6, 0.0, 1e-6, 0.0];
    let exact = 1e-6 * 30.0_f64.cos();
    let error = |absolute: Tolerance| {
        let settings = Settings {
            relative_tolerance: 1e-14,
            absolute_tolerance: absolute,
            ..Settings::default()
        };
        (run(system(), &start, 10.0, settings).state()[2] - exact).abs() / 1e-6
    };
    assert!(error(vec![1e-4, 1e-4, 1e-16, 1e-16].into()) < 1e-8);
    assert!(error(1e-4.into()) > 1e-8);
}

/// Source of truth: `y' = y²` from 1 becomes infinite at t = 1; `√` has no value left of zero; and
/// the other documented reasons.
#[test]
fn every_stop_has_its_reason() {
    let stop = |mut integrator: Dop853<_>, t_end: f64| loop {
        match integrator.step(t_end) {
            Ok(Step::Advanced) => {}
            Ok(Step::Reached) => panic!("arrived at {t_end}"),
            Err(stop) => {
                assert!(integrator.state().iter().all(|y| y.is_finite()));
                let state = integrator.state()[0];
                let time = integrator.time();
                assert_eq!(integrator.dense().component(0, time), state);
                break stop;
            }
        }
    };
    type Rate = fn(f64, &[f64], &mut [f64]);
    let start = |rate: Rate, y0: f64, settings: &Settings| {
        Dop853::new(function(1, rate), 0.0, &[y0], settings.clone()).expect("fits")
    };
    let settings = Settings::default();
    let square: Rate = |_, y, rate| rate[0] = y[0] * y[0];
    let Stop::StepTooSmall { time, .. } = stop(start(square, 1.0, &settings), 2.0) else {
        panic!("expected a step that became too small");
    };
    assert!((time - 1.0).abs() < 1e-9);
    let few = Settings { step_limit: 5, ..settings.clone() };
    assert!(matches!(stop(start(square, 1.0, &few), 2.0), Stop::StepLimit { limit: 5, .. }));
    let root: Rate = |t, _, rate| rate[0] = (1.0 - t).sqrt();
    let Stop::NonFinite { time } = stop(start(root, 0.0, &settings), 2.0) else {
        panic!("expected a solution that ceases to be finite");
    };
    assert!((time - 1.0).abs() < 1e-6);
    let poisoned: Rate = |_, _, rate| rate[0] = f64::NAN;
    assert_eq!(stop(start(poisoned, 0.0, &settings), 1.0), Stop::NonFinite { time: 0.0 });
    let fixed = Settings { fixed_step: Some(0.3), ..settings.clone() };
    assert!(matches!(stop(start(root, 0.0, &fixed), 2.0), Stop::NonFinite { .. }));
    assert!(matches!(stop(start(square, 1.0, &settings), f64::NAN), Stop::NonFinite { .. }));
    let overflow: Rate = |_, y, rate| rate[0] = 1e300 * y[0];
    stop(start(overflow, 1.0, &settings), 1.0);
}

/// Source of truth: the documented errors.
#[test]
fn misuse_is_told() {
    let new = |start: &[f64], settings: Settings| Dop853::new(Kepler, 0.0, start, settings).err();
    let settings = Settings::default();
    assert!(matches!(new(&[1.0], settings.clone()), Some(Error::Length { expected: 4, .. })));
    let poisoned = [f64::NAN, 0.0, 0.0, 0.0];
    assert!(matches!(new(&poisoned, settings.clone()), Some(Error::NonFinite { .. })));
    for wrong in [
        Settings { relative_tolerance: -1e-3, ..settings.clone() },
        Settings { absolute_tolerance: 0.0.into(), ..settings.clone() },
        Settings { absolute_tolerance: vec![1.0, 1.0, f64::NAN, 1.0].into(), ..settings.clone() },
        Settings { largest_step: 0.0, ..settings.clone() },
        Settings { first_step: Some(f64::NAN), ..settings.clone() },
        Settings { fixed_step: Some(-1.0), ..settings.clone() },
        Settings { safety: 1.5, ..settings.clone() },
        Settings { smallest_factor: 0.0, ..settings.clone() },
        Settings { largest_factor: 0.5, ..settings.clone() },
    ] {
        let error = new(&Kepler::START, wrong.clone());
        assert!(matches!(error, Some(Error::Setting { .. })), "{wrong:?} gave {error:?}");
    }
    let short = Settings { absolute_tolerance: vec![1.0].into(), ..settings.clone() };
    assert!(matches!(new(&Kepler::START, short), Some(Error::Length { .. })));
    let nothing = function(0, |_, _: &[f64], _: &mut [f64]| {});
    assert!(Dop853::new(nothing, 0.0, &[], settings).is_err());
}

/// Source of truth: a system at rest whose force begins later; the documented cure is a bound on
/// the step. Exact solution of `y'' = force`, a pulse of a hundredth of the interval.
#[test]
fn a_bound_on_the_step_sees_a_late_pulse() {
    let pulse = |t: f64| if (50.0..51.0).contains(&t) { (t - 50.0) * (51.0 - t) } else { 0.0 };
    let system = function(2, move |t, y: &[f64], rate: &mut [f64]| {
        rate.copy_from_slice(&[y[1], pulse(t)]);
    });
    let settings = Settings { largest_step: 0.5, ..Settings::with_tolerance(1e-9) };
    let integrator = run(system, &[0.0, 0.0], 100.0, settings);
    assert!((integrator.state()[1] - 1.0 / 6.0).abs() < 1e-7);
}
