//! All states of rest (or uniform running) under the mean torques, and what shafts can carry.
//!
//! On a tree of shafts, statics alone decides the torque of each shaft, and the twist follows
//! from its law: all roots of one polynomial each, so the list is proven complete. Shafts in
//! loops share their torque; those are solved together ([`clusters`]).

mod answer;
mod capacity;
mod clusters;
mod running;

use halfshaft_dynamics::{EquationsOfMotion, TorqueLaw};
use halfshaft_results::Limit;

use crate::error::AnalysisError;
use crate::modal::elastic::ElasticSpace;

pub(crate) use answer::{overload_message, solve};
pub(crate) use capacity::{capacity, carries};
pub(crate) use running::RunningState;

/// One state of rest or uniform running.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct RestState {
    /// Twist of each connection, rad.
    pub(crate) twists: Vec<f64>,
    /// Torque of each connection, N·m.
    pub(crate) torques: Vec<f64>,
    /// Whether the line stays there when nudged.
    pub(crate) stable: bool,
}

/// A shaft whose law does not reach the torque asked of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Overload {
    /// Index of the connection.
    pub(crate) connection: usize,
    /// Torque asked, N·m.
    pub(crate) asked: f64,
    /// Where the law ends in that direction.
    pub(crate) limit: Option<Limit>,
}

/// All states of rest of a line.
#[derive(Clone, Debug)]
pub(crate) struct RestStates {
    /// Those nearer to zero twist first.
    pub(crate) states: Vec<RestState>,
    /// Whether the list is proven to be complete.
    pub(crate) complete: bool,
    /// Torque asked of each connection where statics alone decides it, N·m.
    pub(crate) asked: Vec<Option<f64>>,
    /// How the line runs.
    pub(crate) running: RunningState,
    /// The first shaft that cannot carry what is asked of it.
    pub(crate) overload: Option<Overload>,
}

impl RestStates {
    /// The stable state nearest to zero twist.
    pub(crate) fn primary(&self) -> Option<&RestState> {
        self.states.iter().find(|state| state.stable)
    }
}

/// More states than this are not listed; a line of many softening shafts has 3 to the power
/// of their number.
const MOST_STATES: usize = 1000;

/// Finds all states of rest of a line.
pub(crate) fn find(equations: &EquationsOfMotion) -> Result<RestStates, AnalysisError> {
    // Forces that are left for the shafts to carry.
    let running = RunningState::of(equations);
    let clusters = clusters::split(equations, &running.forces);
    let mut asked = vec![None; equations.connections.len()];
    for cluster in &clusters {
        if let Some((connection, torque)) = cluster.determinate() {
            asked[connection] = Some(torque);
        }
    }

    // Twists of each independent part, then every combination of them.
    let mut complete = true;
    let mut combinations =
        vec![Combination { tree_twists: vec![0.0; equations.network.tree.len()], stable: true }];
    let mut overload = None;
    for cluster in &clusters {
        let (solutions, proven) = cluster.solve(equations)?;
        complete &= proven && combinations.len() * solutions.len() <= MOST_STATES;
        if overload.is_none() && !solutions.iter().any(|solution| solution.stable) {
            overload = cluster.overload(equations);
        }
        combinations = combine(&combinations, cluster.members(), &solutions);
    }

    let mut states: Vec<RestState> =
        combinations.iter().map(|combination| rest_state(equations, combination)).collect();
    let size = |state: &RestState| state.twists.iter().map(|x| x.abs()).sum::<f64>();
    states.sort_by(|a, b| size(a).total_cmp(&size(b)));
    Ok(RestStates { states, complete, asked, running, overload })
}

/// Twists of the spanning tree, gathered cluster by cluster.
struct Combination {
    tree_twists: Vec<f64>,
    stable: bool,
}

/// Every old combination with every solution of one more cluster.
fn combine(
    old: &[Combination],
    members: &[usize],
    solutions: &[clusters::Balanced],
) -> Vec<Combination> {
    let with = |base: &Combination, solution: &clusters::Balanced| {
        let mut tree_twists = base.tree_twists.clone();
        for (member, twist) in members.iter().zip(&solution.twists) {
            tree_twists[*member] = *twist;
        }
        Combination { tree_twists, stable: base.stable && solution.stable }
    };
    let pairs = old.iter().flat_map(|base| solutions.iter().map(move |s| with(base, s)));
    pairs.take(MOST_STATES).collect()
}

fn rest_state(equations: &EquationsOfMotion, combination: &Combination) -> RestState {
    let twists = clusters::all_twists(equations, &combination.tree_twists);
    let torques =
        equations.connections.iter().zip(&twists).map(|(c, x)| c.law.torque(*x)).collect();
    RestState { twists, torques, stable: combination.stable }
}

/// Smallest eigenvalue of the tangent stiffness over the inertia with the rigid-body motion taken
/// out, s⁻².
pub(crate) fn lowest_eigenvalue(
    equations: &EquationsOfMotion,
    state: &RestState,
) -> Result<f64, AnalysisError> {
    let eigenvalues = ElasticSpace::new(equations).eigenvalues(equations, &state.twists)?;
    Ok(eigenvalues.first().copied().unwrap_or(0.0))
}

/// Whether the law of a connection can be inverted by polynomial roots.
pub(crate) fn polynomial_of(law: &TorqueLaw) -> &halfshaft_dynamics::laws::PolynomialLaw {
    match law {
        TorqueLaw::Polynomial(law) => law,
    }
}
