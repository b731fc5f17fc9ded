//! Predicted responses held against periodic orbits of the full line.

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_numerics::dense::Matrix;
use halfshaft_numerics::fourier;
use halfshaft_numerics::observer::{Observer, Part};
use halfshaft_numerics::ode::System;
use halfshaft_numerics::ode::periodic::{PeriodicSettings, find_orbit};
use halfshaft_results::VerifiedPoint;

use super::elastic_motion::ElasticMotion;
use crate::averaging::{ModeEquation, Response, phase_lag};
use crate::equilibrium;
use crate::error::{AnalysisError, Doing};

/// Speeds spread over the range at which responses are checked.
const SPREAD: u32 = 8;
/// Lines of more groups than this are checked at the ends of the range and where it tells most: the
/// work of one check grows with the cube of their number.
const LARGE: usize = 8;
/// Speeds nearer to a fold than this part of the range are not chosen: there the prediction may
/// have no orbit to stand for.
const FOLD_MARGIN: f64 = 2e-3;
/// Speeds nearer than this part of the range to a telling one would say the same again.
const NEIGHBOUR: f64 = 0.02;

/// Chooses responses of a mode within a range of speeds: *all* of them at speeds spread over the
/// range, at the peak, and midway between neighbouring folds, where responses coexist.
pub(crate) fn choose(mode: &ModeEquation, (from, to): (f64, f64)) -> Vec<Response> {
    let flow = mode.slow_flow();
    let (low, high) = (mode.sigma(from), mode.sigma(to));
    let mut folds: Vec<f64> = flow.folds().iter().map(|fold| fold.sigma).collect();
    folds.sort_by(f64::total_cmp);
    let mut telling: Vec<f64> =
        folds.windows(2).map(|pair| f64::midpoint(pair[0], pair[1])).collect();
    telling.extend(flow.peak().map(|peak| peak.sigma));
    telling.retain(|sigma| (low..=high).contains(sigma));
    let apart = |sigma: f64, others: &[f64], by: f64| {
        others.iter().all(|other| (sigma - other).abs() > by * (high - low))
    };
    let count = if mode.group_per_x.len() > LARGE { 2 } else { SPREAD };
    let spread = (0..count).map(|k| low + (high - low) * f64::from(k) / f64::from(count - 1));
    let mut sigmas: Vec<f64> = spread
        .filter(|sigma| apart(*sigma, &folds, FOLD_MARGIN) && apart(*sigma, &telling, NEIGHBOUR))
        .collect();
    sigmas.append(&mut telling);
    sigmas.sort_by(f64::total_cmp);
    sigmas.into_iter().flat_map(|sigma| flow.responses(sigma)).collect()
}

/// Steps of the integration over one period at most: beyond that a motion runs away.
pub(super) const MOST_STEPS: usize = 10_000;

/// Samples of an orbit at least, and for each period of the harmonic that is looked at.
const SAMPLES: usize = 256;
const SAMPLES_PER_WAVE: usize = 16;
/// An orbit whose harmonic is more than so many times larger or smaller than predicted is another.
const FARTHEST: f64 = 2.0;

/// What the check of predicted responses gave.
#[derive(Debug, Default)]
pub(crate) struct Verified {
    /// Responses with the orbit found from them.
    pub(crate) points: Vec<VerifiedPoint>,
    /// Responses near which no orbit was found.
    pub(crate) missed: Vec<Response>,
    /// Responses that carry the shaft past the limit of its law, where nothing is to be found.
    pub(crate) beyond: usize,
    /// Whether the user stopped the check before its end.
    pub(crate) cancelled: bool,
}

/// Checks predicted responses by periodic orbits of the full line; `None` where the orders of the
/// torques have no common period.
pub(crate) fn periodic(
    equations: &EquationsOfMotion,
    mode: &ModeEquation,
    points: &[Response],
    observer: &dyn Observer,
) -> Result<Option<Verified>, AnalysisError> {
    let Some(base) = common_order(&equations.excitation.orders()) else { return Ok(None) };
    let mut verified = Verified::default();
    let room = equilibrium::room(equations, mode.reference, &mode.rest_twists);
    for (index, point) in points.iter().enumerate() {
        Part::of(observer, index, points.len()).progress(0.0);
        if observer.cancelled() {
            verified.cancelled = true;
            break;
        }
        if point.rho() >= room {
            verified.beyond += 1;
            continue;
        }
        match check(equations, mode, point, base)? {
            Some(found) => verified.points.push(found),
            None => verified.missed.push(*point),
        }
    }
    Ok(Some(verified))
}

