//! From a line to the answer of `simulate`.

use halfshaft_dynamics::{Active, EquationsOfMotion, Motion};
use halfshaft_model::Driveline;
use halfshaft_model::question::{DryFriction, Question, SimulateQuestion, Start};
use halfshaft_numerics::observer::Observer;
use halfshaft_results::{
    Column, EnergyBalance, Header, HistoryMetrics, HistoryResult, Named, OrderMap, Reason,
    ShaftMetrics, Table,
};

use super::initial::start_state;
use super::recorder::Recorder;
use super::run::{Run, RunSettings, run};
use crate::equilibrium::{self, RestStates};
use crate::error::AnalysisError;
use crate::header::header;
use crate::shock::shaft_metrics;

/// Parts of the recorded time that a history has by default.
pub(crate) const DEFAULT_PARTS: f64 = 2000.0;

/// Answers `simulate`.
pub(crate) fn solve(
    line: &Driveline,
    question: &SimulateQuestion,
    observer: &dyn Observer,
) -> Result<HistoryResult, AnalysisError> {
    let equations = EquationsOfMotion::new(line)?;
    let active = Active { acceleration: question.acceleration, ..Active::all(question.frequency) };
    let mut motion = Motion::new(&equations, active, true);
    let state = start_state(line, &mut motion, question.start, &question.initial)?;
    let record = question.record.unwrap_or((0.0, question.duration));
    let settings = RunSettings {
        active,
        duration: question.duration,
        tolerance: question.tolerance,
        step: question.step.unwrap_or((record.1 - record.0) / DEFAULT_PARTS),
        record,
        follow: question.frequency.is_none(),
        integrator: question.integrator,
        orders: question.orders.clone(),
        exact_friction: question.friction == DryFriction::Exact,
    };
    let run = run(&equations, &state, &settings, observer)?;

    let mut header = header(line, &Question::Simulate(question.clone()));
    header.termination = run.termination.clone();
    header.assumptions.push(start_sentence(question));
    let orders = equations.excitation.orders();
    if question.frequency.is_none() && !orders.is_empty() {
        header.warnings.push(
            "torques of an order are silent, because no excitation speed was given; add \
             --frequency"
                .to_owned(),
        );
    }
    let states = equilibrium::find_stable(&equations)?;
    if states.primary().is_none() {
        header.warnings.push(equilibrium::overload_message(line, &equations, &states));
    }
    energy_warning(&mut header, &run.energy, question.tolerance);
    let metrics = HistoryMetrics {
        shafts: transient_metrics(&equations, question, &state, &states, &run),
        nodes: run.recorder.nodes(),
        channels: channel_metrics(&run.recorder),
        energy_balance: Some(run.energy),
        events: run.events.summary(question.duration),
        integrators: run.integrators.clone(),
        steps: run.steps,
        evaluations: run.evaluations,
    };
    let Run { recorder, events, .. } = run;
    if events.count > events.listed.len() {
        header.warnings.push(format!(
            "of {} events the first {} are listed; --record keeps a part of the run",
            events.count,
            events.listed.len()
        ));
    }
    let orders = order_map(&equations, &recorder).map(Box::new);
    let section = section(&recorder);
    let (columns, events) = (history_columns(recorder), events.listed);
    Ok(HistoryResult { header, columns, metrics, events, orders, section, shock: None })
}

