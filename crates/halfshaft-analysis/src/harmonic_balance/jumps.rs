//! Where slow sweeps jump, and to what.

use halfshaft_numerics::harmonics::HarmonicSet;
use halfshaft_results::{JumpSpeeds, SpecialKind};

use super::answer::{Setting, reference};
use super::branches::TracedBranch;
use super::special::Special;
use super::tracer::{Sample, refit};

/// Jumps at the folds where a stable stretch of a branch ends.
pub(super) fn jumps(setting: &Setting, branches: &[TracedBranch]) -> Vec<JumpSpeeds> {
    let mut jumps = Vec::new();
    for branch in branches {
        let folds = branch.specials.iter().filter(|special| special.kind == SpecialKind::Fold);
        for fold in folds {
            jumps.extend(jump(setting, branches, branch, fold));
        }
    }
    jumps.sort_by(|a, b| a.frequency.total_cmp(&b.frequency));
    jumps
}

/// Samples to either side of a fold that are asked for their stability, beside the nearest.
const FARTHEST: usize = 2;

fn jump(
    setting: &Setting,
    branches: &[TracedBranch],
    branch: &TracedBranch,
    fold: &Special,
) -> Option<JumpSpeeds> {
    let end = stable_side(branch, fold)?;
    // The stable side lies at lower speeds than the fold: sweeping up meets its end.
    let sweep = if end.p < fold.sample.p { "up" } else { "down" };
    let name = reference(setting);
    let index = setting.line.equations.connection(name)?;
    let before = first_harmonic(setting, &fold.sample, branch, index);
    let after = others(branches, fold, branch)
        .map(|(sample, other)| first_harmonic(setting, &sample, other, index))
        .min_by(|a, b| (a - before).abs().total_cmp(&(b - before).abs()));
    Some(JumpSpeeds {
        sweep: sweep.to_owned(),
        frequency: fold.sample.p,
        rpm: fold.sample.p * 30.0 / std::f64::consts::PI,
        channel: format!("{name}.twist"),
        before,
        after,
    })
}

/// The sample on the stable side of a fold, where one side is stable and the other is not.
///
/// Multipliers that are not those of the exact orbit (with few harmonics, by Hill's method) may tell the
/// change a little beside the fold: then samples somewhat further away decide, as long as no other
/// special point lies before them.
fn stable_side<'b>(branch: &'b TracedBranch, fold: &Special) -> Option<&'b Sample> {
    let stable =
        |at: usize| branch.stability.get(at).is_some_and(super::stability::Stability::is_stable);
    for away in 0..=FARTHEST {
        let (before, behind) = (fold.after.checked_sub(away)?, fold.after + 1 + away);
        let others = branch.specials.iter().filter(|other| !std::ptr::eq(*other, fold));
        if away > 0 && others.into_iter().any(|other| (before..behind).contains(&other.after)) {
            return None;
        }
        match (stable(before), stable(behind)) {
            (true, false) => return branch.samples.get(before),
            (false, true) => return branch.samples.get(behind),
            _ => {}
        }
    }
    None
}

/// Stable responses at a fold's speed on other stretches of the branches, interpolated.
fn others<'b>(
    branches: &'b [TracedBranch],
    fold: &'b Special,
    own: &'b TracedBranch,
) -> impl Iterator<Item = (Sample, &'b TracedBranch)> {
    let p = fold.sample.p;
    branches.iter().flat_map(move |branch| {
        let pairs = branch.samples.windows(2).enumerate();
        pairs.filter_map(move |(at, pair)| {
            let is_own = std::ptr::eq(branch, own) && at.abs_diff(fold.after) <= 1;
            let spans = (pair[0].p - p) * (pair[1].p - p) <= 0.0 && pair[0].p != pair[1].p;
            let stable = branch.stable_between(at).is_some_and(|(low, high)| low <= p && p <= high);
            (spans && stable && !is_own).then(|| (mixed(&pair[0], &pair[1], p), branch))
        })
    })
}

fn mixed(a: &Sample, b: &Sample, p: f64) -> Sample {
    let part = (p - a.p) / (b.p - a.p);
    let other = refit(&b.set, &a.set, 1, &b.u);
    let mut sample = a.clone();
    sample.u.iter_mut().zip(other).for_each(|(x, y)| *x += part * (y - *x));
    sample.p = p;
    sample
}

/// First harmonic of the twist of a nonlinear (or the first) connection.
fn first_harmonic(setting: &Setting, sample: &Sample, branch: &TracedBranch, index: usize) -> f64 {
    let set: &HarmonicSet = &sample.set;
    let m = set.coefficients();
    if let Some(twist) = setting.line.twists.iter().find(|twist| twist.connection == index) {
        let mut x = vec![0.0; m];
        for (node, factor) in &twist.parts {
            let source = &sample.u[node * m..(node + 1) * m];
            x.iter_mut().zip(source).for_each(|(x, q)| *x += factor * q);
        }
        return set.modulus(&x, branch.periods as usize);
    }
    set.modulus(&sample.u[..m], branch.periods as usize)
}
