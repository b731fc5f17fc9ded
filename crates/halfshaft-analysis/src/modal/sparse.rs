//! Modes of long lines, of lines with massless nodes, and of bars with consistent inertia.

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_numerics::pencil::{Pencil, PencilTerm};

use super::elastic::ElasticMode;
use crate::error::{AnalysisError, Doing};

/// Stiffness and inertia of a line about given twists, connections first and then the groups.
pub(crate) fn terms(equations: &EquationsOfMotion, twists: &[f64]) -> Vec<PencilTerm> {
    let connections = equations.connections.iter().zip(twists).filter_map(|(connection, x)| {
        let from = connection.from;
        let to = connection.to.map(|(group, ratio)| (group, -ratio));
        let (first, second) = match (from, to) {
            (Some(first), second) => (first, second),
            (None, Some(second)) => (second, None),
            (None, None) => return None,
        };
        let (stiffness, inertia) = (connection.law.stiffness(*x), connection.inertance);
        Some(PencilTerm { first, second, stiffness, inertia })
    });
    let groups = equations.inertia.iter().enumerate().map(|(group, inertia)| PencilTerm {
        first: (group, 1.0),
        second: None,
        stiffness: 0.0,
        inertia: *inertia,
    });
    connections.chain(groups).collect()
}

/// Viscous damping and loss factor of each term of [`terms`].
pub(crate) fn damping_of_terms(equations: &EquationsOfMotion, twists: &[f64]) -> Vec<(f64, f64)> {
    let ends = equations.connections.iter().zip(twists);
    let connections = ends
        .filter(|(connection, _)| connection.from.is_some() || connection.to.is_some())
        .map(|(connection, x)| (connection.damping_at(*x), connection.loss_factor));
    connections.chain(equations.ground_damping.iter().map(|damping| (*damping, 0.0))).collect()
}

/// Squared frequency over the largest local one that is rounding.
const NOTHING: f64 = 1e-20;

/// Number of elastic modes: one for each group with inertia, but for turning as a whole.
pub(crate) fn elastic_count(equations: &EquationsOfMotion) -> usize {
    let heavy = equations.inertia.iter().filter(|inertia| **inertia > 0.0).count();
    heavy - usize::from(equations.rigid.is_some()).min(heavy)
}

/// Turning as a whole, of inertia one.
pub(crate) fn rigid_shape(equations: &EquationsOfMotion) -> Option<Vec<f64>> {
    let rigid = equations.rigid.as_ref()?;
    let length = rigid.inertia.sqrt();
    Some(rigid.speeds.iter().map(|speed| speed / length).collect())
}

/// The lowest elastic modes about given twists, ascending.
pub(super) fn lowest(
    equations: &EquationsOfMotion,
    twists: &[f64],
    count: usize,
) -> Result<Vec<ElasticMode>, AnalysisError> {
    let pencil = Pencil::new(equations.groups(), terms(equations, twists));
    let known: Vec<Vec<f64>> = rigid_shape(equations).into_iter().collect();
    let count = count.min(elastic_count(equations));
    let pairs = pencil.lowest(count, &known).doing("computing natural frequencies")?;
    let largest = equations.connections.iter().zip(twists).map(|(connection, x)| {
        connection.law.stiffness(*x).abs() * equations.compliance_of_heavy(connection)
    });
    let nothing = NOTHING * largest.fold(0.0, f64::max);
    let mode = |pair: halfshaft_numerics::pencil::EigenPair| {
        let twist = |index| equations.twist(index, &pair.vector);
        ElasticMode {
            // What twists nothing, like the ring of a viscous damper, is told as just that.
            eigenvalue: if pair.value.abs() <= nothing { 0.0 } else { pair.value },
            twists: (0..equations.connections.len()).map(twist).collect(),
            shape: pair.vector,
        }
    };
    Ok(pairs.into_iter().map(mode).collect())
}
