//! Which groups of a line keep their unknowns, and how the linear rest is taken out.
//!
//! The ends of nonlinear connections are kept. All other groups that hang on at most two others are
//! eliminated, leaves first: on a tree that is everything, in as many steps as there are groups, each
//! of which joins at most one pair of neighbours. What is left in a mesh (groups with three
//! neighbours or more) is kept as well, and the block solver takes care of it. So are, up to a number,
//! groups without any damping: taken out, they have a pole at their resonance with the neighbours held.

use std::collections::BTreeSet;

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_numerics::blocks::Pattern;

/// One group that is taken out.
#[derive(Clone, Debug)]
pub(super) struct Step {
    pub(super) group: usize,
    /// Its neighbours with the edges to them, at most two.
    pub(super) around: Vec<(usize, usize)>,
    /// The edge between its two neighbours.
    pub(super) between: Option<usize>,
}

/// The line as a graph of groups, with the order in which groups are taken out.
#[derive(Clone, Debug)]
pub(super) struct Skeleton {
    /// Kept groups, each a node of the block system.
    pub(super) kept: Vec<usize>,
    /// Node of each kept group.
    pub(super) node_of: Vec<Option<usize>>,
    pub(super) steps: Vec<Step>,
    /// Pairs of groups that are joined at some time.
    pub(super) edges: Vec<(usize, usize)>,
    /// Edge of each connection between two groups.
    pub(super) edge_of: Vec<Option<usize>>,
    /// Edges between kept groups, with their nodes.
    pub(super) kept_edges: Vec<(usize, usize, usize)>,
    /// Indices of the nonlinear connections.
    pub(super) nonlinear: Vec<usize>,
    pub(super) pattern: Pattern,
}

impl Skeleton {
    /// The skeleton of a line of which the flagged connections count as nonlinear.
    pub(super) fn new(equations: &EquationsOfMotion, nonlinear: &[bool]) -> Self {
        let groups = equations.groups();
        let (graph, mut keep, edge_of) = Graph::of(equations, nonlinear);
        let undamped = undamped(equations);
        if undamped.iter().filter(|alone| **alone).count() <= MOST_UNDAMPED {
            keep.iter_mut().zip(&undamped).for_each(|(keep, alone)| *keep |= alone);
        }
        if !keep.contains(&true) {
            // A linear line: any group can stand for it.
            keep[groups - 1] = true;
        }
        Self::reduced(graph, &keep, edge_of, nonlinear)
    }

    /// The same with no group taken out, for holding the elimination against.
    #[cfg(test)]
    pub(super) fn keeping_all(equations: &EquationsOfMotion, nonlinear: &[bool]) -> Self {
        let (graph, _, edge_of) = Graph::of(equations, nonlinear);
        Self::reduced(graph, &vec![true; equations.groups()], edge_of, nonlinear)
    }

    /// Takes out what is not to be kept.
    fn reduced(
        mut graph: Graph,
        keep: &[bool],
        edge_of: Vec<Option<usize>>,
        nonlinear: &[bool],
    ) -> Self {
        let groups = keep.len();
        let steps = graph.eliminate(keep);
        let gone: BTreeSet<usize> = steps.iter().map(|step| step.group).collect();
        let kept: Vec<usize> = (0..groups).filter(|group| !gone.contains(group)).collect();
        let mut node_of = vec![None; groups];
        for (node, group) in kept.iter().enumerate() {
            node_of[*group] = Some(node);
        }
        let joined = graph.edges.iter().enumerate();
        let kept_edges: Vec<(usize, usize, usize)> =
            joined.filter_map(|(edge, (a, b))| Some((edge, node_of[*a]?, node_of[*b]?))).collect();
        let pattern = Pattern::new(kept.len(), kept_edges.iter().map(|(_, a, b)| (*a, *b)));
        let nonlinear = (0..nonlinear.len()).filter(|index| nonlinear[*index]).collect();
        let edges = graph.edges;
        Self { kept, node_of, steps, edges, edge_of, kept_edges, nonlinear, pattern }
    }
}

/// Undamped groups that are kept at most.
const MOST_UNDAMPED: usize = 40;

/// Which groups nothing damps.
fn undamped(equations: &EquationsOfMotion) -> Vec<bool> {
    let mut list: Vec<bool> = equations.ground_damping.iter().map(|d| *d == 0.0).collect();
    for connection in equations.connections.iter().filter(|c| c.damping != 0.0) {
        for (group, _) in [connection.from, connection.to].into_iter().flatten() {
            list[group] = false;
        }
    }
    list
}

struct Graph {
    edges: Vec<(usize, usize)>,
    /// Neighbours of each group with the edges to them.
    around: Vec<Vec<(usize, usize)>>,
}

impl Graph {
    fn new(groups: usize) -> Self {
        Self { edges: Vec::new(), around: vec![Vec::new(); groups] }
    }

    /// The graph of a line, which groups are ends of its nonlinear connections, and the edge of each
    /// connection.
    fn of(
        equations: &EquationsOfMotion,
        nonlinear: &[bool],
    ) -> (Self, Vec<bool>, Vec<Option<usize>>) {
        let mut graph = Self::new(equations.groups());
        let mut ends_of_nonlinear = vec![false; equations.groups()];
        let mut edge_of = Vec::with_capacity(equations.connections.len());
        for (connection, nonlinear) in equations.connections.iter().zip(nonlinear) {
            let ends = [connection.from, connection.to].map(|end| end.map(|(group, _)| group));
            if *nonlinear {
                ends.iter().flatten().for_each(|group| ends_of_nonlinear[*group] = true);
            }
            edge_of.push(match ends {
                [Some(a), Some(b)] if a != b => Some(graph.edge(a, b)),
                _ => None,
            });
        }
        (graph, ends_of_nonlinear, edge_of)
    }

    /// The edge between two groups, made where it is missing.
    fn edge(&mut self, a: usize, b: usize) -> usize {
        if let Some((_, edge)) = self.around[a].iter().find(|(group, _)| *group == b) {
            return *edge;
        }
        let edge = self.edges.len();
        self.edges.push((a, b));
        self.around[a].push((b, edge));
        self.around[b].push((a, edge));
        edge
    }

    fn eliminate(&mut self, keep: &[bool]) -> Vec<Step> {
        let mut steps = Vec::new();
        let mut queue: BTreeSet<(usize, usize)> = (0..self.around.len())
            .filter(|group| !keep[*group] && self.around[*group].len() <= 2)
            .map(|group| (self.around[group].len(), group))
            .collect();
        while let Some((degree, group)) = queue.pop_first() {
            let around = std::mem::take(&mut self.around[group]);
            debug_assert_eq!(degree, around.len());
            for (other, _) in &around {
                let before = self.around[*other].len();
                self.around[*other].retain(|(back, _)| *back != group);
                queue.remove(&(before, *other));
            }
            let between = match around[..] {
                [(a, _), (b, _)] => Some(self.edge(a, b)),
                _ => None,
            };
            for (other, _) in &around {
                let degree = self.around[*other].len();
                if !keep[*other] && degree <= 2 {
                    queue.insert((degree, *other));
                }
            }
            steps.push(Step { group, around, between });
        }
        steps
    }
}
