//! Where every part lies.
//!
//! The main chain is cut into rows that fit a page. Branches hang below their row: those of nodes
//! farther right come first, so that the trunk of a branch never crosses another branch.

use std::collections::HashMap;

use super::caption::{Caption, Captions, LEADING};
use crate::figure::scene::Point;
use crate::topology::{Chain, Chains, Network};

/// Width of a row of the main chain in points: the column of a page.
const PAGE: f64 = 600.0;
/// Shortest connection.
const SHORTEST: f64 = 62.0;
/// Between texts of neighbours.
const CLEAR: f64 = 10.0;
/// Half of the width of a plate.
pub(super) const PLATE: f64 = 5.0;
/// Heights of half a plate, of the smallest and of the largest inertia.
const HALF_HEIGHTS: (f64, f64) = (13.0, 38.0);
/// Room for a torque's arrow above a plate.
pub(super) const ARROW: f64 = 22.0;
/// From the axis to the first line of text below a connection.
pub(super) const BELOW_EDGE: f64 = 22.0;
/// From the axis to the last line of text above a connection.
pub(super) const ABOVE_EDGE: f64 = 17.0;
/// Between rows.
const ROW_GAP: f64 = 16.0;
/// Around everything.
pub(super) const EDGE: f64 = 10.0;

/// A connection: a line of corners whose last part, level, holds the symbol.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Run {
    pub(super) edge: usize,
    /// The end that lies to the left.
    pub(super) start: usize,
    pub(super) corners: Vec<Point>,
}

/// Where everything lies.
pub(super) struct Layout {
    /// Of every node.
    pub(super) places: Vec<Point>,
    /// Base line of the first line below every node.
    pub(super) text_below: Vec<f64>,
    /// Base line of the last line above every node.
    pub(super) text_above: Vec<f64>,
    pub(super) runs: Vec<Run>,
    pub(super) width: f64,
    pub(super) height: f64,
}

/// A row while it is filled.
#[derive(Clone, Debug, Default)]
struct Row {
    /// Nodes with their places along the row.
    nodes: Vec<(usize, f64)>,
    /// Connections: edge, left end, start and end of the level part; whether it hangs off a trunk.
    links: Vec<Link>,
    /// Left end of what was put in first; later chains lie left of it.
    left: f64,
}

#[derive(Clone, Copy, Debug)]
struct Link {
    edge: usize,
    start: usize,
    end: usize,
    from: f64,
    to: f64,
    joins: Joins,
}

/// How a connection begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Joins {
    /// At the node to its left.
    Level,
    /// At a trunk that comes down from a row above.
    Trunk,
    /// At the end of the row before, round the corner.
    Corner,
}

/// Half of the height of the plate of an inertia: by the logarithm between smallest and largest.
pub(super) fn half_heights(network: &Network) -> Vec<f64> {
    let usable = |inertia: f64| inertia.is_finite() && inertia > 0.0;
    let logs = || network.nodes.iter().map(|n| n.inertia).filter(|i| usable(*i)).map(f64::ln);
    let (low, high) =
        (logs().fold(f64::INFINITY, f64::min), logs().fold(f64::NEG_INFINITY, f64::max));
    let share = |inertia: f64| {
        // Inertias that differ little should not look very different.
        let span = (high - low).max(3.0);
        ((inertia.ln() - low) + (span - (high - low)) / 2.0) / span
    };
    let of = |node: &crate::topology::Node| match () {
        () if node.is_ground => 17.0,
        () if usable(node.inertia) => {
            HALF_HEIGHTS.0 + share(node.inertia) * (HALF_HEIGHTS.1 - HALF_HEIGHTS.0)
        }
        () => 2.5,
    };
    network.nodes.iter().map(of).collect()
}

/// Lays out a line.
pub(super) fn lay_out(network: &Network, chains: &Chains, captions: &Captions) -> Layout {
    let mut placer = Placer::new(network, captions);
    let trees = chains.chains.iter().enumerate().filter(|(_, chain)| chain.start.is_none());
    let roots: Vec<usize> = trees.map(|(index, _)| index).collect();
    for (number, root) in roots.iter().enumerate() {
        let next = roots.get(number + 1).copied().unwrap_or(chains.chains.len());
        placer.tree(&chains.chains[*root..next]);
    }
    placer.finish()
}

struct Placer<'a> {
    network: &'a Network,
    captions: &'a Captions,
    halves: Vec<f64>,
    rows: Vec<Row>,
    /// Row and place along it of every node.
    of_node: Vec<(usize, f64)>,
    /// Nodes from which a branch hangs.
    branching: Vec<bool>,
}

impl<'a> Placer<'a> {
    fn new(network: &'a Network, captions: &'a Captions) -> Self {
        let count = network.nodes.len();
        Self {
            network,
            captions,
            halves: half_heights(network),
            rows: Vec::new(),
            of_node: vec![(0, 0.0); count],
            branching: vec![false; count],
        }
    }

