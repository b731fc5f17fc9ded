//! Ten thousand forced Duffing oscillators over 200 periods: rate, error and share of the processor's
//! arithmetic that is used.

// Rates without their errors would say nothing.
#![allow(clippy::print_stdout)]

#[path = "../tests/reference/lanes.rs"]
mod lanes;
#[path = "../tests/reference/mod.rs"]
mod reference;

use std::time::Instant;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use halfshaft_numerics::ensemble::{
    Finished, Instructions, Pair, Settings, by_runge_kutta, by_series,
};
use halfshaft_numerics::observer::Silent;
use lanes::{DuffingLanes, ManyDuffing};

const COUNT: usize = 10_000;

type Ends = Vec<Option<Finished<()>>>;

fn series(task: &ManyDuffing, settings: &Settings) -> Ends {
    by_series(&DuffingLanes, task, task.oscillators.len(), settings, &Silent)
        .expect("sound settings")
}

fn stages(pair: Pair, task: &ManyDuffing, settings: &Settings) -> Ends {
    let count = task.oscillators.len();
    by_runge_kutta(&DuffingLanes, pair, task, count, settings, &Silent).expect("sound settings")
}

/// Largest error of the displacement, and steps of a trajectory.
fn judge(found: &Ends, exact: &Ends) -> (f64, f64) {
    let pairs = found.iter().flatten().zip(exact.iter().flatten());
    let (mut error, mut steps) = (0.0_f64, 0);
    for (found, exact) in pairs {
        error = error.max((found.state[0] - exact.state[0]).abs());
        steps += found.steps;
    }
    (error, steps as f64 / found.len() as f64)
}

/// Additions and multiplications of a step of degree `n` of [`DuffingLanes`]: the products of series
/// (squares over half, cubes over all earlier powers), the rest of the recurrence, the cosine's series,
/// both polynomials at the end.
fn operations(degree: usize) -> f64 {
    let powers = (degree - 1) as f64;
    let products = 2.0 * (powers * powers / 4.0 + powers * powers / 2.0);
    products + 12.0 * powers + 5.0 * degree as f64 + 4.0 * (degree + 1) as f64 + 100.0
}

/// Operations a second that a chain of nothing but fused multiply-adds on registers reaches, on one core.
fn peak() -> f64 {
    use halfshaft_numerics::ensemble::{Expansion, Lanes, SeriesSystem};

    /// A system of which one expansion is many multiply-adds of 16 independent sums.
    struct Peak;

    const ROUNDS: usize = 20_000;

    impl SeriesSystem for Peak {
        fn coordinates(&self) -> usize {
            1
        }

        fn parameters(&self) -> usize {
            5
        }

        fn helpers(&self) -> usize {
            0
        }

        #[inline(always)]
        fn expand<L: Lanes>(&self, expansion: &mut Expansion<'_, L>) {
            let factor = expansion.parameters[0];
            let mut sums = [expansion.parameters[1]; 16];
            for _ in 0..ROUNDS {
                for sum in &mut sums {
                    *sum = sum.mul_add(factor, factor);
                }
            }
            let total = sums.into_iter().fold(factor, |total, sum| total + sum);
            expansion.coordinates[2..].fill(total * L::splat(0.0));
        }
    }

    let lanes = if Instructions::best() == Instructions::Avx512 { 8 } else { 4 };
    let task = ManyDuffing { periods: 1.0, ..ManyDuffing::drivelines(lanes) };
    let fixed = Some(task.oscillators[0].0.period() / 200.0);
    let settings =
        Settings { threads: 1, lanes: Some(lanes), fixed_step: fixed, ..Settings::default() };
    let start = Instant::now();
    let found = by_series(&Peak, &task, lanes, &settings, &Silent).expect("sound settings");
    let steps = found.iter().flatten().map(|found| found.steps).max().unwrap_or(0);
    (2 * 16 * ROUNDS * lanes * steps) as f64 / start.elapsed().as_secs_f64()
}

fn rates(criterion: &mut Criterion) {
    let task = ManyDuffing::drivelines(COUNT);
    let exact = series(&task, &Settings { degree: 24, ..Settings::with_tolerance(1e-15) });
    let mut group = criterion.benchmark_group("10 000 forced Duffing oscillators, 200 periods");
    group.sample_size(10).throughput(Throughput::Elements(COUNT as u64));
    let peak = peak();
    println!("multiply-adds on registers: {:.1} thousand million operations a second", peak * 1e-9);
    for tolerance in [1e-9, 1e-10] {
        let settings = Settings { threads: 1, ..Settings::with_tolerance(tolerance) };
        let start = Instant::now();
        let found = series(&task, &settings);
        let seconds = start.elapsed().as_secs_f64();
        let (error, steps) = judge(&found, &exact);
        let rate = COUNT as f64 * steps * operations(settings.degree) / seconds;
        println!(
            "series, tolerance {tolerance:e}: {:.0} a second, largest error {error:.1e}, {steps:.0} steps, \
             {:.0} % of the peak",
            COUNT as f64 / seconds,
            100.0 * rate / peak
        );
        group.bench_function(format!("series, tolerance {tolerance:e}, one thread"), |bencher| {
            bencher.iter(|| series(&task, &settings));
        });
    }
    let two = Settings { threads: 2, ..Settings::with_tolerance(1e-10) };
    group.bench_function("series, tolerance 1e-10, two threads", |bencher| {
        bencher.iter(|| series(&task, &two));
    });
    for (pair, tolerance) in [(Pair::DormandPrince8, 1e-11), (Pair::Tsitouras5, 1e-7)] {
        let settings = Settings { threads: 1, ..Settings::with_tolerance(tolerance) };
        let (error, steps) = judge(&stages(pair, &task, &settings), &exact);
        println!("{pair:?}, tolerance {tolerance:e}: largest error {error:.1e}, {steps:.0} steps");
        group.bench_function(format!("{pair:?}, tolerance {tolerance:e}, one thread"), |bencher| {
            bencher.iter(|| stages(pair, &task, &settings));
        });
    }
    group.finish();
}

criterion_group!(benches, rates);
criterion_main!(benches);
