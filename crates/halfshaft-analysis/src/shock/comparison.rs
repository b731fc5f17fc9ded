//! All methods side by side, from one and the same disturbance.

use halfshaft_model::question::{ChannelQuantity, ShockEquation, ShockMethod, ShockQuestion};
use halfshaft_numerics::observer::Observer;
use halfshaft_results::{
    Column, HistoryResult, MethodRow, Reason, ShaftMetrics, Table, Termination,
};

use super::answer::ShockProblem;
use super::closed::ClosedMotion;
use super::full::{self, final_twists, shaft_metrics};
use super::metrics::between;
use super::multiple_scales::Expansion;
use super::single::{self, SingleEquation};
use crate::equilibrium;
use crate::error::AnalysisError;
use crate::time_response::TracePoint;

/// One method's account of the disturbance: `θ` over time and its metrics.
struct Account {
    method: String,
    equation: String,
    omega: f64,
    trace: Vec<TracePoint>,
    metrics: ShaftMetrics,
    /// Name of the account that its errors are against.
    reference: Option<&'static str>,
}

/// When phases are compared, s.
const PHASE_TIME: f64 = 2.0;

/// Adds the comparison to the answer. Methods that do not fit the line are left out.
pub(crate) fn add(
    problem: &ShockProblem<'_>,
    result: &mut HistoryResult,
    observer: &dyn Observer,
) -> Result<(), AnalysisError> {
    let start = start(problem)?;
    let mut accounts = vec![full_account(problem, start, observer)?];
    let equations = [ShockEquation::Twist, ShockEquation::Clamped, ShockEquation::Published];
    for equation in equations {
        let Ok(single) = single::reduce(&problem.equations, &problem.rest, equation) else {
            continue;
        };
        if problem.check_disturbed(&single, start.0, start.1).is_err() {
            continue;
        }
        accounts.extend(accounts_of(problem, &single, start, observer)?);
    }
    if observer.cancelled() {
        let detail = "the methods side by side are not complete".to_owned();
        result.header.termination = Termination::early(Reason::Cancelled, detail);
    }
    let rows = accounts.iter().map(|account| row(account, &accounts)).collect();
    let table = histories(&accounts, result.values("time"));
    if let Some(details) = &mut result.shock {
        details.comparison = rows;
        details.comparison_history = Some(table);
    }
    Ok(())
}

/// The disturbance as `θ` and `θ'` at time 0, whatever the method that was asked for calls it.
fn start(problem: &ShockProblem<'_>) -> Result<(f64, f64), AnalysisError> {
    if problem.question.method != ShockMethod::Full {
        return problem.single_start();
    }
    let state = problem.full_state()?;
    let n = problem.equations.groups();
    let tree = &problem.equations.network.tree;
    let main = tree.iter().position(|edge| edge.shaft == 0).unwrap_or(0);
    Ok((problem.rest.twists[0] - state[main], -state[n + main]))
}

fn full_account(
    problem: &ShockProblem<'_>,
    start: (f64, f64),
    observer: &dyn Observer,
) -> Result<Account, AnalysisError> {
    let equations = &problem.equations;
    let mut state = problem.full_state()?;
    if problem.question.method != ShockMethod::Full {
        // The same disturbance as twist: the load end ahead by θ.
        let n = equations.groups();
        let tree = &equations.network.tree;
        let main = tree.iter().position(|edge| edge.shaft == 0).unwrap_or(0);
        state[main] = problem.rest.twists[0] - start.0;
        state[n + main] = -start.1;
    }
    let run = full::integrate(equations, &state, problem.question, observer)?;
    let rest = final_twists(equations, &problem.rest.twists)?;
    let shafts = shaft_metrics(equations, &run, &rest, &problem.rest.torques);
    let twist = run.recorder.channels().of_connection(0, ChannelQuantity::Twist);
    let before = problem.rest.twists[0];
    let turned = |point: &TracePoint| TracePoint {
        time: point.time,
        value: before - point.value,
        slope: -point.slope,
    };
    let metrics = shafts.into_values().next().unwrap_or_default();
    let metrics = ShaftMetrics {
        first_peak: metrics.first_peak.map(|peak| -peak),
        first_rate_peak: metrics.first_rate_peak.map(|peak| -peak),
        ..metrics
    };
    Ok(Account {
        method: "full".to_owned(),
        equation: "the whole line".to_owned(),
        omega: equilibrium::lowest_eigenvalue(equations, &problem.rest)?.max(0.0).sqrt(),
        trace: run.recorder.traces[twist].iter().map(turned).collect(),
        metrics,
        reference: None,
    })
}

/// A single equation by integration and by both orders of multiple scales.
fn accounts_of(
    problem: &ShockProblem<'_>,
    single: &SingleEquation,
    start: (f64, f64),
    observer: &dyn Observer,
) -> Result<Vec<Account>, AnalysisError> {
    let (question, name) = (problem.question, single::name(single.equation));
    let mut accounts = Vec::new();
    // The twist equation by integration is the whole line over again, but for damping to ground.
    let reference = if single.equation == ShockEquation::Twist && !single.drag_left_out {
        "full"
    } else {
        accounts.push(integrated(single, question, start, observer)?);
        name
    };
    for (order, expansion) in [(1, Expansion::First), (2, Expansion::Second)] {
        let Ok(closed) = ClosedMotion::new(single, question, start, expansion, observer) else {
            continue;
        };
        accounts.push(Account {
            method: format!("multiple scales {order}, {name}"),
            equation: single.formula(),
            omega: single.oscillator.omega,
            trace: closed.trace(question.duration),
            metrics: closed.metrics(question.duration),
            reference: Some(reference),
        });
    }
    Ok(accounts)
}

