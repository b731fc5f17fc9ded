//! Elimination order of a graph and the places of its blocks.

use std::sync::Arc;

/// Which blocks a system on a graph has, in order of elimination. Copies share one store.
#[derive(Debug, Clone)]
pub struct Pattern(Arc<Places>);

#[derive(Debug, PartialEq, Eq)]
struct Places {
    /// Node at each position of the order.
    order: Vec<usize>,
    /// Position of each node.
    position: Vec<usize>,
    /// For each position the later positions it is joined to, ascending, fill included.
    later: Vec<Vec<usize>>,
    /// For each position the place of its first off-diagonal block.
    first: Vec<usize>,
    /// Number of off-diagonal pairs.
    pairs: usize,
}

impl PartialEq for Pattern {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0) || self.0 == other.0
    }
}

impl Eq for Pattern {}

impl Pattern {
    /// The pattern of a graph of `nodes` nodes (at least one) and the given edges.
    pub fn new(nodes: usize, edges: impl IntoIterator<Item = (usize, usize)>) -> Self {
        let mut joined = vec![std::collections::BTreeSet::new(); nodes];
        for (a, b) in edges {
            if a != b {
                joined[a].insert(b);
                joined[b].insert(a);
            }
        }
        let mut order = Vec::with_capacity(nodes);
        let mut later_nodes = Vec::with_capacity(nodes);
        // Those with the fewest neighbours first, and of those the first.
        let mut left: std::collections::BTreeSet<(usize, usize)> =
            joined.iter().enumerate().map(|(node, around)| (around.len(), node)).collect();
        while let Some((_, node)) = left.pop_first() {
            let around: Vec<usize> = joined[node].iter().copied().collect();
            for &a in &around {
                left.remove(&(joined[a].len(), a));
                joined[a].remove(&node);
                joined[a].extend(around.iter().copied().filter(|b| *b != a));
                left.insert((joined[a].len(), a));
            }
            order.push(node);
            later_nodes.push(around);
        }
        let mut position = vec![0; nodes];
        for (at, node) in order.iter().enumerate() {
            position[*node] = at;
        }
        let later: Vec<Vec<usize>> = later_nodes
            .into_iter()
            .map(|around| {
                let mut places: Vec<usize> =
                    around.into_iter().map(|node| position[node]).collect();
                places.sort_unstable();
                places
            })
            .collect();
        let mut first = Vec::with_capacity(nodes);
        let mut pairs = 0;
        for list in &later {
            first.push(pairs);
            pairs += list.len();
        }
        Self(Arc::new(Places { order, position, later, first, pairs }))
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.0.order.len()
    }

    /// Position of a node in the order of elimination.
    #[inline]
    pub fn position(&self, node: usize) -> usize {
        self.0.position[node]
    }

    /// The node that is eliminated last, with the border.
    pub fn last(&self) -> usize {
        self.0.order.last().copied().unwrap_or(0)
    }

    /// The node at a position of the order.
    #[inline]
    pub(super) fn node(&self, position: usize) -> usize {
        self.0.order[position]
    }

    pub(super) fn later(&self, position: usize) -> &[usize] {
        &self.0.later[position]
    }

    pub(super) fn first(&self, position: usize) -> usize {
        self.0.first[position]
    }

    pub(super) fn pairs(&self) -> usize {
        self.0.pairs
    }

    /// Place of the pair of blocks between two positions, the earlier one first.
    #[inline]
    pub(super) fn pair(&self, earlier: usize, later: usize) -> usize {
        let list = &self.0.later[earlier];
        let at = list.partition_point(|other| *other < later);
        debug_assert_eq!(list.get(at), Some(&later), "no such block");
        self.0.first[earlier] + at
    }
}
