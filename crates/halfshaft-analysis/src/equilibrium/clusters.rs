//! Shafts that share their torque, and the twists at which they are in balance.
//!
//! With the twists `x_e` of the spanning tree as unknowns and `x_l = Σ_e a_le x_e` the twists of
//! the shafts that close loops, virtual work gives one equation a tree shaft:
//!
//! ```text
//! p_e(x_e) + Σ_l a_le p_l(x_l) = d_e
//! ```
//!
//! where `d_e` is what the forces beyond the shaft ask of it. Tree shafts that no common loop
//! joins are independent of each other: a cluster of one is one law, piece by piece a polynomial, with
//! all its roots.

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_dynamics::laws::Pieces;
use halfshaft_numerics::dense::{Matrix, dot, symmetric_eigen};
use halfshaft_numerics::newton;

use super::capacity::{capacity, capacity_of};
use super::holding::{VANISHING, holds, is_flat};
use super::{Overload, Shared};
use crate::error::{AnalysisError, Doing};

/// Tree shafts that depend on each other.
pub(super) struct Cluster {
    /// Positions in the spanning tree.
    members: Vec<usize>,
    /// Connection of each member.
    connections: Vec<usize>,
    /// `d_e` of each member, N·m.
    asked: Vec<f64>,
    /// Loops through the members: connection and `a_le` for each member.
    loops: Vec<(usize, Vec<f64>)>,
}

/// Twists of a cluster's members at which it is in balance.
pub(super) struct Balanced {
    pub(super) twists: Vec<f64>,
    /// Whether its tangent stiffness is positive there.
    pub(super) stable: bool,
}

/// Splits the line into clusters under the given forces on its groups.
pub(super) fn split(equations: &EquationsOfMotion, forces: &[f64]) -> Vec<Cluster> {
    let tree = &equations.network.tree;
    let asked = tree_torques(equations, forces);
    let loops: Vec<(usize, Vec<f64>)> = equations
        .network
        .loops
        .iter()
        .map(|shaft| (*shaft, loop_coefficients(equations, *shaft)))
        .collect();
    let cluster_of = join(tree.len(), &loops);
    let mut clusters: Vec<Cluster> = Vec::new();
    for root in 0..tree.len() {
        let members: Vec<usize> = (0..tree.len()).filter(|e| cluster_of[*e] == root).collect();
        if members.is_empty() {
            continue;
        }
        let own = |(shaft, coefficients): &(usize, Vec<f64>)| {
            let own: Vec<f64> = members.iter().map(|member| coefficients[*member]).collect();
            own.iter().any(|a| *a != 0.0).then_some((*shaft, own))
        };
        clusters.push(Cluster {
            connections: members.iter().map(|member| tree[*member].shaft).collect(),
            asked: members.iter().map(|member| asked[*member]).collect(),
            loops: loops.iter().filter_map(own).collect(),
            members,
        });
    }
    clusters
}

/// Twists of all connections from those of the tree.
pub(crate) fn all_twists(equations: &EquationsOfMotion, tree_twists: &[f64]) -> Vec<f64> {
    let mut twists = vec![0.0; equations.connections.len()];
    for (edge, twist) in equations.network.tree.iter().zip(tree_twists) {
        twists[edge.shaft] = *twist;
    }
    if !equations.network.loops.is_empty() {
        let mut angles = vec![0.0; equations.groups()];
        equations.group_angles(tree_twists, &mut angles);
        for &shaft in &equations.network.loops {
            twists[shaft] = equations.twist(shaft, &angles);
        }
    }
    twists
}

/// Torque that the forces beyond each tree shaft ask of it, loops left out.
///
/// The part beyond the shaft is turned rigidly; the work of its forces is the work of the
/// shaft's torque.
fn tree_torques(equations: &EquationsOfMotion, forces: &[f64]) -> Vec<f64> {
    let tree = &equations.network.tree;
    let mut speeds = vec![1.0; equations.groups()];
    for edge in tree {
        if let Some((parent, parent_ratio)) = edge.parent {
            let (child, child_ratio) = edge.child;
            speeds[child] = speeds[parent] * parent_ratio / child_ratio;
        }
    }
    let mut work: Vec<f64> = forces.iter().zip(&speeds).map(|(f, r)| f * r).collect();
    // What is left of a sum after large terms cancel is no torque.
    #[expect(clippy::cast_precision_loss, reason = "a size")]
    let rounding = f64::EPSILON * work.len() as f64 * work.iter().map(|w| w.abs()).sum::<f64>();
    let mut torques = vec![0.0; tree.len()];
    for (index, edge) in tree.iter().enumerate().rev() {
        let (child, ratio) = edge.child;
        let left = if work[child].abs() <= rounding { 0.0 } else { work[child] };
        let torque = left / (speeds[child] * ratio);
        torques[index] = if edge.from_parent { -torque } else { torque };
        if let Some((parent, _)) = edge.parent {
            work[parent] += work[child];
        }
    }
    torques
}

