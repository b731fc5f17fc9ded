//! Times many forced Duffing oscillators, as lines, for the comparison in `bench/peers/time`.
//!
//! `ensemble_times COUNT PERIODS TOLERANCE [lanes=N] [threads=N] [degree=N] [instructions=avx2] [out=FILE]`
//!
//! The oscillators are those of `bench/peers/time/cases.py`. Prints one line: trajectories per second of
//! processor time and of the clock, mean number of steps. The states at the ends go to the file, as
//! little-endian numbers, displacement and rate by turns.
#![allow(clippy::print_stdout, clippy::print_stderr)]

use std::f64::consts::TAU;
use std::time::Instant;

use halfshaft_dynamics::lanes::LaneLine;
use halfshaft_dynamics::{Active, EquationsOfMotion};
use halfshaft_model::{Source, read_model};
use halfshaft_numerics::ensemble::{Instructions, Settings, Start, Starts, by_series};
use halfshaft_numerics::observer::Silent;

/// `x'' + 679 x - 0.679 x³ + 0.0952 x' = 15 cos(W t)`.
const LINE: &str = r#"
format = 1
name = "duffing"
[[inertia]]
name = "j"
inertia = 1
[[shaft]]
name = "s"
from = "j"
to = "ground"
stiffness = 679
cubic = -0.679
damping = 0.0952
[[torque]]
name = "t"
on = "j"
amplitude = 15
"#;

/// Speed and start of oscillator `index` of `count`: number 0 is the one whose end is published.
fn oscillator(index: usize, count: usize) -> (f64, f64) {
    if index == 0 {
        return (26.1, 0.1);
    }
    let part = index as f64 / count as f64;
    (24.0 + 4.0 * part, (17.0 * part).sin())
}

fn starts(line: &LaneLine, equations: &EquationsOfMotion, count: usize, periods: f64) -> Starts {
    let start = |index: usize| {
        let (speed, twist) = oscillator(index, count);
        let active = Active::periodic(speed);
        let parameters = line.values(equations, &active, 0.0).unwrap_or_default();
        Start { time: 0.0, state: vec![twist, 0.0], parameters, end: periods * TAU / speed }
    };
    Starts((0..count).map(start).collect())
}

/// Seconds of processor time of the threads that have ended and of this one; zero where the system does
/// not tell.
fn processor_seconds() -> f64 {
    let read = |path: &str| std::fs::read_to_string(path).ok();
    let stat = read("/proc/self/schedstat");
    let first =
        stat.as_deref().and_then(|text| text.split_whitespace().next()?.parse::<f64>().ok());
    first.unwrap_or(0.0) * 1e-9
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |at: usize| -> Result<f64, Box<dyn std::error::Error>> {
        Ok(arguments.get(at).ok_or("COUNT PERIODS TOLERANCE are needed")?.parse()?)
    };
    let option = |name: &str| arguments.iter().find_map(|text| text.strip_prefix(name));
    let (count, periods) = (number(0)? as usize, number(1)?);
    let mut settings = Settings { threads: 1, ..Settings::with_tolerance(number(2)?) };
    settings.lanes = option("lanes=").map(str::parse).transpose()?;
    settings.threads = option("threads=").map_or(Ok(1), str::parse)?;
    settings.degree = option("degree=").map_or(Ok(settings.degree), str::parse)?;
    settings.instructions = option("instructions=").map(|name| match name {
        "avx2" => Instructions::Avx2,
        "avx512" => Instructions::Avx512,
        _ => Instructions::Plain,
    });
    let (line, _) = read_model(Source::new("duffing.toml", LINE), &[])
        .map_err(|errors| errors.plain().to_string())?;
    let equations = EquationsOfMotion::new(&line)?;
    let line = LaneLine::new(&equations);
    let starts = starts(&line, &equations, count, periods);
    let (clock, processor) = (Instant::now(), processor_seconds());
    let found = by_series(&line, &starts, count, &settings, &Silent)?;
    let (clock, processor) = (clock.elapsed().as_secs_f64(), processor_seconds() - processor);
    let steps: usize = found.iter().flatten().map(|found| found.steps).sum();
    println!(
        "{{\"per_processor_second\": {}, \"per_second\": {}, \"steps\": {}}}",
        count as f64 / processor,
        count as f64 / clock,
        steps as f64 / count as f64
    );
    if let Some(path) = option("out=") {
        let bytes = found.iter().flatten().flat_map(|found| &found.state);
        std::fs::write(path, bytes.flat_map(|value| value.to_le_bytes()).collect::<Vec<u8>>())?;
    }
    Ok(())
}
