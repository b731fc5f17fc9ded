//! Whether the response jumps, and how far that is.

use halfshaft_results::{ModeScaling, ReportResult, ResonanceResult};

use super::reserve::{Threshold, damping, excitation};
use super::{COMFORTABLE, Finding, Standing, periodic};
use crate::account::jumps;
use crate::reading::{Method, Reading};
use crate::words::{column_words, number, percent, plain, quantity};

/// The jumps, or the distance to them in excitation and in damping.
pub(super) fn of(report: &ReportResult) -> Option<Finding> {
    let result = report.best_resonance()?;
    if let Some(finding) = gives_way_first(report, result) {
        return Some(finding);
    }
    if !result.jumps.is_empty() {
        let mut sentences = vec!["The response jumps.".to_owned()];
        sentences.extend(jumps::told(result));
        sentences.extend(way_out(report, result));
        let standing = match one_harmonic_only(report, result) {
            Some(remark) => {
                sentences.push(remark);
                Standing::Open
            }
            None => Standing::Unsafe,
        };
        return Some(Finding::new(standing, "Jumps", sentences.join(" ")));
    }
    if result.scaling.is_empty() {
        return Some(periodic::no_jump(report, result));
    }
    let nearest = result.scaling.iter().min_by(|a, b| factor(a).total_cmp(&factor(b)))?;
    let grows = factor(nearest);
    if grows.is_infinite() {
        let text = "The response cannot jump, whatever the excitation.".to_owned();
        return Some(Finding::new(Standing::Safe, "Jumps", text));
    }
    let text = format!(
        "No jump: the excitation would have to be {}\u{a0}times larger{}.",
        number(grows, 4),
        less_damping(report, &nearest.shaft)
    );
    // A threshold below 1 without a jump in the range shown lies outside of it.
    let standing = if grows < COMFORTABLE { Standing::Watch } else { Standing::Safe };
    Some(Finding::new(standing, "Jumps", text))
}

/// What is to be said of jumps that rest on one harmonic where harmonic balance was asked and failed.
fn one_harmonic_only(report: &ReportResult, result: &ResonanceResult) -> Option<String> {
    let failed = report.missing.iter().any(|missing| missing.section == "resonance");
    let method = Reading::of(result).method;
    (failed && method != Method::HarmonicBalance).then(|| {
        "That rests on one harmonic alone; harmonic balance, which would tell for sure, has no answer."
            .to_owned()
    })
}

/// How far the damping of a shaft would have to fall for a jump, to follow in a sentence.
pub(super) fn less_damping(report: &ReportResult, shaft: &str) -> String {
    let Some(threshold) = damping(report, shaft).filter(|one| one.own > one.begins) else {
        return String::new();
    };
    let Threshold { plane, own, begins } = threshold;
    format!(
        ", or the damping of the {} to fall from {} to {} ({})",
        plain(shaft),
        number(own, 4),
        quantity(begins, 4, &plain(&plane.parameter_unit)),
        percent(threshold.factor(), 3)
    )
}

/// Where the jumps lie past the limit of the shaft's law.
fn gives_way_first(report: &ReportResult, result: &ResonanceResult) -> Option<Finding> {
    let first = result.jumps.iter().min_by(|a, b| a.before.total_cmp(&b.before))?;
    let shaft = column_words(&first.channel)?.owner;
    let room = super::vibration::room(report.statics.as_ref(), shaft)?;
    let text = format!(
        "Before it could jump the {} gives way: the jumps begin at a swing of ±{}, and only {} are \
         left to the limit of its law.",
        plain(shaft),
        quantity(first.before, 4, "rad"),
        quantity(room, 4, "rad")
    );
    (first.before > room).then(|| Finding::new(Standing::Unsafe, "Jumps", text))
}

fn factor(scaling: &ModeScaling) -> f64 {
    scaling.fold_threshold_factor.filter(|factor| !factor.is_nan()).unwrap_or(f64::INFINITY)
}

/// What would end the jumps.
fn way_out(report: &ReportResult, result: &ResonanceResult) -> Option<String> {
    let mut ways = Vec::new();
    let scaled = || result.scaling.first()?.fold_threshold_factor;
    let less = match result.scaling.is_empty() {
        true => excitation(report).map(|threshold| threshold.factor()),
        false => scaled(),
    };
    if let Some(factor) = less.filter(|factor| *factor < 1.0) {
        ways.push(format!("an excitation below {} of this one", percent(factor, 4)));
    }
    let channel = result.leading_channel()?;
    let shaft = column_words(&channel)?.owner;
    if let Some(threshold) = damping(report, shaft).filter(|one| one.own < one.begins) {
        let factor = number(threshold.factor(), 4);
        ways.push(format!("{factor}\u{a0}times the damping of the {}", plain(shaft)));
    }
    (!ways.is_empty()).then(|| format!("It ends with {}.", ways.join(", or with ")))
}
