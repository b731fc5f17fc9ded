//! The legend: what it lists, and where it goes.

use super::ink::InkMap;
use super::markers::Look;
use super::plan::PanelPlan;
use super::{Canvas, note, style};
use crate::figure::font::{CAP_HEIGHT, Weight};
use crate::figure::geometry::{Point, Rect};
use crate::figure::item::Item;
use crate::figure::panel::{Corner, LegendPlace, Panel};
use crate::figure::scene::{Align, Fill, Path, Role, Shape, Stroke, Text};
use crate::figure::typeset::Rich;

use super::wrap::wrapped;

/// Width of the line or area that stands for an item.
const SAMPLE: f64 = 24.0;
/// From a sample to its name.
const GAP: f64 = 5.0;
/// Height of one entry.
const ROW: f64 = 13.0;
/// From the border of the legend to its entries.
const PADDING: f64 = 5.0;
/// From the border of the panel to the legend.
const INSET: f64 = 6.0;
/// Between columns of a legend below the panel.
const BETWEEN: f64 = 16.0;
/// Entries that are listed at most; a further one says how many are not.
const MOST: usize = 30;
/// More entries than this do not go into the panel unless asked for.
const MOST_INSIDE: usize = 9;

/// One line of the legend.
struct Entry {
    name: Rich,
    line: Option<Stroke>,
    area: Option<Fill>,
    look: Option<Look>,
}

impl Entry {
    /// Adds the samples of an item of the same name.
    fn take_from(&mut self, other: Self) {
        self.line = self.line.take().or(other.line);
        self.area = self.area.or(other.area);
        self.look = self.look.or(other.look);
    }
}

/// Whether a legend of this panel is too long for a place inside.
pub(super) fn is_long(panel: &Panel) -> bool {
    entries(panel).len() > MOST_INSIDE
}

/// Height that a legend below a panel of this width takes, with the space around it.
pub(super) fn height_below(panel: &Panel, width: f64) -> f64 {
    let entries = entries(panel);
    if entries.is_empty() { 0.0 } else { Grid::new(&entries, width).height() + 4.0 }
}

impl Canvas<'_> {
    /// Draws the legend; returns false if there is no free place for it in the panel.
    pub(super) fn legend(&mut self, panel: &Panel, plan: &PanelPlan) -> bool {
        let entries = entries(panel);
        if entries.is_empty() || panel.legend == LegendPlace::Hidden {
            return true;
        }
        if let Some(top) = plan.legend_top {
            self.legend_below(&entries, top);
            return true;
        }
        let size = Size::of(&entries, self.rect.width() - 2.0 * (INSET + PADDING));
        let (place, free) = match panel.legend {
            LegendPlace::Inside(corner) => (at_corner(self.rect, size, corner), true),
            _ => emptiest(self.rect, size, &self.ink),
        };
        self.legend_box(&entries, place, size);
        free
    }

    fn legend_box(&mut self, entries: &[Entry], place: Rect, size: Size) {
        let path = Path {
            runs: vec![place.corners()],
            closed: true,
            fill: Some(Fill { colour: style::PAPER, opacity: 0.88 }),
            stroke: Some(Stroke::solid(style::GRID, style::FRAME_WIDTH)),
        };
        self.add(Role::Legend, Shape::Path(path));
        for (row, entry) in entries.iter().enumerate() {
            let middle = place.top + PADDING + (row as f64 + 0.5) * ROW;
            self.entry(entry, Point::new(place.left + PADDING, middle), size.name);
        }
    }

    fn legend_below(&mut self, entries: &[Entry], top: f64) {
        let grid = Grid::new(entries, self.rect.width());
        let left = self.rect.centre().x - 0.5 * grid.width();
        for (index, entry) in entries.iter().enumerate() {
            let column = index % grid.columns.len();
            let x = left + grid.columns[..column].iter().map(|w| w + BETWEEN).sum::<f64>();
            let y = top + 4.0 + ((index / grid.columns.len()) as f64 + 0.5) * ROW;
            self.entry(entry, Point::new(x, y), grid.columns[column] - SAMPLE - GAP);
        }
    }

    /// Draws a sample and its name; `start` is the left end of the sample at half height.
    fn entry(&mut self, entry: &Entry, start: Point, room: f64) {
        if let Some(fill) = entry.area {
            let area = Rect {
                left: start.x + 2.0,
                right: start.x + SAMPLE - 2.0,
                top: start.y - 4.0,
                bottom: start.y + 4.0,
            };
            let runs = vec![area.corners()];
            let path = Path { runs, closed: true, fill: Some(fill), stroke: None };
            self.add(Role::Legend, Shape::Path(path));
        }
        if let Some(stroke) = &entry.line {
            let run = vec![start, start.moved(SAMPLE, 0.0)];
            self.lines(Role::Legend, vec![run], stroke.clone());
        }
        if let Some(look) = entry.look {
            for shape in look.shapes(start.moved(0.5 * SAMPLE, 0.0)) {
                self.add(Role::Legend, shape);
            }
        }
        let size = style::NOTE_SIZE;
        let place = start.moved(SAMPLE + GAP, 0.5 * CAP_HEIGHT * size);
        let base = note("", place, Align::Start);
        let name = wrapped(&entry.name, size, Weight::Regular, room.max(10.0), 1);
        for rich in name {
            self.add(Role::Legend, Shape::Text(Text { rich, ..base.clone() }));
        }
    }
}

