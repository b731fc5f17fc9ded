//! A mode as it is told: its shape, the shares of its energies, and what it is in words.

use halfshaft_dynamics::{Connection, EquationsOfMotion, NodePlace};
use halfshaft_numerics::Complex;
use halfshaft_results::{Mode, Named, Names};

use super::answer::damping_ratio;
use super::elastic::ElasticMode;
use super::label::label;
use crate::equilibrium::RestState;

/// What the modes of a line have in common.
pub(super) struct Telling<'l> {
    equations: &'l EquationsOfMotion,
    nodes: Names,
    connections: Names,
    /// Places of the nodes that have an inertia, and their names.
    bodies: Vec<&'l NodePlace>,
    body_names: Names,
    /// Tangent stiffness of each connection.
    stiffness: Vec<f64>,
    /// Some connection is in its gap.
    play: bool,
}

impl<'l> Telling<'l> {
    pub(super) fn of(equations: &'l EquationsOfMotion, state: &RestState) -> Self {
        let bodies: Vec<&NodePlace> =
            equations.nodes.iter().filter(|node| node.inertia > 0.0).collect();
        let tangent = |(connection, x): (&Connection, &f64)| connection.law.stiffness(*x);
        let stiffness: Vec<f64> =
            equations.connections.iter().zip(&state.twists).map(tangent).collect();
        let mut laws = equations.connections.iter().zip(&stiffness);
        Self {
            nodes: equations.nodes.iter().map(|node| node.name.as_str()).collect(),
            connections: equations.connections.iter().map(|c| c.name.as_str()).collect(),
            body_names: bodies.iter().map(|node| node.name.as_str()).collect(),
            play: laws.any(|(connection, k)| *k == 0.0 && !connection.law.is_linear()),
            bodies,
            stiffness,
            equations,
        }
    }

    pub(super) fn rigid(&self, speeds: &[f64], pair: [Complex; 2]) -> Mode {
        let (shape, _) = self.node_shape(speeds);
        let none = || named(&self.connections, vec![0.0; self.equations.connections.len()]);
        Mode {
            frequency: 0.0,
            damped_frequency: 0.0,
            damping_ratio: 0.0,
            shape: named(&self.nodes, shape),
            twist: none(),
            strain_energy: none(),
            kinetic_energy: named(&self.body_names, self.kinetic_shares(speeds)),
            eigenvalues: pair.map(|value| (value.re, value.im)),
            label: "rigid-body motion: the whole line turns without twist".to_owned(),
        }
    }

    pub(super) fn elastic(&self, mode: &ElasticMode, pair: [Complex; 2]) -> Mode {
        let (shape, scale) = self.node_shape(&mode.shape);
        let twists = mode.twists.iter().map(|twist| twist / scale).collect();
        let strain = self.strain_shares(mode);
        let kinetic = self.kinetic_shares(&mode.shape);
        let mut label = self.words(&strain, &kinetic);
        if mode.eigenvalue < 0.0 {
            label = format!("unstable, moves away without vibrating: {label}");
        } else if mode.eigenvalue == 0.0 {
            label = self.without_vibration(&strain, &shape, &label);
        }
        Mode {
            frequency: mode.frequency(),
            damped_frequency: pair[0].im.abs(),
            damping_ratio: damping_ratio(pair),
            shape: named(&self.nodes, shape),
            twist: named(&self.connections, twists),
            strain_energy: named(&self.connections, strain),
            kinetic_energy: named(&self.body_names, kinetic),
            eigenvalues: pair.map(|value| (value.re, value.im)),
            label,
        }
    }

    fn without_vibration(&self, strain: &[f64], shape: &[f64], label: &str) -> String {
        if self.play || strain.iter().any(|share| *share != 0.0) {
            return format!("free play, no vibration: {label}");
        }
        let nodes = self.equations.nodes.iter().zip(shape);
        let most = nodes.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
        let most = most.map_or("", |(node, _)| node.name.as_str());
        format!("no vibration: {most} turns freely")
    }

    /// Motion of every node for a motion of the groups, the largest 1; and the scale taken out.
    fn node_shape(&self, groups: &[f64]) -> (Vec<f64>, f64) {
        let motion = |node: &NodePlace| node.ratio * groups[node.group];
        let mut shape: Vec<f64> = self.equations.nodes.iter().map(motion).collect();
        let largest = shape.iter().copied().max_by(|a, b| a.abs().total_cmp(&b.abs()));
        let largest = largest.filter(|largest| *largest != 0.0).unwrap_or(1.0);
        shape.iter_mut().for_each(|x| *x /= largest);
        (shape, largest)
    }

    /// Shares of the kinetic energy by inertia.
    fn kinetic_shares(&self, groups: &[f64]) -> Vec<f64> {
        let energy = |node: &&NodePlace| {
            let speed = node.ratio * groups[node.group];
            node.inertia * speed * speed
        };
        shares(self.bodies.iter().map(energy).collect())
    }

    /// Shares of the strain energy by connection, of magnitudes where a tangent is negative.
    fn strain_shares(&self, mode: &ElasticMode) -> Vec<f64> {
        let springs = self.stiffness.iter().zip(&mode.twists);
        shares(springs.map(|(stiffness, twist)| (stiffness * twist * twist).abs()).collect())
    }

    /// A mode in words.
    pub(super) fn in_words(&self, mode: &ElasticMode) -> String {
        self.words(&self.strain_shares(mode), &self.kinetic_shares(&mode.shape))
    }

    /// The same from the shares of its energies.
    fn words(&self, strain: &[f64], kinetic: &[f64]) -> String {
        label(
            strain,
            |index| self.equations.connections[index].name.as_str(),
            kinetic,
            |index| self.bodies[index].name.as_str(),
        )
    }
}

/// Parts of their sum; of nothing, nothing.
fn shares(mut energies: Vec<f64>) -> Vec<f64> {
    let total: f64 = energies.iter().sum();
    if total > 0.0 {
        energies.iter_mut().for_each(|energy| *energy /= total);
    }
    energies
}

fn named(names: &Names, values: Vec<f64>) -> Named<f64> {
    // The values were counted by the list that the names are from.
    Named::of(names, values).unwrap_or_default()
}
