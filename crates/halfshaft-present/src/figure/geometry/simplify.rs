//! Long lines with fewer corners, never further from the original than a tolerance.
//!
//! Two passes, each linear in the number of points and each allowed half of the tolerance:
//!
//! 1. *Columns.* Of the points that stay in one narrow upright column only the first, the lowest, the
//!    highest and the last are kept; the line between lowest and highest passes all the others within
//!    the width of the column. This bounds the size of a dense oscillation (U. Jugel et al., "M4: a
//!    visualization-oriented time series data aggregation", VLDB 2014).
//! 2. *Sectors.* From a kept point the line goes straight on for as long as one ray passes all points
//!    within the tolerance and the points move away (in the manner of J. Sklansky and V. Gonzalez,
//!    "Fast polygonal approximation of digitized curves", Pattern Recognition 12, 1980).
//!
//! The first, last, leftmost, rightmost, lowest and highest points are always kept.

use super::Point;

/// A line with no kept point moved and no left-out point further than `tolerance` from it.
pub(crate) fn simplified(points: &[Point], tolerance: f64) -> Vec<Point> {
    if points.len() < 3 {
        return points.to_vec();
    }
    let coarse = columns(points, 0.5 * tolerance);
    sectors(&coarse, 0.5 * tolerance)
}

/// As [`simplified`], but with a coarser tolerance, up to eight times, for as long as the line would
/// have more than `budget` corners.
pub(crate) fn within_budget(points: &[Point], tolerance: f64, budget: usize) -> Vec<Point> {
    let mut line = simplified(points, tolerance);
    for coarser in [2.0, 4.0, 8.0] {
        if line.len() <= budget {
            break;
        }
        line = simplified(points, coarser * tolerance);
    }
    line
}

fn columns(points: &[Point], width: f64) -> Vec<Point> {
    let column = |point: &Point| (point.x / width).floor();
    let same_column = |a: &Point, b: &Point| column(a) == column(b);
    let mut kept = Vec::new();
    for group in points.chunk_by(same_column) {
        if group.len() <= 4 {
            kept.extend_from_slice(group);
        } else {
            let mut places = extremes(group);
            places.extend([0, group.len() - 1]);
            places.sort_unstable();
            places.dedup();
            kept.extend(places.into_iter().map(|place| group[place]));
        }
    }
    kept
}

/// Places of the leftmost, rightmost, lowest and highest points.
fn extremes(points: &[Point]) -> Vec<usize> {
    let mut places = [0; 4];
    for (place, point) in points.iter().enumerate() {
        let found = places.map(|p: usize| points[p]);
        let further = [
            point.x < found[0].x,
            point.x > found[1].x,
            point.y < found[2].y,
            point.y > found[3].y,
        ];
        for (kept, further) in places.iter_mut().zip(further) {
            if further {
                *kept = place;
            }
        }
    }
    places.to_vec()
}

fn sectors(points: &[Point], tolerance: f64) -> Vec<Point> {
    let mut pinned = extremes(points);
    pinned.sort_unstable();
    let mut kept = vec![points[0]];
    let mut sector = Sector::from(points[0]);
    for (place, pair) in points.windows(2).enumerate() {
        let (last, next) = (pair[0], pair[1]);
        if !sector.accepts(next) || pinned.binary_search(&place).is_ok() {
            if kept.last() != Some(&last) {
                kept.push(last);
            }
            sector = Sector::from(last);
        }
        sector.include(next, tolerance);
    }
    kept.extend(points.last());
    kept
}

/// The directions in which a ray from `apex` passes all included points within the tolerance.
struct Sector {
    apex: Point,
    reach: f64,
    /// Middle direction of the first constraint; other directions are angles from it.
    axis: Option<Point>,
    from: f64,
    to: f64,
}

impl Sector {
    fn from(apex: Point) -> Self {
        Self { apex, reach: 0.0, axis: None, from: 0.0, to: 0.0 }
    }

    /// Whether the line may run from the apex straight to this point.
    fn accepts(&self, point: Point) -> bool {
        let (dx, dy) = (point.x - self.apex.x, point.y - self.apex.y);
        let inside = match self.axis {
            None => true,
            Some(axis) => {
                let angle = angle_from(axis, dx, dy);
                angle >= self.from && angle <= self.to
            }
        };
        // A line that turns back would be cut short.
        inside && dx.hypot(dy) >= self.reach
    }

