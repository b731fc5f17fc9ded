//! Axes: one vertical axis for each panel, one horizontal axis for each group of panels that share
//! it, and an overlaid axis for each second unit.

use serde_json::{Map, Value, json};

use super::text::{hex, html, rounded};
use crate::figure::axis::{Axis, Scale};
use crate::figure::compose::{style, views};
use crate::figure::panel::{Figure, Panel};
use crate::figure::ticks::{Reading, axis_text};
use crate::figure::typeset::Rich;
use crate::figure::view::View;

/// Height of the only panel in pixels.
const PANEL: f64 = 310.0;
/// Height of one of several panels.
const ONE_OF_PANELS: f64 = 215.0;
/// Between panels that share their horizontal axis.
const SHARED_GAP: f64 = 22.0;
/// Between other panels.
const GAP: f64 = 75.0;
/// A secondary axis above a panel.
const TOP_AXIS: f64 = 50.0;

/// The axes of all panels.
pub(super) struct Frames<'a> {
    pub panels: Vec<Frame>,
    figure: &'a Figure,
    seconds: Vec<Second>,
    height: f64,
}

/// The axes of one panel.
pub(super) struct Frame {
    /// Number of the panel, for names that must differ between panels.
    pub index: usize,
    pub x: String,
    pub y: String,
    pub x_view: View,
    pub y_view: View,
    domain: (f64, f64),
    /// Whether the horizontal axis is written below this panel.
    names_x: bool,
    /// Whether the group of the horizontal axis begins here.
    opens_group: bool,
}

/// An overlaid axis.
struct Second {
    /// Which of the two directions.
    letter: char,
    /// Its own name and that of the axis below it, such as `x2` and `x`.
    name: String,
    of: String,
    /// The axis of the other direction that it is anchored to.
    anchor: String,
    panel: usize,
}

impl<'a> Frames<'a> {
    pub(super) fn new(figure: &'a Figure) -> Self {
        let (domains, height) = domains(&figure.panels);
        let mut panels = Vec::new();
        let mut group = 0;
        for (index, ((x_view, y_view), domain)) in
            views(figure).into_iter().zip(domains).enumerate()
        {
            let opens_group = !shares_with_previous(&figure.panels, index);
            group += usize::from(opens_group);
            panels.push(Frame {
                index,
                x: axis_name('x', group),
                y: axis_name('y', index + 1),
                x_view,
                y_view,
                domain,
                names_x: !shares_with_previous(&figure.panels, index + 1),
                opens_group,
            });
        }
        let seconds = seconds(figure, &panels, group);
        Self { panels, figure, seconds, height }
    }

    /// Height of all panels together in pixels.
    pub(super) fn panels_height(&self) -> f64 {
        self.height.max(PANEL).round()
    }

    /// Room in pixels that the first panel needs for a secondary axis above it.
    pub(super) fn above_first(&self) -> f64 {
        let first = self.figure.panels.first();
        let second = first.and_then(|panel| panel.x.usable_secondary());
        if second.is_some() { TOP_AXIS } else { 0.0 }
    }

    /// All axes by the names under which a layout holds them.
    pub(super) fn axes(&self) -> Map<String, Value> {
        let mut axes = Map::new();
        for (panel, frame) in self.figure.panels.iter().zip(&self.panels) {
            axes.insert(layout_name(&frame.y), frame.vertical(&panel.y));
            if frame.names_x {
                axes.insert(layout_name(&frame.x), frame.horizontal(&panel.x));
            }
        }
        for second in &self.seconds {
            axes.insert(layout_name(&second.name), self.overlaid(second));
        }
        if axes.is_empty() {
            axes.insert("xaxis".to_owned(), json!({ "visible": false }));
            axes.insert("yaxis".to_owned(), json!({ "visible": false }));
        }
        axes
    }

