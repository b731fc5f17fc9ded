//! The Campbell diagram: natural frequencies and orders over the speed, with their crossings.

use halfshaft_results::{CampbellGear, CampbellResult};

use super::axes::speed_axis;
use crate::account::campbell::gear_name;
use crate::figure::{
    Anchor, Axis, Colour, Curve, Figure, Label, Line, Marker, Panel, Points, Region, Size, escape,
};
use crate::words::number;

const HERTZ: f64 = 1.0 / std::f64::consts::TAU;

/// The id of the figure of a gear.
pub(crate) fn id(index: usize) -> String {
    if index == 0 { "campbell".to_owned() } else { format!("campbell-{}", index + 1) }
}

/// A figure for each gear.
pub(super) fn figures(result: &CampbellResult) -> Vec<Figure> {
    result.gears.iter().enumerate().map(|(index, gear)| figure(result, gear, index)).collect()
}

fn figure(result: &CampbellResult, gear: &CampbellGear, index: usize) -> Figure {
    let (from, to) = result.frequency;
    let top = height(result, gear) * HERTZ;
    let y = Axis::new("Frequency", "Hz").with_range(0.0, top);
    let mut panel = Panel::new(speed_axis().with_range(from, to), y);
    if let Some((low, high)) = result.operating {
        let x = vec![low, high.min(to), high.min(to), low];
        let region = Region::new("operating range", x, vec![0.0, 0.0, top, top], Colour::SAFE);
        panel = panel.with(Region { opacity: 0.12, ..region });
    }
    for order in &result.orders {
        let end = to.min(top / HERTZ / order);
        let curve = Curve::new(
            "",
            vec![from, end],
            vec![from * order * HERTZ, end * order * HERTZ],
            Colour::AUXILIARY,
        );
        panel = panel.with(curve.with_line(Line::Dashed).with_width(0.8).unlisted());
        let text = number(*order, 4);
        panel = panel
            .with(Label { anchor: Anchor::Left, ..Label::new(end, end * order * HERTZ, text) });
    }
    for (mode, frequency) in gear.frequency.iter().enumerate() {
        let height = frequency * HERTZ;
        if height > top {
            break;
        }
        let name = format!("mode {}: {} Hz", mode + 1, number(height, 4));
        panel = panel.with(Curve::new(name, vec![from, to], vec![height; 2], Colour::index(mode)));
    }
    let shown = gear.critical.iter().filter(|critical| critical.frequency * HERTZ <= top);
    let (acting, silent): (Vec<_>, Vec<_>) = shown.partition(|critical| critical.shaft.is_some());
    for (name, critical, filled) in
        [("critical speed, excited", acting, true), ("critical speed, not excited", silent, false)]
    {
        if critical.is_empty() {
            continue;
        }
        let x = critical.iter().map(|critical| critical.speed).collect();
        let y = critical.iter().map(|critical| critical.frequency * HERTZ).collect();
        let points = Points::new(name, x, y, Colour::DANGER).with_marker(Marker::Circle);
        panel = panel.with(if filled { points } else { points.hollow() });
    }
    let title = if result.gears.len() > 1 {
        format!("Campbell diagram: {}", escape(&gear_name(&gear.gear)))
    } else {
        "Campbell diagram".to_owned()
    };
    Figure::new(id(index), title)
        .with_caption(
            "Natural frequencies (level) and orders of the excitation (dashed, with their numbers); where \
             they meet is a critical speed.",
        )
        .with_size(Size::Wide)
        .with(panel)
}

/// Circular frequency up to which the diagram goes: the highest critical speed, not far above the
/// lowest modes that are not met.
fn height(result: &CampbellResult, gear: &CampbellGear) -> f64 {
    let met = gear.critical.iter().map(|critical| critical.frequency).fold(0.0, f64::max);
    let lowest = gear.frequency.iter().find(|frequency| **frequency > met).copied();
    let highest_order = result.orders.last().copied().unwrap_or(1.0) * result.frequency.1;
    let next = lowest.filter(|lowest| *lowest < 2.0 * met.max(1.0)).unwrap_or(0.0);
    let reach = if met > 0.0 { met.max(next) } else { highest_order };
    1.15 * reach.max(f64::MIN_POSITIVE)
}
