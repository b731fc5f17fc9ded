//! Responses held against periodic orbits of the full equations by shooting.

use halfshaft_numerics::fourier;
use halfshaft_numerics::observer::{Observer, Part};
use halfshaft_results::{Reason, ResonanceResult, SpecialKind, Termination, VerifiedPoint};

use super::answer::{Setting, reference};
use super::branches::{Collected, TracedBranch};
use super::channels::group_series;
use super::orbits::state_of;
use super::system::{HarmonicSystem, Place};
use super::tracer::Sample;
use crate::error::{AnalysisError, Doing};
use crate::shooting::{Lost, Orbit, Sampled, Shooter, Turn};

/// Samples of each branch that are checked, beside those next to what is telling.
const SPREAD: usize = 8;
/// The same for large lines, where a check costs the cube of the number of groups.
const SPREAD_LARGE: usize = 3;
const LARGE: usize = 24;
/// Samples of an orbit for each period of the excitation.
const ORBIT_SAMPLES: usize = 1024;

/// Checks chosen samples of all branches.
pub(super) fn verify(
    setting: &Setting,
    collected: &Collected,
    result: &mut ResonanceResult,
    observer: &dyn Observer,
) -> Result<(), AnalysisError> {
    let chosen: Vec<(&TracedBranch, usize)> = collected
        .branches
        .iter()
        .flat_map(|branch| choose(setting, branch).into_iter().map(move |at| (branch, at)))
        .collect();
    for (done, (branch, at)) in chosen.iter().enumerate() {
        Part::of(observer, done, chosen.len()).progress(0.0);
        if observer.cancelled() {
            let detail = format!("{done} of {} responses were verified", chosen.len());
            result.header.termination = Termination::early(Reason::Cancelled, detail);
            break;
        }
        match check(setting, branch, *at)? {
            Ok(point) => result.verification.push(point),
            Err(lost) => result.header.warnings.push(format!(
                "no periodic motion of the full equations was found near the response at {:.6} rad/s on \
                 the branch from the {}: {}",
                branch.samples[*at].p,
                branch.origin,
                why(lost)
            )),
        }
    }
    Ok(())
}

fn why(lost: Lost) -> &'static str {
    match lost {
        Lost::Chattering => "a contact chatters, closing and opening thousands of times a period",
        Lost::RanAway => "the motion runs away within the period",
        Lost::NotConverged => "Newton's method did not converge",
        Lost::Singular => "the orbit is not isolated",
    }
}

/// Indices of samples to check: spread over the branch, its largest, and those beside its folds.
fn choose(setting: &Setting, branch: &TracedBranch) -> Vec<usize> {
    let count = branch.samples.len();
    let spread = if setting.line.equations.groups() > LARGE { SPREAD_LARGE } else { SPREAD };
    let mut chosen: Vec<usize> =
        (0..spread).map(|k| k * (count - 1) / (spread - 1).max(1)).collect();
    let largest = (0..count).max_by(|a, b| {
        let size = |at: usize| super::tracer::length(&branch.samples[at].u);
        size(*a).total_cmp(&size(*b))
    });
    chosen.extend(largest);
    let folds: Vec<usize> = branch
        .specials
        .iter()
        .filter(|special| special.kind == SpecialKind::Fold)
        .map(|special| special.after)
        .collect();
    for pair in folds.windows(2) {
        chosen.push(usize::midpoint(pair[0], pair[1]) + 1);
    }
    chosen.sort_unstable();
    chosen.dedup();
    chosen.retain(|at| *at < count);
    chosen
}

/// One sample by shooting from its own state.
fn check(
    setting: &Setting,
    branch: &TracedBranch,
    at: usize,
) -> Result<Result<VerifiedPoint, Lost>, AnalysisError> {
    let (sample, stability) = (&branch.samples[at], &branch.stability[at]);
    let equations = &setting.line.equations;
    // The whole period, whatever harmonics know of its symmetry.
    let mut shooter = Shooter::new(equations, branch.base, sample.p, false);
    let guess = state_of(&setting.line, branch.base, sample, &shooter.coordinates());
    let orbit = match shooter.at(&guess, sample.p) {
        Ok(orbit) => orbit,
        Err(lost) => return Ok(Err(lost)),
    };
    let name = reference(setting);
    let shaft = equations.connection(name).unwrap_or(0);
    let (twist, amplitude) = match seen(&mut shooter, &orbit, shaft, branch.periods as usize) {
        Ok(seen) => seen,
        Err(lost) => return Ok(Err(lost)),
    };
    let multipliers = match orbit.multipliers() {
        Ok(multipliers) => multipliers,
        Err(lost) => return Ok(Err(lost)),
    };
    let harmonic = fourier::harmonic(&twist, branch.periods as usize)
        .doing("taking the harmonic of an orbit")?
        .modulus;
    let predicted = predicted(setting, branch, sample, shaft);
    let largest = multipliers.first().map_or(0.0, |m| m.modulus());
    Ok(Ok(VerifiedPoint {
        frequency: sample.p,
        channel: format!("{name}.twist"),
        predicted,
        integrated: harmonic,
        integrated_amplitude: amplitude,
        relative_difference: predicted / harmonic - 1.0,
        predicted_stable: stability.is_stable(),
        integrated_stable: largest < 1.0 + super::stability::NEUTRAL,
        largest_multiplier: largest,
        predicted_multiplier: Some(stability.largest()),
        orbit_residual: orbit.residual / amplitude.max(f64::MIN_POSITIVE),
    }))
}

/// Samples of a twist over the period of an orbit, and half of its peak to peak.
fn seen(
    shooter: &mut Shooter<'_>,
    orbit: &Orbit,
    shaft: usize,
    periods: usize,
) -> Result<(Vec<f64>, f64), Lost> {
    let equations = shooter.equations();
    let count = ORBIT_SAMPLES * periods;
    let mut sampled = Sampled::new(equations.groups(), count, shooter.period(orbit.frequency));
    let mut turns: Vec<Turn> = Vec::new();
    shooter.watch(orbit, |step| {
        sampled.see(step);
        step.turns(shaft, &mut turns);
    })?;
    let mut angles = vec![0.0; equations.groups()];
    let twist: Vec<f64> = (0..sampled.angles[0].len())
        .map(|at| {
            angles.iter_mut().zip(&sampled.angles).for_each(|(q, list)| *q = list[at]);
            equations.twist(shaft, &angles)
        })
        .collect();
    let all = || twist.iter().copied().chain(turns.iter().map(|turn| turn.twist));
    let (top, bottom) =
        (all().fold(f64::NEG_INFINITY, f64::max), all().fold(f64::INFINITY, f64::min));
    Ok((twist, 0.5 * (top - bottom)))
}

fn predicted(setting: &Setting, branch: &TracedBranch, sample: &Sample, shaft: usize) -> f64 {
    let mut system = HarmonicSystem::new(setting.line.clone(), sample.set.clone(), branch.base);
    let place = Place { frequency: sample.p, drive: 1.0 };
    let series = group_series(&mut system, &sample.u, place);
    let m = sample.set.coefficients();
    let connection = &setting.line.equations.connections[shaft];
    let ends = [connection.from, connection.to.map(|(group, ratio)| (group, -ratio))];
    let mut twist = vec![0.0; m];
    for (group, factor) in ends.into_iter().flatten() {
        let source = &series[group * m..(group + 1) * m];
        twist.iter_mut().zip(source).for_each(|(x, q)| *x += factor * q);
    }
    sample.set.modulus(&twist, branch.periods as usize)
}
