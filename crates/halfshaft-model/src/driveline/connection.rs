//! Whether gears and shafts join the nodes to one line that can turn.

use std::collections::HashMap;
use std::ops::Range;

use super::Driveline;
use super::network::Network;
use super::places::Places;
use super::topology::{Topology, TopologyError};
use crate::diagnostic::{Diagnostic, Diagnostics, did_you_mean, nearest};
use crate::elements::Gear;

/// For how many findings is looked for what was meant: each look goes through all names, and who
/// has more mistakes of that kind has understood by then.
const MOST_LOOKS: usize = 20;

/// Adds what is wrong with nodes, gear loops and connections to `found`.
pub(super) fn check_connection(line: &Driveline, places: &Places<'_>, found: &mut Diagnostics) {
    if !places.nodes_known() {
        return;
    }
    let (topology, mut contradictions) = Topology::with_contradictions(line);
    // Ratios of which some are unsound contradict each other without meaning anything.
    let ratios_known = places.all_sound("gear");
    // A gear from a node to itself has been told as that.
    contradictions.retain(|TopologyError::GearLoop { input, output, .. }| input != output);
    if ratios_known {
        let loops = contradictions.iter().enumerate();
        found.items.extend(loops.map(|(number, error)| {
            let related = if number < MOST_LOOKS { line.gears.as_slice() } else { &[] };
            gear_loop(error, related, places)
        }));
        check_shafts_turn(line, &topology, places, found);
    }
    check_driven_nodes(line, &topology, places, found);
    let massless = check_masses(line, &topology, places, found);
    // What hangs on a node that nobody knows cannot be judged.
    let Some(meant) = as_meant(line, &massless).filter(has_connection) else {
        return;
    };
    let (topology, _) = Topology::with_contradictions(&meant);
    let network = Network::of(&meant, &topology);
    check_connected(&meant, &topology, &network, places, found);
    if ratios_known && contradictions.is_empty() && massless.is_empty() {
        check_can_turn(line, &topology, &network, places, found);
    }
}

/// A gear that contradicts those before it, with the places of those before it among `gears`.
fn gear_loop(error: &TopologyError, gears: &[Gear], places: &Places<'_>) -> Diagnostic {
    let TopologyError::GearLoop { index, asked, given, .. } = error;
    let diagnostic = Diagnostic::error(places.key("gear", *index, "ratio"), error.to_string())
        .hint(format!("the loop turns with ratio = {given}; {asked} would lock it"));
    let before = gears.iter().enumerate().take(*index);
    before.fold(diagnostic, |diagnostic, (other, gear)| {
        let label = format!("ratio of \"{}\"", gear.name);
        diagnostic.related(places.key("gear", other, "ratio"), label)
    })
}

/// Names of nodes that elements bring by themselves, not just by a shaft that ends there.
fn anchored(line: &Driveline) -> impl Iterator<Item = &str> {
    let inertias = line.inertias.iter().map(|e| e.name.as_str());
    let gears = line.gears.iter().flat_map(|gear| [gear.input.as_str(), gear.output.as_str()]);
    inertias.chain(gears)
}

/// Most nodes that a hint lists.
const MOST_LISTED: usize = 8;

/// The first nodes as a list, for who has misspelt one beyond recognition.
fn listed<'l>(nodes: impl Iterator<Item = &'l str>) -> String {
    let mut names: Vec<&str> = Vec::new();
    for node in nodes.filter(|node| !node.is_empty()) {
        if names.contains(&node) {
            continue;
        }
        if names.len() == MOST_LISTED {
            names.push("...");
            break;
        }
        names.push(node);
    }
    names.join(", ")
}

/// Every torque and every cylinder of an engine needs an existing node.
fn check_driven_nodes(
    line: &Driveline,
    topology: &Topology,
    places: &Places<'_>,
    found: &mut Diagnostics,
) {
    let torques = line.torques.iter().enumerate().map(|(at, torque)| ("torque", at, &torque.on));
    let cranks = line.engines.iter().enumerate();
    let cranks = cranks.flat_map(|(at, engine)| engine.on.iter().map(move |on| ("engine", at, on)));
    let mut looks = 0..MOST_LOOKS;
    for (list, index, on) in torques.chain(cranks) {
        if topology.node(on).is_none() && places.has(list, index, "on") {
            let hint = looks.next().map(|_| {
                did_you_mean(on, anchored(line)).unwrap_or_else(|| {
                    format!("the nodes of this line are {}", listed(anchored(line)))
                })
            });
            let message = format!("no node is named \"{on}\"");
            let span = places.key(list, index, "on");
            found.push(Diagnostic::error(span, message).maybe_hint(hint));
        }
    }
}

