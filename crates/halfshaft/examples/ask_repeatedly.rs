//! Asks one question of one line again and again and throws the answers away:
//!
//! ```text
//! cargo run --release --example ask_repeatedly -- COUNT MODEL.toml resonance --frequency 25..26.6
//! ```
//!
//! For measuring: the difference in processor time between two counts is what the question costs
//! by itself, without the start of the program and the writing of its answer (`bench/peers`).

use std::error::Error;
use std::hint::black_box;
use std::path::Path;

use halfshaft::model::question::{QuestionText, Verb, read};
use halfshaft::{Question, Silent, ask, load};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [count, model, verb, options @ ..] = arguments.as_slice() else {
        return Err("usage: COUNT MODEL.toml resonance|folds [--OPTION VALUE]...".into());
    };
    let line = load(Path::new(model), &[])?.line;
    let verb = match verb.as_str() {
        "resonance" => Verb::Resonance,
        "folds" => Verb::Folds,
        other => return Err(format!("{other} is not measured here").into()),
    };
    let question: Question = read(verb, &text(options)?, &line)
        .map_err(|errors| errors.iter().map(|error| format!("{error:?}\n")).collect::<String>())?;
    for _ in 0..count.parse::<usize>()? {
        black_box(ask(&line, black_box(&question), &Silent)?);
    }
    Ok(())
}

/// The options as the command line takes them, those that curves have.
fn text(options: &[String]) -> Result<QuestionText, Box<dyn Error>> {
    let mut text = QuestionText::default();
    for pair in options.chunks(2) {
        let [name, value] = pair else { return Err(format!("{} lacks a value", pair[0]).into()) };
        let place = match name.as_str() {
            "--frequency" => &mut text.frequency,
            "--parameter" => &mut text.parameter,
            "--method" => &mut text.method,
            "--tolerance" => &mut text.tolerance,
            "--points" => &mut text.points,
            "--harmonics" => &mut text.harmonics,
            other => return Err(format!("{other} is not known here").into()),
        };
        *place = Some(value.clone());
    }
    Ok(text)
}
