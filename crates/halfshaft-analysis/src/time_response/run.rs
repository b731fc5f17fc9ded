//! One integration of a line from a state to an end time.

use std::sync::Arc;

use halfshaft_dynamics::{Active, EquationsOfMotion, Modes, Motion};
use halfshaft_numerics::Error;
use halfshaft_numerics::observer::Observer;
use halfshaft_numerics::ode::dop853::Dop853;
use halfshaft_numerics::ode::{self, Settings, Stop, System, Tolerance};
use halfshaft_results::{EnergyBalance, Reason, Termination};

use super::channels::Channels;
use super::events::Events;
use super::recorder::Recorder;
use super::watch::Watch;
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
    /// Whether dry friction sticks and slides exactly.
    pub(crate) exact_friction: bool,
}

/// What a run gave.
pub(crate) struct Run<'l> {
    pub(crate) recorder: Recorder<'l>,
    pub(crate) events: Events,
    pub(crate) energy: EnergyBalance,
    pub(crate) steps: u64,
    pub(crate) evaluations: u64,
    pub(crate) termination: Termination,
}

/// Steps between two looks at the observer.
const LOOK_EVERY: u64 = 256;

/// Integrates the full equations from `state` (as of a motion with energy), from event to event.
pub(crate) fn run<'l>(
    equations: &'l EquationsOfMotion,
    state: &[f64],
    settings: &RunSettings,
    observer: &dyn Observer,
) -> Result<Run<'l>, AnalysisError> {
    let mut motion = Motion::new(equations, settings.active, true);
    let modes = Modes::new(equations, settings.exact_friction);
    if !modes.never_switch() {
        motion.set_modes(Arc::new(modes));
    }
    let mut initial = state.to_vec();
    let initial_energy = motion.energy(&initial);
    motion.apply_impulses(0.0, &mut initial);
    motion.choose_modes(0.0, &initial);
    let mut recorder = new_recorder(equations, settings);
    recorder.follow(&motion, 0.0);
    let mut rate = vec![0.0; motion.dimension()];
    motion.derivative(0.0, &initial, &mut rate);
    recorder.start(0.0, &initial, &rate);
    let watch = Watch::new(motion.clone(), 0.0);
    let events = Events::new(equations, &motion, settings.record);
    let numbers = integrator_settings(equations, &initial, settings);
    let integrator =
        Dop853::new(motion, 0.0, &initial, numbers).doing("starting the integration")?;
    let mut passes = Passes {
        equations,
        settings,
        integrator,
        recorder,
        watch,
        reaches: reaches(equations),
        events,
        jumped: false,
        count: 0,
    };
    let finish = passes.all(observer);
    let reached = passes.integrator.time();
    let Passes { integrator, recorder, mut events, .. } = passes;
    let termination = match finish {
        Ok(Finish::RanAway { tree, reach }) => ran_away(equations, tree, reach, reached),
        Ok(Finish::Chattered { connection }) => chattered(equations, connection, reached),
        Ok(Finish::Reached) => termination(Ok(ode::Finish::Reached), reached)?,
        Ok(Finish::Interrupted) => termination(Ok(ode::Finish::Interrupted), reached)?,
        Err(error) => termination(Err(error), reached)?,
    };
    let statistics = integrator.statistics();
    let last = integrator.state().to_vec();
    let mut motion = integrator.into_system();
    events.pass_time(reached, &motion);
    Ok(Run {
        energy: energy_balance(&mut motion, initial_energy, &last),
        recorder,
        events,
        steps: statistics.accepted as u64,
        evaluations: statistics.evaluations as u64,
        termination,
    })
}

/// How the steps came to an end.
enum Finish {
    Reached,
    Interrupted,
    /// A twist is past the limit of its law.
    RanAway {
        tree: usize,
        reach: f64,
    },
    /// A connection changes its mode without time passing.
    Chattered {
        connection: usize,
    },
}

/// The steps of a run.
struct Passes<'r, 'l> {
    equations: &'l EquationsOfMotion,
    settings: &'r RunSettings,
    integrator: Dop853<Motion<'l>>,
    recorder: Recorder<'l>,
    watch: Watch<'l>,
    reaches: Vec<(usize, f64)>,
    events: Events,
    /// Whether the state or the torques have jumped since the last step.
    jumped: bool,
    count: u64,
}

/// Changes of mode at one time, after which they count as chattering.
const MOST_AT_ONCE: usize = 50;

