//! Lines with their answers, and ways to read what is shown of them.

use std::sync::LazyLock;

use halfshaft::model::embedded;
use halfshaft::model::question::read;
use halfshaft::model::{Source, read_model};
use halfshaft::results::{
    ComparisonRow, ItemStyle, ReportResult, StudyFigureSpec, StudyItem, StudyResult, io,
};
use halfshaft::{Answer, Driveline, Question, QuestionText, SetFlag, Silent, Verb, ask, report};

/// The report of the embedded example by every method.
pub static EVERY_METHOD: LazyLock<Answer> =
    LazyLock::new(|| whole(&line(embedded::example(), &[])));
/// The same of the scaled oscillator, whose response folds.
pub static EVERY_METHOD_SCALED: LazyLock<Answer> =
    LazyLock::new(|| whole(&line(embedded::scaled(), &[])));
/// The report of the embedded example where the closed form is all there is.
pub static EMBEDDED: LazyLock<Answer> = LazyLock::new(|| closed_form_alone(&EVERY_METHOD));
/// The same in a gear that does not hold.
pub static OVERLOADED: LazyLock<Answer> =
    LazyLock::new(|| whole(&line(embedded::example(), &["gearbox.ratio=1.79"])));
/// The same with a shaft that stiffens.
pub static HARDENING: LazyLock<Answer> = LazyLock::new(|| {
    closed_form_alone(&whole(&line(embedded::example(), &["half-shaft.cubic=642"])))
});
/// The report of the scaled oscillator where the closed form is all there is.
pub static SCALED: LazyLock<Answer> = LazyLock::new(|| closed_form_alone(&EVERY_METHOD_SCALED));

/// A line with settings such as `gearbox.ratio=1.79`.
pub fn line(source: Source, sets: &[&str]) -> Driveline {
    let sets: Vec<SetFlag> = sets.iter().map(|set| SetFlag((*set).to_owned())).collect();
    let (line, _) = read_model(source, &sets).map_err(|mistakes| mistakes.plain()).unwrap();
    line
}

/// A line from the text of a model file.
pub fn written(text: &str) -> Driveline {
    line(Source::new("test.toml", text), &[])
}

pub fn whole(line: &Driveline) -> Answer {
    Answer::Report(Box::new(report(line, &Silent).unwrap()))
}

/// A report as it is where no other method of the resonance than the closed form has an answer:
/// what theory says by hand is to be found in it.
pub fn closed_form_alone(answer: &Answer) -> Answer {
    let mut report = the_report(answer).clone();
    report.resonance = None;
    report.first_harmonic = None;
    report.folds.clear();
    report.levels.clear();
    report.missing.retain(|one| !matches!(one.section.as_str(), "resonance" | "first-harmonic"));
    Answer::Report(Box::new(report))
}

pub fn the_report(answer: &Answer) -> &ReportResult {
    let Answer::Report(report) = answer else { panic!("no report") };
    report
}

/// The answers that a line gives, one a verb, those that it cannot give left out.
pub fn answers(line: &Driveline) -> Vec<Answer> {
    let usual = QuestionText::default;
    let short = || Some("2 s".to_owned());
    let averaged = || QuestionText { method: Some("averaged".to_owned()), ..usual() };
    let asked = [
        (Verb::Check, usual()),
        (Verb::Static, usual()),
        (Verb::Modes, usual()),
        (Verb::Campbell, QuestionText { operating: Some("50rpm..400rpm".to_owned()), ..usual() }),
        (Verb::Forced, QuestionText { points: Some("50".to_owned()), ..usual() }),
        (Verb::Simulate, QuestionText { duration: short(), ..usual() }),
        (Verb::Shock, QuestionText { compare: true, ..usual() }),
        (Verb::Resonance, QuestionText { verify: true, ..averaged() }),
        (Verb::Folds, QuestionText { parameter: Some("mode.f=1..2000".to_owned()), ..averaged() }),
        (Verb::Bifurcation, QuestionText { steps: Some("5".to_owned()), ..usual() }),
    ];
    let answer = |(verb, text): (Verb, QuestionText)| {
        ask(line, &read(verb, &text, line).ok()?, &Silent).ok()
    };
    asked.into_iter().filter_map(answer).collect()
}

/// A report that tells nothing but what the shafts carry; quick to have.
pub fn static_report(line: &Driveline) -> Answer {
    let Ok(Answer::Check(check)) = ask(line, &Question::Check, &Silent) else { panic!("no check") };
    let Ok(Answer::Static(statics)) = ask(line, &Question::Static, &Silent) else {
        panic!("no statics")
    };
    let mut header = check.header.clone();
    header.analysis = "report".to_owned();
    Answer::Report(Box::new(ReportResult {
        header,
        check,
        statics: Some(statics),
        modes: None,
        campbell: None,
        forced: None,
        shock: None,
        resonance: None,
        first_harmonic: None,
        basins: None,
        closed_form: None,
        levels: Vec::new(),
        folds: Vec::new(),
        closed_folds: Vec::new(),
        missing: Vec::new(),
    }))
}