/// How the shafts take a transient: against the state at time zero and that in which all settles. Nothing
/// settles under a lasting excitation.
fn transient_metrics(
    equations: &EquationsOfMotion,
    question: &SimulateQuestion,
    state: &[f64],
    states: &RestStates,
    run: &Run<'_>,
) -> Named<ShaftMetrics> {
    let own = |source: &halfshaft_dynamics::Source| {
        source.own_frequency.is_some() && !source.harmonics.is_empty()
    };
    let lasting = question.frequency.is_some() || equations.excitation.sources.iter().any(own);
    let settled = equilibrium::after_ramps(equations);
    let settled = settled.and_then(|after| equilibrium::find_stable(&after).ok());
    let settled = settled.as_ref().unwrap_or(states).primary();
    let (false, Some(settled)) = (lasting, settled) else { return Named::default() };
    let mut motion = Motion::new(equations, Active::all(None), true);
    let before = motion.kinematics(state).twists.clone();
    let torque = |(c, x): (&halfshaft_dynamics::Connection, &f64)| c.law.torque(*x);
    let torques: Vec<f64> = equations.connections.iter().zip(&before).map(torque).collect();
    let mut shafts = shaft_metrics(equations, run, &settled.twists, &torques);
    for (index, metrics) in shafts.values_mut().enumerate() {
        metrics.final_torque = Some(settled.torques[index]);
        let way = settled.twists[index] - before[index];
        metrics.overshoot = metrics.first_peak.map(|peak| peak / way).filter(|o| o.is_finite());
    }
    shafts
}

/// The spectra over the orders of the excitation.
fn order_map(equations: &EquationsOfMotion, recorder: &Recorder<'_>) -> Option<OrderMap> {
    let track = recorder.track.as_ref()?;
    let info = recorder.channels().list.get(track.channel)?;
    track.spectra((&info.name, info.unit), &equations.excitation.orders())
}

/// The states at whole revolutions.
fn section(recorder: &Recorder<'_>) -> Option<Table> {
    if recorder.section.is_empty() {
        return None;
    }
    let of = |at: usize| recorder.section.iter().map(|row| row[at]).collect::<Vec<f64>>();
    let mut columns = vec![Column::new("time", "s", of(0))];
    let list = &recorder.channels().list;
    for (place, at) in recorder.channels().of_section().enumerate() {
        columns.push(Column::new(list[at].name.clone(), list[at].unit, of(place + 1)));
    }
    Some(Table::new(columns))
}

fn start_sentence(question: &SimulateQuestion) -> String {
    let from = match question.start {
        Start::Rest => "everything at zero (--start equilibrium begins in steady running)",
        Start::Equilibrium => "the stable equilibrium under the mean torques",
    };
    if question.initial.is_empty() {
        return format!("the run starts from {from}");
    }
    let values: Vec<String> = question
        .initial
        .iter()
        .map(|value| {
            let unit = value.channel.quantity.kind().si_unit();
            format!("{} = {} {unit}", value.channel.name(), value.value)
        })
        .collect();
    format!("the run starts from {from}, with {}", values.join(", "))
}

/// The history as columns: time, then the channels.
pub(crate) fn history_columns(recorder: Recorder<'_>) -> Vec<Column> {
    let mut columns = vec![Column::new("time", "s", recorder.times().to_vec())];
    let names: Vec<(String, &str)> =
        recorder.channels().list.iter().map(|info| (info.name.clone(), info.unit)).collect();
    for ((name, unit), values) in names.into_iter().zip(recorder.history) {
        columns.push(Column::new(name, unit, values));
    }
    columns
}

/// Extremes of every channel.
pub(crate) fn channel_metrics(recorder: &Recorder<'_>) -> Named<halfshaft_results::ChannelMetrics> {
    let list = &recorder.channels().list;
    list.iter().enumerate().map(|(i, info)| (info.name.clone(), recorder.metrics(i))).collect()
}

/// Warns where the energy does not close to what the tolerance promises.
pub(crate) fn energy_warning(header: &mut Header, energy: &EnergyBalance, tolerance: f64) {
    // Errors of many steps add up; a thousand tolerances is where they begin to matter. A motion
    // that runs away has no scale to judge them by.
    let fair = [Reason::Completed, Reason::Cancelled, Reason::StepLimit];
    if fair.contains(&header.termination.reason)
        && energy.relative_residual > 1e3 * tolerance.max(1e-15)
    {
        header.warnings.push(format!(
            "the energy balance is open by {:.2e} of the energy turned over; ask for a tighter \
             --tolerance",
            energy.relative_residual
        ));
    }
}
