//! A shock by integration of a line: the whole one, or the surrogate of a single equation.

use halfshaft_dynamics::{Active, EquationsOfMotion};
use halfshaft_model::question::{ChannelQuantity, IntegratorChoice, ShockQuestion};
use halfshaft_numerics::observer::Observer;
use halfshaft_results::{Named, ShaftMetrics};

use super::metrics::{Response, metrics};
use crate::equilibrium;
use crate::error::AnalysisError;
use crate::time_response::{DEFAULT_PARTS, Run, RunSettings, run};

/// Integrates a line after a disturbance from `state`.
pub(crate) fn integrate<'l>(
    equations: &'l EquationsOfMotion,
    state: &[f64],
    question: &ShockQuestion,
    observer: &dyn Observer,
) -> Result<Run<'l>, AnalysisError> {
    let settings = RunSettings {
        active: Active::shock(),
        duration: question.duration,
        tolerance: question.tolerance,
        step: question.step.unwrap_or(question.duration / DEFAULT_PARTS),
        record: (0.0, question.duration),
        follow: true,
        exact_friction: true,
        integrator: IntegratorChoice::Automatic,
        orders: None,
    };
    run(equations, state, &settings, observer)
}

/// Whether any pulse acts on the line.
pub(crate) fn has_pulse(equations: &EquationsOfMotion) -> bool {
    equations.excitation.sources.iter().any(|source| {
        source.pulse.as_ref().is_some_and(|p| p.angular_impulse() != 0.0 && source.ratio != 0.0)
    })
}

/// When the last pulse has run its course (a ramp: has risen), s.
pub(crate) fn disturbance_end(equations: &EquationsOfMotion) -> f64 {
    let pulses = equations.excitation.sources.iter().filter_map(|source| source.pulse.as_ref());
    pulses.map(halfshaft_model::elements::Pulse::end_s).fold(0.0, f64::max)
}

/// Twist of every connection when all has settled: the stable equilibrium under the mean
/// torques and what ramps leave behind; the old twists where there is none.
pub(crate) fn final_twists(
    equations: &EquationsOfMotion,
    before: &[f64],
) -> Result<Vec<f64>, AnalysisError> {
    let Some(after) = equilibrium::after_ramps(equations) else { return Ok(before.to_vec()) };
    let states = equilibrium::find_stable(&after)?;
    Ok(states.primary().map_or_else(|| before.to_vec(), |state| state.twists.clone()))
}

/// Metrics of every shaft after a run that started about the given twists and torques.
pub(crate) fn shaft_metrics(
    equations: &EquationsOfMotion,
    run: &Run<'_>,
    rest: &[f64],
    static_torques: &[f64],
) -> Named<ShaftMetrics> {
    let free_from = disturbance_end(equations);
    let recorder = &run.recorder;
    let of = |index: usize| {
        let channel = |quantity| recorder.channels().of_connection(index, quantity);
        let (twist, rate) = (channel(ChannelQuantity::Twist), channel(ChannelQuantity::TwistRate));
        metrics(&Response {
            trace: &recorder.traces[twist],
            turning: &recorder.turning[twist],
            rate_turning: &recorder.turning[rate],
            rest: rest[index],
            free_from,
            peak_torque: recorder.largest(channel(ChannelQuantity::Torque)),
            static_torque: static_torques[index],
        })
    };
    let names = equations.connections.iter().map(|connection| connection.name.clone());
    names.enumerate().map(|(index, name)| (name, of(index))).collect()
}
