//! The shape of each mode: how far every inertia moves.

use halfshaft_results::{Mode, ModesResult};

use super::axes::name;
use crate::account::modes::elastic;
use crate::figure::{
    Axis, Colour, Curve, Figure, LegendPlace, Panel, Points, Reference, Size, escape,
};
use crate::words::{frequency_words, percent, plain};

/// Modes that get a figure.
const MOST: usize = 6;
/// Nodes that a figure shows.
const MOST_NODES: usize = 60;

/// The id of the figure of elastic mode `number`, from 1.
pub(crate) fn id(number: usize) -> String {
    format!("mode-{number}")
}

/// One figure for each of the lowest elastic modes.
pub(super) fn figures(result: &ModesResult) -> Vec<Figure> {
    elastic(result).take(MOST).enumerate().map(|(i, mode)| figure(i + 1, mode)).collect()
}

fn figure(number: usize, mode: &Mode) -> Figure {
    let nodes = nodes(mode);
    let place = |row: usize| -(row as f64);
    let names = nodes.iter().enumerate().map(|(row, node)| (place(row), name(node.0))).collect();
    let x = Axis::new("Motion over the largest", "").with_range(-1.12, 1.12);
    let y = Axis { names, ..Axis::default() }.with_range(place(nodes.len()) + 0.4, 0.6);
    let mut panel = Panel::new(x, y).with_legend(LegendPlace::Hidden);
    panel = panel.with(Reference {
        line: crate::figure::Line::Solid,
        ..Reference::vertical(0.0, "", Colour::AUXILIARY)
    });
    for (row, (_, value)) in nodes.iter().enumerate() {
        let (x, y) = (vec![0.0, *value], vec![place(row); 2]);
        panel = panel.with(Curve::new("", x, y, Colour::PRIMARY).with_width(4.0).unlisted());
    }
    let (values, rows): (Vec<f64>, Vec<f64>) =
        nodes.iter().enumerate().map(|(row, node)| (node.1, place(row))).unzip();
    let labels = values.iter().map(|value| crate::words::number(*value, 3)).collect();
    let mut panel = panel
        .with(Points::new("motion", values, rows, Colour::PRIMARY).with_labels(labels).unlisted());
    // On a page the panel is as high as its bars need, compared with the usual panel.
    panel.height_share = (40.0 + 26.0 * nodes.len() as f64) / 310.0;
    let height = 92.0 + 21.0 * nodes.len() as f64;
    let title = format!("Mode {number}: {}", frequency_words(mode.frequency));
    let label = plain(&mode.label);
    let damping = percent(mode.damping_ratio, 3);
    Figure::new(id(number), title)
        .with_caption(escape(&format!(
            "Mode {number}, {damping} of critical damping: {label}. Bars on the same side move \
             together, bars on opposite sides against each other."
        )))
        .with_size(Size::Points { width: 460.8, height })
        .with(panel)
}

/// The inertias with their motion; every node where no inertia is known.
fn nodes(mode: &Mode) -> Vec<(&String, f64)> {
    let is_body = |node: &&String| mode.kinetic_energy.contains_key(node.as_str());
    let some_body = mode.shape.keys().any(|node| is_body(&node));
    mode.shape
        .iter()
        .filter(|(node, _)| !some_body || is_body(node))
        .map(|(node, value)| (node, *value))
        .take(MOST_NODES)
        .collect()
}
