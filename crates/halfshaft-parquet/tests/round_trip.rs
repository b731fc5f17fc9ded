//! Every result through JSON and through Parquet and back: equal to the last bit.

use halfshaft::model::question::{QuestionText, read};
use halfshaft::model::study::read_study;
use halfshaft::results::io::{from_json, to_json};
use halfshaft::results::{Column, HistoryResult};
use halfshaft::{Answer, Driveline, Silent, Verb, ask, load, load_embedded, report, run_study};
use halfshaft_parquet::{ParquetError, from_bytes, to_bytes};
use proptest::prelude::{any, prop_assert_eq, proptest};
use serde_json::Value;
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
    for verb in [
        Verb::Check,
        Verb::Static,
        Verb::Modes,
        Verb::Campbell,
        Verb::Forced,
        Verb::Simulate,
        Verb::Shock,
    ] {
        put(&example, verb, plain());
    }
    put(&example, Verb::Shock, QuestionText { compare: true, ..plain() });
    let steps = Some("4".to_owned());
    put(&example, Verb::Bifurcation, QuestionText { steps, ..plain() });
    for method in ["clamped", "published", "multiple-scales"] {
        put(&example, Verb::Shock, QuestionText { method: Some(method.to_owned()), ..plain() });
    }
    let averaged = || QuestionText { method: Some("averaged".to_owned()), ..plain() };
    put(&example, Verb::Resonance, QuestionText { verify: true, ..averaged() });
    put(&scaled, Verb::Resonance, QuestionText { verify: true, ..averaged() });
    let plane =
        |parameter: &str| QuestionText { parameter: Some(parameter.to_owned()), ..averaged() };
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

/// Puts `null` for every number of a JSON text that has a point; whole numbers are counts. The
/// settings are no numbers of the result.
fn without_numbers(value: &mut Value) {
    match value {
        Value::Number(number) if number.is_f64() => *value = Value::Null,
        Value::Array(items) => items.iter_mut().for_each(without_numbers),
        Value::Object(fields) => {
            let fields = fields.iter_mut().filter(|(name, _)| *name != "settings");
            fields.for_each(|(_, value)| without_numbers(value));
        }
        _ => {}
    }
}

// Source: the form of the files: JSON writes what is no finite number as null. No number of any
// answer may make its file unreadable.
#[test]
fn every_number_of_every_answer_may_be_missing() {
    for answer in answers() {
        let name = &answer.header().analysis;
        let mut value = serde_json::to_value(&answer).expect("plain data");
        without_numbers(&mut value);
        let text = value.to_string();
        let back = from_json(&text).unwrap_or_else(|error| panic!("{name}: {error}"));
        let same = |answer: &Answer| serde_json::to_value(answer).expect("plain data") == value;
        assert!(same(&back), "{name} through JSON");
        if let Ok(bytes) = to_bytes(&back) {
            assert!(same(&from_bytes(bytes).expect("own file")), "{name} through Parquet");
        }
    }
}

// Source: the contract of the results: infinities are written as null and come back as NaN.
#[test]
fn infinities_come_back_as_nan() {
    let example = load_embedded(&[]).expect("is sound").line;
    let question = read(Verb::Shock, &QuestionText::default(), &example).expect("right");
    let Answer::History(mut history) = ask(&example, &question, &Silent).expect("answered") else {
        unreachable!("shock answers with a history")
    };
    let energy = history.metrics.energy_balance.as_mut().expect("integrated");
    (energy.work, energy.residual) = (f64::INFINITY, f64::NAN);
    let shaft = history.metrics.shafts.values_mut().next().expect("one shaft");
    (shaft.peak_torque, shaft.first_peak) = (f64::NEG_INFINITY, Some(f64::NAN));
    let answer = Answer::History(history);
    let text = to_json(&answer, true).expect("plain data");
    let bytes = to_bytes(&answer).expect("has a table");
    for back in [from_json(&text).expect("own text"), from_bytes(bytes).expect("own file")] {
        let Answer::History(back) = back else { panic!("a history") };
        let energy = back.metrics.energy_balance.expect("integrated");
        assert!(energy.work.is_nan() && energy.residual.is_nan() && energy.stored.is_finite());
        let shaft = back.metrics.shafts.values().next().expect("one shaft");
        assert!(shaft.peak_torque.is_nan());
        assert_eq!(shaft.first_peak, None);
    }
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
