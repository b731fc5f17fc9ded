//! Folds as points of a space of responses, speed and parameter: lengths, directions, neighbours.

use halfshaft_numerics::harmonics::HarmonicSet;

use super::fold_system::FoldSample;
use super::fold_trace::{FoldCurve, MISS, Point};
use super::tracer::refit;

/// 1 where the null vectors of two samples point to the same sides together, else -1: the bend
/// changes its sign with either of them.
pub(super) fn sides(a: &FoldSample, b: &FoldSample) -> f64 {
    let along = |x: &[f64], y: &[f64]| {
        let fitted = refit(&a.set, &b.set, 1, x);
        fitted.iter().zip(y).map(|(a, b)| a * b).sum::<f64>()
    };
    // The bend is quadratic in v and linear in w.
    along(&a.w, &b.w).signum()
}

pub(super) fn b_span((low, high): (f64, f64)) -> f64 {
    (high - low).abs().max(f64::MIN_POSITIVE.sqrt())
}

pub(super) fn dot(row: &Point, point: &Point) -> f64 {
    row.0.iter().zip(&point.0).map(|(a, b)| a * b).sum::<f64>() + row.1 * point.1 + row.2 * point.2
}

pub(super) fn inner(a: (&[f64], f64, f64), b: (&[f64], f64, f64), spans: [f64; 3]) -> f64 {
    let sum: f64 = a.0.iter().zip(b.0).map(|(x, y)| x * y).sum();
    sum / (spans[0] * spans[0])
        + a.1 * b.1 / (spans[1] * spans[1])
        + a.2 * b.2 / (spans[2] * spans[2])
}

pub(super) fn norm(a: (&[f64], f64, f64), spans: [f64; 3]) -> f64 {
    inner(a, a, spans).sqrt()
}

pub(super) fn reversed(mut sample: FoldSample) -> FoldSample {
    sample.tangent.0.iter_mut().for_each(|x| *x = -*x);
    sample.tangent.1 = -sample.tangent.1;
    sample.tangent.2 = -sample.tangent.2;
    sample
}

/// Whether two samples are the same fold.
pub(super) fn is_near(a: &FoldSample, b: &FoldSample) -> bool {
    let u = refit(&a.set, &b.set, 1, &a.u);
    let d: Vec<f64> = u.iter().zip(&b.u).map(|(a, b)| a - b).collect();
    norm((&d, a.frequency - b.frequency, a.parameter - b.parameter), b.spans) < 1e-3
}

/// Whether the step from `last` to `next` passes `first`.
pub(super) fn returns(first: &FoldSample, last: &FoldSample, next: &FoldSample) -> bool {
    let fit = |sample: &FoldSample| refit(&sample.set, &first.set, 1, &sample.u);
    let from = |sample: &FoldSample| {
        let d: Vec<f64> = fit(sample).iter().zip(&first.u).map(|(a, b)| a - b).collect();
        let point = (d, sample.frequency - first.frequency, sample.parameter - first.parameter);
        let along = inner(
            (&point.0, point.1, point.2),
            (&first.tangent.0, first.tangent.1, first.tangent.2),
            first.spans,
        );
        (norm((&point.0, point.1, point.2), first.spans), along)
    };
    let ((distance_a, along_a), (distance_b, along_b)) = (from(last), from(next));
    let length = (along_b - along_a).abs();
    along_a <= 0.0 && along_b >= 0.0 && distance_a <= 1.2 * length && distance_b <= 1.2 * length
}

/// Whether a fold lies on a curve that is known.
pub(super) fn on_curve(
    curve: &FoldCurve,
    frequency: f64,
    parameter: f64,
    u: &[f64],
    set: &HarmonicSet,
) -> bool {
    curve.samples.windows(2).any(|pair| {
        let (a, b) = (&pair[0], &pair[1]);
        let fit = |sample: &FoldSample| refit(&sample.set, set, 1, &sample.u);
        let (ua, ub) = (fit(a), fit(b));
        let chord: Point = (
            ub.iter().zip(&ua).map(|(x, y)| x - y).collect(),
            b.frequency - a.frequency,
            b.parameter - a.parameter,
        );
        let d: Point = (
            u.iter().zip(&ua).map(|(x, y)| x - y).collect(),
            frequency - a.frequency,
            parameter - a.parameter,
        );
        let total = inner((&chord.0, chord.1, chord.2), (&chord.0, chord.1, chord.2), a.spans);
        let part = inner((&d.0, d.1, d.2), (&chord.0, chord.1, chord.2), a.spans) / total;
        if !(-0.05..=1.05).contains(&part) {
            return false;
        }
        let off: Vec<f64> = d.0.iter().zip(&chord.0).map(|(d, c)| d - part * c).collect();
        let away = norm((&off, d.1 - part * chord.1, d.2 - part * chord.2), a.spans);
        // The chord of a bent curve lies off it by about the miss of a step.
        away < 3.0 * MISS.max(0.1 * total.sqrt() * total.sqrt())
    })
}
