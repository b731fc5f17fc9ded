//! Periodic orbits by shooting.

mod reference;

use halfshaft_numerics::Complex;
use halfshaft_numerics::Error;
use halfshaft_numerics::fourier;
use halfshaft_numerics::newton::Convergence;
use halfshaft_numerics::ode::dop853::{Dop853, Step};
use halfshaft_numerics::ode::periodic::{PeriodicOrbit, PeriodicSettings, find_orbit};
use halfshaft_numerics::ode::{Settings, System, Variational};
use reference::{Absorber, Duffing};

/// `x'' + c x' + k x = P cos(W t)`.
const LINEAR: Duffing =
    Duffing { damping: 0.3, stiffness: 4.0, cubic: 0.0, force: 1.7, frequency: 1.6 };

fn find(mut problem: Duffing, guess: [f64; 2]) -> PeriodicOrbit {
    let period = problem.period();
    find_orbit(&mut problem, 0.0, period, &guess, &PeriodicSettings::default()).expect("fits")
}

/// The complex amplitude of the linear response, `P / (k - W² + i c W)`.
fn response(problem: &Duffing) -> Complex {
    let w = problem.frequency;
    let stiffness = Complex::new(problem.stiffness - w * w, problem.damping * w);
    Complex::from(problem.force) / stiffness
}

/// Source of truth: the linear response in closed form, and the multipliers `exp(λ T)` with
/// `λ = -c/2 ± i √(k - c²/4)`.
#[test]
fn a_linear_oscillator_is_exact() {
    let problem = LINEAR;
    let orbit = find(problem, [5.0, -3.0]);
    assert!(orbit.report.converged.is_converged());
    // The map is affine, so the first step arrives; the second at most confirms it.
    assert!(orbit.report.iterations <= 2, "{:?}", orbit.report);
    assert!(orbit.residual < 1e-10);
    let (amplitude, w) = (response(&problem), problem.frequency);
    assert!((orbit.state[0] - amplitude.re).abs() < 1e-10);
    assert!((orbit.state[1] + w * amplitude.im).abs() < 1e-10);
    let damping = 0.5 * problem.damping;
    let lambda = Complex::new(-damping, (problem.stiffness - damping * damping).sqrt());
    let exact = lambda.scaled(problem.period()).exp();
    let [first, second] = orbit.multipliers[..] else { panic!("two multipliers") };
    let found = if first.im * exact.im > 0.0 { first } else { second };
    assert!((found - exact).modulus() < 1e-10);
}

/// Source of truth: the exact harmonics of the linear response.
#[test]
fn samples_of_an_orbit_show_its_harmonics() {
    let mut problem = LINEAR;
    let orbit = find(problem, [0.0, 0.0]);
    let settings = PeriodicSettings::default().integration;
    let samples = orbit.sample(&mut problem, 32, &settings).expect("fits");
    assert_eq!((samples.rows(), samples.columns()), (2, 32));
    assert_eq!(samples.column(0), orbit.state);
    let found = fourier::harmonic(samples.row(0), 1).expect("samples");
    let amplitude = response(&problem);
    assert!((found.modulus - amplitude.modulus()).abs() < 1e-10);
    assert!((found.phase - amplitude.argument()).abs() < 1e-10);
    assert!(fourier::mean(samples.row(0)).expect("samples").abs() < 1e-10);
    let half = fourier::half_peak_to_peak(samples.row(1)).expect("samples");
    assert!((half - problem.frequency * amplitude.modulus()).abs() < 1e-9);
}

