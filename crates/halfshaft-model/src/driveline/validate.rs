//! What the elements must satisfy together: names, ends, torques, and how they are connected.

use std::collections::HashMap;

use super::Driveline;
use super::connection::check_connection;
use super::places::Places;
use crate::diagnostic::{Diagnostic, Diagnostics, did_you_mean, with_article};
use crate::elements::{MeanTorque, TorqueTable};

/// Adds every finding about the line as a whole to `found`.
///
/// Where parts of the file are unsound the line holds stand-ins for them; what depends on those
/// is not judged.
pub(crate) fn validate(line: &Driveline, places: &Places<'_>, found: &mut Diagnostics) {
    check_names(line, places, found);
    check_ends(line, places, found);
    check_laws(line, places, found);
    check_torques(line, places, found);
    check_engines(line, places, found);
    let fits = pieces_fit(line, places, found);
    if dampers_sit(line, places, found) && fits {
        check_connection(&line.expanded(), places, found);
    }
}

/// Most pieces of all bars together.
const MOST_PIECES: usize = 100_000;

/// Whether the bars are cut into no more pieces than can be worked with; tells the one with most.
fn pieces_fit(line: &Driveline, places: &Places<'_>, found: &mut Diagnostics) -> bool {
    let bars = line.shafts.iter().enumerate();
    let pieces = bars.filter_map(|(at, shaft)| Some((at, shaft.dimensions.as_ref()?.pieces())));
    let (mut all, mut most) = (0, (0, 0));
    for (at, count) in pieces {
        all += count;
        most = if count > most.1 { (at, count) } else { most };
    }
    if all > MOST_PIECES {
        let message = format!("{all} pieces of bars are more than {MOST_PIECES}");
        let place = places.key("shaft", most.0, "elements");
        found.push(Diagnostic::error(place, message).hint("some dozens a bar are exact enough"));
    }
    all <= MOST_PIECES
}

/// Whether every damper sits on a node that something else brings; tells those that do not.
fn dampers_sit(line: &Driveline, places: &Places<'_>, found: &mut Diagnostics) -> bool {
    let inertias = line.inertias.iter().map(|e| e.name.as_str());
    let gears = line.gears.iter().flat_map(|gear| [gear.input.as_str(), gear.output.as_str()]);
    let shafts = line.shafts.iter().flat_map(|shaft| [shaft.from.as_str(), shaft.to.as_str()]);
    let known: Vec<&str> = inertias.chain(gears).chain(shafts).collect();
    let lost = |(index, damper): &(usize, &crate::elements::Damper)| {
        places.has("damper", *index, "on") && !known.contains(&damper.on.as_str())
    };
    let mut all = true;
    for (index, damper) in line.dampers.iter().enumerate().filter(lost) {
        all = false;
        let hint = did_you_mean(&damper.on, known.iter().copied());
        let message = format!("no node is named \"{}\"", damper.on);
        let place = places.key("damper", index, "on");
        found.push(Diagnostic::error(place, message).maybe_hint(hint));
    }
    all
}

/// Element names with the list and index that they come from.
fn named(line: &Driveline) -> Vec<(&'static str, usize, &str)> {
    let mut all = Vec::new();
    all.extend(line.inertias.iter().enumerate().map(|(i, e)| ("inertia", i, e.name.as_str())));
    all.extend(line.gears.iter().enumerate().map(|(i, e)| ("gear", i, e.name.as_str())));
    all.extend(line.shafts.iter().enumerate().map(|(i, e)| ("shaft", i, e.name.as_str())));
    all.extend(line.torques.iter().enumerate().map(|(i, e)| ("torque", i, e.name.as_str())));
    all.extend(line.dampers.iter().enumerate().map(|(i, e)| ("damper", i, e.name.as_str())));
    all.extend(line.engines.iter().enumerate().map(|(i, e)| ("engine", i, e.name.as_str())));
    all
}

