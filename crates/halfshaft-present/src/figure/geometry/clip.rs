//! Lines cut at the border of a box.
//!
//! Method: Y.-D. Liang and B. A. Barsky, "A new concept and method for line clipping", ACM
//! Transactions on Graphics 3 (1984). Coordinates may be as large as `f64` allows: differences are
//! formed from halves, and a cut end lies exactly on the border.

use super::{Point, Rect};

/// Cuts the line through the points at the border; the pieces inside are returned in order.
/// `None` and places that are not finite break the line. A point on its own is a piece of one.
pub(crate) fn polyline(points: impl IntoIterator<Item = Point>, bounds: &Rect) -> Vec<Vec<Point>> {
    let mut pieces = Pieces::default();
    let mut previous: Option<Point> = None;
    let mut alone = true;
    for point in points {
        if !point.is_finite() {
            pieces.end_line(previous.filter(|p| alone && bounds.contains(*p)));
            previous = None;
            alone = true;
            continue;
        }
        if let Some(start) = previous {
            alone = false;
            match segment(start, point, bounds) {
                Some((from, to)) => pieces.add(from, to),
                None => pieces.end(),
            }
        }
        previous = Some(point);
    }
    pieces.end_line(previous.filter(|p| alone && bounds.contains(*p)));
    pieces.done
}

#[derive(Default)]
struct Pieces {
    done: Vec<Vec<Point>>,
    open: Vec<Point>,
}

impl Pieces {
    fn add(&mut self, from: Point, to: Point) {
        if self.open.last() != Some(&from) {
            self.end();
            self.open.push(from);
        }
        self.open.push(to);
    }

    fn end(&mut self) {
        if !self.open.is_empty() {
            self.done.push(std::mem::take(&mut self.open));
        }
    }

    fn end_line(&mut self, lonely: Option<Point>) {
        self.end();
        self.done.extend(lonely.map(|point| vec![point]));
    }
}

/// The part of a segment inside the box.
pub(crate) fn segment(from: Point, to: Point, bounds: &Rect) -> Option<(Point, Point)> {
    if bounds.contains(from) && bounds.contains(to) {
        return Some((from, to));
    }
    let (mut enter, mut leave) = (Cut::at(0.0), Cut::at(1.0));
    let sides = [
        (from.x, to.x, bounds.left, bounds.right, Side::Upright),
        (from.y, to.y, bounds.top, bounds.bottom, Side::Level),
    ];
    for (start, end, low, high, side) in sides {
        let half = 0.5 * end - 0.5 * start;
        if half == 0.0 {
            if start < low || start > high {
                return None;
            }
            continue;
        }
        let (first, last) = if half > 0.0 { (low, high) } else { (high, low) };
        let share = |border: f64| (0.5 * border - 0.5 * start) / half;
        if share(first) > enter.share {
            enter = Cut { share: share(first), border: Some((side, first)) };
        }
        if share(last) < leave.share {
            leave = Cut { share: share(last), border: Some((side, last)) };
        }
    }
    (enter.share <= leave.share)
        .then(|| (enter.place(from, to, bounds), leave.place(from, to, bounds)))
}

#[derive(Clone, Copy)]
enum Side {
    Upright,
    Level,
}

/// Where along a segment a border is crossed.
#[derive(Clone, Copy)]
struct Cut {
    share: f64,
    border: Option<(Side, f64)>,
}

impl Cut {
    fn at(share: f64) -> Self {
        Self { share, border: None }
    }

    fn place(self, from: Point, to: Point, bounds: &Rect) -> Point {
        // The weighted sum cannot overflow, unlike from + share * (to - from).
        let between = |a: f64, b: f64| (1.0 - self.share) * a + self.share * b;
        let mut place = Point::new(between(from.x, to.x), between(from.y, to.y));
        match self.border {
            None if self.share == 0.0 => place = from,
            None => place = to,
            Some((Side::Upright, x)) => place.x = x,
            Some((Side::Level, y)) => place.y = y,
        }
        Point::new(
            place.x.clamp(bounds.left, bounds.right),
            place.y.clamp(bounds.top, bounds.bottom),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::{prop_assert, proptest};

    const UNIT: Rect = Rect { left: 0.0, top: 0.0, right: 1.0, bottom: 1.0 };

    /// Oracle: geometry by hand. The line y = x/2 + 1/4 enters at (0, 1/4), leaves at (1, 3/4); the
    /// line x + y = 1.5 cuts a corner; the line x + y = 2.5 passes outside.
    #[test]
    fn cuts_are_exact() {
        let cut = |a: (f64, f64), b: (f64, f64)| {
            segment(Point::new(a.0, a.1), Point::new(b.0, b.1), &UNIT)
                .map(|(p, q)| (p.x, p.y, q.x, q.y))
        };
        assert_eq!(cut((-1.0, -0.25), (3.0, 1.75)), Some((0.0, 0.25, 1.0, 0.75)));
        assert_eq!(cut((0.0, 1.5), (1.5, 0.0)), Some((0.5, 1.0, 1.0, 0.5)));
        assert_eq!(cut((0.0, 2.5), (2.5, 0.0)), None);
        assert_eq!(cut((0.5, 2.0), (0.5, 1.5)), None);
        assert_eq!(cut((0.25, 0.25), (0.25, 9.0)), Some((0.25, 0.25, 0.25, 1.0)));
    }

    /// Oracle: symmetry; the line through the centre from -big to +big runs corner to corner.
    #[test]
    fn the_largest_numbers_do_not_overflow() {
        let big = f64::MAX;
        let (from, to) = segment(Point::new(-big, 0.5), Point::new(big, 0.5), &UNIT).unwrap();
        assert_eq!((from.x, from.y, to.x, to.y), (0.0, 0.5, 1.0, 0.5));
        assert!(segment(Point::new(-big, -big), Point::new(big, big), &UNIT).is_some());
    }

    /// Oracle: by hand: a zigzag leaves the box twice and is broken once.
    #[test]
    fn a_line_falls_into_pieces() {
        let points = [(0.5, 0.5), (0.5, 2.0), (0.75, 0.5), (f64::NAN, 0.0), (0.25, 0.25)];
        let pieces = polyline(points.map(|(x, y)| Point::new(x, y)), &UNIT);
        assert_eq!(pieces.iter().map(Vec::len).collect::<Vec<_>>(), [2, 2, 1]);
    }

    proptest! {
        /// Oracle: a point of the segment is inside the box just if it lies between the cut ends.
        #[test]
        fn what_is_kept_is_what_is_inside(
            a in -3.0..3.0_f64, b in -3.0..3.0_f64, c in -3.0..3.0_f64, d in -3.0..3.0_f64,
        ) {
            let (from, to) = (Point::new(a, b), Point::new(c, d));
            let kept = segment(from, to, &UNIT);
            for i in 0..=100 {
                let t = f64::from(i) / 100.0;
                let place = Point::new(a + t * (c - a), b + t * (d - b));
                if UNIT.grown(-1e-9).contains(place) {
                    let near = kept.is_some_and(|(p, q)| {
                        Rect {
                            left: p.x.min(q.x), right: p.x.max(q.x),
                            top: p.y.min(q.y), bottom: p.y.max(q.y),
                        }.grown(1e-9).contains(place)
                    });
                    prop_assert!(near);
                }
            }
            if let Some((p, q)) = kept {
                prop_assert!(UNIT.contains(p) && UNIT.contains(q));
            }
        }
    }
}
