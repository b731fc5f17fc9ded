//! Time of whole questions on the two-mass driveline, answer included.
//!
//! Promises: static and modes under 50 µs, a response curve with stability and folds at 1000
//! frequencies under 1 ms, a fold curve with its cusp under 1 ms.

use criterion::{Criterion, criterion_group, criterion_main};
use halfshaft_analysis::ask;
use halfshaft_model::question::{Question, QuestionText, Verb, read};
use halfshaft_model::{Driveline, embedded, read_model};
use halfshaft_numerics::observer::Silent;
use std::hint::black_box;

fn line(scaled: bool) -> Driveline {
    let source = if scaled { embedded::scaled() } else { embedded::example() };
    read_model(source, &[]).expect("the embedded models are sound").0
}

fn question(line: &Driveline, verb: Verb, text: &QuestionText) -> Question {
    read(verb, text, line).expect("the options are right")
}

fn bench(criterion: &mut Criterion) {
    let (physical, scaled) = (line(false), line(true));
    let text = QuestionText::default;
    let some = |text: &str| Some(text.to_owned());
    let averaged = || QuestionText { method: some("averaged"), ..text() };
    let plane = |parameter: &str| QuestionText { parameter: some(parameter), ..averaged() };
    let cases: Vec<(&str, &Driveline, Question)> = vec![
        ("static", &physical, Question::Static),
        ("modes", &physical, question(&physical, Verb::Modes, &text())),
        (
            "response curve, 1000 frequencies",
            &scaled,
            question(&scaled, Verb::Resonance, &averaged()),
        ),
        (
            "folds, amplitude",
            &scaled,
            question(&scaled, Verb::Folds, &plane("excitation.amplitude=1..20")),
        ),
        ("folds, cubic", &scaled, question(&scaled, Verb::Folds, &plane("spring.cubic=-1..-0.1"))),
        (
            "folds, damping",
            &scaled,
            question(&scaled, Verb::Folds, &plane("spring.damping=0.02..0.16")),
        ),
        ("folds, scaled f", &scaled, question(&scaled, Verb::Folds, &plane("mode.f=1..20"))),
        ("shock, 5 s at 1e-10", &physical, question(&physical, Verb::Shock, &text())),
        (
            "verified response curve",
            &scaled,
            question(&scaled, Verb::Resonance, &QuestionText { verify: true, ..averaged() }),
        ),
    ];
    let mut group = criterion.benchmark_group("question");
    for (name, line, question) in &cases {
        group.bench_function(*name, |bencher| {
            bencher.iter(|| ask(black_box(line), black_box(question), &Silent));
        });
    }
    group.finish();
    criterion.bench_function("read the embedded model", |bencher| {
        bencher.iter(|| read_model(black_box(embedded::example()), &[]));
    });
}

criterion_group!(benches, bench);
criterion_main!(benches);
