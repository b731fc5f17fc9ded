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
/// Diameter of a point, in points.
const SMALL: f64 = 1.8;
const RING: f64 = 3.6;

/// The sweeps with their names, colours and marks.
const SWEEPS: [(f64, &str, Colour); 2] =
    [(-1.0, "sweeping down", Colour::DANGER), (1.0, "sweeping up", Colour::PRIMARY)];

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
    let twist = result.twist();
    let marked = marks::marked(&special, (&result.swept, &twist), |_, _| String::new());
    panel.with_all(marked.into_iter().map(|points| Item::from(points.hollow())))
}

/// Points of one direction: small discs up, rings around them down, so that both are seen.
fn dots(way: f64, label: &str, colour: Colour, (x, y): (Vec<f64>, Vec<f64>)) -> Points {
    let points = Points::new(label, x, y, colour).with_marker(Marker::Circle);
    if way > 0.0 {
        Points { size: SMALL, ..points }
    } else {
        Points { size: RING, ..points.hollow() }
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
        let samples = Samples { x: x.to_vec(), y: y.to_vec(), stable: stable.clone() }.smoothed();
        let label = "response by harmonic balance";
        let own =
            Curve::by_stability(label, &samples.x, &samples.y, &samples.stable, Colour::AUXILIARY);
        curves.extend(own.into_iter().map(|curve| curve.with_width(1.0)));
    }
    curves
}

fn exponents(result: &BifurcationResult) -> Panel {
    let y = Axis::new("Largest Lyapunov exponent", "1/s");
    let mut panel = Panel::new(abscissa(result), y).with(level(0.0, ""));
    panel.height_share = 0.5;
    let [x, direction, exponent] =
        [&result.swept, "direction", "lyapunov_exponent"].map(|name| result.values.values(name));
    for (own, label, colour) in SWEEPS {
        let rows = x.iter().zip(exponent).zip(direction).filter(|(_, way)| **way == own);
        let (xs, ys): (Vec<f64>, Vec<f64>) = rows.map(|((x, y), _)| (*x, *y)).unzip();
        if !xs.is_empty() {
            panel = panel.with(Curve::new(label, xs, ys, colour).with_width(1.0).unlisted());
        }
    }
    panel
}
