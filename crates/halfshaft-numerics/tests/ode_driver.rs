//! Integration through break times, watched by an observer.

mod reference;

use std::ops::ControlFlow;

use halfshaft_numerics::Error;
use halfshaft_numerics::ode::dop853::{Dop853, Step};
use halfshaft_numerics::ode::{Finish, Settings, System, function, integrate};
use reference::Duffing;

/// `x'' + x = force`, the force constant between breaks.
struct Pushed {
    force: f64,
}

impl System for Pushed {
    fn dimension(&self) -> usize {
        2
    }

    fn derivative(&mut self, _: f64, state: &[f64], rate: &mut [f64]) {
        rate[0] = state[1];
        rate[1] = self.force - state[0];
    }
}

fn pushed() -> Dop853<Pushed> {
    Dop853::new(Pushed { force: 0.0 }, 0.0, &[0.0, 0.0], Settings::with_tolerance(1e-12))
        .expect("the arguments fit")
}

/// Source of truth: superposition. A unit step at `a` answers `1 - cos(t - a)`, an impulse at `a`
/// answers `sin(t - a)`.
#[test]
fn steps_and_impulses_superpose() {
    let mut integrator = pushed();
    let (impulse_first, step, impulse) = (0.0, 1.25, 3.0);
    let mut seen = Vec::new();
    let finish = integrate(
        &mut integrator,
        10.0,
        &[impulse_first, step, impulse],
        |time, system, state| {
            seen.push(time);
            if time == step {
                system.force = 2.0;
            } else {
                state[1] += 0.5;
            }
        },
        |_| ControlFlow::Continue(()),
    );
    assert_eq!(finish, Ok(Finish::Reached));
    assert_eq!(seen, [impulse_first, step, impulse]);
    assert_eq!(integrator.time(), 10.0);
    let t = integrator.time();
    let exact = 0.5 * (t - impulse_first).sin()
        + 2.0 * (1.0 - (t - step).cos())
        + 0.5 * (t - impulse).sin();
    assert!((integrator.state()[0] - exact).abs() < 1e-10);
    // A force that jumps at known times costs no rejected steps.
    assert_eq!(integrator.statistics().rejected, 0);
}

/// Source of truth: the documented rule that a break belongs to the interval it begins.
#[test]
fn consecutive_calls_handle_each_break_once() {
    let mut integrator = pushed();
    let breaks = [-1.0, 0.0, 2.0, 4.0, 6.0];
    let mut count = 0;
    for t_end in [2.0, 4.0, 5.0] {
        let kick = |_: f64, _: &mut Pushed, _: &mut [f64]| count += 1;
        integrate(&mut integrator, t_end, &breaks, kick, |_| ControlFlow::Continue(()))
            .expect("harmless");
    }
    assert_eq!(count, 3);
}

/// Source of truth: an impulse that is undone on the way back leads back to the start.
#[test]
fn breaks_work_backwards() {
    let mut integrator = pushed();
    integrator.restart_with(|_, state| state.copy_from_slice(&[1.0, 0.0])).expect("finite");
    let forwards = |_: f64, _: &mut Pushed, state: &mut [f64]| state[1] += 0.3;
    let backwards = |_: f64, _: &mut Pushed, state: &mut [f64]| state[1] -= 0.3;
    integrate(&mut integrator, 5.0, &[1.0, 2.0], forwards, |_| ControlFlow::Continue(()))
        .expect("harmless");
    integrate(&mut integrator, 0.0, &[2.0, 1.0], backwards, |_| ControlFlow::Continue(()))
        .expect("harmless");
    assert!((integrator.state()[0] - 1.0).abs() < 1e-10 && integrator.state()[1].abs() < 1e-10);
}

