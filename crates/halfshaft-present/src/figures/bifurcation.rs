//! The bifurcation diagram: Poincaré points over what is swept, continued branches beneath, and below it
//! the largest Lyapunov exponent.

use halfshaft_results::{BifurcationResult, StrobedBranch};

use super::axes::{column_axis, level, name, speed_axis};
use super::marks;
use super::smooth::Samples;
use crate::figure::{Axis, Colour, Curve, Figure, Item, Marker, Panel, Points, Size};

/// The id of the figure.
pub(crate) const ID: &str = "bifurcation";
/// Points of one direction that are drawn at most: more of them would not be seen, but make the picture
/// heavy.
const MOST_POINTS: usize = 40_000;
/// Diameters of the points of few and of many, in points: discs up, rings around them down.
const FEW: (f64, f64) = (2.8, 5.0);
const MANY: (f64, f64) = (2.0, 2.6);
/// Special points that are marked at most: more of them would hide the motions.
const MOST_MARKED: usize = 16;
/// From so many points of a direction on they are many.
const CROWD: usize = 2000;

/// The sweeps with their names, colours and marks.
const SWEEPS: [(f64, &str, Colour); 2] =
    [(-1.0, "sweeping down", Colour::Orange), (1.0, "sweeping up", Colour::PRIMARY)];

/// The figure.
pub(crate) fn figure(result: &BifurcationResult) -> Figure {
    let caption = "Twist whenever a period of the excitation begins: one point a value where the motion \
                   repeats after every period, several where it does after several, a band where it does \
                   not. Lines are the responses that resonance continues, solid where stable. Below: the \
                   largest Lyapunov exponent; above zero the motion is chaotic.";
    Figure::new(ID, format!("Bifurcation diagram of the {}", name(&result.shaft)))
        .with_caption(caption)
        .with_size(Size::Points { width: 648.0, height: 490.0 })
        .with(diagram(result))
        .with(exponents(result))
}

fn abscissa(result: &BifurcationResult) -> Axis {
    if result.swept == "frequency" {
        return speed_axis();
    }
    column_axis(&result.swept, result.columns.first().map_or("", |column| &column.unit))
}

fn diagram(result: &BifurcationResult) -> Panel {
    let y = Axis::new(format!("Twist of the {} at phase 0", name(&result.shaft)), "rad");
    let mut panel = Panel::new(abscissa(result), y);
    for branch in &result.branches {
        panel = panel.with_all(drawn(result, branch));
    }
    let table = result.table();
    let [x, direction, twist] =
        [&result.swept, "direction", &result.twist()].map(|name| table.values(name).to_vec());
    for (own, label, colour) in SWEEPS {
        let rows = x.iter().zip(&twist).zip(&direction).filter(|(_, way)| **way == own);
        let all: Vec<(f64, f64)> = rows.map(|((x, y), _)| (*x, *y)).collect();
        let every = all.len().div_ceil(MOST_POINTS).max(1);
        let (xs, ys): (Vec<f64>, Vec<f64>) = all.into_iter().step_by(every).unzip();
        if xs.is_empty() {
            continue;
        }
        panel = panel.with(dots(own, label, colour, (xs, ys)));
    }
    let special =
        result.branches.iter().flat_map(|branch| &branch.special_points).collect::<Vec<_>>();
    if special.len() > MOST_MARKED {
        return panel;
    }
    let twist = result.twist();
    let marked = marks::marked(&special, (&result.swept, &twist), |_, _| String::new());
    let plain = |points: Points| Points { colour: Colour::Black, ..points.hollow() };
    panel.with_all(marked.into_iter().map(plain).map(Item::from))
}

/// Points of one direction: small discs up, rings around them down, so that both are seen.
fn dots(way: f64, label: &str, colour: Colour, (x, y): (Vec<f64>, Vec<f64>)) -> Points {
    let many = x.len() > CROWD;
    let (disc, ring) = if many { MANY } else { FEW };
    let points = Points::new(label, x, y, colour).with_marker(Marker::Circle);
    match (way > 0.0, many) {
        (true, _) => Points { size: disc, ..points },
        // Rings of so little width would only be heavy.
        (false, true) => Points { size: ring, ..points },
        (false, false) => Points { size: ring, ..points.hollow() },
    }
}

/// A branch at the beginning of every period until it repeats.
fn drawn(result: &BifurcationResult, branch: &StrobedBranch) -> Vec<Curve> {
    let x = branch.values(&result.swept);
    let stable: Vec<bool> = branch.values("stable").iter().map(|value| *value != 0.0).collect();
    let mut curves = Vec::new();
    for period in 1..=branch.periods.max(1) {
        let number = if period == 1 { String::new() } else { format!(".{period}") };
        let y = branch.values(&format!("{}{number}", result.twist()));
        if y.is_empty() {
            break;
        }
        let samples = Samples { x: x.to_vec(), y: y.to_vec(), stable: stable.clone() }.smoothed();
        let label = "response by continuation";
        let own =
            Curve::by_stability(label, &samples.x, &samples.y, &samples.stable, Colour::AUXILIARY);
        curves.extend(own.into_iter().map(|curve| curve.with_width(0.8)));
    }
    curves
}

fn exponents(result: &BifurcationResult) -> Panel {
    let y = Axis::new("Lyapunov exponent", "1/s");
    let mut panel = Panel::new(abscissa(result), y).with(level(0.0, ""));
    panel.height_share = 0.5;
    // The one beneath is wider, so that both are seen where they agree.
    let width = |way: f64| if way > 0.0 { 1.0 } else { 2.6 };
    let [x, direction, exponent] =
        [&result.swept, "direction", "lyapunov_exponent"].map(|name| result.values.values(name));
    for (own, label, colour) in SWEEPS {
        let rows = x.iter().zip(exponent).zip(direction).filter(|(_, way)| **way == own);
        let (xs, ys): (Vec<f64>, Vec<f64>) = rows.map(|((x, y), _)| (*x, *y)).unzip();
        if !xs.is_empty() {
            panel = panel.with(Curve::new(label, xs, ys, colour).with_width(width(own)).unlisted());
        }
    }
    panel
}
