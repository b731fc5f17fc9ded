//! What happens between the samples of a branch, located to the tolerance.
//!
//! Folds are zeros of the parameter's share of the tangent; branch points, period doublings and
//! Neimark-Sacker points zeros of a multiplier's distance from the unit circle; grazing contact a zero
//! of the distance of the extreme twist from a switching twist. Each test is a function of the
//! arclength between two samples, every value of it at a converged response; its zero is closed in by
//! a bracketing method. Where the number of harmonics is free it is raised until the place stands
//! still.

use halfshaft_numerics::bracket::{RootSettings, find_root};
use halfshaft_numerics::harmonics::HarmonicSet;
use halfshaft_results::SpecialKind;

use super::grazing::{Touch, touches};
use super::problem::{Axis, Condition, Failure, Metric};
use super::stability::{Crossing, Judge, Stability, counted, crossings, pair_angle, test};
use super::tracer::{MOST_HARMONICS, Sample, Tracer, refit};

/// A special point between sample `after` and the next.
#[derive(Clone, Debug)]
pub(crate) struct Special {
    pub(crate) kind: SpecialKind,
    pub(crate) after: usize,
    pub(crate) sample: Sample,
    pub(crate) stability: Option<Stability>,
    /// Change of the parameter when harmonics were last added, relative; the width of the bracket
    /// where none were.
    pub(crate) precision: f64,
    pub(crate) located: bool,
    /// Change of the unstable dimension.
    pub(crate) change: Option<i32>,
    pub(crate) note: Option<String>,
    /// What touches, at a grazing contact.
    pub(crate) touch: Option<Touch>,
}

/// A place is settled when more harmonics move it by less than this part.
const SETTLED: f64 = 1e-11;
/// Rounds of more harmonics at most.
const MOST_ROUNDS: usize = 12;
/// Halvings until a test function has opposite signs at both ends.
const MOST_HALVINGS: usize = 40;

/// A pair of multipliers nearer to the real axis than this is none, rad.
const LEAST_ANGLE: f64 = 1e-5;

/// What is zero at a special point.
pub(super) enum Test<'q> {
    Fold,
    Crossing(Crossing),
    /// The branch's orientation, which only has a sign.
    Orientation,
    Value(&'q dyn Fn(&Sample) -> f64),
}

/// The curve between two samples of a branch.
struct Segment<'s> {
    from: &'s Sample,
    to: &'s Sample,
}

impl Tracer<'_, '_> {
    /// The response of the branch in the plane across the chord of two samples at a part of it.
    pub(super) fn on_segment(
        &mut self,
        (from, to): (&Sample, &Sample),
        part: f64,
        set: &HarmonicSet,
    ) -> Result<Sample, Failure> {
        self.between(&Segment { from, to }, part, set)
    }

