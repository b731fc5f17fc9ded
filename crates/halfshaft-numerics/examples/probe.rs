#[path = "../tests/reference/lanes.rs"]
mod lanes;
#[path = "../tests/reference/mod.rs"]
mod reference;
use halfshaft_numerics::ensemble::*;
use halfshaft_numerics::observer::Silent;
fn cpu() -> f64 {
    std::fs::read_to_string("/proc/thread-self/schedstat")
        .unwrap()
        .split(' ')
        .next()
        .unwrap()
        .parse::<f64>()
        .unwrap()
        * 1e-9
}
fn main() {
    let count = 4000;
    let task = lanes::ManyDuffing::drivelines(count);
    let tight = by_series(
        &lanes::DuffingLanes,
        &task,
        count,
        &Settings { degree: 24, ..Settings::with_tolerance(1e-14) },
        &Silent,
    )
    .unwrap();
    let s = &tight[0].as_ref().unwrap().state;
    println!(
        "{:e} {:e}",
        s[0] - reference::Duffing::DRIVELINE_AFTER_200[0],
        s[1] - reference::Duffing::DRIVELINE_AFTER_200[1]
    );
    let only = std::env::args().nth(1);
    for (pair, tol) in
        [(Pair::DormandPrince8, 1e-9), (Pair::DormandPrince8, 1e-10), (Pair::Tsitouras5, 1e-6)]
    {
        for (ins, lanes) in
            [(Instructions::Avx512, 16), (Instructions::Avx2, 8), (Instructions::Avx2, 1)]
        {
            let set = Settings {
                threads: 1,
                lanes: Some(lanes),
                instructions: Some(ins),
                ..Settings::with_tolerance(tol)
            };
            let t = cpu();
            let got =
                by_runge_kutta(&lanes::DuffingLanes, pair, &task, count, &set, &Silent).unwrap();
            let dt = cpu() - t;
            let mut worst = 0.0f64;
            let mut steps = 0;
            for (a, b) in got.iter().zip(&tight) {
                let (a, b) = (a.as_ref().unwrap(), b.as_ref().unwrap());
                worst = worst.max((a.state[0] - b.state[0]).abs());
                steps += a.steps;
            }
            println!(
                "{pair:?} {ins:?} {lanes} tol {tol:e}: {:.0}/s  steps {:.0} err {worst:.2e}",
                count as f64 / dt,
                steps as f64 / count as f64
            );
        }
    }
    for (ins, lanes) in [
        (Instructions::Avx512, 16),
        (Instructions::Avx512, 8),
        (Instructions::Avx2, 8),
        (Instructions::Avx2, 4),
        (Instructions::Avx2, 1),
    ] {
        if only.is_some() && lanes != 16 {
            continue;
        }
        for (degree, tol) in [(12, 1e-10), (16, 1e-10), (20, 1e-10), (24, 1e-10), (28, 1e-10)] {
            let set = Settings {
                degree,
                threads: 1,
                lanes: Some(lanes),
                instructions: Some(ins),
                ..Settings::with_tolerance(tol)
            };
            let t = cpu();
            let got = by_series(&lanes::DuffingLanes, &task, count, &set, &Silent).unwrap();
            let dt = cpu() - t;
            let mut worst = 0.0f64;
            let mut steps = 0;
            for (a, b) in got.iter().zip(&tight) {
                let (a, b) = (a.as_ref().unwrap(), b.as_ref().unwrap());
                worst = worst.max((a.state[0] - b.state[0]).abs());
                steps += a.steps;
            }
            println!(
                "{ins:?} {lanes} deg {degree} tol {tol:e}: {:.0}/s  steps {:.0} err {worst:.2e}",
                count as f64 / dt,
                steps as f64 / count as f64
            );
        }
    }
}