    /// A main chain with its branches, which follow it.
    fn tree(&mut self, chains: &[Chain]) {
        let Some((main, branches)) = chains.split_first() else { return };
        let mut leaving: HashMap<usize, Vec<&Chain>> = HashMap::new();
        for branch in branches {
            if let Some((node, _)) = branch.start {
                self.branching[node] = true;
                leaving.entry(node).or_default().push(branch);
            }
        }
        let mut first = 0;
        while first < main.nodes.len() {
            let band = self.rows.len();
            let next = self.band(main, first);
            self.branches(&main.nodes[first..next], &leaving, band);
            first = next;
        }
    }

    /// The branches that hang from some nodes, and theirs; those farther right first.
    fn branches(&mut self, nodes: &[usize], leaving: &HashMap<usize, Vec<&Chain>>, band: usize) {
        let of = |node: &usize| leaving.get(node).into_iter().flatten().rev().copied();
        let mut open: Vec<&Chain> = nodes.iter().flat_map(of).collect();
        while let Some(branch) = open.pop() {
            self.branch(branch, band);
            open.extend(branch.nodes.iter().flat_map(of));
        }
    }

    /// A row of the main chain from the node at `first` on; returns the first node left over.
    fn band(&mut self, main: &Chain, first: usize) -> usize {
        let row = self.rows.len();
        self.rows.push(Row::default());
        let node = main.nodes[first];
        let mut at = self.half_width(node);
        if first > 0 {
            let edge = main.edges[first - 1];
            let (start, from) = (main.nodes[first - 1], 0.0);
            at = from + self.edge_length(edge) + self.plate(node);
            at = at.max(self.half_width(node));
            let to = at - self.plate(node);
            let joins = Joins::Corner;
            self.rows[row].links.push(Link { edge, start, end: node, from, to, joins });
        }
        self.put(node, row, at);
        for index in first + 1..main.nodes.len() {
            let next = main.nodes[index];
            let place = self.next_place(main.nodes[index - 1], next, main.edges[index - 1], at);
            if place + self.half_width(next) > PAGE {
                return index;
            }
            self.link(main.edges[index - 1], (main.nodes[index - 1], at), (next, place), row);
            at = place;
            self.put(next, row, at);
        }
        main.nodes.len()
    }

    fn branch(&mut self, chain: &Chain, band: usize) {
        let Some((node, edge)) = chain.start else { return };
        let (above, at) = self.of_node[node];
        let trunk = at + self.trunk(node);
        let mut places = Vec::new();
        let Some(first) = chain.nodes.first() else { return };
        let mut along = trunk + self.edge_length(edge) + self.plate(*first);
        along = along.max(trunk + 6.0 + self.half_width(*first));
        places.push(along);
        for (index, pair) in chain.nodes.windows(2).enumerate() {
            along = self.next_place(pair[0], pair[1], chain.edges[index], along);
            places.push(along);
        }
        let end = along + chain.nodes.last().map_or(0.0, |node| self.half_width(*node));
        let row = self.free_row(above.max(band), end + CLEAR);
        self.rows[row].left = self.rows[row].left.min(trunk);
        let to = places[0] - self.plate(*first);
        let joins = Joins::Trunk;
        self.rows[row].links.push(Link { edge, start: node, end: *first, from: trunk, to, joins });
        for (index, (node, place)) in chain.nodes.iter().zip(&places).enumerate() {
            if index > 0 {
                let before = (chain.nodes[index - 1], places[index - 1]);
                self.link(chain.edges[index - 1], before, (*node, *place), row);
            }
            self.put(*node, row, *place);
        }
    }

    /// A row below `above` that is free left of `end`; a new one where there is none.
    fn free_row(&mut self, above: usize, end: f64) -> usize {
        let free = (above + 1..self.rows.len()).find(|row| self.rows[*row].left > end);
        free.unwrap_or_else(|| {
            self.rows.push(Row { left: f64::INFINITY, ..Row::default() });
            self.rows.len() - 1
        })
    }

    fn put(&mut self, node: usize, row: usize, at: f64) {
        self.of_node[node] = (row, at);
        self.rows[row].nodes.push((node, at));
    }

    fn link(&mut self, edge: usize, from: (usize, f64), to: (usize, f64), row: usize) {
        let start = from.1 + self.leaves(from.0);
        let end = to.1 - self.plate(to.0);
        let joins = Joins::Level;
        self.rows[row].links.push(Link {
            edge,
            start: from.0,
            end: to.0,
            from: start,
            to: end,
            joins,
        });
    }

    /// The place of the next node of a chain.
    fn next_place(&self, node: usize, next: usize, edge: usize, at: f64) -> f64 {
        let start = at + self.leaves(node);
        let by_edge = start + self.edge_length(edge) + self.plate(next);
        let texts = at + self.half_width(node) + CLEAR + self.half_width(next);
        let beside_trunk = if self.branching[node] {
            start + 6.0 + self.half_width(next)
        } else {
            f64::NEG_INFINITY
        };
        by_edge.max(texts).max(beside_trunk)
    }

    /// From a node to where the connection to its right begins: beyond the trunk, if it has one.
    fn leaves(&self, node: usize) -> f64 {
        if self.branching[node] { self.trunk(node) } else { self.plate(node) }
    }

