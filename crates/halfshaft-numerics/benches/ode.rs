//! Time integration and periodic orbits, layer by layer.

#[path = "../tests/reference/mod.rs"]
mod reference;

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use halfshaft_numerics::fourier;
use halfshaft_numerics::ode::dop853::{Dop853, Step};
use halfshaft_numerics::ode::periodic::{PeriodicSettings, find_orbit};
use halfshaft_numerics::ode::{Settings, System};
use reference::{Chain, Duffing, Kepler};

/// Integrates to the end and returns the integrator.
fn run<S: System>(system: S, start: &[f64], t_end: f64, settings: Settings) -> Dop853<S> {
    let mut integrator = Dop853::new(system, 0.0, start, settings).expect("the arguments fit");
    while integrator.step(t_end).expect("the problem is harmless") == Step::Advanced {}
    integrator
}

/// A hundred steps of fixed length.
fn steps(criterion: &mut Criterion) {
    let fixed = |length| Settings { fixed_step: Some(length), ..Settings::default() };
    criterion.bench_function("100 steps, Duffing (2)", |bencher| {
        bencher.iter(|| run(Duffing::DRIVELINE, &[0.1, 0.0], 1.0, fixed(0.01)).state()[0]);
    });
    criterion.bench_function("100 steps, Kepler (4)", |bencher| {
        bencher.iter(|| run(Kepler, &Kepler::START, 1.0, fixed(0.01)).state()[0]);
    });
    for inertias in [2, 10, 50] {
        let chain = Chain { inertias, frequency: 4.6 };
        let start = vec![0.0; 2 * inertias];
        let name = format!("100 steps, chain ({})", 2 * inertias);
        criterion.bench_function(&name, |bencher| {
            bencher.iter(|| run(chain, &start, 1.0, fixed(0.01)).state()[0]);
        });
    }
}

fn duffing(criterion: &mut Criterion) {
    let mut problem = Duffing::DRIVELINE;
    let t_end = 200.0 * problem.period();
    for tolerance in [1e-9, 1e-12] {
        let settings = Settings::with_tolerance(tolerance);
        let reached = run(problem, &Duffing::DRIVELINE_START, t_end, settings.clone());
        assert!((reached.state()[0] - Duffing::DRIVELINE_AFTER_200[0]).abs() < 100.0 * tolerance);
        let name = format!("Duffing, 200 periods, tolerance {tolerance:e}");
        criterion.bench_function(&name, |bencher| {
            bencher.iter(|| {
                run(problem, &Duffing::DRIVELINE_START, t_end, settings.clone()).state()[0]
            });
        });
    }
    criterion.bench_function("Duffing, right-hand side", |bencher| {
        let mut rate = [0.0; 2];
        let mut t = 0.0;
        bencher.iter(|| {
            t += 0.01;
            problem.derivative(black_box(t), black_box(&[0.1, 0.2]), &mut rate);
            rate[1]
        });
    });
}

fn orbit(criterion: &mut Criterion) {
    let mut problem = Duffing { frequency: 26.3, ..Duffing::DRIVELINE };
    let settings = PeriodicSettings::default();
    let guess = [0.0, 0.0];
    let find = |problem: &mut Duffing| {
        find_orbit(problem, 0.0, problem.period(), &guess, &settings).expect("arguments fit")
    };
    let found = find(&mut problem);
    assert!(found.report.converged.is_converged() && found.residual < 1e-9);
    criterion.bench_function("Duffing, periodic orbit by shooting", |bencher| {
        bencher.iter(|| find(&mut problem));
    });
    let samples = found.sample(&mut problem, 64, &settings.integration).expect("arguments fit");
    criterion.bench_function("half of peak to peak, 64 samples", |bencher| {
        bencher.iter(|| fourier::half_peak_to_peak(black_box(samples.row(0))));
    });
}

criterion_group!(benches, steps, duffing, orbit);
criterion_main!(benches);
