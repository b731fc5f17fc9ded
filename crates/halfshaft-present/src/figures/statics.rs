//! Torque over twist of each shaft.

use halfshaft_results::{Limit, StaticResult, Table};

use super::axes::name;
use super::slug;
use crate::account::statics::gear_name;
use crate::figure::{Axis, Colour, Curve, Figure, Line, Panel, Points, Reference};
use crate::words::number;

/// Shafts that get a figure at most.
const MOST_FIGURES: usize = 12;

/// The id of the figure of a shaft.
fn id(shaft: &str) -> String {
    format!("torque-{}", slug(shaft))
}

/// One figure for each shaft whose law is not a straight line; where all are straight, for the most
/// loaded one.
pub(super) fn figures(result: &StaticResult) -> Vec<Figure> {
    let shown = shown(result);
    let curves = result.curves.iter().filter(|(shaft, _)| shown.contains(&shaft.as_str()));
    curves.map(|(shaft, table)| figure(result, shaft, table)).collect()
}

/// The ids of these figures.
pub(crate) fn ids(result: &StaticResult) -> Vec<String> {
    shown(result).into_iter().map(id).collect()
}

fn shown(result: &StaticResult) -> Vec<&str> {
    let straight = |table: &Table| {
        let stiffness = table.values("stiffness");
        let first = stiffness.first().copied().unwrap_or(0.0);
        stiffness.iter().all(|value| (value - first).abs() <= 1e-9 * first.abs())
    };
    let bent = result.curves.iter().filter(|(_, table)| !straight(table));
    let bent: Vec<&str> = bent.map(|(shaft, _)| shaft.as_str()).take(MOST_FIGURES).collect();
    if !bent.is_empty() {
        return bent;
    }
    let load = |shaft: &str| result.required_torque.get(shaft).map_or(0.0, |torque| torque.abs());
    let shafts = result.curves.keys().map(String::as_str);
    shafts.max_by(|a, b| load(a).total_cmp(&load(b))).into_iter().collect()
}

fn figure(result: &StaticResult, shaft: &str, table: &Table) -> Figure {
    let demands = demands(result, shaft);
    let limits = limits(result, shaft);
    let states = states(result, shaft);
    let x = Axis::new("Twist", "rad").with_secondary("Twist", "°", 180.0 / std::f64::consts::PI);
    let mut y = Axis::new("Torque", "N·m");
    y.range = vertical_range(table, &limits, &states, &demands);
    let mut panel = Panel::new(x, y);
    for demand in &demands {
        panel = panel.with(demand.reference());
    }
    for limit in &limits {
        let label = format!("carries at most {} N·m", number(limit.torque.abs(), 5));
        panel = panel.with(Reference {
            line: Line::DashDot,
            ..Reference::horizontal(limit.torque, label, Colour::DANGER)
        });
    }
    panel = panel.with_all(law(table)).with_all(marks(&states));
    Figure::new(id(shaft), format!("Torque over twist of the {}", name(shaft)))
        .with_caption(caption(shaft, !limits.is_empty(), !demands.is_empty()))
        .with(panel)
}

/// The law: solid where more twist takes more torque, dashed where the shaft gives way.
fn law(table: &Table) -> Vec<Curve> {
    let stiffness = table.values("stiffness");
    let holds: Vec<bool> = stiffness.iter().map(|stiffness| *stiffness > 0.0).collect();
    let (twist, torque) = (table.values("twist"), table.values("torque"));
    let mut curves =
        Curve::by_stability("law, stable part", twist, torque, &holds, Colour::PRIMARY);
    let mut listed = false;
    for curve in curves.iter_mut().filter(|curve| curve.line == Line::Dashed) {
        curve.name = "law, gives way".to_owned();
        curve.in_legend = !std::mem::replace(&mut listed, true);
    }
    // The legend names the stable part first.
    curves.sort_by_key(|curve| curve.line == Line::Dashed);
    curves
}

/// Twist and torque of a state of rest, and whether it is stable.
type State = (f64, f64, bool);

fn states(result: &StaticResult, shaft: &str) -> Vec<State> {
    let of = |state: &halfshaft_results::Equilibrium| {
        Some((*state.twist.get(shaft)?, *state.torque.get(shaft)?, state.stable))
    };
    result.equilibria.iter().filter_map(of).collect()
}

