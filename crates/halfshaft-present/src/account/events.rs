//! What is told of contacts, stages, stick and slip, of order spectra, and of how nodes turn.

use halfshaft_results::{ConnectionEvents, HistoryResult, OrderMap};

use super::Grid;
use crate::words::{capital, column_label, number, percent, plain, quantity};

/// Events that are listed in an account.
const LISTED: usize = 12;

/// Sentences on every connection that switched.
pub(super) fn sentences(result: &HistoryResult) -> Vec<String> {
    let events = result.metrics.events.iter();
    events.flat_map(|(name, events)| of_connection(&plain(name), events)).collect()
}

fn of_connection(name: &str, events: &ConnectionEvents) -> Vec<String> {
    let times = |count: u64| if count == 1 { "once".to_owned() } else { format!("{count} times") };
    let mut sentences = Vec::new();
    if events.contacts > 0 {
        let crossings = match events.lash_crossings {
            0 => String::new(),
            count => format!(", {} of these across the gap", times(count)),
        };
        sentences.push(format!(
            "The {name} comes into contact {}{crossings}; the hardest impact is at {} with {}, and it is \
             in free play for {} of the time.",
            times(events.contacts),
            quantity(events.hardest_impact_speed, 4, "rad/s"),
            quantity(events.hardest_impact_energy, 4, "J"),
            percent(events.free_share, 3)
        ));
    } else if events.separations > 0 {
        sentences.push(format!("The {name} loses contact and does not meet again."));
    }
    if events.stage_changes > 0 {
        sentences.push(format!("The {name} changes its stage {}.", times(events.stage_changes)));
    }
    if events.sticks + events.slips > 0 {
        sentences.push(format!(
            "The dry friction of the {name} comes to stick {}; it sticks for {} of the time.",
            times(events.sticks),
            percent(events.stuck_share, 3)
        ));
    }
    sentences
}

/// The first events, one row each.
pub(super) fn table(result: &HistoryResult) -> Option<Grid> {
    if result.events.is_empty() {
        return None;
    }
    let first = || result.events.iter().take(LISTED);
    let title = match result.events.len() {
        count if count > LISTED => format!("Events: the first {LISTED} of {count}"),
        _ => "Events".to_owned(),
    };
    let grid = Grid::new(title)
        .numbers("time", "s", 8, first().map(|event| Some(event.time)))
        .words("what", first().map(|event| event.text.as_str()))
        .numbers("twist", "rad", 5, first().map(|event| Some(event.twist)))
        .numbers("rate of twist", "rad/s", 5, first().map(|event| Some(event.twist_rate)))
        .numbers("energy", "J", 4, first().map(|event| event.energy));
    Some(grid.without_empty_columns())
}

/// How the nodes turn, one row each.
pub(super) fn nodes(result: &HistoryResult) -> Option<Grid> {
    let nodes = &result.metrics.nodes;
    let moving = nodes.values().any(|node| node.peak_acceleration != 0.0);
    let values =
        |of: fn(&halfshaft_results::NodeMetrics) -> f64| nodes.values().map(move |n| Some(of(n)));
    moving.then(|| {
        Grid::new("How the nodes turn")
            .words("node", nodes.keys())
            .numbers("irregularity", "", 4, nodes.values().map(|node| node.speed_irregularity))
            .numbers("peak acceleration", "rad/s²", 5, values(|node| node.peak_acceleration))
            .numbers("at", "s", 5, values(|node| node.peak_acceleration_time))
            .numbers("peak jerk", "rad/s³", 4, values(|node| node.peak_jerk))
            .numbers("at", "s", 5, values(|node| node.peak_jerk_time))
            .without_empty_columns()
    })
}

/// Where each order of a run is largest.
pub(super) fn orders(map: &OrderMap) -> Grid {
    let peaks: Vec<(f64, f64)> = map
        .cuts
        .iter()
        .map(|order| {
            let cut = map.cut(*order);
            let pairs = cut.into_iter().zip(map.frequency.iter().copied());
            pairs.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((f64::NAN, f64::NAN))
        })
        .collect();
    let unit = plain(&map.unit);
    Grid::new(format!("Orders of the {}", column_label(&map.channel)))
        .words("order", map.cuts.iter().map(|order| number(*order, 4)))
        .numbers("largest amplitude", &unit, 5, peaks.iter().map(|peak| Some(peak.0)))
        .numbers("at", "rad/s", 5, peaks.iter().map(|peak| Some(peak.1)))
        .numbers("", "rpm", 5, peaks.iter().map(|peak| Some(peak.1 * 30.0 / std::f64::consts::PI)))
}

/// How the spectra were made.
pub(super) fn how(map: &OrderMap) -> String {
    format!(
        "{}: spectra of blocks of {} revolutions of the excitation under Hann's window, sampled at even \
         phases.",
        capital(&column_label(&map.channel)),
        map.revolutions
    )
}
