//! Where slow sweeps lose stability other than in a jump, and what the line does from there.

use halfshaft_results::{Branch, SpecialKind};

use crate::reading::{Reading, Stop, bounds, holds};

/// One sentence for each loss of stability on the responses that a slow sweep shows.
pub(crate) fn told(reading: &Reading<'_>) -> Vec<String> {
    let courses = reading.courses().into_iter().zip(&reading.result.branches);
    let shown = courses.filter(|(_, branch)| branch.periods <= 1 && !branch.is_detached());
    let mut losses: Vec<(f64, String)> =
        shown.flat_map(|(course, _)| of_course(reading, &course)).collect();
    losses.sort_by(|a, b| a.0.total_cmp(&b.0));
    losses.into_iter().map(|(_, sentence)| sentence).collect()
}

fn of_course(reading: &Reading<'_>, course: &[Stop]) -> Vec<(f64, String)> {
    let loss = |triple: &[Stop]| {
        let [before, point, behind] = triple else { return None };
        let consequence = consequence(point.kind?)?;
        // Where it holds on one side only, that side is where a sweep comes from.
        let from = match (holds(before, point), holds(point, behind)) {
            (true, false) => before,
            (false, true) => behind,
            _ => return None,
        };
        let (x, rising) = (point.sample.x, from.sample.x < point.sample.x);
        let sweep = match (reading.x.is_speed(), rising) {
            (true, true) => "Sweeping up".to_owned(),
            (true, false) => "Sweeping down".to_owned(),
            (false, true) => format!("Raising the {}", reading.x.name()),
            (false, false) => format!("Lowering the {}", reading.x.name()),
        };
        let place = reading.x.told(x);
        Some((x, format!("{sweep}, stability is lost at {place} {consequence}.")))
    };
    course.windows(3).filter_map(loss).collect()
}

/// By what stability is lost and what the motion becomes; folds are jumps, which are told as such.
fn consequence(kind: SpecialKind) -> Option<&'static str> {
    match kind {
        SpecialKind::NeimarkSacker => {
            Some("by a Neimark-Sacker bifurcation: the motion becomes quasi-periodic")
        }
        SpecialKind::PeriodDoubling => Some("by a period doubling: the motion doubles its period"),
        SpecialKind::BranchPoint => {
            Some("at a branch point: the motion goes over to the response that crosses there")
        }
        _ => None,
    }
}

/// That responses of broken mirror symmetry come in pairs of which one is listed.
pub(super) fn twins(reading: &Reading<'_>) -> Vec<String> {
    let branches = &reading.result.branches;
    let symmetric = |branch: &Branch| {
        let odd = mean(reading, branch).is_some_and(|mean| mean <= MIRRORED);
        let parts = branch.special_points.iter().any(|p| p.kind == SpecialKind::BranchPoint);
        odd && parts
    };
    if !branches.iter().any(symmetric) {
        return Vec::new();
    }
    let broken = |branch: &&Branch| {
        branch.origin.starts_with("branch point")
            && mean(reading, branch).is_some_and(|mean| mean > MIRRORED)
    };
    let count = branches.iter().filter(broken).count();
    if count == 0 {
        return Vec::new();
    }
    let which = if count == 1 { "the response" } else { "every response" };
    vec![format!(
        "At a branch point the mirror symmetry of the response breaks: {which} that begins there has a \
         mirrored twin, its twist of the opposite sign half a period later, which is not listed."
    )]
}

/// The mean twist is none where it is below this part of the swing.
const MIRRORED: f64 = 1e-6;

/// The largest mean of the twist, relative to its largest swing; `None` where it is not known.
fn mean(reading: &Reading<'_>, branch: &Branch) -> Option<f64> {
    let channel = reading.channel.as_ref()?;
    let of = |measure: &str| branch.values(&format!("{channel}.{measure}")).iter().copied();
    let mean = bounds(of("mean").map(f64::abs))?.1;
    let swing = bounds(of("amplitude"))?.1;
    Some(mean / swing)
}

#[cfg(test)]
mod tests {
    use halfshaft_results::{Named, SpecialKind, SpecialPoint, Status};

    use super::{told, twins};
    use crate::made;
    use crate::reading::Reading;

    fn point(kind: SpecialKind, x: f64, swing: f64) -> SpecialPoint {
        let mut values = Named::default();
        values.insert("frequency".to_owned(), x);
        values.insert("spring.twist.amplitude".to_owned(), swing);
        SpecialPoint::new(kind, Status::Located, values)
    }

    const ROWS: [(f64, f64, bool); 5] =
        [(1.0, 1.0, true), (2.0, 2.0, true), (3.0, 2.0, false), (4.0, 1.0, true), (5.0, 0.5, true)];

    /// Oracle: by hand: sweeping up the stable stretch ends at 2.5 rad/s, 23.873 rpm; sweeping down the
    /// other one ends at 3.5 rad/s, 33.423 rpm.
    #[test]
    fn a_loss_of_stability_is_told_for_both_directions() {
        let points = vec![
            point(SpecialKind::NeimarkSacker, 2.5, 2.0),
            point(SpecialKind::PeriodDoubling, 3.5, 1.5),
        ];
        let result = made::resonance(&[(&ROWS, points)]);
        let text = told(&Reading::of(&result)).join(" ");
        assert_eq!(
            text,
            "Sweeping up, stability is lost at 23.873\u{a0}rpm (2.5\u{a0}rad/s) by a Neimark-Sacker \
             bifurcation: the motion becomes quasi-periodic. Sweeping down, stability is lost at \
             33.423\u{a0}rpm (3.5\u{a0}rad/s) by a period doubling: the motion doubles its period."
        );
    }

    /// Oracle: the definition: a response without mean that others of the opposite mean part from.
    #[test]
    fn broken_symmetry_has_a_twin() {
        let points = vec![point(SpecialKind::BranchPoint, 2.5, 2.0)];
        let mut result = made::resonance(&[(&ROWS, points), (&ROWS[1..4], Vec::new())]);
        assert!(twins(&Reading::of(&result)).is_empty());
        let parted = &mut result.branches[1];
        parted.origin = "branch point at 2.5 rad/s".to_owned();
        let mean = parted.columns.iter_mut().find(|column| column.name.ends_with(".mean"));
        mean.unwrap().values[1] = -0.3;
        let text = twins(&Reading::of(&result)).join(" ");
        assert!(text.contains("has a mirrored twin"), "{text}");
    }
}
