//! Which order excites, and which range of speeds shows the resonance.

use halfshaft_dynamics::laws::PolynomialLaw;
use halfshaft_dynamics::{EquationsOfMotion, TorqueLaw};
use halfshaft_numerics::dense::dot;

use super::curve::{Curve, Kind, follow};
use super::grid::Grid;
use super::problem::{METHOD, Problem};
use super::responses::Finder;
use crate::equilibrium;
use crate::error::AnalysisError;
use crate::modal::elastic::lowest_modes;

/// A mode of the line about rest, as far as a range of speeds needs it.
#[derive(Clone, Debug)]
pub(super) struct Resonance {
    /// Natural circular frequency of the asked mode, rad/s.
    pub(super) omega: f64,
    /// Damping coefficient of the mode, 1/s.
    pub(super) beta: f64,
}

/// The error of a line that does not say by itself where to look.
pub(super) fn no_resonance() -> AnalysisError {
    AnalysisError::MethodDoesNotFit {
        method: METHOD,
        reason: "the line has no resonance to look about: give a range of speeds".to_owned(),
    }
}

/// Mean twist of the nonlinear shaft at rest, rad: the held one nearest to zero.
pub(super) fn rest_twist(problem: &Problem) -> f64 {
    let law = &problem.law;
    let (asked, parallel) = (law.statics.asked, law.statics.parallel);
    let mut twists = law.law.twists_at(asked);
    if parallel != 0.0 {
        // What is in parallel moves it: near the twist under the whole load by Newton's method.
        let start = asked / (parallel + law.law.stiffness(0.0));
        twists.insert(0, law.mean(1e-9 * start.abs().max(1e-9), start).unwrap_or(start));
    }
    let held = twists.iter().filter(|x| law.law.stiffness(**x) + parallel > 0.0);
    held.copied().min_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap_or(0.0)
}