/// Source of truth: the first zero of cos is π/2; the steps join without gaps, and their dense
/// output meets the states at both ends.
#[test]
fn an_observer_sees_every_step_and_may_stop() {
    let mut integrator = pushed();
    integrator.reset(0.0, &[1.0, 0.0]).expect("finite");
    let mut last = 0.0;
    let mut crossing = None;
    let finish = integrate(
        &mut integrator,
        100.0,
        &[0.7],
        |_, _, _| {},
        |mut step| {
            assert_eq!(step.previous_time(), last);
            last = step.time();
            let (from, to) = (step.previous_state()[0], step.state()[0]);
            let (start, end) = (step.previous_time(), step.time());
            let dense = step.dense();
            assert!((dense.component(0, start) - from).abs() < 1e-15);
            assert!((dense.component(0, end) - to).abs() < 1e-14);
            if to >= 0.0 {
                return ControlFlow::Continue(());
            }
            let settings = halfshaft_numerics::bracket::RootSettings::default();
            let zero = halfshaft_numerics::bracket::find_root(
                |t| dense.component(0, t),
                start,
                end,
                settings,
            );
            crossing = zero.ok().map(|root| root.value);
            ControlFlow::Break(())
        },
    );
    assert_eq!(finish, Ok(Finish::Interrupted));
    let crossing = crossing.expect("cos changes its sign");
    assert!((crossing - std::f64::consts::FRAC_PI_2).abs() < 1e-9);
    assert_eq!(integrator.time(), last);
}

/// Source of truth: the documented errors.
#[test]
fn misuse_is_told() {
    let run = |t_end: f64, breaks: &[f64], kick: f64| {
        let change = |_: f64, _: &mut Pushed, state: &mut [f64]| state[1] = kick;
        integrate(&mut pushed(), t_end, breaks, change, |_| ControlFlow::Continue(()))
    };
    let unordered = run(5.0, &[1.0, 3.0, 2.0], 0.0);
    assert_eq!(unordered, Err(Error::BreaksNotOrdered { index: 2, time: 2.0 }));
    assert!(run(-5.0, &[1.0, 3.0], 0.0).is_err());
    assert!(run(5.0, &[f64::NAN], 0.0).is_err());
    assert!(run(5.0, &[1.0, f64::NAN], 0.0).is_err());
    assert!(matches!(run(5.0, &[1.0], f64::NAN), Err(Error::NonFinite { .. })));
    assert!(matches!(run(f64::NAN, &[], 0.0), Err(Error::Stopped(_))));
    let mut integrator = pushed();
    assert!(integrator.reset(0.0, &[1.0]).is_err());
    assert!(integrator.reset(f64::INFINITY, &[1.0, 0.0]).is_err());
    assert_eq!((integrator.time(), integrator.state()), (0.0, &[0.0, 0.0][..]));
}

/// Source of truth: after a reset the integrator must behave like a new one.
#[test]
fn a_reset_integrator_is_like_a_new_one() {
    let settings = Settings::with_tolerance(1e-9);
    let problem = Duffing::DRIVELINE;
    let mut old = Dop853::new(problem, 0.0, &[2.0, 0.0], settings.clone()).expect("fits");
    while old.step(1.0).expect("harmless") == Step::Advanced {}
    old.reset(0.3, &[0.1, 0.0]).expect("finite");
    assert_eq!((old.time(), old.previous_time()), (0.3, 0.3));
    assert_eq!(old.dense().component(0, 0.3), 0.1);
    assert_eq!(old.dense().derivative(1, 0.3), 0.0);
    let mut new = Dop853::new(problem, 0.3, &[0.1, 0.0], settings).expect("fits");
    while new.step(2.0).expect("harmless") == Step::Advanced {
        old.step(2.0).expect("harmless");
        assert_eq!(old.time(), new.time());
        assert_eq!(old.state(), new.state());
        assert_eq!(old.rate(), new.rate());
    }
}

/// Source of truth: a system behind a reference and the same one by value give the same numbers,
/// and the integrator hands the system back.
#[test]
fn systems_may_be_borrowed() {
    let mut calls = 0;
    let mut system = function(1, |_, y: &[f64], rate: &mut [f64]| {
        calls += 1;
        rate[0] = -y[0];
    });
    let mut integrator = Dop853::new(&mut system, 0.0, &[1.0], Settings::default()).expect("fits");
    while integrator.step(1.0).expect("harmless") == Step::Advanced {}
    let work = integrator.statistics();
    assert_eq!(integrator.into_system().dimension(), 1);
    assert_eq!(calls, work.evaluations);
}
