//! Time of harmonic balance in layers: law, residual, Newton step, orbit, stability, seeds, branch, and
//! whole questions with stability and located special points.
//!
//! Promises: a Duffing curve in under 3 ms, its seeds in under 0.5 ms; with one nonlinear shaft the
//! time of a sample grows no faster than the number of inertias.

#[path = "../tests/common/lines.rs"]
mod lines;

use std::hint::black_box;

use criterion::{BatchSize, BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use halfshaft_analysis::ask;
use halfshaft_analysis::layers::Layers;
use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_model::question::{Question, QuestionText, Verb, read};
use halfshaft_model::{Driveline, Source, read_model};
use halfshaft_numerics::observer::Silent;

fn line_of(text: &str) -> Driveline {
    read_model(Source::new("bench.toml", text), &[]).expect("the model is sound").0
}

fn question(line: &Driveline, range: (f64, f64)) -> Question {
    let text = QuestionText {
        method: Some("harmonic-balance".to_owned()),
        frequency: Some(format!("{:?}..{:?}", range.0, range.1)),
        ..QuestionText::default()
    };
    read(Verb::Resonance, &text, line).expect("the options are right")
}

/// Lines with the range of their curve.
fn cases() -> Vec<(&'static str, String, (f64, f64))> {
    vec![
        ("duffing", lines::theory(15.0), (25.0, 27.0)),
        ("absorber", lines::absorber(0.11), (0.9, 1.4)),
        ("chain of ten", lines::chain(10, |_| true), (4.2, 5.2)),
        ("chain of fifty", lines::chain(50, |_| true), (0.9, 1.1)),
    ]
}

fn layers(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("law");
    let line = line_of(&lines::theory(15.0));
    let equations = EquationsOfMotion::new(&line).expect("is validated");
    let twists: Vec<f64> = (0..64).map(|k| 0.05 * f64::from(k)).collect();
    let (mut torque, mut slope) = (vec![0.0; 64], vec![0.0; 64]);
    group.throughput(Throughput::Elements(64));
    group.bench_function("cubic, 64 twists", |bencher| {
        let law = &equations.connections[0].law;
        bencher.iter(|| law.evaluate(black_box(&twists), &mut torque, &mut slope));
    });
    group.finish();
    for (name, text, range) in cases() {
        let line = line_of(&text);
        let Some(layers) = Layers::new(&line, range, 1e-6) else { continue };
        let mut equations = layers.system();
        let mut group =
            criterion.benchmark_group(format!("{name}, {} unknowns", layers.unknowns()));
        group.bench_function("residual", |bencher| bencher.iter(|| equations.residual()));
        group.bench_function("jacobian", |bencher| bencher.iter(|| equations.jacobian()));
        group.bench_function("newton step", |bencher| bencher.iter(|| equations.newton_step()));
        group.bench_function("orbit", |bencher| bencher.iter(|| equations.orbit()));
        group.bench_function("stability", |bencher| bencher.iter(|| equations.stability()));
        if equations.stabilities().is_some() {
            group.bench_function("stability of 8", |bencher| {
                bencher.iter(|| equations.stabilities());
            });
        }
        group.sample_size(10);
        group.bench_function("seeds", |bencher| bencher.iter(|| layers.seeds()));
        group.bench_function("branch", |bencher| bencher.iter(|| layers.branch()));
        group.finish();
    }
}

fn curves(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("curve");
    group.sample_size(10);
    for (name, text, range) in cases() {
        let line = line_of(&text);
        let question = question(&line, range);
        group.bench_function(name, |bencher| {
            bencher.iter_batched(
                || question.clone(),
                |question| ask(&line, &question, &Silent),
                BatchSize::SmallInput,
            );
        });
    }
    group.finish();
}

/// The residual, Newton step and branch of rows with one nonlinear shaft: linear in their length.
fn growth(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("one nonlinear shaft");
    group.sample_size(10);
    for count in [10_usize, 30, 100, 300, 1000] {
        let line = line_of(&lines::chain(count, |k| k == count / 2));
        // About the first resonance, which lies lower the longer the row.
        let first = 1000.0_f64.sqrt() * std::f64::consts::FRAC_PI_2 / (count as f64 + 0.5);
        let range = (0.93 * first, 1.07 * first);
        let Some(layers) = Layers::new(&line, range, 1e-6) else { continue };
        let mut equations = layers.system();
        group.throughput(Throughput::Elements(count as u64));
        group.bench_function(BenchmarkId::new("newton step", count), |bencher| {
            bencher.iter(|| equations.newton_step());
        });
        group.bench_function(BenchmarkId::new("branch", count), |bencher| {
            bencher.iter(|| layers.branch());
        });
    }
    group.finish();
}

criterion_group!(benches, layers, curves, growth);
criterion_main!(benches);
