//! Response curves over the excitation speed.

use halfshaft_results::{Branch, ModeScaling, ResonanceResult, SpecialPoint};

use super::axes::{column_axis, curve, name, speed_axis};
use super::periodic;
use super::smooth::Samples;
use crate::account::resonance::fold_points;
use crate::figure::{Axis, Colour, Curve, Figure, Item, Line, Panel, Points};
use crate::words::{number, plain};

/// The id of the figure of the exciting order at `index`.
pub(crate) fn id(result: &ResonanceResult, index: usize) -> String {
    match result.scaling.get(index) {
        Some(scaling) if result.scaling.len() > 1 => {
            super::slug(&format!("response-order-{}", number(scaling.order, 6)))
        }
        _ => "response".to_owned(),
    }
}

/// The ids of the figures of harmonic balance or of the first harmonic.
pub(crate) fn ids(result: &ResonanceResult) -> Vec<String> {
    periodic::figures(result).into_iter().map(|figure| figure.id).collect()
}

/// One figure for each exciting order of the closed form; those of other methods.
pub(super) fn figures(result: &ResonanceResult) -> Vec<Figure> {
    if result.scaling.is_empty() {
        return periodic::figures(result);
    }
    let orders = result.scaling.iter().enumerate();
    orders.map(|(index, scaling)| figure(result, index, Some(scaling))).collect()
}

fn figure(result: &ResonanceResult, index: usize, scaling: Option<&ModeScaling>) -> Figure {
    let branches: Vec<&Branch> =
        result.branches.iter().filter(|branch| belongs(branch, result, scaling)).collect();
    let (column, y) = vertical(&branches, scaling);
    let mut panel = Panel::new(speed_axis(), y);
    panel = panel.with_all(backbone(result, index, &column));
    for branch in &branches {
        panel = panel.with_all(branch_curves(
            branch,
            "frequency",
            &column,
            "response",
            Colour::PRIMARY,
        ));
    }
    let points: Vec<&SpecialPoint> =
        branches.iter().flat_map(|b| fold_points(std::slice::from_ref(*b))).collect();
    panel = panel.with_all(folds(&points, "frequency", &column));
    panel = panel.with_all(verified(result, scaling, "frequency"));
    let shaft =
        scaling.map_or_else(String::new, |scaling| format!(" of the {}", name(&scaling.shaft)));
    let order = scaling
        .filter(|_| result.scaling.len() > 1)
        .map_or_else(String::new, |scaling| format!(", order {}", number(scaling.order, 6)));
    Figure::new(id(result, index), format!("Resonance{shaft}{order}"))
        .with_caption(caption(result, !points.is_empty()))
        .with(panel)
}

fn caption(result: &ResonanceResult, folds: bool) -> String {
    let mut text =
        "Swing of the twist about its mean, over the excitation speed; dash-dot is the backbone, on \
         which the peaks lie."
            .to_owned();
    if folds {
        text += " Solid is stable, dashed is not; at the folds a slow sweep jumps.";
    }
    if !result.verification.is_empty() {
        text += " Circles are periodic motions of the full equations, by integration.";
    }
    text
}

/// Whether a branch is driven by that order: its detuning says so.
fn belongs(branch: &Branch, result: &ResonanceResult, scaling: Option<&ModeScaling>) -> bool {
    let Some(scaling) = scaling.filter(|_| result.scaling.len() > 1) else { return true };
    let rows = branch.values("frequency").iter().zip(branch.values("sigma"));
    let fits = |(frequency, sigma): (&f64, &f64)| {
        let own = scaling.order * frequency - scaling.omega_1;
        (own - sigma).abs() <= 1e-6 * scaling.omega_1.abs()
    };
    rows.take(1).all(fits)
}

/// The column on the vertical axis: the twist of the shaft that measures the mode.
fn vertical(branches: &[&Branch], scaling: Option<&ModeScaling>) -> (String, Axis) {
    let has = |column: &str| branches.iter().any(|branch| !branch.values(column).is_empty());
    let twist = scaling.map(|scaling| format!("{}.twist.harmonic1", scaling.shaft));
    match twist.filter(|column| has(column) || !has("rho")) {
        Some(column) => {
            let axis = column_axis(&column, "rad");
            (column, axis)
        }
        None => ("rho".to_owned(), column_axis("rho", "rad")),
    }
}

/// A branch split by its stability; smooth where it was continued by few samples.
pub(super) fn branch_curves(
    branch: &Branch,
    x: &str,
    y: &str,
    label: &str,
    colour: Colour,
) -> Vec<Curve> {
    let mut samples = samples(branch, x, y);
    // Others list all responses at many speeds.
    if !branch.values("truncation").is_empty() {
        samples = samples.smoothed();
    }
    Curve::by_stability(label, &samples.x, &samples.y, &samples.stable, colour)
}

/// The samples of a branch. Where nothing is known of stability it is drawn as it is.
pub(super) fn samples(branch: &Branch, x: &str, y: &str) -> Samples {
    let (x, y) = (branch.values(x).to_vec(), branch.values(y).to_vec());
    let stable: Vec<bool> = branch.values("stable").iter().map(|value| *value != 0.0).collect();
    let stable = if stable.is_empty() { vec![true; x.len()] } else { stable };
    Samples { x, y, stable }
}

fn backbone(result: &ResonanceResult, index: usize, column: &str) -> Option<Curve> {
    let table = result.backbones.get(index)?;
    let (x, y) = (table.values("frequency"), table.values(column));
    let line = curve("backbone".to_owned(), x, y, Colour::AUXILIARY);
    (!x.is_empty() && !y.is_empty()).then(|| line.with_line(Line::DashDot).with_width(1.0))
}

/// Folds as filled points with their speeds.
pub(super) fn folds(points: &[&SpecialPoint], x: &str, y: &str) -> Option<Points> {
    let places: Vec<(f64, f64)> =
        points.iter().filter_map(|point| Some((point.value(x)?, point.value(y)?))).collect();
    if places.is_empty() {
        return None;
    }
    let unit = if x == "frequency" || x == "sigma" { " rad/s" } else { "" };
    let labels = places.iter().map(|(x, _)| format!("fold {}{unit}", number(*x, 6))).collect();
    let (xs, ys) = places.into_iter().unzip();
    Some(Points::new("fold", xs, ys, Colour::DANGER).with_labels(labels))
}

/// Responses found by integration: open circles where they are stable, open diamonds where not.
pub(super) fn verified(
    result: &ResonanceResult,
    scaling: Option<&ModeScaling>,
    x: &str,
) -> Vec<Item> {
    let place = |point: &halfshaft_results::VerifiedPoint| match (x, scaling) {
        ("frequency", _) => Some(point.frequency),
        ("sigma", Some(scaling)) => Some(scaling.order * point.frequency - scaling.omega_1),
        _ => None,
    };
    let mut items = Vec::new();
    let looks = [
        (true, "integrated", crate::figure::Marker::Circle),
        (false, "integrated, not stable", crate::figure::Marker::Diamond),
    ];
    for (stable, label, marker) in looks {
        let points = result.verification.iter().filter(|point| point.integrated_stable == stable);
        let (xs, ys): (Vec<f64>, Vec<f64>) =
            points.filter_map(|point| Some((place(point)?, point.integrated))).unzip();
        if !xs.is_empty() {
            let points = Points::new(plain(label), xs, ys, Colour::Black);
            items.push(points.with_marker(marker).hollow().into());
        }
    }
    items
}
