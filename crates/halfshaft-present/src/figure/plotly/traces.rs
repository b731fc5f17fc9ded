//! Curves, points and regions as traces.

use std::collections::BTreeSet;

use serde_json::{Value, json};

use super::axes::Frame;
use super::text::{DIGITS, hex, hover_line, rounded, rounded_to, typeset};
use crate::figure::axis::Scale;
use crate::figure::compose::{BUDGET, NamedPoint, style};
use crate::figure::geometry::{Point, simplify};
use crate::figure::item::{Curve, Item, Line, Marker, Points, Region};
use crate::figure::panel::{LegendPlace, Panel};
use crate::figure::svg::PIXELS_PER_POINT;
use crate::figure::view::View;

/// The reader may enlarge a curve, so it is kept as exact as on a page this many points wide.
const ENLARGED_PAGE: f64 = 2000.0;
/// Curves with more points than this are thinned.
const MANY_POINTS: usize = 4_000;
/// How far a thinned curve may be off on the enlarged page, in points.
const TOLERANCE: f64 = 0.05;

/// The traces of a panel, areas first.
pub(super) fn of_panel(panel: &Panel, frame: &Frame, named: &[NamedPoint]) -> Vec<Value> {
    let mut listed = Listed { hidden: panel.legend == LegendPlace::Hidden, names: BTreeSet::new() };
    let (areas, others): (Vec<_>, Vec<_>) =
        panel.items.iter().enumerate().partition(|(_, item)| matches!(item, Item::Region(_)));
    let mut traces = Vec::new();
    for (number, item) in areas.into_iter().chain(others) {
        match item {
            Item::Curve(curve) => traces.push(of_curve(curve, panel, frame, &mut listed)),
            Item::Points(points) => {
                let mut trace = of_points(points, panel, frame, &mut listed);
                add_names(&mut trace, points, named.iter().filter(|named| named.item == number));
                traces.push(trace);
            }
            Item::Region(region) => traces.push(of_region(region, frame, &mut listed)),
            Item::Reference(_) | Item::Label(_) => {}
        }
    }
    traces
}

/// Which names already stand in the legend.
struct Listed<'a> {
    hidden: bool,
    names: BTreeSet<&'a str>,
}

impl<'a> Listed<'a> {
    /// Whether an item is the one of its name that stands in the legend.
    fn takes(&mut self, name: &'a str, wanted: bool) -> bool {
        wanted && !self.hidden && !name.trim().is_empty() && self.names.insert(name)
    }
}

fn of_curve<'a>(curve: &'a Curve, panel: &Panel, frame: &Frame, listed: &mut Listed<'a>) -> Value {
    let (x, y) = columns(&curve.x, &curve.y, frame, true);
    let stroke = style::stroke(curve.colour.rgb(), curve.width, curve.line);
    // A line through a single point would not be seen.
    let dot = x.iter().flatten().count() == 1;
    let mut trace = common(&curve.name, frame, listed.takes(&curve.name, curve.in_legend));
    trace["mode"] = json!(if dot { "markers" } else { "lines" });
    if dot {
        trace["marker"] = json!({ "color": hex(stroke.colour), "size": 4 });
    }
    trace["x"] = json!(x);
    trace["y"] = json!(y);
    trace["connectgaps"] = json!(false);
    trace["line"] = json!({
        "color": hex(stroke.colour),
        "width": rounded(stroke.width * PIXELS_PER_POINT),
        "dash": dash(curve.line, stroke.width),
        "simplify": false,
    });
    trace["hovertemplate"] = json!(hover(&curve.name, panel, ""));
    trace
}

fn of_points<'a>(
    points: &'a Points,
    panel: &Panel,
    frame: &Frame,
    listed: &mut Listed<'a>,
) -> Value {
    let (x, y) = columns(&points.x, &points.y, frame, false);
    let mut trace = common(&points.name, frame, listed.takes(&points.name, points.in_legend));
    trace["mode"] = json!("markers");
    trace["x"] = json!(x);
    trace["y"] = json!(y);
    trace["cliponaxis"] = json!(false);
    trace["marker"] = marker(points);
    let name = if points.labels.is_empty() { "" } else { "<br>%{text}" };
    trace["hovertemplate"] = json!(hover(&points.name, panel, name));
    trace
}

/// Sets the names of points on the sides that the composed figure found for them.
fn add_names<'a>(trace: &mut Value, points: &Points, named: impl Iterator<Item = &'a NamedPoint>) {
    if points.labels.iter().all(|label| label.trim().is_empty()) {
        return;
    }
    let mut sides = vec!["top right".to_owned(); points.x.len().min(points.y.len())];
    for name in named {
        if let Some(side) = sides.get_mut(name.point) {
            *side = side_of(name);
        }
    }
    trace["mode"] = json!("markers+text");
    trace["text"] = points.labels.iter().map(|label| typeset(label)).collect();
    trace["textposition"] = json!(sides);
}

