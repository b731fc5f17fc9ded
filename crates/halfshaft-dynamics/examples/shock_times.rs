//! Times single shock responses, for the comparison in `bench/peers/time`.
//!
//! `shock_times COUNT TOLERANCE [DEGREE]`
//!
//! The published shock equation of the two-mass driveline as a line of one inertia: from 1 rad at rest over
//! 5 s, one motion after the other, each for itself and on one lane. Prints one line: microseconds a response,
//! its steps, and twist and rate at the end.
#![allow(clippy::print_stdout, clippy::print_stderr)]

use std::time::Instant;

use halfshaft_dynamics::lanes::LaneLine;
use halfshaft_dynamics::{Active, EquationsOfMotion};
use halfshaft_model::{Source, read_model};
use halfshaft_numerics::ensemble::{Settings, Start, Starts, by_series};
use halfshaft_numerics::observer::Silent;

/// `x'' + 1.102941176470588 x' + 78.67647058823529 x - 7.867647058823529 x³ = 0`.
const LINE: &str = r#"
format = 1
name = "shock"
[[inertia]]
name = "load"
inertia = 81.6
[[shaft]]
name = "half-shaft"
from = "load"
to = "ground"
stiffness = 6420
cubic = -642
damping = 90
"#;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [count, tolerance, more @ ..] = arguments.as_slice() else {
        return Err("COUNT TOLERANCE are needed".into());
    };
    let (count, tolerance): (usize, f64) = (count.parse()?, tolerance.parse()?);
    let mut settings = Settings { threads: 1, ..Settings::with_tolerance(tolerance) };
    settings.lanes = Some(1);
    if let Some(degree) = more.first() {
        settings.degree = degree.parse()?;
    }
    let (line, _) = read_model(Source::new("shock.toml", LINE), &[])
        .map_err(|errors| errors.plain().to_string())?;
    let equations = EquationsOfMotion::new(&line)?;
    let line = LaneLine::new(&equations);
    let active = Active::shock();
    let parameters = line.values(&equations, &active, 0.0).unwrap_or_default();
    let start = Start { time: 0.0, state: vec![1.0, 0.0], parameters, end: 5.0 };
    let starts = Starts(vec![start]);
    let mut times: Vec<f64> = Vec::with_capacity(count);
    let mut last = None;
    for _ in 0..count {
        let clock = Instant::now();
        let found = by_series(&line, &starts, 1, &settings, &Silent)?;
        times.push(clock.elapsed().as_secs_f64() * 1e6);
        last = found.into_iter().flatten().next();
    }
    times.sort_by(f64::total_cmp);
    let last = last.ok_or("no response was computed")?;
    println!(
        "{{\"microseconds\": {}, \"steps\": {}, \"twist\": {:?}, \"rate\": {:?}}}",
        times[times.len() / 2],
        last.steps,
        last.state[0],
        last.state[1]
    );
    Ok(())
}
