//! From a line to the answer of `resonance --method averaged`.

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_model::Driveline;
use halfshaft_model::question::{DEFAULT_POINTS, Question, ResonanceQuestion};
use halfshaft_numerics::observer::Observer;
use halfshaft_results::{
    Branch, Column, Header, JumpSpeeds, Named, Reason, ResonanceResult, SpecialKind, SpecialPoint,
    Status, Table, Termination,
};

use super::columns::ChannelMaps;
use super::curve::{CurvePoint, PointKind, ResponseCurve};
use super::mode_equation::ModeEquation;
use super::responses::{Response, SlowFlow};
use super::scaling::scaling;
use crate::equilibrium::{self, RestState};
use crate::error::AnalysisError;
use crate::header::header;
use crate::modal::{choose_equilibrium, mode_label};
use crate::verification;

/// Answers `resonance` by averaging.
pub(crate) fn solve(
    line: &Driveline,
    question: &ResonanceQuestion,
    observer: &dyn Observer,
) -> Result<ResonanceResult, AnalysisError> {
    let equations = EquationsOfMotion::new(line)?;
    let states = equilibrium::find_stable(&equations)?;
    let rest = choose_equilibrium(line, &equations, &states, None)?;
    let modes = excited_modes(&equations, rest, question)?;
    let mut result = ResonanceResult {
        header: header(line, &Question::Resonance(question.clone())),
        branches: Vec::new(),
        scaling: Vec::new(),
        peaks: Vec::new(),
        backbones: Vec::new(),
        jumps: Vec::new(),
        verification: Vec::new(),
        effort: None,
    };
    let label = mode_label(&equations, rest, question.mode)?;
    let points = question.points.unwrap_or(DEFAULT_POINTS);
    for (mode, window) in &modes {
        far_off(mode, *window, &mut result.header);
        add_mode(&equations, mode, *window, points, &mut result);
        result.scaling.push(scaling(&equations, mode, label.clone()));
        say(&equations, mode, &mut result);
        if question.verify {
            verify(&equations, mode, *window, &mut result, observer)?;
        }
    }
    Ok(result)
}

/// Holds responses of a mode against periodic orbits of the full equations.
fn verify(
    equations: &EquationsOfMotion,
    mode: &ModeEquation,
    window: (f64, f64),
    result: &mut ResonanceResult,
    observer: &dyn Observer,
) -> Result<(), AnalysisError> {
    let points = verification::choose(mode, window);
    let Some(checked) = verification::periodic(equations, mode, &points, observer)? else {
        result.header.warnings.push(
            "not verified: the orders of the torques have no common period, so the full equations \
             have no periodic motion"
                .to_owned(),
        );
        return Ok(());
    };
    for missed in &checked.missed {
        result.header.warnings.push(format!(
            "no periodic motion of the full equations was found near the response of {:.4} rad \
             predicted at {:.4} rad/s",
            missed.rho(),
            mode.frequency(missed.sigma)
        ));
    }
    if checked.beyond > 0 {
        result.header.warnings.push(format!(
            "{} of {} responses were not held against the full equations, because they swing the {} \
             past the limit of its law",
            checked.beyond,
            points.len(),
            equations.connections[mode.reference].name
        ));
    }
    if checked.cancelled {
        let detail = format!(
            "{} of {} responses were held against the full equations",
            checked.points.len(),
            points.len()
        );
        result.header.termination = Termination::early(Reason::Cancelled, detail);
    }
    result.verification.extend(checked.points);
    Ok(())
}

/// A mode under one order, with the range of Ω to show.
type ExcitedMode = (ModeEquation, (f64, f64));

/// The mode under each order that meets it in the range.
fn excited_modes(
    equations: &EquationsOfMotion,
    rest: &RestState,
    question: &ResonanceQuestion,
) -> Result<Vec<ExcitedMode>, AnalysisError> {
    let known = equations.excitation.orders();
    if known.is_empty() {
        let reason = "no torque has an amplitude".to_owned();
        return Err(AnalysisError::NoExcitation { reason });
    }
    if let Some(order) = question.order.filter(|order| !known.contains(order)) {
        let known: Vec<String> = known.iter().map(f64::to_string).collect();
        let reason =
            format!("no torque has the order {order}; the orders are {}", known.join(", "));
        return Err(AnalysisError::NoExcitation { reason });
    }
    let orders = question.order.map_or(known, |order| vec![order]);
    let mut modes = Vec::new();
    let mut deaf = true;
    for order in orders {
        let mode = ModeEquation::new(equations, rest, question.mode, order)?;
        // What a node of the mode is driven by vanishes only to rounding.
        if mode.f <= 1e-12 * equations.excitation.scale() / mode.inertia {
            continue;
        }
        deaf = false;
        let window = question.frequency.unwrap_or_else(|| default_window(&mode));
        let resonance = mode.frequency(0.0);
        if question.order.is_some() || (window.0 <= resonance && resonance <= window.1) {
            modes.push((mode, window));
        }
    }
    if deaf {
        let reason =
            format!("no torque moves mode {}: they act where it stands still", question.mode);
        return Err(AnalysisError::NoExcitation { reason });
    }
    if modes.is_empty() {
        // Off resonance the averaged answer is still an answer, if a rough one.
        let order = equations.excitation.orders()[0];
        let mode = ModeEquation::new(equations, rest, question.mode, order)?;
        let window = question.frequency.unwrap_or_else(|| default_window(&mode));
        modes.push((mode, window));
    }
    Ok(modes)
}

