//! The shapes of points.

use std::f64::consts::TAU;

use super::style;
use crate::figure::geometry::Point;
use crate::figure::item::Marker;
use crate::figure::scene::{Disc, Fill, Ink, Path, Shape, Stroke};

/// How a point is drawn.
#[derive(Clone, Copy, Debug)]
pub(super) struct Look {
    pub marker: Marker,
    pub filled: bool,
    pub colour: Ink,
    pub size: f64,
}

impl Look {
    /// Half of the size, kept to what can be seen and drawn.
    pub(super) fn radius(&self) -> f64 {
        if self.size.is_finite() { self.size.clamp(1.0, 72.0) / 2.0 } else { 3.0 }
    }

    /// The shapes of a point, from back to front. Sizes are matched by area, so that no shape looks
    /// heavier than another.
    pub(super) fn shapes(&self, centre: Point) -> Vec<Shape> {
        let radius = self.radius();
        match self.marker {
            Marker::Circle => vec![self.disc(centre, radius)],
            Marker::Square => vec![self.area(around(centre, 1.25 * radius, &turns(4, 0.125)))],
            Marker::Diamond => vec![self.area(around(centre, 1.3 * radius, &turns(4, 0.0)))],
            Marker::Triangle => {
                let centre = centre.moved(0.0, 0.2 * radius);
                vec![self.area(around(centre, 1.35 * radius, &turns(3, 0.0)))]
            }
            Marker::TriangleDown => {
                let centre = centre.moved(0.0, -0.2 * radius);
                vec![self.area(around(centre, 1.35 * radius, &turns(3, 0.5)))]
            }
            Marker::Star => vec![self.area(star(centre, 1.55 * radius))],
            Marker::Cross => self.cross(&around(centre, 1.15 * radius, &turns(4, 0.125))),
            Marker::Plus => self.cross(&around(centre, 1.15 * radius, &turns(4, 0.0))),
        }
    }

    fn dress(&self) -> (Fill, Stroke) {
        if self.filled {
            (Fill::solid(self.colour), Stroke::solid(style::PAPER, style::MARKER_EDGE))
        } else {
            (Fill::solid(style::PAPER), Stroke::solid(self.colour, style::MARKER_LINE))
        }
    }

    fn disc(&self, centre: Point, radius: f64) -> Shape {
        let (fill, stroke) = self.dress();
        Shape::Disc(Disc { centre, radius, fill: Some(fill), stroke: Some(stroke) })
    }

    fn area(&self, corners: Vec<Point>) -> Shape {
        let (fill, stroke) = self.dress();
        Shape::Path(Path {
            runs: vec![corners],
            closed: true,
            fill: Some(fill),
            stroke: Some(stroke),
        })
    }

    fn cross(&self, ends: &[Point]) -> Vec<Shape> {
        let runs = vec![vec![ends[0], ends[2]], vec![ends[1], ends[3]]];
        let lines = |stroke: Stroke| {
            let stroke = Some(stroke);
            Shape::Path(Path { runs: runs.clone(), closed: false, fill: None, stroke })
        };
        let edge = style::MARKER_LINE + 2.0 * style::MARKER_EDGE;
        vec![
            lines(Stroke::solid(style::PAPER, edge)),
            lines(Stroke::solid(self.colour, style::MARKER_LINE)),
        ]
    }
}

/// Directions of evenly spread corners, in turns from straight up.
fn turns(count: u32, first: f64) -> Vec<f64> {
    (0..count).map(|i| first + f64::from(i) / f64::from(count)).collect()
}

fn around(centre: Point, radius: f64, turns: &[f64]) -> Vec<Point> {
    turns.iter().map(|turn| on_circle(centre, radius, *turn)).collect()
}

fn on_circle(centre: Point, radius: f64, turn: f64) -> Point {
    let (sine, cosine) = (TAU * turn).sin_cos();
    centre.moved(radius * sine, -radius * cosine)
}

fn star(centre: Point, radius: f64) -> Vec<Point> {
    let corner = |i: u32| {
        let radius = if i.is_multiple_of(2) { radius } else { 0.45 * radius };
        on_circle(centre, radius, f64::from(i) / 10.0)
    };
    (0..10).map(corner).collect()
}