    /// The response at a part (0 to 1) of the way between two samples, over a set of harmonics.
    fn between(
        &mut self,
        segment: &Segment<'_>,
        part: f64,
        set: &HarmonicSet,
    ) -> Result<Sample, Failure> {
        let (from, to) = (segment.from, segment.to);
        let fit = |sample: &Sample, values: &[f64]| refit(&sample.set, set, 1, values);
        let (a, b) = (fit(from, &from.u), fit(to, &to.u));
        let mut fitted = a.clone();
        self.use_set(set, &mut fitted, set);
        let metric = self.metric(&a);
        let chord: Vec<f64> = b.iter().zip(&a).map(|(b, a)| b - a).collect();
        let chord_p = to.p - from.p;
        let length = metric.norm(&chord, chord_p);
        let direction = |sample: &Sample| {
            let mut t = fit(sample, &sample.tangent);
            let along = metric.dot((&t, sample.tangent_p), (&chord, chord_p)) / length;
            let scale = length / along;
            t.iter_mut().for_each(|x| *x *= scale);
            (t, sample.tangent_p * scale)
        };
        let ((ta, ta_p), (tb, tb_p)) = (direction(from), direction(to));
        let s = part;
        // Hermite's cubic through both samples with their directions.
        let weights = [
            (1.0 + 2.0 * s) * (1.0 - s) * (1.0 - s),
            s * (1.0 - s) * (1.0 - s),
            s * s * (3.0 - 2.0 * s),
            s * s * (s - 1.0),
        ];
        let mix = |a: f64, ta: f64, b: f64, tb: f64| {
            weights[0] * a + weights[1] * ta + weights[2] * b + weights[3] * tb
        };
        let mut u: Vec<f64> = (0..a.len()).map(|k| mix(a[k], ta[k], b[k], tb[k])).collect();
        let mut p = mix(from.p, ta_p, to.p, tb_p);
        let row: Vec<f64> = chord.iter().map(|x| x / (metric.size * metric.size)).collect();
        let corner = chord_p / (metric.span * metric.span);
        let held: f64 = row.iter().zip(&a).map(|(r, a)| r * a).sum::<f64>() + corner * from.p;
        let target = held + part * length * length;
        let condition = Condition { row: &row, corner, target };
        let done = self.problem.correct(&mut u, &mut p, &condition, &metric)?;
        self.counted.iterations += done.iterations;
        let unit: Vec<f64> = chord.iter().map(|x| x / length).collect();
        self.finish_sample(set.clone(), u, p, &metric, Some((&unit, chord_p / length)))
    }

    fn value(&mut self, judge: &mut Judge, what: &Test<'_>, sample: &Sample) -> f64 {
        match what {
            Test::Fold => sample.tangent_p,
            Test::Orientation => sample.orientation,
            Test::Value(value) => value(sample),
            Test::Crossing(crossing) => match self.judge(judge, sample) {
                Ok(stability) => test(&stability, *crossing),
                Err(_) => f64::NAN,
            },
        }
    }

    /// The stability of a response.
    pub(super) fn judge(
        &mut self,
        judge: &mut Judge,
        sample: &Sample,
    ) -> Result<Stability, Failure> {
        let mut u = sample.u.clone();
        self.use_set(&sample.set, &mut u, &sample.set);
        let place = self.problem.place_at(sample.p);
        if matches!(self.problem.axis, Axis::Parameter(_)) {
            self.problem.line_at(sample.p)?;
            *judge = Judge::new(&self.problem.system, judge.method());
        }
        judge.stability(&self.problem.system, &sample.u, place)
    }

    /// Closes in on a zero of a test between two samples over one set of harmonics.
    fn close_in(
        &mut self,
        judge: &mut Judge,
        what: &Test<'_>,
        segment: &Segment<'_>,
        set: &HarmonicSet,
        (mut low, mut high): (f64, f64),
    ) -> Option<(Sample, f64)> {
        let at = |tracer: &mut Self, judge: &mut Judge, part: f64| {
            let sample = tracer.between(segment, part, set).ok()?;
            let value = tracer.value(judge, what, &sample);
            Some((value, sample))
        };
        let (mut at_low, first) = at(self, judge, low)?;
        let (mut at_high, last) = at(self, judge, high)?;
        // A test may be undefined at one end; what counts then is on which side it is.
        let side = |tracer: &mut Self, judge: &mut Judge, sample: &Sample| match what {
            Test::Crossing(crossing) => {
                tracer.judge(judge, sample).ok().map(|stability| counted(&stability, *crossing))
            }
            _ => None,
        };
        let (side_low, side_high) = (side(self, judge, &first), side(self, judge, &last));
        for _ in 0..MOST_HALVINGS {
            if at_low * at_high <= 0.0 {
                break;
            }
            if side_low == side_high {
                return None;
            }
            let middle = f64::midpoint(low, high);
            let (value, sample) = at(self, judge, middle)?;
            if side(self, judge, &sample) == side_low {
                (low, at_low) = (middle, value);
            } else {
                (high, at_high) = (middle, value);
            }
        }
        if at_low * at_high > 0.0 || (at_low * at_high).is_nan() {
            return None;
        }
        let settings = RootSettings {
            absolute_tolerance: 1e-13,
            relative_tolerance: 0.0,
            ..RootSettings::default()
        };
        let mut failed = false;
        let root = find_root(
            |part| match at(self, judge, part) {
                Some((value, _)) => value,
                None => {
                    failed = true;
                    f64::NAN
                }
            },
            low,
            high,
            settings,
        )
        .ok()?;
        let sample = self.between(segment, root.value, set).ok()?;
        let genuine = self.is_zero(judge, what, &sample);
        (!failed && genuine).then_some((sample, root.value))
    }

