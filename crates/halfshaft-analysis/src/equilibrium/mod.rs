//! All states of rest (or uniform running) under the mean torques, and what shafts can carry.
//!
//! On a tree of shafts, statics alone decides the torque of each shaft, and the twist follows
//! from its law: all roots of one polynomial a piece, so the list is proven complete. Shafts in
//! loops share their torque; those are solved together ([`clusters`]).

mod answer;
mod capacity;
mod clusters;
mod free_play;
mod holding;
mod running;

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_model::elements::Pulse;
use halfshaft_results::{Limit, ShaftCapacity};

use crate::error::AnalysisError;
use crate::modal::elastic::lowest_modes;

pub(crate) use answer::{overload_message, solve};
pub(crate) use capacity::{capacity, carries, snap_limits};
pub(crate) use clusters::all_twists;
pub(crate) use free_play::free_play;
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

/// A shaft, or several that share a torque.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Shared {
    /// Indices of the connections; torques and twists are in the sense of the first.
    pub(crate) connections: Vec<usize>,
    /// Torque that they must carry together, N·m; `None` where a loop leaves it undecided.
    pub(crate) asked: Option<f64>,
    /// Limits of what they carry together.
    pub(crate) capacity: Option<ShaftCapacity>,
}

/// Shafts whose laws do not reach the torque asked of them.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Overload {
    /// Indices of the connections that carry the torque together.
    pub(crate) connections: Vec<usize>,
    /// Torque asked, N·m; `None` where a loop leaves it undecided.
    pub(crate) asked: Option<f64>,
    /// Where the law ends in that direction.
    pub(crate) limit: Option<Limit>,
}

/// All states of rest of a line.
#[derive(Clone, Debug)]
pub(crate) struct RestStates {
    /// Those nearer to zero twist first.
    pub(crate) states: Vec<RestState>,
    /// Whether every part of the line was solved with proof that no state is missed.
    pub(crate) proven: bool,
    /// How many states there are, where that is more than are listed.
    pub(crate) left_out: Option<f64>,
    /// Torque asked of each connection where statics alone decides it, N·m.
    pub(crate) asked: Vec<Option<f64>>,
    /// Shafts that share a torque.
    pub(crate) shared: Vec<Shared>,
    /// How the line runs.
    pub(crate) running: RunningState,
    /// The first shaft that cannot carry what is asked of it.
    pub(crate) overload: Option<Overload>,
}

impl RestStates {
    /// Whether the list is proven to be complete.
    pub(crate) fn is_complete(&self) -> bool {
        self.proven && self.left_out.is_none()
    }

    /// The stable state nearest to zero twist.
    pub(crate) fn primary(&self) -> Option<&RestState> {
        self.states.iter().find(|state| state.stable)
    }
}

/// More states than this are not listed; a line of many softening shafts has 3 to the power
/// of their number.
const MOST_STATES: usize = 1000;

/// Finds all states of rest of a line, or the stable ones and the nearest of the others where
/// there are too many to list.
pub(crate) fn find(equations: &EquationsOfMotion) -> Result<RestStates, AnalysisError> {
    find_up_to(equations, MOST_STATES)
}

/// Finds the stable state nearest to zero twist (the only one in the list), or why there is none.
pub(crate) fn find_stable(equations: &EquationsOfMotion) -> Result<RestStates, AnalysisError> {
    find_up_to(equations, 1)
}

fn find_up_to(equations: &EquationsOfMotion, most: usize) -> Result<RestStates, AnalysisError> {
    // Forces that are left for the shafts to carry.
    let running = RunningState::of(equations);
    let clusters = clusters::split(equations, &running.forces);
    let mut asked = vec![None; equations.connections.len()];
    for cluster in &clusters {
        if let Some((connection, torque)) = cluster.determinate() {
            asked[connection] = Some(torque);
        }
    }
    let shared = clusters.iter().filter_map(|cluster| cluster.shared(equations)).collect();

    // Twists of each independent part, then every combination of them.
    let (mut proven, mut count) = (true, 1.0);
    let none = vec![0.0; equations.network.tree.len()];
    let mut combinations = vec![Combination { tree_twists: none, stable: true, size: 0.0 }];
    let mut overload = None;
    for cluster in &clusters {
        let (solutions, all) = cluster.solve(equations)?;
        proven &= all;
        #[expect(clippy::cast_precision_loss, reason = "a few roots each")]
        {
            count *= solutions.len() as f64;
        }
        if overload.is_none() && !solutions.iter().any(|solution| solution.stable) {
            overload = Some(cluster.overload(equations));
        }
        combinations = combine(combinations, cluster.members(), &solutions, most);
    }
    #[expect(clippy::cast_precision_loss, reason = "bounded by the list's limit")]
    let left_out = (count > combinations.len() as f64).then_some(count);

    combinations.sort_by(|a, b| a.size.total_cmp(&b.size));
    let states: Vec<RestState> =
        combinations.iter().map(|combination| rest_state(equations, combination)).collect();
    Ok(RestStates { states, proven, left_out, asked, shared, running, overload })
}

