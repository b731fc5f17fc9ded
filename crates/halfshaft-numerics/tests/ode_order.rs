//! Order of convergence of the integrator and of its dense output, by halving fixed steps.

mod reference;

use halfshaft_numerics::ode::dop853::{Dop853, Step};
use halfshaft_numerics::ode::{Settings, System, function};
use reference::{Duffing, free_duffing, jacobi};

fn fixed<S: System>(system: S, start: &[f64], length: f64) -> Dop853<S> {
    let settings = Settings { fixed_step: Some(length), ..Settings::default() };
    Dop853::new(system, 0.0, start, settings).expect("the arguments fit")
}

/// Error at `t_end` for `count` steps.
fn end_error<S: System>(system: S, start: &[f64], t_end: f64, count: usize, exact: &[f64]) -> f64 {
    let mut integrator = fixed(system, start, t_end / count as f64);
    while integrator.step(t_end).expect("harmless") == Step::Advanced {}
    assert_eq!(integrator.statistics().accepted, count);
    let difference = integrator.state().iter().zip(exact).map(|(a, b)| (a - b).abs());
    difference.fold(0.0, f64::max)
}

/// The power of the step length with which errors fall, from the first and the last.
fn order(errors: &[f64]) -> f64 {
    let halvings = (errors.len() - 1) as f64;
    (errors[0] / errors[errors.len() - 1]).log2() / halvings
}

const FREE: Duffing =
    Duffing { damping: 0.0, stiffness: 1.0, cubic: 0.7, force: 0.0, frequency: 0.0 };

/// Source of truth: cn by the arithmetic-geometric mean at a quarter period and in the limits of a
/// circle and a hyperbola (Abramowitz & Stegun 16.5, 16.6).
#[test]
fn the_elliptic_reference_is_right() {
    let quarter = 1.854_074_677_301_371_9;
    let (sn, cn, dn) = jacobi(quarter, 0.5);
    assert!((sn - 1.0).abs() < 1e-15 && cn.abs() < 1e-15 && (dn - 0.5_f64.sqrt()).abs() < 1e-15);
    let (sn, cn, dn) = jacobi(0.7, 0.0);
    assert!((sn - 0.7_f64.sin()).abs() < 1e-15 && (cn - 0.7_f64.cos()).abs() < 1e-15 && dn == 1.0);
}

/// Source of truth: the free Duffing oscillation by elliptic functions; order 8.
#[test]
fn the_order_on_a_nonlinear_oscillation_is_eight() {
    let (t_end, amplitude) = (10.0, 1.5);
    let exact = free_duffing(FREE.stiffness, FREE.cubic, amplitude, t_end);
    let errors: Vec<f64> = [20, 40, 80, 160]
        .into_iter()
        .map(|count| end_error(FREE, &[amplitude, 0.0], t_end, count, &exact))
        .collect();
    assert!((order(&errors) - 8.0).abs() < 0.6, "order {}: {errors:?}", order(&errors));
}

/// Source of truth: `y' = cos(t) y`, `y = exp(sin t)`, which depends on time: a wrong node of any
/// stage spoils the order.
#[test]
fn the_order_on_a_forced_problem_is_eight() {
    let forced = || function(1, |t: f64, y: &[f64], rate: &mut [f64]| rate[0] = t.cos() * y[0]);
    let exact = 5.0_f64.sin().exp();
    let errors: Vec<f64> = [10, 20, 40]
        .into_iter()
        .map(|count| end_error(forced(), &[1.0], 5.0, count, &[exact]))
        .collect();
    assert!((order(&errors) - 8.0).abs() < 0.6, "order {}: {errors:?}", order(&errors));
}

/// Largest error of dense output and of its derivative over the whole interval.
fn dense_errors(count: usize) -> (f64, f64) {
    let (t_end, amplitude) = (10.0, 1.5);
    let mut integrator = fixed(FREE, &[amplitude, 0.0], t_end / f64::from(count as u32));
    let (mut value_error, mut slope_error) = (0.0_f64, 0.0_f64);
    while integrator.time() < t_end {
        integrator.step(t_end).expect("harmless");
        let dense = integrator.dense();
        let (from, to) = dense.interval();
        for k in 0..=10 {
            let t = from + (to - from) * f64::from(k) / 10.0;
            let exact = free_duffing(FREE.stiffness, FREE.cubic, amplitude, t);
            value_error = value_error.max((dense.component(0, t) - exact[0]).abs());
            slope_error = slope_error.max((dense.derivative(0, t) - exact[1]).abs());
        }
    }
    (value_error, slope_error)
}

/// Source of truth: the same oscillation; the dense output has order 7 (its error within one step
/// order 8), its derivative one less.
#[test]
fn the_order_of_dense_output_is_seven() {
    let errors: Vec<(f64, f64)> = [20, 40, 80].into_iter().map(dense_errors).collect();
    let values: Vec<f64> = errors.iter().map(|e| e.0).collect();
    let slopes: Vec<f64> = errors.iter().map(|e| e.1).collect();
    assert!(order(&values) > 6.9, "order {}: {values:?}", order(&values));
    assert!(order(&slopes) > 5.9, "order {}: {slopes:?}", order(&slopes));
}
