//! Which keys of an engine go together.

use super::engine::{MOST_HIGHEST_ORDER, firing_order};
use crate::diagnostic::{Diagnostic, Diagnostics};
use crate::format::CheckedTable;

/// Adds what does not go together in an engine.
pub(crate) fn check_engine(engine: &CheckedTable, found: &mut Diagnostics) {
    check_sources(engine, found);
    check_crank(engine, found);
    check_cylinders(engine, found);
    if engine.number("highest_order").is_some_and(|order| order > MOST_HIGHEST_ORDER) {
        let message = format!("orders are taken up to {MOST_HIGHEST_ORDER}");
        found.push(Diagnostic::error(engine.span_of("highest_order"), message));
    }
    if engine.number("strokes").is_some_and(|strokes| strokes == 3.0) {
        let message = "a working cycle has 2 or 4 strokes, not 3";
        found.push(Diagnostic::error(engine.span_of("strokes"), message));
    }
}

/// An engine takes its torque from pressure, from torques, or from its masses alone.
fn check_sources(engine: &CheckedTable, found: &mut Diagnostics) {
    if engine.mentions("pressure") && engine.mentions("torque") {
        let message = "an engine has a pressure or a torque, not both";
        found.push(
            Diagnostic::error(engine.span_of("torque"), message)
                .related(engine.span_of("pressure"), "the pressure")
                .hint("leave out one of them"),
        );
    }
    let sources = ["pressure", "torque", "oscillating_mass"];
    if !sources.iter().any(|key| engine.mentions(key)) {
        found.push(Diagnostic::error(engine.span.clone(), "this engine has no torque").hint(
            "give a pressure (with bore, stroke and rod_length), a torque or an oscillating_mass",
        ));
    }
    if engine.mentions("crankcase_pressure") && !engine.mentions("pressure") {
        let message = "crankcase_pressure does nothing without a pressure";
        let place = engine.span_of("crankcase_pressure");
        found.push(Diagnostic::warning(place, message).hint("leave it out"));
    }
}

/// The crank gear has all its measures or none.
fn check_crank(engine: &CheckedTable, found: &mut Diagnostics) {
    let measures = ["bore", "stroke", "rod_length"];
    let asking = ["pressure", "oscillating_mass", "bore", "stroke", "rod_length"]
        .into_iter()
        .find(|key| engine.mentions(key));
    let Some(asking) = asking else { return };
    for missing in measures.into_iter().filter(|key| !engine.mentions(key)) {
        found.push(
            Diagnostic::error(
                engine.span_of(asking),
                format!("an engine with \"{asking}\" needs \"{missing}\""),
            )
            .hint(format!("add {missing} = \"... mm\"")),
        );
    }
    if let (Some(stroke), Some(rod)) = (engine.number("stroke"), engine.number("rod_length"))
        && rod <= stroke / 2.0
    {
        let message = "the rod is not longer than the crank radius, half of the stroke";
        found.push(Diagnostic::error(engine.span_of("rod_length"), message));
    }
}

/// Cylinders, cranks and firing angles must be as many.
fn check_cylinders(engine: &CheckedTable, found: &mut Diagnostics) {
    if engine.mentions("firing_order") && engine.mentions("firing_angles") {
        found.push(
            Diagnostic::error(
                engine.span_of("firing_angles"),
                "an engine has a firing_order or firing_angles, not both",
            )
            .related(engine.span_of("firing_order"), "the order"),
        );
        return;
    }
    let fires = ["firing_order", "firing_angles"].into_iter().find(|key| engine.mentions(key));
    let fired = fires.map(|key| engine.numbers(key).len());
    let told = engine.number("cylinders").map(|number| number.to_string());
    let nodes = engine.texts("on").len();
    let order = firing_order(engine);
    let cylinders = fired.unwrap_or(order.len());
    if cylinders == 0 {
        return;
    }
    if let Some(told) = told.filter(|told| *told != cylinders.to_string()) {
        let place = engine.span_of(fires.unwrap_or("cylinders"));
        let message = format!("{cylinders} cylinders fire, and there are {told}");
        found.push(Diagnostic::error(place, message).related(engine.span_of("cylinders"), "here"));
    }
    if nodes > 1 && nodes != cylinders {
        let message = format!("{nodes} cranks for {cylinders} cylinders");
        found.push(
            Diagnostic::error(engine.span_of("on"), message)
                .hint("name the node of each cylinder's crank, or one node for all"),
        );
    }
    let mut sorted = order.clone();
    sorted.sort_unstable();
    let whole = engine.numbers("firing_order").iter().all(|number| number.fract() == 0.0);
    if fires == Some("firing_order") && (!whole || !sorted.iter().copied().eq(1..=order.len())) {
        let message =
            format!("the firing order must name each cylinder from 1 to {} once", order.len());
        found.push(
            Diagnostic::error(engine.span_of("firing_order"), message).hint("e.g. [1, 3, 4, 2]"),
        );
    }
}
