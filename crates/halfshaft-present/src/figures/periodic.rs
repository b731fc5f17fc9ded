//! Response curves of harmonic balance and of the first harmonic: any number of branches with
//! special points of every kind, over the excitation speed or over a parameter.

use halfshaft_results::{Branch, ResonanceResult, SpecialKind, SpecialPoint, Table};

use super::axes::{column_axis, name, speed_axis};
use super::smooth::Samples;
use super::{marks, resonance};
use crate::account::periodic::periods_words;
use crate::figure::{Axis, Colour, Curve, Figure, Item, Line, Panel, Reference, escape};
use crate::reading::{Abscissa, Reading};
use crate::words::{number, unit};

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
    panel = panel.with_all(backbones(result, x, &column));
    for branch in &result.branches {
        panel = panel.with_all(drawn(branch, (x, &column)));
    }
    panel = panel.with_all(special(reading, &column));
    if reading.x.is_speed() {
        panel = panel.with_all(resonance::verified(result, None, x));
    }
    panel
}

/// The backbones, without that of the undamped line where it would be hidden under the other.
fn backbones(result: &ResonanceResult, x: &str, y: &str) -> Vec<Curve> {
    let drawn: Vec<(bool, Curve)> = result
        .backbones
        .iter()
        .filter_map(|table| Some((table.column("energy").is_some(), backbone(table, x, y)?)))
        .collect();
    let hidden =
        |curve: &Curve| drawn.iter().any(|(undamped, other)| !undamped && covers(other, curve));
    drawn.iter().filter(|(free, curve)| !(*free && hidden(curve))).map(|(_, c)| c.clone()).collect()
}

/// Whether a curve lies on another one, to a hundredth of how far they go.
fn covers(other: &Curve, curve: &Curve) -> bool {
    let size = |of: fn(&Curve) -> &Vec<f64>| {
        let most = [other, curve].into_iter().flat_map(of).copied().map(f64::abs);
        most.fold(f64::MIN_POSITIVE, f64::max)
    };
    let (wide, high) = (size(|c| &c.x), size(|c| &c.y));
    let top = other.y.iter().copied().fold(0.0, f64::max);
    let near = |x: f64, y: f64| {
        let places = other.x.iter().zip(&other.y);
        places.into_iter().any(|(a, b)| ((x - a) / wide).hypot((y - b) / high) <= 0.01)
    };
    let places = curve.x.iter().zip(&curve.y).filter(|(_, y)| **y <= top);
    let beyond = curve.y.iter().copied().fold(0.0, f64::max) > 1.02 * top;
    !beyond && places.into_iter().all(|(x, y)| near(*x, *y))
}

/// A backbone: of the free line without damping, or where the response lags by a quarter turn.
fn backbone(table: &Table, x: &str, y: &str) -> Option<Curve> {
    let known = |name: &str| table.column(name).is_some();
    let (label, line) = match (known("energy"), known("drive")) {
        (true, _) => ("backbone, undamped", Line::Dotted),
        (_, true) => ("backbone, phase resonance", Line::DashDot),
        _ => ("backbone", Line::DashDot),
    };
    let (x, y) = (table.values(x).to_vec(), table.values(y).to_vec());
    let samples = Samples { stable: vec![true; x.len()], x, y }.smoothed();
    let drawn = Curve::new(label, samples.x, samples.y, Colour::AUXILIARY);
    (!drawn.x.is_empty() && !drawn.y.is_empty()).then(|| drawn.with_line(line).with_width(1.0))
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
    let samples = closed(resonance::samples(branch, x, y), branch).smoothed();
    let (label, colour) = look(branch);
    Curve::by_stability(&label, &samples.x, &samples.y, &samples.stable, colour)
}

/// Samples that end where they began, where the branch closes on itself.
fn closed(mut samples: Samples, branch: &Branch) -> Samples {
    let first = samples.x.first().copied().zip(samples.y.first().copied());
    let last = samples.x.last().copied().zip(samples.y.last().copied());
    let whole = samples.x.len() == samples.y.len() && samples.x.len() == samples.stable.len();
    if let Some((x, y)) = first.filter(|first| branch.closed && whole && Some(*first) != last) {
        let stable = samples.stable.first().copied().unwrap_or(true);
        samples.x.push(x);
        samples.y.push(y);
        samples.stable.push(stable);
    }
    samples
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

/// Multipliers are shown up to this, so that the line at 1 can be read.
const SHOWN: f64 = 2.0;

/// The largest multiplier of all, where it is beyond what is shown.
fn beyond(reading: &Reading<'_>) -> Option<f64> {
    let branches = reading.result.branches.iter();
    let all = branches.flat_map(|branch| branch.values("largest_multiplier")).copied();
    all.filter(|value| value.is_finite()).reduce(f64::max).filter(|most| *most > SHOWN)
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
    let mut y = Axis::new("Largest multiplier", "");
    if beyond(reading).is_some() {
        y = y.with_range(0.0, SHOWN);
    }
    let mut panel = Panel::new(axis(&reading.x), y).with(limit);
    panel.height_share = 0.55;
    for branch in &reading.result.branches {
        // The largest of several moduli has corners, which stay.
        let Samples { x, y, stable } = closed(resonance::samples(branch, x, column), branch);
        let (label, colour) = look(branch);
        let curves = Curve::by_stability(&label, &x, &y, &stable, colour);
        panel = panel.with_all(curves.into_iter().map(Curve::unlisted));
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
        text += " The grey lines are backbones, on which the peaks lie as the excitation grows.";
    }
    if !result.verification.is_empty() && reading.x.is_speed() {
        text += " Circles and diamonds are periodic motions of the full equations, by integration.";
    }
    if result.branches.iter().any(|branch| !branch.values("largest_multiplier").is_empty()) {
        text += " Below: the factor by which a small disturbance changes over one period; under 1 it \
                 dies out.";
    }
    if let Some(most) = beyond(reading) {
        text += &format!(
            " It is shown up to {}; the largest one is {}.",
            number(SHOWN, 3),
            number(most, 3)
        );
    }
    text
}
