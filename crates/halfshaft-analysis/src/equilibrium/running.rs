//! How the line runs under its mean torques, and what is left for the shafts.

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_results::{Named, Running, RunningKind};

/// Uniform running of a line.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct RunningState {
    pub(crate) kind: RunningKind,
    /// Acceleration of the first group's reference, rad/s².
    pub(crate) acceleration: f64,
    /// Speed of the first group's reference, rad/s.
    pub(crate) speed: f64,
    /// Mean torques less inertia and drag, on each group, N·m; they sum to nothing.
    pub(crate) forces: Vec<f64>,
}

/// Mean torques that cancel to this part count as balanced.
const BALANCED: f64 = 1e-9;

impl RunningState {
    /// The running of a line under its mean torques.
    pub(crate) fn of(equations: &EquationsOfMotion) -> Self {
        let mean = equations.excitation.mean(equations.groups());
        let Some(rigid) = &equations.rigid else {
            let kind = RunningKind::Held;
            return Self { kind, acceleration: 0.0, speed: 0.0, forces: mean };
        };
        let total = rigid.torque(&mean);
        let size: f64 = mean.iter().zip(&rigid.speeds).map(|(q, r)| (q * r).abs()).sum();
        let balanced = total.abs() <= BALANCED * size;
        if !balanced && rigid.ground_damping > 0.0 {
            let speed = total / rigid.ground_damping;
            let forces = mean
                .iter()
                .zip(&equations.ground_damping)
                .zip(&rigid.speeds)
                .map(|((q, d), r)| q - d * r * speed)
                .collect();
            let kind = RunningKind::SteadySpeed;
            return Self { kind, acceleration: 0.0, speed, forces };
        }
        let acceleration = total / rigid.inertia;
        let forces = mean
            .iter()
            .zip(&equations.inertia)
            .zip(&rigid.speeds)
            .map(|((q, m), r)| q - m * r * acceleration)
            .collect();
        let (kind, acceleration) = if balanced {
            (RunningKind::Balanced, 0.0)
        } else {
            (RunningKind::Accelerating, acceleration)
        };
        Self { kind, acceleration, speed: 0.0, forces }
    }

    /// The same as a result.
    pub(crate) fn result(&self, equations: &EquationsOfMotion) -> Running {
        let balancing: Named<f64> = equations
            .excitation
            .sources
            .iter()
            .filter(|source| source.balances)
            .map(|source| (source.name.clone(), source.mean))
            .collect();
        let node = equations.reference.first().map(|node| equations.nodes[*node].name.clone());
        Running {
            kind: self.kind,
            node: node.unwrap_or_default(),
            acceleration: self.acceleration,
            speed: self.speed,
            balancing,
        }
    }
}
