//! How far stable responses are from losing their stability.

use halfshaft_results::SpecialKind;

use crate::reading::{Reading, Sample};
use crate::words::{counted, number, percent};

/// The stability of the responses as sentences.
pub(super) fn told(reading: &Reading<'_>) -> Vec<String> {
    let samples = reading.samples();
    if samples.is_empty() || !knows(reading) {
        return Vec::new();
    }
    let unstable = samples.iter().filter(|sample| !sample.stable).count();
    let mut sentences = Vec::new();
    sentences.push(if unstable == 0 {
        "Every response that was found is stable.".to_owned()
    } else if unstable == samples.len() {
        "No response that was found is stable.".to_owned()
    } else {
        lost(reading)
    });
    sentences.extend(margin(&samples));
    sentences
}

fn knows(reading: &Reading<'_>) -> bool {
    reading.result.branches.iter().any(|branch| !branch.values("stable").is_empty())
}

/// How stability is lost, by the kinds of special points.
fn lost(reading: &Reading<'_>) -> String {
    let count = |kind: SpecialKind| {
        let points = reading.result.branches.iter().flat_map(|branch| &branch.special_points);
        points.filter(|point| point.kind == kind).count()
    };
    let kinds = [
        (SpecialKind::Fold, "fold", "folds"),
        (SpecialKind::PeriodDoubling, "period doubling", "period doublings"),
        (SpecialKind::NeimarkSacker, "Neimark-Sacker point", "Neimark-Sacker points"),
        (SpecialKind::BranchPoint, "branch point", "branch points"),
    ];
    let ways: Vec<String> = kinds
        .into_iter()
        .map(|(kind, one, many)| (count(kind), one, many))
        .filter(|(count, ..)| *count > 0)
        .map(|(count, one, many)| counted(count, one, many))
        .collect();
    if ways.is_empty() {
        "Some of the responses are not stable.".to_owned()
    } else {
        format!("Stability changes at {}.", crate::words::list(&ways))
    }
}

/// How fast disturbances die out at the largest stable response, and where they do so slowest.
fn margin(samples: &[Sample]) -> Option<String> {
    let stable = || samples.iter().filter(|sample| sample.stable && sample.multiplier.is_some());
    let top = stable().max_by(|a, b| a.swing.total_cmp(&b.swing))?;
    let worst = stable().max_by(|a, b| size(a).total_cmp(&size(b)))?;
    let at_top = format!(
        "At the largest stable response the largest Floquet multiplier is {}: over one period a \
         disturbance falls to {}",
        number(size(top), 4),
        percent(size(top), 3)
    );
    // Towards a special point it grows to 1, which says nothing new.
    let all_stable = samples.iter().all(|sample| sample.stable);
    Some(if all_stable && size(worst) > size(top) {
        format!("{at_top}; nowhere is it larger than {}.", number(size(worst), 4))
    } else {
        format!("{at_top}.")
    })
}

fn size(sample: &Sample) -> f64 {
    sample.multiplier.unwrap_or(f64::NAN)
}
