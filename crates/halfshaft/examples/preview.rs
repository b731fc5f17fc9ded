//! Writes what the program shows to a folder, for looking at:
//! `cargo run --example preview -- FOLDER [STUDY.toml]`.
//!
//! Several lines, each with its summaries as text, its figures as SVG and PNG, its sketch, and its
//! report as HTML: answers made by hand with everything that harmonic balance can find, the embedded
//! example, the same in a gear that does not hold, the scaled
//! oscillator, the starter file, and a long branched line made up from a fixed seed. With a study also
//! its summary, page and figures.

use std::error::Error;
use std::fmt::Write as _;
use std::path::Path;

use halfshaft::model::embedded;
use halfshaft::model::question::{QuestionText, Verb, read};
use halfshaft::model::study::read_study;
use halfshaft::model::{SetFlag, Source, read_model};
use halfshaft::present::figure::{SvgOptions, png, svg};
use halfshaft::present::{figures, html, sketch, summary};
use halfshaft::{Answer, Driveline, Silent, ask, report, run_study};

#[path = "../tests/present/made.rs"]
#[allow(dead_code, clippy::unwrap_used, reason = "its numbers are the tests'")]
mod made;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args_os().nth(1).ok_or("which folder?")?;
    let folder = Path::new(&folder);
    for (name, answer) in made::all() {
        let folder = folder.join("made").join(name);
        std::fs::create_dir_all(&folder)?;
        write(name, &answer, &folder)?;
        pictures(&answer, &folder)?;
    }
    let made = folder.join("made").join("report");
    std::fs::create_dir_all(&made)?;
    let report = made::with_every_method(&report(&line(embedded::scaled(), &[])?, &Silent)?);
    let report = Answer::Report(Box::new(report));
    write("report", &report, &made)?;
    pictures(&report, &made)?;
    let starter = Source::new("starter", embedded::starter());
    let branched = Source::new("branched", branched(23));
    let scaled = |sets: &[&str]| line(embedded::scaled(), sets);
    for (name, line) in [
        ("embedded", line(embedded::example(), &[])?),
        ("overloaded", line(embedded::example(), &["gearbox.ratio=1.79"])?),
        ("hardening", line(embedded::example(), &["half-shaft.cubic=642"])?),
        ("scaled", scaled(&[])?),
        ("starter", line(starter, &[])?),
        ("branched", line(branched, &[])?),
    ] {
        let folder = folder.join(name);
        std::fs::create_dir_all(&folder)?;
        show(&line, &folder)?;
    }
    match std::env::args_os().nth(2) {
        Some(study) => show_study(Path::new(&study), &folder.join("study")),
        None => Ok(()),
    }
}

fn show_study(path: &Path, folder: &Path) -> Result<(), Box<dyn Error>> {
    std::fs::create_dir_all(folder)?;
    let study = Answer::Study(run_study(&read_study(path)?, &Silent));
    write("study", &study, folder)?;
    pictures(&study, folder)
}

fn line(source: Source, sets: &[&str]) -> Result<Driveline, Box<dyn Error>> {
    let sets: Vec<SetFlag> = sets.iter().map(|set| SetFlag((*set).to_owned())).collect();
    let (line, _) = read_model(source, &sets).map_err(|mistakes| mistakes.plain())?;
    Ok(line)
}

fn show(line: &Driveline, folder: &Path) -> Result<(), Box<dyn Error>> {
    let whole = Answer::Report(Box::new(report(line, &Silent)?));
    write("report", &whole, folder)?;
    pictures(&whole, folder)?;
    for (verb, text) in questions() {
        let Ok(question) = read(verb, &text, line) else { continue };
        match ask(line, &question, &Silent) {
            Ok(answer) => write(verb.name(), &answer, folder)?,
            Err(error) => std::fs::write(folder.join(verb.name()), error.to_string())?,
        }
    }
    Ok(())
}

