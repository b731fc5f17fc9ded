//! Fold curves in the plane of excitation speed and one parameter.

use halfshaft_results::{FoldsResult, ReportResult, SpecialKind, SpecialPoint, Table};

use super::axes::{column_axis, speed_axis};
use super::regions::{Tints, tints};
use super::{marks, slug};
use crate::figure::{Colour, Curve, Figure, Label, Line, Panel, Points, Reference, Region, escape};
use crate::reading::Method;
use crate::words::{number, quantity, unit};

/// The id of the figure of a plane.
pub(crate) fn id(result: &FoldsResult) -> String {
    format!("folds-{}", slug(&result.parameter))
}

/// The planes of a report by the best method, each with the closed form beside it where another
/// method leads.
pub(crate) fn pairs(report: &ReportResult) -> Vec<(&FoldsResult, Option<&FoldsResult>)> {
    let twin = |plane: &FoldsResult| {
        report.closed_folds.iter().find(|other| other.parameter == plane.parameter)
    };
    let led = |plane: &FoldsResult| report.folds.iter().any(|p| p.parameter == plane.parameter);
    let main = report.folds.iter().map(|plane| (plane, twin(plane)));
    let alone = report.closed_folds.iter().filter(|plane| !led(plane)).map(|plane| (plane, None));
    main.chain(alone).collect()
}

/// The figure of a plane, with the closed form beside it where it is given.
pub(super) fn compared(result: &FoldsResult, closed: Option<&FoldsResult>) -> Figure {
    let curves: Vec<(Vec<f64>, Vec<f64>)> =
        result.curves.iter().map(|table| points(table, &result.parameter)).collect();
    let mut y = column_axis(&result.parameter, &result.parameter_unit);
    y.range = range(result, &curves);
    let mut x = speed_axis();
    x.range = speeds(result);
    let mut panel = Panel::new(x, y);
    panel = match &result.responses {
        Some(responses) => {
            let Tints { regions, labels } = tints(responses, &curves);
            panel.with_all(regions).with_all(labels)
        }
        None => {
            let region = |(x, y)| Region::new(several(result), x, y, Colour::Sky);
            panel.with_all(areas(&curves).into_iter().map(region))
        }
    };
    let method = |plane: &FoldsResult| Method::of(&plane.header).map_or("", Method::words);
    let name = closed.map_or("fold".to_owned(), |_| format!("fold, {}", method(result)));
    for (x, y) in curves {
        panel = panel.with(Curve::new(name.clone(), x, y, Colour::PRIMARY));
    }
    for table in closed.iter().flat_map(|plane| &plane.curves) {
        let (x, y) = points(table, &result.parameter);
        let name = format!("fold, {}", closed.map_or("", method));
        let line = Curve::new(name, x, y, Colour::Orange).with_line(Line::DashDot);
        panel = panel.with(line.with_width(1.1));
    }
    panel = panel.with_all(special(result)).with_all(own_value(result));
    if result.curves.is_empty() && closed.is_none_or(|plane| plane.curves.is_empty()) {
        panel = with_remark(panel, result);
    }
    let title = format!(
        "Fold curves over excitation speed and {}",
        escape(&crate::words::column_label(&result.parameter))
    );
    let mut text = caption(result);
    if closed.is_some() {
        text += " Dash-dot is the closed form of one mode.";
    }
    Figure::new(id(result), title).with_caption(text).with(panel)
}

/// The speeds at which responses were counted: the plane that was searched.
fn speeds(result: &FoldsResult) -> Option<(f64, f64)> {
    let speeds = &result.responses.as_ref()?.frequency;
    Some((*speeds.first()?, *speeds.last()?))
}