    /// Whether a test is truly zero at a response: where multipliers meet on the real axis, away from
    /// the unit circle, a test may change its sign by a jump.
    fn is_zero(&mut self, judge: &mut Judge, what: &Test<'_>, sample: &Sample) -> bool {
        let Test::Crossing(crossing) = what else { return true };
        let Ok(stability) = self.judge(judge, sample) else { return false };
        let turned =
            *crossing != Crossing::Pair || pair_angle(&stability).sin().abs() > LEAST_ANGLE;
        test(&stability, *crossing).abs() < 1e-6 && turned
    }

    /// Locates a zero of a test between two samples; harmonics are added until it stands still.
    pub(super) fn locate(
        &mut self,
        judge: &mut Judge,
        what: &Test<'_>,
        (from, to): (&Sample, &Sample),
    ) -> Option<(Sample, f64)> {
        let segment = Segment { from, to };
        let highest = from.set.highest().max(to.set.highest());
        let mut set = from.set.up_to(highest);
        let (mut sample, mut part) = self.close_in(judge, what, &segment, &set, (0.0, 1.0))?;
        let mut precision = f64::NAN;
        if self.settings.harmonics.is_some() {
            return Some((sample, 1e-13));
        }
        if self.shoots() {
            // Harmonics converge slowly at kinks: shooting takes it from here.
            return Some((sample, f64::NAN));
        }
        for round in 0..MOST_ROUNDS {
            let more = 2.max(set.highest() / 4).next_multiple_of(2);
            let next = set.up_to((set.highest() + more).min(MOST_HARMONICS));
            if next == set {
                break;
            }
            let mut width: f64 = if round == 0 { 1e-2 } else { 1e-3 };
            let better = loop {
                let bracket = ((part - width).max(-0.5), (part + width).min(1.5));
                match self.close_in(judge, what, &segment, &next, bracket) {
                    Some(found) => break Some(found),
                    None if width < 0.5 => width *= 5.0,
                    None => break None,
                }
            };
            let Some((found, place)) = better else { break };
            precision = (found.p - sample.p).abs() / found.p.abs().max(f64::MIN_POSITIVE);
            (sample, part, set) = (found, place, next);
            if precision < SETTLED {
                break;
            }
        }
        Some((sample, precision))
    }

    /// Special points of a branch, in its order.
    pub(super) fn specials(
        &mut self,
        judge: &mut Judge,
        samples: &[Sample],
        stabilities: &[Stability],
    ) -> Vec<Special> {
        let mut found = Vec::new();
        for after in 0..samples.len().saturating_sub(1) {
            let pair = (&samples[after], &samples[after + 1]);
            let stability = (&stabilities[after], &stabilities[after + 1]);
            let mut here = self.between_pair(judge, after, pair, stability);
            // In the order of the branch.
            let metric = Metric { size: pair.0.metric.0, span: pair.0.metric.1 };
            let along = |special: &Special| {
                let u = refit(&special.sample.set, &pair.0.set, 1, &special.sample.u);
                let d: Vec<f64> = u.iter().zip(&pair.0.u).map(|(a, b)| a - b).collect();
                metric.dot((&d, special.sample.p - pair.0.p), (&pair.0.tangent, pair.0.tangent_p))
            };
            here.sort_by(|a, b| along(a).total_cmp(&along(b)));
            found.append(&mut here);
        }
        found
    }

