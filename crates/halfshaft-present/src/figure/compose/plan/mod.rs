//! Where the panels lie and what their axes say.
//!
//! Margins follow from the widths of the numbers, the numbers from the lengths of the axes, and the
//! lengths from the margins; three rounds settle that.

use super::{legend, style};
use crate::figure::font::{DESCENT, LINE_HEIGHT, Weight};
use crate::figure::geometry::{Point, Rect};
use crate::figure::panel::{Figure, Panel};
use crate::figure::ticks::Ticks;
use crate::figure::typeset::Rich;
use crate::figure::view::{Side, View};

use super::wrap::wrapped;
pub(super) use axis::AxisPlan;

mod axis;

/// Height that every panel has on average, in points.
const SMALLEST_PANEL: f64 = 84.0;

/// The layout of a figure.
pub(super) struct Plan {
    pub width: f64,
    pub height: f64,
    pub title: Vec<Rich>,
    /// Start of the first line of the heading.
    pub title_place: Point,
    pub panels: Vec<PanelPlan>,
}

/// The layout of one panel.
pub(super) struct PanelPlan {
    pub rect: Rect,
    pub x: AxisPlan,
    pub y: AxisPlan,
    /// Whether numbers and text of the horizontal axis stand here, not below a later panel.
    pub names_x: bool,
    /// Whether the secondary horizontal axis stands here, not above an earlier panel.
    pub names_top: bool,
    /// Upper edge of a legend below the panel.
    pub legend_top: Option<f64>,
}

impl Plan {
    /// Lays out a figure with the legends of the marked panels below them.
    pub(super) fn new(figure: &Figure, legend_below: &[bool]) -> Self {
        let (width, height) = figure.dimensions();
        let views = views(figure);
        let mut margins = Margins::guess(figure);
        let mut plan = margins.plan(figure, &views, width, height);
        for _ in 0..3 {
            margins = Margins::needed(figure, &plan, legend_below);
            plan = margins.plan(figure, &views, width, height);
        }
        plan
    }
}

/// The shown intervals; neighbours with equal horizontal axes share theirs.
pub(in crate::figure) fn views(figure: &Figure) -> Vec<(View, View)> {
    let panels = &figure.panels;
    let group = |index: usize| {
        let first = (0..index).rev().take_while(|&i| panels[i].x == panels[index].x).last();
        let later = panels[index..].iter().take_while(|p| p.x == panels[index].x).count();
        &panels[first.unwrap_or(index)..index + later]
    };
    let views = panels.iter().enumerate().map(|(index, panel)| {
        let together = group(index).iter().flat_map(|panel| &panel.items);
        (View::fit(&panel.x, Side::X, together), View::fit(&panel.y, Side::Y, &panel.items))
    });
    views.collect()
}

/// What surrounds the panels.
struct Margins {
    left: f64,
    right: f64,
    title: Vec<Rich>,
    /// Above and below each panel, without and with its legend.
    rows: Vec<Row>,
}

#[derive(Clone, Copy, Default)]
struct Row {
    above: f64,
    below: f64,
    legend: f64,
}

impl Margins {
    fn guess(figure: &Figure) -> Self {
        let row = Row { above: 10.0, below: 30.0, legend: 0.0 };
        Self { left: 55.0, right: 15.0, title: Vec::new(), rows: vec![row; figure.panels.len()] }
    }

    fn needed(figure: &Figure, plan: &Plan, legend_below: &[bool]) -> Self {
        let sides = plan.panels.iter().map(side_margins);
        let (left, right) =
            sides.fold((style::EDGE, style::EDGE), |(l, r), side| (l.max(side.0), r.max(side.1)));
        let room = (plan.width - 2.0 * style::EDGE).max(20.0) / style::SLACK;
        let title = Rich::parse(&figure.title);
        let title = wrapped(&title, style::TITLE_SIZE, Weight::Bold, room, 4);
        let rows = plan.panels.iter().zip(&figure.panels).zip(legend_below);
        let rows = rows.map(|((plan, panel), &below)| {
            let legend = if below { legend::height_below(panel, plan.rect.width()) } else { 0.0 };
            Row { legend, ..row_margins(plan) }
        });
        Self { left, right, title, rows: rows.collect() }
    }

    fn plan(&self, figure: &Figure, views: &[(View, View)], width: f64, height: f64) -> Plan {
        let title_height = match self.title.len() {
            0 => 0.0,
            lines => lines as f64 * style::TITLE_SIZE * LINE_HEIGHT + 3.0,
        };
        let used: f64 = self.rows.iter().map(|row| row.above + row.below + row.legend).sum();
        let shares: Vec<f64> = figure.panels.iter().map(share).collect();
        let all: f64 = shares.iter().sum();
        let around = 2.0 * style::EDGE + title_height + used;
        // A page that a long heading or legend fills grows rather than crush its panels.
        let free = (height - around).max(SMALLEST_PANEL * shares.len() as f64);
        let height = height.max(around + free);
        let right = (width - self.right).max(self.left + 20.0);
        let mut top = style::EDGE + title_height;
        let mut panels = Vec::new();
        for (index, panel) in figure.panels.iter().enumerate() {
            let row = self.rows.get(index).copied().unwrap_or_default();
            top += row.above;
            let high = free * shares[index] / all;
            let rect = Rect { left: self.left, top, right, bottom: top + high };
            top += high + row.below;
            let legend_top = (row.legend > 0.0).then_some(top);
            top += row.legend;
            let neighbours = Neighbours::of(figure, index);
            panels.push(panel_plan(panel, views[index], on_pixels(rect), legend_top, neighbours));
        }
        align_numbers(&mut panels);
        let title_place = Point::new(self.title_left(width), style::EDGE + 0.8 * style::TITLE_SIZE);
        Plan { width, height, title: self.title.clone(), title_place, panels }
    }

