//! A line taken apart into chains.

use std::collections::VecDeque;

use super::Network;

/// Nodes in a row with the connections between them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Chain {
    /// The node of an earlier chain from which this one branches off, and the connection there.
    pub(crate) start: Option<(usize, usize)>,
    pub(crate) nodes: Vec<usize>,
    /// Between one node and the next.
    pub(crate) edges: Vec<usize>,
}

/// The line as chains: the main one first, every branch after the chain that it leaves.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Chains {
    pub(crate) chains: Vec<Chain>,
    /// Connections that close loops.
    pub(crate) loops: Vec<usize>,
}

/// A tree within a part of the line that hangs together.
struct Tree {
    /// Nodes, each after its parent.
    order: Vec<usize>,
    /// For every node the connection to its parent and the parent itself.
    parent: Vec<Option<(usize, usize)>>,
}

impl Chains {
    pub(super) fn of(network: &Network) -> Self {
        let adjacent = adjacency(network);
        let mut chains = Self::default();
        let mut seen = vec![false; network.nodes.len()];
        let mut in_tree = vec![false; network.edges.len()];
        for first in 0..network.nodes.len() {
            if seen[first] {
                continue;
            }
            let spanning = Tree::grow(&adjacent, first, |_| true);
            for node in &spanning.order {
                seen[*node] = true;
                if let Some((edge, _)) = spanning.parent[*node] {
                    in_tree[edge] = true;
                }
            }
            let (start, end) = longest_way(network, &adjacent, &spanning, &in_tree);
            let tree = Tree::grow(&adjacent, start, |edge| in_tree[edge]);
            chains.add(&tree, end);
        }
        chains.loops = (0..in_tree.len()).filter(|edge| !in_tree[*edge]).collect();
        chains
    }

    /// Adds a tree: the way from its root to `end`, then the branches, those of later nodes first.
    fn add(&mut self, tree: &Tree, end: usize) {
        let next = tree.next_in_chain(end);
        let children = tree.children();
        let Some(root) = tree.order.first() else { return };
        let mut open = vec![(None, *root)];
        while let Some((start, first)) = open.pop() {
            let mut chain = Chain { start, nodes: vec![first], edges: Vec::new() };
            let mut at = first;
            while let Some(child) = next[at] {
                chain.nodes.push(child);
                chain.edges.extend(tree.parent[child].map(|(edge, _)| edge));
                at = child;
            }
            for node in &chain.nodes {
                // What is pushed last is taken first: branches of the last node.
                for child in children[*node].iter().rev().filter(|c| next[*node] != Some(**c)) {
                    open.push((tree.parent[*child].map(|(edge, _)| (*node, edge)), *child));
                }
            }
            self.chains.push(chain);
        }
    }
}

impl Tree {
    /// All nodes within reach of the first over the allowed connections, nearest first.
    fn grow(adjacent: &[Vec<(usize, usize)>], first: usize, allow: impl Fn(usize) -> bool) -> Self {
        let mut parent = vec![None; adjacent.len()];
        let mut order = Vec::new();
        let mut reached = vec![false; adjacent.len()];
        let mut open = VecDeque::from([first]);
        reached[first] = true;
        while let Some(node) = open.pop_front() {
            order.push(node);
            for (edge, other) in adjacent[node].iter().filter(|(edge, _)| allow(*edge)) {
                if !reached[*other] {
                    reached[*other] = true;
                    parent[*other] = Some((*edge, node));
                    open.push_back(*other);
                }
            }
        }
        Self { order, parent }
    }

    /// Number of connections from the root to every node.
    fn depths(&self) -> Vec<usize> {
        let mut depths = vec![0_usize; self.parent.len()];
        for node in &self.order {
            depths[*node] = self.parent[*node].map_or(0, |(_, parent)| depths[parent] + 1);
        }
        depths
    }

    /// The node farthest from the root, the first of equals.
    fn farthest(&self) -> usize {
        let depths = self.depths();
        let mut best = self.order[0];
        for node in &self.order {
            if depths[*node] > depths[best] {
                best = *node;
            }
        }
        best
    }

    fn children(&self) -> Vec<Vec<usize>> {
        let mut children = vec![Vec::new(); self.parent.len()];
        for node in &self.order {
            if let Some((_, parent)) = self.parent[*node] {
                children[parent].push(*node);
            }
        }
        children
    }

    /// For every node the child with which its chain goes on: towards `end` if that lies beyond,
    /// else the one with the longest way ahead.
    fn next_in_chain(&self, end: usize) -> Vec<Option<usize>> {
        let mut ahead = vec![0_usize; self.parent.len()];
        let mut next: Vec<Option<usize>> = vec![None; self.parent.len()];
        for node in self.order.iter().rev() {
            let Some((_, parent)) = self.parent[*node] else { continue };
            let length = ahead[*node] + 1;
            // From the back, so that the first of equals wins.
            if length >= ahead[parent] {
                (ahead[parent], next[parent]) = (length, Some(*node));
            }
        }
        let mut node = end;
        while let Some((_, parent)) = self.parent[node] {
            next[parent] = Some(node);
            node = parent;
        }
        next
    }
}

fn adjacency(network: &Network) -> Vec<Vec<(usize, usize)>> {
    let mut adjacent = vec![Vec::new(); network.nodes.len()];
    for (index, edge) in network.edges.iter().enumerate() {
        adjacent[edge.from].push((index, edge.to));
        adjacent[edge.to].push((index, edge.from));
    }
    adjacent
}

/// Both ends of the longest way through a tree, the one nearer to the first torque first.
fn longest_way(
    network: &Network,
    adjacent: &[Vec<(usize, usize)>],
    spanning: &Tree,
    in_tree: &[bool],
) -> (usize, usize) {
    let one = spanning.farthest();
    let other = Tree::grow(adjacent, one, |edge| in_tree[edge]).farthest();
    let first_torque = |node: &&usize| network.nodes[**node].torques.first().copied();
    let driven = spanning.order.iter().filter(|node| first_torque(node).is_some());
    let driver = driven.min_by_key(first_torque);
    let depths = driver.map(|node| Tree::grow(adjacent, *node, |edge| in_tree[edge]).depths());
    // Drive stands at the left, ground at the right.
    let rank = |index: usize| {
        let distance = depths.as_ref().map_or(0, |depths| depths[index]);
        (network.nodes[index].is_ground, distance, index)
    };
    if rank(one) <= rank(other) { (one, other) } else { (other, one) }
}
