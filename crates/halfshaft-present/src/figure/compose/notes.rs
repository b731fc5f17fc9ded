//! Texts between the axes: labels with a fixed place, names of points and of reference lines.
//!
//! A text that may choose takes the place with the least ink under it, in a stated order of
//! preference.

use super::markers::Look;
use super::{Canvas, note, style};
use crate::figure::font::{CAP_HEIGHT, DESCENT, Weight};
use crate::figure::geometry::{Point, Rect};
use crate::figure::item::{Anchor, Direction, Item, Label, Points, Reference};
use crate::figure::panel::Panel;
use crate::figure::scene::{Align, Ink, Role, Shape, Text};
use crate::figure::typeset::Rich;

/// From a point or line to its text.
const GAP: f64 = 2.5;
/// From the frame to any text inside it.
const CLEARANCE: f64 = 2.5;
/// Points beyond this number get no text: nobody could read them.
const MOST_NAMED: usize = 200;

/// A point with a name, and where the middle of the name lies as seen from it.
#[derive(Clone, Debug)]
pub(in crate::figure) struct NamedPoint {
    /// Number of the item in its panel, and of the point in the item.
    pub item: usize,
    pub point: usize,
    /// To the right and downwards, in halves of the width and height of the name.
    pub right: f64,
    pub down: f64,
}

/// Where the text of a reference line lies: which of the four places beside the ends of the line.
#[derive(Clone, Copy, Debug)]
pub(in crate::figure) struct NamedReference {
    /// Number of the item in its panel.
    pub item: usize,
    /// Whether it lies at the right end, or the upper one.
    pub at_end: bool,
    /// Whether it lies above a level line, or left of an upright one.
    pub before: bool,
}

impl NamedPoint {
    fn new(item: usize, point: usize, place: Point, name: &Rect) -> Self {
        let middle = name.centre();
        let right = 2.0 * (middle.x - place.x) / name.width().max(1.0);
        let down = 2.0 * (middle.y - place.y) / name.height().max(1.0);
        Self { item, point, right, down }
    }
}

impl Canvas<'_> {
    /// Sets all texts, those without a choice first.
    pub(super) fn notes(&mut self, panel: &Panel) {
        for item in &panel.items {
            if let Item::Label(label) = item {
                self.label(label);
            }
        }
        for (number, item) in panel.items.iter().enumerate() {
            if let Item::Points(points) = item {
                self.names_of_points(points, number);
            }
        }
        for (number, item) in panel.items.iter().enumerate() {
            if let Item::Reference(reference) = item {
                self.name_of_reference(reference, number);
            }
        }
    }

    fn label(&mut self, label: &Label) {
        let place = self.place(label.x, label.y);
        let rich = Rich::parse(&label.text);
        if rich.is_empty() || !self.rect.grown(0.1).contains(place) {
            return;
        }
        let half = 0.5 * CAP_HEIGHT * style::NOTE_SIZE;
        let (place, align) = match label.anchor {
            Anchor::Centre => (place.moved(0.0, half), Align::Middle),
            Anchor::Left => (place.moved(-GAP, half), Align::End),
            Anchor::Right => (place.moved(GAP, half), Align::Start),
            Anchor::Above => (place.moved(0.0, -GAP), Align::Middle),
            Anchor::Below => (place.moved(0.0, GAP + 2.0 * half), Align::Middle),
        };
        let text = self.moved_inside(haloed(rich, place, align, label.colour.rgb()));
        self.set(text);
    }

    fn names_of_points(&mut self, points: &Points, item: usize) {
        let radius = Look::of(points).radius();
        let visible = self.visible(points);
        for (index, place) in visible.into_iter().take(MOST_NAMED) {
            let rich = points.labels.get(index).map(|name| Rich::parse(name)).unwrap_or_default();
            if !rich.is_empty() {
                let choices = around(place, radius, &rich);
                if let Some((_, name)) = self.set_best(choices, DESCENT) {
                    self.named.push(NamedPoint::new(item, index, place, &name));
                }
            }
        }
    }

    fn name_of_reference(&mut self, reference: &Reference, item: usize) {
        let rich = Rich::parse(&reference.label);
        let Some((from, to)) = self.reference_line(reference).filter(|_| !rich.is_empty()) else {
            return;
        };
        let colour = reference.colour.rgb();
        let (above, below) = (GAP, GAP + CAP_HEIGHT * style::NOTE_SIZE);
        let inset = 2.0 * GAP;
        let text = |place: Point, align: Align, upright: bool| Text {
            upright,
            ..haloed(rich.clone(), place, align, colour)
        };
        let choices = match reference.axis {
            Direction::Horizontal => vec![
                text(to.moved(-inset, -above), Align::End, false),
                text(from.moved(inset, -above), Align::Start, false),
                text(to.moved(-inset, below), Align::End, false),
                text(from.moved(inset, below), Align::Start, false),
            ],
            Direction::Vertical => vec![
                text(to.moved(-above, inset), Align::End, true),
                text(to.moved(below, inset), Align::End, true),
                text(from.moved(-above, -inset), Align::Start, true),
                text(from.moved(below, -inset), Align::Start, true),
            ],
        };
        // Its own line runs just under a text above it; few letters reach below their base line.
        if let Some((choice, _)) = self.set_best(choices, 0.0) {
            let (before, at_end) = match reference.axis {
                Direction::Horizontal => (choice < 2, choice % 2 == 0),
                Direction::Vertical => (choice % 2 == 0, choice < 2),
            };
            self.named_references.push(NamedReference { item, at_end, before });
        }
    }

    /// Sets the choice with the least ink under it, counted to this depth below the base line; of
    /// nearly equal ones the first. Returns its number and the box that it fills.
    fn set_best(&mut self, choices: Vec<Text>, descent: f64) -> Option<(usize, Rect)> {
        const RELUCTANCE: f64 = 0.12;
        let mut best: Option<(f64, usize, Text)> = None;
        for (rank, text) in choices.into_iter().enumerate() {
            let text = self.moved_inside(text);
            let cost = self.ink.count(&extent(&text, descent)) + RELUCTANCE * rank as f64;
            if best.as_ref().is_none_or(|(least, ..)| cost < *least) {
                best = Some((cost, rank, text));
            }
        }
        let (_, rank, text) = best?;
        let area = bounds(&text);
        self.set(text);
        Some((rank, area))
    }

    fn set(&mut self, text: Text) {
        self.ink.add_box(&bounds(&text));
        self.add(Role::Annotation, Shape::Text(text));
    }

    /// The text moved so far that it does not cross the frame, if it can fit at all.
    fn moved_inside(&self, mut text: Text) -> Text {
        // Letters are a little higher than capitals, and the white edge must not cut the frame.
        let (area, frame) = (bounds(&text), self.rect.grown(-CLEARANCE));
        let shift = |low: f64, high: f64, from: f64, to: f64| match high - low > to - from {
            true => from - low,
            false => (from - low).max(0.0) + (to - high).min(0.0),
        };
        let dx = shift(area.left, area.right, frame.left, frame.right);
        let dy = shift(area.top, area.bottom, frame.top, frame.bottom);
        text.place = text.place.moved(dx, dy);
        text
    }
}