    /// A heading starts where the panels do if it fits there, else at the edge of the page.
    fn title_left(&self, width: f64) -> f64 {
        let fits = |line: &Rich| {
            let length = style::SLACK * line.width(style::TITLE_SIZE, Weight::Bold);
            self.left + length <= width - style::EDGE
        };
        if self.title.iter().all(fits) { self.left } else { style::EDGE }
    }
}

/// Gives the numbers of all vertical axes the same room, so that the texts beyond them line up.
fn align_numbers(panels: &mut [PanelPlan]) {
    let widest = panels.iter().map(|panel| panel.y.label_width).fold(0.0, f64::max);
    let second = |panel: &PanelPlan| panel.y.secondary.as_ref().map_or(0.0, |s| s.label_width);
    let second_widest = panels.iter().map(second).fold(0.0, f64::max);
    for panel in panels {
        panel.y.label_width = widest;
        if let Some(second) = &mut panel.y.secondary {
            second.label_width = second_widest;
        }
    }
}

/// Which neighbours share the horizontal axis.
#[derive(Clone, Copy)]
struct Neighbours {
    above: bool,
    below: bool,
}

impl Neighbours {
    fn of(figure: &Figure, index: usize) -> Self {
        let x = |i: usize| figure.panels.get(i).map(|panel| &panel.x);
        Self { above: index > 0 && x(index - 1) == x(index), below: x(index + 1) == x(index) }
    }
}

fn share(panel: &Panel) -> f64 {
    let share = panel.height_share;
    if share.is_finite() { share.clamp(0.05, 20.0) } else { 1.0 }
}

fn on_pixels(rect: Rect) -> Rect {
    let snap = |length: f64| (length / style::PIXEL).round() * style::PIXEL;
    Rect {
        left: snap(rect.left),
        top: snap(rect.top),
        right: snap(rect.right),
        bottom: snap(rect.bottom),
    }
}

fn panel_plan(
    panel: &Panel,
    (x, y): (View, View),
    rect: Rect,
    legend_top: Option<f64>,
    neighbours: Neighbours,
) -> PanelPlan {
    PanelPlan {
        rect,
        x: AxisPlan::new(&panel.x, x, rect.width(), true),
        y: AxisPlan::new(&panel.y, y, rect.height(), false),
        names_x: !neighbours.below,
        names_top: !neighbours.above,
        legend_top,
    }
}

/// Room for marks, numbers and text of an axis across it.
fn block(label_width: f64, text: &[Rich]) -> f64 {
    let numbers = style::TICK_LENGTH + style::TICK_GAP + label_width;
    match text.len() {
        0 => numbers,
        lines => {
            let size = style::LABEL_SIZE;
            let leading = (lines - 1) as f64 * LINE_HEIGHT * size;
            numbers + style::AXIS_GAP + leading + (1.0 + DESCENT) * size
        }
    }
}

/// What a panel needs to its left and right.
fn side_margins(plan: &PanelPlan) -> (f64, f64) {
    let left = block(plan.y.label_width, &plan.y.text);
    let second = plan.y.secondary.as_ref();
    let right = second.map_or(0.0, |second| block(second.label_width, &second.text));
    let over = overhang(plan);
    (style::EDGE + left.max(over.0), style::EDGE + right.max(over.1))
}

/// How far numbers of the horizontal axes reach beyond the panel to the left and right.
fn overhang(plan: &PanelPlan) -> (f64, f64) {
    let width = plan.rect.width();
    let mut over = (0.0_f64, 0.0_f64);
    let mut include = |ticks: &Ticks, shares: &[f64]| {
        for (tick, share) in ticks.majors.iter().zip(shares) {
            let half = 0.5 * style::SLACK * tick.label.width(style::TICK_SIZE, Weight::Regular);
            over = (over.0.max(half - share * width), over.1.max(half - (1.0 - share) * width));
        }
    };
    if plan.names_x {
        include(&plan.x.ticks, &plan.x.shares(&plan.x.ticks).0);
    }
    if let Some(second) = plan.x.secondary.as_ref().filter(|_| plan.names_top) {
        include(&second.ticks, &plan.x.secondary_shares(second).0);
    }
    over
}

/// What a panel needs above and below, without a legend.
fn row_margins(plan: &PanelPlan) -> Row {
    let half_number = 0.75 * style::TICK_SIZE;
    let above = match &plan.x.secondary {
        Some(second) if plan.names_top => block(second.label_width, &second.text),
        _ => half_number,
    };
    let below = if plan.names_x { block(plan.x.label_width, &plan.x.text) } else { half_number };
    Row { above, below, legend: 0.0 }
}