fn marks(states: &[State]) -> Vec<Points> {
    let of = |wanted: bool| -> (Vec<f64>, Vec<f64>) {
        states.iter().filter(|state| state.2 == wanted).map(|state| (state.0, state.1)).unzip()
    };
    let (stable, unstable) = (of(true), of(false));
    let label = |x: &f64| format!("{} rad", number(*x, 4));
    let labels = stable.0.iter().map(label).collect();
    let mut marks = Vec::new();
    if !stable.0.is_empty() {
        marks.push(
            Points::new("stable state", stable.0, stable.1, Colour::SAFE).with_labels(labels),
        );
    }
    if !unstable.0.is_empty() {
        marks.push(
            Points::new("state that is not stable", unstable.0, unstable.1, Colour::DANGER)
                .hollow(),
        );
    }
    marks
}

/// What a gear asks of the shaft.
struct Demand {
    torque: f64,
    label: String,
    holds: bool,
}

impl Demand {
    fn reference(&self) -> Reference {
        let colour = if self.holds { Colour::AUXILIARY } else { Colour::DANGER };
        Reference { line: Line::Dotted, ..Reference::horizontal(self.torque, &self.label, colour) }
    }
}

fn demands(result: &StaticResult, shaft: &str) -> Vec<Demand> {
    let several = result.gears.windows(2).any(|pair| pair[0].gear != pair[1].gear);
    let of = |gear: &halfshaft_results::GearState| {
        let torque = *gear.required_torque.get(shaft)?;
        let of = if several { format!("{} ", name(&gear.gear)) } else { "gear ".to_owned() };
        let holds = gear.exists || gear.overloaded.as_deref() != Some(shaft);
        // Gears that hold crowd about the states of rest; the table has their numbers.
        let asks = if holds { String::new() } else { format!(" asks {} N·m", number(torque, 5)) };
        Some(Demand { torque, label: format!("{of}{}{asks}", gear_name(gear)), holds })
    };
    result.gears.iter().filter_map(of).collect()
}

fn limits(result: &StaticResult, shaft: &str) -> Vec<Limit> {
    let Some(capacity) = result.capacity.get(shaft) else { return Vec::new() };
    let loads = [capacity.positive, capacity.negative];
    let limits: Vec<Limit> = loads.into_iter().flatten().collect();
    // A symmetric law needs only the side of the load.
    let asked = result.required_torque.get(shaft).copied().unwrap_or(0.0);
    match limits.as_slice() {
        [up, down] if up.torque == -down.torque && asked != 0.0 => {
            vec![if asked < 0.0 { *down } else { *up }]
        }
        _ => limits,
    }
}

/// What matters: states, limits and demands. A law that runs far beyond them would flatten them.
fn vertical_range(
    table: &Table,
    limits: &[Limit],
    states: &[State],
    demands: &[Demand],
) -> Option<(f64, f64)> {
    if limits.is_empty() {
        return None;
    }
    let values = || {
        let limits = limits.iter().flat_map(|limit| [limit.torque, -limit.torque]);
        let states = states.iter().map(|state| state.1);
        limits.chain(states).chain(demands.iter().map(|demand| demand.torque))
    };
    let finite = || values().filter(|value| value.is_finite());
    let (low, high) = (finite().reduce(f64::min)?, finite().reduce(f64::max)?);
    let lowest = table.values("torque").iter().copied().fold(f64::INFINITY, f64::min);
    let highest = table.values("torque").iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let pad = 0.12 * (high - low);
    // Wider than the data where a demand lies beyond them.
    let within = |value: f64, edge: f64, sign: f64| {
        let seen = if sign > 0.0 { edge.max(high) } else { edge.min(low) };
        if sign > 0.0 { value.min(seen + pad / 2.0) } else { value.max(seen - pad / 2.0) }
    };
    Some((within(low - pad, lowest, -1.0), within(high + pad, highest, 1.0)))
}

fn caption(shaft: &str, limited: bool, gears: bool) -> String {
    let mut text = format!("Static law of the {}, with its states of rest.", name(shaft));
    if limited {
        text += " Past its largest torque the law gives way: what lies on the dashed part is never seen.";
    }
    if gears {
        text += " Dotted lines are what each gear asks; those in red lie beyond what the shaft carries.";
    }
    text
}
