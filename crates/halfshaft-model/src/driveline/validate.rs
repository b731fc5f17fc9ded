//! What the elements must satisfy together: names, nodes, gear loops, one connected line.

use std::collections::HashMap;

use super::Driveline;
use super::network::Network;
use super::places::Places;
use super::topology::{Topology, TopologyError};
use crate::diagnostic::{Diagnostic, Diagnostics, did_you_mean};
use crate::elements::MeanTorque;

/// Adds every finding about the line as a whole to `found`.
pub(crate) fn validate(line: &Driveline, places: &Places, found: &mut Diagnostics) {
    check_names(line, places, found);
    check_ends(line, places, found);
    check_torques(line, places, found);
    let topology = match Topology::of(line) {
        Ok(topology) => topology,
        Err(error) => {
            found.push(gear_loop(&error, line, places));
            return;
        }
    };
    let massless = check_masses(line, &topology, places, found);
    check_shafts_turn(line, &topology, places, found);
    // A misspelt node makes a part of its own; one message about it is enough.
    if !massless && !line.shafts.is_empty() {
        let network = Network::of(line, &topology);
        check_connected(line, &topology, &network, places, found);
        check_can_turn(line, &topology, &network, places, found);
    }
}

/// Element names with the list and index that they come from.
fn named(line: &Driveline) -> Vec<(&'static str, usize, &str)> {
    let mut all = Vec::new();
    all.extend(line.inertias.iter().enumerate().map(|(i, e)| ("inertia", i, e.name.as_str())));
    all.extend(line.gears.iter().enumerate().map(|(i, e)| ("gear", i, e.name.as_str())));
    all.extend(line.shafts.iter().enumerate().map(|(i, e)| ("shaft", i, e.name.as_str())));
    all.extend(line.torques.iter().enumerate().map(|(i, e)| ("torque", i, e.name.as_str())));
    all
}

