//! From a line to the answer of `modes`.

use halfshaft_dynamics::{Connection, EquationsOfMotion};
use halfshaft_model::Driveline;
use halfshaft_model::question::{ModesQuestion, Question};
use halfshaft_numerics::Complex;
use halfshaft_results::{Equilibrium, Mode, ModesInGear, ModesResult, Named};

use super::elastic::{ALL_UP_TO, ElasticMode, lowest_modes};
use super::label::label;
use super::sparse::elastic_count;
use super::vibration::{Vibration, gears};
use crate::equilibrium::{self, RestState, RestStates};
use crate::error::AnalysisError;
use crate::header::header;

/// Modes that are listed of a long line where nobody says how many.
const OF_A_LONG_LINE: usize = 20;

/// Answers `modes`.
pub(crate) fn solve(
    line: &Driveline,
    question: &ModesQuestion,
) -> Result<ModesResult, AnalysisError> {
    let vibration = Vibration::of(line, question.equilibrium)?;
    let Vibration { equations, state } = &vibration;
    let all = elastic_count(equations);
    let long = equations.groups() > ALL_UP_TO;
    let count = question.count.unwrap_or(if long { OF_A_LONG_LINE } else { all }).min(all);
    let undamped = vibration.modes(count)?;
    let pairs = vibration.damped(&undamped)?;
    let mut modes = Vec::with_capacity(undamped.len() + 1);
    if let (Some(rigid), Some(pair)) = (&equations.rigid, pairs.rigid) {
        modes.push(rigid_mode(equations, &rigid.speeds, pair));
    }
    for (mode, pair) in undamped.iter().zip(&pairs.elastic) {
        modes.push(elastic_mode(equations, state, mode, *pair));
    }
    let mut header = header(line, &Question::Modes(question.clone()));
    vibration.told(&mut header);
    Ok(ModesResult {
        header,
        equilibrium: rest_result(equations, state, true)?,
        modes,
        elastic_modes: (count < all).then_some(all),
        gears: if question.equilibrium.is_none() { in_gears(line, OF_A_GEAR)? } else { Vec::new() },
    })
}

/// Modes that are listed gear by gear.
const OF_A_GEAR: usize = 6;

/// The lowest modes in every gear; none without a list of ratios, and in gears without a stable state.
pub(crate) fn in_gears(line: &Driveline, count: usize) -> Result<Vec<ModesInGear>, AnalysisError> {
    let mut rows = Vec::new();
    for (gear, line) in gears(line, false)?.into_iter().filter(|(gear, _)| gear.gearbox.is_some()) {
        let vibration = match Vibration::of(&line, None) {
            Err(AnalysisError::NoEquilibrium { .. }) => {
                rows.push(ModesInGear {
                    gear,
                    frequency: Vec::new(),
                    damped_frequency: Vec::new(),
                    damping_ratio: Vec::new(),
                });
                continue;
            }
            other => other?,
        };
        let modes = vibration.modes(count)?;
        let pairs = vibration.damped(&modes)?;
        rows.push(ModesInGear {
            gear,
            frequency: modes.iter().map(ElasticMode::frequency).collect(),
            damped_frequency: pairs.elastic.iter().map(|pair| pair[0].im.abs()).collect(),
            damping_ratio: pairs.elastic.iter().map(|pair| damping_ratio(*pair)).collect(),
        });
    }
    Ok(rows)
}

/// Damping over critical damping of a pair of eigenvalues: more than one where it does not oscillate.
pub(crate) fn damping_ratio([first, second]: [Complex; 2]) -> f64 {
    let magnitude = (first * second).modulus().sqrt();
    if magnitude > 0.0 { -(first.re + second.re) / (2.0 * magnitude) } else { 0.0 }
}

/// What modes make of dry friction, which has no tangent that would say anything.
pub(super) fn friction_left_out(equations: &EquationsOfMotion) -> Option<String> {
    let names: Vec<&str> = equations
        .connections
        .iter()
        .filter(|connection| connection.friction.is_some())
        .map(|connection| connection.name.as_str())
        .collect();
    (!names.is_empty()).then(|| {
        format!(
            "the dry friction of {} is left out, as if it slid freely; motions so small that it \
             sticks have other modes",
            names.join(" and ")
        )
    })
}

/// The equilibrium of that number (from 1), or the stable one nearest to zero twist.
pub(crate) fn choose_equilibrium<'s>(
    line: &Driveline,
    equations: &EquationsOfMotion,
    states: &'s RestStates,
    number: Option<usize>,
) -> Result<&'s RestState, AnalysisError> {
    match number {
        Some(asked) => states
            .states
            .get(asked - 1)
            .ok_or(AnalysisError::NoSuchEquilibrium { asked, found: states.states.len() }),
        None => states.primary().ok_or_else(|| AnalysisError::NoEquilibrium {
            reason: equilibrium::overload_message(line, equations, states),
        }),
    }
}

/// What elastic mode number `mode` (from 1) is, in words.
pub(crate) fn mode_label(
    equations: &EquationsOfMotion,
    state: &RestState,
    mode: usize,
) -> Result<String, AnalysisError> {
    let modes = lowest_modes(equations, &state.twists, mode)?;
    let found = modes.len();
    let shape = modes.get(mode - 1).ok_or(AnalysisError::NoSuchMode { asked: mode, found })?;
    Ok(words(equations, state, shape))
}