/// Twists of the spanning tree, gathered cluster by cluster.
#[derive(Clone)]
struct Combination {
    tree_twists: Vec<f64>,
    stable: bool,
    /// Sum of the sizes of the twists, rad.
    size: f64,
}

/// Every old combination with every solution of one more cluster; of too many the stable ones
/// first, and then those nearest to zero twist. Sizes add up, so the stable state nearest to zero
/// twist is never dropped.
fn combine(
    mut old: Vec<Combination>,
    members: &[usize],
    solutions: &[clusters::Balanced],
    most: usize,
) -> Vec<Combination> {
    if let [only] = solutions {
        // Long lines have one after the other.
        old.iter_mut().for_each(|base| base.extend(members, only));
        return old;
    }
    let with = |base: &Combination, solution: &clusters::Balanced| {
        let mut base = base.clone();
        base.extend(members, solution);
        base
    };
    let pairs = old.iter().flat_map(|base| solutions.iter().map(move |s| with(base, s)));
    let mut all: Vec<Combination> = pairs.collect();
    if all.len() > most {
        all.sort_by(|a, b| b.stable.cmp(&a.stable).then(a.size.total_cmp(&b.size)));
        all.truncate(most);
    }
    all
}

impl Combination {
    fn extend(&mut self, members: &[usize], solution: &clusters::Balanced) {
        for (member, twist) in members.iter().zip(&solution.twists) {
            self.tree_twists[*member] = *twist;
        }
        self.size += solution.twists.iter().map(|x| x.abs()).sum::<f64>();
        self.stable &= solution.stable;
    }
}

fn rest_state(equations: &EquationsOfMotion, combination: &Combination) -> RestState {
    let twists = all_twists(equations, &combination.tree_twists);
    let torques =
        equations.connections.iter().zip(&twists).map(|(c, x)| c.law.torque(*x)).collect();
    RestState { twists, torques, stable: combination.stable }
}

/// The line with what its ramps leave behind as mean torques; `None` without a ramp.
pub(crate) fn after_ramps(equations: &EquationsOfMotion) -> Option<EquationsOfMotion> {
    if !equations.excitation.has_ramp() {
        return None;
    }
    let mut after = equations.clone();
    for source in &mut after.excitation.sources {
        source.mean += source.pulse.as_ref().map_or(0.0, Pulse::final_torque);
        let table = source.table.as_ref().and_then(|table| table.torque_nm.last());
        source.mean += table.copied().unwrap_or(0.0);
    }
    Some(after)
}

/// How far a shaft may swing from its twist at rest until the nearer limit of its law, rad;
/// infinite without a limit.
pub(crate) fn room(equations: &EquationsOfMotion, shaft: usize, rest_twists: &[f64]) -> f64 {
    let limit = capacity(&equations.connections[shaft].law);
    [limit.positive, limit.negative]
        .iter()
        .flatten()
        .map(|limit| (limit.twist - rest_twists[shaft]).abs())
        .fold(f64::INFINITY, f64::min)
}

/// Smallest eigenvalue of the tangent stiffness over the inertia with the rigid-body motion taken
/// out, s⁻².
pub(crate) fn lowest_eigenvalue(
    equations: &EquationsOfMotion,
    state: &RestState,
) -> Result<f64, AnalysisError> {
    let modes = lowest_modes(equations, &state.twists, 1)?;
    Ok(modes.first().map_or(0.0, |mode| mode.eigenvalue))
}
