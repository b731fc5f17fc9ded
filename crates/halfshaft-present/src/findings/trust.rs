//! How good the numbers are.

use halfshaft_results::ReportResult;

use super::{Finding, Standing};
use crate::account::{methods, verification};
use crate::words::{counted, number, percent, quantity};

/// A closed form within this of integration, at the largest response, is good for design.
const GOOD: f64 = 0.05;
/// Speeds within this part of that of the largest response count as beside it.
const NEAR: f64 = 0.1;

/// Closed forms against integration, and the energy balance.
pub(super) fn trust(report: &ReportResult) -> Vec<Finding> {
    let mut found = Vec::new();
    found.extend(balance(report));
    found.extend(closed_form(report));
    found.extend(orders(report));
    found.extend(energy(report));
    found
}

/// Harmonic balance agrees with integration to this at least, or something is wrong.
const EXACT: f64 = 1e-4;

/// Harmonic balance against integration.
fn balance(report: &ReportResult) -> Option<Finding> {
    let points = &report.resonance.as_ref()?.verification;
    let (top, worst) = verification::best_and_worst(points)?;
    let multipliers = verification::multiplier_difference(points)
        .map_or_else(String::new, |apart| {
            format!(", and the largest Floquet multipliers to {}", number(apart, 2))
        });
    let disagree = points.iter().filter(|p| p.predicted_stable != p.integrated_stable).count();
    let stability = match disagree {
        0 => "Stability agrees at all of them.".to_owned(),
        count => format!("Stability disagrees at {}.", counted(count, "of them", "of them")),
    };
    let text = format!(
        "Harmonic balance agrees with integration of the full equations at {} to {} at the largest \
         and to {} at the worst{multipliers}. {stability}",
        counted(points.len(), "response", "responses"),
        percent(top.relative_difference.abs(), 2),
        percent(worst.relative_difference.abs(), 2),
    );
    let good = worst.relative_difference.abs() <= EXACT && disagree == 0;
    let standing = if good { Standing::Note } else { Standing::Watch };
    Some(Finding::new(standing, "Agreement", text))
}

fn closed_form(report: &ReportResult) -> Option<Finding> {
    let points = &report.closed_form.as_ref()?.verification;
    let (top, worst) = verification::best_and_worst(points)?;
    let difference = top.relative_difference.abs();
    let digits = if difference > 0.0 { -difference.log10() } else { 16.0 };
    let apart = (worst.frequency / top.frequency - 1.0).abs();
    let off = if apart > 0.15 { ", off the resonance, where averaging is rough" } else { "" };
    // Two curves that cross agree at one point; what lies beside it tells more.
    let beside = points
        .iter()
        .filter(|point| (point.frequency / top.frequency - 1.0).abs() <= NEAR)
        .map(|point| point.relative_difference.abs())
        .fold(0.0, f64::max);
    let near = if beside > difference {
        format!(", within {} of that speed to {}", percent(NEAR, 2), percent(beside, 2))
    } else {
        String::new()
    };
    let text = format!(
        "At its largest response the closed form agrees with integration of the full equations \
         to {} digits ({}){near}. The largest difference in the range is {}, at {}{off}.",
        number(digits.clamp(0.0, 16.0), 2),
        percent(difference, 2),
        percent(worst.relative_difference.abs(), 2),
        quantity(worst.frequency, 4, "rad/s")
    );
    let same = points.iter().all(|point| point.predicted_stable == point.integrated_stable);
    let rough = !(difference <= GOOD && beside <= 2.0 * GOOD && same);
    // Where harmonic balance leads, nothing rests on the closed form.
    let standing =
        if !rough || report.resonance.is_some() { Standing::Note } else { Standing::Watch };
    let topic = if report.resonance.is_some() { "Closed form" } else { "Agreement" };
    Some(Finding::new(standing, topic, text))
}

fn orders(report: &ReportResult) -> Option<Finding> {
    let rows = &report.shock.as_ref()?.shock.as_ref()?.comparison;
    let (first, second) = methods::orders(rows).into_iter().next()?;
    let text = methods::second_against_first(first, second)?;
    Some(Finding::new(Standing::Note, "Closed form of the shock", text))
}

fn energy(report: &ReportResult) -> Option<Finding> {
    let balance = report.shock.as_ref()?.metrics.energy_balance.as_ref()?;
    let text = format!(
        "The energy balance of the shock closes to {} of the energy turned over.",
        number(balance.relative_residual.abs(), 2)
    );
    Some(Finding::new(Standing::Note, "Energy", text))
}
