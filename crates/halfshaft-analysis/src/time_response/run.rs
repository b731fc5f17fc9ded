//! One integration of a line from a state to an end time.

use std::cell::Cell;
use std::ops::ControlFlow;

use halfshaft_dynamics::{Active, EquationsOfMotion, Motion};
use halfshaft_numerics::Error;
use halfshaft_numerics::observer::Observer;
use halfshaft_numerics::ode::dop853::Dop853;
use halfshaft_numerics::ode::{Finish, Settings, Stop, System, Tolerance, integrate};
use halfshaft_results::{EnergyBalance, Reason, Termination};

use super::channels::Channels;
use super::recorder::Recorder;
use crate::equilibrium;
use crate::error::{AnalysisError, Doing};

/// What to run.
pub(crate) struct RunSettings {
    /// Which torques act.
    pub(crate) active: Active,
    /// End time, s.
    pub(crate) duration: f64,
    /// Relative tolerance.
    pub(crate) tolerance: f64,
    /// Step of the history, s.
    pub(crate) step: f64,
    /// Times that are kept and measured, s.
    pub(crate) record: (f64, f64),
    /// Whether turning points of the twists and their rates are kept.
    pub(crate) follow: bool,
}

/// What a run gave.
pub(crate) struct Run<'l> {
    pub(crate) recorder: Recorder<'l>,
    pub(crate) energy: EnergyBalance,
    pub(crate) steps: u64,
    pub(crate) evaluations: u64,
    pub(crate) termination: Termination,
}

/// Steps between two looks at the observer.
const LOOK_EVERY: u64 = 256;

/// Integrates the full equations from `state` (as of a motion with energy).
pub(crate) fn run<'l>(
    equations: &'l EquationsOfMotion,
    state: &[f64],
    settings: &RunSettings,
    observer: &dyn Observer,
) -> Result<Run<'l>, AnalysisError> {
    let mut motion = Motion::new(equations, settings.active, true);
    let mut initial = state.to_vec();
    let initial_energy = motion.energy(&initial);
    motion.apply_impulses(0.0, &mut initial);
    let dimension = motion.dimension();
    let mut recorder = new_recorder(equations, settings);
    let mut rate = vec![0.0; dimension];
    motion.derivative(0.0, &initial, &mut rate);
    recorder.start(0.0, &initial, &rate);

    let numbers = integrator_settings(equations, &initial, settings);
    let mut integrator =
        Dop853::new(motion, 0.0, &initial, numbers).doing("starting the integration")?;
    let breaks: Vec<f64> = equations.excitation.breaks().into_iter().filter(|t| *t > 0.0).collect();
    // The break and the step after it are told apart by two closures that share this flag.
    let jumped = Cell::new(false);
    let reaches = reaches(equations);
    let mut lost: Option<(usize, f64)> = None;
    let mut count = 0_u64;
    let finish = integrate(
        &mut integrator,
        settings.duration,
        &breaks,
        |time, motion: &mut Motion<'_>, state| {
            motion.apply_impulses(time, state);
            motion.switch_pulses(time);
            jumped.set(true);
        },
        |mut step| {
            let (from, to) = (step.previous_time(), step.time());
            let dense = step.dense();
            if jumped.take() {
                recorder.jump(&dense, from);
            }
            recorder.step(&dense, from, to);
            lost = reaches.iter().copied().find(|(tree, reach)| step.state()[*tree].abs() > *reach);
            if lost.is_some() {
                return ControlFlow::Break(());
            }
            count += 1;
            if count.is_multiple_of(LOOK_EVERY) {
                observer.progress(to / settings.duration);
                if observer.cancelled() {
                    return ControlFlow::Break(());
                }
            }
            ControlFlow::Continue(())
        },
    );
    let reached = integrator.time();
    let termination = match lost {
        Some((tree, reach)) => ran_away(equations, tree, reach, reached),
        None => termination(finish, reached)?,
    };
    let statistics = integrator.statistics();
    let last = integrator.state().to_vec();
    let mut motion = integrator.into_system();
    Ok(Run {
        energy: energy_balance(&mut motion, initial_energy, &last),
        recorder,
        steps: statistics.accepted as u64,
        evaluations: statistics.evaluations as u64,
        termination,
    })
}

/// Twists of this many times the limit of a law have nothing to hold them back: all equilibria of a
/// softening cubic lie within twice its limit.
const LOST: f64 = 4.0;

/// Tree twists whose laws have a limit on both sides, and how far is too far.
pub(crate) fn reaches(equations: &EquationsOfMotion) -> Vec<(usize, f64)> {
    let reach = |shaft: usize| {
        let limit = equilibrium::snap_limits(&equations.connections[shaft].law);
        Some(LOST * limit.positive?.twist.abs().max(limit.negative?.twist.abs()))
    };
    let tree = equations.network.tree.iter().enumerate();
    tree.filter_map(|(index, edge)| Some((index, reach(edge.shaft)?)))
        .filter(|(_, reach)| *reach > 0.0)
        .collect()
}

