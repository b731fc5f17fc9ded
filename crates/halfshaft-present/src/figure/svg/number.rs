//! Short numbers and path data.

use std::fmt::{self, Display, Write};

use crate::figure::geometry::Point;

/// A length in hundredths of a point. Steps between such numbers are exact, so a path of a million
/// relative steps does not drift.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Hundredths(i64);

impl Hundredths {
    pub(super) fn of(length: f64) -> Self {
        Self((100.0 * length).round() as i64)
    }
}

impl Display for Hundredths {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sign = if self.0 < 0 { "-" } else { "" };
        let (whole, rest) = (self.0.unsigned_abs() / 100, self.0.unsigned_abs() % 100);
        match rest {
            0 => write!(f, "{sign}{whole}"),
            rest if rest % 10 == 0 => write!(f, "{sign}{whole}.{}", rest / 10),
            rest => write!(f, "{sign}{whole}.{rest:02}"),
        }
    }
}

/// Appends the path through the points: one absolute place, then steps.
pub(super) fn path_data(out: &mut String, points: &[Point], closed: bool) {
    let mut places = points.iter().map(|p| (Hundredths::of(p.x), Hundredths::of(p.y)));
    let Some(start) = places.next() else { return };
    let _ = write!(out, "M{} {}", start.0, start.1);
    let mut last = start;
    let mut letter = "l";
    for place in places {
        if place == last {
            continue;
        }
        out.push_str(letter);
        push_step(out, place.0.0 - last.0.0);
        if place.1.0 >= last.1.0 {
            out.push(' ');
        }
        push_step(out, place.1.0 - last.1.0);
        letter = " ";
        last = place;
    }
    if closed {
        out.push('z');
    }
}

/// A number without the zero before its decimal point.
fn push_step(out: &mut String, step: i64) {
    let text = Hundredths(step).to_string();
    match (text.strip_prefix("0."), text.strip_prefix("-0.")) {
        (Some(rest), _) => {
            let _ = write!(out, ".{rest}");
        }
        (_, Some(rest)) => {
            let _ = write!(out, "-.{rest}");
        }
        _ => out.push_str(&text),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Oracle: by hand.
    #[test]
    fn numbers_are_short() {
        let shown =
            [0.0, -0.004, 1.5, -0.25, 12.345, 100.0, 0.07].map(|v| Hundredths::of(v).to_string());
        assert_eq!(shown, ["0", "0", "1.5", "-0.25", "12.35", "100", "0.07"]);
    }

    /// Oracle: by hand, and the sum of the rounded steps is the rounded end.
    #[test]
    fn paths_are_relative_and_do_not_drift() {
        let mut data = String::new();
        let points = [(1.0, 2.0), (1.5, 1.75), (1.5, 1.751), (0.5, 3.0)];
        path_data(&mut data, &points.map(|(x, y)| Point::new(x, y)), true);
        assert_eq!(data, "M1 2l.5-.25 -1 1.25z");
        let long: Vec<Point> = (0..10_000).map(|i| Point::new(f64::from(i) / 300.0, 0.0)).collect();
        let mut data = String::new();
        path_data(&mut data, &long, false);
        let steps = data.trim_start_matches("M0 0l").split(' ').step_by(2);
        let end: f64 = steps.map(|step| step.parse::<f64>().unwrap()).sum();
        assert!((end - 33.33).abs() < 1e-6);
    }
}
