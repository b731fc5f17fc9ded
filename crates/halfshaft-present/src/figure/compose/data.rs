//! Regions, reference lines, curves and points.

use std::collections::BTreeSet;

use super::markers::Look;
use super::{Canvas, style};
use crate::figure::geometry::{Point, Rect, clip, polygon, simplify};
use crate::figure::item::{Curve, Direction, Item, Points, Reference, Region};
use crate::figure::panel::Panel;
use crate::figure::scene::{Disc, Fill, Path, Role, Shape};

/// Lines stay this close to the exact curve, in points: a fifteenth of a pixel of a screen.
const TOLERANCE: f64 = 0.05;
/// Corners of one curve from which on the tolerance is relaxed, up to eight times.
pub(in crate::figure) const BUDGET: usize = 20_000;
/// With more points than this, those that nearly cover each other are drawn once: numbers, and how
/// near they lie in points.
const CROWDS: [(usize, f64); 2] = [(20_000, 1.0), (2_000, 0.25)];

impl Canvas<'_> {
    /// Fills the areas.
    pub(super) fn regions(&mut self, panel: &Panel) {
        for item in &panel.items {
            let Item::Region(region) = item else { continue };
            let places = region.x.iter().zip(&region.y).map(|(&x, &y)| self.place(x, y));
            let places: Vec<Point> = places.collect();
            let areas = places
                .split(|place| !place.is_finite())
                .map(|corners| polygon::clipped(corners, &self.rect))
                .map(|corners| simplify::within_budget(&corners, TOLERANCE, BUDGET));
            let runs: Vec<Vec<Point>> =
                areas.filter(|corners| polygon::area(corners) > 0.0).collect();
            if !runs.is_empty() {
                self.shows_data = true;
                let path = Path { runs, closed: true, fill: Some(fill(region)), stroke: None };
                self.add(Role::Region, Shape::Path(path));
            }
        }
    }

    /// Draws the straight lines across the panel.
    pub(super) fn references(&mut self, panel: &Panel) {
        for item in &panel.items {
            let Item::Reference(reference) = item else { continue };
            if let Some((from, to)) = self.reference_line(reference) {
                let run = vec![from, to];
                self.ink.add_line(&run);
                self.shows_data = true;
                let colour = reference.colour.rgb();
                let stroke = style::stroke(colour, style::REFERENCE_WIDTH, reference.line);
                self.lines(Role::Reference, vec![run], stroke);
            }
        }
    }

    /// The ends of a straight line, if it lies in the panel.
    pub(super) fn reference_line(&self, reference: &Reference) -> Option<(Point, Point)> {
        let Rect { left, top, right, bottom } = self.rect;
        let value = reference.value;
        match reference.axis {
            Direction::Horizontal => {
                let y = self.place(f64::NAN, value).y;
                let inside = y >= top - 0.1 && y <= bottom + 0.1;
                inside.then(|| (Point::new(left, y), Point::new(right, y)))
            }
            Direction::Vertical => {
                let x = self.place(value, f64::NAN).x;
                let inside = x >= left - 0.1 && x <= right + 0.1;
                inside.then(|| (Point::new(x, bottom), Point::new(x, top)))
            }
        }
    }

    /// Draws the curves.
    pub(super) fn curves(&mut self, panel: &Panel) {
        for item in &panel.items {
            let Item::Curve(curve) = item else { continue };
            let (dots, runs) = self.pieces(curve);
            self.shows_data |= !(dots.is_empty() && runs.is_empty());
            for run in &runs {
                self.ink.add_line(run);
            }
            let stroke = style::stroke(curve.colour.rgb(), curve.width, curve.line);
            let fill = Some(Fill::solid(stroke.colour));
            let radius = 0.75 * stroke.width;
            self.lines(Role::Curve, runs, stroke);
            for centre in dots {
                let disc = Disc { centre, radius, fill, stroke: None };
                self.add(Role::Curve, Shape::Disc(disc));
            }
        }
    }

    /// The visible pieces of a curve: points on their own, and lines.
    fn pieces(&self, curve: &Curve) -> (Vec<Point>, Vec<Vec<Point>>) {
        let places = curve.x.iter().zip(&curve.y).map(|(&x, &y)| self.place(x, y));
        let pieces = clip::polyline(places, &self.rect);
        let mut budget = BUDGET;
        let (mut dots, mut runs) = (Vec::new(), Vec::new());
        for piece in pieces {
            if let [dot] = piece[..] {
                dots.push(dot);
            } else {
                let run = simplify::within_budget(&piece, TOLERANCE, budget.max(1000));
                budget = budget.saturating_sub(run.len());
                runs.push(run);
            }
        }
        (thinned(dots, 0.5), runs)
    }

    /// Draws the points.
    pub(super) fn points(&mut self, panel: &Panel) {
        for item in &panel.items {
            let Item::Points(points) = item else { continue };
            let look = Look::of(points);
            let mut places: Vec<Point> =
                self.visible(points).into_iter().map(|(_, place)| place).collect();
            if let Some((_, near)) = CROWDS.iter().find(|(count, _)| places.len() > *count) {
                places = thinned(places, *near);
            }
            self.shows_data |= !places.is_empty();
            let reach = look.radius();
            for place in places {
                let around = Rect { left: place.x, top: place.y, right: place.x, bottom: place.y };
                self.ink.add_box(&around.grown(reach));
                for shape in look.shapes(place) {
                    self.add(Role::Marker, shape);
                }
            }
        }
    }

    /// The points that lie in the panel, with their numbers.
    pub(super) fn visible(&self, points: &Points) -> Vec<(usize, Point)> {
        let border = self.rect.grown(0.1);
        let places = points.x.iter().zip(&points.y).map(|(&x, &y)| self.place(x, y));
        places.enumerate().filter(|(_, place)| border.contains(*place)).collect()
    }
}

/// How a region is filled.
pub(super) fn fill(region: &Region) -> Fill {
    let opacity = if region.opacity.is_finite() { region.opacity.clamp(0.0, 1.0) } else { 0.2 };
    Fill { colour: region.colour.rgb(), opacity }
}

/// One point of each square of this size.
fn thinned(points: Vec<Point>, size: f64) -> Vec<Point> {
    let mut taken = BTreeSet::new();
    let square = |point: &Point| ((point.x / size) as i64, (point.y / size) as i64);
    points.into_iter().filter(|point| taken.insert(square(point))).collect()
}

impl Look {
    /// How points are drawn.
    pub(super) fn of(points: &Points) -> Self {
        Self {
            marker: points.marker,
            filled: points.filled,
            colour: points.colour.rgb(),
            size: points.size,
        }
    }
}
