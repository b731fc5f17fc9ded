//! The curve between two samples of a branch, every response of it in a plane across their chord.

use halfshaft_numerics::bracket::{RootSettings, find_root};
use halfshaft_numerics::harmonics::HarmonicSet;

use super::problem::{Condition, Failure, Metric};
use super::tracer::{Sample, Tracer, refit};

/// Part of the segment to which a zero on the cubic is closed in: the curve is further from it.
const CLOSE: f64 = 1e-9;

/// Two samples over one set of harmonics, with the chord between them.
pub(super) struct Segment {
    pub(super) set: HarmonicSet,
    from: End,
    to: End,
    metric: Metric,
    /// Row and corner of the condition that holds a response in a plane across the chord: the unit
    /// vector along it in the metric.
    row: Vec<f64>,
    corner: f64,
    length: f64,
    /// Unit vector along the chord.
    unit: Vec<f64>,
    unit_p: f64,
}

/// A sample with its direction, scaled so that the chord is passed at unit speed.
struct End {
    u: Vec<f64>,
    p: f64,
    along: Vec<f64>,
    along_p: f64,
}

impl Segment {
    pub(super) fn new(
        tracer: &mut Tracer<'_, '_>,
        (from, to): (&Sample, &Sample),
        set: &HarmonicSet,
    ) -> Self {
        let fit = |sample: &Sample, values: &[f64]| refit(&sample.set, set, 1, values);
        let (a, b) = (fit(from, &from.u), fit(to, &to.u));
        let metric = tracer.metric(&a);
        let chord: Vec<f64> = b.iter().zip(&a).map(|(b, a)| b - a).collect();
        let chord_p = to.p - from.p;
        let length = metric.norm(&chord, chord_p);
        let end = |sample: &Sample, u: Vec<f64>| {
            let mut along = fit(sample, &sample.tangent);
            let share = metric.dot((&along, sample.tangent_p), (&chord, chord_p)) / length;
            let scale = length / share;
            along.iter_mut().for_each(|x| *x *= scale);
            End { u, p: sample.p, along, along_p: sample.tangent_p * scale }
        };
        let unit: Vec<f64> = chord.iter().map(|x| x / length).collect();
        let unit_p = chord_p / length;
        let row = unit.iter().map(|x| x / (metric.size * metric.size)).collect();
        let corner = unit_p / (metric.span * metric.span);
        let (from, to) = (end(from, a), end(to, b));
        Self { set: set.clone(), from, to, metric, row, corner, length, unit, unit_p }
    }

    /// How far the parameter moves along the whole of it.
    pub(super) fn parameter_span(&self) -> f64 {
        (self.to.p - self.from.p).abs()
    }

    /// Condition of the plane at a part of the way.
    fn condition(&self, part: f64) -> Condition<'_> {
        let held: f64 = self.row.iter().zip(&self.from.u).map(|(r, a)| r * a).sum();
        let target = held + self.corner * self.from.p + part * self.length;
        Condition { row: &self.row, corner: self.corner, target }
    }

    /// The parameter at a part of Hermite's cubic through both samples with their directions.
    pub(super) fn parameter(&self, s: f64) -> f64 {
        let (bend, twist) = self.curvature();
        self.from.p + s * (self.from.along_p + s * (bend + s * twist))
    }

    /// Parts within the segment at which that parameter turns.
    pub(super) fn turns(&self) -> Vec<f64> {
        let (bend, twist) = self.curvature();
        let (a, b, c) = (3.0 * twist, 2.0 * bend, self.from.along_p);
        let sum = -0.5 * (b + (b * b - 4.0 * a * c).sqrt().copysign(b));
        [sum / a, c / sum].into_iter().filter(|s| *s > 0.0 && *s < 1.0).collect()
    }

    /// Part at which a function of it that has opposite signs at the ends is zero.
    pub(super) fn zero(function: impl FnMut(f64) -> f64) -> Option<f64> {
        let settings = RootSettings { absolute_tolerance: CLOSE, ..RootSettings::default() };
        find_root(function, 0.0, 1.0, settings).ok().map(|root| root.value)
    }

    /// Coefficients of the square and the cube of the part in that parameter.
    fn curvature(&self) -> (f64, f64) {
        let (way, first, last) = (self.to.p - self.from.p, self.from.along_p, self.to.along_p);
        (3.0 * way - 2.0 * first - last, first + last - 2.0 * way)
    }

    /// Hermite's cubic through both samples with their directions.
    pub(super) fn guess(&self, s: f64) -> (Vec<f64>, f64) {
        let weights = [
            (1.0 + 2.0 * s) * (1.0 - s) * (1.0 - s),
            s * (1.0 - s) * (1.0 - s),
            s * s * (3.0 - 2.0 * s),
            s * s * (s - 1.0),
        ];
        let mix = |a: f64, along_a: f64, b: f64, along_b: f64| {
            weights[0] * a + weights[1] * along_a + weights[2] * b + weights[3] * along_b
        };
        let (a, b) = (&self.from, &self.to);
        let u = (0..a.u.len()).map(|k| mix(a.u[k], a.along[k], b.u[k], b.along[k])).collect();
        (u, mix(a.p, a.along_p, b.p, b.along_p))
    }
}

