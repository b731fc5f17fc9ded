//! Ranges of speeds over which no branch is stable.

use super::explorer::ExactBranch;

/// Speeds at which it is let run where no branch is stable.
const GAP_SPEEDS: usize = 9;
/// Part of the range below which a gap is none.
const NARROW: f64 = 1e-3;

/// Speeds within a gap.
pub(super) fn inside((from, to): (f64, f64)) -> Vec<f64> {
    let at = |k: usize| from + (to - from) * (k as f64 + 0.5) / GAP_SPEEDS as f64;
    (0..GAP_SPEEDS).map(at).collect()
}

/// Ranges of speeds over which no branch is stable, apart from narrow ones.
pub(super) fn gaps(branches: &[ExactBranch], (low, high): (f64, f64)) -> Vec<(f64, f64)> {
    let mut covered: Vec<(f64, f64)> = Vec::new();
    for branch in branches {
        for (at, pair) in branch.points.windows(2).enumerate() {
            let stable = [&pair[0], &pair[1]].map(|point| point.stability.is_stable());
            let special = branch.specials.iter().find(|special| special.after == at);
            let between = special.map_or(pair[1].p(), |special| special.point.p());
            let (from, to) = match stable {
                [true, true] => (pair[0].p(), pair[1].p()),
                [true, false] => (pair[0].p(), between),
                [false, true] => (between, pair[1].p()),
                [false, false] => continue,
            };
            covered.push((from.min(to), from.max(to)));
        }
    }
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
