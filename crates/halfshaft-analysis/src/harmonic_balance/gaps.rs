//! Stretches of branches over a range, and what of it they leave.

/// Part of the range below which a gap is none.
const NARROW: f64 = 1e-3;

/// The stable part of the stretch between two neighbours of a branch, given as parameter and
/// stability, with the special point between them where there is one.
pub(super) fn stretch(
    from: (f64, bool),
    to: (f64, bool),
    special: Option<f64>,
) -> Option<(f64, f64)> {
    let (low, high) = match (from.1, to.1) {
        (true, true) => (from.0, to.0),
        (true, false) => (from.0, special.unwrap_or(to.0)),
        (false, true) => (special.unwrap_or(to.0), to.0),
        (false, false) => return None,
    };
    Some((low.min(high), low.max(high)))
}

/// What of a range no stretch covers, apart from narrow parts.
pub(super) fn uncovered(mut covered: Vec<(f64, f64)>, (low, high): (f64, f64)) -> Vec<(f64, f64)> {
    covered.sort_by(|a, b| a.0.total_cmp(&b.0));
    let narrow = NARROW * (high - low);
    let mut gaps = Vec::new();
    let mut reached = low;
    for (from, to) in covered {
        if from > reached + narrow {
            gaps.push((reached, from));
        }
        reached = reached.max(to);
    }
    if high > reached + narrow {
        gaps.push((reached, high));
    }
    gaps
}

#[cfg(test)]
mod tests {
    use super::*;

    // Source: by hand.
    #[test]
    fn what_no_stretch_covers_is_left() {
        let covered = vec![(2.0, 3.0), (0.0, 1.0), (2.5, 2.7), (3.0005, 4.0)];
        assert_eq!(uncovered(covered, (0.0, 5.0)), [(1.0, 2.0), (4.0, 5.0)]);
        assert_eq!(uncovered(Vec::new(), (1.0, 2.0)), [(1.0, 2.0)]);
        assert_eq!(stretch((1.0, true), (2.0, false), Some(1.5)), Some((1.0, 1.5)));
        assert_eq!(stretch((1.0, false), (0.0, true), None), Some((0.0, 0.0)));
        assert_eq!(stretch((1.0, false), (2.0, false), None), None);
    }
}
