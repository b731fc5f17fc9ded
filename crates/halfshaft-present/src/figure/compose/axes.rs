//! Grid, frame, marks, numbers and axis texts.

use super::plan::{AxisPlan, PanelPlan};
use super::{Canvas, note, style};
use crate::figure::font::{CAP_HEIGHT, DESCENT, LINE_HEIGHT};
use crate::figure::geometry::{Point, Rect};
use crate::figure::scene::{Align, Path, Role, Shape, Stroke, Text};
use crate::figure::ticks::Ticks;
use crate::figure::typeset::Rich;

/// The side of a panel on which an axis is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Edge {
    Left,
    Right,
    Bottom,
    Top,
}

impl Canvas<'_> {
    /// Draws everything of the axes.
    pub(super) fn axes(&mut self, plan: &PanelPlan) {
        self.grid(plan);
        self.frame();
        let own = |axis: &AxisPlan| (axis.ticks.clone(), axis.shares(&axis.ticks));
        for (axis, edge, opposite, named) in [
            (&plan.x, Edge::Bottom, Edge::Top, plan.names_x),
            (&plan.y, Edge::Left, Edge::Right, true),
        ] {
            let (ticks, shares) = own(axis);
            self.marks(edge, &shares);
            if named {
                self.numbers(edge, &ticks, &shares);
                self.text(edge, &axis.text, axis.label_width);
            }
            let Some(second) = &axis.secondary else { continue };
            if edge == Edge::Bottom && !plan.names_top {
                continue;
            }
            let shares = axis.secondary_shares(second);
            self.marks(opposite, &shares);
            self.numbers(opposite, &second.ticks, &shares);
            self.text(opposite, &second.text, second.label_width);
        }
    }

    fn grid(&mut self, plan: &PanelPlan) {
        let rect = self.rect;
        let upright = plan.x.shares(&plan.x.ticks).0.into_iter().map(|share| {
            let x = rect.left + share * rect.width();
            vec![Point::new(x, rect.bottom), Point::new(x, rect.top)]
        });
        let level = plan.y.shares(&plan.y.ticks).0.into_iter().map(|share| {
            let y = rect.bottom - share * rect.height();
            vec![Point::new(rect.left, y), Point::new(rect.right, y)]
        });
        let runs = upright.chain(level).collect();
        self.lines(Role::Grid, runs, Stroke::solid(style::GRID, style::GRID_WIDTH));
    }

    fn frame(&mut self) {
        let stroke = Some(Stroke::solid(style::FRAME, style::FRAME_WIDTH));
        let runs = vec![self.rect.corners()];
        let path = Path { runs, closed: true, fill: None, stroke };
        self.add(Role::Frame, Shape::Path(path));
    }

    fn marks(&mut self, edge: Edge, (majors, minors): &(Vec<f64>, Vec<f64>)) {
        let rect = self.rect;
        let mark = |length: f64| {
            move |share: &f64| {
                let foot = foot(&rect, edge, *share);
                vec![foot, outwards(foot, edge, length)]
            }
        };
        let majors = majors.iter().map(mark(style::TICK_LENGTH));
        let minors = minors.iter().map(mark(style::MINOR_LENGTH));
        let runs = majors.chain(minors).collect();
        self.lines(Role::Frame, runs, Stroke::solid(style::FRAME, style::FRAME_WIDTH));
    }

    fn numbers(&mut self, edge: Edge, ticks: &Ticks, shares: &(Vec<f64>, Vec<f64>)) {
        for (tick, share) in ticks.majors.iter().zip(&shares.0) {
            let distance = style::TICK_LENGTH + style::TICK_GAP;
            let place = outwards(foot(&self.rect, edge, *share), edge, distance);
            let capital = CAP_HEIGHT * style::TICK_SIZE;
            let (place, align) = match edge {
                Edge::Left => (place.moved(0.0, 0.5 * capital), Align::End),
                Edge::Right => (place.moved(0.0, 0.5 * capital), Align::Start),
                Edge::Bottom => (place.moved(0.0, capital), Align::Middle),
                Edge::Top => (place, Align::Middle),
            };
            let base = note("", place, align);
            let text = Text { rich: tick.label.clone(), size: style::TICK_SIZE, ..base };
            self.add(Role::TickLabel, Shape::Text(text));
        }
    }

    /// The text of an axis, beyond numbers that need `label_width` across the edge.
    fn text(&mut self, edge: Edge, lines: &[Rich], label_width: f64) {
        let start = style::TICK_LENGTH + style::TICK_GAP + label_width + style::AXIS_GAP;
        let size = style::LABEL_SIZE;
        for (index, rich) in lines.iter().enumerate() {
            // Lines are read from the top or from the left, whatever the side of the panel.
            let from_frame = match edge {
                Edge::Bottom | Edge::Right => index,
                Edge::Top | Edge::Left => lines.len() - 1 - index,
            };
            let above = matches!(edge, Edge::Top | Edge::Left);
            let towards_frame = size * if above { DESCENT } else { CAP_HEIGHT };
            let distance = start + towards_frame + from_frame as f64 * size * LINE_HEIGHT;
            let place = outwards(foot(&self.rect, edge, 0.5), edge, distance);
            let upright = matches!(edge, Edge::Left | Edge::Right);
            let base = note("", place, Align::Middle);
            let text = Text { rich: rich.clone(), size, upright, ..base };
            self.add(Role::AxisText, Shape::Text(text));
        }
    }

    /// Adds straight lines of one look, if there are any.
    pub(super) fn lines(&mut self, role: Role, runs: Vec<Vec<Point>>, stroke: Stroke) {
        if !runs.is_empty() {
            let stroke = Some(stroke);
            self.add(role, Shape::Path(Path { runs, closed: false, fill: None, stroke }));
        }
    }
}

/// The point of an edge at a share of the axis.
fn foot(rect: &Rect, edge: Edge, share: f64) -> Point {
    let x = rect.left + share * rect.width();
    let y = rect.bottom - share * rect.height();
    match edge {
        Edge::Left => Point::new(rect.left, y),
        Edge::Right => Point::new(rect.right, y),
        Edge::Bottom => Point::new(x, rect.bottom),
        Edge::Top => Point::new(x, rect.top),
    }
}

fn outwards(point: Point, edge: Edge, distance: f64) -> Point {
    match edge {
        Edge::Left => point.moved(-distance, 0.0),
        Edge::Right => point.moved(distance, 0.0),
        Edge::Bottom => point.moved(0.0, distance),
        Edge::Top => point.moved(0.0, -distance),
    }
}
