//! Ten thousand forced Duffing oscillators over 200 periods: rate, error and share of the processor's
//! arithmetic that is used.

// Rates without their errors would say nothing.
#![allow(clippy::print_stdout)]

#[path = "../tests/reference/lanes.rs"]
mod lanes;
#[path = "../tests/reference/mod.rs"]
mod reference;

use std::hint::black_box;
use std::sync::OnceLock;
use std::time::Instant;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use halfshaft_numerics::ensemble::{Finished, Pair, Settings, by_runge_kutta, by_series};
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

/// Multiply-adds on registers, in twelve sums that do not wait for each other.
struct Sums {
    rounds: usize,
}

impl pulp::WithSimd for Sums {
    /// Operations, and the sum of all so that they are really done.
    type Output = (f64, f64);

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, simd: S) -> (f64, f64) {
        let factor = simd.splat_f64s(black_box(0.3));
        let mut sums = [simd.splat_f64s(black_box(0.7)); 12];
        for _ in 0..self.rounds {
            for sum in &mut sums {
                *sum = simd.mul_add_f64s(*sum, factor, factor);
            }
        }
        let total = sums.iter().map(|sum| simd.reduce_sum_f64s(*sum)).sum();
        ((2 * 12 * S::F64_LANES * self.rounds) as f64, total)
    }
}

/// Operations a second that one core reaches with nothing but multiply-adds on registers.
fn peak() -> f64 {
    let before = processor_seconds();
    let (operations, sum) = pulp::Arch::new().dispatch(Sums { rounds: 30_000_000 });
    black_box(sum);
    operations / (processor_seconds() - before)
}

/// Seconds of processor time of this thread; of the clock where the system does not tell.
fn processor_seconds() -> f64 {
    static START: OnceLock<Instant> = OnceLock::new();
    let stat = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let first = stat.as_deref().and_then(|text| text.split(' ').next()?.parse::<f64>().ok());
    first.map_or_else(
        || START.get_or_init(Instant::now).elapsed().as_secs_f64(),
        |nanoseconds| nanoseconds * 1e-9,
    )
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
        let before = processor_seconds();
        let found = series(&task, &settings);
        let seconds = processor_seconds() - before;
        let (error, steps) = judge(&found, &exact);
        let rate = COUNT as f64 * steps * operations(settings.degree) / seconds;
        println!(
            "series, tolerance {tolerance:e}: {:.0} per second and core, largest error {error:.1e}, {steps:.0} steps, \
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
        let before = processor_seconds();
        let found = stages(pair, &task, &settings);
        let rate = COUNT as f64 / (processor_seconds() - before);
        let (error, steps) = judge(&found, &exact);
        println!(
            "{pair:?}, tolerance {tolerance:e}: {rate:.0} per second and core, largest error \
             {error:.1e}, {steps:.0} steps"
        );
        group.bench_function(format!("{pair:?}, tolerance {tolerance:e}, one thread"), |bencher| {
            bencher.iter(|| stages(pair, &task, &settings));
        });
    }
    group.finish();
}

criterion_group!(benches, rates);
criterion_main!(benches);