/// Dampers that nothing holds, and tables that are no working cycle.
fn check_engines(line: &Driveline, places: &Places<'_>, found: &mut Diagnostics) {
    for (index, damper) in line.dampers.iter().enumerate() {
        if damper.is_silent() && places.is_sound("damper", index) {
            let message = format!("nothing holds the ring of damper \"{}\"", damper.name);
            found.push(
                Diagnostic::error(places.key("damper", index, "name"), message)
                    .hint("give it a damping, a stiffness or both"),
            );
        }
    }
    for (index, engine) in line.engines.iter().enumerate() {
        if let Some(Err((message, hint))) =
            engine.table().map(|table| table.cycle(engine.revolutions()))
            && places.is_sound("engine", index)
            && engine.strokes != 3
        {
            let key = if engine.torque.is_some() { "torque" } else { "pressure" };
            found.push(Diagnostic::error(places.key("engine", index, key), message).hint(hint));
        }
    }
}

fn check_names(line: &Driveline, places: &Places<'_>, found: &mut Diagnostics) {
    let mut first: HashMap<&str, (&'static str, usize)> = HashMap::new();
    let readable = named(line).into_iter().filter(|(list, at, _)| places.has(list, *at, "name"));
    for (list, index, name) in readable {
        let span = places.key(list, index, "name");
        if name.trim().is_empty() || name.chars().any(char::is_control) {
            found.push(Diagnostic::error(span, format!("this {list} needs a readable name")));
        } else if name == crate::GROUND {
            found.push(
                Diagnostic::error(
                    span,
                    format!("{} cannot be named \"ground\"", with_article(list)),
                )
                .hint("\"ground\" is the fixed node that shafts connect to"),
            );
        } else if let Some((other, at)) = first.get(name) {
            let (other_kind, kind) = (with_article(other), with_article(list));
            let message = format!("two elements are named \"{name}\": {other_kind} and {kind}");
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

fn check_ends(line: &Driveline, places: &Places<'_>, found: &mut Diagnostics) {
    for (index, gear) in line.gears.iter().enumerate() {
        if gear.input == gear.output && places.has("gear", index, "input") {
            let message = format!("gear \"{}\" has the same node at both ends", gear.name);
            found.push(Diagnostic::error(places.key("gear", index, "output"), message));
        }
    }
    for (index, shaft) in line.shafts.iter().enumerate() {
        if shaft.from == shaft.to && places.has("shaft", index, "from") {
            let message = format!("shaft \"{}\" has the same node at both ends", shaft.name);
            found.push(Diagnostic::error(places.key("shaft", index, "to"), message));
        }
        if shaft.is_silent() && places.is_sound("shaft", index) {
            let message = format!("shaft \"{}\" carries no torque at all", shaft.name);
            found.push(
                Diagnostic::error(places.key("shaft", index, "stiffness"), message)
                    .hint("give it a stiffness"),
            );
        }
    }
    let nothing = line.connection_names().next().is_none() && line.dampers.is_empty();
    if nothing && places.all_sound("shaft") && places.all_sound("gear") {
        let place = places.key("inertia", 0, "name");
        found.push(
            Diagnostic::error(place, "the line has no [[shaft]], so nothing can wind up")
                .hint("add a [[shaft]] with from, to and stiffness; \"ground\" is the fixed node"),
        );
    }
}

/// Stages and points that do not make a law.
fn check_laws(line: &Driveline, places: &Places<'_>, found: &mut Diagnostics) {
    let sound =
        line.shafts.iter().enumerate().filter(|(index, _)| places.is_sound("shaft", *index));
    for (index, shaft) in sound {
        for fault in shaft.law_faults() {
            let place = places.nested("shaft", index, fault.list, fault.entry);
            found.push(Diagnostic::error(place, fault.message).hint(fault.hint));
        }
    }
}

fn check_torques(line: &Driveline, places: &Places<'_>, found: &mut Diagnostics) {
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
        if let Some((message, hint)) = torque.table.as_ref().and_then(TorqueTable::fault)
            && places.is_sound("torque", index)
        {
            let place = places.key("torque", index, "table");
            found.push(Diagnostic::error(place, message).hint(hint));
        }
        let silent = torque.mean == MeanTorque::Value(0.0)
            && torque.harmonics.iter().all(|h| h.amplitude_nm == 0.0)
            && torque.pulse.is_none()
            && torque.table.is_none();
        if silent && places.is_sound("torque", index) {
            let message = format!("torque \"{}\" does nothing", torque.name);
            found.push(
                Diagnostic::warning(places.key("torque", index, "name"), message)
                    .hint("give it a mean, an amplitude, a pulse or a table"),
            );
        }
    }
}
