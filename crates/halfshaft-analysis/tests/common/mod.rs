//! Lines and questions for the tests.
#![allow(dead_code, reason = "each test file uses a part of this")]

use halfshaft_analysis::{AnalysisError, ask};
use halfshaft_model::question::{Question, QuestionText, Verb, read};
use halfshaft_model::{Driveline, SetFlag, Source, embedded, read_model};
use halfshaft_numerics::observer::Silent;
use halfshaft_results::{
    Answer, FoldsResult, HistoryResult, ModesResult, ResonanceResult, SpecialKind, SpecialPoint,
    StaticResult,
};

/// The line of a model text with settings applied.
pub fn line_of(text: &str, settings: &[&str]) -> Driveline {
    let settings: Vec<SetFlag> = settings.iter().map(|s| SetFlag((*s).to_owned())).collect();
    match read_model(Source::new("test.toml", text), &settings) {
        Ok((line, _)) => line,
        Err(found) => panic!("{}", found.plain()),
    }
}

/// The embedded two-mass driveline.
pub fn driveline(settings: &[&str]) -> Driveline {
    line_of(&embedded::example().text, settings)
}

/// The embedded scaled oscillator.
pub fn oscillator(settings: &[&str]) -> Driveline {
    line_of(&embedded::scaled().text, settings)
}

/// Asks a question whose options are right.
pub fn try_ask(line: &Driveline, verb: Verb, text: &QuestionText) -> Result<Answer, AnalysisError> {
    let question = question(line, verb, text);
    ask(line, &question, &Silent)
}

pub fn question(line: &Driveline, verb: Verb, text: &QuestionText) -> Question {
    read(verb, text, line).unwrap_or_else(|errors| panic!("{errors:?}"))
}

fn asked(line: &Driveline, verb: Verb, text: &QuestionText) -> Answer {
    try_ask(line, verb, text).unwrap_or_else(|error| panic!("{error}"))
}

pub fn statics(line: &Driveline) -> StaticResult {
    match asked(line, Verb::Static, &QuestionText::default()) {
        Answer::Static(result) => result,
        other => panic!("{other:?}"),
    }
}

pub fn modes(line: &Driveline) -> ModesResult {
    match asked(line, Verb::Modes, &QuestionText::default()) {
        Answer::Modes(result) => result,
        other => panic!("{other:?}"),
    }
}

pub fn history(line: &Driveline, verb: Verb, text: &QuestionText) -> HistoryResult {
    match asked(line, verb, text) {
        Answer::History(result) => result,
        other => panic!("{other:?}"),
    }
}

/// Answer of `resonance` by the method that the options name, else by averaging.
pub fn resonance(line: &Driveline, text: &QuestionText) -> ResonanceResult {
    let method = text.method.clone().or(some("averaged"));
    match asked(line, Verb::Resonance, &QuestionText { method, ..text.clone() }) {
        Answer::Resonance(result) => result,
        other => panic!("{other:?}"),
    }
}

pub fn folds(line: &Driveline, parameter: &str) -> FoldsResult {
    let (parameter, method) = (some(parameter), some("averaged"));
    let text = QuestionText { parameter, method, ..QuestionText::default() };
    match asked(line, Verb::Folds, &text) {
        Answer::Folds(result) => result,
        other => panic!("{other:?}"),
    }
}

/// Text option.
pub fn some(text: &str) -> Option<String> {
    Some(text.to_owned())
}

pub fn of_kind(points: &[SpecialPoint], kind: SpecialKind) -> Vec<&SpecialPoint> {
    points.iter().filter(|point| point.kind == kind).collect()
}

#[track_caller]
pub fn assert_close(actual: f64, expected: f64, relative: f64) {
    let error = (actual - expected).abs();
    let bound = relative * expected.abs().max(f64::MIN_POSITIVE);
    assert!(error <= bound, "{actual} is not {expected} to {relative:e} (off by {error:e})");
}

/// A chain of inertias with linear shafts, free or held at ground before the first inertia.
pub fn chain(inertias: &[f64], stiffness: &[f64], ground: Option<f64>, damping: f64) -> String {
    let mut text = "format = 1\nname = \"chain\"\n".to_owned();
    for (index, inertia) in inertias.iter().enumerate() {
        text += &format!("[[inertia]]\nname = \"n{index}\"\ninertia = {inertia:?}\n");
    }
    for (index, k) in stiffness.iter().enumerate() {
        text += &format!(
            "[[shaft]]\nname = \"s{index}\"\nfrom = \"n{index}\"\nto = \"n{}\"\nstiffness = {k:?}\n\
             damping = {damping:?}\n",
            index + 1
        );
    }
    if let Some(k) = ground {
        text += &format!(
            "[[shaft]]\nname = \"held\"\nfrom = \"n0\"\nto = \"ground\"\nstiffness = {k:?}\n"
        );
    }
    text
}
