//! What all one-step methods promise alike: orders, dense output, retaken steps, stiffness.

mod reference;

use std::ops::ControlFlow;

use halfshaft_numerics::ode::dop853::Dop853;
use halfshaft_numerics::ode::dopri5::Dopri5;
use halfshaft_numerics::ode::radau5::Radau5;
use halfshaft_numerics::ode::{
    ByColumns, ByDifferences, Finish, OneStep, Settings, Step, Stop, System, function, integrate,
};
use reference::{Chain, Duffing, Kepler, free_duffing};

const FREE: Duffing =
    Duffing { damping: 0.0, stiffness: 1.0, cubic: 0.7, force: 0.0, frequency: 0.0 };
const AMPLITUDE: f64 = 1.5;

fn all_methods(settings: &Settings) -> [Box<dyn OneStep<System = ByColumns<Duffing>>>; 3] {
    let (system, start) = (|| ByColumns::new(FREE), [AMPLITUDE, 0.0]);
    [
        Box::new(Dop853::new(system(), 0.0, &start, settings.clone()).expect("fits")),
        Box::new(Dopri5::new(system(), 0.0, &start, settings.clone()).expect("fits")),
        Box::new(Radau5::new(system(), 0.0, &start, settings.clone()).expect("fits")),
    ]
}

/// Largest errors at the end and inside the steps, for a fixed step length.
fn errors(method: usize, length: f64) -> [f64; 2] {
    let settings = Settings { fixed_step: Some(length), ..Settings::with_tolerance(1e-13) };
    let [first, second, third] = all_methods(&settings);
    let mut integrator = [first, second, third].into_iter().nth(method).expect("three methods");
    let (t_end, mut inside) = (10.0, 0.0_f64);
    let finish = integrate(
        &mut *integrator,
        t_end,
        &[],
        |_, _, _| {},
        |mut step| {
            let (from, to) = (step.previous_time(), step.time());
            for k in 0..=10 {
                let t = from + (to - from) * f64::from(k) / 10.0;
                let exact = free_duffing(FREE.stiffness, FREE.cubic, AMPLITUDE, t);
                inside = inside.max((step.dense().component(0, t) - exact[0]).abs());
            }
            ControlFlow::Continue(())
        },
    );
    assert_eq!(finish, Ok(Finish::Reached));
    let exact = free_duffing(FREE.stiffness, FREE.cubic, AMPLITUDE, t_end);
    [(integrator.state()[0] - exact[0]).hypot(integrator.state()[1] - exact[1]), inside]
}

/// Source of truth: the free Duffing oscillation by elliptic functions. Orders 8, 5, 5 at the ends;
/// inside the steps 7, 4, 3, whose local errors are of the order one higher.
#[test]
fn orders_of_convergence() {
    for (method, counts, order, inside) in
        [(0, [20, 80], 8.0, 7.0), (1, [160, 640], 5.0, 4.0), (2, [80, 320], 5.0, 3.0)]
    {
        let [coarse, fine] = counts.map(|count: u32| errors(method, 10.0 / f64::from(count)));
        let of = |k: usize| (coarse[k] / fine[k]).log2() / 2.0;
        assert!((of(0) - order).abs() < 0.6, "method {method}: {} {coarse:?} {fine:?}", of(0));
        assert!(of(1) > inside - 0.1, "method {method} inside: {} {coarse:?}", of(1));
    }
}