/// Detuning, as part of the natural frequency, below which averaging is not asked.
pub(super) const MOST_DETUNED: f64 = 0.95;

/// Range of Ω that shows the resonance: several widths of it and all of its bend.
pub(crate) fn default_window(mode: &ModeEquation) -> (f64, f64) {
    let flow = mode.slow_flow();
    let mut reach = 8.0 * mode.beta / 2.0;
    let mut bend = (0.0_f64, 0.0_f64);
    let marks = flow.folds().into_iter().chain(flow.peak());
    for sigma in marks.map(|response| response.sigma).filter(|sigma| sigma.is_finite()) {
        bend = (bend.0.min(sigma), bend.1.max(sigma));
    }
    reach = reach.max(bend.1 - bend.0).clamp(1e-3 * mode.omega, 0.5 * mode.omega);
    let low = (bend.0.max(-0.8 * mode.omega) - reach).max(-MOST_DETUNED * mode.omega);
    let high = bend.1.min(2.0 * mode.omega) + reach;
    (mode.frequency(low), mode.frequency(high))
}

fn add_mode(
    equations: &EquationsOfMotion,
    mode: &ModeEquation,
    (from, to): (f64, f64),
    points: usize,
    result: &mut ResonanceResult,
) {
    let flow = mode.slow_flow();
    let maps = ChannelMaps::new(equations, mode);
    let window = (mode.sigma(from), mode.sigma(to));
    let curve = ResponseCurve::new(&flow, window, points);
    for piece in &curve.pieces {
        result.branches.push(branch(mode, &maps, piece));
    }
    if let Some(peak) = flow.peak() {
        result.peaks.push(maps.values(mode, &peak));
    }
    result.backbones.push(backbone(mode, &flow, &maps, window));
    let channel = format!("{}.twist", equations.connections[mode.reference].name);
    result.jumps.extend(jumps(mode, &flow, window, &channel));
}

fn branch(mode: &ModeEquation, maps: &ChannelMaps, piece: &[CurvePoint]) -> Branch {
    let responses: Vec<Response> = piece.iter().map(|point| point.response).collect();
    let special = |point: &CurvePoint| {
        let kind = match point.kind {
            PointKind::Fold => SpecialKind::Fold,
            PointKind::End => SpecialKind::End,
            PointKind::Regular | PointKind::Peak => return None,
        };
        let mut values = maps.values(mode, &point.response);
        values.retain(|name, _| !matches!(name, "stable" | "unstable_dimension"));
        Some(SpecialPoint::new(kind, Status::Located, values))
    };
    let special_points = piece.iter().filter_map(special).collect();
    Branch::plain(maps.columns(mode, &responses), special_points)
}

/// Points on a backbone.
const BACKBONE_POINTS: u32 = 120;

/// The backbone `σ = g(ρ²)` up to a little beyond the peak, within the window.
fn backbone(mode: &ModeEquation, flow: &SlowFlow, maps: &ChannelMaps, window: (f64, f64)) -> Table {
    let highest = flow.peak().map_or(1.0, |peak| peak.rho()) * 1.1;
    let responses: Vec<Response> = (0..=BACKBONE_POINTS)
        .map(|k| {
            let rho = highest * f64::from(k) / f64::from(BACKBONE_POINTS);
            Response { sigma: flow.bend(rho * rho), z: rho * rho, beyond: 0.0 }
        })
        .take_while(|response| response.sigma >= window.0 && response.sigma <= window.1)
        .collect();
    let of = |value: &dyn Fn(&Response) -> f64| responses.iter().map(value).collect::<Vec<f64>>();
    let mut columns = vec![
        Column::new("frequency", "rad/s", of(&|r| mode.frequency(r.sigma))),
        Column::new("sigma", "rad/s", of(&|r| r.sigma)),
        Column::new("rho", "rad", of(&Response::rho)),
    ];
    let rows: Vec<Named<f64>> = responses.iter().map(|r| maps.harmonics(mode, r)).collect();
    for (name, unit) in maps.harmonic_names() {
        let values = rows.iter().map(|row| row[name.as_str()]).collect();
        columns.push(Column::new(name, unit, values));
    }
    Table::new(columns)
}

