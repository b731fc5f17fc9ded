//! Zeros of a test between two samples of a branch.
//!
//! A test is a function of the arclength between the samples, every value of it at a converged
//! response. Its zero is closed in by a bracketing method first; where the number of harmonics is free
//! it is then raised until the place stands still, each time by secants from the place known before,
//! with one factorisation for all of them where the test does not ask for the curve's direction.

use halfshaft_model::question::StabilityMethod;
use halfshaft_numerics::bracket::{RootSettings, find_root};
use halfshaft_numerics::harmonics::HarmonicSet;

use super::problem::{Axis, Failure};
use super::refine::exact_stability;
use super::segment::Segment;
use super::stability::{Crossing, Judge, Stability, counted, crosses, halved, test};
use super::tracer::{MOST_HARMONICS, Sample, Tracer, length};

/// A place is settled when more harmonics move it by less than this part.
const SETTLED: f64 = 1e-11;
/// Rounds of more harmonics at most.
const MOST_ROUNDS: usize = 12;
/// A multiplier further from the circle than this where it was closed in on jumps over it.
const JUMP: f64 = 1e-2;
/// Part of the segment to which a zero is closed in.
const CLOSED_IN: f64 = 1e-13;
/// The same where secants over more harmonics go on from there.
const CLOSE: f64 = 1e-5;
/// Secants from a known place at most.
const MOST_SECANTS: usize = 8;
/// A secant further than this part of the segment is not one from a place known before.
const FARTHEST_SECANT: f64 = 0.1;
/// First step of the secants where the slope is unknown.
const FIRST_SECANT: f64 = 1e-5;
/// A secant below this that no longer brings the test nearer to zero has met rounding.
const ROUNDING: f64 = 1e-8;
/// Last coefficients, relative to the whole, that a set of harmonics is chosen for.
const LAST_COEFFICIENT: f64 = 1e-13;

/// What is zero at a special point.
pub(super) enum Test<'q> {
    Fold,
    Crossing(Crossing),
    /// The branch's orientation, which only has a sign.
    Orientation,
    Value(&'q dyn Fn(&Sample) -> f64),
}

impl Test<'_> {
    /// Whether its value is in the direction of the curve.
    fn is_directed(&self) -> bool {
        matches!(self, Self::Fold | Self::Orientation)
    }

    /// Its values at two samples, given their stability.
    fn at_ends(
        &self,
        (from, to): (&Sample, &Sample),
        stability: Option<(&Stability, &Stability)>,
    ) -> Option<(f64, f64)> {
        match self {
            Self::Fold => Some((from.tangent_p, to.tangent_p)),
            Self::Orientation => Some((from.orientation, to.orientation)),
            Self::Value(value) => Some((value(from), value(to))),
            Self::Crossing(crossing) => {
                stability.map(|(before, after)| (test(before, *crossing), test(after, *crossing)))
            }
        }
    }
}

/// What is known of a test when its zero is closed in on.
struct Known {
    /// Parts with their values.
    seen: Vec<(f64, f64)>,
    /// The response whose factors are the ones last made.
    near: Option<(Sample, f64)>,
    /// Part of the segment to which the zero is wanted.
    close: f64,
}

/// A zero of a test.
struct Zero {
    sample: Sample,
    /// Part of the segment.
    part: f64,
    /// Slope of the test by the part, where two values have told it.
    slope: f64,
    /// Part by which the zero may still be off.
    left: f64,
}