fn ran_away(equations: &EquationsOfMotion, tree: usize, reach: f64, time: f64) -> Termination {
    let name = &equations.connections[equations.network.tree[tree].shaft].name;
    let detail = format!(
        "at t = {time:.6} s the {name} is twisted past {reach:.4} rad, {LOST} times the limit of its \
         law, and the motion runs away; see `halfshaft static`"
    );
    Termination::early(Reason::RunsAway, detail)
}

fn new_recorder<'l>(equations: &'l EquationsOfMotion, settings: &RunSettings) -> Recorder<'l> {
    let channels = Channels::new(Motion::new(equations, settings.active, true));
    let followed = channels
        .list
        .iter()
        .map(|info| {
            settings.follow && (info.name.ends_with(".twist") || info.name.ends_with(".twist_rate"))
        })
        .collect();
    Recorder::new(channels, settings.record, settings.step, followed)
}

/// Tolerances in the scales of the problem: an absolute error counts against the twist (and
/// rate of twist) that the loading causes.
fn integrator_settings(
    equations: &EquationsOfMotion,
    state: &[f64],
    settings: &RunSettings,
) -> Settings {
    let n = equations.groups();
    let m = equations.network.tree.len();
    let loading = equations.excitation.scale();
    let stiffnesses = equations.connections.iter().map(|c| c.law.pieces().stiffness_scale());
    let stiffest = stiffnesses.fold(0.0, f64::max);
    let lightest = equations.inertia.iter().copied().fold(f64::INFINITY, f64::min);
    let fastest = (2.0 * stiffest / lightest).sqrt();
    let by_load = if stiffest > 0.0 { loading / stiffest } else { 0.0 };
    let largest = |values: &[f64]| values.iter().fold(0.0_f64, |largest, v| largest.max(v.abs()));
    let by_rate = if fastest > 0.0 { largest(&state[n..n + m]) / fastest } else { 0.0 };
    let scale = by_load.max(largest(&state[..m])).max(by_rate);
    let scale = if scale > 0.0 { scale } else { 1.0 };
    let rate_scale = if fastest > 0.0 { scale * fastest } else { scale };
    let energy_scale = (stiffest * scale * scale).max(loading * scale).max(f64::MIN_POSITIVE);
    let mut absolute = vec![settings.tolerance * scale; n];
    absolute.extend(vec![settings.tolerance * rate_scale; n]);
    absolute.extend([settings.tolerance * energy_scale; 2]);
    Settings {
        relative_tolerance: settings.tolerance,
        absolute_tolerance: Tolerance::PerComponent(absolute),
        ..Settings::default()
    }
}

/// How an integration ended, in words that help.
fn termination(finish: Result<Finish, Error>, reached: f64) -> Result<Termination, AnalysisError> {
    let runs_away = "the motion runs away there; a softening shaft that is thrown past its \
                     capacity does that: see `halfshaft static`";
    match finish {
        Ok(Finish::Reached) => Ok(Termination::completed()),
        Ok(Finish::Interrupted) => Ok(Termination::early(
            Reason::Cancelled,
            format!("stopped by the user at t = {reached:.6} s; the history up to there is kept"),
        )),
        Err(Error::Stopped(Stop::StepLimit { time, .. })) => Ok(Termination::early(
            Reason::StepLimit,
            format!(
                "the integrator used up its steps at t = {time:.6} s; ask for less time or a \
                     looser --tolerance"
            ),
        )),
        Err(Error::Stopped(Stop::StepTooSmall { time, .. })) => Ok(Termination::early(
            Reason::StepTooSmall,
            format!("the step became too small at t = {time:.6} s: {runs_away}"),
        )),
        Err(Error::Stopped(Stop::NonFinite { time })) => Ok(Termination::early(
            Reason::NonFinite,
            format!("numbers overflowed at t = {time:.6} s: {runs_away}"),
        )),
        Err(source) => Err(AnalysisError::Numerics { doing: "integrating", source }),
    }
}

fn energy_balance(motion: &mut Motion<'_>, initial: f64, last: &[f64]) -> EnergyBalance {
    let n = motion.coordinates();
    let stored = motion.energy(last);
    let (work, dissipated) = (last[2 * n], last[2 * n + 1]);
    let residual = initial + work - dissipated - stored;
    let turned_over = initial.abs() + work.abs() + dissipated.abs() + stored.abs();
    let relative_residual = if turned_over > 0.0 { residual.abs() / turned_over } else { 0.0 };
    EnergyBalance { initial, stored, work, dissipated, residual, relative_residual }
}