fn integrated(
    single: &SingleEquation,
    question: &ShockQuestion,
    (x, v): (f64, f64),
    observer: &dyn Observer,
) -> Result<Account, AnalysisError> {
    let run = full::integrate(&single.surrogate, &[x, v, 0.0, 0.0], question, observer)?;
    let rest = final_twists(&single.surrogate, &[0.0])?;
    let shafts = shaft_metrics(&single.surrogate, &run, &rest, &[single.static_torque]);
    let twist = run.recorder.channels().of_connection(0, ChannelQuantity::Twist);
    Ok(Account {
        method: single::name(single.equation).to_owned(),
        equation: single.formula(),
        omega: single.oscillator.omega,
        trace: run.recorder.traces[twist].clone(),
        metrics: shafts.into_values().next().unwrap_or_default(),
        reference: Some("full"),
    })
}

fn row(account: &Account, accounts: &[Account]) -> MethodRow {
    let reference =
        account.reference.and_then(|name| accounts.iter().find(|other| other.method == name));
    let error = |of: fn(&ShaftMetrics) -> Option<f64>| {
        let reference = of(&reference?.metrics).filter(|reference| *reference != 0.0)?;
        Some(of(&account.metrics)? / reference - 1.0)
    };
    let phase_error = reference.and_then(|reference| phase_error(account, reference));
    MethodRow {
        method: account.method.clone(),
        equation: account.equation.clone(),
        first_peak: account.metrics.first_peak,
        first_peak_time: account.metrics.first_peak_time,
        first_rate_peak: account.metrics.first_rate_peak,
        oscillation_frequency: account.metrics.oscillation_frequency,
        decay_rate: account.metrics.decay_rate,
        first_peak_error: error(|metrics| metrics.first_peak),
        first_rate_peak_error: error(|metrics| metrics.first_rate_peak),
        largest_difference: reference.and_then(|reference| largest_difference(account, reference)),
        phase_error,
        reference: reference.map(|reference| reference.method.clone()),
    }
}

/// Largest distance between two histories over the first peak of the reference.
fn largest_difference(account: &Account, reference: &Account) -> Option<f64> {
    let peak = reference.metrics.first_peak?.abs();
    let apart = |point: &TracePoint| Some((value_at(account, point.time)? - point.value).abs());
    let largest = reference.trace.iter().filter_map(apart).fold(0.0, f64::max);
    (peak > 0.0).then(|| largest / peak)
}

/// `θ` of an account at a time; `None` outside its history.
fn value_at(account: &Account, time: f64) -> Option<f64> {
    let after = account.trace.partition_point(|point| point.time < time);
    let point = account.trace.get(after)?;
    if point.time == time {
        return Some(point.value);
    }
    let from = account.trace.get(after.checked_sub(1)?)?;
    Some(between(from, point, time).value)
}

/// By how much an account runs ahead of its reference at [`PHASE_TIME`], rad; whole vibrations
/// count 2π.
fn phase_error(account: &Account, reference: &Account) -> Option<f64> {
    let (first, turned) = phase(account)?;
    let (reference_first, reference_turned) = phase(reference)?;
    // Both begin at nearly the same angle, which may lie on either side of ±π.
    Some(wrapped(first - reference_first) + (turned - reference_turned))
}

/// Phase of the vibration: the angle of `(θ, -θ'/ω)` at first, and how far it has turned until
/// [`PHASE_TIME`], rad. `None` where the history is shorter.
fn phase(account: &Account) -> Option<(f64, f64)> {
    let mut turned = 0.0;
    let mut angles: Option<(f64, f64)> = None;
    for (index, point) in account.trace.iter().enumerate() {
        let at_end = point.time >= PHASE_TIME;
        let point = if at_end {
            let from = account.trace.get(index.checked_sub(1)?)?;
            &between(from, point, PHASE_TIME)
        } else {
            point
        };
        if point.value == 0.0 && point.slope == 0.0 {
            continue; // at rest before the disturbance
        }
        let angle = (-point.slope / account.omega).atan2(point.value);
        let (first, before) = angles.unwrap_or((angle, angle));
        turned += wrapped(angle - before);
        angles = Some((first, angle));
        if at_end {
            return Some((first, turned));
        }
    }
    None
}

/// The angle in (-π, π].
fn wrapped(angle: f64) -> f64 {
    use std::f64::consts::{PI, TAU};
    if angle > PI {
        angle - TAU
    } else if angle <= -PI {
        angle + TAU
    } else {
        angle
    }
}

/// Twist beyond equilibrium of every method on the answer's own times.
fn histories(accounts: &[Account], times: &[f64]) -> Table {
    let mut columns = vec![Column::new("time", "s", times.to_vec())];
    for account in accounts {
        let at = |time: &f64| value_at(account, *time).map_or(f64::NAN, |value| -value);
        let values = times.iter().map(at).collect();
        columns.push(Column::new(account.method.clone(), "rad", values));
    }
    Table::new(columns)
}