/// Source of truth: the documentation of `retake`: the state of one step of that length, from a
/// new integrator that starts where the step began; both dense outputs are the same polynomial.
#[test]
fn a_retaken_step_is_a_fresh_one() {
    let settings = Settings::with_tolerance(1e-7);
    for (method, mut integrator) in all_methods(&settings).into_iter().enumerate() {
        for _ in 0..7 {
            integrator.step(10.0).expect("harmless");
        }
        let (start, time) = (integrator.previous_time(), integrator.time());
        let state = integrator.previous_state().to_vec();
        for share in [0.4, 0.9, 0.1, 1.0, 0.7] {
            let end = start + share * (time - start);
            integrator.retake(end).expect("shorter");
            let length = end - start;
            let fresh = Settings { fixed_step: Some(length), ..settings.clone() };
            let mut others = all_methods(&fresh);
            let fresh = &mut others[method];
            fresh.reset(start, &state).expect("finite");
            assert_eq!(fresh.step(end), Ok(Step::Reached));
            assert_eq!((integrator.time(), integrator.previous_time()), (end, start));
            assert_eq!(integrator.previous_state(), state);
            assert_eq!(integrator.state(), fresh.state(), "method {method}, share {share}");
            assert_eq!(integrator.rate(), fresh.rate());
            let middle = start + 0.3 * length;
            assert_eq!(integrator.dense().interval(), fresh.dense().interval());
            let (a, b) = (integrator.dense().component(1, middle), fresh.dense());
            assert_eq!(a, b.component(1, middle), "method {method}, share {share}");
        }
        let stood = integrator.state().to_vec();
        for end in [start, start - 0.1, time + 0.1, f64::NAN] {
            assert!(matches!(integrator.retake(end), Err(Stop::OutsideStep { .. })));
            assert_eq!(integrator.state(), stood);
        }
        while integrator.step(10.0).expect("harmless") == Step::Advanced {}
        let exact = free_duffing(FREE.stiffness, FREE.cubic, AMPLITUDE, 10.0);
        assert!((integrator.state()[0] - exact[0]).abs() < 1e-4, "method {method}");
    }
}

/// Source of truth: the documented errors: there is no step to take again before the first, after a
/// reset and after a stop.
#[test]
fn nothing_to_retake() {
    for mut integrator in all_methods(&Settings::default()) {
        assert!(matches!(integrator.retake(0.1), Err(Stop::OutsideStep { .. })));
        integrator.step(1.0).expect("harmless");
        integrator.reset(0.5, &[1.0, 0.0]).expect("finite");
        assert!(matches!(integrator.retake(0.5), Err(Stop::OutsideStep { .. })));
        integrator.step(0.0).expect("harmless");
        let (start, end) = (integrator.previous_time(), integrator.time());
        assert_eq!(integrator.retake(0.5 * (start + end)), Ok(()), "backwards");
    }
}

/// Source of truth: the energy of an undamped oscillator is constant; a random walk of rounding
/// over ten thousand steps stays far below a thousand units of the last place.
#[test]
fn energy_at_the_tightest_tolerance() {
    let settings = Settings::with_tolerance(1e-15);
    let mut integrator = Dop853::new(FREE, 0.0, &[AMPLITUDE, 0.0], settings).expect("fits");
    let before = FREE.energy(&[AMPLITUDE, 0.0]);
    while integrator.step(500.0).expect("harmless") == Step::Advanced {}
    let drift = integrator.energy_drift(before);
    assert!(drift < 1000.0 * f64::EPSILON, "drift {drift:e}");
}

trait Energy {
    fn energy_drift(&self, before: f64) -> f64;
}

impl<I: OneStep<System = Duffing>> Energy for I {
    fn energy_drift(&self, before: f64) -> f64 {
        (self.system().energy(self.state()) / before - 1.0).abs()
    }
}

fn is_found_stiff(mut integrator: impl OneStep, t_end: f64) -> bool {
    while integrator.step(t_end).expect("harmless") == Step::Advanced {}
    let found = integrator.is_stiff();
    let state = integrator.state().to_vec();
    integrator.reset(t_end, &state).expect("finite");
    assert!(!integrator.is_stiff(), "a reset clears the finding");
    found
}

fn is_found_by_any<S: System + Clone>(
    system: &S,
    start: &[f64],
    t_end: f64,
    tolerance: f64,
) -> bool {
    let settings = Settings::with_tolerance(tolerance);
    let high = Dop853::new(system.clone(), 0.0, start, settings.clone()).expect("fits");
    let low = Dopri5::new(system.clone(), 0.0, start, settings).expect("fits");
    let (high, low) = (is_found_stiff(high, t_end), is_found_stiff(low, t_end));
    high || low
}

