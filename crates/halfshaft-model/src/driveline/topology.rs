//! Which nodes turn rigidly together, and at which ratios.
//!
//! Rigid gears join nodes into groups with one degree of freedom each. A group is led by
//! its reference node; every node turns at a fixed multiple of the reference. The reference
//! is the node farthest down the line (an output that is no input), so that reduced
//! inertias are "at the wheel" as driveline engineers state them.

use super::Driveline;

/// A node: where elements meet.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// Its name.
    pub name: String,
    /// Index of the inertia on it, if any.
    pub inertia: Option<usize>,
    /// Index of its group.
    pub group: usize,
    /// Speed of this node over the speed of the group's reference node.
    pub ratio: f64,
}

/// Nodes that turn rigidly together.
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    /// Node indices in file order.
    pub nodes: Vec<usize>,
    /// Index of the node whose angle stands for the group.
    pub reference: usize,
}

/// Nodes and groups of a line.
#[derive(Clone, Debug, PartialEq)]
pub struct Topology {
    /// Nodes: those of inertias first, then those that only gears and shafts name.
    pub nodes: Vec<Node>,
    /// Groups in the order of their first node.
    pub groups: Vec<Group>,
    /// Node indices by name, for finding: models are built over and over along a sweep, and a
    /// sorted list is the cheapest index to make.
    by_name: Vec<usize>,
}

/// Gears that cannot turn.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TopologyError {
    /// A loop of gears asks two ratios of one pair of nodes.
    #[error(
        "gear \"{gear}\" contradicts the gears before it: it asks {asked} between \"{input}\" and \
         \"{output}\", they give {given}"
    )]
    GearLoop {
        /// The gear that closes the loop.
        gear: String,
        /// Its index.
        index: usize,
        /// Its input node.
        input: String,
        /// Its output node.
        output: String,
        /// Its ratio.
        asked: f64,
        /// The ratio that the other gears of the loop give.
        given: f64,
    },
}

/// Two ratios around a gear loop agree when they differ by less than this part; tooth counts
/// rounded to ten digits still pass.
const RATIO_TOLERANCE: f64 = 1e-9;

impl Topology {
    /// Nodes and groups of `line`.
    ///
    /// # Errors
    /// [`TopologyError`] where a loop of gears contradicts itself.
    pub fn of(line: &Driveline) -> Result<Self, TopologyError> {
        let (topology, mut contradictions) = Self::with_contradictions(line);
        if contradictions.is_empty() { Ok(topology) } else { Err(contradictions.swap_remove(0)) }
    }

    /// Nodes and groups of `line`, and every gear that contradicts those before it; such a gear
    /// joins its nodes all the same.
    pub(crate) fn with_contradictions(line: &Driveline) -> (Self, Vec<TopologyError>) {
        let nodes = first_mentions(line);
        let names: Vec<&str> = nodes.iter().map(|(_, name)| *name).collect();
        let by_name = sorted(&names);
        let find = |name: &str| position(&by_name, |node| names[node], name);
        let mut sets = RatioSets::new(names.len());
        let mut roles = vec![Role::default(); names.len()];
        let mut contradictions = Vec::new();
        let rigid = line.gears.iter().enumerate().filter(|(_, gear)| !gear.is_elastic());
        for (index, gear) in rigid {
            let (Some(input), Some(output)) = (find(&gear.input), find(&gear.output)) else {
                continue; // cannot be: the ends of gears are among the names
            };
            roles[input].is_input = true;
            roles[output].is_output = true;
            if let Err(given) = sets.join(input, output, gear.ratio) {
                contradictions.push(TopologyError::GearLoop {
                    gear: gear.name.clone(),
                    index,
                    input: gear.input.clone(),
                    output: gear.output.clone(),
                    asked: gear.ratio,
                    given,
                });
            }
        }
        let inertias = nodes.iter().map(|(position, _)| *position);
        let inertias = inertias.map(|p| Some(p).filter(|p| *p < line.inertias.len())).collect();
        (Self::assemble(&names, &roles, inertias, by_name, &mut sets), contradictions)
    }

