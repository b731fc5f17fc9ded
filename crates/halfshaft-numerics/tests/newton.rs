//! Newton's method.

use halfshaft_numerics::Error;
use halfshaft_numerics::dense::Matrix;
use halfshaft_numerics::newton::{Convergence, Settings, Solution, solve};

/// Rosenbrock's function as two equations; solution (1, 1).
fn rosenbrock(start: [f64; 2], scale: f64, settings: &Settings) -> Solution {
    let residual = |x: &[f64], out: &mut [f64]| {
        out[0] = scale * 10.0 * (x[1] - x[0] * x[0]);
        out[1] = 1.0 - x[0];
    };
    let jacobian = |x: &[f64], out: &mut Matrix| {
        out[(0, 0)] = -scale * 20.0 * x[0];
        out[(0, 1)] = scale * 10.0;
        out[(1, 0)] = -1.0;
    };
    solve(residual, jacobian, &start, settings).expect("arguments fit")
}

/// Source of truth: the exact solution (1, 1).
#[test]
fn rosenbrock_converges_and_does_not_care_for_the_scale_of_equations() {
    let settings = Settings::default();
    let plain = rosenbrock([-1.2, 1.0], 1.0, &settings);
    assert!(plain.report.converged.is_converged());
    assert!(plain.unknowns.iter().all(|x| (x - 1.0).abs() < 1e-10));
    // A power of two scales without rounding: the iterates must be the same numbers.
    let scaled = rosenbrock([-1.2, 1.0], 1024.0, &settings);
    assert_eq!(scaled.unknowns, plain.unknowns);
    assert_eq!(scaled.report.iterations, plain.report.iterations);
    assert!(plain.report.iterations <= 12, "{} iterations", plain.report.iterations);
}

/// Source of truth: the order two of Newton's method at a simple root: `x² = 2` from 1.
#[test]
fn convergence_is_quadratic() {
    let settings = Settings { step_tolerance: 1e-15, ..Settings::default() };
    let solution = solve(
        |x, out| out[0] = x[0] * x[0] - 2.0,
        |x, out| out[(0, 0)] = 2.0 * x[0],
        &[1.0],
        &settings,
    )
    .expect("arguments fit");
    assert!((solution.unknowns[0] - 2.0_f64.sqrt()).abs() < 1e-15);
    let steps: Vec<f64> = solution.report.history.iter().map(|step| step.step_norm).collect();
    for pair in steps.windows(2).filter(|pair| pair[1] > 1e-7) {
        assert!(pair[1] < 0.6 * pair[0] * pair[0], "{steps:?}");
    }
    assert!(solution.report.history.iter().all(|step| step.damping == 1.0));
}

/// Source of truth: `arctan x = 0`; the undamped method diverges for starts beyond 1.39.
#[test]
fn damping_makes_a_poor_start_converge() {
    let solution = solve(
        |x, out| out[0] = x[0].atan(),
        |x, out| out[(0, 0)] = 1.0 / (1.0 + x[0] * x[0]),
        &[30.0],
        &Settings::default(),
    )
    .expect("arguments fit");
    assert!(solution.report.converged.is_converged());
    assert!(solution.unknowns[0].abs() < 1e-10);
    assert!(solution.report.history.iter().any(|step| step.damping < 1.0));
}

/// Source of truth: `√x = 1` is not defined left of zero, where the full first step from 9 leads.
#[test]
fn a_step_out_of_the_domain_is_halved() {
    let solution = solve(
        |x, out| out[0] = x[0].sqrt().ln(),
        |x, out| out[(0, 0)] = 0.5 / x[0],
        &[9.0],
        &Settings::default(),
    )
    .expect("arguments fit");
    assert!(solution.report.converged.is_converged());
    assert!((solution.unknowns[0] - 1.0).abs() < 1e-9);
}

/// Source of truth: the documented reasons. `x² + 1` has no real root.
#[test]
fn every_end_has_its_reason() {
    let none = |start: f64, settings: &Settings| {
        solve(
            |x, out| out[0] = x[0] * x[0] + 1.0,
            |x, out| out[(0, 0)] = 2.0 * x[0],
            &[start],
            settings,
        )
        .expect("arguments fit")
    };
    let settings = Settings::default();
    let stalled = none(0.7, &settings).report;
    assert!(!stalled.converged.is_converged());
    assert!(stalled.residual_norm >= 1.0);
    assert_eq!(none(0.0, &settings).report.converged, Convergence::SingularJacobian);
    let impatient = Settings { iteration_limit: 2, ..settings.clone() };
    let far = rosenbrock([-1.2, 1.0], 1.0, &impatient);
    assert_eq!((far.report.converged, far.report.iterations), (Convergence::IterationLimit, 2));
    let easy = Settings { residual_tolerance: 5.0, ..settings.clone() };
    let there = rosenbrock([-1.2, 1.0], 1.0, &easy);
    assert_eq!((there.report.converged, there.report.iterations), (Convergence::Residual, 0));
    let empty = solve(|_, _| {}, |_, _| {}, &[], &settings).expect("nothing to solve");
    assert_eq!(empty.report.converged, Convergence::Residual);
}

/// Source of truth: the documented errors.
#[test]
fn misuse_is_told() {
    let run = |start: f64, settings: &Settings| {
        solve(|x, out| out[0] = x[0].ln(), |x, out| out[(0, 0)] = 1.0 / x[0], &[start], settings)
    };
    let settings = Settings::default();
    assert!(matches!(run(-1.0, &settings), Err(Error::NonFinite { .. })));
    assert!(matches!(run(f64::NAN, &settings), Err(Error::NonFinite { .. })));
    for wrong in [
        Settings { step_tolerance: 0.0, ..settings.clone() },
        Settings { residual_tolerance: f64::NAN, ..settings.clone() },
        Settings { smallest_damping: 2.0, ..settings.clone() },
        Settings { typical: vec![0.0], ..settings.clone() },
    ] {
        assert!(matches!(run(1.0, &wrong), Err(Error::Setting { .. })), "{wrong:?}");
    }
    let lengths = Settings { typical: vec![1.0, 1.0], ..settings };
    assert!(matches!(run(1.0, &lengths), Err(Error::Length { .. })));
}
