//! Which keys of a shaft, a gear or a torque go together, which the list of keys cannot say.

use super::dimensions::NEEDED;
use crate::diagnostic::{Diagnostic, Diagnostics, with_article};
use crate::format::CheckedTable;

/// Keys whose sum is one law.
const POLYNOMIAL: [&str; 7] =
    ["stiffness", "quadratic", "cubic", "quintic", "septic", "clearance", "contact"];
/// Keys that each give the whole torque.
const WHOLE: [&str; 3] = ["stages", "coast_stages", "table"];

/// Keys of a bar.
const BAR: [&str; 6] =
    ["length", "outer_diameter", "inner_diameter", "shear_modulus", "density", "elements"];
/// What a bar does not have: its pieces would each slip by themselves.
const NOT_OF_A_BAR: [&str; 3] = ["friction", "friction_speed", "engagement"];

/// Adds what does not go together in a shaft.
pub(crate) fn check_shaft(shaft: &CheckedTable, found: &mut Diagnostics) {
    let mentions = |key: &&str| shaft.mentions(key);
    if let Some(bar) = BAR.iter().copied().find(|key| mentions(key)) {
        check_bar(shaft, bar, found);
        return;
    }
    let whole = WHOLE.iter().copied().find(|key| mentions(key));
    match whole {
        Some("table") => no_others(shaft, "table", &[&POLYNOMIAL], found),
        Some(stages) => no_others(shaft, stages, &[&POLYNOMIAL, &["table"]], found),
        None => check_polynomial(shaft, found),
    }
    if shaft.mentions("coast_stages") && !shaft.mentions("stages") {
        found.push(
            Diagnostic::error(shaft.span_of("coast_stages"), "coast_stages need stages")
                .hint("stages are for positive twist, coast_stages for negative"),
        );
    }
    if !shaft.mentions("clearance") && !shaft.mentions("contact") {
        no_free_play(shaft, "clearance or contact", found);
    }
    if shaft.mentions("engagement") && !shaft.mentions("friction") {
        found.push(
            Diagnostic::error(shaft.span_of("engagement"), "engagement needs a friction")
                .hint("add friction = \"... N·m\", what the engaged clutch can bear"),
        );
    }
    if shaft.mentions("friction_speed") && !shaft.mentions("friction") {
        found.push(
            Diagnostic::warning(
                shaft.span_of("friction_speed"),
                "friction_speed does nothing without friction",
            )
            .hint("add friction = \"... N·m\""),
        );
    }
}

/// A bar has all its measures, and no other law.
fn check_bar(shaft: &CheckedTable, bar: &'static str, found: &mut Diagnostics) {
    no_others(shaft, bar, &[&POLYNOMIAL, &WHOLE, &NOT_OF_A_BAR], found);
    for (missing, unit) in NEEDED.into_iter().filter(|(key, _)| !shaft.mentions(key)) {
        found.push(
            Diagnostic::error(
                shaft.span_of(bar),
                format!("a shaft with \"{bar}\" needs \"{missing}\""),
            )
            .hint(format!("add {missing} = \"... {unit}\"")),
        );
    }
    no_free_play(shaft, "clearance or contact", found);
}

/// Where there is no free play, damping has no place to pause.
fn no_free_play(table: &CheckedTable, free_play: &str, found: &mut Diagnostics) {
    if table.mentions("damping_acts") {
        let message = format!("damping_acts does nothing without a {free_play}");
        found
            .push(Diagnostic::warning(table.span_of("damping_acts"), message).hint("leave it out"));
    }
}

/// A law that is the whole torque has no other one beside it.
fn no_others(shaft: &CheckedTable, law: &str, others: &[&[&str]], found: &mut Diagnostics) {
    for key in others.iter().flat_map(|keys| keys.iter()).filter(|key| shaft.mentions(key)) {
        let message = format!("a shaft with \"{law}\" has no \"{key}\"");
        found.push(
            Diagnostic::error(shaft.span_of(key), message)
                .related(shaft.span_of(law), "this is the whole torque")
                .hint(format!("leave out \"{key}\" or \"{law}\"")),
        );
    }
}

fn check_polynomial(shaft: &CheckedTable, found: &mut Diagnostics) {
    if shaft.mentions("clearance") && shaft.mentions("contact") {
        found.push(
            Diagnostic::error(
                shaft.span_of("contact"),
                "a shaft has a clearance or a contact, not both",
            )
            .related(shaft.span_of("clearance"), "the clearance")
            .hint("a second shaft between the same nodes can take one of them"),
        );
    }
    if !shaft.mentions("stiffness") {
        let gap = ["clearance", "contact"].into_iter().find(|key| shaft.mentions(key));
        let (place, message) = match gap {
            Some(gap) => {
                let message = format!("this shaft has {} and no \"stiffness\"", with_article(gap));
                (shaft.span_of(gap), message)
            }
            None => (shaft.span.clone(), "this shaft has no \"stiffness\"".to_owned()),
        };
        found.push(Diagnostic::error(place, message).hint("add stiffness = \"... N·m/rad\""));
    }
}

/// Adds what does not go together in a gear.
pub(crate) fn check_gear(gear: &CheckedTable, found: &mut Diagnostics) {
    if !gear.mentions("clearance") {
        no_free_play(gear, "clearance", found);
    }
    if gear.mentions("stiffness") {
        return;
    }
    let of_mesh = ["damping", "clearance", "referred_to"];
    for key in of_mesh.into_iter().filter(|key| gear.mentions(key)) {
        let message = format!("a gear with \"{key}\" needs the stiffness of its mesh");
        found.push(
            Diagnostic::error(gear.span_of(key), message).hint("add stiffness = \"... N·m/rad\""),
        );
    }
}

/// Adds what does not go together in a torque.
pub(crate) fn check_torque(torque: &CheckedTable, found: &mut Diagnostics) {
    if let Some(orders) = torque.table("orders") {
        let count = orders.numbers("order").len();
        for (key, what) in [("amplitude", "amplitudes"), ("phase", "phases")] {
            let others = orders.numbers(key).len();
            if orders.is_sound() && orders.mentions(key) && others != count {
                let message = format!("{count} orders and {others} {what}");
                found.push(
                    Diagnostic::error(torque.span_of("orders"), message).hint(
                        "each order needs its amplitude, and its phase where phases are given",
                    ),
                );
            }
        }
    }
    for (key, other, unit) in
        [("speed_power", "reference_speed", "\"... rpm\""), ("reference_speed", "speed_power", "2")]
    {
        if torque.mentions(key) && !torque.mentions(other) {
            found.push(
                Diagnostic::error(torque.span_of(key), format!("{key} needs a {other}"))
                    .hint(format!("add {other} = {unit}")),
            );
        }
    }
}