/// Jumps of slow sweeps: at each fold in the window, where the stable branch ends.
fn jumps(
    mode: &ModeEquation,
    flow: &SlowFlow,
    (from, to): (f64, f64),
    channel: &str,
) -> Vec<JumpSpeeds> {
    let folds = flow.folds();
    let inside = folds.iter().filter(|fold| fold.sigma >= from && fold.sigma <= to);
    inside
        .filter_map(|fold| {
            let sweep = if turns_back(flow, fold, &folds)? { "up" } else { "down" };
            let frequency = mode.frequency(fold.sigma);
            let far = |response: &Response| (response.z / fold.z - 1.0).abs() > 1e-5;
            let after = flow
                .responses(fold.sigma)
                .into_iter()
                .filter(|response| far(response) && flow.is_stable(response))
                .min_by(|a, b| {
                    let distance = |r: &Response| (r.rho() - fold.rho()).abs();
                    distance(a).total_cmp(&distance(b))
                });
            Some(JumpSpeeds {
                sweep: sweep.to_owned(),
                frequency,
                rpm: frequency * 30.0 / std::f64::consts::PI,
                channel: channel.to_owned(),
                before: fold.rho(),
                after: after.map(|response| response.rho()),
            })
        })
        .collect()
}

/// Whether the curve lies below the fold in frequency: then sweeps upwards jump there.
fn turns_back(flow: &SlowFlow, fold: &Response, folds: &[Response]) -> Option<bool> {
    // Towards smaller amplitudes, since just above the fold the curve may end at its peak; and
    // not past the neighbouring fold near a cusp.
    let room = folds
        .iter()
        .filter(|other| other.z < fold.z)
        .map(|other| 1.0 - other.z / fold.z)
        .fold(f64::INFINITY, f64::min);
    let near = flow.at(fold.z * (1.0 - (room / 3.0).min(1e-4)), fold.beyond > 0.0)?;
    Some(near.sigma < fold.sigma)
}

/// Detuning, as part of the natural frequency, beyond which averaging is only a rough guide.
const FAR: f64 = 0.5;

/// Warns where a range asked for lies far from the resonance.
fn far_off(mode: &ModeEquation, (from, to): (f64, f64), header: &mut Header) {
    let own = mode.frequency(0.0);
    if from < (1.0 - FAR - 1e-6) * own || to > (1.0 + FAR + 1e-6) * own {
        header.warnings.push(format!(
            "averaging speaks of speeds near {own:.4} rad/s, the resonance of mode {}; towards the ends \
             of the range from {from:.4} to {to:.4} rad/s it is a rough guide at best, and other modes \
             are left out (--verify shows by how much)",
            mode.mode
        ));
    }
}

/// What the reader must know of the averaged answer.
fn say(equations: &EquationsOfMotion, mode: &ModeEquation, result: &mut ResonanceResult) {
    let header = &mut result.header;
    header.assumptions.push(
        "averaging of one mode near its resonance: other modes and other orders are left out, and \
         the frequency stands near the natural one"
            .to_owned(),
    );
    if mode.restoring[4] != 0.0 || mode.restoring[6] != 0.0 {
        header.assumptions.push(
            "even terms of the law beyond the quadratic one are left out; quintic and septic terms \
             count to first order"
                .to_owned(),
        );
    }
    let room = equilibrium::room(equations, mode.reference, &mode.rest_twists);
    let flow = mode.slow_flow();
    let largest = flow.largest_z().sqrt();
    let name = &equations.connections[mode.reference].name;
    if largest.is_finite() && largest > room {
        header.warnings.push(format!(
            "at its peak the {name} swings by {largest:.4} rad, past the {room:.4} rad that are left to \
             the limit of its law: the line would give way there, which averaging does not see"
        ));
    }
    let jumps = flow.folds().iter().map(Response::rho).fold(f64::INFINITY, f64::min);
    if jumps.is_finite() && jumps > room {
        header.warnings.push(format!(
            "the jumps begin at a swing of {jumps:.4} rad, past the {room:.4} rad that are left to the \
             limit of the law of the {name}: the shaft would give way before it jumps"
        ));
    }
    let threshold = flow.threshold().filter(|_| jumps.is_infinite());
    if let Some((_, z)) = threshold.filter(|(_, z)| z.sqrt() > room) {
        header.assumptions.push(format!(
            "a jump is out of reach: it would begin at a swing of {:.4} rad, but from rest the law of \
             the {name} carries only to {room:.4} rad, so the shaft would give way first",
            z.sqrt()
        ));
    }
    if mode.beta <= 0.0 {
        header.warnings.push(
            "without damping the response has no peak and is never asymptotically stable"
                .to_owned(),
        );
    }
    if mode.beta > 0.2 * mode.omega {
        header.warnings.push(format!(
            "the damping ratio of the mode is {:.3}: averaging is for light damping",
            mode.beta / (2.0 * mode.omega)
        ));
    }
}
