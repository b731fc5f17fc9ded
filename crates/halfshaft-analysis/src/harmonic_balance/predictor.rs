//! Where the next sample of a curve is expected: beyond the tangent, from the last two samples.

use std::borrow::Cow;

use halfshaft_numerics::harmonics::HarmonicSet;

use super::problem::Metric;
use super::tracer::{Sample, refit};

/// Directions of neighbours that differ by more than this cosine are not fitted together.
const LEAST_TURN: f64 = 0.5;
/// Steps longer than so many times the last are not extrapolated.
const LONGEST: f64 = 3.0;

/// Adds to a prediction along the tangent the square and the cube of the step, from the polynomial
/// through the last two samples that has the tangents of both. Its variable is the way along the last
/// tangent, by which the next sample is found.
pub(super) fn bend(
    (last, before): (&Sample, &Sample),
    set: &HarmonicSet,
    metric: &Metric,
    step: f64,
    (along, along_p): (&[f64], f64),
    (u, p): (&mut [f64], &mut f64),
) {
    let here = fitted(&last.set, set, &last.u);
    let there = fitted(&before.set, set, &before.u);
    let back: Vec<f64> = there.iter().zip(&*here).map(|(a, b)| a - b).collect();
    let back_p = before.p - last.p;
    // before = last - d t + d² a - d³ b, with the slope t - 2 d a + 3 d² b.
    let d = -metric.dot((&back, back_p), (along, along_p));
    if d <= 0.0 || step > LONGEST * d {
        return;
    }
    let slope = fitted(&before.set, set, &before.tangent);
    let turn = metric.dot((&slope, before.tangent_p), (along, along_p));
    let length = metric.norm(&slope, before.tangent_p);
    let fits = turn > LEAST_TURN * length;
    let (square, cube) = ((step / d).powi(2), (step / d).powi(3));
    let predicted = |back: f64, along: f64, slope: f64| {
        let chord = back + d * along;
        if !fits {
            return square * chord;
        }
        let slopes = 0.5 * d * (along - slope / turn);
        square * (3.0 * chord - 2.0 * slopes) + cube * 2.0 * (chord - slopes)
    };
    for (((u, back), along), slope) in u.iter_mut().zip(&back).zip(along).zip(&*slope) {
        *u += predicted(*back, *along, *slope);
    }
    *p += predicted(back_p, along_p, before.tangent_p);
}

/// Coefficients over another set of harmonics; the same ones where the set is the same.
fn fitted<'u>(from: &HarmonicSet, to: &HarmonicSet, u: &'u [f64]) -> Cow<'u, [f64]> {
    if from == to { Cow::Borrowed(u) } else { Cow::Owned(refit(from, to, 1, u)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    // Source: a cubic curve, which is predicted exactly.
    #[test]
    fn cubic_curves_are_predicted_exactly() {
        let set = HarmonicSet::odd(1);
        let curve = |s: f64| [0.3 * s * s - 0.1 * s * s * s, 1.0 + 0.2 * s * s * s];
        let slope = |s: f64| [0.6 * s - 0.3 * s * s, 0.6 * s * s];
        let sample = |s: f64, scale: f64| Sample {
            set: set.clone(),
            u: curve(s).to_vec(),
            p: s,
            tangent: slope(s).iter().map(|x| scale * x).collect(),
            tangent_p: scale,
            metric: (1.0, 1.0),
            orientation: 1.0,
            truncation: 0.0,
        };
        let metric = Metric { size: 1.0, span: 1.0 };
        // The last tangent is along the parameter, so that the way along it is the parameter.
        let (last, before) = (sample(0.0, 1.0), sample(-0.3, 0.7));
        let step = 0.4;
        let (mut u, mut p) = (vec![0.0, 1.0], step);
        bend((&last, &before), &set, &metric, step, (&[0.0, 0.0], 1.0), (&mut u, &mut p));
        let exact = curve(step);
        assert!((u[0] - exact[0]).abs() < 1e-15 && (u[1] - exact[1]).abs() < 1e-15, "{u:?}");
        assert!((p - step).abs() < 1e-15);
    }
}