    /// Traces without points: plotly shows an axis only if a trace uses it.
    pub(super) fn carriers(&self) -> impl Iterator<Item = Value> + '_ {
        self.seconds.iter().map(|second| {
            let (x, y) = match second.letter {
                'x' => (&second.name, &second.anchor),
                _ => (&second.anchor, &second.name),
            };
            json!({
                "type": "scatter", "mode": "lines", "x": [null], "y": [null],
                "xaxis": x, "yaxis": y, "hoverinfo": "skip", "showlegend": false,
            })
        })
    }

    /// For each overlaid axis: whose values it repeats, and in which ratio.
    pub(super) fn links(&self) -> Vec<Value> {
        let link = |second: &Second| {
            let (axis, view) = self.source(second);
            let reading = axis.usable_secondary()?;
            Some(json!({
                "axis": layout_name(&second.name),
                "of": layout_name(&second.of),
                "factor": reading.factor,
                "offset": reading.offset,
                "log": view.scale == Scale::Log,
            }))
        };
        self.seconds.iter().filter_map(link).collect()
    }

    fn source(&self, second: &Second) -> (&Axis, &View) {
        let (panel, frame) = (&self.figure.panels[second.panel], &self.panels[second.panel]);
        match second.letter {
            'x' => (&panel.x, &frame.x_view),
            _ => (&panel.y, &frame.y_view),
        }
    }

    fn overlaid(&self, second: &Second) -> Value {
        let (axis, view) = self.source(second);
        let Some(reading) = axis.usable_secondary() else { return Value::Null };
        // In this order, so that a negative factor turns the axis round.
        let ends = (reading.value(view.low), reading.value(view.high));
        let mut value = base(&reading.label, &reading.unit, view.scale, ends);
        value["overlaying"] = json!(second.of);
        value["anchor"] = json!(second.anchor);
        value["side"] = json!(if second.letter == 'x' { "top" } else { "right" });
        value["showgrid"] = json!(false);
        // Left alone, plotly would put the marks where those of the axis below are.
        value["tickmode"] = json!("auto");
        value
    }
}

impl Frame {
    /// A trace without points on the axes of the panel.
    pub(super) fn carrier(&self) -> Value {
        json!({
            "type": "scatter", "mode": "lines", "x": [null], "y": [null],
            "xaxis": self.x, "yaxis": self.y, "hoverinfo": "skip", "showlegend": false,
        })
    }

    fn vertical(&self, axis: &Axis) -> Value {
        let mut value =
            base(&axis.label, &axis.unit, axis.scale, (self.y_view.low, self.y_view.high));
        value["anchor"] = json!(self.x);
        value["domain"] = json!([self.domain.0, self.domain.1]);
        let whole = self.domain.1 - self.domain.0 > 0.99;
        let title = value["title"]["text"].as_str().map(str::to_owned);
        if let Some(title) = title.filter(|_| !whole) {
            value["title"]["text"] = json!(two_lines(&title));
        }
        add_names(&mut value, axis);
        value
    }

    fn horizontal(&self, axis: &Axis) -> Value {
        let mut value =
            base(&axis.label, &axis.unit, axis.scale, (self.x_view.low, self.x_view.high));
        value["anchor"] = json!(self.y);
        add_names(&mut value, axis);
        value
    }
}

/// Names in place of numbers, where the axis has them.
fn add_names(value: &mut Value, axis: &Axis) {
    let placed: Vec<(f64, String)> = axis
        .names
        .iter()
        .filter_map(|(place, name)| Some((rounded(*place)?, html(&Rich::parse(name)))))
        .collect();
    if placed.is_empty() {
        return;
    }
    let (places, names): (Vec<f64>, Vec<String>) = placed.into_iter().unzip();
    value["tickmode"] = json!("array");
    value["tickvals"] = json!(places);
    value["ticktext"] = json!(names);
    value["minor"] = json!({ "ticks": "" });
}

/// A title in two lines, broken at the space nearest its middle, where it is too long to stand beside
/// a low panel.
fn two_lines(title: &str) -> String {
    const LONGEST: usize = 14;
    let length = title.chars().count();
    // What is within a tag must stay in one piece.
    if length <= LONGEST || title.contains('<') {
        return title.to_owned();
    }
    let middle = title.len() / 2;
    let space = title.match_indices(' ').map(|(at, _)| at).min_by_key(|at| at.abs_diff(middle));
    space.map_or_else(|| title.to_owned(), |at| format!("{}<br>{}", &title[..at], &title[at + 1..]))
}

