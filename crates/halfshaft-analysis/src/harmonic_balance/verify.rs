//! Responses held against periodic orbits of the full equations by shooting.

use halfshaft_numerics::fourier;
use halfshaft_numerics::observer::{Observer, Part};
use halfshaft_numerics::ode::System;
use halfshaft_numerics::ode::periodic::{PeriodicSettings, find_orbit};
use halfshaft_results::{Reason, ResonanceResult, SpecialKind, Termination, VerifiedPoint};

use super::answer::{Setting, reference};
use super::branches::{Collected, TracedBranch};
use super::channels::group_series;
use super::system::{HarmonicSystem, Place};
use super::tracer::Sample;
use crate::equilibrium::{self, RunningState};
use crate::error::{AnalysisError, Doing};
use crate::verification::ElasticMotion;

/// Samples of each branch that are checked, beside those next to what is telling.
const SPREAD: usize = 8;
/// The same for large lines, where a check costs the cube of the number of groups.
const SPREAD_LARGE: usize = 2;
const LARGE: usize = 8;
/// Samples of an orbit at least, and for each period of the excitation.
const ORBIT_SAMPLES: usize = 512;
/// Steps of the integration over one period at most.
const MOST_STEPS: usize = 20_000;

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
            Some(point) => result.verification.push(point),
            None => result.header.warnings.push(format!(
                "no periodic motion of the full equations was found near the response at {:.6} rad/s on \
                 the branch from the {}",
                branch.samples[*at].p, branch.origin
            )),
        }
    }
    Ok(())
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
) -> Result<Option<VerifiedPoint>, AnalysisError> {
    let (sample, stability) = (&branch.samples[at], &branch.stability[at]);
    let equations = &setting.line.equations;
    let place = Place { frequency: sample.p, drive: 1.0 };
    let period = std::f64::consts::TAU / (branch.base * sample.p);
    let mut motion = ElasticMotion::new(equations, sample.p);
    let guess = state(setting, branch, sample, place, &motion);
    let mut settings = PeriodicSettings::default();
    let size = guess.iter().take(motion.twists()).fold(0.0_f64, |a, b| a.max(b.abs()));
    let speed = size * branch.base * sample.p * f64::from(branch.periods);
    let sizes = |k: usize| if k < motion.twists() { size.max(1e-9) } else { speed.max(1e-9) };
    settings.newton.typical = (0..guess.len()).map(sizes).collect();
    settings.integration.step_limit = MOST_STEPS;
    let orbit = find_orbit(&mut motion, 0.0, period, &guess, &settings);
    let Ok(orbit) = orbit else { return Ok(None) };
    if !orbit.report.converged.is_converged() {
        return Ok(None);
    }
    let samples = orbit
        .sample(&mut motion, ORBIT_SAMPLES * branch.periods as usize, &settings.integration)
        .doing("sampling a periodic orbit")?;
    let name = reference(setting);
    let shaft = equations.connection(name).unwrap_or(0);
    let tree = equations.network.tree.len();
    let twist: Vec<f64> = (0..samples.columns())
        .map(|column| {
            let twists: Vec<f64> = (0..tree).map(|edge| samples[(edge, column)]).collect();
            equilibrium::all_twists(equations, &twists)[shaft]
        })
        .collect();
    let harmonic = fourier::harmonic(&twist, branch.periods as usize)
        .doing("taking the harmonic of an orbit")?
        .modulus;
    let amplitude = fourier::half_peak_to_peak(&twist).doing("measuring an orbit")?;
    let predicted = predicted(setting, branch, sample, shaft);
    let largest = orbit.multipliers.iter().map(|m| m.modulus()).fold(0.0, f64::max);
    Ok(Some(VerifiedPoint {
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

/// The state at time 0: twists and rates of the tree, and the speed as a whole where it counts.
fn state(
    setting: &Setting,
    branch: &TracedBranch,
    sample: &Sample,
    place: Place,
    motion: &ElasticMotion<'_>,
) -> Vec<f64> {
    let equations = &setting.line.equations;
    let mut system = HarmonicSystem::new(setting.line.clone(), sample.set.clone(), branch.base);
    let series = group_series(&mut system, &sample.u, place);
    let m = sample.set.coefficients();
    let speed = branch.base * place.frequency;
    let (mut angles, mut speeds) = (Vec::new(), Vec::new());
    for coefficients in series.chunks_exact(m) {
        let (value, slope) = sample.set.evaluate(coefficients, 0.0);
        angles.push(value);
        speeds.push(speed * slope);
    }
    let mut state = vec![0.0; motion.dimension()];
    for (index, edge) in equations.network.tree.iter().enumerate() {
        state[index] = equations.twist(edge.shaft, &angles);
        state[motion.twists() + index] = equations.twist(edge.shaft, &speeds);
    }
    if let (Some(rigid), true) = (&equations.rigid, motion.dimension() > 2 * motion.twists()) {
        state[2 * motion.twists()] = rigid.mean(&speeds) + RunningState::of(equations).speed;
    }
    state
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
