//! How a line hangs together: its nodes, what connects them, and the chains to draw it by.
//!
//! The longest way through the line is the main chain; what branches off it is a chain of its own,
//! and so on. Connections that close a loop belong to no chain.

use std::collections::HashMap;

use halfshaft_results::CheckResult;

pub(crate) use chains::{Chain, Chains};

mod chains;

/// Name of the fixed node in models.
const GROUND: &str = "ground";

/// A node of the line, or one place where the line is held.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Node {
    pub(crate) name: String,
    /// Its own inertia, kg·m²; 0 where it has none.
    pub(crate) inertia: f64,
    /// Its damping to ground, N·m·s/rad.
    pub(crate) damping: f64,
    pub(crate) is_ground: bool,
    /// Torques on it, by their place in the result.
    pub(crate) torques: Vec<usize>,
}

/// What connects two nodes, by its place in the result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Part {
    Gear(usize),
    Shaft(usize),
}

/// A connection between two nodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Edge {
    pub(crate) part: Part,
    pub(crate) from: usize,
    pub(crate) to: usize,
}

/// The line as nodes and connections.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Network {
    pub(crate) nodes: Vec<Node>,
    pub(crate) edges: Vec<Edge>,
}

impl Network {
    pub(crate) fn new(check: &CheckResult) -> Self {
        let mut builder = Builder::default();
        for member in check.reduced_inertias.iter().flat_map(|group| &group.members) {
            let node = builder.node(&member.node);
            let node = &mut builder.network.nodes[node];
            (node.inertia, node.damping) = (member.inertia, member.damping);
        }
        for (index, gear) in check.gears.iter().enumerate() {
            builder.edge(Part::Gear(index), &gear.input, &gear.output);
        }
        for (index, shaft) in check.shafts.iter().enumerate() {
            builder.edge(Part::Shaft(index), &shaft.from, &shaft.to);
        }
        for (index, torque) in check.torques.iter().enumerate() {
            let node = builder.node(&torque.on);
            builder.network.nodes[node].torques.push(index);
        }
        builder.network
    }

    /// The chains that the line is drawn by.
    pub(crate) fn chains(&self) -> Chains {
        Chains::of(self)
    }
}

#[derive(Default)]
struct Builder {
    network: Network,
    by_name: HashMap<String, usize>,
}

impl Builder {
    /// The node of that name; the ground is a new place each time.
    fn node(&mut self, name: &str) -> usize {
        let is_ground = name == GROUND;
        if let Some(known) = self.by_name.get(name).filter(|_| !is_ground) {
            return *known;
        }
        let index = self.network.nodes.len();
        self.network.nodes.push(Node {
            name: name.to_owned(),
            inertia: 0.0,
            damping: 0.0,
            is_ground,
            torques: Vec::new(),
        });
        if !is_ground {
            self.by_name.insert(name.to_owned(), index);
        }
        index
    }

    fn edge(&mut self, part: Part, from: &str, to: &str) {
        let (from, to) = (self.node(from), self.node(to));
        self.network.edges.push(Edge { part, from, to });
    }
}
