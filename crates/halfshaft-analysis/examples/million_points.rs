//! Number of responses at a million pairs of excitation speed and parameter, by first harmonic:
//!
//! ```text
//! cargo run --release -p halfshaft-analysis --example million_points
//! ```
//!
//! Prints, for four parameters of the embedded oscillator, the seconds that the map took on one
//! thread and how many points have 1, 2 or 3 responses (`bench/peers/periodic`).
#![allow(clippy::print_stdout, reason = "it is read by a script")]

use std::error::Error;
use std::time::Instant;

use halfshaft_analysis::response_count;
use halfshaft_model::question::{Question, QuestionText, Verb, read};
use halfshaft_model::{Source, embedded, read_model};

const SIDE: u32 = 1000;

fn main() -> Result<(), Box<dyn Error>> {
    let text: Source = embedded::scaled();
    let (line, _) = read_model(text, &[]).map_err(|found| found.plain())?;
    let even = |from: f64, to: f64| -> Vec<f64> {
        (0..SIDE).map(|k| from + (to - from) * f64::from(k) / f64::from(SIDE - 1)).collect()
    };
    let speeds = even(25.0, 26.5);
    for (parameter, from, to) in [
        ("excitation.amplitude", 1.0, 20.0),
        ("spring.cubic", -1.0, -0.1),
        ("spring.damping", 0.02, 0.16),
        ("oscillator.inertia", 0.99, 1.01),
    ] {
        let asked = QuestionText {
            parameter: Some(format!("{parameter}={from}..{to}")),
            method: Some("first-harmonic".to_owned()),
            ..QuestionText::default()
        };
        let Ok(Question::Folds(asked)) = read(Verb::Folds, &asked, &line) else {
            return Err(format!("{parameter} cannot be asked for").into());
        };
        let values = even(from, to);
        let start = Instant::now();
        let found = response_count(&line, &asked, &speeds, &values)?;
        let seconds = start.elapsed().as_secs_f64();
        let counts = found.count.iter().flatten();
        let of = |wanted: u32| counts.clone().filter(|count| **count == wanted).count();
        println!("{parameter} {seconds:.4} {} {} {}", of(1), of(2), of(3));
    }
    Ok(())
}