fn pictures(answer: &Answer, folder: &Path) -> Result<(), Box<dyn Error>> {
    for figure in figures::of(answer) {
        let text = svg::render(&figure, &SvgOptions::default());
        std::fs::write(folder.join(format!("{}.svg", figure.id)), text)?;
        let picture = png::render(&figure, 1.5)?;
        std::fs::write(folder.join(format!("{}.png", figure.id)), picture)?;
    }
    Ok(())
}

/// Every question with settings that show much.
fn questions() -> Vec<(Verb, QuestionText)> {
    let usual = QuestionText::default;
    let averaged = || QuestionText { method: Some("averaged".to_owned()), ..usual() };
    vec![
        (Verb::Check, usual()),
        (Verb::Static, usual()),
        (Verb::Modes, usual()),
        (Verb::Simulate, QuestionText { duration: Some("2 s".to_owned()), ..usual() }),
        (Verb::Shock, QuestionText { compare: true, ..usual() }),
        (Verb::Resonance, QuestionText { verify: true, ..averaged() }),
        (Verb::Folds, QuestionText { parameter: Some("mode.f=1..2000".to_owned()), ..averaged() }),
    ]
}

fn write(name: &str, answer: &Answer, folder: &Path) -> Result<(), Box<dyn Error>> {
    std::fs::write(folder.join(format!("{name}.txt")), summary::text(answer))?;
    std::fs::write(folder.join(format!("{name}.html")), html::page(answer))?;
    if let Answer::Check(check) = answer {
        std::fs::write(folder.join("sketch.svg"), sketch::sketch(check))?;
    }
    Ok(())
}

/// A made-up line: engine, gearbox, a long shaft in pieces, and branches off it.
fn branched(bodies: usize) -> String {
    let mut seed = 20_u64;
    let mut number = move |low: f64, high: f64| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let share = (seed >> 40) as f64 / (1_u64 << 24) as f64;
        low * (high / low).powf(share)
    };
    let mut text = String::from("format = 1\nname = \"Made-up branched line\"\n");
    let mut part = |words: std::fmt::Arguments<'_>| text.write_fmt(words);
    for body in 0..bodies {
        let inertia = number(0.01, 3.0);
        let _ = part(format_args!("[[inertia]]\nname = \"body {body}\"\ninertia = {inertia:.4}\n"));
    }
    for body in 1..bodies {
        // Every fifth body starts a branch a little way back.
        let from = if body % 5 == 0 { body.saturating_sub(3) } else { body - 1 };
        let (stiffness, damping) = (number(2e3, 6e4), number(0.3, 6.0));
        let cubic = if body % 7 == 1 {
            format!("cubic = {:.0}\n", -4.0 * stiffness)
        } else {
            String::new()
        };
        let _ = part(format_args!(
            "[[shaft]]\nname = \"shaft {body}\"\nfrom = \"body {from}\"\nto = \"body {body}\"\n\
             stiffness = {stiffness:.0}\ndamping = {damping:.2}\n{cubic}"
        ));
    }
    let _ = part(format_args!(
        "[[gear]]\nname = \"transfer gear\"\ninput = \"body 4\"\noutput = \"front output\"\n\
         ratio = 2.4\n[[inertia]]\nname = \"front wheels\"\ninertia = 1.7\n[[shaft]]\n\
         name = \"front shaft\"\nfrom = \"front output\"\nto = \"front wheels\"\n\
         stiffness = \"9 kN·m/rad\"\ndamping = 4\n[[torque]]\nname = \"engine\"\non = \"body 0\"\n\
         mean = \"120 N·m\"\namplitude = \"25 N·m\"\norder = 2\n[[torque]]\nname = \"load\"\n\
         on = \"body {}\"\nmean = \"balance\"\n\
         pulse = {{ shape = \"half-sine\", peak = \"-400 N·m\", start = 0, duration = \"30 ms\" }}\n",
        bodies - 1
    ));
    text
}
