//! Every result through JSON and through Parquet and back: equal to the last bit.

use halfshaft::model::question::{QuestionText, read};
use halfshaft::model::study::read_study;
use halfshaft::results::io::{from_json, to_json};
use halfshaft::results::{Column, HistoryResult};
use halfshaft::{Answer, Driveline, Silent, Verb, ask, load, load_embedded, report, run_study};
use halfshaft_parquet::{ParquetError, from_bytes, to_bytes};
use proptest::prelude::{any, prop_assert_eq, proptest};
use std::path::Path;

fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

fn answers() -> Vec<Answer> {
    let example = load_embedded(&[]).expect("is sound").line;
    let scaled = load(&root().join("examples/two-mass-driveline/scaled.toml"), &[]);
    let scaled = scaled.expect("is sound").line;
    let mut answers = Vec::new();
    let mut put = |line: &Driveline, verb: Verb, text: QuestionText| {
        let question = read(verb, &text, line).expect("the options are right");
        answers.push(ask(line, &question, &Silent).expect("answered"));
    };
    let plain = QuestionText::default;
    for verb in [Verb::Check, Verb::Static, Verb::Modes, Verb::Simulate, Verb::Shock] {
        put(&example, verb, plain());
    }
    put(&example, Verb::Shock, QuestionText { compare: true, ..plain() });
    for method in ["clamped", "published", "multiple-scales"] {
        put(&example, Verb::Shock, QuestionText { method: Some(method.to_owned()), ..plain() });
    }
    put(&example, Verb::Resonance, QuestionText { verify: true, ..plain() });
    put(&scaled, Verb::Resonance, QuestionText { verify: true, ..plain() });
    let plane = |parameter: &str| QuestionText { parameter: Some(parameter.to_owned()), ..plain() };
    put(&scaled, Verb::Folds, plane("spring.cubic=-1..1"));
    put(&example, Verb::Folds, plane("half-shaft.damping=1..100"));
    answers
}

// Source: equality of the values themselves, bit by bit.
#[test]
fn every_answer_comes_back_equal() {
    for answer in answers() {
        let name = &answer.header().analysis;
        for pretty in [true, false] {
            let text = to_json(&answer, pretty).expect("plain data");
            assert_eq!(from_json(&text).expect("own text"), answer, "{name} through JSON");
        }
        match to_bytes(&answer) {
            Ok(bytes) => assert_eq!(from_bytes(bytes).expect("own file"), answer, "{name}"),
            Err(ParquetError::NoTable { .. }) => assert!(answer.tables().is_empty(), "{name}"),
            Err(error) => panic!("{name}: {error}"),
        }
    }
}

#[test]
fn reports_and_studies_come_back_equal() {
    let example = load_embedded(&[]).expect("is sound").line;
    let report = Answer::Report(Box::new(report(&example, &Silent).expect("answered")));
    let text = to_json(&report, false).expect("plain data");
    assert_eq!(from_json(&text).expect("own text"), report);
    let study = "format = 1\nname = \"s\"\n[[question]]\nname = \"a\"\nask = \"static\"\n\
                 [[figure]]\nname = \"f\"\ntitle = \"t\"\nx = \"time\"\ny = \"half-shaft.twist\"\n\
                 [[figure.question]]\nname = \"q\"\nask = \"shock\"\n[[figure.compare]]\n\
                 what = \"peak\"\npointer = \"/metrics/shafts/half-shaft/first_peak\"\nprinted = 0.1\n";
    let path = std::env::temp_dir().join(format!("halfshaft-study-{}.toml", std::process::id()));
    std::fs::write(&path, study).expect("writes");
    let study = read_study(&path).expect("is sound");
    let _ = std::fs::remove_file(&path);
    let answer = Answer::Study(run_study(&study, &Silent));
    let text = to_json(&answer, false).expect("plain data");
    assert_eq!(from_json(&text).expect("own text"), answer);
}

#[test]
fn foreign_files_are_refused() {
    assert!(from_bytes(b"no parquet".to_vec()).is_err());
    assert!(from_json("{}").is_err());
    assert!(from_json("{\"analysis\": \"horoscope\"}").is_err());
}

/// A history whose columns hold the given numbers.
fn history_with(values: Vec<f64>) -> Answer {
    let example = load_embedded(&[]).expect("is sound").line;
    let question = read(Verb::Simulate, &QuestionText::default(), &example).expect("right");
    let Answer::History(history) = ask(&example, &question, &Silent).expect("answered") else {
        unreachable!("simulate answers with a history")
    };
    Answer::History(HistoryResult { columns: vec![Column::new("a.b", "rad", values)], ..history })
}

proptest! {
    // Source: equality of bits, for any finite numbers and missing ones.
    #[test]
    fn any_numbers_come_back(bits in proptest::collection::vec(any::<u64>(), 0..40)) {
        let finite = |bits: u64| {
            let value = f64::from_bits(bits);
            if value.is_finite() { value } else { f64::NAN }
        };
        let answer = history_with(bits.into_iter().map(finite).collect());
        let text = to_json(&answer, false).expect("plain data");
        prop_assert_eq!(&from_json(&text).expect("own text"), &answer);
        let bytes = to_bytes(&answer).expect("has a table");
        prop_assert_eq!(&from_bytes(bytes).expect("own file"), &answer);
    }
}
