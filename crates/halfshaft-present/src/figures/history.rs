//! Time histories of the shafts: twist, rate of twist and torque above each other.

use halfshaft_results::HistoryResult;

use super::axes::{curve, level, name, time_axis};
use crate::figure::{Axis, Colour, Figure, Marker, Panel, Points};
use crate::words::{Quantity, column_words, list, plain};

/// Shafts in one figure.
const TOGETHER: usize = 3;
/// Figures at most.
const MOST_FIGURES: usize = 8;

/// Panels from top to bottom.
const PANELS: [(Quantity, &str); 3] =
    [(Quantity::Twist, "rad"), (Quantity::TwistRate, "rad/s"), (Quantity::Torque, "N·m")];

/// The ids of the figures of a history.
pub(crate) fn ids(result: &HistoryResult) -> Vec<String> {
    groups(result).iter().enumerate().map(|(index, _)| id(index)).collect()
}

fn id(index: usize) -> String {
    if index == 0 { "history".to_owned() } else { format!("history-{}", index + 1) }
}

/// A figure for every few shafts.
pub(super) fn figures(result: &HistoryResult) -> Vec<Figure> {
    let groups = groups(result);
    groups.iter().enumerate().map(|(index, group)| figure(result, index, group)).collect()
}

/// The shafts of each figure, that of the answer first.
fn groups(result: &HistoryResult) -> Vec<Vec<&str>> {
    let mut shafts: Vec<&str> = Vec::new();
    for column in &result.columns {
        if let Some(words) = column_words(&column.name)
            && PANELS.iter().any(|(quantity, _)| *quantity == words.quantity)
            && words.quantity.key() == column.name.rsplit('.').next().unwrap_or_default()
            && !shafts.contains(&words.owner)
        {
            shafts.push(words.owner);
        }
    }
    if let Some(shock) = &result.shock {
        shafts.sort_by_key(|shaft| *shaft != shock.shaft);
    }
    shafts.chunks(TOGETHER).take(MOST_FIGURES).map(<[&str]>::to_vec).collect()
}

fn figure(result: &HistoryResult, index: usize, shafts: &[&str]) -> Figure {
    let mut figure = Figure::new(id(index), title(result, shafts)).with_caption(caption(result));
    for (number, (quantity, unit)) in PANELS.into_iter().enumerate() {
        if let Some(panel) = panel(result, shafts, quantity, unit, number == 0) {
            figure = figure.with(panel);
        }
    }
    figure
}

fn title(result: &HistoryResult, shafts: &[&str]) -> String {
    let names: Vec<String> = shafts.iter().map(|shaft| name(shaft)).collect();
    let what = if result.shock.is_some() { "Answer to the shock" } else { "Motion" };
    format!("{what}: {}", list(&names))
}

fn caption(result: &HistoryResult) -> String {
    if result.shock.is_some() {
        "Twist, rate of twist and torque over time. Dotted: the level before the shock.".to_owned()
    } else {
        "Twist, rate of twist and torque over time.".to_owned()
    }
}

/// One quantity of a few shafts; none where no shaft has it.
fn panel(
    result: &HistoryResult,
    shafts: &[&str],
    quantity: Quantity,
    unit: &str,
    first: bool,
) -> Option<Panel> {
    let label = crate::words::capital(quantity.words());
    let mut panel = Panel::new(time_axis(), Axis::new(label, unit));
    let time = result.values("time");
    for (index, shaft) in shafts.iter().enumerate() {
        let values = result.values(&format!("{shaft}.{}", quantity.key()));
        if values.is_empty() {
            continue;
        }
        let mut line = curve(name(shaft), time, values, Colour::index(index));
        // The upper panel's legend is enough for all.
        line.in_legend = first && shafts.len() > 1;
        panel = panel.with(line);
        if quantity != Quantity::Torque {
            panel = panel.with_all(marks(result, shaft, quantity, first));
        }
        if let Some(value) = before(result, shaft, quantity).filter(|_| shafts.len() == 1) {
            panel = panel.with(level(value, "before"));
        }
    }
    (!panel.items.is_empty()).then_some(panel)
}

/// Kinds of events with their names and marks.
const EVENTS: [(&str, &str, Marker, Colour); 4] = [
    ("contact", "contact", Marker::Triangle, Colour::DANGER),
    ("separation", "contact lost", Marker::TriangleDown, Colour::Orange),
    ("stick", "sticks", Marker::Square, Colour::Purple),
    ("slip", "slides", Marker::Diamond, Colour::SAFE),
];
/// More marks than this of one kind would hide the curve.
const MOST_MARKS: usize = 400;

/// The events of a shaft as points on its curve.
fn marks(result: &HistoryResult, shaft: &str, quantity: Quantity, first: bool) -> Vec<Points> {
    let of = |(kind, label, marker, colour): (&str, &str, Marker, Colour)| {
        let events = result.events.iter().filter(|e| e.kind == kind && e.element == shaft);
        let value = |event: &halfshaft_results::HistoryEvent| match quantity {
            Quantity::Twist => event.twist,
            _ => event.twist_rate,
        };
        let (x, y): (Vec<f64>, Vec<f64>) = events.map(|e| (e.time, value(e))).unzip();
        let drawn = !x.is_empty() && x.len() <= MOST_MARKS;
        drawn.then(|| Points {
            marker,
            size: 5.0,
            in_legend: first,
            ..Points::new(label, x, y, colour)
        })
    };
    EVENTS.into_iter().filter_map(of).collect()
}

/// The value before the shock.
fn before(result: &HistoryResult, shaft: &str, quantity: Quantity) -> Option<f64> {
    let shock = result.shock.as_ref()?;
    // The single equations tell the advance of the load end, whose level before is zero.
    let absolute = plain(&shock.method) == "full";
    match quantity {
        Quantity::Twist if absolute => shock.equilibrium.get(shaft).copied(),
        Quantity::Torque => result.metrics.shafts.get(shaft).map(|metrics| metrics.static_torque),
        _ => None,
    }
}