/// An empty plane about the resonance, saying that it is empty.
fn with_remark(mut panel: Panel, result: &FoldsResult) -> Panel {
    let resonance = result.scaling.as_ref().map(|scaling| scaling.omega_1 / scaling.order);
    let middle = resonance.filter(|speed| speed.is_finite() && *speed > 0.0).unwrap_or(1.0);
    let (from, to) = panel.x.range.unwrap_or((0.8 * middle, 1.2 * middle));
    let middle = f64::midpoint(from, to);
    panel.x = panel.x.with_range(from, to);
    let (low, high) = panel.y.range.unwrap_or((0.0, 1.0));
    let height = low + 0.5 * (high - low);
    panel.with(Label::new(middle, height, "no response folds in this range"))
}

fn several(result: &FoldsResult) -> &'static str {
    let higher = |key: &str| {
        result.scaling.as_ref().is_some_and(|scaling| {
            scaling.coefficients.get(key).is_some_and(|coefficient| *coefficient != 0.0)
        })
    };
    if higher("x5") || higher("x7") { "three or more responses" } else { "three responses" }
}

fn caption(result: &FoldsResult) -> String {
    let mut text = match &result.responses {
        Some(_) => {
            "The tint and the number tell how many responses exist side by side; where it is one, \
             nothing can jump."
        }
        None => {
            "In the shaded wedge three responses exist; a slow sweep through it jumps at its edges."
        }
    }
    .to_owned();
    let has = |kind| result.special_points.iter().any(|point| point.kind == kind);
    if has(SpecialKind::Cusp) || result.responses.is_none() {
        text += " Stars are cusps, where the jump begins.";
    }
    if has(SpecialKind::IsolaBirth) || has(SpecialKind::IsolaMerger) {
        text += " Triangles are where a detached response is born or joins another.";
    }
    if result.parameter_value.is_some() {
        text += " The dashed line is the model's own value.";
    }
    if result.curves.is_empty() {
        "No response folds in this range.".clone_into(&mut text);
    }
    text
}

/// The points of a curve.
fn points(table: &Table, parameter: &str) -> (Vec<f64>, Vec<f64>) {
    let rows = table.values("frequency").iter().zip(table.values(parameter));
    rows.map(|(x, y)| (*x, *y)).filter(|(x, y)| x.is_finite() && y.is_finite()).unzip()
}

/// What lies between folds: within a curve that turns at a cusp, or between two that do not.
pub(super) fn areas(curves: &[(Vec<f64>, Vec<f64>)]) -> Vec<(Vec<f64>, Vec<f64>)> {
    let mut areas = Vec::new();
    let mut open: Vec<&(Vec<f64>, Vec<f64>)> = Vec::new();
    for curve in curves.iter().filter(|curve| curve.1.len() > 2) {
        if turns(&curve.1) { areas.push(closed(curve)) } else { open.push(curve) }
    }
    if let [first, second] = open.as_slice() {
        areas.push(between(first, second));
    }
    areas
}

/// The area between two curves that run the same way over the parameter. Where one of them has left
/// the speeds shown before the other ends, the border of the plane closes it, not a chord.
fn between((x, y): &(Vec<f64>, Vec<f64>), (x2, y2): &(Vec<f64>, Vec<f64>)) -> (Vec<f64>, Vec<f64>) {
    let all = || y.iter().chain(y2).copied();
    let (low, high) = crate::reading::bounds(all()).unwrap_or((0.0, 1.0));
    let middle = f64::midpoint(low, high);
    let corner = |p: (f64, f64), q: (f64, f64)| {
        let (short, long) =
            if (p.1 - middle).abs() < (q.1 - middle).abs() { (p, q) } else { (q, p) };
        ((short.1 - long.1).abs() > 1e-3 * (high - low)).then_some((short.0, long.1))
    };
    let mut line: Vec<(f64, f64)> = x.iter().copied().zip(y.iter().copied()).collect();
    let back: Vec<(f64, f64)> = x2.iter().copied().zip(y2.iter().copied()).rev().collect();
    line.extend(line.last().zip(back.first()).and_then(|(p, q)| corner(*p, *q)));
    let start = line.first().copied();
    line.extend(&back);
    line.extend(back.last().zip(start.as_ref()).and_then(|(p, q)| corner(*p, *q)));
    line.into_iter().unzip()
}

