//! From a line to the answer of `static`.

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_model::Driveline;
use halfshaft_model::question::Question;
use halfshaft_numerics::observer::Observer;
use halfshaft_results::{
    Column, Equilibrium, GearState, Named, Reason, RunningKind, ShaftCapacity, SharedLoad,
    StaticResult, Table, Termination,
};

use super::{
    Overload, RestStates, Shared, after_ramps, capacity, carries, find, find_stable, free_play,
    lowest_eigenvalue,
};
use crate::error::AnalysisError;
use crate::header::header;
use crate::modal::{by_connection, rest_result};

/// Answers `static`.
pub(crate) fn solve(
    line: &Driveline,
    observer: &dyn Observer,
) -> Result<StaticResult, AnalysisError> {
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
    let gears = gear_states(line, observer)?;
    let equilibria = listed(&equations, &states, observer)?;
    let mut header = header(line, &Question::Static);
    header.assumptions.push(running_sentence(&equations, &states));
    if !states.proven {
        header.assumptions.push(
            "shafts in loops share their torque; their equilibria were searched for from many \
             starts, which is not a proof that there are no others"
                .to_owned(),
        );
    }
    if let Some(count) = states.left_out {
        header.assumptions.push(format!(
            "of the {count:.0} combinations of twists in equilibrium the {} nearest to zero twist \
             are listed, stable ones first",
            states.states.len()
        ));
    }
    match states.primary() {
        Some(state) => header.warnings.extend(free_play(&equations, state)),
        None => header.warnings.push(overload_message(line, &equations, &states)),
    }
    header.warnings.extend(ramp_warning(&equations)?);
    let load = load_words(&equations);
    for (state, overload) in &gears {
        let Some(overload) = overload.as_ref().filter(|_| !state.exists) else { continue };
        let message = needs(&gear_subject(line, &load, state), &equations, overload);
        if !header.warnings.contains(&message) {
            header.warnings.push(message);
        }
    }
    if observer.cancelled() {
        let detail = "not all equilibria and gears are listed".to_owned();
        header.termination = Termination::early(Reason::Cancelled, detail);
    }
    Ok(StaticResult {
        header,
        // A list that the user cut short is not complete, whatever is proven of it.
        complete: states.is_complete() && equilibria.len() == states.states.len(),
        equilibria,
        torque_capacity: names().zip(torque_capacity).collect(),
        capacity: names().zip(capacities.iter().copied()).collect(),
        required_torque: required(&equations, &states),
        shared: shared(&equations, &states),
        running: states.running.result(&equations),
        gears: gears.into_iter().map(|(state, _)| state).collect(),
        curves: (0..capacities.len())
            .map(|index| {
                let twists = states.states.iter().map(|state| state.twists[index]);
                let curve = torque_curve(&equations, index, &capacities[index], twists);
                (equations.connections[index].name.clone(), curve)
            })
            .collect(),
    })
}

/// What a ramp that stays does to a line that holds before it.
fn ramp_warning(equations: &EquationsOfMotion) -> Result<Option<String>, AnalysisError> {
    let Some(after) = after_ramps(equations) else { return Ok(None) };
    let states = find_stable(&after)?;
    let Some(overload) = states.overload.as_ref().filter(|_| states.primary().is_none()) else {
        return Ok(None);
    };
    Ok(Some(needs("when the ramp has risen, the line", &after, overload)))
}

/// Work in floating-point operations that the eigenvalues of all states may take.
const EIGENVALUE_WORK: f64 = 1e10;

/// The states as results; as many as were made until the user stopped.
fn listed(
    equations: &EquationsOfMotion,
    states: &RestStates,
    observer: &dyn Observer,
) -> Result<Vec<Equilibrium>, AnalysisError> {
    #[expect(clippy::cast_precision_loss, reason = "a size")]
    let work = (equations.groups() as f64).powi(3);
    let mut spent = 0.0;
    let mut listed = Vec::with_capacity(states.states.len());
    for state in &states.states {
        if observer.cancelled() {
            break;
        }
        spent += work;
        let affordable = spent <= EIGENVALUE_WORK;
        let lowest = affordable.then(|| lowest_eigenvalue(equations, state)).transpose()?;
        listed.push(rest_result(equations, state, lowest));
    }
    Ok(listed)
}