/// A node that turns without any inertia, and the node that was probably meant.
struct Massless<'l> {
    name: &'l str,
    meant: Option<&'l str>,
}

const ADD_INERTIA: &str = "add an [[inertia]] of that name, or connect the node by a [[gear]]";

/// How many connections end at each group.
fn ends_at(line: &Driveline, topology: &Topology) -> Vec<usize> {
    let mut ends = vec![0; topology.groups.len()];
    for (group, _) in Network::of(line, topology).ends.into_iter().flatten().flatten() {
        ends[group] += 1;
    }
    ends
}

/// Every group of nodes needs an inertia, unless it only joins connections; returns those without.
fn check_masses<'l>(
    line: &'l Driveline,
    topology: &'l Topology,
    places: &Places<'_>,
    found: &mut Diagnostics,
) -> Vec<Massless<'l>> {
    let mut massless = Vec::new();
    let mut looks = 0..MOST_LOOKS;
    let mentions = first_mentions(line, places);
    let ends = ends_at(line, topology);
    for (number, group) in topology.groups.iter().enumerate() {
        let heavy = group.nodes.iter().any(|node| topology.nodes[*node].inertia.is_some());
        if heavy || ends[number] > 1 {
            continue;
        }
        let names: Vec<&str> =
            group.nodes.iter().map(|node| topology.nodes[*node].name.as_str()).collect();
        // Any node of the group may be the misspelt one that should have brought an inertia.
        let misspelt = names.iter().find_map(|name| {
            looks.next()?;
            let elsewhere = |other: &&str| topology.place(other).is_some_and(|(g, _)| g != number);
            Some((*name, nearest(name, anchored(line).filter(elsewhere))?))
        });
        let name = misspelt.map_or(topology.nodes[group.reference].name.as_str(), |(n, _)| n);
        let meant = misspelt.map(|(_, meant)| meant);
        let elsewhere = |other: &&str| topology.place(other).is_some_and(|(g, _)| g != number);
        let hint = match meant {
            Some(meant) => format!("did you mean \"{meant}\"?"),
            None if looks.is_empty() => ADD_INERTIA.to_owned(),
            None => match listed(anchored(line).filter(elsewhere)) {
                others if others.is_empty() => ADD_INERTIA.to_owned(),
                others => format!("{ADD_INERTIA}; the other nodes are {others}"),
            },
        };
        let message = format!("the node \"{name}\" has no inertia");
        found.push(Diagnostic::error(mention(&mentions, places, name), message).hint(hint));
        massless.push(Massless { name, meant });
    }
    massless
}

/// The line with misspelt nodes put right, so that what they leave hanging is not told as a
/// mistake of its own; `None` where what was meant is not known.
fn as_meant(line: &Driveline, massless: &[Massless<'_>]) -> Option<Driveline> {
    let others = massless.iter().map(|massless| Some((massless.name, massless.meant?)));
    let others: HashMap<&str, &str> = others.collect::<Option<_>>()?;
    let mut meant = line.clone();
    let gears = meant.gears.iter_mut().flat_map(|gear| [&mut gear.input, &mut gear.output]);
    let shafts = meant.shafts.iter_mut().flat_map(|shaft| [&mut shaft.from, &mut shaft.to]);
    for node in gears.chain(shafts) {
        if let Some(other) = others.get(node.as_str()) {
            (*other).clone_into(node);
        }
    }
    Some(meant)
}

/// Where gears and shafts first name each node; a shaft's word is the place to mend, where there is
/// one.
fn first_mentions<'l>(line: &'l Driveline, places: &Places<'_>) -> HashMap<&'l str, Range<usize>> {
    let mut mentions = HashMap::new();
    let mut mention = |name: &'l str, list: &str, index: usize, key: &str| {
        mentions.entry(name).or_insert_with(|| places.key(list, index, key));
    };
    for (index, shaft) in line.shafts.iter().enumerate() {
        mention(&shaft.from, "shaft", index, "from");
        mention(&shaft.to, "shaft", index, "to");
    }
    for (index, gear) in line.gears.iter().enumerate() {
        mention(&gear.input, "gear", index, "input");
        mention(&gear.output, "gear", index, "output");
    }
    mentions
}

