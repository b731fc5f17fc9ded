//! Areas cut at the border of a box.
//!
//! Method: I. E. Sutherland and G. W. Hodgman, "Reentrant polygon clipping", Communications of the
//! ACM 17 (1974). Where a hollow shape falls apart, its parts stay joined by lines of no width along
//! the border, which a filled area does not show.

use super::{Point, Rect, clip};

/// The part of a closed polygon inside the box; empty if nothing is left.
pub(crate) fn clipped(corners: &[Point], bounds: &Rect) -> Vec<Point> {
    let everywhere = Rect { left: -FAR, top: -FAR, right: FAR, bottom: FAR };
    let halves = [
        Rect { left: bounds.left, ..everywhere },
        Rect { top: bounds.top, ..everywhere },
        Rect { right: bounds.right, ..everywhere },
        Rect { bottom: bounds.bottom, ..everywhere },
    ];
    halves.iter().fold(corners.to_vec(), |corners, half| inside(&corners, half))
}

/// Beyond every coordinate, so that a half plane can be written as a box.
const FAR: f64 = f64::MAX;

fn inside(corners: &[Point], half: &Rect) -> Vec<Point> {
    let mut kept: Vec<Point> = Vec::with_capacity(corners.len() + 2);
    let ends = corners.iter().cycle().skip(1);
    for (&from, &to) in corners.iter().zip(ends) {
        if let Some((from, to)) = clip::segment(from, to, half) {
            if kept.last() != Some(&from) {
                kept.push(from);
            }
            kept.push(to);
        }
    }
    if kept.len() > 1 && kept.first() == kept.last() {
        kept.pop();
    }
    kept
}

/// Area of a polygon, for tests and for leaving out what cannot be seen.
pub(crate) fn area(corners: &[Point]) -> f64 {
    let ends = corners.iter().cycle().skip(1);
    let twice: f64 = corners.iter().zip(ends).map(|(a, b)| a.x * b.y - b.x * a.y).sum();
    0.5 * twice.abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    const UNIT: Rect = Rect { left: 0.0, top: 0.0, right: 1.0, bottom: 1.0 };

    fn polygon(corners: &[(f64, f64)]) -> Vec<Point> {
        corners.iter().map(|&(x, y)| Point::new(x, y)).collect()
    }

    /// Oracle: areas by hand: a box around it, half of it, a triangle over one corner, a U whose
    /// two arms (each 0.25 wide) reach 0.5 into the box from below, one that misses it.
    #[test]
    fn areas_are_exact() {
        let cases: [(&[(f64, f64)], f64); 5] = [
            (&[(-1.0, -1.0), (2.0, -1.0), (2.0, 2.0), (-1.0, 2.0)], 1.0),
            (&[(0.5, -1.0), (2.0, -1.0), (2.0, 2.0), (0.5, 2.0)], 0.5),
            (&[(0.5, 0.0), (1.5, 0.0), (0.5, 1.0)], 0.375),
            (
                &[
                    (0.0, 2.0),
                    (0.0, 0.5),
                    (0.25, 0.5),
                    (0.25, 1.5),
                    (0.75, 1.5),
                    (0.75, 0.5),
                    (1.0, 0.5),
                    (1.0, 2.0),
                ],
                0.25,
            ),
            (&[(2.0, 2.0), (3.0, 2.0), (3.0, 3.0)], 0.0),
        ];
        for (corners, expected) in cases {
            let found = area(&clipped(&polygon(corners), &UNIT));
            assert!((found - expected).abs() < 1e-12, "{corners:?}: {found} not {expected}");
        }
        assert!(clipped(&[], &UNIT).is_empty());
    }
}
