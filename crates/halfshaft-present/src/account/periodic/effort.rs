//! What the answer cost and how exact it is.

use crate::reading::{Method, Reading, bounds};
use crate::words::{capital, counted, number};

/// Harmonics, what they leave out, and the effort, as sentences.
pub(super) fn told(reading: &Reading<'_>) -> String {
    let mut sentences = Vec::new();
    sentences.extend(harmonics(reading));
    sentences.extend(effort(reading));
    sentences.join(" ")
}

fn harmonics(reading: &Reading<'_>) -> Option<String> {
    if reading.method == Method::FirstHarmonic {
        return Some("One harmonic of the response was kept.".to_owned());
    }
    let all = |name: &str| {
        let branches = reading.result.branches.iter();
        bounds(branches.flat_map(|branch| branch.values(name)).copied())
    };
    let (least, most) = all("harmonics")?;
    let kept = if least < most {
        format!("{} to {}", number(least, 4), number(most, 4))
    } else {
        number(most, 4)
    };
    let noun = if most == 1.0 { "harmonic" } else { "harmonics" };
    let left = all("truncation").map_or_else(String::new, |(_, worst)| {
        format!("; those left out are at most {} of the waveform, by estimate", number(worst, 2))
    });
    Some(format!("Harmonic balance kept {kept} {noun} of the response{left}."))
}

fn effort(reading: &Reading<'_>) -> Option<String> {
    let effort = reading.result.effort?;
    Some(capital(&format!(
        "{} in {}, by {} with {} of Newton's method, from {}.",
        counted(effort.samples, "sample", "samples"),
        counted(reading.result.branches.len(), "response", "responses"),
        counted(effort.steps, "step", "steps"),
        counted(effort.iterations, "iteration", "iterations"),
        counted(effort.seeds, "starting point", "starting points"),
    )))
}