impl Tracer<'_, '_> {
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
        self.choose(&sample.set);
        let place = self.problem.place_at(sample.p);
        if matches!(self.problem.axis, Axis::Parameter(_)) {
            self.problem.line_at(sample.p)?;
            *judge = Judge::new(&self.problem.system, judge.method());
        }
        let system = &self.problem.system;
        if self.shoots()
            && judge.method() == StabilityMethod::Monodromy
            && let Some(exact) = exact_stability(&system.line, system.base, sample)
        {
            return Ok(exact);
        }
        judge.stability(&self.problem.system, &sample.u, place)
    }

    /// The stability of all samples of a branch; those over the same harmonics at once where the line
    /// allows it.
    pub(super) fn judge_all(&mut self, judge: &mut Judge, samples: &[Sample]) -> Vec<Stability> {
        let mut all = Vec::with_capacity(samples.len());
        for run in samples.chunk_by(|a, b| a.set == b.set) {
            let together = self.judge_together(judge, run).unwrap_or_else(|| vec![None; run.len()]);
            for (sample, known) in run.iter().zip(together) {
                let one = || self.judge(judge, sample).unwrap_or_default();
                all.push(known.unwrap_or_else(one));
            }
        }
        all
    }

    fn judge_together(&mut self, judge: &Judge, run: &[Sample]) -> Option<Vec<Option<Stability>>> {
        let first = run.first()?;
        if self.shoots() || matches!(self.problem.axis, Axis::Parameter(_)) {
            return None;
        }
        self.choose(&first.set);
        let place = |sample: &Sample| self.problem.place_at(sample.p);
        let responses: Vec<_> = run.iter().map(|s| (s.u.as_slice(), place(s))).collect();
        judge.stabilities(&self.problem.system, &responses)
    }

    /// Closes in on a zero of a test between two samples over one set of harmonics, to a part of the
    /// segment; `known` are the values at the ends of the bracket, if they are.
    fn close_in(
        &mut self,
        judge: &mut Judge,
        what: &Test<'_>,
        segment: &Segment,
        bracket: (f64, f64),
        close: f64,
        known: Option<(f64, f64)>,
    ) -> Option<Zero> {
        if let Some((at_low, at_high)) = known.filter(|(a, b)| a * b <= 0.0) {
            let seen = vec![(bracket.0, at_low), (bracket.1, at_high)];
            return self.root(judge, what, segment, bracket, Known { seen, near: None, close });
        }
        let mut seen: Vec<(f64, f64)> = Vec::new();
        let mut at = |tracer: &mut Self, judge: &mut Judge, part: f64| {
            let sample = tracer.between(segment, part, None).ok()?;
            let value = tracer.value(judge, what, &sample);
            seen.push((part, value));
            Some((value, sample))
        };
        let (at_low, first) = at(self, judge, bracket.0)?;
        let (at_high, last) = at(self, judge, bracket.1)?;
        if at_low * at_high <= 0.0 {
            let near = (last, bracket.1);
            let known = Known { seen, near: Some(near), close };
            return self.root(judge, what, segment, bracket, known);
        }
        let side = |tracer: &mut Self, judge: &mut Judge, sample: &Sample| match what {
            Test::Crossing(crossing) => {
                tracer.judge(judge, sample).ok().map(|stability| counted(&stability, *crossing))
            }
            _ => None,
        };
        let sides = (side(self, judge, &first), side(self, judge, &last));
        let bracket = halved(bracket, (at_low, at_high), sides, |part| {
            let (value, sample) = at(self, judge, part)?;
            Some((value, side(self, judge, &sample)))
        })?;
        self.root(judge, what, segment, bracket, Known { seen, near: None, close })
    }

    /// The zero in a bracket, given the values seen and the response whose factors are the ones last made.
    fn root(
        &mut self,
        judge: &mut Judge,
        what: &Test<'_>,
        segment: &Segment,
        (low, high): (f64, f64),
        Known { mut seen, mut near, close }: Known,
    ) -> Option<Zero> {
        let settings = RootSettings {
            absolute_tolerance: close,
            relative_tolerance: 0.0,
            ..RootSettings::default()
        };
        let root = find_root(
            |part| {
                if let Some((_, value)) = seen.iter().find(|(known, _)| *known == part) {
                    return *value;
                }
                let close = near.as_ref().filter(|(_, at)| (part - at).abs() < FARTHEST_SECANT);
                let beside = close.and_then(|(sample, at)| {
                    self.nearby(segment, (sample, *at), part, what.is_directed()).ok()
                });
                let factored = beside.is_none() || what.is_directed();
                let Some(sample) = beside.or_else(|| self.between(segment, part, None).ok()) else {
                    return f64::NAN;
                };
                let value = self.value(judge, what, &sample);
                seen.push((part, value));
                if factored {
                    near = Some((sample, part));
                }
                value
            },
            low,
            high,
            settings,
        )
        .ok()?;
        let left =
            seen.iter().find(|(part, _)| *part == root.value).map_or(f64::NAN, |seen| seen.1);
        if close > CLOSED_IN && matches!(what, Test::Crossing(_)) && left.abs() > JUMP {
            return None;
        }
        let slope = slope(&mut seen, root.value);
        let near = near.as_ref().map(|near| &near.0);
        let sample = self.between(segment, root.value, near).ok()?;
        let zero = Zero { sample, part: root.value, slope, left: close };
        (close > CLOSED_IN || self.is_zero(judge, what, &zero.sample)).then_some(zero)
    }

    /// A zero over more harmonics, by secants from where it was over fewer.
    fn follow_zero(
        &mut self,
        judge: &mut Judge,
        what: &Test<'_>,
        segment: &Segment,
        zero: &Zero,
    ) -> Option<Zero> {
        let centre = self.between(segment, zero.part, Some(&zero.sample)).ok()?;
        let mut part = zero.part;
        let mut value = self.value(judge, what, &centre);
        let mut slope = zero.slope;
        let mut here = None;
        for _ in 0..MOST_SECANTS {
            let step =
                if slope.is_finite() && slope != 0.0 { -value / slope } else { FIRST_SECANT };
            if value == 0.0 || step.abs() < CLOSED_IN {
                break;
            }
            let away = (part + step - zero.part).abs();
            if !(away < FARTHEST_SECANT && (part + step - 0.5).abs() < 1.0) {
                return None;
            }
            let near = (&centre, zero.part);
            let next = self.nearby(segment, near, part + step, what.is_directed()).ok()?;
            let next_value = self.value(judge, what, &next);
            if next_value.is_nan() {
                return None;
            }
            if next_value.abs() >= 0.5 * value.abs() {
                if step.abs() < ROUNDING {
                    break;
                }
                // Not so near as it seemed.
                if next_value.abs() > 2.0 * value.abs() {
                    return None;
                }
            }
            if step.abs() > ROUNDING {
                slope = (next_value - value) / step;
            }
            part += step;
            (value, here) = (next_value, Some(next));
        }
        let sample = match here {
            Some(sample) if what.is_directed() => sample,
            Some(sample) => self.finish_on(segment, sample.u, sample.p).ok()?,
            None => centre,
        };
        let left = (value / slope).abs();
        let zero = Zero { sample, part, slope, left };
        (left < ROUNDING && self.is_zero(judge, what, &zero.sample)).then_some(zero)
    }

    /// Whether a test is truly zero at a response.
    fn is_zero(&mut self, judge: &mut Judge, what: &Test<'_>, sample: &Sample) -> bool {
        let Test::Crossing(crossing) = what else { return true };
        self.judge(judge, sample).is_ok_and(|stability| crosses(&stability, *crossing))
    }

    /// Locates a zero of a test between two samples; harmonics are added until it stands still. Gives
    /// how far the last of them moved it, relative; NaN where none were added, the part to which it was
    /// closed in where their number is given.
    pub(super) fn locate(
        &mut self,
        judge: &mut Judge,
        what: &Test<'_>,
        pair: (&Sample, &Sample),
        stability: Option<(&Stability, &Stability)>,
    ) -> Option<(Sample, f64)> {
        let highest = pair.0.set.highest().max(pair.1.set.highest());
        let mut segment = Segment::new(self, pair, &pair.0.set.up_to(highest));
        let more = self.settings.harmonics.is_none() && !self.shoots();
        let close = if more && !matches!(what, Test::Orientation) { CLOSE } else { CLOSED_IN };
        let known = what.at_ends(pair, stability).filter(|_| pair.0.set == pair.1.set);
        let mut zero = self.close_in(judge, what, &segment, (0.0, 1.0), close, known)?;
        if self.settings.harmonics.is_some() {
            return Some((zero.sample, CLOSED_IN));
        }
        if self.shoots() {
            // Harmonics converge slowly at kinks: shooting takes it from here.
            return Some((zero.sample, f64::NAN));
        }
        let mut precision = f64::NAN;
        for round in 0..MOST_ROUNDS {
            let next = more_harmonics(&zero.sample);
            let mut found = None;
            if next != segment.set {
                let finer = Segment::new(self, pair, &next);
                found = self.over_more(judge, what, &finer, &zero, round);
                if found.is_some() {
                    segment = finer;
                }
            }
            let Some(found) = found else {
                if round == 0 && close > CLOSED_IN {
                    // Over these harmonics then, and to the end.
                    zero = self.close_in(judge, what, &segment, (0.0, 1.0), CLOSED_IN, known)?;
                }
                break;
            };
            let p = found.sample.p;
            let moved = (p - zero.sample.p).abs().max(found.left * segment.parameter_span());
            precision = moved / p.abs().max(f64::MIN_POSITIVE);
            zero = found;
            if precision < SETTLED {
                break;
            }
        }
        Some((zero.sample, precision))
    }

    /// A zero over more harmonics.
    fn over_more(
        &mut self,
        judge: &mut Judge,
        what: &Test<'_>,
        segment: &Segment,
        zero: &Zero,
        round: usize,
    ) -> Option<Zero> {
        if !matches!(what, Test::Orientation)
            && let Some(found) = self.follow_zero(judge, what, segment, zero)
        {
            return Some(found);
        }
        let mut width: f64 = if round == 0 { 1e-2 } else { 1e-3 };
        loop {
            let bracket = ((zero.part - width).max(-0.5), (zero.part + width).min(1.5));
            match self.close_in(judge, what, segment, bracket, CLOSED_IN, None) {
                Some(found) => return Some(found),
                None if width < 0.5 => width *= 5.0,
                None => return None,
            }
        }
    }
}