/// `a_le`: twist of a loop shaft for a unit twist of each tree shaft.
fn loop_coefficients(equations: &EquationsOfMotion, shaft: usize) -> Vec<f64> {
    let count = equations.network.tree.len();
    let mut unit = vec![0.0; count];
    let mut angles = vec![0.0; equations.groups()];
    (0..count)
        .map(|edge| {
            unit[edge] = 1.0;
            equations.group_angles(&unit, &mut angles);
            unit[edge] = 0.0;
            let a = equations.twist(shaft, &angles);
            // Beyond both ends of the loop the twist cancels, but for rounding.
            if a.abs() < 1e-12 { 0.0 } else { a }
        })
        .collect()
}

/// Root of the cluster of each tree shaft.
fn join(count: usize, loops: &[(usize, Vec<f64>)]) -> Vec<usize> {
    let mut cluster: Vec<usize> = (0..count).collect();
    for (_, coefficients) in loops {
        let touched: Vec<usize> = (0..count).filter(|e| coefficients[*e] != 0.0).collect();
        let Some(root) = touched.iter().map(|e| cluster[*e]).min() else { continue };
        let old: Vec<usize> = touched.iter().map(|e| cluster[*e]).collect();
        for of in cluster.iter_mut().filter(|of| old.contains(of)) {
            *of = root;
        }
    }
    cluster
}

impl Cluster {
    /// Positions in the spanning tree.
    pub(super) fn members(&self) -> &[usize] {
        &self.members
    }

    /// Connection and torque, where statics alone decides it.
    pub(super) fn determinate(&self) -> Option<(usize, f64)> {
        (self.loops.is_empty() && self.members.len() == 1)
            .then(|| (self.connections[0], self.asked[0]))
    }

    /// All twists at which the cluster is in balance, and whether that is proven to be all.
    pub(super) fn solve(
        &self,
        equations: &EquationsOfMotion,
    ) -> Result<(Vec<Balanced>, bool), AnalysisError> {
        if self.members.len() == 1 {
            let law = self.single_law(equations);
            let balanced = |x: f64| Balanced { twists: vec![x], stable: holds(&law, x) };
            return Ok((law.twists_at(self.asked[0]).into_iter().map(balanced).collect(), true));
        }
        // A linear cluster has one equilibrium, which one start finds.
        let linear = self.laws().all(|index| equations.connections[index].law.is_linear());
        let starts = if linear { 1 } else { STARTS * self.members.len() };
        Ok((self.search(equations, starts)?, linear))
    }

    /// Law of a cluster of one over its twist: loops act in parallel, each `a p(a x)`.
    fn single_law(&self, equations: &EquationsOfMotion) -> Pieces {
        let law = |index: usize| equations.connections[index].law.pieces();
        let loops = self.loops.iter().filter(|(_, a)| a[0] != 0.0);
        loops
            .fold(law(self.connections[0]), |sum, (shaft, a)| sum.add(&law(*shaft).stretched(a[0])))
    }