fn side_of(name: &NamedPoint) -> String {
    // A name that was moved inwards from the frame must not be centred again: it would be cut.
    const ACROSS: f64 = 0.3;
    const UP: f64 = 0.7;
    type Sides = [&'static str; 3];
    let side = |offset: f64, beside: f64, [low, middle, high]: Sides| match offset {
        offset if offset < -beside => low,
        offset if offset > beside => high,
        _ => middle,
    };
    let up = side(name.down, UP, ["top", "middle", "bottom"]);
    match (up, side(name.right, ACROSS, ["left", "center", "right"])) {
        // Plotly would set the name on top of the point.
        ("middle", "center") => "top center".to_owned(),
        (up, across) => format!("{up} {across}"),
    }
}

fn of_region<'a>(region: &'a Region, frame: &Frame, listed: &mut Listed<'a>) -> Value {
    let (x, y) = columns(&region.x, &region.y, frame, false);
    let (red, green, blue) = region.colour.rgb();
    let opacity = if region.opacity.is_finite() { region.opacity.clamp(0.0, 1.0) } else { 0.2 };
    let mut trace = common(&region.name, frame, listed.takes(&region.name, region.in_legend));
    trace["mode"] = json!("lines");
    trace["x"] = json!(x);
    trace["y"] = json!(y);
    trace["line"] = json!({ "width": 0, "simplify": false });
    trace["fill"] = json!("toself");
    trace["fillcolor"] = json!(format!("rgba({red},{green},{blue},{opacity:.3})"));
    trace["hoverinfo"] = json!("skip");
    trace
}

fn common(name: &str, frame: &Frame, in_legend: bool) -> Value {
    let name = typeset(name);
    json!({
        "type": "scatter",
        "name": name,
        // Items of one name are one branch: they are shown and hidden together.
        "legendgroup": format!("{}:{name}", frame.index),
        "showlegend": in_legend,
        "xaxis": frame.x,
        "yaxis": frame.y,
    })
}

fn hover(name: &str, panel: &Panel, more: &str) -> String {
    let name = typeset(name);
    let head = if name.is_empty() { name } else { format!("<b>{name}</b><br>") };
    let (x, y) = (hover_line(&panel.x, "x"), hover_line(&panel.y, "y"));
    format!("{head}{x}<br>{y}{more}<extra></extra>")
}

fn dash(line: Line, width: f64) -> String {
    if line == Line::Solid {
        return "solid".to_owned();
    }
    let pixels = |length: &f64| format!("{:.1}px", length * width * PIXELS_PER_POINT);
    style::dashes(line).iter().map(pixels).collect::<Vec<_>>().join(",")
}

fn marker(points: &Points) -> Value {
    let symbol = match points.marker {
        Marker::Circle => "circle",
        Marker::Square => "square",
        Marker::Triangle => "triangle-up",
        Marker::TriangleDown => "triangle-down",
        Marker::Diamond => "diamond",
        Marker::Cross => "x-thin",
        Marker::Plus => "cross-thin",
        Marker::Star => "star",
    };
    let colour = hex(points.colour.rgb());
    let thin = matches!(points.marker, Marker::Cross | Marker::Plus);
    let (fill, edge, width) = match (thin, points.filled) {
        (true, _) => (colour.as_str(), colour.as_str(), 2.0),
        (false, true) => (colour.as_str(), "#ffffff", 1.0),
        (false, false) => ("#ffffff", colour.as_str(), 1.7),
    };
    let star = if points.marker == Marker::Star { 1.4 } else { 1.15 };
    let size = if points.size.is_finite() { points.size.clamp(1.0, 72.0) } else { 6.0 };
    json!({
        "symbol": symbol,
        "size": rounded(star * size * PIXELS_PER_POINT),
        "color": fill,
        "opacity": 1,
        "line": { "color": edge, "width": width },
    })
}

type Column = Vec<Option<f64>>;

/// Both columns of values with gaps where there is no place on the axes; long lines are thinned.
fn columns(x: &[f64], y: &[f64], frame: &Frame, thin: bool) -> (Column, Column) {
    let pairs: Vec<(f64, f64)> = x.iter().copied().zip(y.iter().copied()).collect();
    let shown = if thin && pairs.len() > MANY_POINTS { thinned(&pairs, frame) } else { pairs };
    let (x_digits, y_digits) = (digits(&frame.x_view), digits(&frame.y_view));
    let cell = |view: &View, value: f64, digits: usize| {
        let placed = value.is_finite() && view.share(value).is_finite();
        placed.then_some(value).and_then(|value| rounded_to(value, digits))
    };
    // A pair with one part missing is missing as a whole, so that lines break the same everywhere.
    let row = |(x, y): (f64, f64)| {
        let cells = (cell(&frame.x_view, x, x_digits), cell(&frame.y_view, y, y_digits));
        if cells.0.is_some() && cells.1.is_some() { cells } else { (None, None) }
    };
    shown.into_iter().map(row).unzip()
}

/// Digits that numbers need to lie apart on the axis: more on one that shows a small part far from
/// zero.
fn digits(view: &View) -> usize {
    let size = view.low.abs().max(view.high.abs());
    let lost = match view.scale {
        Scale::Linear => (size / (view.high - view.low)).log10().ceil().clamp(0.0, 9.0),
        Scale::Log => 0.0,
    };
    DIGITS + lost as usize
}

/// The pairs that matter on an enlarged page.
fn thinned(pairs: &[(f64, f64)], frame: &Frame) -> Vec<(f64, f64)> {
    let place = |&(x, y): &(f64, f64)| {
        Point::new(ENLARGED_PAGE * frame.x_view.share(x), ENLARGED_PAGE * frame.y_view.share(y))
    };
    let mut kept = Vec::new();
    for run in pairs.chunk_by(|a, b| place(a).is_finite() == place(b).is_finite()) {
        if !place(&run[0]).is_finite() {
            kept.push((f64::NAN, f64::NAN));
            continue;
        }
        let places: Vec<Point> = run.iter().map(place).collect();
        let line = simplify::within_budget(&places, TOLERANCE, BUDGET);
        // The line is a part of the places in their order, so one pass finds the pairs again.
        let mut rest = places.iter().zip(run);
        kept.extend(
            line.iter().filter_map(|corner| {
                rest.find(|(place, _)| *place == corner).map(|(_, pair)| *pair)
            }),
        );
    }
    kept
}
