//! Predicted responses held against periodic orbits of the full line.

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_numerics::fourier;
use halfshaft_numerics::observer::Observer;
use halfshaft_numerics::ode::System;
use halfshaft_numerics::ode::periodic::{PeriodicSettings, find_orbit};
use halfshaft_results::{Branch, VerifiedPoint};

use super::elastic_motion::ElasticMotion;
use crate::averaging::{ModeEquation, Response, phase_lag};
use crate::error::{AnalysisError, Doing};

/// Points that are checked on a curve.
const POINTS: usize = 9;
/// Points nearer to a fold than this part of the frequency are not chosen: there the prediction
/// may have no orbit to stand for.
const FOLD_MARGIN: f64 = 2e-3;

/// Chooses responses along the branches of a mode, spread evenly, folds avoided.
pub(crate) fn choose(branches: &[Branch], mode: &ModeEquation) -> Vec<Response> {
    let flow = mode.slow_flow();
    let folds: Vec<f64> = flow.folds().iter().map(|fold| mode.frequency(fold.sigma)).collect();
    let mut all: Vec<Response> = Vec::new();
    for branch in branches {
        let rows = branch.values("sigma").iter().zip(branch.values("rho"));
        for (frequency, (sigma, rho)) in branch.values("frequency").iter().zip(rows) {
            let near = |fold: &f64| (frequency / fold - 1.0).abs() < FOLD_MARGIN;
            // Branches of other orders have their own detuning for the same speed.
            let own = (mode.sigma(*frequency) - sigma).abs() <= 1e-9 * mode.omega;
            if own && !folds.iter().any(near) {
                let z = rho * rho;
                all.push(Response { sigma: *sigma, z, beyond: sigma - flow.bend(z) });
            }
        }
    }
    if all.is_empty() {
        return all;
    }
    let last = all.len() - 1;
    (0..POINTS).map(|k| all[k * last / (POINTS - 1)]).collect()
}

/// Samples of an orbit for its harmonics.
const SAMPLES: usize = 256;

/// Checks predicted responses by periodic orbits of the full line. Those for which no orbit is
/// found near the prediction are left out.
pub(crate) fn periodic(
    equations: &EquationsOfMotion,
    mode: &ModeEquation,
    points: &[Response],
    observer: &dyn Observer,
) -> Result<Vec<VerifiedPoint>, AnalysisError> {
    let Some(base) = common_order(&equations.excitation.orders()) else { return Ok(Vec::new()) };
    let mut verified = Vec::new();
    for point in points {
        if observer.cancelled() {
            break;
        }
        verified.extend(check(equations, mode, point, base)?);
    }
    Ok(verified)
}

/// Largest order that divides all others, so that its period is common to all.
fn common_order(orders: &[f64]) -> Option<f64> {
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
    let orbit = find_orbit(&mut motion, 0.0, period, &guess, &settings);
    // A line that runs away within the period has no orbit there: nothing to compare.
    let Ok(orbit) = orbit else { return Ok(None) };
    if !orbit.report.converged.is_converged() {
        return Ok(None);
    }
    let samples = orbit
        .sample(&mut motion, SAMPLES, &settings.integration)
        .doing("sampling a periodic orbit")?;
    let Some(edge) = equations.network.tree.iter().position(|e| e.shaft == mode.reference) else {
        return Ok(None);
    };
    let twist = samples.row(edge);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small count")]
    let harmonic = (mode.order / base).round() as usize;
    let integrated =
        fourier::harmonic(twist, harmonic).doing("taking the harmonic of an orbit")?.modulus;
    let amplitude = fourier::half_peak_to_peak(twist).doing("measuring an orbit")?;
    let largest = orbit.multipliers.iter().map(|m| m.modulus()).fold(0.0, f64::max);
    let flow = mode.slow_flow();
    Ok(Some(VerifiedPoint {
        frequency,
        predicted: point.rho(),
        integrated,
        integrated_amplitude: amplitude,
        relative_difference: point.rho() / integrated - 1.0,
        predicted_stable: flow.is_stable(point),
        integrated_stable: largest < 1.0,
        largest_multiplier: largest,
        orbit_residual: orbit.residual / amplitude.max(f64::MIN_POSITIVE),
    }))
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
