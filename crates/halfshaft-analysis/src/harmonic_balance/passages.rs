//! Where a curve over the drive passes drive 1 between two of its samples.

use super::segment::Segment;
use super::tracer::{Sample, Tracer, length};

/// Halvings of the way between two samples.
const HALVINGS: usize = 8;
/// Part of the way between two samples by which the cubic may miss the curve.
const MISSED: f64 = 0.2;
/// A turn of the cubic this near to drive 1 may be one beyond it on the curve.
const NEARLY: f64 = 0.1;
/// Responses this near to each other, relative, are one.
const SAME: f64 = 1e-6;

/// Responses of drive 1 between two samples: two where the curve turns between them beyond 1.
pub(super) fn passages(tracer: &mut Tracer<'_, '_>, from: &Sample, to: &Sample) -> Vec<Vec<f64>> {
    let crosses = |a: &Sample, b: &Sample| (a.p - 1.0) * (b.p - 1.0) <= 0.0 && a.p != b.p;
    if crosses(from, to) {
        return passage(tracer, from, to, None).into_iter().collect();
    }
    if from.tangent_p * to.tangent_p >= 0.0 {
        return Vec::new();
    }
    let segment = Segment::new(tracer, (from, to), &from.set);
    let below = from.p < 1.0;
    let beyond = |part: &f64| {
        let turn = segment.parameter(*part);
        (turn < 1.0) != below || (turn - 1.0).abs() < NEARLY
    };
    let Some(part) = segment.turns().into_iter().find(beyond) else { return Vec::new() };
    let Ok(middle) = tracer.between(&segment, part, None) else { return Vec::new() };
    if !crosses(from, &middle) {
        return Vec::new();
    }
    let first = passage(tracer, from, &middle, None);
    let second = passage(tracer, &middle, to, first.as_deref());
    first.into_iter().chain(second).collect()
}

/// The response of drive 1 between two samples on different sides of it, other than one known.
fn passage(
    tracer: &mut Tracer<'_, '_>,
    from: &Sample,
    to: &Sample,
    known: Option<&[f64]>,
) -> Option<Vec<f64>> {
    let is_new = |u: &Vec<f64>| known.is_none_or(|known| apart(u, known) > SAME * length(u));
    let segment = Segment::new(tracer, (from, to), &from.set);
    let chord = apart(&from.u, &to.u);
    let below = from.p < 1.0;
    let part = Segment::zero(|part| segment.parameter(part) - 1.0);
    let found = part.and_then(|part| {
        at_full_drive(tracer, &segment.guess(part).0, MISSED * chord).filter(is_new)
    });
    if found.is_some() {
        return found;
    }
    // The curve bends between them: halve the way, on the curve, until it does no more.
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..HALVINGS {
        let middle = f64::midpoint(low, high);
        let sample = tracer.between(&segment, middle, None).ok()?;
        let reach = (high - low) * MISSED * chord;
        if let Some(u) = at_full_drive(tracer, &sample.u, reach).filter(is_new) {
            return Some(u);
        }
        if (sample.p < 1.0) == below { low = middle } else { high = middle }
    }
    None
}

/// The response of drive 1 from a guess, no further from it than that.
fn at_full_drive(tracer: &mut Tracer<'_, '_>, guess: &[f64], reach: f64) -> Option<Vec<f64>> {
    let mut u = guess.to_vec();
    tracer.problem.at(&mut u, 1.0, length(guess)).ok()?;
    (apart(&u, guess) <= reach).then_some(u)
}

fn apart(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}