/// Torque asked of each shaft that carries it alone.
fn required(equations: &EquationsOfMotion, states: &RestStates) -> Named<f64> {
    let of = |(index, asked): (usize, &Option<f64>)| {
        Some((equations.connections[index].name.clone(), (*asked)?))
    };
    states.asked.iter().enumerate().filter_map(of).collect()
}

/// The shafts that share a torque.
fn shared(equations: &EquationsOfMotion, states: &RestStates) -> Vec<SharedLoad> {
    let of = |shared: &Shared| SharedLoad {
        shafts: names(equations, &shared.connections),
        required_torque: shared.asked,
        capacity: shared.capacity,
    };
    states.shared.iter().map(of).collect()
}

fn names(equations: &EquationsOfMotion, connections: &[usize]) -> Vec<String> {
    connections.iter().map(|index| equations.connections[*index].name.clone()).collect()
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

/// The line in each gear of each gearbox that lists its ratios, with what is overloaded there.
fn gear_states(
    line: &Driveline,
    observer: &dyn Observer,
) -> Result<Vec<(GearState, Option<Overload>)>, AnalysisError> {
    let mut rows = Vec::new();
    for gear in line.gears() {
        let address = format!("{}.ratio", gear.name);
        let Ok(parameter) = line.parameter(&address) else { continue };
        for ratio in &gear.ratios {
            if observer.cancelled() {
                return Ok(rows);
            }
            let shifted = line.with(&parameter, *ratio)?;
            let equations = EquationsOfMotion::new(&shifted)?;
            let states = find_stable(&equations)?;
            let twist = states.primary().map(|state| by_connection(&equations, &state.twists));
            let first = states.overload.as_ref().map(|overload| overload.connections[0]);
            let state = GearState {
                gear: gear.name.clone(),
                ratio: *ratio,
                required_torque: required(&equations, &states),
                shared: shared(&equations, &states),
                exists: twist.is_some(),
                twist: twist.unwrap_or_default(),
                overloaded: first.map(|index| equations.connections[index].name.clone()),
            };
            rows.push((state, states.overload));
        }
    }
    Ok(rows)
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

fn gear_subject(line: &Driveline, load: &str, state: &GearState) -> String {
    let listed = line.gears().iter().filter(|gear| !gear.ratios.is_empty()).count();
    let gear = if listed == 1 { "gear" } else { state.gear.as_str() };
    format!("{gear} {}{load}", state.ratio)
}

/// "gear 1.79 at 850 N·m needs 8688 N·m on the half-shaft; its law carries 7814 N·m".
fn needs(subject: &str, equations: &EquationsOfMotion, overload: &Overload) -> String {
    let shafts = names(equations, &overload.connections).join(" and ");
    let Some(needed) = overload.asked.map(f64::abs) else {
        return format!(
            "{subject}: no stable state of {shafts}, which share their torque, was found"
        );
    };
    let (on, laws) = match overload.connections.len() {
        1 => (format!("the {shafts}"), ("its law", "carries", "holds")),
        _ => (format!("{shafts} together"), ("their laws", "carry", "hold")),
    };
    let carries = overload.limit.map(|limit| limit.torque.abs());
    let (asked, limit) = pair(needed, carries.unwrap_or(0.0));
    let carried = if carries.is_some() && asked == limit {
        format!("{} just that, at the limit where no state is stable", laws.1)
    } else if carries.is_some() {
        format!("{} {limit}", laws.1)
    } else {
        format!("{} no such torque in a stable state", laws.2)
    };
    format!("{subject} needs {asked} on {on}; {} {carried}", laws.0)
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
    match &states.overload {
        Some(overload) => needs(&subject, equations, overload),
        None => format!("{subject}: no stable state was found"),
    }
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
    let pieces = law.pieces();
    let joints = pieces.list().iter().map(|piece| piece.from.abs()).filter(|x| x.is_finite());
    let reach = equilibria.map(f64::abs).chain(turning).chain(joints).fold(0.0, f64::max);
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