fn haloed(rich: Rich, place: Point, align: Align, colour: Ink) -> Text {
    Text { rich, colour, halo: true, ..note("", place, align) }
}

/// The places for the name of a point, from the best to the worst: close to it, then further away.
fn around(place: Point, radius: f64, rich: &Rich) -> Vec<Text> {
    [GAP, 3.0 * GAP, 5.0 * GAP].into_iter().flat_map(|gap| ring(place, radius, gap, rich)).collect()
}

fn ring(place: Point, radius: f64, gap: f64, rich: &Rich) -> [Text; 8] {
    let near = radius + gap;
    let slant = 0.7 * radius + 0.6 * gap;
    let capital = CAP_HEIGHT * style::NOTE_SIZE;
    let choices = [
        (place.moved(slant, -slant), Align::Start),
        (place.moved(near, 0.5 * capital), Align::Start),
        (place.moved(-slant, -slant), Align::End),
        (place.moved(-near, 0.5 * capital), Align::End),
        (place.moved(slant, slant + capital), Align::Start),
        (place.moved(-slant, slant + capital), Align::End),
        (place.moved(0.0, -near), Align::Middle),
        (place.moved(0.0, near + capital), Align::Middle),
    ];
    choices.map(|(place, align)| haloed(rich.clone(), place, align, style::TEXT))
}

/// The box that a text fills.
fn bounds(text: &Text) -> Rect {
    extent(text, DESCENT)
}

/// The box around a text that reaches this far below its base line, in units of the font size.
fn extent(text: &Text, descent: f64) -> Rect {
    let width = style::SLACK * text.rich.width(text.size, Weight::Regular);
    let before = match text.align {
        Align::Start => 0.0,
        Align::Middle => 0.5 * width,
        Align::End => width,
    };
    let (up, down) = (CAP_HEIGHT * text.size, descent * text.size);
    let Point { x, y } = text.place;
    if text.upright {
        let bottom = y + before;
        return Rect { left: x - up, right: x + down, top: bottom - width, bottom };
    }
    let left = x - before;
    Rect { left, right: left + width, top: y - up, bottom: y + down }
}