impl Tracer<'_, '_> {
    /// The response of the branch in the plane across the chord of two samples at a part of it.
    pub(super) fn on_segment(
        &mut self,
        pair: (&Sample, &Sample),
        part: f64,
        set: &HarmonicSet,
    ) -> Result<Sample, Failure> {
        let segment = Segment::new(self, pair, set);
        self.between(&segment, part, None)
    }

    /// The response at a part of the way between two samples (0 at the first, 1 at the other), from a
    /// guess or from the cubic through both.
    pub(super) fn between(
        &mut self,
        segment: &Segment,
        part: f64,
        guess: Option<&Sample>,
    ) -> Result<Sample, Failure> {
        let (mut u, mut p) = match guess {
            Some(sample) => (refit(&sample.set, &segment.set, 1, &sample.u), sample.p),
            None => segment.guess(part),
        };
        self.choose(&segment.set);
        let condition = segment.condition(part);
        let done = self.problem.correct(&mut u, &mut p, &condition, &segment.metric)?;
        self.counted.iterations += done.iterations;
        self.finish_on(segment, u, p)
    }

    /// The response at a part of the way from that at another part close by, whose factors are the
    /// ones last made: the direction is taken over unless it is wanted anew.
    pub(super) fn nearby(
        &mut self,
        segment: &Segment,
        (near, at): (&Sample, f64),
        part: f64,
        directed: bool,
    ) -> Result<Sample, Failure> {
        if self.problem.system.set != segment.set {
            return Err(Failure::NotConverged);
        }
        let unit = (&segment.unit[..], segment.unit_p);
        let share = segment.metric.dot((&near.tangent, near.tangent_p), unit);
        let ahead = (part - at) * segment.length / share;
        let mut u: Vec<f64> =
            near.u.iter().zip(&near.tangent).map(|(u, t)| u + ahead * t).collect();
        let mut p = near.p + ahead * near.tangent_p;
        let condition = segment.condition(part);
        let done = self.problem.correct_nearby(&mut u, &mut p, &condition, &segment.metric)?;
        self.counted.iterations += done.iterations;
        if directed {
            return self.finish_on(segment, u, p);
        }
        let truncation = self.problem.system.truncation;
        Ok(Sample { u, p, truncation, ..near.clone() })
    }

    /// A sample of the segment with its direction, and the factors that go with it.
    pub(super) fn finish_on(
        &mut self,
        segment: &Segment,
        u: Vec<f64>,
        p: f64,
    ) -> Result<Sample, Failure> {
        let unit = (&segment.unit[..], segment.unit_p);
        self.finish_sample(segment.set.clone(), u, p, &segment.metric, Some(unit))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn segment(top: f64) -> Segment {
        let end = |u: f64| End {
            u: vec![u],
            p: top - (u - 0.5) * (u - 0.5),
            along: vec![1.0],
            along_p: -2.0 * (u - 0.5),
        };
        Segment {
            set: HarmonicSet::odd(1),
            from: end(0.0),
            to: end(1.0),
            metric: Metric { size: 1.0, span: 1.0 },
            row: vec![1.0],
            corner: 0.0,
            length: 1.0,
            unit: vec![1.0],
            unit_p: 0.0,
        }
    }

    // Source: by hand, the parameter 1.1 - (u - 0.5)², which the cubic is.
    #[test]
    fn turns_of_the_parameter_between_samples_are_known() {
        let segment = segment(1.1);
        assert_eq!(segment.turns(), [0.5]);
        for part in [0.0, 0.2, 0.5, 1.0] {
            let by_hand = 1.1 - (part - 0.5) * (part - 0.5);
            assert!((segment.parameter(part) - by_hand).abs() < 1e-15);
            assert!((segment.guess(part).1 - by_hand).abs() < 1e-15);
        }
    }
}
