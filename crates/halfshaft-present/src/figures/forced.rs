//! Vibratory torques over the excitation speed, and the orders of the most loaded shaft.

use halfshaft_results::{ForcedGear, ForcedPeak, ForcedResult};

use super::axes::{name, speed_axis};
use crate::account::campbell::gear_name;
use crate::figure::{Axis, Colour, Curve, Figure, Line, Panel, escape};
use crate::words::number;

/// Curves in one panel at most.
const MOST_CURVES: usize = 6;

/// The ids of the figures of a gear, in their order.
pub(crate) fn ids(gear: &ForcedGear, index: usize) -> Vec<String> {
    let numbered = |what: &str| match index {
        0 => what.to_owned(),
        _ => format!("{what}-{}", index + 1),
    };
    let mut ids = vec![numbered("forced")];
    if in_orders(gear).is_some() {
        ids.push(numbered("forced-orders"));
    }
    ids
}

/// Figures for each gear.
pub(super) fn figures(result: &ForcedResult) -> Vec<Figure> {
    let several = result.gears.len() > 1;
    let mut figures = Vec::new();
    for (index, gear) in result.gears.iter().enumerate() {
        let of =
            if several { format!(": {}", escape(&gear_name(&gear.gear))) } else { String::new() };
        let mut ids = ids(gear, index).into_iter();
        if let Some(id) = ids.next() {
            figures.push(overall(gear, id, &of));
        }
        if let (Some(id), Some(channel)) = (ids.next(), in_orders(gear)) {
            figures.push(orders(gear, channel, result, id, &of));
        }
    }
    figures
}

/// Peaks of one unit, the largest first.
fn largest<'g>(gear: &'g ForcedGear, unit: &str) -> Vec<&'g ForcedPeak> {
    let mut peaks: Vec<&ForcedPeak> = gear.peaks.iter().filter(|peak| peak.unit == unit).collect();
    peaks.sort_by(|a, b| b.amplitude.total_cmp(&a.amplitude));
    // Pieces of a bar look alike: the most loaded one stands for all.
    let mut known: Vec<&str> = Vec::new();
    peaks.retain(|peak| {
        let bar = bar(&peak.channel);
        let new = bar.is_none_or(|bar| !known.contains(&bar));
        known.extend(bar);
        new
    });
    peaks.truncate(MOST_CURVES);
    peaks
}

/// The bar of a piece such as `propeller shaft.3`.
fn bar(channel: &str) -> Option<&str> {
    let (owner, _) = channel.rsplit_once('.')?;
    let (bar, piece) = owner.rsplit_once('.')?;
    let numbered = !piece.is_empty() && piece.chars().all(|c| c.is_ascii_digit());
    numbered.then_some(bar)
}

/// The most loaded shaft that is told order by order, where there are several orders.
fn in_orders(gear: &ForcedGear) -> Option<&str> {
    let told = |channel: &str| {
        let beginning = format!("{channel}.order");
        let moduli = |name: &&str| name.starts_with(&beginning) && !name.ends_with(".phase");
        gear.table.columns.iter().map(|c| c.name.as_str()).filter(moduli).count() > 1
    };
    largest(gear, "N·m").into_iter().map(|peak| peak.channel.as_str()).find(|channel| told(channel))
}

fn overall(gear: &ForcedGear, id: String, of: &str) -> Figure {
    let speeds = gear.table.values("frequency");
    let mut figure = Figure::new(id, format!("Vibration over the speed{of}")).with_caption(
        "Half of the range over a period, all orders together with their phases; the most loaded shafts \
         and the most accelerated nodes.",
    );
    for (unit, label) in [("N·m", "Torque, half range"), ("rad/s²", "Acceleration, half range")] {
        let peaks = largest(gear, unit);
        if peaks.is_empty() {
            continue;
        }
        let mut panel = Panel::new(speed_axis(), Axis::new(label, unit).logarithmic());
        for (index, peak) in peaks.iter().enumerate() {
            let values = gear.table.values(&format!("{}.amplitude", peak.channel));
            let owner =
                peak.channel.rsplit_once('.').map_or(peak.channel.as_str(), |(owner, _)| owner);
            let curve =
                Curve::new(name(owner), speeds.to_vec(), values.to_vec(), Colour::index(index));
            panel = panel.with(curve);
        }
        figure = figure.with(panel);
    }
    figure
}

fn orders(gear: &ForcedGear, channel: &str, result: &ForcedResult, id: String, of: &str) -> Figure {
    let speeds = gear.table.values("frequency");
    let column = |order: f64| gear.table.values(&format!("{channel}.order{order}"));
    let most =
        |values: &[f64]| values.iter().copied().filter(|v| v.is_finite()).fold(0.0, f64::max);
    let mut loudest: Vec<f64> = result.orders.clone();
    loudest.sort_by(|a, b| most(column(*b)).total_cmp(&most(column(*a))));
    loudest.truncate(MOST_CURVES);
    loudest.sort_by(f64::total_cmp);
    let owner = channel.rsplit_once('.').map_or(channel, |(owner, _)| owner);
    let mut panel = Panel::new(speed_axis(), Axis::new("Torque", "N·m"));
    let all = gear.table.values(&format!("{channel}.amplitude"));
    let sum =
        Curve::new("all orders, half range", speeds.to_vec(), all.to_vec(), Colour::AUXILIARY);
    panel = panel.with(sum.with_line(Line::Dashed));
    for (index, order) in loudest.into_iter().enumerate() {
        let label = format!("order {}", number(order, 4));
        let values = column(order).to_vec();
        panel = panel.with(Curve::new(label, speeds.to_vec(), values, Colour::index(index)));
    }
    Figure::new(id, format!("Orders of the torque in the {}{of}", name(owner)))
        .with_caption("Amplitudes of single orders, and half of the range of all of them together.")
        .with(panel)
}
