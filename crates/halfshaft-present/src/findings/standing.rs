//! Whether the shafts carry the mean torques.

use halfshaft_results::{GearState, RunningKind, StaticResult};

use super::{Finding, Standing};
use crate::account::statics::{Margin, gear_margin, gear_name, margins, primary, tightest};
use crate::words::{capital, list, number, quantity, times};

/// The load in the model's own gear.
pub(super) fn load(result: &StaticResult) -> Vec<Finding> {
    let margins = margins(result);
    let topic = match result.running.kind {
        RunningKind::Held => "Static load",
        RunningKind::Accelerating => "Load while accelerating",
        RunningKind::Balanced | RunningKind::SteadySpeed => "Steady running",
    };
    let Some(tight) = tightest(&margins) else { return Vec::new() };
    if primary(result).is_none() {
        let text = match tight.carries {
            Some(limit) if tight.factor() < 1.0 => format!(
                "There is no stable state: the {} would have to carry {} and can carry {}, {} of that.",
                tight.shaft,
                torque(tight.asked),
                torque(limit.torque),
                crate::words::percent(tight.factor(), 3)
            ),
            _ => "No stable state was found under the mean torques.".to_owned(),
        };
        return vec![Finding::new(Standing::Unsafe, topic, text)];
    }
    let text = match tight.carries {
        Some(limit) if tight.asked == 0.0 => {
            format!("Nothing loads the {}; it can carry {}.", tight.shaft, torque(limit.torque))
        }
        Some(limit) => format!(
            "The {} can carry {}; {} asks {}: {} what is needed.",
            tight.shaft,
            torque(limit.torque),
            topic.to_lowercase(),
            torque(tight.asked),
            times(tight.factor())
        ),
        None => unlimited(&margins),
    };
    vec![Finding::new(Standing::of_margin(tight.factor()), topic, text)]
}

/// Where no loaded shaft has a limit.
fn unlimited(margins: &[Margin]) -> String {
    let most = margins.iter().max_by(|a, b| a.asked.total_cmp(&b.asked));
    most.map_or_else(String::new, |most| {
        format!(
            "No shaft has a limit in its law in the direction of its load; the largest load is {} on \
             the {}.",
            torque(most.asked),
            most.shaft
        )
    })
}

fn torque(value: f64) -> String {
    quantity(value, 4, "N·m")
}

/// The other gears: those that hold and those that do not.
pub(super) fn gears(result: &StaticResult) -> Vec<Finding> {
    let (hold, fail): (Vec<&GearState>, Vec<&GearState>) =
        result.gears.iter().partition(|gear| gear.exists);
    let mut found = Vec::new();
    if !fail.is_empty() {
        found.push(Finding::new(Standing::Unsafe, &topic(&fail), failing(result, &fail)));
    }
    if !hold.is_empty() {
        let tight = hold
            .iter()
            .filter_map(|gear| Some((gear_margin(result, gear)?, *gear)))
            .min_by(|a, b| a.0.factor().total_cmp(&b.0.factor()));
        let (factor, text) = tight.map_or((f64::INFINITY, String::new()), |(margin, gear)| {
            (margin.factor(), holding(&hold, gear, &margin))
        });
        found.push(Finding::new(Standing::of_margin(factor), &topic(&hold), text));
    }
    found
}

fn topic(gears: &[&GearState]) -> String {
    let names: Vec<String> = gears.iter().map(|gear| gear_name(gear)).collect();
    let noun = if gears.len() == 1 { "Gear" } else { "Gears" };
    format!("{noun} {}", list(&names))
}

fn failing(result: &StaticResult, fail: &[&GearState]) -> String {
    let demands: Vec<String> = fail
        .iter()
        .filter_map(|gear| {
            let margin = gear_margin(result, gear)?;
            Some(format!("{} asks {}", gear_name(gear), torque(margin.asked)))
        })
        .collect();
    let carries = fail
        .iter()
        .filter_map(|gear| gear_margin(result, gear))
        .filter_map(|margin| Some((margin.shaft.clone(), margin.carries?)))
        .min_by(|a, b| a.1.torque.total_cmp(&b.1.torque));
    let limit = carries.map_or_else(String::new, |(shaft, limit)| {
        format!("; the {shaft} can carry {}", torque(limit.torque))
    });
    capital(&format!("there is no stable state at these torques: {}{limit}.", list(&demands)))
}

fn holding(hold: &[&GearState], tight: &GearState, margin: &Margin) -> String {
    let Some(limit) = margin.carries else {
        return "No loaded shaft has a limit in its law.".to_owned();
    };
    let which = if hold.len() == 1 {
        String::new()
    } else {
        format!("The tightest is {}: ", gear_name(tight))
    };
    let text = format!(
        "{which}it asks {} of the {}, which can carry {}, {} as much.",
        torque(margin.asked),
        margin.shaft,
        torque(limit.torque),
        number(margin.factor(), 3) + "\u{a0}times"
    );
    capital(&text)
}
