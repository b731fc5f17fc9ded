//! Ranges of speeds over which no branch is stable.

use super::super::gaps::{stretch, uncovered};
use super::explorer::ExactBranch;
use super::seeds::MOST_MULTIPLE;

/// Speeds at which it is let run where no branch is stable.
const GAP_SPEEDS: usize = 9;

/// Gaps that are told one by one.
const TOLD: usize = 6;

/// What to say of ranges over which no branch is stable.
pub(super) fn told(gaps: &[(f64, f64)]) -> Option<String> {
    if gaps.is_empty() {
        return None;
    }
    let range = |(from, to): &(f64, f64)| format!("{from:.6} and {to:.6}");
    let ranges: Vec<String> = gaps.iter().take(TOLD).map(range).collect();
    let more = gaps.len().saturating_sub(TOLD);
    let more = if more > 0 { format!(" and in {more} more ranges") } else { String::new() };
    Some(format!(
        "no stable periodic response was found between {} rad/s{more}: the motion does not repeat there \
         within {MOST_MULTIPLE} periods, or does so only after very long",
        ranges.join(", between ")
    ))
}

/// Speeds within a gap.
pub(super) fn inside((from, to): (f64, f64)) -> Vec<f64> {
    let at = |k: usize| from + (to - from) * (k as f64 + 0.5) / GAP_SPEEDS as f64;
    (0..GAP_SPEEDS).map(at).collect()
}

/// Ranges of speeds over which no branch is stable, apart from narrow ones.
pub(super) fn gaps(branches: &[ExactBranch], range: (f64, f64)) -> Vec<(f64, f64)> {
    let covered = branches.iter().flat_map(|branch| {
        branch.points.windows(2).enumerate().filter_map(|(at, pair)| {
            let special = branch.specials.iter().find(|special| special.after == at);
            let between = special.map(|special| special.point.p());
            let stable = |point: &super::point::Point| point.stability.is_stable();
            stretch((pair[0].p(), stable(&pair[0])), (pair[1].p(), stable(&pair[1])), between)
        })
    });
    uncovered(covered.collect(), range)
}
