//! Figures as data for plotly.js, for pages in which the reader can zoom and point.
//!
//! [`figure_json`] gives `{data, layout, config}`. A page needs [`BUNDLE`], [`DRAW`], and one call:
//!
//! ```html
//! <div id="place"></div>
//! <script>halfshaftDraw(document.getElementById("place"), FIGURE);</script>
//! ```
//!
//! where `FIGURE` is [`script_json`] of the value. Nothing is loaded from the network.
//!
//! What the plain `Plotly.newPlot` would not do is in [`DRAW`]: a secondary axis keeps its ratio to
//! the primary one whatever the reader drags (plotly can only keep equal ranges equal), and a long
//! heading takes more lines on a narrow screen.

use serde_json::{Map, Value, json};

use super::compose::{sides_of_names, style, wrapped};
use super::font::Weight;
use super::panel::Figure;
use super::svg::FONTS;
use super::typeset::Rich;
use axes::Frames;

mod axes;
mod notes;
mod text;
mod traces;

/// The plotly.js basic bundle, version 4.1.1 (MIT licence, in `assets/plotly`).
pub const BUNDLE: &str = include_str!("../../../assets/plotly/plotly-basic.min.js");

/// The function `halfshaftDraw(element, figure)`, which draws a figure into an element of the page.
pub const DRAW: &str = include_str!("draw.js");

/// Pages narrower than this, in pixels, get the narrow heading.
const NARROW: f64 = 620.0;
/// Font size of the heading in pixels.
const TITLE_SIZE: f64 = 16.0;
/// Font size of all other texts in pixels.
const TEXT_SIZE: f64 = 13.0;

/// The figure for plotly.js. No value in it is infinite or not a number; places without a value are
/// `null`, which plotly shows as gaps.
#[must_use]
pub fn figure_json(figure: &Figure) -> Value {
    let frames = Frames::new(figure);
    let mut data = Vec::new();
    let (mut shapes, mut annotations) = (Vec::new(), Vec::new());
    let named = sides_of_names(figure);
    for ((panel, frame), named) in figure.panels.iter().zip(&frames.panels).zip(&named) {
        let mut traces = traces::of_panel(panel, frame, &named.points);
        if traces.is_empty() {
            // Without a trace plotly does not lay out the axes that the texts stand on.
            traces.push(frame.carrier());
        }
        shapes.extend(notes::shapes(panel, frame));
        annotations.extend(notes::annotations(panel, frame, &named.references));
        if traces.iter().all(is_empty) && annotations.is_empty() {
            annotations.push(notes::empty(Some(frame)));
        }
        data.extend(traces);
    }
    if figure.panels.is_empty() {
        annotations.push(notes::empty(None));
    }
    let listed = data.iter().filter(|trace| trace["showlegend"] == true).count();
    data.extend(frames.carriers());
    let mut layout = layout(figure, &frames, listed);
    layout.insert("shapes".to_owned(), Value::Array(shapes));
    layout.insert("annotations".to_owned(), Value::Array(annotations));
    layout.extend(frames.axes());
    json!({ "data": data, "layout": layout, "config": config(figure) })
}

fn is_empty(trace: &Value) -> bool {
    trace["x"].as_array().is_none_or(|values| values.iter().all(Value::is_null))
}

/// JSON that may stand inside a `<script>` element: no text in it can end the element.
#[must_use]
pub fn script_json(value: &Value) -> String {
    // `<`, `>` and `&` occur only inside strings, where an escape means the same.
    let text = value.to_string();
    text.replace('<', "\\u003c").replace('>', "\\u003e").replace('&', "\\u0026")
}

/// What depends on the width of the page.
struct Sheet {
    heading: String,
    /// Above the heading, in pixels.
    pad: f64,
    /// Above the panels, in pixels.
    top: f64,
    /// Of the whole, in pixels.
    height: f64,
}

impl Sheet {
    /// The sheet for a heading and a number of legend columns that fit the page.
    fn new(figure: &Figure, frames: &Frames, heading_width: f64, legend_rows: usize) -> Self {
        let title = Rich::parse(&figure.title);
        let lines = wrapped(&title, TITLE_SIZE, Weight::Bold, heading_width, 6);
        let lines: Vec<String> = lines.iter().map(text::html).collect();
        let heading =
            if lines.is_empty() { String::new() } else { format!("<b>{}</b>", lines.join("<br>")) };
        let top = 22.0 + 21.0 * lines.len() as f64 + frames.above_first();
        // Plotly sets the first of several lines higher than a single line.
        let pad = if lines.len() > 1 { 24.0 } else { 10.0 };
        let bottom = 60.0 + 20.0 * legend_rows as f64;
        Self { heading, pad, top, height: top + frames.panels_height() + bottom }
    }
}

fn layout(figure: &Figure, frames: &Frames, listed: usize) -> Map<String, Value> {
    // Beside the heading there is room for the buttons of plotly.
    let wide = Sheet::new(figure, frames, 660.0, listed.div_ceil(5));
    let narrow = Sheet::new(figure, frames, 240.0, listed.div_ceil(2));
    let layout = json!({
        "title": {
            "text": wide.heading,
            "font": { "size": TITLE_SIZE },
            "x": 0,
            "xanchor": "left",
            "xref": "container",
            "y": 1,
            "yanchor": "top",
            "yref": "container",
            "pad": { "l": 10, "t": wide.pad },
        },
        "font": { "family": FONTS, "size": TEXT_SIZE, "color": text::hex(style::TEXT) },
        // A point, and a thin space between thousands.
        "separators": ".\u{2009}",
        "paper_bgcolor": "#ffffff",
        "plot_bgcolor": "#ffffff",
        "autosize": true,
        "height": wide.height,
        "margin": { "l": 60, "r": 24, "t": wide.top, "b": 50 },
        "hovermode": "closest",
        "dragmode": "zoom",
        "hoverlabel": { "bgcolor": "#ffffff", "font": { "family": FONTS } },
        "showlegend": listed > 0,
        "legend": legend(),
        "modebar": { "bgcolor": "rgba(255,255,255,0.7)", "color": "#999999" },
        "meta": meta(figure, frames, &narrow),
    });
    match layout {
        Value::Object(map) => map,
        _ => Map::new(),
    }
}

/// What the page needs to know besides: which axes belong together, and the sheet for a narrow page.
fn meta(figure: &Figure, frames: &Frames, narrow: &Sheet) -> Value {
    json!({
        "linked": frames.links(),
        "label": Rich::parse(&figure.title).text(),
        "narrow": {
            "below": NARROW,
            "title": narrow.heading,
            "pad": narrow.pad,
            "top": narrow.top,
            "height": narrow.height,
        },
    })
}

/// A legend along the lower edge.
fn legend() -> Value {
    json!({
        "orientation": "h",
        "x": 0.01,
        "xanchor": "left",
        "xref": "container",
        "y": 0.0,
        "yanchor": "bottom",
        "yref": "container",
        "tracegroupgap": 0,
    })
}

fn config(figure: &Figure) -> Value {
    json!({
        "responsive": true,
        "displaylogo": false,
        "doubleClick": "reset",
        "modeBarButtons": [["zoom2d", "pan2d", "resetScale2d", "toImage"]],
        "toImageButtonOptions": { "format": "svg", "filename": figure.id },
    })
}