/// Slope of a function at its zero from the values seen on the way there.
fn slope(seen: &mut [(f64, f64)], zero: f64) -> f64 {
    // Values nearer than this are mostly rounding.
    let apart = |part: f64| (part - zero).abs() > 1e-8;
    seen.sort_by(|a, b| (a.0 - zero).abs().total_cmp(&(b.0 - zero).abs()));
    seen.iter()
        .find(|(part, _)| apart(*part))
        .map_or(f64::NAN, |(part, value)| value / (part - zero))
}

/// Harmonics by which the coefficients of a response ought to have died out, judged by how they decay:
/// at least a tenth more and at most twice as many.
fn more_harmonics(sample: &Sample) -> HarmonicSet {
    let (set, m) = (&sample.set, sample.set.coefficients());
    let highest = set.highest();
    let size = length(&sample.u).max(f64::MIN_POSITIVE);
    let largest = |from: usize, to: usize| {
        let orders = set.orders().iter().filter(|order| (from + 1..=to).contains(order));
        let nodes = || sample.u.chunks_exact(m);
        let moduli = orders.flat_map(|&order| nodes().map(move |node| set.modulus(node, order)));
        (moduli.fold(f64::MIN_POSITIVE, f64::max) / size).ln()
    };
    let quarter = (highest / 4).max(2);
    let (before, last) = (
        largest(highest.saturating_sub(2 * quarter), highest - quarter),
        largest(highest - quarter, highest),
    );
    let fall = ((before - last) / quarter as f64).max(0.0);
    let wanted = (last - LAST_COEFFICIENT.ln()) / fall;
    let least = 2.max(highest / 10).next_multiple_of(2);
    let wanted = if wanted.is_finite() { wanted.min(highest as f64) as usize } else { highest };
    let more = wanted.max(least).next_multiple_of(2);
    set.up_to((highest + more).min(MOST_HARMONICS))
}