/// Largest order that divides all others, so that its period is common to all.
pub(crate) fn common_order(orders: &[f64]) -> Option<f64> {
    let first = *orders.first()?;
    let divides = |base: f64| {
        orders.iter().all(|order| {
            let ratio = order / base;
            (ratio - ratio.round()).abs() < 1e-9
        })
    };
    (1..=64).map(|parts| first / f64::from(parts)).find(|base| divides(*base))
}

fn check(
    equations: &EquationsOfMotion,
    mode: &ModeEquation,
    point: &Response,
    base: f64,
) -> Result<Option<VerifiedPoint>, AnalysisError> {
    let frequency = mode.frequency(point.sigma);
    let period = std::f64::consts::TAU / (base * frequency);
    let mut motion = ElasticMotion::new(equations, frequency);
    let guess = guess(equations, mode, point, &motion);
    let mut settings = PeriodicSettings::default();
    settings.newton.typical = typical(&guess, mode, point);
    settings.integration.step_limit = MOST_STEPS;
    let orbit = find_orbit(&mut motion, 0.0, period, &guess, &settings);
    // A line that runs away within the period has no orbit there: nothing to compare.
    let Ok(orbit) = orbit else { return Ok(None) };
    if !orbit.report.converged.is_converged() {
        return Ok(None);
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small count")]
    let harmonic = (mode.order / base).round() as usize;
    let samples = orbit
        .sample(&mut motion, SAMPLES.max(SAMPLES_PER_WAVE * harmonic), &settings.integration)
        .doing("sampling a periodic orbit")?;
    let twist = twist_of(equations, mode.reference, &samples);
    let twist = twist.as_slice();
    let integrated =
        fourier::harmonic(twist, harmonic).doing("taking the harmonic of an orbit")?.modulus;
    // Newton's method may have gone to another response, which says nothing of this one.
    if !(1.0 / FARTHEST..=FARTHEST).contains(&(integrated / point.rho())) {
        return Ok(None);
    }
    let amplitude = fourier::half_peak_to_peak(twist).doing("measuring an orbit")?;
    let largest = orbit.multipliers.iter().map(|m| m.modulus()).fold(0.0, f64::max);
    let flow = mode.slow_flow();
    Ok(Some(VerifiedPoint {
        frequency,
        channel: format!("{}.twist", equations.connections[mode.reference].name),
        predicted: point.rho(),
        integrated,
        integrated_amplitude: amplitude,
        relative_difference: point.rho() / integrated - 1.0,
        predicted_stable: flow.is_stable(point),
        integrated_stable: largest < 1.0,
        largest_multiplier: largest,
        predicted_multiplier: None,
        orbit_residual: orbit.residual / amplitude.max(f64::MIN_POSITIVE),
    }))
}

/// Twist of a shaft over an orbit; one that closes a loop follows from those of the tree.
fn twist_of(equations: &EquationsOfMotion, shaft: usize, samples: &Matrix) -> Vec<f64> {
    if let Some(edge) = equations.network.tree.iter().position(|edge| edge.shaft == shaft) {
        return samples.row(edge).to_vec();
    }
    let tree = equations.network.tree.len();
    (0..samples.columns())
        .map(|column| {
            let twists: Vec<f64> = (0..tree).map(|edge| samples[(edge, column)]).collect();
            equilibrium::all_twists(equations, &twists)[shaft]
        })
        .collect()
}

/// The state at time 0 of the predicted response.
fn guess(
    equations: &EquationsOfMotion,
    mode: &ModeEquation,
    point: &Response,
    motion: &ElasticMotion<'_>,
) -> Vec<f64> {
    let angle = mode.phase - phase_lag(mode, point);
    let omega = mode.omega + point.sigma;
    let x = point.rho() * angle.cos() + mode.mean_shift(point.z);
    let v = -point.rho() * omega * angle.sin();
    let mut state = vec![0.0; motion.dimension()];
    for (index, edge) in equations.network.tree.iter().enumerate() {
        state[index] = mode.rest_twists[edge.shaft] + mode.twist_per_x[edge.shaft] * x;
        state[motion.twists() + index] = mode.twist_per_x[edge.shaft] * v;
    }
    state
}

/// Sizes by which Newton's method weighs the unknowns.
fn typical(guess: &[f64], mode: &ModeEquation, point: &Response) -> Vec<f64> {
    let rho = point.rho().max(f64::MIN_POSITIVE.sqrt());
    let twists = guess.len() / 2;
    (0..guess.len()).map(|k| if k < twists { rho } else { rho * mode.omega }).collect()
}
