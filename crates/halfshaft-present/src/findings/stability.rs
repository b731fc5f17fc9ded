//! Whether small disturbances die out, and what could not be answered.

use halfshaft_results::{MissingSection, ReportResult};

use super::methods::replaced;
use super::{Finding, Standing};
use crate::account::{check::minus, head, modes};
use crate::words::{capital, frequency_words, list, percent, plain};

/// Stability of the running state, and sections without an answer.
pub(super) fn stability(report: &ReportResult) -> Vec<Finding> {
    let mut found = Vec::new();
    if let Some(result) = &report.modes {
        found.extend(modes::elastic(result).min_by(|a, b| damping(a).total_cmp(&damping(b))).map(
            |mode| {
                let text = format!(
                    "Small disturbances {}: the least damped mode, at {}, has {} of critical damping.",
                    if mode.damping_ratio > 0.0 { "ring and die out" } else { "do not die out" },
                    frequency_words(mode.frequency),
                    percent(mode.damping_ratio, 3)
                );
                let stable = result.equilibrium.stable && mode.damping_ratio > 0.0;
                let standing = if stable { Standing::Safe } else { Standing::Watch };
                Finding::new(standing, "Stability at rest", text)
            },
        ));
    }
    found.extend(open(report));
    found
}

/// Sections without an answer, those of one reason together.
fn open(report: &ReportResult) -> Vec<Finding> {
    let mut groups: Vec<(&MissingSection, Vec<String>)> = Vec::new();
    for missing in report.missing.iter().filter(|missing| !replaced(report, missing)) {
        let same = |group: &&mut (&MissingSection, Vec<String>)| {
            group.0.reason == missing.reason && group.0.advice == missing.advice
        };
        let title = head::title(&missing.section);
        match groups.iter_mut().find(same) {
            Some((_, titles)) => titles.push(title.to_lowercase()),
            None => groups.push((missing, vec![title])),
        }
    }
    let finding = |(missing, titles): (&MissingSection, Vec<String>)| {
        let reason = minus(&plain(&missing.reason));
        let advice = missing
            .advice
            .as_ref()
            .map_or_else(String::new, |advice| format!(" To get an answer: {}.", plain(advice)));
        let text = capital(&format!("{reason}.{advice}"));
        Finding::new(Standing::Open, &list(&titles), text)
    };
    groups.into_iter().map(finding).collect()
}

fn damping(mode: &halfshaft_results::Mode) -> f64 {
    if mode.damping_ratio.is_nan() { f64::INFINITY } else { mode.damping_ratio }
}