/// Source of truth: long integration: what is left of the start after 4000 periods is
/// exp(-0.0952/2 · 963) = 1e-20 of it.
#[test]
fn a_stable_orbit_is_where_long_integration_ends() {
    let problem = Duffing { frequency: 26.3, ..Duffing::DRIVELINE };
    let orbit = find(problem, [0.0, 0.0]);
    assert_eq!(orbit.report.converged, Convergence::Step);
    let period = problem.period();
    let settings = Settings::with_tolerance(1e-11);
    let mut integrator = Dop853::new(problem, 0.0, &[0.0, 0.0], settings).expect("fits");
    while integrator.step(4000.0 * period).expect("harmless") == Step::Advanced {}
    assert!((integrator.state()[0] - orbit.state[0]).abs() < 1e-8);
    assert!((integrator.state()[1] - orbit.state[1]).abs() < 1e-7);
    assert!(orbit.multipliers.iter().all(|z| z.modulus() < 1.0));
}

/// Source of truth: Liouville's formula: the product of the multipliers is exp(-c T).
#[test]
fn multipliers_obey_liouvilles_formula() {
    for frequency in [20.0, 25.5, 26.0, 26.3, 30.0] {
        let problem = Duffing { frequency, ..Duffing::DRIVELINE };
        let orbit = find(problem, [0.0, 0.0]);
        let product = orbit.multipliers[0] * orbit.multipliers[1];
        let exact = (-problem.damping * problem.period()).exp();
        assert!((product - Complex::from(exact)).modulus() < 1e-10, "frequency {frequency}");
    }
}

const D1: Duffing =
    Duffing { damping: 0.05, stiffness: 1.0, cubic: 0.1, force: 0.18, frequency: 1.0 };

/// First harmonic of an orbit.
fn fundamental(orbit: &PeriodicOrbit, mut problem: Duffing) -> f64 {
    let settings = PeriodicSettings::default().integration;
    let samples = orbit.sample(&mut problem, 64, &settings).expect("fits");
    fourier::harmonic(samples.row(0), 1).expect("samples").modulus
}

/// Source of truth: AUTO-07p and an independent harmonic balance, which agree to all digits given:
/// at W = 1.268776 the response of D1 peaks with a fundamental of 2.830192.
#[test]
fn the_peak_of_a_hardening_response() {
    let problem = Duffing { frequency: 1.268_776, ..D1 };
    // At the peak the response lags by a quarter: x = a sin(W t).
    let orbit = find(problem, [0.0, 2.83 * problem.frequency]);
    assert!(orbit.report.converged.is_converged());
    assert!((fundamental(&orbit, problem) - 2.830_192).abs() < 1e-6);
    assert!(orbit.multipliers[0].modulus() < 1.0);
}

/// Source of truth: the same programs put the upper fold of D1 at W = 1.2696019555, fundamental
/// 2.82501671: there a multiplier is +1. The distance of the multiplier from 1 shrinks with the
/// root of the distance from the fold.
#[test]
fn a_multiplier_reaches_one_at_the_fold() {
    let fold = 1.269_601_955_5;
    let distance = |below: f64| {
        let problem = Duffing { frequency: fold - below, ..D1 };
        let orbit = find(problem, [0.05, 2.83 * problem.frequency]);
        assert!(orbit.report.converged.is_converged(), "{below}: {:?}", orbit.report);
        let near = (fundamental(&orbit, problem) - 2.825_016_71).abs();
        assert!(near < 10.0 * below.sqrt(), "fundamental off by {near}");
        assert_eq!(orbit.multipliers[0].im, 0.0);
        (1.0 - orbit.multipliers[0].re).abs()
    };
    let (far, close) = (distance(1e-5), distance(1e-7));
    assert!(close < 0.01, "multiplier off by {close}");
    assert!((far / close - 10.0).abs() < 1.0, "ratio {}", far / close);
}