/// Source of truth: these motions oscillate as fast as they move at all, so that no step is held
/// back by stability, whatever the tolerance and the units.
#[test]
fn smooth_motions_are_not_stiff() {
    let driveline = Duffing::DRIVELINE;
    let undamped = Duffing { damping: 0.0, force: 0.0, ..driveline };
    for tolerance in [1e-2, 1e-3, 1e-5, 1e-7, 1e-9, 1e-12, 1e-14] {
        assert!(!is_found_by_any(&driveline, &[0.1, 0.0], 100.0, tolerance));
        assert!(!is_found_by_any(&undamped, &[0.1, 0.0], 100.0, tolerance));
        assert!(!is_found_by_any(&FREE, &[AMPLITUDE, 0.0], 1000.0, tolerance));
        // Coarser, the method of order 5 falls into the sun.
        if tolerance < 1e-4 {
            assert!(!is_found_by_any(&Kepler, &Kepler::START, 200.0, tolerance));
        }
        let chain = Chain { inertias: 4, frequency: 4.6 };
        let start = [0.1, -0.1, 0.1, -0.1, 0.0, 0.0, 0.0, 0.0];
        assert!(!is_found_by_any(&chain, &start, 1.0, tolerance));
    }
}

/// Source of truth: `y' = -1e5 (y - cos t)`, whose solution is as smooth as the cosine after a
/// moment, and the relaxation of Van der Pol's equation between two jumps.
#[test]
fn stiff_systems_are_found() {
    for tolerance in [1e-3, 1e-6, 1e-9] {
        let forced = |t: f64, y: &[f64], rate: &mut [f64]| rate[0] = -1e5 * (y[0] - t.cos());
        let settings = Settings::with_tolerance(tolerance);
        let system = || function(1, forced);
        let high = Dop853::new(system(), 0.0, &[0.0], settings.clone()).expect("fits");
        assert!(is_found_stiff(high, 0.5), "order 8, {tolerance:e}");
        let low = Dopri5::new(system(), 0.0, &[0.0], settings.clone()).expect("fits");
        assert!(is_found_stiff(low, 0.5), "order 5, {tolerance:e}");
        let implicit = ByDifferences::new(system());
        let implicit = Radau5::new(implicit, 0.0, &[0.0], settings.clone()).expect("fits");
        assert!(!is_found_stiff(implicit, 0.5));
        let relaxation = function(2, |_, y: &[f64], rate: &mut [f64]| {
            rate[0] = y[1];
            rate[1] = ((1.0 - y[0] * y[0]) * y[1] - y[0]) / 1e-4;
        });
        let high = Dop853::new(relaxation, 0.0, &[2.0, -0.66], settings).expect("fits");
        assert!(is_found_stiff(high, 0.2), "Van der Pol, {tolerance:e}");
    }
}

/// Evaluations and error after 200 periods of the forced oscillation.
fn effort<I: OneStep>(mut integrator: I) -> (usize, f64) {
    let t_end = 200.0 * Duffing::DRIVELINE.period();
    while integrator.step(t_end).expect("harmless") == Step::Advanced {}
    let [x, v] = Duffing::DRIVELINE_AFTER_200;
    let frequency = Duffing::DRIVELINE.frequency;
    let error =
        (integrator.state()[0] - x).abs().max((integrator.state()[1] - v).abs() / frequency);
    (integrator.statistics().evaluations, error)
}

/// Source of truth: the Taylor integration behind [`Duffing::DRIVELINE_AFTER_200`]; at errors of 1e-6
/// and less the order of 8 must pay.
#[test]
fn effort_at_equal_error() {
    let (system, start) = (Duffing::DRIVELINE, Duffing::DRIVELINE_START);
    let mut least = [usize::MAX; 2];
    for step in 4..=24 {
        let tolerance = 10.0_f64.powf(-0.5 * f64::from(step));
        let settings = Settings::with_tolerance(tolerance);
        let high = effort(Dop853::new(system, 0.0, &start, settings.clone()).expect("fits"));
        let low = effort(Dopri5::new(system, 0.0, &start, settings).expect("fits"));
        for (least, (evaluations, error)) in least.iter_mut().zip([high, low]) {
            if error < 1e-6 {
                *least = (*least).min(evaluations);
            }
        }
    }
    assert!(least[0] < least[1], "{least:?}");
}