/// The entries in the order of the items; items of one name share an entry.
fn entries(panel: &Panel) -> Vec<Entry> {
    let mut entries: Vec<Entry> = Vec::new();
    let mut left_out = 0_usize;
    for item in &panel.items {
        let Some(entry) = entry_of(item) else { continue };
        match entries.iter().position(|known| known.name == entry.name) {
            Some(place) => entries[place].take_from(entry),
            None if entries.len() < MOST => entries.push(entry),
            None => left_out += 1,
        }
    }
    if left_out > 0 {
        let name = Rich::plain(&format!("and {left_out} more"));
        entries.push(Entry { name, line: None, area: None, look: None });
    }
    entries
}

fn entry_of(item: &Item) -> Option<Entry> {
    let (name, listed) = match item {
        Item::Curve(curve) => (&curve.name, curve.in_legend),
        Item::Points(points) => (&points.name, points.in_legend),
        Item::Region(region) => (&region.name, region.in_legend),
        Item::Reference(_) | Item::Label(_) => return None,
    };
    let name = Rich::parse(name);
    if !listed || name.is_empty() {
        return None;
    }
    let mut entry = Entry { name, line: None, area: None, look: None };
    match item {
        Item::Curve(curve) => {
            entry.line = Some(style::stroke(curve.colour.rgb(), curve.width, curve.line));
        }
        Item::Points(points) => entry.look = Some(Look::of(points)),
        Item::Region(region) => entry.area = Some(super::data::fill(region)),
        Item::Reference(_) | Item::Label(_) => {}
    }
    Some(entry)
}

/// Size of a legend inside the panel.
#[derive(Clone, Copy)]
struct Size {
    width: f64,
    height: f64,
    /// Room for a name.
    name: f64,
}

impl Size {
    fn of(entries: &[Entry], most: f64) -> Self {
        let name = entries.iter().map(name_width).fold(0.0, f64::max);
        let name = name.min(most - SAMPLE - GAP).max(10.0);
        Self {
            width: 2.0 * PADDING + SAMPLE + GAP + name,
            height: 2.0 * PADDING + ROW * entries.len() as f64,
            name,
        }
    }
}

fn name_width(entry: &Entry) -> f64 {
    // A little more than the text needs, so that rounding never costs the last letter.
    style::SLACK * entry.name.width(style::NOTE_SIZE, Weight::Regular) + 0.1
}

fn at_corner(panel: Rect, size: Size, corner: Corner) -> Rect {
    let (across, down) = match corner {
        Corner::TopLeft => (0.0, 0.0),
        Corner::TopRight => (1.0, 0.0),
        Corner::BottomLeft => (0.0, 1.0),
        Corner::BottomRight => (1.0, 1.0),
    };
    placed(panel, size, across, down)
}

/// A legend at shares of the free width and height.
fn placed(panel: Rect, size: Size, across: f64, down: f64) -> Rect {
    let left = panel.left + INSET + across * (panel.width() - 2.0 * INSET - size.width);
    let top = panel.top + INSET + down * (panel.height() - 2.0 * INSET - size.height);
    Rect { left, top, right: left + size.width, bottom: top + size.height }
}

/// The place with the least ink, corners first, and whether nothing is covered there.
fn emptiest(panel: Rect, size: Size, ink: &InkMap) -> (Rect, bool) {
    const PLACES: [(f64, f64); 8] = [
        (1.0, 0.0),
        (0.0, 0.0),
        (1.0, 1.0),
        (0.0, 1.0),
        (0.5, 0.0),
        (0.5, 1.0),
        (1.0, 0.5),
        (0.0, 0.5),
    ];
    let mut best = (placed(panel, size, 1.0, 0.0), f64::INFINITY);
    for (across, down) in PLACES {
        let place = placed(panel, size, across, down);
        let covered = ink.count(&place.grown(2.0));
        if covered < best.1 {
            best = (place, covered);
        }
    }
    let small = size.width < 0.7 * panel.width() && size.height < 0.7 * panel.height();
    (best.0, small && best.1 == 0.0)
}

/// Columns of a legend below the panel.
struct Grid {
    columns: Vec<f64>,
    rows: usize,
}

impl Grid {
    /// As many columns as fit, each as wide as its widest entry.
    fn new(entries: &[Entry], room: f64) -> Self {
        let widths: Vec<f64> =
            entries.iter().map(|entry| SAMPLE + GAP + name_width(entry)).collect();
        let grid = |count: usize| {
            let width = |column: usize| {
                widths.iter().skip(column).step_by(count).copied().fold(0.0, f64::max)
            };
            let columns: Vec<f64> = (0..count).map(width).collect();
            Self { columns, rows: entries.len().div_ceil(count) }
        };
        let fitting = (2..=entries.len().min(6)).rev().map(grid).find(|g| g.width() <= room);
        fitting.unwrap_or_else(|| {
            let mut single = grid(1);
            single.columns[0] = single.columns[0].min(room.max(SAMPLE + GAP + 10.0));
            single
        })
    }

    fn width(&self) -> f64 {
        self.columns.iter().sum::<f64>() + BETWEEN * (self.columns.len() as f64 - 1.0)
    }

    fn height(&self) -> f64 {
        ROW * self.rows as f64
    }
}