    /// Connections of the cluster.
    fn laws(&self) -> impl Iterator<Item = usize> + '_ {
        let loops = self.loops.iter().map(|(shaft, _)| *shaft);
        self.connections.iter().copied().chain(loops)
    }

    /// Balanced twists by Newton's method from many starts; not proven complete.
    fn search(
        &self,
        equations: &EquationsOfMotion,
        starts: usize,
    ) -> Result<Vec<Balanced>, AnalysisError> {
        let count = self.members.len();
        let reach = self.reach(equations);
        let mut found: Vec<Balanced> = Vec::new();
        for start in 0..starts {
            let guess: Vec<f64> = (0..count)
                .map(
                    |axis| if start == 0 { 0.0 } else { reach * (2.0 * halton(start, axis) - 1.0) },
                )
                .collect();
            let solution = newton::solve(
                |x, residual| self.residual(equations, x, residual),
                |x, jacobian| self.jacobian(equations, x, jacobian),
                &guess,
                &newton::Settings { typical: vec![reach; count], ..newton::Settings::default() },
            )
            .doing("looking for equilibria of shafts in a loop")?;
            if !solution.report.converged.is_converged() {
                continue;
            }
            let near = |other: &Balanced| {
                let pairs = other.twists.iter().zip(&solution.unknowns);
                pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) < 1e-7 * reach
            };
            if !found.iter().any(near) {
                let stable = self.is_stable(equations, &solution.unknowns)?;
                found.push(Balanced { twists: solution.unknowns, stable });
            }
        }
        Ok(found)
    }

    /// Whether the tangent stiffness of the cluster is positive definite; where a law is flat (inside
    /// a gap), whether it is not negative.
    fn is_stable(&self, equations: &EquationsOfMotion, x: &[f64]) -> Result<bool, AnalysisError> {
        let mut tangent = Matrix::zeros(x.len(), x.len());
        self.jacobian(equations, x, &mut tangent);
        let values =
            symmetric_eigen(&tangent).doing("judging the stability of an equilibrium")?.values;
        let largest = values.iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
        let twists = self.connections.iter().copied().zip(x.iter().copied());
        let loops = self.loops.iter().map(|(shaft, a)| (*shaft, dot(a, x)));
        let flat =
            |(index, x): (usize, f64)| is_flat(&equations.connections[index].law.pieces(), x);
        if twists.chain(loops).any(flat) {
            return Ok(values.iter().all(|value| *value >= -VANISHING * largest));
        }
        Ok(values.iter().all(|value| *value > VANISHING * largest))
    }

    /// Twists within which solutions are looked for: a few times the scale of the laws.
    fn reach(&self, equations: &EquationsOfMotion) -> f64 {
        let load: f64 = self.asked.iter().map(|d| d.abs()).sum();
        let scale = |index: usize| {
            let law = &equations.connections[index].law;
            let pieces = law.pieces();
            let loaded = [load, -load].into_iter().flat_map(|torque| pieces.twists_at(torque));
            let loaded = loaded.map(f64::abs).fold(0.0, f64::max);
            let joints = pieces.list().iter().map(|piece| piece.from.abs());
            let joints = joints.filter(|x| x.is_finite()).fold(0.0, f64::max);
            let limit = capacity(law);
            let limits = [limit.positive, limit.negative];
            let turning = limits.iter().flatten().map(|l| l.twist.abs()).fold(0.0, f64::max);
            loaded.max(1.5 * joints).max(3.0 * turning)
        };
        let reach = self.laws().map(scale).fold(0.0, f64::max);
        if reach > 0.0 { 2.0 * reach } else { 1.0 }
    }

    fn residual(&self, equations: &EquationsOfMotion, x: &[f64], residual: &mut [f64]) {
        let law = |index: usize| &equations.connections[index].law;
        for (i, connection) in self.connections.iter().enumerate() {
            residual[i] = law(*connection).torque(x[i]) - self.asked[i];
        }
        for (shaft, a) in &self.loops {
            let torque = law(*shaft).torque(dot(a, x));
            for (residual, a) in residual.iter_mut().zip(a) {
                *residual += a * torque;
            }
        }
    }

    fn jacobian(&self, equations: &EquationsOfMotion, x: &[f64], jacobian: &mut Matrix) {
        let law = |index: usize| &equations.connections[index].law;
        for row in 0..x.len() {
            for column in 0..x.len() {
                jacobian[(row, column)] =
                    if row == column { law(self.connections[row]).stiffness(x[row]) } else { 0.0 };
            }
        }
        for (shaft, a) in &self.loops {
            let stiffness = law(*shaft).stiffness(dot(a, x));
            for row in 0..x.len() {
                for column in 0..x.len() {
                    jacobian[(row, column)] += stiffness * a[row] * a[column];
                }
            }
        }
    }

    /// The shafts of a cluster in which several share a torque.
    pub(super) fn shared(&self, equations: &EquationsOfMotion) -> Option<Shared> {
        let parallel = self.members.len() == 1;
        (!self.loops.is_empty()).then(|| Shared {
            connections: self.laws().collect(),
            asked: parallel.then(|| self.asked[0]),
            capacity: parallel.then(|| capacity_of(&self.single_law(equations))),
        })
    }

    /// What a cluster without any stable twist says about it.
    pub(super) fn overload(&self, equations: &EquationsOfMotion) -> Overload {
        let connections = self.laws().collect();
        if self.members.len() > 1 {
            return Overload { connections, asked: None, limit: None };
        }
        let asked = self.asked[0];
        let limits = capacity_of(&self.single_law(equations));
        let limit = if asked >= 0.0 { limits.positive } else { limits.negative };
        Overload { connections, asked: Some(asked), limit }
    }
}

/// Starts of the search for each unknown.
const STARTS: usize = 48;

/// Element `index` of the Halton sequence on axis `axis`: points that fill a box evenly.
fn halton(index: usize, axis: usize) -> f64 {
    const PRIMES: [usize; 12] = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37];
    let base = PRIMES[axis % PRIMES.len()];
    let (mut rest, mut digit, mut value) = (index + axis / PRIMES.len(), 1.0, 0.0);
    while rest > 0 {
        #[expect(clippy::cast_precision_loss, reason = "digits of a small base")]
        {
            digit /= base as f64;
            value += digit * (rest % base) as f64;
        }
        rest /= base;
    }
    value
}