    /// From a node to the trunk of its branches, beside its texts.
    fn trunk(&self, node: usize) -> f64 {
        self.half_width(node) + 5.0
    }

    fn plate(&self, node: usize) -> f64 {
        if self.halves[node] < 3.0 { self.halves[node] } else { PLATE }
    }

    /// Half of the width of a node with its texts.
    fn half_width(&self, node: usize) -> f64 {
        (0.5 * self.captions.nodes[node].width()).max(PLATE + 4.0)
    }

    fn edge_length(&self, edge: usize) -> f64 {
        (self.captions.edges[edge].width() + 8.0).max(SHORTEST)
    }

    /// Heights of the rows, then all places.
    fn finish(self) -> Layout {
        let count = self.network.nodes.len();
        let mut layout = Layout {
            places: vec![Point::default(); count],
            text_below: vec![0.0; count],
            text_above: vec![0.0; count],
            runs: Vec::new(),
            width: 2.0 * EDGE,
            height: EDGE,
        };
        let mut axes = Vec::with_capacity(self.rows.len());
        let mut bottoms = Vec::with_capacity(self.rows.len());
        for row in &self.rows {
            let (above, to_text, below) = self.heights(row);
            let axis = layout.height + above;
            axes.push(axis);
            for (node, at) in &row.nodes {
                layout.places[*node] = Point::new(EDGE + at, axis);
                layout.text_below[*node] = axis + to_text;
                layout.text_above[*node] = axis - self.to_torques(row, *node);
                layout.width = layout.width.max(at + self.half_width(*node) + 2.0 * EDGE);
            }
            layout.height = axis + below + ROW_GAP;
            bottoms.push(layout.height - 0.5 * ROW_GAP);
        }
        layout.height -= ROW_GAP - 4.0;
        for (row, axis) in self.rows.iter().zip(&axes) {
            for link in &row.links {
                layout.runs.push(self.run(link, *axis, &layout.places, &bottoms));
            }
        }
        layout
    }

    /// Of a row: from its top to the axis, from there to the first text below the nodes, and from
    /// the axis to the bottom.
    fn heights(&self, row: &Row) -> (f64, f64, f64) {
        let (mut above, mut to_text, mut lines) = (20.0_f64, 24.0_f64, 0);
        for (node, _) in &row.nodes {
            let Caption { above: torques, below } = &self.captions.nodes[*node];
            let text = torques.len() as f64 * LEADING;
            above = above.max(if torques.is_empty() {
                self.halves[*node] + 4.0
            } else {
                self.to_torques(row, *node) + 2.0 + text
            });
            to_text = to_text.max(self.halves[*node] + 12.0);
            lines = lines.max(below.len());
        }
        for link in &row.links {
            let Caption { above: name, below } = &self.captions.edges[link.edge];
            above = above.max(ABOVE_EDGE + name.len() as f64 * LEADING);
            to_text = to_text.max(BELOW_EDGE + below.len() as f64 * LEADING + 3.0);
        }
        (above, to_text, to_text + lines as f64 * LEADING)
    }

    /// From the axis up to the last line of the torques on a node: clear of its arrow, and of the
    /// names of the connections beside it, over which that line may reach.
    fn to_torques(&self, row: &Row, node: usize) -> f64 {
        let names = row.links.iter().map(|link| self.captions.edges[link.edge].above.len());
        let names = names.max().unwrap_or(0) as f64;
        let beside = ABOVE_EDGE + names * LEADING + 2.0;
        (self.halves[node] + ARROW - 2.0).max(beside)
    }

    fn run(&self, link: &Link, axis: f64, places: &[Point], bottoms: &[f64]) -> Run {
        let level = [Point::new(EDGE + link.from, axis), Point::new(EDGE + link.to, axis)];
        let start = places[link.start];
        let mut corners = match link.joins {
            Joins::Level => vec![Point::new(start.x + self.plate(link.start), axis)],
            Joins::Trunk => {
                let above = Point::new(start.x + self.plate(link.start), start.y);
                vec![above, Point::new(level[0].x, start.y)]
            }
            Joins::Corner => {
                let row = self.of_node[link.end].0;
                // The lane between this row and whatever hangs above it.
                let lane = row.checked_sub(1).and_then(|row| bottoms.get(row)).copied();
                let lane = lane.unwrap_or(start.y);
                // To the right of everything that hangs above.
                let above = &self.rows[self.of_node[link.start].0..row];
                let ends = above.iter().flat_map(|row| &row.nodes);
                let right = ends
                    .map(|(node, at)| EDGE + at + self.half_width(*node) + 5.0)
                    .fold(start.x + self.trunk(link.start), f64::max);
                vec![
                    Point::new(start.x + self.plate(link.start), start.y),
                    Point::new(right, start.y),
                    Point::new(right, lane),
                    Point::new(level[0].x, lane),
                ]
            }
        };
        corners.extend(level);
        Run { edge: link.edge, start: link.start, corners }
    }
}