fn base(label: &str, unit: &str, scale: Scale, (low, high): (f64, f64)) -> Value {
    let title = html(&axis_text(label, unit, &Reading::default()));
    let (kind, low, high) = match scale {
        Scale::Linear => ("linear", low, high),
        Scale::Log => ("log", low.log10(), high.log10()),
    };
    let line = hex(style::FRAME);
    // Powers of ten only where a plain number would be long.
    let size = low.abs().max(high.abs());
    let plain = scale == Scale::Linear && (1e-3..1e6).contains(&size);
    json!({
        "type": kind,
        "range": [finite(low), finite(high)],
        "title": { "text": title, "standoff": 8 },
        "ticks": "outside",
        "ticklen": 5,
        "tickcolor": line,
        "minor": { "ticks": "outside", "ticklen": 3, "tickcolor": line },
        "gridcolor": hex(style::GRID),
        "zeroline": false,
        "exponentformat": if plain { "none" } else { "power" },
        "automargin": true,
    })
}

/// The secondary value at a far end of an axis may be too large for a number.
fn finite(value: f64) -> f64 {
    value.clamp(-1e300, 1e300)
}

fn shares_with_previous(panels: &[Panel], index: usize) -> bool {
    index > 0 && panels.get(index).is_some_and(|panel| panel.x == panels[index - 1].x)
}

/// `x`, `x2`, `x3`, ...: the first has no number.
fn axis_name(letter: char, number: usize) -> String {
    if number <= 1 { letter.to_string() } else { format!("{letter}{number}") }
}

/// `xaxis2` for `x2`.
fn layout_name(name: &str) -> String {
    let (letter, number) = name.split_at(1);
    format!("{letter}axis{number}")
}

fn seconds(figure: &Figure, frames: &[Frame], groups: usize) -> Vec<Second> {
    let mut seconds = Vec::new();
    let (mut next_x, mut next_y) = (groups + 1, frames.len() + 1);
    for (panel, frame) in figure.panels.iter().zip(frames) {
        if panel.x.usable_secondary().is_some() && frame.opens_group {
            let name = axis_name('x', next_x);
            let (of, anchor) = (frame.x.clone(), frame.y.clone());
            seconds.push(Second { letter: 'x', name, of, anchor, panel: frame.index });
            next_x += 1;
        }
        if panel.y.usable_secondary().is_some() {
            let name = axis_name('y', next_y);
            let (of, anchor) = (frame.y.clone(), frame.x.clone());
            seconds.push(Second { letter: 'y', name, of, anchor, panel: frame.index });
            next_y += 1;
        }
    }
    seconds
}

/// The vertical share of each panel from below, and the height of all together in pixels.
fn domains(panels: &[Panel]) -> (Vec<(f64, f64)>, f64) {
    let first = if panels.len() > 1 { ONE_OF_PANELS } else { PANEL };
    let share = |panel: &Panel| {
        let share = panel.height_share;
        first * if share.is_finite() { share.clamp(0.05, 20.0) } else { 1.0 }
    };
    let gap = |index: usize| match () {
        () if index == 0 => 0.0,
        () if shares_with_previous(panels, index) => SHARED_GAP,
        () if panels[index].x.usable_secondary().is_some() => GAP + TOP_AXIS,
        () => GAP,
    };
    let mut down = 0.0;
    let mut spans = Vec::new();
    for (index, panel) in panels.iter().enumerate() {
        down += gap(index);
        spans.push((down, down + share(panel)));
        down += share(panel);
    }
    let total = f64::max(down, 1.0);
    let domains = spans.into_iter().map(|(from, to)| (1.0 - to / total, 1.0 - from / total));
    let clean = |share: f64| rounded(share).unwrap_or(0.0).clamp(0.0, 1.0);
    (domains.map(|(low, high)| (clean(low), clean(high))).collect(), down)
}

#[cfg(test)]
mod tests {
    use super::two_lines;

    /// Oracle: by hand.
    #[test]
    fn long_titles_take_two_lines() {
        assert_eq!(two_lines("Twist (rad)"), "Twist (rad)");
        assert_eq!(two_lines("Largest multiplier"), "Largest<br>multiplier");
        assert_eq!(
            two_lines("Main twist, first harmonic (rad)"),
            "Main twist, first<br>harmonic (rad)"
        );
        assert_eq!(two_lines("Overwhelmingly<sub>1</sub> long"), "Overwhelmingly<sub>1</sub> long");
    }
}
