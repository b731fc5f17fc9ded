//! What is written at each part.

use halfshaft_results::{CheckResult, CheckedShaft, CheckedTorque};

use crate::figure::scene::{Rich, Weight};
use crate::topology::{Network, Node, Part};
use crate::words::{number, plain, quantity, short};

/// Font size of names.
const NAME_SIZE: f64 = 9.0;
/// Font size of values.
const VALUE_SIZE: f64 = 8.0;
/// Longest line of a name, in characters; a longer name takes a second line.
const NAME_LINE: usize = 15;
/// From one line to the next.
pub(super) const LEADING: f64 = 10.8;

/// How a line of text looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Look {
    Name,
    Value,
    /// Nonlinear, or out of the usual.
    Marked,
    Torque,
}

/// A line of text.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Line {
    pub(super) text: String,
    pub(super) look: Look,
}

impl Line {
    fn new(text: String, look: Look) -> Self {
        Self { text, look }
    }

    pub(super) fn size(&self) -> f64 {
        if self.look == Look::Name { NAME_SIZE } else { VALUE_SIZE }
    }

    pub(super) fn weight(&self) -> Weight {
        if self.look == Look::Name { Weight::Bold } else { Weight::Regular }
    }

    /// Width in points, with slack for a viewer that lacks the font.
    fn width(&self) -> f64 {
        1.06 * Rich::plain(&self.text).width(self.size(), self.weight())
    }
}

/// Texts above and below a part.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Caption {
    pub(super) above: Vec<Line>,
    pub(super) below: Vec<Line>,
}

impl Caption {
    /// Width of the widest line.
    pub(super) fn width(&self) -> f64 {
        self.above.iter().chain(&self.below).map(Line::width).fold(0.0, f64::max)
    }
}

/// Captions of all nodes and of all connections.
pub(super) struct Captions {
    pub(super) nodes: Vec<Caption>,
    pub(super) edges: Vec<Caption>,
}

impl Captions {
    pub(super) fn new(check: &CheckResult, network: &Network) -> Self {
        Self {
            nodes: network.nodes.iter().map(|node| of_node(check, node)).collect(),
            edges: network.edges.iter().map(|edge| of_part(check, edge.part)).collect(),
        }
    }
}

fn of_node(check: &CheckResult, node: &Node) -> Caption {
    if node.is_ground {
        return Caption::default();
    }
    let mut below = name_lines(&node.name);
    if node.inertia != 0.0 {
        below.push(Line::new(quantity(node.inertia, 5, "kg·m²"), Look::Value));
    }
    if node.damping != 0.0 {
        let text = format!("drag {}", quantity(node.damping, 4, "N·m·s/rad"));
        below.push(Line::new(text, Look::Value));
    }
    let torques = node.torques.iter().filter_map(|index| check.torques.get(*index));
    Caption { above: torques.flat_map(of_torque).collect(), below }
}

fn of_torque(torque: &CheckedTorque) -> Vec<Line> {
    let mut lines = vec![Line::new(short(&torque.name, 2 * NAME_LINE), Look::Torque)];
    let mut value = |text: String| lines.push(Line::new(text, Look::Value));
    match torque.mean {
        None => value("balances".to_owned()),
        Some(0.0) => {}
        Some(mean) => value(quantity(mean, 5, "N·m")),
    }
    if let Some(first) = torque.harmonics.first() {
        let more = if torque.harmonics.len() > 1 { ", ..." } else { "" };
        let amplitude = quantity(first.amplitude, 5, "N·m");
        value(format!("±{amplitude}, order {}{more}", number(first.order, 4)));
    }
    if torque.pulse.is_some() {
        value("and a pulse".to_owned());
    }
    lines
}

fn of_part(check: &CheckResult, part: Part) -> Caption {
    match part {
        Part::Gear(index) => check.gears.get(index).map(|gear| Caption {
            above: name_lines(&gear.name),
            below: vec![Line::new(format!("{} : 1", number(gear.ratio, 5)), Look::Value)],
        }),
        Part::Shaft(index) => check.shafts.get(index).map(of_shaft),
    }
    .unwrap_or_default()
}

fn of_shaft(shaft: &CheckedShaft) -> Caption {
    let mut below = vec![Line::new(quantity(shaft.stiffness, 5, "N·m/rad"), Look::Value)];
    if shaft.damping != 0.0 {
        below.push(Line::new(quantity(shaft.damping, 5, "N·m·s/rad"), Look::Value));
    }
    for term in shaft.nonlinear_terms.iter().take(3) {
        let effect: String = plain(&term.effect).split([':', ',']).next().unwrap_or("").to_owned();
        // The long effects of quadratic terms stand in the tables.
        let effect =
            if effect.chars().count() <= 12 { format!(", {effect}") } else { String::new() };
        below.push(Line::new(format!("{}{effect}", short(&term.key, NAME_LINE)), Look::Marked));
    }
    Caption { above: name_lines(&shaft.name), below }
}

/// A name in one line or two.
fn name_lines(name: &str) -> Vec<Line> {
    let name = plain(name);
    let line = |text: &str| Line::new(short(text, NAME_LINE + 3), Look::Name);
    if name.chars().count() <= NAME_LINE {
        return vec![line(&name)];
    }
    // The space that makes both lines most alike.
    let middle = name.len() / 2;
    let spaces = name.char_indices().filter(|(_, c)| *c == ' ').map(|(place, _)| place);
    match spaces.min_by_key(|place| place.abs_diff(middle)) {
        Some(place) => vec![line(&name[..place]), line(&name[place + 1..])],
        None => vec![line(&name)],
    }
}

#[cfg(test)]
mod tests {
    use super::name_lines;

    /// Oracle: by hand.
    #[test]
    fn long_names_take_two_lines() {
        let shown = |name: &str| -> Vec<String> {
            name_lines(name).into_iter().map(|line| line.text).collect()
        };
        assert_eq!(shown("half-shaft"), ["half-shaft"]);
        assert_eq!(shown("half-shaft flange left"), ["half-shaft", "flange left"]);
        assert_eq!(shown("abcdefghijklmnopqrstuvwxyz"), ["abcdefghijklmnopq…"]);
    }
}
