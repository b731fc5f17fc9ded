//! Reference lines and labels as shapes and annotations.

use serde_json::{Value, json};

use super::axes::Frame;
use super::text::{hex, rounded, typeset};
use crate::figure::axis::Scale;
use crate::figure::compose::{NamedReference, style};
use crate::figure::item::{Anchor, Direction, Item, Label, Reference};
use crate::figure::panel::Panel;
use crate::figure::svg::PIXELS_PER_POINT;
use crate::figure::view::View;

/// The border of a panel and the straight lines across it.
pub(super) fn shapes(panel: &Panel, frame: &Frame) -> Vec<Value> {
    let lines = references(panel).filter_map(|reference| shape(reference, frame));
    std::iter::once(border(frame)).chain(lines).collect()
}

/// A rectangle, because plotly can draw axis lines on all panels of a shared axis only together
/// with their marks.
fn border(frame: &Frame) -> Value {
    json!({
        "type": "rect", "layer": "below", "line": { "color": hex(style::FRAME), "width": 1 },
        "xref": format!("{} domain", frame.x), "x0": 0, "x1": 1,
        "yref": format!("{} domain", frame.y), "y0": 0, "y1": 1,
    })
}

/// The remark in the middle of a panel, or of the whole figure, that there is nothing to see.
pub(super) fn empty(frame: Option<&Frame>) -> Value {
    let mut note = note("no data to show", &hex(style::FAINT));
    let place = frame.map_or_else(
        || ("paper".to_owned(), "paper".to_owned()),
        |frame| (format!("{} domain", frame.x), format!("{} domain", frame.y)),
    );
    merge(&mut note, json!({ "xref": place.0, "x": 0.5, "yref": place.1, "y": 0.5 }));
    note
}

/// The texts of a panel.
pub(super) fn annotations(panel: &Panel, frame: &Frame, named: &[NamedReference]) -> Vec<Value> {
    let along = panel.items.iter().enumerate().filter_map(|(number, item)| match item {
        Item::Reference(reference) => {
            along(reference, frame, named.iter().find(|named| named.item == number))
        }
        _ => None,
    });
    let labels = panel.items.iter().filter_map(|item| match item {
        Item::Label(label) => placed(label, frame),
        _ => None,
    });
    along.chain(labels).collect()
}

fn references(panel: &Panel) -> impl Iterator<Item = &Reference> {
    panel.items.iter().filter_map(|item| match item {
        Item::Reference(reference) => Some(reference),
        _ => None,
    })
}

fn shape(reference: &Reference, frame: &Frame) -> Option<Value> {
    let value = rounded(reference.value)?;
    let dash: Vec<String> = style::dashes(reference.line)
        .iter()
        .map(|length| format!("{:.1}px", length * style::REFERENCE_WIDTH * PIXELS_PER_POINT))
        .collect();
    let line = json!({
        "color": hex(reference.colour.rgb()),
        "width": rounded(style::REFERENCE_WIDTH * PIXELS_PER_POINT),
        "dash": if dash.is_empty() { "solid".to_owned() } else { dash.join(",") },
    });
    let (x, y) = (&frame.x, &frame.y);
    let shape = match reference.axis {
        Direction::Horizontal => json!({
            "type": "line", "layer": "above", "line": line,
            "xref": format!("{x} domain"), "x0": 0, "x1": 1, "yref": y, "y0": value, "y1": value,
        }),
        Direction::Vertical => json!({
            "type": "line", "layer": "above", "line": line,
            "yref": format!("{y} domain"), "y0": 0, "y1": 1, "xref": x, "x0": value, "x1": value,
        }),
    };
    Some(shape)
}

/// The text of a reference line, on the side that the composed figure found for it.
fn along(reference: &Reference, frame: &Frame, named: Option<&NamedReference>) -> Option<Value> {
    let text = typeset(&reference.label);
    if text.is_empty() {
        return None;
    }
    let mut note = note(&text, &hex(reference.colour.rgb()));
    let (x, y) = (&frame.x, &frame.y);
    let (at_end, before) = named.map_or((true, true), |named| (named.at_end, named.before));
    let place = match reference.axis {
        Direction::Horizontal => json!({
            "xref": format!("{x} domain"), "x": if at_end { 0.99 } else { 0.01 },
            "xanchor": if at_end { "right" } else { "left" },
            "yref": y, "y": coordinate(&frame.y_view, reference.value)?,
            "yanchor": if before { "bottom" } else { "top" },
        }),
        Direction::Vertical => json!({
            "yref": format!("{y} domain"), "y": if at_end { 0.98 } else { 0.02 },
            "yanchor": if at_end { "top" } else { "bottom" },
            "xref": x, "x": coordinate(&frame.x_view, reference.value)?,
            "xanchor": if before { "right" } else { "left" },
            "textangle": -90,
        }),
    };
    merge(&mut note, place);
    Some(note)
}

fn placed(label: &Label, frame: &Frame) -> Option<Value> {
    let text = typeset(&label.text);
    let x = coordinate(&frame.x_view, label.x)?;
    let y = coordinate(&frame.y_view, label.y)?;
    let (across, up) = match label.anchor {
        Anchor::Centre => ("center", "middle"),
        Anchor::Left => ("right", "middle"),
        Anchor::Right => ("left", "middle"),
        Anchor::Above => ("center", "bottom"),
        Anchor::Below => ("center", "top"),
    };
    let mut note = note(&text, &hex(label.colour.rgb()));
    let place = json!({
        "xref": frame.x, "x": x, "xanchor": across, "yref": frame.y, "y": y, "yanchor": up,
    });
    merge(&mut note, place);
    Some(note)
}

fn note(text: &str, colour: &str) -> Value {
    json!({
        "text": text,
        "showarrow": false,
        "font": { "color": colour, "size": 12 },
        "bgcolor": "rgba(255,255,255,0.6)",
        "borderpad": 1,
    })
}

/// Annotations, unlike shapes, count in powers of ten on a logarithmic axis.
fn coordinate(view: &View, value: f64) -> Option<f64> {
    match view.scale {
        Scale::Linear => rounded(value),
        Scale::Log => rounded(value.log10()),
    }
}

fn merge(into: &mut Value, from: Value) {
    if let (Value::Object(into), Value::Object(from)) = (into, from) {
        into.extend(from);
    }
}