/// The resonance about which a line is looked at.
///
/// Where the shaft is slack at rest, its stiffness far from there stands in.
pub(super) fn resonance(
    equations: &EquationsOfMotion,
    shaft: usize,
    mode: usize,
) -> Result<Resonance, AnalysisError> {
    let states = equilibrium::find_stable(equations)?;
    let twists = states.primary().map(|state| state.twists.clone());
    if let Some(twists) = &twists
        && let Some(found) = about(equations, twists, mode)?
    {
        return Ok(found);
    }
    let mut taut = equations.clone();
    let law = &equations.connections[shaft].law;
    let reach = law.switching_twists().iter().fold(1e-6_f64, |far, twist| far.max(twist.abs()));
    let stiffness = law.stiffness(2.0 * reach).max(law.stiffness(-2.0 * reach));
    let straight = [0.0, stiffness, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    taut.connections[shaft].law = TorqueLaw::Polynomial(PolynomialLaw::new(straight));
    let twists = twists.unwrap_or_else(|| vec![0.0; equations.connections.len()]);
    about(&taut, &twists, mode)?.ok_or_else(no_resonance)
}

/// Modes that are looked at for what counts as no stiffness at all.
const LOOKED_AT: usize = 20;

/// The modes about given twists; `None` where the asked one does not vibrate.
fn about(
    equations: &EquationsOfMotion,
    twists: &[f64],
    mode: usize,
) -> Result<Option<Resonance>, AnalysisError> {
    let modes = lowest_modes(equations, twists, mode.max(LOOKED_AT))?;
    let found = modes.len();
    let asked = modes.get(mode - 1).ok_or(AnalysisError::NoSuchMode { asked: mode, found })?;
    let largest = modes.iter().map(|mode| mode.eigenvalue).fold(0.0, f64::max);
    if asked.eigenvalue <= 1e-12 * largest {
        return Ok(None);
    }
    let damping = equations.damping_matrix();
    let image: Vec<f64> =
        (0..damping.rows()).map(|row| dot(damping.row(row), &asked.shape)).collect();
    let (omega, beta) = (asked.eigenvalue.sqrt(), dot(&asked.shape, &image));
    Ok(Some(Resonance { omega, beta }))
}

/// The order that is asked for, or of all the one that drives the shaft most at `nu`, and how many
/// there are.
pub(super) fn order(
    equations: &EquationsOfMotion,
    asked: Option<f64>,
    nu: Option<f64>,
) -> Result<f64, AnalysisError> {
    let known = equations.excitation.orders();
    if known.is_empty() {
        let reason = "no torque has an amplitude".to_owned();
        return Err(AnalysisError::NoExcitation { reason });
    }
    if let Some(order) = asked {
        if known.contains(&order) {
            return Ok(order);
        }
        let known: Vec<String> = known.iter().map(f64::to_string).collect();
        let reason =
            format!("no torque has the order {order}; the orders are {}", known.join(", "));
        return Err(AnalysisError::NoExcitation { reason });
    }
    let mut best = (known[0], -1.0);
    for order in &known {
        let problem = Problem::new(equations.clone(), *order)?;
        let at = nu.and_then(|nu| problem.value(nu));
        let strength = at.map_or(0.0, |point| point.gamma.modulus());
        if strength > best.1 {
            best = (*order, strength);
        }
    }
    Ok(best.0)
}

/// The shaft whose twist is solved for: the nonlinear one; of a linear line the first that an order
/// twists within a range of circular frequencies.
pub(super) fn shaft(problem: Problem, window: (f64, f64)) -> Problem {
    if !problem.law.law.is_linear() || !problem.law.is_plain() || reaches(&problem, window).is_ok()
    {
        return problem;
    }
    let other = |shaft| Problem::of_shaft(problem.equations.clone(), shaft, problem.order);
    let others = (0..problem.equations.connections.len()).map(other);
    others.into_iter().find(|other| reaches(other, window).is_ok()).unwrap_or(problem)
}

/// Refuses a drive that does not reach the shaft within a range of circular frequencies.
pub(super) fn reaches(problem: &Problem, (from, to): (f64, f64)) -> Result<(), AnalysisError> {
    let scale = problem.equations.excitation.scale();
    let loud = (0..8).any(|k| {
        let nu = from + (to - from) * (f64::from(k) + 0.37) / 8.0;
        problem.value(nu).is_some_and(|point| {
            let blocked = point.gamma.modulus() / (point.beta.modulus() * scale);
            let stiffness = point.alpha.modulus() / point.beta.modulus();
            point.gamma.modulus() > 0.0 && (blocked > 1e-12 || stiffness < 1e-12)
        })
    });
    if loud && !problem.drive.is_silent() {
        return Ok(());
    }
    let shaft = &problem.equations.connections[problem.shaft].name;
    let reason = format!("the torques of order {} do not twist the {shaft}", problem.order);
    Err(AnalysisError::NoExcitation { reason })
}

/// Circular frequencies of a coarse look.
const COARSE: usize = 160;

/// Evenly spaced numbers, both ends exact.
pub(super) fn even(from: f64, to: f64, count: usize) -> Vec<f64> {
    let last = count.max(2) - 1;
    #[expect(clippy::cast_precision_loss, reason = "counts are small")]
    let at = |k: usize| from + (to - from) * (k as f64 / last as f64);
    (0..=last).map(|k| if k == last { to } else { at(k) }).collect()
}

/// Range of circular frequencies that shows a resonance: several widths of it, its peak and all
/// folds near it.
pub(super) fn window(problem: &Problem, finder: &Finder, resonance: &Resonance) -> (f64, f64) {
    let omega = resonance.omega;
    let broad = even(0.4 * omega, 1.9 * omega, COARSE);
    let curve = follow(problem, Grid::new(problem, finder, broad, &|| false), &|| false);
    let (low, high) = marks(&curve, omega);
    let reach = (4.0 * resonance.beta).max(high - low).clamp(1e-3 * omega, 0.5 * omega);
    ((low - reach).max(0.05 * omega), high + reach)
}

/// Least and greatest frequency of what belongs to a resonance: itself, the peak, folds.
fn marks(curve: &Curve, omega: f64) -> (f64, f64) {
    let samples = || curve.pieces.iter().flat_map(|piece| &piece.samples);
    let folds = samples().filter(|sample| sample.kind == Kind::Fold);
    let peaks = samples().filter(|sample| sample.kind == Kind::Peak);
    let peak = peaks.max_by(|a, b| a.response.amplitude().total_cmp(&b.response.amplitude()));
    let (mut low, mut high) = (omega, omega);
    for sample in folds.chain(peak) {
        low = low.min(sample.response.nu);
        high = high.max(sample.response.nu);
    }
    (low, high)
}