/// Source of truth: AUTO-07p and an independent harmonic balance: Neimark-Sacker points of the
/// absorber at P = 0.11, multipliers on the unit circle at the given angles.
#[test]
fn a_pair_of_multipliers_crosses_the_unit_circle() {
    for (frequency, angle) in [(1.112_711_239_1, 0.560_218), (1.195_736_669_1, 0.476_273)] {
        let mut problem = Absorber { force: 0.11, frequency };
        let period = std::f64::consts::TAU / frequency;
        let orbit = response_by_continuation(&mut problem, frequency, period);
        assert!(orbit.report.converged.is_converged(), "{:?}", orbit.report);
        let pair = orbit.multipliers[0];
        assert!((pair.modulus() - 1.0).abs() < 1e-7, "{frequency}: modulus {}", pair.modulus());
        assert!((pair.argument().abs() - angle).abs() < 1e-6, "{frequency}: {}", pair.argument());
    }
}

/// The response at a frequency, followed from 0.8 upwards in small steps.
fn response_by_continuation(problem: &mut Absorber, frequency: f64, period: f64) -> PeriodicOrbit {
    let settings = PeriodicSettings::default();
    let mut guess = vec![0.0; 4];
    let count = 200;
    for k in 0..count {
        problem.frequency = 0.8 + (frequency - 0.8) * f64::from(k) / f64::from(count);
        let period = std::f64::consts::TAU / problem.frequency;
        let orbit = find_orbit(problem, 0.0, period, &guess, &settings).expect("fits");
        guess = orbit.state;
    }
    problem.frequency = frequency;
    find_orbit(problem, 0.0, period, &guess, &settings).expect("fits")
}

/// Source of truth: differences of the flow, order two: the monodromy matrix by perturbed starts.
#[test]
fn the_monodromy_matrix_is_the_derivative_of_the_flow() {
    let problem = Absorber { force: 0.11, frequency: 1.1 };
    let start = [0.3, -0.2, 0.1, 0.4];
    let settings = Settings::with_tolerance(1e-13);
    let flow = |start: &[f64]| {
        let mut integrator = Dop853::new(problem, 0.0, start, settings.clone()).expect("fits");
        while integrator.step(5.0).expect("harmless") == Step::Advanced {}
        integrator.state().to_vec()
    };
    let mut system = problem;
    let initial = Variational::<Absorber>::initial_state(&start);
    let tolerances = Variational::<Absorber>::settings(&settings, 4);
    let equation = Variational::new(&mut system);
    assert_eq!(equation.dimension(), 20);
    let mut integrator = Dop853::new(equation, 0.0, &initial, tolerances).expect("fits");
    while integrator.step(5.0).expect("harmless") == Step::Advanced {}
    let matrix = Variational::<Absorber>::matrix(integrator.state(), 4);
    let step = 1e-4;
    for column in 0..4 {
        let moved = |by: f64| {
            let mut moved = start;
            moved[column] += by;
            flow(&moved)
        };
        let (plus, minus) = (moved(step), moved(-step));
        for row in 0..4 {
            let difference = (plus[row] - minus[row]) / (2.0 * step);
            assert!((matrix[(row, column)] - difference).abs() < 1e-6, "{row}, {column}");
        }
    }
}

/// Source of truth: the documented behaviour: just outside the bistable range no orbit is near a
/// guess of rest, and the report must say so.
#[test]
fn failure_to_converge_is_reported_not_raised() {
    let mut problem = Duffing { frequency: 25.9, ..Duffing::DRIVELINE };
    let orbit = find(problem, [0.0, 0.0]);
    assert!(!orbit.report.converged.is_converged());
    assert!(orbit.residual > 1e-3);
    let settings = PeriodicSettings::default();
    let wrong = find_orbit(&mut problem, 0.0, 1.0, &[0.0], &settings);
    assert!(matches!(wrong, Err(Error::Length { expected: 2, found: 1, .. })));
    let wrong = find_orbit(&mut problem, 0.0, f64::NAN, &[0.0; 2], &settings);
    assert!(matches!(wrong, Err(Error::NonFinite { .. })));
    // A softening oscillator thrown beyond its barrier does not live for a period.
    let wrong = find_orbit(&mut problem, 0.0, 1.0, &[500.0, 1e5], &settings);
    assert!(matches!(wrong, Err(Error::Stopped(_))));
}