impl Passes<'_, '_> {
    /// From break to break, from event to event.
    fn all(&mut self, observer: &dyn Observer) -> Result<Finish, Error> {
        let mut breaks = self.equations.breaks();
        breaks.retain(|time| *time > 0.0 && *time < self.settings.duration);
        breaks.push(self.settings.duration);
        for (index, goal) in breaks.iter().copied().enumerate() {
            let mut at_once = 0;
            while self.integrator.time() != goal {
                let before = self.integrator.time();
                if let Some(connection) = self.step(goal)? {
                    let stood = self.integrator.time() - before <= 1e-13 * goal;
                    at_once = if stood { at_once + 1 } else { 0 };
                    if at_once > MOST_AT_ONCE {
                        return Ok(Finish::Chattered { connection });
                    }
                }
                if let Some(finish) = self.look_round(observer) {
                    return Ok(finish);
                }
            }
            if index + 1 < breaks.len() {
                self.pass_break(goal)?;
            }
        }
        Ok(Finish::Reached)
    }

    /// One step, or what of it comes before the next event; gives the connection of that.
    fn step(&mut self, goal: f64) -> Result<Option<usize>, Error> {
        self.integrator.step(goal)?;
        let (from, to) = (self.integrator.previous_time(), self.integrator.time());
        let passage = self.watch.first(&self.integrator.dense(), (from, to));
        let passage = match passage {
            Some(passage) => Some(self.watch.meet(&mut self.integrator, passage)?),
            None => None,
        };
        let to = self.integrator.time();
        let dense = self.integrator.dense();
        if std::mem::take(&mut self.jumped) {
            self.recorder.jump(&dense, from);
        }
        self.recorder.step(&dense, from, to);
        let Some(passage) = passage else { return Ok(None) };
        let mut event = None;
        self.integrator.restart_with(|motion, state| {
            event = Some(motion.pass(passage.border, to, state));
        })?;
        if let Some(event) = event {
            self.events.take(to, &event, self.integrator.system());
        }
        self.follow_modes(to);
        Ok(Some(passage.border.connection))
    }

    fn follow_modes(&mut self, time: f64) {
        let motion = self.integrator.system();
        if let Some(modes) = motion.modes() {
            self.watch.follow(modes, time);
        }
        self.recorder.follow(motion, time);
    }

    /// Impulses and pulses that begin or end at a time.
    fn pass_break(&mut self, time: f64) -> Result<(), Error> {
        self.integrator.restart_with(|motion, state| {
            motion.apply_impulses(time, state);
            motion.switch_pulses(time);
            motion.choose_modes(time, state);
        })?;
        self.jumped = true;
        self.events.pass_time(time, self.integrator.system());
        self.follow_modes(time);
        Ok(())
    }

    /// Whether the run ends early.
    fn look_round(&mut self, observer: &dyn Observer) -> Option<Finish> {
        let state = self.integrator.state();
        let lost = self.reaches.iter().find(|(tree, reach)| state[*tree].abs() > *reach);
        if let Some((tree, reach)) = lost.copied() {
            return Some(Finish::RanAway { tree, reach });
        }
        self.count += 1;
        if self.count.is_multiple_of(LOOK_EVERY) {
            observer.progress(self.integrator.time() / self.settings.duration);
            if observer.cancelled() {
                return Some(Finish::Interrupted);
            }
        }
        None
    }
}

fn chattered(equations: &EquationsOfMotion, connection: usize, time: f64) -> Termination {
    let name = &equations.connections[connection].name;
    let detail = format!(
        "at t = {time:.9} s the {name} changes between contact and free play, or stick and slip, without \
         time passing; a damper that acts at every twist (damping_acts = \"always\") or \
         `--friction smoothed` goes through"
    );
    Termination::early(Reason::Chattering, detail)
}

/// Twists of this many times the limit of a law have nothing to hold them back: all equilibria of a
/// softening cubic lie within twice its limit.
const LOST: f64 = 4.0;

/// Tree twists whose laws have a limit on both sides, and how far is too far.
fn reaches(equations: &EquationsOfMotion) -> Vec<(usize, f64)> {
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
    let rates = largest(&state[n..2 * n]);
    let rate_scale = if fastest > 0.0 { scale * fastest } else { scale.max(rates) };
    let kinetic = 0.5 * lightest * rates * rates;
    let energy_scale = (stiffest * scale * scale).max(loading * scale).max(kinetic);
    let energy_scale = if energy_scale > 0.0 { energy_scale } else { 1.0 };
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
fn termination(
    finish: Result<ode::Finish, Error>,
    reached: f64,
) -> Result<Termination, AnalysisError> {
    let runs_away = "the motion runs away there; a softening shaft that is thrown past its \
                     capacity does that: see `halfshaft static`";
    match finish {
        Ok(ode::Finish::Reached) => Ok(Termination::completed()),
        Ok(ode::Finish::Interrupted) => Ok(Termination::early(
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
