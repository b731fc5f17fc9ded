//! What a report finds: what is safe, what is not, and by how much.

use halfshaft_results::{ReportResult, StaticResult};

use crate::account::statics;
use crate::reading::{Method, Reading};

mod critical;
mod jumps;
mod methods;
mod periodic;
mod reserve;
mod shock;
mod stability;
mod standing;
mod trust;
mod vibration;

/// What a finding says of the line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Standing {
    /// Something gives way or runs away.
    Unsafe,
    /// It holds with little room, or is not known.
    Watch,
    /// It could not be answered.
    Open,
    /// It holds.
    Safe,
    /// Nothing about safety: how good the numbers are.
    Note,
}

impl Standing {
    /// The word for it.
    pub(crate) fn word(self) -> &'static str {
        match self {
            Self::Unsafe => "not safe",
            Self::Watch => "watch",
            Self::Open => "open",
            Self::Safe => "safe",
            Self::Note => "note",
        }
    }

    /// The standing of a margin, capacity over load.
    fn of_margin(factor: f64) -> Self {
        match factor {
            f if f < 1.0 => Self::Unsafe,
            f if f < COMFORTABLE => Self::Watch,
            f if f.is_nan() => Self::Watch,
            _ => Self::Safe,
        }
    }
}

/// Margins below this are marked: capacity over load.
pub(crate) const COMFORTABLE: f64 = 1.25;

/// One finding.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Finding {
    pub(crate) standing: Standing,
    /// What it is about, in a word or two.
    pub(crate) topic: String,
    /// What was found, with numbers.
    pub(crate) text: String,
}

impl Finding {
    fn new(standing: Standing, topic: &str, text: String) -> Self {
        Self { standing, topic: topic.to_owned(), text }
    }

    /// The finding in one line.
    pub(crate) fn line(&self) -> String {
        format!("[{}] {}: {}", self.standing.word(), self.topic, self.text)
    }
}

/// All findings, the gravest first.
pub(crate) fn of(report: &ReportResult) -> Vec<Finding> {
    let mut found = Vec::new();
    if let Some(statics) = &report.statics {
        found.extend(standing::load(statics));
        found.extend(standing::gears(statics));
    }
    found.extend(stability::stability(report));
    found.extend(critical::critical(report));
    found.extend(shock::shock(report));
    found.extend(vibration::vibration(report));
    found.extend(jumps::of(report));
    found.extend(periodic::unsettled(report));
    found.extend(methods::methods(report));
    found.extend(trust::trust(report));
    found.extend(scope(report));
    found.sort_by_key(|finding| finding.standing);
    found
}

/// What the findings are about, where the model has more gears or modes than one.
fn scope(report: &ReportResult) -> Option<Finding> {
    let gears = report.statics.as_ref().is_some_and(|statics| statics.gears.len() > 1);
    let elastic = report
        .modes
        .as_ref()
        .map_or(0, |modes| modes.modes.iter().filter(|mode| mode.frequency > 0.0).count());
    let mut limits = Vec::new();
    if gears {
        limits.push("in the gear that the model is in".to_owned());
    }
    let best = report.best_resonance().map(Reading::of);
    match best {
        Some(reading) if reading.method != Method::Averaged => {
            // Other methods take all modes together, as far as the range goes.
            let range = reading.range().filter(|_| reading.x.is_speed());
            limits.extend(
                range.map(|(from, to)| {
                    format!("resonance and jumps {}", reading.x.between(from, to))
                }),
            );
        }
        _ if elastic > 1 => limits.push(format!("resonance and jumps for mode 1 of {elastic}")),
        _ => {}
    }
    let text = format!(
        "Stability, shock, resonance and jumps are judged one by one under the mean torques, {}.",
        limits.join(", ")
    );
    (!limits.is_empty()).then(|| Finding::new(Standing::Note, "Scope", text))
}

/// The findings in one sentence.
pub(crate) fn headline(findings: &[Finding]) -> String {
    let topics = |standing: Standing| {
        let of: Vec<String> = findings
            .iter()
            .filter(|finding| finding.standing == standing)
            .map(|finding| finding.topic.to_lowercase())
            .collect();
        crate::words::list(&of)
    };
    let mut sentences = Vec::new();
    let kinds = [
        ("Not safe", Standing::Unsafe),
        ("To watch", Standing::Watch),
        ("Safe", Standing::Safe),
        ("Not answered", Standing::Open),
    ];
    for (start, topics) in kinds.map(|(start, standing)| (start, topics(standing))) {
        if !topics.is_empty() {
            sentences.push(format!("{start}: {topics}."));
        }
    }
    sentences.join(" ")
}

/// Twist at which the law of a shaft gives way, in the direction of `load`, as a size.
fn limit_twist(statics: &StaticResult, shaft: &str, load: f64) -> Option<f64> {
    let capacity = statics.capacity.get(shaft)?;
    let limit = if load < 0.0 { capacity.negative } else { capacity.positive }?;
    Some(limit.twist.abs())
}

/// Twist of a shaft in the state in which the line runs.
fn rest_twist(statics: &StaticResult, shaft: &str) -> Option<f64> {
    statics::primary(statics)?.twist.get(shaft).copied()
}