    /// The folds of a branch alone.
    pub(super) fn folds(&mut self, judge: &mut Judge, samples: &[Sample]) -> Vec<Special> {
        let mut found = Vec::new();
        for (after, pair) in samples.windows(2).enumerate() {
            if pair[0].tangent_p * pair[1].tangent_p >= 0.0 {
                continue;
            }
            let Some((sample, precision)) = self.locate(judge, &Test::Fold, (&pair[0], &pair[1]))
            else {
                continue;
            };
            found.push(Special {
                kind: SpecialKind::Fold,
                after,
                sample,
                stability: None,
                precision,
                located: true,
                change: None,
                note: None,
                touch: None,
            });
        }
        found
    }

    fn between_pair(
        &mut self,
        judge: &mut Judge,
        after: usize,
        (from, to): (&Sample, &Sample),
        (before, behind): (&Stability, &Stability),
    ) -> Vec<Special> {
        let mut wanted: Vec<(SpecialKind, Test<'_>)> = Vec::new();
        let fold = from.tangent_p * to.tangent_p < 0.0;
        let crossed = from.orientation * to.orientation < 0.0;
        if fold {
            wanted.push((SpecialKind::Fold, Test::Fold));
        }
        let changes = crossings(before, behind);
        let mirrored = !before.half.is_empty();
        for crossing in &changes {
            match crossing {
                Crossing::MinusOne => {
                    wanted.push((SpecialKind::PeriodDoubling, Test::Crossing(*crossing)));
                }
                Crossing::Pair => {
                    wanted.push((SpecialKind::NeimarkSacker, Test::Crossing(*crossing)));
                }
                // Without the mirror symmetry a multiplier passes 1 at every fold.
                Crossing::One if mirrored => {
                    wanted.push((SpecialKind::BranchPoint, Test::Crossing(*crossing)));
                }
                Crossing::One => {}
            }
        }
        if crossed {
            wanted.push((SpecialKind::BranchPoint, Test::Orientation));
        }
        let change = i32::try_from(behind.unstable).unwrap_or(0)
            - i32::try_from(before.unstable).unwrap_or(0);
        let alone = wanted.len() == 1;
        let mut specials = self.grazing(judge, after, (from, to));
        if specials.len() == 1 && wanted.is_empty() {
            specials[0].change = Some(change);
        }
        for (kind, what) in wanted {
            let place = self.locate(judge, &what, (from, to));
            if place.is_none()
                && matches!(what, Test::Crossing(Crossing::Pair))
                && change.abs() != 2
            {
                // A pair outside the circle that met on the real axis.
                continue;
            }
            let located = place.is_some();
            let (sample, precision) = place.unwrap_or_else(|| (from.clone(), f64::NAN));
            let stability = self.judge(judge, &sample).ok();
            specials.push(Special {
                kind,
                after,
                sample,
                stability,
                precision,
                located,
                change: alone.then_some(change),
                note: None,
                touch: None,
            });
        }
        specials
    }

    /// Whether special points of these curves are left to shooting: the excitation speed runs over a
    /// line with kinks.
    pub(super) fn shoots(&self) -> bool {
        matches!(self.problem.axis, Axis::Frequency)
            && self.problem.place.drive == 1.0
            && self.problem.system.line.has_kinks()
    }

    /// Where a twist begins or ceases to touch a switching twist between two samples.
    fn grazing(
        &mut self,
        judge: &mut Judge,
        after: usize,
        (from, to): (&Sample, &Sample),
    ) -> Vec<Special> {
        if matches!(self.problem.axis, Axis::Parameter(_)) {
            return Vec::new();
        }
        let line = self.problem.system.line.clone();
        let mut specials = Vec::new();
        for touch in touches(&line, from, to) {
            let beyond = |sample: &Sample| touch.beyond(&line, sample);
            let place = self.locate(judge, &Test::Value(&beyond), (from, to));
            let Some((sample, precision)) = place else { continue };
            let stability = self.judge(judge, &sample).ok();
            specials.push(Special {
                kind: SpecialKind::GrazingContact,
                after,
                note: Some(touch.words(&line, &sample)),
                sample,
                stability,
                precision,
                located: true,
                change: None,
                touch: Some(touch),
            });
        }
        specials
    }
}
