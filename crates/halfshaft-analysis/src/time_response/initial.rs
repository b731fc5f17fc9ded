//! The state before the first moment.

use halfshaft_dynamics::{EquationsOfMotion, Motion};
use halfshaft_model::question::{ChannelQuantity, InitialValue, Start};
use halfshaft_model::{Driveline, GROUND};
use halfshaft_numerics::dense::{Matrix, dot, solve};

use crate::equilibrium::{self, RestStates};
use crate::error::AnalysisError;
use crate::modal::choose_equilibrium;

/// The state that a run starts from: `start` with the given initial values set upon it.
///
/// Where only shafts are given, the other shafts of the spanning tree keep their twist and the
/// line as a whole its angle; where a node is given too, the motion changes as little as the
/// values allow.
pub(crate) fn start_state(
    line: &Driveline,
    motion: &mut Motion<'_>,
    start: Start,
    initial: &[InitialValue],
) -> Result<Vec<f64>, AnalysisError> {
    let equations = motion.equations();
    let mut state = match start {
        Start::Rest => motion.zero_state(),
        Start::Equilibrium => {
            let states = equilibrium::find_stable(equations)?;
            equilibrium_state(line, motion, &states)?
        }
    };
    let n = motion.coordinates();
    let displaced = |quantity| matches!(quantity, ChannelQuantity::Twist | ChannelQuantity::Angle);
    let (angles, speeds): (Vec<&InitialValue>, Vec<&InitialValue>) =
        initial.iter().partition(|value| displaced(value.channel.quantity));
    adjust(motion, &mut state[..n], &angles)?;
    adjust(motion, &mut state[n..2 * n], &speeds)?;
    Ok(state)
}

/// The stable equilibrium nearest to zero twist, as a state.
pub(crate) fn equilibrium_state(
    line: &Driveline,
    motion: &Motion<'_>,
    states: &RestStates,
) -> Result<Vec<f64>, AnalysisError> {
    let equations = motion.equations();
    let rest = choose_equilibrium(line, equations, states, None)?;
    let mut state = motion.zero_state();
    for (index, edge) in equations.network.tree.iter().enumerate() {
        state[index] = rest.twists[edge.shaft];
    }
    if equations.rigid.is_some() {
        // The speed of the first group is that of the mean angle, whose first weight is 1.
        state[2 * motion.coordinates() - 1] = states.running.speed;
    }
    Ok(state)
}

/// Changes coordinates (twists of the tree and mean, or their rates) to meet the values.
fn adjust(
    motion: &mut Motion<'_>,
    coordinates: &mut [f64],
    values: &[&InitialValue],
) -> Result<(), AnalysisError> {
    if values.is_empty() {
        return Ok(());
    }
    let rows = values
        .iter()
        .map(|value| row(motion, value))
        .collect::<Result<Vec<Vec<f64>>, AnalysisError>>()?;
    let shafts_only = values.iter().all(|value| {
        matches!(value.channel.quantity, ChannelQuantity::Twist | ChannelQuantity::TwistRate)
    });
    let weights = if shafts_only { tree_weights(motion) } else { inverse_inertia(motion) };
    let missing: Vec<f64> =
        rows.iter().zip(values).map(|(row, value)| value.value - dot(row, coordinates)).collect();
    // Smallest weighted change with rows · change = missing.
    let weighted: Vec<Vec<f64>> = rows.iter().map(|row| weights.apply(row)).collect();
    let gram = Matrix::from_fn(rows.len(), rows.len(), |i, j| dot(&rows[i], &weighted[j]));
    let contradicts = |reason: String| AnalysisError::InitialValues { reason };
    let factors = solve(&gram, &missing)
        .map_err(|_| contradicts("two of them fix the same motion".to_owned()))?;
    for (factor, direction) in factors.iter().zip(&weighted) {
        for (coordinate, step) in coordinates.iter_mut().zip(direction) {
            *coordinate += factor * step;
        }
    }
    for (row, value) in rows.iter().zip(values) {
        let got = dot(row, coordinates);
        if (got - value.value).abs() > 1e-9 * value.value.abs().max(got.abs()).max(1e-9) {
            let name = value.channel.name();
            return Err(contradicts(format!("{name} cannot be met together with the others")));
        }
    }
    Ok(())
}

/// Value of a channel for each unit coordinate: its row of the linear map.
fn row(motion: &mut Motion<'_>, value: &InitialValue) -> Result<Vec<f64>, AnalysisError> {
    let equations = motion.equations();
    let n = motion.coordinates();
    let channel = &value.channel;
    let missing = || AnalysisError::InitialValues {
        reason: format!("{} is no channel of the line", channel.name()),
    };
    let mut state = motion.zero_state();
    let mut row = vec![0.0; n];
    for (index, entry) in row.iter_mut().enumerate() {
        state[index] = 1.0;
        let kinematics = motion.kinematics(&state);
        *entry = match channel.quantity {
            ChannelQuantity::Twist | ChannelQuantity::TwistRate => {
                kinematics.twists[equations.connection(&channel.owner).ok_or_else(missing)?]
            }
            _ if channel.owner == GROUND => return Err(missing()),
            _ => {
                let node = &equations.nodes[equations.node(&channel.owner).ok_or_else(missing)?];
                node.ratio * kinematics.angles[node.group]
            }
        };
        state[index] = 0.0;
    }
    Ok(row)
}

/// How readily each coordinate changes.
enum Weights {
    /// Tree twists alike, the mean not at all.
    Tree { twists: usize },
    /// Group motions by the inverse of their inertia, in the given coordinates.
    Inertia(Matrix),
}

impl Weights {
    fn apply(&self, row: &[f64]) -> Vec<f64> {
        match self {
            Self::Tree { twists } => {
                let keep =
                    |(index, value): (usize, &f64)| if index < *twists { *value } else { 0.0 };
                row.iter().enumerate().map(keep).collect()
            }
            Self::Inertia(matrix) => {
                (0..row.len()).map(|index| dot(matrix.row(index), row)).collect()
            }
        }
    }
}

fn tree_weights(motion: &Motion<'_>) -> Weights {
    Weights::Tree { twists: motion.tree_twists() }
}

/// Inverse of the inertia in coordinates: with `q = T z` it is `T⁻¹ M⁻¹ T⁻ᵀ`, and `T⁻¹` is the
/// map from group angles to coordinates.
fn inverse_inertia(motion: &Motion<'_>) -> Weights {
    let equations: &EquationsOfMotion = motion.equations();
    let n = motion.coordinates();
    let none = vec![0.0; n];
    let columns: Vec<Vec<f64>> = (0..n)
        .map(|group| {
            let mut unit = vec![0.0; n];
            unit[group] = 1.0;
            motion.state_of(&unit, &none)[..n].to_vec()
        })
        .collect();
    Weights::Inertia(Matrix::from_fn(n, n, |i, j| {
        (0..n).map(|group| columns[group][i] * columns[group][j] / equations.inertia[group]).sum()
    }))
}
