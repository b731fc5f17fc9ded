//! The implicit method on stiff systems.

use halfshaft_numerics::dense::Matrix;
use halfshaft_numerics::ode::radau5::Radau5;
use halfshaft_numerics::ode::{
    ByDifferences, Differentiated, Settings, Statistics, Step, System, Tolerance, function,
};

fn run<S: Differentiated>(system: S, start: &[f64], t_end: f64, settings: Settings) -> Radau5<S> {
    let mut integrator = Radau5::new(system, 0.0, start, settings).expect("the arguments fit");
    while integrator.step(t_end).expect("the problem is solvable") == Step::Advanced {}
    integrator
}

/// `y' = M y`.
#[derive(Debug, Clone)]
struct Linear(Matrix);

impl System for Linear {
    fn dimension(&self) -> usize {
        self.0.rows()
    }

    fn derivative(&mut self, _: f64, state: &[f64], rate: &mut [f64]) {
        for (row, rate) in rate.iter_mut().enumerate() {
            *rate = self.0.row(row).iter().zip(state).map(|(a, y)| a * y).sum();
        }
    }
}

impl Differentiated for Linear {
    fn jacobian(&mut self, _: f64, _: &[f64], out: &mut Matrix) {
        out.clone_from(&self.0);
    }
}

/// A rotation of frequency 2 beside a decay of 1e6, seen in skew coordinates `y = V z`.
const SKEW: [[f64; 3]; 3] = [[1.0, 0.0, 1.0], [0.0, 1.0, -1.0], [1.0, 1.0, 1.0]];
const UNSKEWED: [[f64; 3]; 3] = [[2.0, 1.0, -1.0], [-1.0, 0.0, 1.0], [-1.0, -1.0, 1.0]];

fn skew_system() -> Linear {
    let blocks = Matrix::from_rows([[0.0, 2.0, 0.0], [-2.0, 0.0, 0.0], [0.0, 0.0, -1e6]]);
    let product = Matrix::from_rows(SKEW).mul(&blocks).expect("fits");
    Linear(product.mul(&Matrix::from_rows(UNSKEWED)).expect("fits"))
}

/// Source of truth: the matrix exponential, `V exp(Λ t) V⁻¹ y0` with exact V and V⁻¹. An explicit
/// method would need more than a million steps.
#[test]
fn a_decay_beside_an_oscillation() {
    let start = [1.0, 2.0, -1.0];
    let inverse = Matrix::from_rows(UNSKEWED);
    let z = inverse.mul_vector(&start).expect("fits");
    let (sin, cos) = 20.0_f64.sin_cos();
    let exact = [cos * z[0] + sin * z[1], cos * z[1] - sin * z[0], 0.0];
    let exact = Matrix::from_rows(SKEW).mul_vector(&exact).expect("fits");
    for (tolerance, most, steps) in [(1e-4, 1e-2, 120), (1e-7, 2e-5, 400), (1e-10, 5e-8, 2000)] {
        let integrator = run(skew_system(), &start, 10.0, Settings::with_tolerance(tolerance));
        let errors = integrator.state().iter().zip(&exact).map(|(a, b)| (a - b).abs());
        let error = errors.fold(0.0, f64::max);
        assert!(error < most, "{tolerance:e}: {error:e}");
        let work = integrator.statistics();
        assert!(work.accepted < steps, "{work:?}");
        // A constant Jacobian is never evaluated again.
        assert!(work.jacobians <= 1 + work.rejected, "{work:?}");
    }
}

/// Source of truth: the stability function vanishes at infinity (Hairer & Wanner II, section IV.5):
/// a decay of 1e12 is gone after one step of any length.
#[test]
fn the_fastest_decay_is_gone_after_one_step() {
    let settings = Settings { fixed_step: Some(1.0), ..Settings::default() };
    let integrator = run(Linear(Matrix::from_rows([[-1e12]])), &[1.0], 1.0, settings);
    assert!(integrator.state()[0].abs() < 1e-11, "{:?}", integrator.state());
}

fn van_der_pol() -> impl System {
    function(2, |_, y: &[f64], rate: &mut [f64]| {
        rate[0] = y[1];
        rate[1] = ((1.0 - y[0] * y[0]) * y[1] - y[0]) / 1e-6;
    })
}

/// Source of truth: Van der Pol's equation with ε = 1e-6 at t = 2, from (2, 0): reference
/// solution of Hairer & Wanner II, section IV.10.
#[test]
fn van_der_pol_jumps() {
    for (tolerance, most, steps) in [(1e-4, 1e-3, 300), (1e-7, 1e-5, 800), (1e-10, 1e-8, 3000)] {
        let system = ByDifferences::new(van_der_pol());
        let integrator = run(system, &[2.0, 0.0], 2.0, Settings::with_tolerance(tolerance));
        let state = integrator.state();
        let errors = (state[0] - 1.706_167_732_170_483, state[1] + 0.892_809_701_024_797_5);
        assert!(errors.0.abs() < most && errors.1.abs() < most, "{tolerance:e}: {errors:?}");
        let work: Statistics = integrator.statistics();
        assert!(work.accepted < steps && work.jacobians <= work.accepted + work.rejected);
    }
}

/// Source of truth: Robertson's reaction at t = 40, published with ten digits in the examples of the
/// LSODE and CVODE programs (0.7158270688, 0.9185534765e-5, 0.2841637457); its masses sum to 1.
#[test]
fn robertson_reacts() {
    let system = function(3, |_, y: &[f64], rate: &mut [f64]| {
        rate[0] = -0.04 * y[0] + 1e4 * y[1] * y[2];
        rate[2] = 3e7 * y[1] * y[1];
        rate[1] = -rate[0] - rate[2];
    });
    let settings = Settings {
        absolute_tolerance: Tolerance::PerComponent(vec![1e-10, 1e-14, 1e-10]),
        ..Settings::with_tolerance(1e-10)
    };
    let integrator = run(ByDifferences::new(system), &[1.0, 0.0, 0.0], 40.0, settings);
    let exact = [0.715_827_068_8, 0.918_553_476_5e-5, 0.284_163_745_7];
    for (state, exact) in integrator.state().iter().zip(exact) {
        assert!((state / exact - 1.0).abs() < 1e-8, "{state} against {exact}");
    }
    assert!((integrator.state().iter().sum::<f64>() - 1.0).abs() < 1e-12);
}
