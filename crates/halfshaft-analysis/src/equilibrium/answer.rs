//! From a line to the answer of `static`.

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_model::Driveline;
use halfshaft_model::question::{Question, Verb};
use halfshaft_results::{
    Column, GearState, Named, RunningKind, ShaftCapacity, StaticResult, Table,
};

use super::{RestStates, capacity, carries, find};
use crate::error::AnalysisError;
use crate::header::header;
use crate::modal::{by_connection, rest_result};

/// Answers `static`.
pub(crate) fn solve(line: &Driveline) -> Result<StaticResult, AnalysisError> {
    let equations = EquationsOfMotion::new(line)?;
    let states = find(&equations)?;
    let capacities: Vec<ShaftCapacity> =
        equations.connections.iter().map(|connection| capacity(&connection.law)).collect();
    let asked = |index: usize| {
        let carried = states.primary().map(|state| state.torques[index]);
        states.asked[index].or(carried).unwrap_or(0.0)
    };
    let names = || equations.connections.iter().map(|connection| connection.name.clone());
    let torque_capacity =
        (0..capacities.len()).map(|index| carries(&capacities[index], asked(index)));
    let gears = gear_states(line)?;
    let mut header = header(line, Verb::Static, &Question::Static);
    header.assumptions.push(running_sentence(&equations, &states));
    if !states.complete {
        header.assumptions.push(
            "shafts in loops share their torque; their equilibria were searched for from many \
             starts, which is not a proof that there are no others"
                .to_owned(),
        );
    }
    if states.primary().is_none() {
        header.warnings.push(overload_message(line, &equations, &states));
    }
    let load = load_words(&equations);
    for state in gears.iter().filter(|state| !state.exists) {
        let message = gear_message(line, &load, state, torque_capacity_of(&equations, state));
        if !header.warnings.contains(&message) {
            header.warnings.push(message);
        }
    }
    Ok(StaticResult {
        header,
        equilibria: states
            .states
            .iter()
            .map(|state| rest_result(&equations, state))
            .collect::<Result<_, _>>()?,
        complete: states.complete,
        torque_capacity: names().zip(torque_capacity).collect(),
        capacity: names().zip(capacities.iter().copied()).collect(),
        required_torque: required(&equations, &states),
        running: states.running.result(&equations),
        gears,
        curves: (0..capacities.len())
            .map(|index| {
                let twists = states.states.iter().map(|state| state.twists[index]);
                let curve = torque_curve(&equations, index, &capacities[index], twists);
                (equations.connections[index].name.clone(), curve)
            })
            .collect(),
    })
}

/// Torque asked of each shaft: by statics alone, else in the stable state.
fn required(equations: &EquationsOfMotion, states: &RestStates) -> Named<f64> {
    let carried = |index: usize| states.primary().map(|state| state.torques[index]);
    let of = |(index, asked): (usize, &Option<f64>)| {
        Some((equations.connections[index].name.clone(), asked.or_else(|| carried(index))?))
    };
    states.asked.iter().enumerate().filter_map(of).collect()
}

/// How the line runs, as a sentence.
fn running_sentence(equations: &EquationsOfMotion, states: &RestStates) -> String {
    let running = states.running.result(equations);
    let node = &running.node;
    match running.kind {
        RunningKind::Held => "the line is held at ground".to_owned(),
        RunningKind::Balanced if running.balancing.is_empty() => {
            "the mean torques balance: the line runs at any constant speed".to_owned()
        }
        RunningKind::Balanced => {
            let torques: Vec<String> = running
                .balancing
                .iter()
                .map(|(name, torque)| format!("{name} takes {torque:.6} N·m"))
                .collect();
            format!("steady running: {} to balance the other mean torques", torques.join(", "))
        }
        RunningKind::Accelerating => format!(
            "the mean torques do not balance: the line accelerates uniformly, {node} at {:.6} \
             rad/s², and the twists are those in the accelerating line",
            running.acceleration
        ),
        RunningKind::SteadySpeed => format!(
            "damping to ground balances the mean torques when {node} turns at {:.6} rad/s; the \
             twists are those at that speed",
            running.speed
        ),
    }
}

/// The line in each gear of each gearbox that lists its ratios.
fn gear_states(line: &Driveline) -> Result<Vec<GearState>, AnalysisError> {
    let mut rows = Vec::new();
    for gear in line.gears() {
        let address = format!("{}.ratio", gear.name);
        let Ok(parameter) = line.parameter(&address) else { continue };
        for ratio in &gear.ratios {
            let shifted = line.with(&parameter, *ratio)?;
            let equations = EquationsOfMotion::new(&shifted)?;
            let states = find(&equations)?;
            let twist = states.primary().map(|state| by_connection(&equations, &state.twists));
            let overloaded = states.overload.map(|overload| overload.connection);
            rows.push(GearState {
                gear: gear.name.clone(),
                ratio: *ratio,
                required_torque: required(&equations, &states),
                exists: twist.is_some(),
                twist: twist.unwrap_or_default(),
                overloaded: overloaded.map(|index| equations.connections[index].name.clone()),
            });
        }
    }
    Ok(rows)
}