fn check_names(line: &Driveline, places: &Places, found: &mut Diagnostics) {
    let mut first: HashMap<&str, (&'static str, usize)> = HashMap::new();
    for (list, index, name) in named(line) {
        let span = places.key(list, index, "name");
        if name.trim().is_empty() || name.chars().any(char::is_control) {
            found.push(Diagnostic::error(span, format!("this {list} needs a readable name")));
        } else if name == crate::GROUND {
            found.push(
                Diagnostic::error(span, format!("a {list} cannot be named \"ground\""))
                    .hint("\"ground\" is the fixed node that shafts connect to"),
            );
        } else if let Some((other, at)) = first.get(name) {
            let message = format!("two elements are named \"{name}\": a {other} and a {list}");
            found.push(
                Diagnostic::error(span, message)
                    .related(places.key(other, *at, "name"), "first named here")
                    .hint("names are addresses (\"<name>.<key>\"), so each must be unique"),
            );
        } else {
            first.insert(name, (list, index));
        }
    }
}

fn check_ends(line: &Driveline, places: &Places, found: &mut Diagnostics) {
    for (index, gear) in line.gears.iter().enumerate() {
        if gear.input == gear.output {
            let message = format!("gear \"{}\" has the same node at both ends", gear.name);
            found.push(Diagnostic::error(places.key("gear", index, "output"), message));
        }
    }
    for (index, shaft) in line.shafts.iter().enumerate() {
        if shaft.from == shaft.to {
            let message = format!("shaft \"{}\" has the same node at both ends", shaft.name);
            found.push(Diagnostic::error(places.key("shaft", index, "to"), message));
        }
        if shaft.polynomial().iter().all(|k| *k == 0.0) && shaft.damping_nm_s_per_rad == 0.0 {
            let message = format!("shaft \"{}\" carries no torque at all", shaft.name);
            found.push(
                Diagnostic::error(places.key("shaft", index, "stiffness"), message)
                    .hint("give it a stiffness"),
            );
        }
    }
    if line.shafts.is_empty() {
        let place = places.key("inertia", 0, "name");
        found.push(
            Diagnostic::error(place, "the line has no [[shaft]], so nothing can wind up")
                .hint("add a [[shaft]] with from, to and stiffness; \"ground\" is the fixed node"),
        );
    }
}

fn check_torques(line: &Driveline, places: &Places, found: &mut Diagnostics) {
    let mut balancing: Option<usize> = None;
    let grounded = line.shafts.iter().any(|s| s.from == crate::GROUND || s.to == crate::GROUND);
    for (index, torque) in line.torques.iter().enumerate() {
        if torque.mean == MeanTorque::Balance {
            let span = places.key("torque", index, "mean");
            if grounded {
                let message = "the line is held by a shaft to ground, so nothing needs balancing";
                found.push(Diagnostic::error(span, message).hint("give the torque as a number"));
            } else if let Some(first) = balancing {
                found.push(
                    Diagnostic::error(span, "only one torque can balance the others")
                        .related(places.key("torque", first, "mean"), "this one does already"),
                );
            } else {
                balancing = Some(index);
            }
        }
        let silent = torque.mean == MeanTorque::Value(0.0)
            && torque.harmonics.iter().all(|h| h.amplitude_nm == 0.0)
            && torque.pulse.is_none();
        if silent {
            let message = format!("torque \"{}\" does nothing", torque.name);
            found.push(
                Diagnostic::warning(places.key("torque", index, "name"), message)
                    .hint("give it a mean, an amplitude or a pulse"),
            );
        }
    }
}

fn gear_loop(error: &TopologyError, line: &Driveline, places: &Places) -> Diagnostic {
    let TopologyError::GearLoop { index, asked, given, .. } = error;
    let diagnostic = Diagnostic::error(places.key("gear", *index, "ratio"), error.to_string())
        .hint(format!("the loop turns with ratio = {given}; {asked} would lock it"));
    let before = line.gears.iter().enumerate().take(*index);
    before.fold(diagnostic, |diagnostic, (other, gear)| {
        let label = format!("ratio of \"{}\"", gear.name);
        diagnostic.related(places.key("gear", other, "ratio"), label)
    })
}

/// Every group needs an inertia, every torque an existing node. Says whether any node is
/// massless.
fn check_masses(
    line: &Driveline,
    topology: &Topology,
    places: &Places,
    found: &mut Diagnostics,
) -> bool {
    let anchored: Vec<&str> = line
        .inertias
        .iter()
        .map(|e| e.name.as_str())
        .chain(line.gears.iter().flat_map(|gear| [gear.input.as_str(), gear.output.as_str()]))
        .collect();
    for (index, torque) in line.torques.iter().enumerate() {
        if topology.node(&torque.on).is_none() {
            let message = format!("no node is named \"{}\"", torque.on);
            let hint = did_you_mean(&torque.on, anchored.iter().copied());
            let span = places.key("torque", index, "on");
            found.push(Diagnostic::error(span, message).maybe_hint(hint));
        }
    }
    let mut massless = false;
    for group in &topology.groups {
        if group.nodes.iter().any(|node| topology.nodes[*node].inertia.is_some()) {
            continue;
        }
        massless = true;
        let name = topology.nodes[group.reference].name.as_str();
        let others = anchored.iter().copied().filter(|other| *other != name);
        let hint = did_you_mean(name, others).unwrap_or_else(|| {
            "add an [[inertia]] of that name, or connect the node by a [[gear]]".to_owned()
        });
        let span = first_mention(line, places, name);
        let message = format!("the node \"{name}\" has no inertia");
        found.push(Diagnostic::error(span, message).hint(hint));
    }
    massless
}

/// Where a node that is no inertia is first named.
fn first_mention(line: &Driveline, places: &Places, node: &str) -> std::ops::Range<usize> {
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
    places: &Places,
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
    places: &Places,
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
    places: &Places,
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
