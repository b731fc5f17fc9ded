//! Laws given by functions, against the same law in the model file and against their own physics.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::path::Path;

use halfshaft::model::question::{QuestionText, Verb, read};
use halfshaft::model::{Source, read_model};
use halfshaft::results::SpecialKind;
use halfshaft::{Answer, Driveline, LawError, SampleError, Sampling, Silent, ask, load, with_law};

fn scaled() -> Driveline {
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples"));
    load(&folder.join("two-mass-driveline/scaled.toml"), &[]).unwrap().line
}

fn wide() -> Sampling {
    Sampling { range_rad: (-8.0, 8.0), ..Sampling::default() }
}

fn answer(line: &Driveline, verb: Verb, text: &QuestionText) -> Answer {
    let question = read(verb, text, line).unwrap();
    ask(line, &question, &Silent).unwrap()
}

fn folds(line: &Driveline) -> Vec<f64> {
    let text = QuestionText { frequency: Some("25.6..26.4".to_owned()), ..QuestionText::default() };
    let Answer::Resonance(result) = answer(line, Verb::Resonance, &text) else { panic!() };
    let points = result.branches.iter().flat_map(|branch| &branch.special_points);
    let folds = points.filter(|point| point.kind == SpecialKind::Fold);
    folds.map(|point| point.value("frequency").unwrap()).collect()
}

// Source: the same law as a polynomial of the model file.
#[test]
fn a_function_has_the_folds_of_the_polynomial_that_it_is() {
    let line = scaled();
    let function =
        with_law(&line, "spring", |x| 679.1236 * x - 0.679 * x * x * x, &wide()).unwrap();
    let (known, found) = (folds(&line), folds(&function));
    assert_eq!((known.len(), found.len()), (2, 2));
    for (a, b) in known.iter().zip(&found) {
        assert!((a / b - 1.0).abs() < 1e-12, "{a} {b}");
    }
}

// Source: the first integral of J x'' + T(x) = 0 with T = A sinh(B x).
#[test]
fn an_undamped_motion_keeps_its_energy() {
    const TEXT: &str = "format = 1\nname = \"free\"\n[[inertia]]\nname = \"disc\"\ninertia = 2\n\
        [[shaft]]\nname = \"rod\"\nfrom = \"disc\"\nto = \"ground\"\nstiffness = 1\n";
    let line = read_model(Source::new("free", TEXT), &[]).unwrap().0;
    let (a, b) = (300.0, 1.5);
    let line = with_law(&line, "rod", |x| a * (b * x).sinh(), &Sampling::default()).unwrap();
    let text = QuestionText {
        duration: Some("5s".to_owned()),
        initial: vec!["rod.twist=1.2 rad".to_owned()],
        tolerance: Some("1e-12".to_owned()),
        ..QuestionText::default()
    };
    let Answer::History(history) = answer(&line, Verb::Simulate, &text) else { panic!() };
    let column =
        |name: &str| &history.columns.iter().find(|column| column.name == name).unwrap().values;
    let energy = |(x, v): (&f64, &f64)| v * v + a / b * ((b * x).cosh() - 1.0);
    let all: Vec<f64> =
        column("rod.twist").iter().zip(column("rod.twist_rate")).map(energy).collect();
    assert!(all.len() > 100);
    for e in &all {
        assert!((e / all[0] - 1.0).abs() < 1e-9, "{e} {}", all[0]);
    }
}

#[test]
fn what_is_no_law_is_told() {
    let line = scaled();
    let nowhere = with_law(&line, "sprig", |x| x, &wide()).unwrap_err();
    assert_eq!(nowhere.to_string(), "no shaft is named \"sprig\": did you mean \"spring\"?");
    let kinked = with_law(&line, "spring", f64::abs, &wide()).unwrap_err();
    assert!(
        matches!(&kinked, LawError::Function { reason: SampleError::Rough { at }, .. } if at.len() == 1),
        "{kinked}"
    );
    assert!(kinked.to_string().contains("spring"));
}
