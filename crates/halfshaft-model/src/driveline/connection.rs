//! Whether gears and shafts join the nodes to one line that can turn.

use super::Driveline;
use super::network::Network;
use super::places::Places;
use super::topology::{Topology, TopologyError};
use crate::diagnostic::{Diagnostic, Diagnostics, did_you_mean, nearest};

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
        found.items.extend(contradictions.iter().map(|error| gear_loop(error, line, places)));
        check_shafts_turn(line, &topology, places, found);
    }
    check_torque_nodes(line, &topology, places, found);
    let massless = check_masses(line, &topology, places, found);
    // What hangs on a node that nobody knows cannot be judged.
    let Some(meant) = as_meant(line, &massless).filter(|line| !line.shafts.is_empty()) else {
        return;
    };
    let (topology, _) = Topology::with_contradictions(&meant);
    let network = Network::of(&meant, &topology);
    check_connected(&meant, &topology, &network, places, found);
    if ratios_known && contradictions.is_empty() && massless.is_empty() {
        check_can_turn(line, &topology, &network, places, found);
    }
}

fn gear_loop(error: &TopologyError, line: &Driveline, places: &Places<'_>) -> Diagnostic {
    let TopologyError::GearLoop { index, asked, given, .. } = error;
    let diagnostic = Diagnostic::error(places.key("gear", *index, "ratio"), error.to_string())
        .hint(format!("the loop turns with ratio = {given}; {asked} would lock it"));
    let before = line.gears.iter().enumerate().take(*index);
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

/// Every torque needs an existing node.
fn check_torque_nodes(
    line: &Driveline,
    topology: &Topology,
    places: &Places<'_>,
    found: &mut Diagnostics,
) {
    for (index, torque) in line.torques.iter().enumerate() {
        if topology.node(&torque.on).is_none() && places.has("torque", index, "on") {
            let message = format!("no node is named \"{}\"", torque.on);
            let hint = did_you_mean(&torque.on, anchored(line));
            let span = places.key("torque", index, "on");
            found.push(Diagnostic::error(span, message).maybe_hint(hint));
        }
    }
}

/// A node that turns without any inertia, and the node that was probably meant.
struct Massless<'l> {
    name: &'l str,
    meant: Option<&'l str>,
}

/// Every group of nodes needs an inertia; returns those without.
fn check_masses<'l>(
    line: &'l Driveline,
    topology: &'l Topology,
    places: &Places<'_>,
    found: &mut Diagnostics,
) -> Vec<Massless<'l>> {
    let mut massless = Vec::new();
    for group in &topology.groups {
        if group.nodes.iter().any(|node| topology.nodes[*node].inertia.is_some()) {
            continue;
        }
        let names: Vec<&str> =
            group.nodes.iter().map(|node| topology.nodes[*node].name.as_str()).collect();
        // Any node of the group may be the misspelt one that should have brought an inertia.
        let misspelt = names.iter().find_map(|name| {
            let others = anchored(line).filter(|other| !names.contains(other));
            Some((*name, nearest(name, others)?))
        });
        let name = misspelt.map_or(topology.nodes[group.reference].name.as_str(), |(n, _)| n);
        let meant = misspelt.map(|(_, meant)| meant);
        let hint = meant.map_or_else(
            || "add an [[inertia]] of that name, or connect the node by a [[gear]]".to_owned(),
            |meant| format!("did you mean \"{meant}\"?"),
        );
        let message = format!("the node \"{name}\" has no inertia");
        found.push(Diagnostic::error(first_mention(line, places, name), message).hint(hint));
        massless.push(Massless { name, meant });
    }
    massless
}

/// The line with misspelt nodes put right, so that what they leave hanging is not told as a
/// mistake of its own; `None` where what was meant is not known.
fn as_meant(line: &Driveline, massless: &[Massless<'_>]) -> Option<Driveline> {
    let mut meant = line.clone();
    for Massless { name, meant: other } in massless {
        let other = (*other)?;
        let gears = meant.gears.iter_mut().flat_map(|gear| [&mut gear.input, &mut gear.output]);
        let shafts = meant.shafts.iter_mut().flat_map(|shaft| [&mut shaft.from, &mut shaft.to]);
        for node in gears.chain(shafts).filter(|node| node.as_str() == *name) {
            other.clone_into(node);
        }
    }
    Some(meant)
}

/// Where a node that is no inertia is first named.
fn first_mention(line: &Driveline, places: &Places<'_>, node: &str) -> std::ops::Range<usize> {
    for (index, shaft) in line.shafts.iter().enumerate() {
        for (key, name) in [("from", &shaft.from), ("to", &shaft.to)] {
            if name == node {
                return places.key("shaft", index, key);
            }
        }
    }
    for (index, gear) in line.gears.iter().enumerate() {
        for (key, name) in [("input", &gear.input), ("output", &gear.output)] {
            if name == node {
                return places.key("gear", index, key);
            }
        }
    }
    places.key("inertia", 0, "name")
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
        || first_mention(line, places, &topology.nodes[topology.groups[*first].reference].name),
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
    if network.grounded {
        return;
    }
    let speeds = network.rigid_speeds(topology.groups.len());
    for index in &network.loops {
        let [Some((from, from_ratio)), Some((to, to_ratio))] = network.ends[*index] else {
            continue;
        };
        let (from_speed, to_speed) = (speeds[from] * from_ratio, speeds[to] * to_ratio);
        if (from_speed - to_speed).abs() <= 1e-9 * from_speed.abs() {
            continue;
        }
        let shaft = &line.shafts[*index];
        let message = format!(
            "the loop that shaft \"{}\" closes cannot turn: \"{}\" would turn at {:.6} times the \
             speed of \"{}\"",
            shaft.name,
            shaft.from,
            from_speed / to_speed,
            shaft.to
        );
        found.push(
            Diagnostic::error(places.key("shaft", *index, "name"), message)
                .hint("make the gear ratios on both paths of the loop agree"),
        );
    }
}
