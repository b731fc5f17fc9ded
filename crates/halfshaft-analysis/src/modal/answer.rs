//! From a line to the answer of `modes`.

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_model::Driveline;
use halfshaft_model::question::{ModesQuestion, Question};
use halfshaft_numerics::Complex;
use halfshaft_results::{Equilibrium, ModesInGear, ModesResult, Named};

use super::elastic::{ALL_UP_TO, ElasticMode, lowest_modes};
use super::sparse::elastic_count;
use super::telling::Telling;
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
    let lowest = match undamped.first() {
        Some(mode) => mode.eigenvalue,
        None => equilibrium::lowest_eigenvalue(equations, state)?,
    };
    let told = Telling::of(equations, state);
    let mut modes = Vec::with_capacity(undamped.len() + 1);
    if let (Some(rigid), Some(pair)) = (&equations.rigid, pairs.rigid) {
        modes.push(told.rigid(&rigid.speeds, pair));
    }
    modes.extend(undamped.iter().zip(&pairs.elastic).map(|(mode, pair)| told.elastic(mode, *pair)));
    let mut header = header(line, &Question::Modes(question.clone()));
    vibration.told(&mut header);
    Ok(ModesResult {
        header,
        equilibrium: rest_result(equations, state, Some(lowest)),
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
    Ok(Telling::of(equations, state).in_words(shape))
}

/// An equilibrium as a result; with its lowest eigenvalue where that is known.
pub(crate) fn rest_result(
    equations: &EquationsOfMotion,
    state: &RestState,
    lowest_eigenvalue: Option<f64>,
) -> Equilibrium {
    Equilibrium {
        twist: by_connection(equations, &state.twists),
        torque: by_connection(equations, &state.torques),
        stable: state.stable,
        lowest_eigenvalue,
    }
}

pub(crate) fn by_connection(equations: &EquationsOfMotion, values: &[f64]) -> Named<f64> {
    let names = equations.connections.iter().map(|connection| connection.name.clone());
    names.zip(values.iter().copied()).collect()
}

/// Modes in words, from the shares of their energies.
pub(crate) fn words(
    equations: &EquationsOfMotion,
    state: &RestState,
    modes: &[ElasticMode],
) -> Vec<String> {
    let told = Telling::of(equations, state);
    modes.iter().map(|mode| told.in_words(mode)).collect()
}