/// An equilibrium as a result; with its lowest eigenvalue where that is asked for.
pub(crate) fn rest_result(
    equations: &EquationsOfMotion,
    state: &RestState,
    with_eigenvalue: bool,
) -> Result<Equilibrium, AnalysisError> {
    let lowest = || equilibrium::lowest_eigenvalue(equations, state);
    Ok(Equilibrium {
        twist: by_connection(equations, &state.twists),
        torque: by_connection(equations, &state.torques),
        stable: state.stable,
        lowest_eigenvalue: with_eigenvalue.then(lowest).transpose()?,
    })
}

pub(crate) fn by_connection(equations: &EquationsOfMotion, values: &[f64]) -> Named<f64> {
    let names = equations.connections.iter().map(|connection| connection.name.clone());
    names.zip(values.iter().copied()).collect()
}

/// Motion of every node for a motion of the groups, the largest 1; and the scale taken out.
fn node_shape(equations: &EquationsOfMotion, groups: &[f64]) -> (Named<f64>, f64) {
    let motion = |node: &halfshaft_dynamics::NodePlace| node.ratio * groups[node.group];
    let largest = equations
        .nodes
        .iter()
        .map(motion)
        .max_by(|a, b| a.abs().total_cmp(&b.abs()))
        .filter(|largest| *largest != 0.0)
        .unwrap_or(1.0);
    let shape =
        equations.nodes.iter().map(|node| (node.name.clone(), motion(node) / largest)).collect();
    (shape, largest)
}

/// Shares of the kinetic energy by inertia.
fn kinetic_shares(equations: &EquationsOfMotion, groups: &[f64]) -> Vec<(String, f64)> {
    let energy = |node: &halfshaft_dynamics::NodePlace| {
        let speed = node.ratio * groups[node.group];
        node.inertia * speed * speed
    };
    let total: f64 = equations.nodes.iter().map(energy).sum();
    let bodies = equations.nodes.iter().filter(|node| node.inertia > 0.0);
    bodies.map(|node| (node.name.clone(), energy(node) / total)).collect()
}

fn rigid_mode(equations: &EquationsOfMotion, speeds: &[f64], pair: [Complex; 2]) -> Mode {
    let (shape, _) = node_shape(equations, speeds);
    let none = vec![0.0; equations.connections.len()];
    Mode {
        frequency: 0.0,
        damped_frequency: 0.0,
        damping_ratio: 0.0,
        shape,
        twist: by_connection(equations, &none),
        strain_energy: by_connection(equations, &none),
        kinetic_energy: kinetic_shares(equations, speeds).into_iter().collect(),
        eigenvalues: pair.map(|value| (value.re, value.im)),
        label: "rigid-body motion: the whole line turns without twist".to_owned(),
    }
}

fn elastic_mode(
    equations: &EquationsOfMotion,
    state: &RestState,
    mode: &ElasticMode,
    pair: [Complex; 2],
) -> Mode {
    let (shape, scale) = node_shape(equations, &mode.shape);
    let twists: Vec<f64> = mode.twists.iter().map(|twist| twist / scale).collect();
    let strain = strain_shares(equations, state, mode);
    let kinetic = kinetic_shares(equations, &mode.shape);
    let frequency = mode.frequency();
    let mut label = words(equations, state, mode);
    if mode.eigenvalue < 0.0 {
        label = format!("unstable, moves away without vibrating: {label}");
    } else if mode.eigenvalue == 0.0 {
        let slack = |(connection, x): (&Connection, &f64)| {
            !connection.law.is_linear() && connection.law.stiffness(*x) == 0.0
        };
        let play = equations.connections.iter().zip(&state.twists).any(slack);
        label = if strain.iter().all(|share| *share == 0.0) && !play {
            let moving = |a: &(&String, &f64), b: &(&String, &f64)| a.1.abs().total_cmp(&b.1.abs());
            let most = shape.iter().max_by(moving).map_or("", |(node, _)| node.as_str());
            format!("no vibration: {most} turns freely")
        } else {
            format!("free play, no vibration: {label}")
        };
    }
    Mode {
        frequency,
        damped_frequency: pair[0].im.abs(),
        damping_ratio: damping_ratio(pair),
        shape,
        twist: by_connection(equations, &twists),
        strain_energy: by_connection(equations, &strain),
        kinetic_energy: kinetic.into_iter().collect(),
        eigenvalues: pair.map(|value| (value.re, value.im)),
        label,
    }
}

/// A mode in words, from the shares of its energies.
pub(crate) fn words(
    equations: &EquationsOfMotion,
    state: &RestState,
    mode: &ElasticMode,
) -> String {
    let strain = strain_shares(equations, state, mode);
    let kinetic = kinetic_shares(equations, &mode.shape);
    let strain: Vec<(&str, f64)> =
        equations.connections.iter().map(|c| c.name.as_str()).zip(strain).collect();
    let kinetic: Vec<(&str, f64)> =
        kinetic.iter().map(|(name, share)| (name.as_str(), *share)).collect();
    label(&strain, &kinetic)
}

/// Shares of the strain energy by connection, of magnitudes where a tangent is negative.
fn strain_shares(equations: &EquationsOfMotion, state: &RestState, mode: &ElasticMode) -> Vec<f64> {
    let energy: Vec<f64> = equations
        .connections
        .iter()
        .zip(&state.twists)
        .zip(&mode.twists)
        .map(|((connection, x), twist)| (connection.law.stiffness(*x) * twist * twist).abs())
        .collect();
    let total: f64 = energy.iter().sum();
    energy.iter().map(|e| if total > 0.0 { e / total } else { 0.0 }).collect()
}
