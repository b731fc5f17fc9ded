//! Whether a branch has come back to where it began.

use super::problem::Metric;
use super::tracer::{Sample, refit};

/// Whether the step from the last sample to `next` passes the first sample in its direction.
pub(super) fn comes_back(samples: &[Sample], next: &Sample) -> bool {
    let (Some(first), Some(last)) = (samples.first(), samples.last()) else { return false };
    let metric = Metric { size: first.metric.0, span: first.metric.1 };
    let fit = |sample: &Sample| refit(&sample.set, &first.set, 1, &sample.u);
    let (a, b) = (fit(last), fit(next));
    let from_first = |u: &[f64], p: f64| {
        let d: Vec<f64> = u.iter().zip(&first.u).map(|(x, y)| x - y).collect();
        (
            metric.norm(&d, p - first.p),
            metric.dot((&d, p - first.p), (&first.tangent, first.tangent_p)),
        )
    };
    let (distance_a, along_a) = from_first(&a, last.p);
    let (distance_b, along_b) = from_first(&b, next.p);
    let step: Vec<f64> = b.iter().zip(&a).map(|(x, y)| x - y).collect();
    let length = metric.norm(&step, next.p - last.p);
    let forward = metric.dot((&step, next.p - last.p), (&first.tangent, first.tangent_p));
    passes((distance_a, along_a), (distance_b, along_b), forward, length)
}

/// Whether a step passes a place in its direction: given are the distances of its ends from the place
/// and their ways along the direction, the way of the step along it, and its length.
pub(super) fn passes(from: (f64, f64), to: (f64, f64), forward: f64, length: f64) -> bool {
    forward > 0.7 * length
        && from.1 <= 0.0
        && to.1 >= 0.0
        && from.0 <= 1.1 * length
        && to.0 <= 1.1 * length
}
