//! Resonance of many lines that differ in two numbers, on some threads, thrown away when a number has been
//! read off:
//!
//! ```text
//! cargo run --release -p halfshaft --example many_lines -- MODEL.toml COUNT THREADS METHOD
//! ```
//!
//! The yardstick for the ensembles of the Python package (`bench/ensemble.py`): the same rows, the same
//! question, the same number of threads, and nothing in between.

#![allow(clippy::print_stdout, reason = "it is read by a script")]

use std::error::Error;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::Instant;

use halfshaft::model::Parameter;
use halfshaft::model::question::{QuestionText, Verb, read};
use halfshaft::{Answer, Driveline, Question, Silent, ask, load};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [model, count, threads, method] = arguments.as_slice() else {
        return Err("usage: MODEL.toml COUNT THREADS METHOD".into());
    };
    let line = load(Path::new(model), &[])?.line;
    let text = QuestionText { method: Some(method.clone()), ..QuestionText::default() };
    let question = read(Verb::Resonance, &text, &line).map_err(|errors| format!("{errors:?}"))?;
    let addresses = ["spring.cubic", "excitation.amplitude"];
    let parameters = addresses.map(|address| line.parameter(address));
    let [Ok(cubic), Ok(amplitude)] = parameters else {
        return Err("the model needs the shaft \"spring\" and the torque \"excitation\"".into());
    };
    let (count, threads) = (count.parse::<usize>()?, threads.parse::<usize>()?);
    let (next, began) = (AtomicUsize::new(0), Instant::now());
    let work = || {
        let mut sum = 0.0;
        loop {
            let row = next.fetch_add(1, Ordering::Relaxed);
            if row >= count {
                return sum;
            }
            sum += samples(&line, &question, [&cubic, &amplitude], row as f64 / count as f64);
        }
    };
    let sum: f64 = thread::scope(|scope| {
        let all: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        all.into_iter().map(|one| one.join().unwrap_or(f64::NAN)).sum()
    });
    println!("{:.6} {sum}", began.elapsed().as_secs_f64());
    Ok(())
}

/// Samples of all branches of the line at a place between 0 and 1 of the table; NaN without an answer.
fn samples(line: &Driveline, question: &Question, [k, f]: [&Parameter; 2], place: f64) -> f64 {
    let changed =
        line.with(k, -1.0 + 0.9 * place).and_then(|line| line.with(f, 5.0 + 10.0 * place));
    match changed.map(|line| ask(&line, question, &Silent)) {
        Ok(Ok(Answer::Resonance(answer))) => {
            let rows =
                answer.branches.iter().map(|b| b.columns.first().map_or(0, |c| c.values.len()));
            rows.sum::<usize>() as f64
        }
        _ => f64::NAN,
    }
}