    fn include(&mut self, point: Point, tolerance: f64) {
        let (dx, dy) = (point.x - self.apex.x, point.y - self.apex.y);
        let distance = dx.hypot(dy);
        self.reach = self.reach.max(distance);
        // The apex itself is within the tolerance of such a point, whatever the direction.
        if distance <= tolerance {
            return;
        }
        let half = (tolerance / distance).asin();
        match self.axis {
            None => {
                self.axis = Some(Point::new(dx, dy));
                (self.from, self.to) = (-half, half);
            }
            Some(axis) => {
                let angle = angle_from(axis, dx, dy);
                self.from = self.from.max(angle - half);
                self.to = self.to.min(angle + half);
            }
        }
    }
}

fn angle_from(axis: Point, dx: f64, dy: f64) -> f64 {
    (axis.x * dy - axis.y * dx).atan2(axis.x * dx + axis.y * dy)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::collection::vec;
    use proptest::prelude::{prop_assert, proptest};

    fn distance_to_segment(point: Point, from: Point, to: Point) -> f64 {
        let (dx, dy) = (to.x - from.x, to.y - from.y);
        let length = dx * dx + dy * dy;
        let along = (point.x - from.x) * dx + (point.y - from.y) * dy;
        let share = if length > 0.0 { (along / length).clamp(0.0, 1.0) } else { 0.0 };
        (point.x - from.x - share * dx).hypot(point.y - from.y - share * dy)
    }

    fn largest_error(original: &[Point], line: &[Point]) -> f64 {
        let distance = |point: &Point| {
            line.windows(2)
                .map(|ends| distance_to_segment(*point, ends[0], ends[1]))
                .fold(f64::INFINITY, f64::min)
        };
        original.iter().map(distance).fold(0.0, f64::max)
    }

    proptest! {
        /// Oracle: the stated bound, with the distance from every point to the line by definition.
        #[test]
        fn no_point_is_further_than_the_tolerance(
            steps in vec((-1.0..1.0_f64, -1.0..1.0_f64), 3..300),
            size in 0.01..3.0_f64,
            drift in 0.0..0.5_f64,
        ) {
            let mut place = Point::default();
            let walk: Vec<Point> = steps
                .iter()
                .map(|&(dx, dy)| {
                    place = place.moved(size * dx + drift, size * dy);
                    place
                })
                .collect();
            let line = simplified(&walk, 0.05);
            prop_assert!(largest_error(&walk, &line) <= 0.05 + 1e-9);
            prop_assert!(line.first() == walk.first() && line.last() == walk.last());
            prop_assert!(line.iter().all(|p| walk.contains(p)));
            for place in extremes(&walk) {
                prop_assert!(line.contains(&walk[place]));
            }
        }
    }

    /// Oracle: a straight line is its two ends; a spike inside one column keeps its tip.
    #[test]
    fn straight_parts_collapse_and_spikes_stay() {
        let straight: Vec<Point> =
            (0..1000).map(|i| Point::new(f64::from(i), 0.5 * f64::from(i))).collect();
        assert_eq!(simplified(&straight, 0.05).len(), 2);
        let mut spike: Vec<Point> =
            (0..1000).map(|i| Point::new(f64::from(i) * 1e-4, 0.0)).collect();
        spike[500].y = 7.0;
        assert!(simplified(&spike, 0.05).contains(&spike[500]));
    }

    /// Oracle: arithmetic: 400 points of width hold 16,000 columns of 0.025, each keeps at most six.
    /// The budget brings the same line below 20,000 at a tolerance of 0.4.
    #[test]
    fn the_size_of_a_dense_oscillation_is_bounded() {
        let dense: Vec<Point> = (0..1_000_000)
            .map(|i| Point::new(f64::from(i) * 4e-4, 100.0 * f64::from(i).sin()))
            .collect();
        assert!(simplified(&dense, 0.05).len() <= 6 * 16_000);
        assert!(within_budget(&dense, 0.05, 10_000).len() <= 20_000);
    }
}
