//! Order spectra of a run: the waterfall from above, and the amplitudes of single orders over the speed; the
//! states at whole revolutions as a phase portrait.

use halfshaft_results::{HistoryResult, OrderMap};

use super::axes::{column_axis, name, speed_axis};
use crate::figure::{
    Axis, Colour, Curve, Figure, LegendPlace, Marker, Panel, Points, Region, Size,
};
use crate::words::{capital, column_label, number, plain, short};

const WATERFALL: &str = "waterfall";
const CUTS: &str = "order-cuts";
const PORTRAIT: &str = "phase-portrait";

/// Levels of the waterfall in decibels below its largest amplitude, with their colours.
const LEVELS: [(f64, Colour); 7] = [
    (-6.0, Colour::Rgb(128, 0, 38)),
    (-12.0, Colour::Rgb(189, 0, 38)),
    (-18.0, Colour::Rgb(240, 59, 32)),
    (-24.0, Colour::Rgb(253, 141, 60)),
    (-32.0, Colour::Rgb(254, 178, 76)),
    (-40.0, Colour::Rgb(254, 217, 118)),
    (-50.0, Colour::Rgb(255, 245, 205)),
];
/// Rows and columns at most: finer ones would not be seen.
const MOST_ROWS: usize = 160;
/// Points of a portrait at most.
const MOST_POINTS: usize = 4000;
/// Speeds that differ by less than this part are one.
const STEADY: f64 = 1e-9;

/// The ids of the figures, in their order.
pub(crate) fn ids(result: &HistoryResult) -> Vec<String> {
    figures(result).into_iter().map(|figure| figure.id).collect()
}

/// Waterfall and cuts of a run whose speed moves, the portrait of one whose speed stays.
pub(super) fn figures(result: &HistoryResult) -> Vec<Figure> {
    let moves = |map: &&OrderMap| {
        let ends = (map.frequency.first(), map.frequency.last());
        matches!(ends, (Some(a), Some(b)) if (a - b).abs() > STEADY * a.abs())
    };
    let mut figures = Vec::new();
    match result.orders.as_deref().filter(moves) {
        Some(map) => figures.extend([waterfall(map), cuts(map)]),
        None => figures.extend(portrait(result)),
    }
    figures
}

fn waterfall(map: &OrderMap) -> Figure {
    let all = map.amplitude.iter().flatten();
    let largest = all.copied().filter(|a| a.is_finite()).fold(f64::MIN_POSITIVE, f64::max);
    let mut panel = Panel::new(Axis::new("Order", "per revolution"), speed_axis());
    let mut above = f64::INFINITY;
    for (level, colour) in LEVELS {
        let from = largest * 10_f64.powf(level / 20.0);
        let (x, y) = cells(map, (from, above));
        if !x.is_empty() {
            let label = format!("from {} {}", number(from, 3), plain(&map.unit));
            panel = panel.with(Region { opacity: 1.0, ..Region::new(label, x, y, colour) });
        }
        above = from;
    }
    // Every corner of the picture may hold something.
    panel = panel.with_legend(LegendPlace::Below);
    let title = format!("Orders of the {}", short(&column_label(&map.channel), 50));
    Figure::new(WATERFALL, title)
        .with_caption("Amplitude over the orders of the excitation at every speed of the run.")
        .with_size(Size::Square)
        .with(panel)
}

/// Corners of the cells whose amplitudes lie between two, stretches of a row joined.
fn cells(map: &OrderMap, (from, to): (f64, f64)) -> (Vec<f64>, Vec<f64>) {
    let (mut x, mut y) = (Vec::new(), Vec::new());
    let step = map.frequency.len().div_ceil(MOST_ROWS).max(1);
    let inside = |value: f64| value >= from && value < to;
    let rows: Vec<usize> = (0..map.frequency.len()).step_by(step).collect();
    let half = 0.5 * map.order.get(1).map_or(1.0, |second| second - map.order[0]);
    for (at, row) in rows.iter().enumerate() {
        let here = map.frequency[*row];
        let beside = |k: Option<usize>| k.and_then(|k| rows.get(k)).map(|k| map.frequency[*k]);
        let (before, after) = (beside(at.checked_sub(1)), beside(Some(at + 1)));
        let gap = match (before, after) {
            (Some(a), Some(b)) => [0.5 * (here - a), 0.5 * (b - here)],
            (Some(a), None) => [0.5 * (here - a); 2],
            (None, Some(b)) => [0.5 * (b - here); 2],
            (None, None) => [0.5; 2],
        };
        let (low, high) = (here - gap[0], here + gap[1]);
        let values = &map.amplitude[*row];
        let mut column = 0;
        while column < values.len() {
            let start = column;
            while column < values.len() && inside(values[column]) {
                column += 1;
            }
            if column > start {
                let (left, right) = (map.order[start] - half, map.order[column - 1] + half);
                x.extend([left, right, right, left, f64::NAN]);
                y.extend([low, low, high, high, f64::NAN]);
            } else {
                column += 1;
            }
        }
    }
    (x, y)
}

fn cuts(map: &OrderMap) -> Figure {
    let label = capital(&short(&column_label(&map.channel), 60));
    let mut panel =
        Panel::new(speed_axis(), Axis::new(format!("{label}, amplitude"), plain(&map.unit)));
    for (index, order) in map.cuts.iter().enumerate() {
        let curve = Curve::new(
            format!("order {}", number(*order, 4)),
            map.frequency.clone(),
            map.cut(*order),
            Colour::index(index),
        );
        panel = panel.with(curve);
    }
    Figure::new(CUTS, "Order cuts")
        .with_caption("Amplitudes of single orders of the excitation over its speed.")
        .with(panel)
}

/// Twist and rate of the shaft with free play or dry friction, else the first, with the states at whole
/// revolutions.
fn portrait(result: &HistoryResult) -> Option<Figure> {
    let section = result.section.as_ref()?;
    let first = section.columns.get(1)?.name.strip_suffix(".twist")?.to_owned();
    let shaft = result.metrics.events.keys().next().cloned().unwrap_or(first);
    let (twist, rate) = (format!("{shaft}.twist"), format!("{shaft}.twist_rate"));
    let of = |name: &str| section.columns.iter().find(|c| c.name == name).map(|c| c.values.clone());
    let thin = |values: Vec<f64>| -> Vec<f64> {
        let step = values.len().div_ceil(MOST_POINTS).max(1);
        values.into_iter().step_by(step).collect()
    };
    let (x, y) = (result.values(&twist).to_vec(), result.values(&rate).to_vec());
    let mut path = Curve::new("motion", x, y, Colour::AUXILIARY);
    path.width = 0.6;
    let points = Points::new(
        "whenever a revolution of the excitation begins",
        thin(of(&twist)?),
        thin(of(&rate)?),
        Colour::DANGER,
    );
    let panel = Panel::new(column_axis(&twist, "rad"), column_axis(&rate, "rad/s"))
        .with(path)
        .with(Points { marker: Marker::Circle, size: 4.0, ..points });
    let figure = Figure::new(PORTRAIT, format!("Phase portrait: {}", name(&shaft)))
        .with_caption("Rate of twist over twist; points at the beginning of every revolution.")
        .with_size(Size::Square)
        .with(panel);
    Some(figure)
}
