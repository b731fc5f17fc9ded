//! Ranges of speeds over which no branch is stable.

use super::explorer::ExactBranch;
use super::seeds::MOST_MULTIPLE;

/// Speeds at which it is let run where no branch is stable.
const GAP_SPEEDS: usize = 9;
/// Part of the range below which a gap is none.
const NARROW: f64 = 1e-3;

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

/// The stable part of the stretch between two neighbours of a branch, given as parameter and
/// stability, with the special point between them where there is one.
pub(in super::super) fn stretch(
    from: (f64, bool),
    to: (f64, bool),
    special: Option<f64>,
) -> Option<(f64, f64)> {
    let (low, high) = match (from.1, to.1) {
        (true, true) => (from.0, to.0),
        (true, false) => (from.0, special.unwrap_or(to.0)),
        (false, true) => (special.unwrap_or(to.0), to.0),
        (false, false) => return None,
    };
    Some((low.min(high), low.max(high)))
}

/// What of a range no stretch covers, apart from narrow parts.
pub(in super::super) fn uncovered(
    mut covered: Vec<(f64, f64)>,
    (low, high): (f64, f64),
) -> Vec<(f64, f64)> {
    covered.sort_by(|a, b| a.0.total_cmp(&b.0));
    let narrow = NARROW * (high - low);
    let mut gaps = Vec::new();
    let mut reached = low;
    for (from, to) in covered {
        if from > reached + narrow {
            gaps.push((reached, from));
        }
        reached = reached.max(to);
    }
    if high > reached + narrow {
        gaps.push((reached, high));
    }
    gaps
}

#[cfg(test)]
mod tests {
    use super::*;

    // Source: by hand.
    #[test]
    fn what_no_stretch_covers_is_left() {
        let covered = vec![(2.0, 3.0), (0.0, 1.0), (2.5, 2.7), (3.0005, 4.0)];
        assert_eq!(uncovered(covered, (0.0, 5.0)), [(1.0, 2.0), (4.0, 5.0)]);
        assert_eq!(uncovered(Vec::new(), (1.0, 2.0)), [(1.0, 2.0)]);
        assert_eq!(stretch((1.0, true), (2.0, false), Some(1.5)), Some((1.0, 1.5)));
        assert_eq!(stretch((1.0, false), (0.0, true), None), Some((0.0, 0.0)));
        assert_eq!(stretch((1.0, false), (2.0, false), None), None);
    }
}
