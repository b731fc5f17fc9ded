//! From a line to the answer of `modes`.

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_model::Driveline;
use halfshaft_model::question::{ModesQuestion, Question};
use halfshaft_numerics::Complex;
use halfshaft_results::{Equilibrium, Mode, ModesResult, Named};

use super::damped::damped;
use super::elastic::{ElasticMode, ElasticSpace};
use super::label::label;
use crate::equilibrium::{self, RestState, RestStates};
use crate::error::AnalysisError;
use crate::header::header;

/// Answers `modes`.
pub(crate) fn solve(
    line: &Driveline,
    question: &ModesQuestion,
) -> Result<ModesResult, AnalysisError> {
    let equations = EquationsOfMotion::new(line)?;
    let states = match question.equilibrium {
        Some(_) => equilibrium::find(&equations)?,
        None => equilibrium::find_stable(&equations)?,
    };
    let state = choose_equilibrium(line, &equations, &states, question.equilibrium)?;
    let undamped = ElasticSpace::new(&equations).modes(&equations, &state.twists)?;
    let pairs = damped(&equations, &undamped, &state.twists)?;
    let mut modes = Vec::with_capacity(equations.groups());
    if let (Some(rigid), Some(pair)) = (&equations.rigid, pairs.rigid) {
        modes.push(rigid_mode(&equations, &rigid.speeds, pair));
    }
    for (mode, pair) in undamped.iter().zip(&pairs.elastic) {
        modes.push(elastic_mode(&equations, state, mode, *pair));
    }
    let mut header = header(line, &Question::Modes(question.clone()));
    header.assumptions.push(
        "small vibrations about the equilibrium: each shaft acts by its tangent stiffness there"
            .to_owned(),
    );
    header.assumptions.extend(friction_left_out(&equations));
    header.warnings.extend(equilibrium::free_play(&equations, state));
    if !state.stable {
        header.warnings.push("this equilibrium is not stable: small motions grow".to_owned());
    }
    Ok(ModesResult { header, equilibrium: rest_result(&equations, state, true)?, modes })
}

/// What modes make of dry friction, which has no tangent that would say anything.
fn friction_left_out(equations: &EquationsOfMotion) -> Option<String> {
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
    let modes = ElasticSpace::new(equations).modes(equations, &state.twists)?;
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
    let frequency = mode.eigenvalue.max(0.0).sqrt();
    let [first, second] = pair;
    let magnitude = (first * second).modulus().sqrt();
    let damping_ratio =
        if magnitude > 0.0 { -(first.re + second.re) / (2.0 * magnitude) } else { 0.0 };
    let mut label = words(equations, state, mode);
    if mode.eigenvalue < 0.0 {
        label = format!("unstable, moves away without vibrating: {label}");
    } else if mode.eigenvalue == 0.0 {
        label = format!("free play, no vibration: {label}");
    }
    Mode {
        frequency,
        damped_frequency: first.im.abs(),
        damping_ratio,
        shape,
        twist: by_connection(equations, &twists),
        strain_energy: by_connection(equations, &strain),
        kinetic_energy: kinetic.into_iter().collect(),
        eigenvalues: pair.map(|value| (value.re, value.im)),
        label,
    }
}

/// A mode in words, from the shares of its energies.
fn words(equations: &EquationsOfMotion, state: &RestState, mode: &ElasticMode) -> String {
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