    fn assemble(
        names: &[&str],
        roles: &[Role],
        inertias: Vec<Option<usize>>,
        by_name: Vec<usize>,
        sets: &mut RatioSets,
    ) -> Self {
        let roots: Vec<(usize, f64)> = (0..names.len()).map(|node| sets.root(node)).collect();
        let mut groups: Vec<Group> = Vec::new();
        let mut group_of_root = vec![usize::MAX; names.len()];
        for (node, (root, _)) in roots.iter().enumerate() {
            if group_of_root[*root] == usize::MAX {
                group_of_root[*root] = groups.len();
                groups.push(Group { nodes: Vec::new(), reference: node });
            }
            groups[group_of_root[*root]].nodes.push(node);
        }
        for group in &mut groups {
            group.reference = reference_of(roles, &group.nodes);
        }
        let nodes = names
            .iter()
            .zip(&roots)
            .zip(inertias)
            .map(|((name, (root, ratio)), inertia)| {
                let group = group_of_root[*root];
                let (_, reference_ratio) = roots[groups[group].reference];
                Node { name: (*name).to_owned(), inertia, group, ratio: ratio / reference_ratio }
            })
            .collect();
        Self { nodes, groups, by_name }
    }

    /// Index of the node of that name; `None` for ground and unknown names.
    pub fn node(&self, name: &str) -> Option<usize> {
        position(&self.by_name, |node| self.nodes[node].name.as_str(), name)
    }

    /// Group and ratio of the node of that name; `None` for ground and unknown names.
    pub fn place(&self, name: &str) -> Option<(usize, f64)> {
        let node = &self.nodes[self.node(name)?];
        Some((node.group, node.ratio))
    }
}

/// Names of inertias, then gear ends, then shaft ends, each where it stands first among them all,
/// without ground.
fn first_mentions(line: &Driveline) -> Vec<(usize, &str)> {
    let inertias = line.inertias.iter().map(|e| e.name.as_str());
    let gears = line.gears.iter().flat_map(|gear| [gear.input.as_str(), gear.output.as_str()]);
    let shafts = line.shafts.iter().flat_map(|shaft| [shaft.from.as_str(), shaft.to.as_str()]);
    let all: Vec<&str> = inertias.chain(gears).chain(shafts).collect();
    let mut first: Vec<usize> = sorted(&all);
    first.dedup_by_key(|position| all[*position]);
    first.retain(|position| all[*position] != crate::GROUND);
    first.sort_unstable();
    first.into_iter().map(|position| (position, all[position])).collect()
}

/// Positions of the names in the order of the names, equal ones in their own order.
fn sorted(names: &[&str]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..names.len()).collect();
    order.sort_by_key(|position| names[*position]);
    order
}

/// The entry of a sorted list of positions whose name is `name`.
fn position<'n>(
    by_name: &[usize],
    name_of: impl Fn(usize) -> &'n str,
    name: &str,
) -> Option<usize> {
    by_name.binary_search_by(|entry| name_of(*entry).cmp(name)).ok().map(|at| by_name[at])
}

/// What gears make of a node.
#[derive(Clone, Copy, Debug, Default)]
struct Role {
    is_input: bool,
    is_output: bool,
}

/// The node that stands for its group: an output that is no input, else the first.
fn reference_of(roles: &[Role], nodes: &[usize]) -> usize {
    let last = nodes.iter().rev().find(|node| roles[**node].is_output && !roles[**node].is_input);
    last.or(nodes.first()).copied().unwrap_or(0)
}

/// Disjoint sets of nodes with the speed ratio of each node to its set's root.
struct RatioSets {
    parent: Vec<usize>,
    /// Speed of the node over the speed of its parent.
    ratio: Vec<f64>,
}

impl RatioSets {
    fn new(count: usize) -> Self {
        Self { parent: (0..count).collect(), ratio: vec![1.0; count] }
    }

    /// Root of a node and the node's speed over the root's.
    fn root(&mut self, node: usize) -> (usize, f64) {
        let mut path = Vec::new();
        let mut at = node;
        while self.parent[at] != at {
            path.push(at);
            at = self.parent[at];
        }
        let root = at;
        // Flatten the path from the root outwards so that each ratio becomes direct.
        for step in path.into_iter().rev() {
            self.ratio[step] *= self.ratio[self.parent[step]];
            self.parent[step] = root;
        }
        (root, if node == root { 1.0 } else { self.ratio[node] })
    }

    /// Makes `input` turn at `ratio` times `output`; in a loop that gives another ratio,
    /// that ratio is the error.
    fn join(&mut self, input: usize, output: usize, ratio: f64) -> Result<(), f64> {
        let (input_root, input_ratio) = self.root(input);
        let (output_root, output_ratio) = self.root(output);
        if input_root == output_root {
            let given = input_ratio / output_ratio;
            let agrees = (given - ratio).abs() <= RATIO_TOLERANCE * ratio.abs();
            return if agrees { Ok(()) } else { Err(given) };
        }
        self.parent[input_root] = output_root;
        self.ratio[input_root] = ratio * output_ratio / input_ratio;
        Ok(())
    }
}
