//! Time of the first-harmonic method: maps of the number of responses, whole questions.
//!
//! Promise: one million pairs of excitation speed and parameter, with the number of responses at
//! each, in less than 2 s on one core.

use criterion::{Criterion, criterion_group, criterion_main};
use halfshaft_analysis::{ask, response_count};
use halfshaft_model::question::{FoldsQuestion, Question, QuestionText, Verb, read};
use halfshaft_model::{Driveline, Source, embedded, read_model};
use halfshaft_numerics::observer::Silent;
use std::hint::black_box;

fn line(source: Source) -> Driveline {
    read_model(source, &[]).expect("a sound model").0
}

fn some(text: &str) -> Option<String> {
    Some(text.to_owned())
}

fn question(line: &Driveline, verb: Verb, text: QuestionText) -> Question {
    let method = some("first-harmonic");
    read(verb, &QuestionText { method, ..text }, line).expect("the options are right")
}

fn plane(line: &Driveline, parameter: &str) -> FoldsQuestion {
    let text = QuestionText { parameter: some(parameter), ..QuestionText::default() };
    match question(line, Verb::Folds, text) {
        Question::Folds(question) => question,
        other => panic!("{other:?}"),
    }
}

fn even(from: f64, to: f64, count: u32) -> Vec<f64> {
    (0..count).map(|k| from + (to - from) * f64::from(k) / f64::from(count - 1)).collect()
}

/// A chain of inertias held at ground, its middle shaft hardening.
fn chain(count: usize) -> Driveline {
    let mut text = "format = 1\nname = \"chain\"\n".to_owned();
    for k in 0..count {
        text += &format!("[[inertia]]\nname = \"n{k}\"\ninertia = 1.0\ndamping = 0.05\n");
        let from = if k == 0 { "ground".to_owned() } else { format!("n{}", k - 1) };
        let cubic = if k == count / 2 { "cubic = 50000.0\n" } else { "" };
        text += &format!(
            "[[shaft]]\nname = \"s{k}\"\nfrom = \"{from}\"\nto = \"n{k}\"\nstiffness = 1000.0\n\
             damping = 0.5\n{cubic}"
        );
    }
    let last = count - 1;
    text += &format!("[[torque]]\nname = \"drive\"\non = \"n{last}\"\namplitude = 5.0\n");
    line(Source::new("chain.toml", text))
}

fn maps(criterion: &mut Criterion) {
    let scaled = line(embedded::scaled());
    let speeds = even(25.0, 26.5, 1000);
    let mut group = criterion.benchmark_group("map of a million points");
    group.sample_size(10);
    for (parameter, from, to) in [
        ("excitation.amplitude", 1.0, 20.0),
        ("spring.cubic", -1.0, -0.1),
        ("spring.damping", 0.02, 0.16),
        ("oscillator.inertia", 0.99, 1.01),
    ] {
        let asked = plane(&scaled, &format!("{parameter}={from}..{to}"));
        let values = even(from, to, 1000);
        group.bench_function(parameter, |bencher| {
            bencher.iter(|| response_count(black_box(&scaled), &asked, &speeds, &values));
        });
    }
    group.finish();
}

fn questions(criterion: &mut Criterion) {
    let scaled = line(embedded::scaled());
    let (ten, hundred, thousand) = (chain(10), chain(100), chain(1000));
    let resonance = |line: &Driveline, frequency: &str| {
        let text = QuestionText { frequency: some(frequency), ..QuestionText::default() };
        question(line, Verb::Resonance, text)
    };
    let mut group = criterion.benchmark_group("first harmonic");
    group.sample_size(10);
    for (name, line, asked) in [
        ("response curve, 1000 speeds", &scaled, resonance(&scaled, "25..26.5")),
        ("chain of 10", &ten, resonance(&ten, "4..7")),
        ("chain of 100", &hundred, resonance(&hundred, "0.3..0.7")),
        ("chain of 1000", &thousand, resonance(&thousand, "0.03..0.07")),
    ] {
        group.bench_function(name, |bencher| {
            bencher.iter(|| ask(black_box(line), &asked, &Silent));
        });
    }
    let text = QuestionText { parameter: some("excitation.amplitude=1..20"), ..Default::default() };
    let folds = question(&scaled, Verb::Folds, text);
    group.bench_function("fold curve through its cusp", |bencher| {
        bencher.iter(|| ask(black_box(&scaled), &folds, &Silent));
    });
    group.finish();
}

criterion_group!(benches, maps, questions);
criterion_main!(benches);
