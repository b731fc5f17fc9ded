//! Messages that a first-time user stumbled over. Source: the notes of a first trial of the program.

use halfshaft_model::question::{QuestionText, Verb, read};
use halfshaft_model::study::read_study_text;
use halfshaft_model::{Diagnostics, SetFlag, Source, embedded, read_model};

fn told_of(text: &str, settings: &[&str]) -> Vec<(String, String)> {
    let settings: Vec<SetFlag> = settings.iter().map(|text| SetFlag((*text).to_owned())).collect();
    told(&read_model(Source::new("line.toml", text), &settings).expect_err("has mistakes"))
}

fn told(found: &Diagnostics) -> Vec<(String, String)> {
    let item = |item: &halfshaft_model::Diagnostic| {
        (item.message.clone(), item.hint.clone().unwrap_or_default())
    };
    found.errors().map(item).collect()
}

/// The example with one text replaced must have one mistake, told in these words.
#[track_caller]
fn one(from: &str, to: &str, message: &str, hint: &str) {
    let text = embedded::example().text;
    assert!(text.contains(from), "the example has {from}");
    let told = told_of(&text.replacen(from, to, 1), &[]);
    assert_eq!(told.len(), 1, "{told:?}");
    assert!(told[0].0.contains(message), "{told:?}");
    assert!(told[0].1.contains(hint), "{told:?}");
}

#[test]
fn a_misspelt_key_is_not_missed_as_well() {
    one("stiffness =", "stifness =", "unknown key \"stifness\"", "did you mean \"stiffness\"?");
    let text = embedded::example().text;
    let told = told_of(&text.replacen("peak =", "peek =", 1), &[]);
    assert_eq!(told.len(), 1, "{told:?}");
    // What is far from every key is no spelling of the missing one.
    let told = told_of(&text.replacen("stiffness =", "colour =", 1), &[]);
    assert_eq!(told.len(), 2, "{told:?}");
}

#[test]
fn a_word_in_place_of_a_number_is_compared_with_the_words_there_are() {
    one("mean = \"850 N·m\"", "mean = \"balanced\"", "balanced", "did you mean \"balance\"?");
    one("mean = \"850 N·m\"", "mean = \"x\"", "does not begin", "or the word \"balance\"");
    let told = told_of(&embedded::example().text, &["engine torque.mean=balanced"]);
    assert_eq!(told[0].1, "did you mean \"balance\"?");
}

#[test]
fn a_text_without_quotation_marks_is_told_once() {
    let (name, marks) = ("name = \"half-shaft\"", "in quotation marks");
    one(name, "name = flywheel", "quotation marks", "write \"flywheel\" in quotation marks");
    one(name, "name = true flywheel # x", "quotation marks", "write \"true flywheel\"");
    one("\"6420 N·m/rad\"", "6420 N·m/rad", "no quotation marks", "write \"6420 N·m/rad\"");
    one("ratio = 5.71", "ratio = 3.5:1", "no quotation marks", marks);
    one("ratio = 5.71", "ratio =", "", "the file is TOML");
    one("ratio = 5.71", "ratio = \"4,1\"", "does not begin", "written with a point: 4.1");
    one("ratio = 5.71", "ratio = 4,1", "\"4,1\" is no number", "written with a point: 4.1");
}

#[test]
fn a_wrong_sign_is_told_together_with_a_missing_unit() {
    let damping = "damping = \"90 N·m·s/rad\"";
    one(damping, "damping = \"-40\"", "must not be negative", "write \"40 N·m·s/rad\"");
    one(damping, "damping = \"-40 N·m·s/rad\"", "must not be negative", "leave the minus sign out");
    one(damping, "damping = -40", "must not be negative", "leave the minus sign out");
}

#[test]
fn a_ratio_may_be_written_as_a_proportion() {
    let text = embedded::example().text.replacen("ratio = 5.71", "ratio = \"57.1:10\"", 1);
    let set = SetFlag("gearbox.ratio=3.5:1".to_owned());
    let (line, _) = read_model(Source::new("line.toml", text), &[set]).expect("is sound");
    assert_eq!((line.gears()[0].ratio, line.gears()[1].ratio), (3.5, 5.71));
}

#[test]
fn one_kind_of_file_in_the_place_of_the_other_is_told_in_one_sentence() {
    let study = "format = 1\nname = \"s\"\n[[question]]\nname = \"a\"\nask = \"static\"\n";
    let told_of_study = told_of(study, &["a.b=1"]);
    assert_eq!(told_of_study.len(), 1, "{told_of_study:?}");
    assert_eq!(told_of_study[0].0, "this is a study file, not a model file");
    assert!(told_of_study[0].1.contains("`halfshaft run line.toml`"), "{told_of_study:?}");
    let model = Source::new("m.toml", embedded::example().text);
    let told = told(&read_study_text(model, "").expect_err("is no study"));
    assert_eq!(told.len(), 1, "{told:?}");
    assert_eq!(told[0].0, "this is a model file, not a study file");
    assert!(told[0].1.contains("`halfshaft check m.toml`"), "{told:?}");
}

#[test]
fn a_node_that_is_near_to_no_other_is_told_the_nodes_there_are() {
    let there = "engine, vehicle";
    one("to = \"vehicle\"", "to = \"xyz\"", "\"xyz\" has no inertia", there);
    one("on = \"engine\"", "on = \"xyz\"", "no node is named \"xyz\"", there);
}

#[test]
fn a_record_that_runs_backwards_is_refused() {
    let line = read_model(embedded::example(), &[]).expect("is sound").0;
    let text = QuestionText { record: Some("2..1".to_owned()), ..QuestionText::default() };
    let errors = read(Verb::Simulate, &text, &line).expect_err("runs backwards");
    assert_eq!(errors[0].hint, "did you mean \"1..2\"?");
}

/// What follows a header without its brackets stands in the wrong table: only the header is told.
#[test]
fn a_broken_header_is_the_only_mistake() {
    let text = embedded::example().text;
    for broken in ["[shaft", "[[shaft]", "[[shaft"] {
        let told = told_of(&text.replacen("[[shaft]]", broken, 1), &[]);
        assert_eq!(told.len(), 1, "{broken}: {told:?}");
        assert!(told[0].0.contains("unclosed"), "{broken}: {told:?}");
        assert!(told[0].1.contains("[[shaft]]"), "{broken}: {told:?}");
    }
}
