//! A line prepared for harmonic balance: its nonlinear connections, skeleton and mean loads.

use std::rc::Rc;

use halfshaft_dynamics::EquationsOfMotion;

use super::skeleton::Skeleton;
use crate::equilibrium::RunningState;

/// A nonlinear connection seen from the kept groups.
#[derive(Clone, Debug)]
pub(super) struct NonlinearTwist {
    /// Index of the connection.
    pub(super) connection: usize,
    /// Twist as a sum of factors times the angles of nodes; at most two.
    pub(super) parts: Vec<(usize, f64)>,
    /// `wᵀ M⁻¹ w`, 1/(kg·m²): its twist yields so much to fast torques.
    pub(super) mobility: f64,
}

/// A line with what harmonic balance derives from it once.
#[derive(Clone, Debug)]
pub(crate) struct Line {
    pub(crate) equations: Rc<EquationsOfMotion>,
    pub(super) skeleton: Rc<Skeleton>,
    /// Stiffness that each connection gives to the linear part, N·m/rad: none for nonlinear ones.
    pub(super) stiffness: Vec<f64>,
    /// Mean torque on each group, N·m: what running leaves, less preloads of linear connections.
    pub(super) mean: Vec<f64>,
    pub(super) twists: Vec<NonlinearTwist>,
    /// Whether the line turns freely.
    pub(super) free: bool,
}

/// Mean torques below this part of all loads are rounding.
const NEGLIGIBLE: f64 = 1e-13;

/// Which connections of a line are nonlinear.
pub(super) fn nonlinear(equations: &EquationsOfMotion) -> Vec<bool> {
    let of = |c: &halfshaft_dynamics::Connection| !c.law.is_linear() || c.friction.is_some();
    equations.connections.iter().map(of).collect()
}

impl Line {
    /// A line by itself.
    pub(crate) fn new(equations: Rc<EquationsOfMotion>) -> Self {
        let flags = nonlinear(&equations);
        let skeleton = Rc::new(Skeleton::new(&equations, &flags));
        Self::with_skeleton(equations, skeleton)
    }

    /// A line whose flagged connections count as nonlinear even where they are not, for families of
    /// lines along a parameter.
    pub(super) fn flagged(equations: Rc<EquationsOfMotion>, flags: &[bool]) -> Self {
        let skeleton = Rc::new(Skeleton::new(&equations, flags));
        Self::with_skeleton(equations, skeleton)
    }

    /// Another line of the same shape.
    pub(super) fn with_skeleton(equations: Rc<EquationsOfMotion>, skeleton: Rc<Skeleton>) -> Self {
        let mut stiffness: Vec<f64> =
            equations.connections.iter().map(|c| c.law.stiffness(0.0)).collect();
        let running = RunningState::of(&equations);
        let mut mean = running.forces;
        let mut size = equations.excitation.scale();
        let mut is_nonlinear = vec![false; stiffness.len()];
        for &index in &skeleton.nonlinear {
            stiffness[index] = 0.0;
            is_nonlinear[index] = true;
        }
        for (index, connection) in equations.connections.iter().enumerate() {
            let preload = connection.law.torque(0.0);
            size += preload.abs();
            if !is_nonlinear[index] && preload != 0.0 {
                equations.add_direction(index, -preload, &mut mean);
            }
        }
        mean.iter_mut().filter(|q| q.abs() <= NEGLIGIBLE * size).for_each(|q| *q = 0.0);
        let twists = skeleton.nonlinear.iter().map(|index| twist(&equations, &skeleton, *index));
        Self {
            twists: twists.collect(),
            free: equations.rigid.is_some(),
            stiffness,
            mean,
            skeleton,
            equations,
        }
    }

    /// Whether every response has a mirror image half a period later: odd laws and no mean torque.
    pub(super) fn is_odd(&self) -> bool {
        let laws = self.twists.iter().map(|t| &self.equations.connections[t.connection].law);
        laws.into_iter().all(halfshaft_dynamics::TorqueLaw::is_odd)
            && self.mean.iter().all(|q| *q == 0.0)
    }

    /// Whether a law is not smooth: its torque has kinks, in itself or in a higher derivative, or
    /// friction bends within a small speed.
    pub(super) fn has_kinks(&self) -> bool {
        self.twists.iter().any(|twist| {
            let connection = &self.equations.connections[twist.connection];
            !connection.law.is_smooth() || connection.friction.is_some()
        })
    }

    /// Pieces of the laws of the nonlinear connections.
    pub(super) fn pieces(&self) -> Vec<halfshaft_dynamics::laws::Pieces> {
        let laws = self.twists.iter().map(|t| &self.equations.connections[t.connection].law);
        laws.map(halfshaft_dynamics::laws::TorqueLaw::pieces).collect()
    }

    /// Number of nodes of the block system.
    pub(super) fn nodes(&self) -> usize {
        self.skeleton.kept.len()
    }
}

fn twist(equations: &EquationsOfMotion, skeleton: &Skeleton, index: usize) -> NonlinearTwist {
    let connection = &equations.connections[index];
    let ends = [connection.from, connection.to.map(|(group, ratio)| (group, -ratio))];
    let mut parts: Vec<(usize, f64)> = Vec::new();
    let mut mobility = 0.0;
    for (group, factor) in ends.into_iter().flatten() {
        let Some(node) = skeleton.node_of[group] else { continue };
        match parts.iter_mut().find(|(known, _)| *known == node) {
            Some((_, sum)) => *sum += factor,
            None => parts.push((node, factor)),
        }
    }
    for (node, factor) in &parts {
        mobility += factor * factor / equations.inertia[skeleton.kept[*node]];
    }
    NonlinearTwist { connection: index, parts, mobility }
}