/// Where a node that is no inertia is first named.
fn mention(
    mentions: &HashMap<&str, Range<usize>>,
    places: &Places<'_>,
    node: &str,
) -> Range<usize> {
    mentions.get(node).cloned().unwrap_or_else(|| places.key("inertia", 0, "name"))
}

/// Whether anything can wind up.
fn has_connection(line: &Driveline) -> bool {
    line.connection_names().next().is_some()
}

/// A shaft between nodes that turn rigidly together either does nothing or locks the line.
fn check_shafts_turn(
    line: &Driveline,
    topology: &Topology,
    places: &Places<'_>,
    found: &mut Diagnostics,
) {
    for (index, shaft) in line.shafts.iter().enumerate() {
        let (Some((from, from_ratio)), Some((to, to_ratio))) =
            (topology.place(&shaft.from), topology.place(&shaft.to))
        else {
            continue;
        };
        if from == to && shaft.from != shaft.to {
            let effect = if from_ratio == to_ratio { "never twists" } else { "locks the gears" };
            let message = format!(
                "shaft \"{}\" joins \"{}\" and \"{}\", which gears hold together: it {effect}",
                shaft.name, shaft.from, shaft.to
            );
            found.push(Diagnostic::error(places.key("shaft", index, "to"), message));
        }
    }
    for (index, gear) in line.gears.iter().enumerate().filter(|(_, gear)| gear.is_elastic()) {
        let group = |node: &str| topology.place(node).map(|(group, _)| group);
        if group(&gear.input) == group(&gear.output) && gear.input != gear.output {
            let message = format!(
                "the elastic mesh of gear \"{}\" joins \"{}\" and \"{}\", which rigid gears hold \
                 together",
                gear.name, gear.input, gear.output
            );
            found.push(
                Diagnostic::error(places.key("gear", index, "stiffness"), message)
                    .hint("leave its stiffness out, or make the gears beside it elastic too"),
            );
        }
    }
}

fn check_connected(
    line: &Driveline,
    topology: &Topology,
    network: &Network,
    places: &Places<'_>,
    found: &mut Diagnostics,
) {
    let Some(first) = network.unreached.first() else { return };
    let nodes = network.unreached.iter().flat_map(|group| &topology.groups[*group].nodes);
    let names: Vec<_> = nodes.map(|node| format!("\"{}\"", topology.nodes[*node].name)).collect();
    let message = if names.len() == 1 {
        format!("{} floats: no shaft or gear joins it to the rest", names[0])
    } else {
        format!("{} float: no shaft or gear joins them to the rest", names.join(", "))
    };
    let inertia = topology.groups[*first].nodes.iter().find_map(|n| topology.nodes[*n].inertia);
    let span = inertia.map_or_else(
        || {
            let node = &topology.nodes[topology.groups[*first].reference];
            mention(&first_mentions(line, places), places, &node.name)
        },
        |inertia| places.key("inertia", inertia, "name"),
    );
    found.push(
        Diagnostic::error(span, message)
            .hint("connect it by a [[shaft]] or [[gear]], or give it a file of its own"),
    );
}

/// A free line must be able to turn without twisting any shaft.
fn check_can_turn(
    line: &Driveline,
    topology: &Topology,
    network: &Network,
    places: &Places<'_>,
    found: &mut Diagnostics,
) {
    for locked in network.locked_loops(line, topology.groups.len()) {
        let index = match locked.kind {
            "gear" => line.gears.iter().position(|gear| gear.name == locked.shaft),
            _ => line.shafts.iter().position(|shaft| shaft.name == locked.shaft),
        };
        let place = places.key(locked.kind, index.unwrap_or(0), "name");
        found.push(
            Diagnostic::error(place, locked.to_string())
                .hint("make the gear ratios on both paths of the loop agree"),
        );
    }
}