fn torque_capacity_of(equations: &EquationsOfMotion, state: &GearState) -> Option<f64> {
    let index = equations.connection(state.overloaded.as_deref()?)?;
    let load = state.required_torque.get(state.overloaded.as_deref()?).copied().unwrap_or(0.0);
    carries(&capacity(&equations.connections[index].law), load)
}

/// The torque that loads the line: " at 850 N·m", or nothing where several sources load it.
fn load_words(equations: &EquationsOfMotion) -> String {
    let sources = equations.excitation.sources.iter();
    let loading: Vec<_> = sources.filter(|source| !source.balances && source.mean != 0.0).collect();
    match loading.as_slice() {
        [source] => format!(" at {} N·m", round(source.mean.abs())),
        _ => String::new(),
    }
}

/// Four significant digits and no needless zeros.
fn round(value: f64) -> String {
    if value.abs() >= 1000.0 {
        format!("{value:.0}")
    } else {
        format!("{}", (value * 1e3).round() / 1e3)
    }
}

fn gear_message(line: &Driveline, load: &str, state: &GearState, carries: Option<f64>) -> String {
    let listed = line.gears().iter().filter(|gear| !gear.ratios.is_empty()).count();
    let gear = if listed == 1 { "gear" } else { state.gear.as_str() };
    let subject = format!("{gear} {}{load}", state.ratio);
    needs(&subject, state.overloaded.as_deref(), &state.required_torque, carries)
}

fn needs(
    subject: &str,
    shaft: Option<&str>,
    required: &Named<f64>,
    carries: Option<f64>,
) -> String {
    let Some(shaft) = shaft else { return format!("{subject}: no stable state was found") };
    let needed = required.get(shaft).copied().unwrap_or(0.0).abs();
    let carried = carries.map_or_else(
        || "holds no such torque in a stable state".to_owned(),
        |carries| format!("carries {}", pair(needed, carries).1),
    );
    format!(
        "{subject} needs {} on the {shaft}; its law {carried}",
        pair(needed, carries.unwrap_or(0.0)).0
    )
}

/// Two torques with as few digits as tell them apart.
fn pair(a: f64, b: f64) -> (String, String) {
    let texts = |digits: usize| (format!("{a:.digits$} N·m"), format!("{b:.digits$} N·m"));
    (0..6).map(texts).find(|(a, b)| a != b).unwrap_or_else(|| texts(0))
}

/// Why no stable state exists, with numbers: "gear 1.79 at 850 N·m needs 8688 N·m on the
/// half-shaft; its law carries 7814 N·m".
pub(crate) fn overload_message(
    line: &Driveline,
    equations: &EquationsOfMotion,
    states: &RestStates,
) -> String {
    let load = load_words(equations);
    let boxes: Vec<_> = line.gears().iter().filter(|gear| !gear.ratios.is_empty()).collect();
    let subject = match boxes.as_slice() {
        [gear] => format!("gear {}{load}", gear.ratio),
        _ if load.is_empty() => "the mean torque".to_owned(),
        _ => format!("the mean torque{load}"),
    };
    let Some(overload) = states.overload else {
        return format!("{subject}: no stable state was found");
    };
    let name = equations.connections[overload.connection].name.clone();
    let required: Named<f64> = [(name.clone(), overload.asked)].into_iter().collect();
    let carries = overload.limit.map(|limit| limit.torque.abs());
    needs(&subject, Some(&name), &required, carries)
}

/// Points on a torque-twist curve.
const CURVE_POINTS: u32 = 401;

/// Torque and tangent stiffness of one shaft over the twists that matter: past its limits
/// and past every equilibrium.
fn torque_curve(
    equations: &EquationsOfMotion,
    index: usize,
    capacity: &ShaftCapacity,
    equilibria: impl Iterator<Item = f64>,
) -> Table {
    let law = &equations.connections[index].law;
    let limits = [capacity.positive, capacity.negative];
    let turning = limits.iter().flatten().map(|limit| limit.twist.abs());
    let reach = equilibria.map(f64::abs).chain(turning).fold(0.0, f64::max);
    let reach = 1.25 * if reach > 0.0 { reach } else { 1.0 };
    let twists: Vec<f64> = (0..CURVE_POINTS)
        .map(|i| reach * (2.0 * f64::from(i) / f64::from(CURVE_POINTS - 1) - 1.0))
        .collect();
    let torques = twists.iter().map(|x| law.torque(*x)).collect();
    let stiffness = twists.iter().map(|x| law.stiffness(*x)).collect();
    Table::new(vec![
        Column::new("twist", "rad", twists),
        Column::new("torque", "N·m", torques),
        Column::new("stiffness", "N·m/rad", stiffness),
    ])
}
