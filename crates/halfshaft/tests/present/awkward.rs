//! Answers as no analysis gives them, and lines at the edge: everything is shown, nothing panics.

use std::fmt::Write as _;

use halfshaft::Answer;
use halfshaft::model::embedded;
use halfshaft::present::figure::svg::{SvgOptions, render};
use halfshaft::present::summary::WIDTH;
use halfshaft::present::{figures, sketch, summary};
use halfshaft::results::io;
use serde_json::{Value, json};

use super::common::{
    HARDENING, OVERLOADED, SCALED, answers, line, study, the_report, whole, written,
};
use super::html::Page;
use super::summary::columns;

/// Shows an answer in every way, and looks at what must hold of any text.
fn show(answer: &Answer, with_page: bool) {
    let text = summary::text(answer);
    for line in text.lines() {
        assert!(columns(line) <= WIDTH, "{line}");
        assert!(!line.contains(char::is_control), "{line:?}");
    }
    for word in ["NaN", "inf ", "None", "Some("] {
        assert!(!text.contains(word), "{word} in\n{text}");
    }
    for figure in figures::of(answer) {
        let _ = render(&figure, &SvgOptions::default());
    }
    if let Answer::Check(check) = answer {
        let _ = sketch::sketch(check);
    }
    if with_page {
        super::html::assert_sound(&Page::of(answer));
    }
}

/// Long lists of numbers cut short: what is tried here does not depend on how many there are.
fn thinned(value: &mut Value) {
    match value {
        Value::Array(list) => {
            if list.iter().all(|one| one.is_number() || one.is_null()) {
                list.truncate(5);
            }
            list.iter_mut().for_each(thinned);
        }
        Value::Object(parts) => parts.values_mut().for_each(thinned),
        _ => {}
    }
}

/// The way to every part of a value.
fn ways(value: &Value, way: &str, all: &mut Vec<String>) {
    let mut go = |key: &str, part: &Value| {
        let way = format!("{way}/{}", key.replace('~', "~0").replace('/', "~1"));
        all.push(way.clone());
        ways(part, &way, all);
    };
    match value {
        Value::Array(list) => {
            for (index, part) in list.iter().enumerate().take(3) {
                go(&index.to_string(), part);
            }
        }
        Value::Object(parts) => parts.iter().for_each(|(key, part)| go(key, part)),
        _ => {}
    }
}

/// What to put in place of a part.
fn instead(part: &Value) -> Vec<Value> {
    match part {
        Value::Array(_) => vec![json!([]), Value::Null],
        Value::Object(_) => vec![json!({}), Value::Null],
        Value::Number(_) => {
            vec![json!(0.0), json!(-1.0), json!(1e300), json!(-1e-300), Value::Null]
        }
        Value::String(_) => vec![json!(""), json!("\u{1b}[1mä\n漢字 ".repeat(40))],
        Value::Bool(truth) => vec![json!(!truth)],
        Value::Null => vec![],
    }
}

/// Changes one part after the other; shows what is still an answer. Returns how many were.
fn shaken(answer: &Answer) -> u32 {
    let mut whole: Value = serde_json::from_str(&io::to_json(answer, false).unwrap()).unwrap();
    thinned(&mut whole);
    let mut all = Vec::new();
    ways(&whole, "", &mut all);
    let mut shown = 0;
    for way in all {
        let own = whole.pointer(&way).cloned().unwrap();
        for other in instead(&own) {
            let removes = other.is_null() || other == json!([]) || other == json!({});
            *whole.pointer_mut(&way).unwrap() = other;
            if let Ok(answer) = serde_json::from_value::<Answer>(whole.clone()) {
                show(&answer, removes);
                shown += 1;
            }
        }
        *whole.pointer_mut(&way).unwrap() = own;
    }
    shown
}

// Source: the contract: no result makes the presentation fail.
#[test]
fn answers_with_any_part_missing_or_odd_are_shown() {
    let scaled = answers(&line(embedded::scaled(), &[]));
    let folding =
        scaled.into_iter().filter(|a| matches!(a, Answer::Resonance(_) | Answer::Folds(_)));
    for answer in answers(&line(embedded::example(), &[])).into_iter().chain(folding) {
        let name = answer.header().analysis.clone();
        let shown = shaken(&answer);
        assert!(shown > 30, "{name}: only {shown} were still answers");
    }
}

// Source: the same, for the report with every section, and folds and jumps in it.
#[test]
fn reports_with_any_part_missing_or_odd_are_shown() {
    let report = the_report(&SCALED).clone();
    // Sections without a header of numbers of their own are shaken above.
    let mut small = report;
    small.closed_folds.truncate(1);
    assert!(shaken(&Answer::Report(Box::new(small))) > 100);
}

// Source: the same, for answers with everything that harmonic balance can find.
#[test]
fn periodic_responses_with_any_part_missing_or_odd_are_shown() {
    for (name, answer) in super::made::all() {
        show(&answer, true);
        let shown = shaken(&answer);
        assert!(shown > 30, "{name}: only {shown} were still answers");
    }
}

// Source: the same, for a study whose figures have names that are alike as names of files.
#[test]
fn studies_with_any_part_missing_or_odd_are_shown() {
    assert!(shaken(&study()) > 100);
}

// Source: the same, for lines at the edge of what the model allows.
#[test]
fn lines_at_the_edge_are_shown() {
    let silent = ["engine torque.mean=0", "engine torque.amplitude=0", "road load.mean=0"];
    let single = "format = 1\nname = \"One\"\n[[inertia]]\nname = \"disc\"\ninertia = 2\n\
        [[shaft]]\nname = \"rod\"\nfrom = \"disc\"\nto = \"ground\"\nstiffness = 50\n";
    let lines = [
        line(embedded::example(), &["gearbox.ratio=1.79"]),
        line(embedded::example(), &["half-shaft.cubic=642"]),
        line(embedded::example(), &silent),
        line(embedded::example(), &["half-shaft.cubic=0", "half-shaft.damping=0"]),
        written(single),
        written(&comb()),
    ];
    for line in &lines {
        for answer in answers(line) {
            show(&answer, true);
        }
        show(&whole(line), true);
    }
    show(&OVERLOADED, true);
    show(&HARDENING, true);
}

/// Many equal branches on one inertia.
fn comb() -> String {
    let mut text =
        "format = 1\nname = \"Comb\"\n[[inertia]]\nname = \"hub\"\ninertia = 1\n".to_owned();
    for arm in 0..12 {
        write!(
            text,
            "[[inertia]]\nname = \"mass {arm}\"\ninertia = 0.1\n[[shaft]]\nname = \"arm {arm}\"\n\
             from = \"hub\"\nto = \"mass {arm}\"\nstiffness = 100\n"
        )
        .unwrap();
    }
    text + "[[torque]]\nname = \"drive\"\non = \"hub\"\nmean = 5\namplitude = 1\n"
}