/// A curve through its cusp as an area. Where one branch has left the speeds shown before the
/// parameter ends, the border of the plane closes it, not a chord.
fn closed((x, y): &(Vec<f64>, Vec<f64>)) -> (Vec<f64>, Vec<f64>) {
    let (mut x, mut y) = (x.clone(), y.clone());
    let (Some(first), Some(last)) = (x.first().zip(y.first()), x.last().zip(y.last())) else {
        return (x, y);
    };
    let ((x0, y0), (x1, y1)) = ((*first.0, *first.1), (*last.0, *last.1));
    let middle = f64::midpoint(y0, y1);
    let farthest = |a: f64, b: &f64| if (b - middle).abs() > (a - middle).abs() { *b } else { a };
    let cusp = y.iter().fold(middle, farthest);
    // The branch that ends nearer to the cusp is the one that was cut short.
    let corner = if (y0 - cusp).abs() < (y1 - cusp).abs() { (x0, y1) } else { (x1, y0) };
    x.push(corner.0);
    y.push(corner.1);
    (x, y)
}

/// Whether the parameter goes to a turning point and back along a curve.
fn turns(values: &[f64]) -> bool {
    let (Some(first), Some(last)) = (values.first(), values.last()) else { return false };
    let extremes = values
        .iter()
        .copied()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
    let span = extremes.1 - extremes.0;
    let far = |extreme: f64| (extreme - first).abs().min((extreme - last).abs()) > 0.3 * span;
    far(extremes.0) || far(extremes.1)
}

/// Cusps, births and mergers with the value of the parameter at which they lie.
fn special(result: &FoldsResult) -> Vec<Points> {
    let symbol = escape(unit(&result.parameter_unit));
    let beside = |kind: SpecialKind, (_, y): (f64, f64)| {
        format!("{} {}", marks::short(kind), quantity(y, 5, &symbol))
    };
    let points: Vec<&SpecialPoint> = result.special_points.iter().collect();
    marks::marked(&points, ("frequency", &result.parameter), beside)
}

fn own_value(result: &FoldsResult) -> Option<Reference> {
    let value = result.parameter_value.filter(|value| value.is_finite())?;
    let symbol = escape(unit(&result.parameter_unit));
    let label = format!("model: {} {symbol}", number(value, 5));
    Some(Reference { line: Line::Dashed, ..Reference::horizontal(value, label, Colour::Black) })
}

/// The asked range of the parameter, so that an empty plane still shows what was searched.
fn range(result: &FoldsResult, curves: &[(Vec<f64>, Vec<f64>)]) -> Option<(f64, f64)> {
    let asked = result.header.settings.get("parameter")?;
    let end = |key: &str| asked.get(key).and_then(serde_json::Value::as_f64);
    let (mut low, mut high) = (end("from")?, end("to")?);
    let seen = curves.iter().flat_map(|curve| curve.1.iter().copied());
    for value in seen.chain(result.parameter_value) {
        low = low.min(value);
        high = high.max(value);
    }
    let pad = 0.04 * (high - low);
    let held =
        |value: f64, padded: f64| if value * padded < 0.0 || value == 0.0 { 0.0 } else { padded };
    Some((held(low, low - pad), held(high, high + pad)))
}

#[cfg(test)]
mod tests {
    use super::areas;

    /// Oracle: by hand: one curve leaves the plane at speed 0 and parameter -1, the other goes on to
    /// -4: what lies left of it down there is closed along the border of speed 0.
    #[test]
    fn a_curve_that_left_the_plane_is_closed_along_its_border() {
        let long = (vec![2.0, 3.0, 4.0], vec![-4.0, 0.0, 4.0]);
        let short = (vec![0.0, 3.0, 9.0], vec![-1.0, 0.0, 4.0]);
        let found = areas(&[long, short]);
        let x = vec![2.0, 3.0, 4.0, 9.0, 3.0, 0.0, 0.0];
        let y = vec![-4.0, 0.0, 4.0, 4.0, 0.0, -1.0, -4.0];
        assert_eq!(found, vec![(x, y)]);
    }
}
