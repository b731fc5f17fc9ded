//! Which methods have no answer, where others have one.

use halfshaft_results::{MissingSection, ReportResult};

use super::{Finding, Standing};
use crate::account::check::minus;
use crate::reading::{Method, Reading};
use crate::words::{capital, plain};

/// The method that a section of the report is by; `None` for other sections.
fn method(section: &str) -> Option<Method> {
    match section {
        "resonance" => Some(Method::HarmonicBalance),
        "first-harmonic" => Some(Method::FirstHarmonic),
        "closed-form" => Some(Method::Averaged),
        _ => None,
    }
}

/// Whether a section is a method of the resonance in whose place another one stands.
pub(super) fn replaced(report: &ReportResult, missing: &MissingSection) -> bool {
    method(&missing.section).is_some() && report.best_resonance().is_some()
}

/// The methods that have no answer, and which one is spoken of instead.
pub(super) fn methods(report: &ReportResult) -> Option<Finding> {
    let best = Reading::of(report.best_resonance()?).method;
    let absent: Vec<String> = report
        .missing
        .iter()
        .filter_map(|missing| {
            let reason = minus(&plain(&missing.reason));
            let method = method(&missing.section)?.with_article();
            Some(match reason.split_once("does not fit this line: ") {
                Some((_, why)) => format!("{method} does not fit this line: {why}"),
                None => format!("{method} gives no answer: {reason}"),
            })
        })
        .collect();
    if absent.is_empty() {
        return None;
    }
    let leads = best == Method::HarmonicBalance;
    let spoken = if leads {
        String::new()
    } else {
        format!(" What is said of resonance and jumps is by {}.", best.with_article())
    };
    let text = format!("{}.{spoken}", capital(&absent.join("; ")));
    let standing = if leads { Standing::Note } else { Standing::Watch };
    Some(Finding::new(standing, "Methods", text))
}
