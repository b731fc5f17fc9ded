//! The speed at which a report asks which start leads where.

use halfshaft_results::Branch;

/// Speeds at which responses are counted.
const SPEEDS: usize = 400;

/// The middle of the widest range of speeds with more than one stable response, rad/s.
pub(super) fn speed(branches: &[Branch]) -> Option<f64> {
    let all = || branches.iter().flat_map(|branch| branch.values("frequency"));
    let low = all().copied().fold(f64::INFINITY, f64::min);
    let high = all().copied().fold(f64::NEG_INFINITY, f64::max);
    let at = |k: usize| low + (high - low) * (k as f64 + 0.5) / SPEEDS as f64;
    let (mut widest, mut run) = ((0, 0), 0);
    for k in 0..SPEEDS {
        run = if stable(branches, at(k)) > 1 { run + 1 } else { 0 };
        if run > widest.1 {
            widest = (k, run);
        }
    }
    let (last, count) = widest;
    // Between the first and the last speed of the range.
    (count > 0).then(|| f64::midpoint(at(last + 1 - count), at(last)))
}

/// Stable responses at a speed.
fn stable(branches: &[Branch], speed: f64) -> usize {
    branches.iter().map(|branch| passes(branch, speed)).sum()
}

/// How often a branch goes through a speed as a stable response.
fn passes(branch: &Branch, speed: f64) -> usize {
    let (speeds, stable) = (branch.values("frequency"), branch.values("stable"));
    let parts = speeds.windows(2).zip(stable.windows(2));
    // A speed that two stretches share counts for the one that it begins.
    let through = |pair: &[f64]| (pair[0] <= speed) != (pair[1] <= speed);
    parts.filter(|(pair, both)| through(pair) && both.iter().all(|value| *value == 1.0)).count()
}

#[cfg(test)]
mod tests {
    use super::speed;
    use halfshaft_results::{Branch, Column};

    fn branch(speeds: &[f64], stable: &[f64]) -> Branch {
        let column = |name: &str, values: &[f64]| Column::new(name, "1", values.to_vec());
        let columns = vec![column("frequency", speeds), column("stable", stable)];
        Branch::plain(columns, Vec::new())
    }

    /// Oracle: by hand: between the folds at 2 and 3 two of the three responses are stable.
    #[test]
    fn between_two_folds_two_responses_are_stable() {
        let s = [0.0, 1.0, 2.0, 3.0, 3.0, 2.5, 2.0, 2.0, 3.0, 4.0, 5.0];
        let stable = [1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0];
        let found = speed(&[branch(&s, &stable)]);
        assert!(found.is_some_and(|found| (found - 2.5).abs() < 0.02), "{found:?}");
        assert_eq!(speed(&[branch(&[0.0, 1.0], &[1.0, 1.0])]), None);
        assert_eq!(speed(&[]), None);
    }
}
