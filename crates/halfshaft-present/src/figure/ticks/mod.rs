//! Which values an axis names, and how.

use super::axis::Scale;
use super::font::Weight;
use super::typeset::{Level, Rich};
use super::view::View;

mod linear;
mod log;
mod number;

/// The marks of one axis.
#[derive(Clone, Debug, Default)]
pub(crate) struct Ticks {
    /// Values with a label, in increasing order.
    pub majors: Vec<Tick>,
    /// Values with a short mark only.
    pub minors: Vec<f64>,
    /// What the labels leave out.
    pub reading: Reading,
}

/// A value with its label.
#[derive(Clone, Debug)]
pub(crate) struct Tick {
    pub value: f64,
    pub label: Rich,
}

/// How a value follows from its label: `value = base + label * 10^exponent`.
#[derive(Clone, Debug, Default)]
pub(crate) struct Reading {
    pub exponent: i32,
    /// The base as text, without sign, and whether it is negative.
    pub base: Option<(Rich, bool)>,
}

/// The room that the labels of an axis have.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Room {
    /// Length of the axis in points.
    pub length: f64,
    /// Whether labels follow each other along their own reading direction.
    pub along: bool,
    /// Font size of the labels.
    pub size: f64,
}

impl Room {
    /// Smallest distance of neighbouring labels that looks calm, in points.
    fn calm_distance(&self) -> f64 {
        if self.along { 4.2 * self.size } else { 2.6 * self.size }
    }

    /// Whether labels at these shares of the axis keep clear of each other.
    fn fits(&self, majors: &[Tick], share: impl Fn(f64) -> f64) -> bool {
        majors.windows(2).all(|pair| {
            let distance = self.length * (share(pair[1].value) - share(pair[0].value)).abs();
            distance >= self.needed(&pair[0].label, &pair[1].label)
        })
    }

    fn needed(&self, first: &Rich, second: &Rich) -> f64 {
        if !self.along {
            return 1.5 * self.size;
        }
        let width = |label: &Rich| label.width(self.size, Weight::Regular);
        0.5 * (width(first) + width(second)) + 1.1 * self.size
    }
}

/// Chooses the marks of an axis.
pub(crate) fn choose(view: &View, room: Room) -> Ticks {
    match view.scale {
        Scale::Linear => linear::ticks(view.low, view.high, room),
        Scale::Log => log::ticks(view, room),
    }
}

/// The names of an axis that shows names, those that have room.
pub(crate) fn named(names: &[(f64, String)], view: &View, room: Room) -> Ticks {
    let shown = names.iter().filter(|(value, _)| value.is_finite() && view.shows(*value));
    let mut all: Vec<Tick> =
        shown.map(|(value, name)| Tick { value: *value, label: Rich::parse(name) }).collect();
    all.sort_by(|a, b| a.value.total_cmp(&b.value));
    let mut majors: Vec<Tick> = Vec::new();
    for tick in all {
        let pair: Vec<Tick> = majors.last().cloned().into_iter().chain([tick]).collect();
        if room.fits(&pair, |value| view.share(value)) {
            majors.extend(pair.into_iter().next_back());
        }
    }
    Ticks { majors, ..Ticks::default() }
}

/// The text of an axis: quantity, base, multiplier and unit, as in "Twist θ (×10⁻³ rad)".
pub(crate) fn axis_text(label: &str, unit: &str, reading: &Reading) -> Rich {
    let mut text = Rich::parse(label);
    if let Some((base, negative)) = &reading.base {
        text.push_str(if *negative { " + " } else { " − " }, Level::Base);
        text.append(base);
    }
    let unit = Rich::parse(unit);
    if reading.exponent == 0 && unit.is_empty() {
        return text;
    }
    text.push_str(if text.is_empty() { "(" } else { " (" }, Level::Base);
    if reading.exponent != 0 {
        text.push_str("×10", Level::Base);
        text.push_str(&number::signed(reading.exponent), Level::Super);
        text.push_str(if unit.is_empty() { "" } else { " " }, Level::Base);
    }
    text.append(&unit);
    text.push(')', Level::Base);
    text
}
