//! Where a curve over the drive passes drive 1 between two of its samples.

use super::segment::Segment;
use super::tracer::{Sample, Tracer, length};

/// Halvings of the way between two samples.
const HALVINGS: usize = 8;
/// Halvings by which the cubic between two samples is searched.
const SEARCHED: usize = 40;
/// Part of the way between two samples by which the cubic may miss the curve.
const MISSED: f64 = 0.2;

/// Responses of drive 1 between two samples: two where the curve turns between them beyond 1.
pub(super) fn passages(tracer: &mut Tracer<'_, '_>, from: &Sample, to: &Sample) -> Vec<Vec<f64>> {
    let crosses = |a: &Sample, b: &Sample| (a.p - 1.0) * (b.p - 1.0) <= 0.0 && a.p != b.p;
    if crosses(from, to) {
        return passage(tracer, from, to).into_iter().collect();
    }
    if from.tangent_p * to.tangent_p >= 0.0 {
        return Vec::new();
    }
    let segment = Segment::new(tracer, (from, to), &from.set);
    let below = from.p < 1.0;
    let beyond = |part: &f64| (segment.parameter(*part) < 1.0) != below;
    let Some(part) = segment.turns().into_iter().find(beyond) else { return Vec::new() };
    let Ok(middle) = tracer.between(&segment, part, None) else { return Vec::new() };
    let halves = [(from, &middle), (&middle, to)].into_iter().filter(|(a, b)| crosses(a, b));
    halves.filter_map(|(a, b)| passage(tracer, a, b)).collect()
}

/// The response of drive 1 between two samples on different sides of it.
fn passage(tracer: &mut Tracer<'_, '_>, from: &Sample, to: &Sample) -> Option<Vec<f64>> {
    let segment = Segment::new(tracer, (from, to), &from.set);
    let chord = apart(&from.u, &to.u);
    let below = from.p < 1.0;
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..SEARCHED {
        let middle = f64::midpoint(low, high);
        if (segment.parameter(middle) < 1.0) == below { low = middle } else { high = middle }
    }
    let guess = segment.guess(low).0;
    if let Some(u) = at_full_drive(tracer, &guess, MISSED * chord) {
        return Some(u);
    }
    // The curve bends between them: halve the way, on the curve, until it does no more.
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..HALVINGS {
        let middle = f64::midpoint(low, high);
        let sample = tracer.between(&segment, middle, None).ok()?;
        if let Some(u) = at_full_drive(tracer, &sample.u, (high - low) * MISSED * chord) {
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
