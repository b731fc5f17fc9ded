//! Times of `modes` and `forced` of a free chain within the process, for `bench/peers/torsional`.
//!
//! `torsional_times modes|frequencies|forced COUNT REPEATS`: a chain of COUNT inertias of 0.5 kg·m² with
//! shafts of 2e5 N·m/rad; without damping for `modes` and for their frequencies alone, with 10 N·m·s/rad
//! beside each shaft and four orders on the first inertia at 1000 speeds for `forced`. One line of JSON:
//! seconds of each repeat, and how many modes or speeds were told.

use std::error::Error;
use std::fmt::Write as _;
use std::time::Instant;

use halfshaft_analysis::{ask, natural_frequencies};
use halfshaft_model::question::{QuestionText, Verb, read};
use halfshaft_model::{Driveline, Source, read_model};
use halfshaft_numerics::observer::Silent;
use halfshaft_results::Answer;

/// Speeds of a forced vibration.
const SPEEDS: &str = "1000";

#[expect(clippy::print_stdout, reason = "a program of its own, whose output this is")]
fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [what, count, repeats] = arguments.as_slice() else {
        return Err("usage: torsional_times modes|frequencies|forced COUNT REPEATS".into());
    };
    let forced = what == "forced";
    let line = chain(count.parse()?, forced)?;
    let text = QuestionText {
        frequency: forced.then(|| "20..300".to_owned()),
        points: forced.then(|| SPEEDS.to_owned()),
        ..QuestionText::default()
    };
    let verb = if forced { Verb::Forced } else { Verb::Modes };
    let question = read(verb, &text, &line).map_err(|errors| format!("{errors:?}"))?;
    let (mut seconds, mut told) = (Vec::new(), 0);
    for _ in 0..repeats.parse::<usize>()? {
        let start = Instant::now();
        if what == "frequencies" {
            told = natural_frequencies(&line)?.len();
            seconds.push(start.elapsed().as_secs_f64());
            continue;
        }
        let answer = ask(&line, &question, &Silent)?;
        seconds.push(start.elapsed().as_secs_f64());
        told = match answer {
            Answer::Modes(modes) => modes.modes.len(),
            Answer::Forced(forced) => forced.gears.first().map_or(0, |gear| gear.table.rows()),
            _ => 0,
        };
    }
    println!("{{\"seconds\": {seconds:?}, \"modes\": {told}}}");
    Ok(())
}

fn chain(count: usize, forced: bool) -> Result<Driveline, Box<dyn Error>> {
    let mut text = "format = 1\nname = \"chain\"\n".to_owned();
    for node in 1..=count {
        writeln!(text, "[[inertia]]\nname = \"J{node}\"\ninertia = 0.5")?;
    }
    let damping = if forced { 10 } else { 0 };
    for node in 1..count {
        let ends = format!("from = \"J{node}\"\nto = \"J{}\"", node + 1);
        writeln!(
            text,
            "[[shaft]]\nname = \"k{node}\"\n{ends}\nstiffness = 2e5\ndamping = {damping}"
        )?;
    }
    if forced {
        let further = "{ order = 2, amplitude = 50 }, { order = 3, amplitude = 5 }, { order = 4, amplitude = 2 }";
        writeln!(
            text,
            "[[torque]]\nname = \"t\"\non = \"J1\"\namplitude = 200\nharmonics = [ {further} ]"
        )?;
    }
    let (line, _) =
        read_model(Source::new("chain.toml", text), &[]).map_err(|found| found.plain())?;
    Ok(line)
}
