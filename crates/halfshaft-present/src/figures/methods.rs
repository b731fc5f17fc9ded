//! All methods of a shock in one figure, and how far each is from what it approximates.

use halfshaft_results::{HistoryResult, MethodRow, Table};

use super::axes::{curve, name, time_axis};
use crate::figure::{Axis, Colour, Curve, Figure, LegendPlace, Line, Panel};

/// The figure; none where no comparison was asked for.
pub(super) fn figure(result: &HistoryResult) -> Option<Figure> {
    let shock = result.shock.as_ref()?;
    let history = shock.comparison_history.as_ref()?;
    if shock.comparison.len() < 2 {
        return None;
    }
    let looks = looks(&shock.comparison);
    let time = history.values("time");
    let mut upper = Panel::new(time_axis(), Axis::new("Twist beyond rest", "rad"))
        .with_legend(LegendPlace::Below);
    // The thick full line comes first, so that the others stay visible on top of it.
    for (row, look) in shock.comparison.iter().zip(&looks) {
        let curve = curve(name(&row.method), time, history.values(&row.method), look.colour);
        upper = upper.with(look.dressed(curve));
    }
    let title = "The shock by every method";
    let mut figure = Figure::new("methods", title).with_caption(
        "One disturbance, answered by every method. Colour tells the equation, dashes the order of \
         the closed form; the thick black line is the integrated full line.",
    );
    let lower = differences(history, &shock.comparison, &looks);
    figure = figure.with(upper);
    if !lower.items.is_empty() {
        figure.caption +=
            " Below: the error of each closed form, against the integration of its own equation.";
        figure = figure.with(lower);
    }
    Some(figure)
}

/// How a method is drawn.
struct Look {
    colour: Colour,
    line: Line,
    width: f64,
}

impl Look {
    fn dressed(&self, curve: Curve) -> Curve {
        curve.with_line(self.line).with_width(self.width)
    }
}

/// Colours of equations; the first lies on the black line and must be seen there.
const FAMILIES: [Colour; 5] =
    [Colour::Sky, Colour::Vermillion, Colour::Green, Colour::Purple, Colour::Orange];

/// A colour for each equation, dashes for each order.
fn looks(rows: &[MethodRow]) -> Vec<Look> {
    let mut equations: Vec<&str> = Vec::new();
    let mut looks = Vec::new();
    for row in rows {
        if row.reference.is_none() {
            looks.push(Look { colour: Colour::Black, line: Line::Solid, width: 3.2 });
            continue;
        }
        let family = family(row);
        let index = equations.iter().position(|known| *known == family).unwrap_or_else(|| {
            equations.push(family);
            equations.len() - 1
        });
        let line = match order(row) {
            Some("1") => Line::Dotted,
            Some(_) => Line::Dashed,
            None => Line::Solid,
        };
        looks.push(Look { colour: FAMILIES[index % FAMILIES.len()], line, width: 1.4 });
    }
    looks
}

/// "twist" of "multiple scales 2, twist"; the method itself where it is no closed form.
fn family(row: &MethodRow) -> &str {
    row.method.split_once(',').map_or(row.method.as_str(), |(_, family)| family.trim())
}

fn order(row: &MethodRow) -> Option<&str> {
    let order = row.method.strip_prefix("multiple scales")?.trim_start();
    Some(order.split(',').next().unwrap_or(order).trim())
}

/// Every closed form less its reference.
fn differences(history: &Table, rows: &[MethodRow], looks: &[Look]) -> Panel {
    let mut panel =
        Panel::new(time_axis(), Axis::new("Error", "rad")).with_legend(LegendPlace::Hidden);
    let time = history.values("time");
    for (row, look) in rows.iter().zip(looks) {
        let Some(reference) = row.reference.as_ref().filter(|_| order(row).is_some()) else {
            continue;
        };
        let pairs = history.values(&row.method).iter().zip(history.values(reference));
        let difference: Vec<f64> = pairs.map(|(value, reference)| value - reference).collect();
        let line = curve(name(&row.method), time, &difference, look.colour);
        panel = panel.with(look.dressed(line));
    }
    panel
}
