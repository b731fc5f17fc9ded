//! What is told of a simulation.

use halfshaft_results::{ChannelMetrics, EnergyBalance, HistoryResult};

use super::{Account, Grid, events};
use crate::words::{column_label, column_words, decimals, number, places, plain, quantity};

/// The whole account.
pub(crate) fn account(result: &HistoryResult) -> Account {
    let mut account = Account::default();
    account.text([span(result), largest(result)]);
    account.text(transients(result));
    account.text(events::sentences(result));
    figures(result, &mut account);
    account.append(more(result));
    account.grid(extremes(result));
    account.text(trust(result));
    account
}

/// Beside the history: orders, events, nodes.
pub(crate) fn more(result: &HistoryResult) -> Account {
    let mut account = Account::default();
    for figure in crate::figures::orders::ids(result) {
        account.figure(figure);
    }
    if let Some(map) = &result.orders {
        account.note(events::how(map));
        account.grid(events::orders(map));
    }
    if let Some(grid) = events::table(result) {
        account.grid(grid);
    }
    if !result.metrics.shafts.is_empty() && result.shock.is_none() {
        account.grid(super::shock::table(result));
    }
    if let Some(grid) = events::nodes(result) {
        account.grid(grid);
    }
    account
}

/// How the shaft with the largest torque takes a transient.
fn transients(result: &HistoryResult) -> Vec<String> {
    let shafts = result.metrics.shafts.iter();
    let most = shafts.max_by(|a, b| a.1.peak_torque.abs().total_cmp(&b.1.peak_torque.abs()));
    let Some((name, metrics)) = most else { return Vec::new() };
    let mut sentences = Vec::new();
    if let (Some(after), Some(time)) = (metrics.final_torque, metrics.first_peak_time) {
        let over = metrics.overshoot.map_or_else(String::new, |overshoot| {
            format!(" and overshoots by {}", crate::words::percent(overshoot.abs(), 3))
        });
        sentences.push(format!(
            "The torque of the {} settles at {}; its twist first turns round after {}{over}.",
            plain(name),
            quantity(after, 6, "N·m"),
            quantity(time, 4, "s")
        ));
    }
    sentences.push(super::shock::settling(metrics));
    sentences
}

/// The places of the figures of the history.
pub(crate) fn figures(result: &HistoryResult, account: &mut Account) {
    for id in crate::figures::history::ids(result) {
        account.figure(id);
    }
}

/// Which times the history holds.
pub(crate) fn span(result: &HistoryResult) -> String {
    let times = result.values("time");
    match (times.first(), times.last()) {
        (Some(first), Some(last)) => format!(
            "The history runs from {} to {}, {} points.",
            quantity(*first, 6, "s"),
            quantity(*last, 6, "s"),
            times.len()
        ),
        _ => "The history is empty.".to_owned(),
    }
}

/// The torque that is largest of all shafts.
fn largest(result: &HistoryResult) -> String {
    let torques = result.metrics.channels.iter().filter(|(name, _)| {
        column_words(name).is_some_and(|words| words.quantity == crate::words::Quantity::Torque)
    });
    let size = |metrics: &ChannelMetrics| metrics.maximum.abs().max(metrics.minimum.abs());
    let most = torques.max_by(|a, b| size(a.1).total_cmp(&size(b.1)));
    most.map_or_else(String::new, |(name, metrics)| {
        let owner = column_words(name).map_or("", |words| words.owner);
        format!(
            "The largest shaft torque is {} on the {}.",
            quantity(size(metrics), 6, "N·m"),
            plain(owner)
        )
    })
}

/// Extremes of all channels. Every row has its own unit and size, so each has its own decimals.
pub(crate) fn extremes(result: &HistoryResult) -> Grid {
    let channels = &result.metrics.channels;
    let unit = |name: &str| {
        let column = result.columns.iter().find(|column| column.name == name);
        column.map_or_else(String::new, |column| plain(&column.unit))
    };
    let rows: Vec<[String; 4]> = channels.values().map(extremes_of).collect();
    let column = |index: usize| rows.iter().map(move |row| row[index].clone());
    let mut grid = Grid::new("Extremes over the recorded time")
        .words("channel", channels.keys().map(|name| column_label(name)))
        .words("smallest", column(0))
        .words("largest", column(1))
        .words("half of peak to peak", column(2))
        .words("mean", column(3))
        .words("unit", channels.keys().map(|name| unit(name)));
    grid.columns[1..5].iter_mut().for_each(|column| column.numeric = true);
    grid
}

/// The four numbers of a channel with equal decimals: what is nothing beside the others reads as
/// nothing.
fn extremes_of(metrics: &ChannelMetrics) -> [String; 4] {
    let values = [metrics.minimum, metrics.maximum, metrics.amplitude, metrics.mean];
    let largest = values.iter().map(|value| value.abs()).fold(0.0, f64::max);
    let calm = (1e-6..1e7).contains(&largest);
    let places = places(largest, 6);
    values.map(|value| match calm && value != 0.0 {
        true => decimals(value, places),
        false => number(value, 6),
    })
}

/// How far the numbers can be trusted: energy and effort.
pub(crate) fn trust(result: &HistoryResult) -> Vec<String> {
    let metrics = &result.metrics;
    let mut sentences: Vec<String> = metrics.energy_balance.iter().map(energy).collect();
    if let [first, .., last] = metrics.integrators.as_slice() {
        sentences.push(format!(
            "Integrated by {} and from {} on by {}: {}.",
            first.method,
            quantity(last.from, 4, "s"),
            last.method,
            last.why
        ));
    }
    if metrics.steps > 0 {
        sentences.push(format!(
            "The integration took {} steps and {} evaluations of the equations.",
            metrics.steps, metrics.evaluations
        ));
    }
    sentences
}

/// Where the energy went.
fn energy(balance: &EnergyBalance) -> String {
    let joule = |value: f64| quantity(value, 5, "J");
    format!(
        "Energy balance: {} at the start, {} of work done by the torques, {} turned to heat, {} at \
         the end; it closes to {} of the energy turned over.",
        joule(balance.initial),
        joule(balance.work),
        joule(balance.dissipated),
        joule(balance.stored),
        number(balance.relative_residual.abs(), 2)
    )
}
