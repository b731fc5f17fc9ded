//! A branch as a polyline through its samples and the special points between them.
//!
//! Samples lie at the steps of a continuation; stability changes, and curves turn, at special points
//! between two of them. Whoever tells where a stretch begins or ends needs those.

use halfshaft_results::{Branch, SpecialKind, SpecialPoint};

use super::{Reading, Sample, bounds};

/// One point of the course of a branch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stop {
    pub(crate) sample: Sample,
    /// What happens there; `None` at a sample.
    pub(crate) kind: Option<SpecialKind>,
}

/// What changes stability or turns the curve.
const CHANGES: [SpecialKind; 4] = [
    SpecialKind::Fold,
    SpecialKind::PeriodDoubling,
    SpecialKind::NeimarkSacker,
    SpecialKind::BranchPoint,
];

impl Reading<'_> {
    /// The courses of all branches, one for each.
    pub(crate) fn courses(&self) -> Vec<Vec<Stop>> {
        let samples = self.samples();
        let scale = |of: fn(&Sample) -> f64| {
            bounds(samples.iter().map(of)).map_or(1.0, |(low, high)| high - low).max(1e-300)
        };
        let scales = (scale(|sample| sample.x), scale(|sample| sample.swing));
        let branches = self.result.branches.iter().enumerate();
        branches
            .map(|(index, branch)| {
                let own = samples.iter().filter(|sample| sample.branch == index).copied().collect();
                self.course(branch, own, scales)
            })
            .collect()
    }

    fn course(&self, branch: &Branch, samples: Vec<Sample>, scales: (f64, f64)) -> Vec<Stop> {
        let mut stops: Vec<Stop> =
            samples.into_iter().map(|sample| Stop { sample, kind: None }).collect();
        // A branch that closes on itself goes on from its last sample to its first.
        if branch.closed
            && let Some(first) = stops.first().copied()
        {
            stops.push(first);
        }
        let points = branch.special_points.iter().filter(|point| CHANGES.contains(&point.kind));
        for point in points {
            self.insert(&mut stops, point, scales);
        }
        stops
    }

    /// Puts a special point between the two stops that it makes the least detour for.
    fn insert(&self, stops: &mut Vec<Stop>, point: &SpecialPoint, scales: (f64, f64)) {
        let swing = point.value(&self.swing_column()).or_else(|| point.value(&self.column()));
        let (Some(x), Some(swing)) = (point.value(&self.x.column), swing) else { return };
        let far =
            |a: &Sample, b: (f64, f64)| ((a.x - b.0) / scales.0).hypot((a.swing - b.1) / scales.1);
        let detour = |pair: &[Stop]| {
            let (a, b) = (&pair[0].sample, &pair[1].sample);
            far(a, (x, swing)) + far(b, (x, swing)) - far(a, (b.x, b.swing))
        };
        let pairs = stops.windows(2).enumerate().map(|(at, pair)| (at, detour(pair)));
        let Some((at, _)) = pairs.min_by(|a, b| a.1.total_cmp(&b.1)) else { return };
        let (a, b) = (stops[at].sample, stops[at + 1].sample);
        let sample =
            Sample { x, swing, stable: a.stable && b.stable, multiplier: None, branch: a.branch };
        stops.insert(at + 1, Stop { sample, kind: Some(point.kind) });
    }
}

/// Whether the stretch between two neighbouring stops is stable: a special point ends a stretch and
/// belongs to both sides.
pub(crate) fn holds(from: &Stop, to: &Stop) -> bool {
    match (from.kind, to.kind) {
        (None, None) => from.sample.stable && to.sample.stable,
        (None, Some(_)) => from.sample.stable,
        (Some(_), None) => to.sample.stable,
        (Some(_), Some(_)) => false,
    }
}

#[cfg(test)]
mod tests {
    use halfshaft_results::{Named, SpecialKind, SpecialPoint, Status};

    use super::holds;
    use crate::account::periodic::{most_coexisting, unstable_gaps};
    use crate::made;
    use crate::reading::Reading;

    fn point(kind: SpecialKind, x: f64, swing: f64) -> SpecialPoint {
        let mut values = Named::default();
        values.insert("frequency".to_owned(), x);
        values.insert("spring.twist.amplitude".to_owned(), swing);
        SpecialPoint::new(kind, Status::Located, values)
    }

    /// Oracle: by hand: stability is lost at 2.25 and won back at 3.75, between samples at whole
    /// speeds.
    #[test]
    fn a_gap_ends_at_the_special_points() {
        let rows = [(1.0, 1.0, true), (2.0, 2.0, true), (3.0, 2.0, false), (4.0, 1.0, true)];
        let rows = [rows.as_slice(), &[(5.0, 0.5, true)]].concat();
        let points = vec![
            point(SpecialKind::NeimarkSacker, 2.25, 2.0),
            point(SpecialKind::NeimarkSacker, 3.75, 1.25),
        ];
        let result = made::resonance(&[(&rows, points)]);
        let reading = Reading::of(&result);
        assert_eq!(unstable_gaps(&reading), vec![(2.25, 3.75)]);
        let course = &reading.courses()[0];
        let held = course.windows(2).filter(|pair| holds(&pair[0], &pair[1])).count();
        assert_eq!((course.len(), held), (7, 4));
    }

    /// Oracle: by hand: an S that turns at 3.3 and at 1.6, past its samples at whole speeds.
    #[test]
    fn responses_exist_side_by_side_between_the_folds() {
        let rows = [
            (1.0, 0.5, true),
            (2.0, 1.0, true),
            (3.0, 1.5, true),
            (3.0, 2.0, false),
            (2.0, 2.5, false),
            (2.0, 3.0, true),
            (3.0, 3.5, true),
            (4.0, 4.0, true),
        ];
        let points = vec![point(SpecialKind::Fold, 3.3, 1.75), point(SpecialKind::Fold, 1.6, 2.75)];
        let result = made::resonance(&[(&rows, points)]);
        let reading = Reading::of(&result);
        assert_eq!(most_coexisting(&reading), Some((3, 1.6, 3.3)));
        assert!(unstable_gaps(&reading).is_empty());
    }
}
