//! The line as a network: groups joined by shafts, a spanning tree and what closes loops.
//!
//! The tree starts at ground where a shaft is held there, else at the first group. The
//! twists of its shafts are coordinates of the line; a shaft outside the tree closes a loop
//! and its twist follows from the others. Elastic meshes of gears are shafts here: they follow the
//! line's own, and the ratio of the gear divides the one at their input.

use super::Driveline;
use super::topology::Topology;
use crate::elements::Gear;

/// One end of a shaft: group and speed ratio of the node there; `None` is ground.
pub type End = Option<(usize, f64)>;

/// A shaft of the spanning tree, seen from the root.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TreeShaft {
    /// Index of the shaft, or past those of the mesh.
    pub shaft: usize,
    /// The end nearer to the root; `None` is ground.
    pub parent: End,
    /// The group at the far end and its ratio.
    pub child: (usize, f64),
    /// Whether the shaft's `from` end is the parent.
    pub from_parent: bool,
}

/// Groups and shafts as a graph.
#[derive(Clone, Debug, PartialEq)]
pub struct Network {
    /// `from` and `to` of every shaft, then input and output of every elastic mesh.
    pub ends: Vec<[End; 2]>,
    /// Whether a shaft is held at ground.
    pub grounded: bool,
    /// Shafts of the spanning tree, parents before children.
    pub tree: Vec<TreeShaft>,
    /// Indices of the shafts that close loops.
    pub loops: Vec<usize>,
    /// Groups that the tree does not reach.
    pub unreached: Vec<usize>,
}

impl Network {
    /// The network of a line with its groups.
    pub fn of(line: &Driveline, topology: &Topology) -> Self {
        let shafts = line
            .shafts
            .iter()
            .map(|shaft| [topology.place(&shaft.from), topology.place(&shaft.to)]);
        let ends: Vec<[End; 2]> =
            shafts.chain(line.meshes().map(|gear| mesh_ends(gear, topology))).collect();
        let grounded = ends.iter().flatten().any(Option::is_none);
        let count = topology.groups.len();
        let mut search = Search::new(&ends, count);
        search.spread(if grounded { count } else { 0 });
        let unreached = (0..count).filter(|group| !search.reached[*group]).collect();
        let loops = (0..ends.len()).filter(|shaft| !search.in_tree[*shaft]).collect();
        let tree = search.tree;
        Self { ends, grounded, tree, loops, unreached }
    }

    /// Speeds of the groups when the whole line turns without any twist in the tree, scaled
    /// to 1 at the first group; only meaningful for a line without ground.
    pub fn rigid_speeds(&self, groups: usize) -> Vec<f64> {
        let mut speeds = vec![1.0; groups];
        for edge in &self.tree {
            if let Some((parent, parent_ratio)) = edge.parent {
                let (child, child_ratio) = edge.child;
                speeds[child] = speeds[parent] * parent_ratio / child_ratio;
            }
        }
        speeds
    }

    /// The loops of shafts that keep a free line from turning without twisting any shaft; a line
    /// that is held at ground need not turn.
    pub(crate) fn locked_loops(&self, line: &Driveline, groups: usize) -> Vec<LockedLoop> {
        if self.grounded || self.loops.is_empty() {
            return Vec::new();
        }
        let speeds = self.rigid_speeds(groups);
        let locked = self.loops.iter().filter_map(|index| {
            let [Some((from, from_ratio)), Some((to, to_ratio))] = self.ends[*index] else {
                return None;
            };
            // Speeds are those of the tree, which does not reach what floats.
            if self.unreached.binary_search(&from).is_ok() {
                return None;
            }
            let (from_speed, to_speed) = (speeds[from] * from_ratio, speeds[to] * to_ratio);
            if (from_speed - to_speed).abs() <= SPEED_TOLERANCE * from_speed.abs() {
                return None;
            }
            let times = from_speed / to_speed;
            Some(match line.shafts.get(*index) {
                Some(shaft) => LockedLoop {
                    kind: "shaft",
                    shaft: shaft.name.clone(),
                    from: shaft.from.clone(),
                    to: shaft.to.clone(),
                    times,
                },
                None => {
                    let gear = line.meshes().nth(*index - line.shafts.len())?;
                    LockedLoop {
                        kind: "gear",
                        shaft: gear.name.clone(),
                        from: gear.input.clone(),
                        to: gear.output.clone(),
                        times: times * gear.ratio,
                    }
                }
            })
        });
        locked.collect()
    }
}

/// Ends of an elastic mesh: its twist is `angle(input) / ratio - angle(output)`.
fn mesh_ends(gear: &Gear, topology: &Topology) -> [End; 2] {
    let input = topology.place(&gear.input).map(|(group, ratio)| (group, ratio / gear.ratio));
    [input, topology.place(&gear.output)]
}

/// A loop of shafts between gears that only turns by winding up.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error(
    "the loop that {kind} \"{shaft}\" closes cannot turn: \"{from}\" would turn at {times:.6} times \
     the speed of \"{to}\""
)]
pub struct LockedLoop {
    /// "shaft" or "gear".
    pub kind: &'static str,
    /// The shaft, or gear with an elastic mesh, that closes the loop.
    pub shaft: String,
    /// Its `from` node, or input.
    pub from: String,
    /// Its `to` node, or output.
    pub to: String,
    /// Speed that the rest of the loop gives the `from` node over that of the `to` node.
    pub times: f64,
}

/// Two speeds around a loop of shafts agree when they differ by less than this part; tooth counts
/// rounded to ten digits still pass.
const SPEED_TOLERANCE: f64 = 1e-9;

/// Breadth-first search over groups; ground is the node after the last group.
struct Search<'e> {
    ends: &'e [[End; 2]],
    /// Shafts at each group and, last, at ground.
    shafts_at: Vec<Vec<usize>>,
    reached: Vec<bool>,
    in_tree: Vec<bool>,
    tree: Vec<TreeShaft>,
}

impl<'e> Search<'e> {
    fn new(ends: &'e [[End; 2]], groups: usize) -> Self {
        let mut shafts_at = vec![Vec::new(); groups + 1];
        for (shaft, pair) in ends.iter().enumerate() {
            for end in pair {
                shafts_at[end.map_or(groups, |(group, _)| group)].push(shaft);
            }
        }
        Self {
            ends,
            shafts_at,
            reached: vec![false; groups + 1],
            in_tree: vec![false; ends.len()],
            tree: Vec::new(),
        }
    }

    fn spread(&mut self, root: usize) {
        let ground = self.reached.len() - 1;
        let mut queue = std::collections::VecDeque::from([root]);
        self.reached[root] = true;
        while let Some(at) = queue.pop_front() {
            for shaft in std::mem::take(&mut self.shafts_at[at]) {
                let [from, to] = self.ends[shaft];
                let from_parent = from.map_or(ground, |(group, _)| group) == at;
                let (parent, child) = if from_parent { (from, to) } else { (to, from) };
                let Some(child) = child.filter(|(group, _)| !self.reached[*group]) else {
                    continue;
                };
                self.reached[child.0] = true;
                self.in_tree[shaft] = true;
                self.tree.push(TreeShaft { shaft, parent, child, from_parent });
                queue.push_back(child.0);
            }
        }
    }
}