/// A study of the scaled oscillator: a response, a fold plane, a question without an answer, and
/// figures whose names are alike when signs are left out.
pub fn study() -> Answer {
    let line = line(embedded::scaled(), &[]);
    let found = answers(&line);
    let item = |figure: &str, question: &str, answer: Option<Answer>| StudyItem {
        figure: Some(figure.to_owned()),
        question: question.to_owned(),
        style: ItemStyle::Line,
        failure: answer.is_none().then(|| "nothing disturbs the line".to_owned()),
        answer,
    };
    let spec = |name: &str, x: &str, y: &str| StudyFigureSpec {
        name: name.to_owned(),
        title: format!("Figure {name}"),
        caption: "As printed".to_owned(),
        x: x.to_owned(),
        y: y.to_owned(),
        x_range: None,
        y_range: Some((0.0, 30.0)),
    };
    let of = |verb: &str| found.iter().find(|a| a.header().analysis == verb).cloned();
    let mut header = the_report(&SCALED).header.clone();
    header.analysis = "run".to_owned();
    Answer::Study(StudyResult {
        header,
        description: "Two printed figures".to_owned(),
        items: vec![
            item("fig 8", "response", of("resonance")),
            item("fig/8", "plane", of("folds")),
            item("fig 8", "shock", None),
        ],
        figures: vec![
            spec("fig 8", "frequency", "rho"),
            spec("fig/8", "frequency", "mode.f"),
            spec("fig ä", "sigma", "rho"),
        ],
        comparisons: vec![ComparisonRow {
            figure: "fig 8".to_owned(),
            what: "jump".to_owned(),
            printed: "25.9".to_owned(),
            recomputed: "25.94".to_owned(),
            difference: "-0.2 %".to_owned(),
            printed_value: Some(25.9),
            recomputed_value: Some(25.94),
            remark: "read off".to_owned(),
        }],
    })
}

/// The same answer about a line with other names.
pub fn renamed(answer: &Answer, names: &[(&str, &str)]) -> Answer {
    let mut text = io::to_json(answer, false).unwrap();
    for (old, new) in names {
        let new = serde_json::to_string(new).unwrap();
        text = text.replace(old, new.trim_matches('"'));
    }
    io::from_json(&text).unwrap()
}

/// A text in one line with one space between words.
pub fn flat(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The first number after a phrase, as a reader takes it: `−1.5×10⁻³`.
pub fn number_after(text: &str, phrase: &str) -> f64 {
    let at = text.find(phrase).unwrap_or_else(|| panic!("no \"{phrase}\" in:\n{text}"));
    let after = &text[at + phrase.len()..];
    let starts = |c: char| c.is_ascii_digit() || c == '−';
    let start = after.find(starts).unwrap_or_else(|| panic!("no number after \"{phrase}\""));
    let belongs = |c: char| c.is_ascii_digit() || "−.×⁻⁰¹²³⁴⁵⁶⁷⁸⁹".contains(c);
    let digits: String = after[start..].chars().take_while(|c| belongs(*c)).collect();
    read_number(&digits)
}

fn read_number(text: &str) -> f64 {
    let ascii = |c: char| match "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().position(|raised| raised == c)
    {
        Some(digit) => char::from_digit(u32::try_from(digit).unwrap(), 10).unwrap(),
        None if c == '−' || c == '⁻' => '-',
        None => c,
    };
    let text: String = text.trim_end_matches('.').replace("×10", "e").chars().map(ascii).collect();
    text.parse().unwrap_or_else(|_| panic!("\"{text}\" is no number"))
}

/// Whether a printed number is a value to so many digits.
#[track_caller]
pub fn assert_shows(shown: f64, value: f64, digits: i32) {
    let slack = 0.5001 * 10.0_f64.powi(1 - digits) * value.abs();
    assert!((shown - value).abs() <= slack, "{shown} is not {value} to {digits} digits");
}

/// What the theory says of the embedded example, from the numbers of its file.
pub mod by_hand {
    /// Linear and cubic stiffness of the half-shaft, N·m/rad and N·m/rad³.
    pub const K1: f64 = 6420.0;
    pub const K3: f64 = -642.0;
    /// Engine torque through the final drive in direct gear, N·m.
    pub const DEMAND: f64 = 850.0 * 5.71;

    /// Twist at which `K1 x + K3 x³` is largest.
    pub fn limit_twist() -> f64 {
        (K1 / (-3.0 * K3)).sqrt()
    }

    /// The torque there.
    pub fn capacity() -> f64 {
        2.0 / 3.0 * K1 * limit_twist()
    }

    /// Twist under a torque: the smallest root of the cubic, by Viète's cosine.
    pub fn twist(torque: f64) -> f64 {
        let angle = (-torque / capacity()).acos() / 3.0;
        2.0 * limit_twist() * (angle - 2.0 * std::f64::consts::FRAC_PI_3).cos()
    }

    /// Engine and vehicle as one inertia on the half-shaft.
    pub fn inertia() -> f64 {
        let engine = 0.328 * 5.71 * 5.71;
        engine * 81.6 / (engine + 81.6)
    }

    /// Smallest `f` at which `x'' + ω² x + α x³ + β x' = f cos` folds (theory 5).
    pub fn fold_threshold(omega: f64, alpha: f64, beta: f64) -> f64 {
        (32.0 * omega.powi(3) * beta.powi(3) / (9.0 * 3.0_f64.sqrt() * alpha.abs())).sqrt()
    }
}
