//! Response curves of harmonic balance and of the first harmonic: any number of branches with
//! special points of every kind, over the excitation speed or over a parameter.

use halfshaft_results::{Branch, ResonanceResult, SpecialKind, SpecialPoint};

use super::axes::{column_axis, curve, name, speed_axis};
use super::{marks, resonance};
use crate::account::periodic::periods_words;
use crate::figure::{Axis, Colour, Curve, Figure, Item, Line, Panel, Reference, escape};
use crate::reading::{Abscissa, Reading};
use crate::words::unit;

/// The figures, each with its id.
pub(super) fn figures(result: &ResonanceResult) -> Vec<Figure> {
    if result.branches.is_empty() {
        return Vec::new();
    }
    let reading = Reading::of(result);
    let mut figures = vec![response(&reading)];
    figures.extend(super::multipliers::figure(&reading));
    figures
}

/// The response with its special points, and below it how far it is from losing its stability.
fn response(reading: &Reading<'_>) -> Figure {
    let shaft =
        reading.shaft().map_or_else(String::new, |shaft| format!(" of the {}", name(&shaft)));
    let figure = Figure::new("response", format!("Resonance{shaft}"))
        .with_caption(caption(reading))
        .with(panel(reading));
    match margin(reading) {
        Some(panel) => figure.with(panel),
        None => figure,
    }
}

/// The panel of the response.
pub(super) fn panel(reading: &Reading<'_>) -> Panel {
    let result = reading.result;
    let column = reading.column();
    let x = reading.x.column.as_str();
    let mut panel = Panel::new(axis(&reading.x), column_axis(&column, "rad"));
    for table in &result.backbones {
        let (xs, ys) = (table.values(x), table.values(&column));
        if !xs.is_empty() && !ys.is_empty() {
            let line = curve("backbone".to_owned(), xs, ys, Colour::AUXILIARY);
            panel = panel.with(line.with_line(Line::DashDot).with_width(1.0));
        }
    }
    for branch in &result.branches {
        panel = panel.with_all(drawn(branch, (x, &column)));
    }
    panel = panel.with_all(special(reading, &column));
    if reading.x.is_speed() {
        panel = panel.with_all(resonance::verified(result, None, x));
    }
    panel
}

/// The horizontal axis.
pub(super) fn axis(x: &Abscissa) -> Axis {
    if x.is_speed() { speed_axis() } else { column_axis(&x.column, &x.unit) }
}

/// The name and the colour of a branch: what a slow sweep shows, what it does not, and what repeats
/// after more than one period.
fn look(branch: &Branch) -> (String, Colour) {
    match (branch.periods, branch.is_detached()) {
        (0 | 1, false) => ("response".to_owned(), Colour::PRIMARY),
        (0 | 1, true) => ("detached response".to_owned(), Colour::Orange),
        (periods, detached) => {
            let apart = if detached { "detached, " } else { "" };
            (format!("{apart}of {}", periods_words(periods)), Colour::Purple)
        }
    }
}

fn drawn(branch: &Branch, (x, y): (&str, &str)) -> Vec<Curve> {
    let (label, colour) = look(branch);
    let mut curves = resonance::branch_curves(branch, x, y, &label, colour);
    if branch.closed {
        close(&mut curves, branch, (x, y));
    }
    curves
}

/// Joins the ends of a branch that closes on itself.
fn close(curves: &mut Vec<Curve>, branch: &Branch, (x, y): (&str, &str)) {
    let (xs, ys, stable) = (branch.values(x), branch.values(y), branch.values("stable"));
    let count = xs.len().min(ys.len());
    if count < 3 || (xs[0], ys[0]) == (xs[count - 1], ys[count - 1]) {
        return;
    }
    let (label, colour) = look(branch);
    let solid = [0, count - 1].iter().all(|row| stable.get(*row).is_none_or(|value| *value != 0.0));
    let line = if solid { Line::Solid } else { Line::Dashed };
    let joint = Curve::new(label, vec![xs[count - 1], xs[0]], vec![ys[count - 1], ys[0]], colour);
    curves.push(joint.with_line(line).unlisted());
}

/// Special points of all branches.
fn special(reading: &Reading<'_>, column: &str) -> Vec<Item> {
    let points: Vec<&SpecialPoint> =
        reading.result.branches.iter().flat_map(|branch| &branch.special_points).collect();
    let symbol = escape(unit(&reading.x.unit));
    let beside = |kind, (x, _): (f64, f64)| marks::beside(kind, x, &symbol);
    let marks = marks::marked(&points, (&reading.x.column, column), beside);
    marks.into_iter().map(Item::from).collect()
}

/// The largest multiplier over the same axis, against 1, where stability is lost.
fn margin(reading: &Reading<'_>) -> Option<Panel> {
    let column = "largest_multiplier";
    let known = reading.result.branches.iter().any(|branch| !branch.values(column).is_empty());
    if !known {
        return None;
    }
    let x = reading.x.column.as_str();
    let limit = Reference::horizontal(1.0, "stability is lost", Colour::DANGER);
    let mut panel = Panel::new(axis(&reading.x), Axis::new("Largest multiplier", "")).with(limit);
    panel.height_share = 0.55;
    for branch in &reading.result.branches {
        let curves = drawn(branch, (x, column)).into_iter().map(Curve::unlisted);
        panel = panel.with_all(curves);
    }
    Some(panel)
}

fn caption(reading: &Reading<'_>) -> String {
    let result = reading.result;
    let over = if reading.x.is_speed() {
        "the excitation speed".to_owned()
    } else {
        escape(&reading.x.name())
    };
    let mut text = format!(
        "Swing of the twist about its mean (first harmonic) over {over}. Solid is stable, dashed is not."
    );
    let has = |kind: SpecialKind| {
        result.branches.iter().flat_map(|b| &b.special_points).any(|point| point.kind == kind)
    };
    if has(SpecialKind::Fold) {
        text += " At the folds a slow sweep jumps.";
    }
    if result.branches.iter().any(Branch::is_detached) {
        text += " No sweep reaches the detached response.";
    }
    if !result.backbones.is_empty() {
        text += " Dash-dot is the backbone, on which the peaks lie.";
    }
    if !result.verification.is_empty() && reading.x.is_speed() {
        text += " Circles and diamonds are periodic motions of the full equations, by integration.";
    }
    if result.branches.iter().any(|branch| !branch.values("largest_multiplier").is_empty()) {
        text += " Below: the factor by which a small disturbance changes over one period; under 1 it \
                 dies out.";
    }
    text
}
