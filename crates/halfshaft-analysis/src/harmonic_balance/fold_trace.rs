//! Curves of folds by arclength in response, speed and a second parameter, with cusps and turning
//! points.

use halfshaft_numerics::bracket::{RootSettings, find_root};
use halfshaft_numerics::harmonics::HarmonicSet;
use halfshaft_numerics::observer::Observer;
use halfshaft_results::SpecialKind;

use super::fold_points::{b_span, dot, inner, is_near, norm, returns, reversed, sides};
use super::fold_system::{FoldSample, FoldSystem};
use super::predictor::{PREDICTED_FROM, Waypoint, ahead, joined};
use super::problem::Failure;
use super::tracer::{Counted, MOST_HARMONICS, length, refit};

/// A curve of folds.
#[derive(Clone, Debug)]
pub(super) struct FoldCurve {
    pub(super) samples: Vec<FoldSample>,
    pub(super) specials: Vec<FoldSpecial>,
}

/// A cusp, or where a detached response is born or joins another.
#[derive(Clone, Debug)]
pub(super) struct FoldSpecial {
    pub(super) kind: SpecialKind,
    pub(super) sample: FoldSample,
    pub(super) precision: f64,
}

/// The numbers of the continuation of folds.
#[derive(Clone, Copy, Debug)]
pub(super) struct FoldSettings {
    pub(super) frequency: (f64, f64),
    pub(super) parameter: (f64, f64),
    pub(super) tolerance: f64,
    pub(super) harmonics: Option<usize>,
    /// Longest step relative to the window.
    pub(super) longest: f64,
}

/// Miss of the tangent that is aimed at, in the metric.
pub(super) const MISS: f64 = 0.01;
const SHORTEST: f64 = 1e-8;
const MOST_SAMPLES: usize = 4000;
/// Rounds of more harmonics for a special point.
const MOST_ROUNDS: usize = 8;
/// A place is settled when more harmonics move it by less than this part.
const SETTLED: f64 = 1e-10;

/// A point: unknowns, speed, parameter.
pub(super) type Point = (Vec<f64>, f64, f64);

/// Follows curves of folds.
pub(super) struct FoldTracer<'t, 'f> {
    pub(super) system: FoldSystem<'f>,
    pub(super) settings: FoldSettings,
    pub(super) observer: &'t dyn Observer,
    pub(super) counted: Counted,
}

fn weighted(tangent: (&[f64], f64, f64), spans: [f64; 3]) -> Point {
    let row = tangent.0.iter().map(|x| x / (spans[0] * spans[0])).collect();
    (row, tangent.1 / (spans[1] * spans[1]), tangent.2 / (spans[2] * spans[2]))
}

fn unit(x: &[f64]) -> Vec<f64> {
    let size = length(x);
    x.iter().map(|x| x / size).collect()
}

/// Where a step along a direction from the latest of the recent samples is expected to end.
fn predicted(
    recent: &[&FoldSample],
    set: &HarmonicSet,
    along: &Point,
    spans: [f64; 3],
    step: f64,
) -> Point {
    let waypoint = |sample: &&FoldSample| {
        let (along, along_frequency, along_parameter) = &sample.tangent;
        let place = [sample.frequency, sample.parameter];
        Waypoint {
            place: joined(&sample.set, set, &sample.u, &place),
            direction: joined(&sample.set, set, along, &[*along_frequency, *along_parameter]),
        }
    };
    let list: Vec<Waypoint> = recent.iter().map(waypoint).collect();
    let along = joined(set, set, &along.0, &[along.1, along.2]);
    let m = along.len() - 2;
    let dot =
        |a: &[f64], b: &[f64]| inner((&a[..m], a[m], a[m + 1]), (&b[..m], b[m], b[m + 1]), spans);
    let mut point = ahead(&list, &dot, step, &along);
    let ends = point.split_off(m);
    (point, ends[0], ends[1])
}

impl FoldTracer<'_, '_> {
    fn spans(&self, u: &[f64]) -> [f64; 3] {
        let (a, b) = (self.settings.frequency, self.settings.parameter);
        [length(u).max(f64::MIN_POSITIVE.sqrt()), b_span(a), b_span(b)]
    }

    fn use_set(&mut self, set: &HarmonicSet) {
        if self.system.problem.system.set != *set {
            let next = self.system.problem.with_set(set.clone());
            self.system = FoldSystem::new(next);
        }
    }

    /// A first sample of a curve from a located fold.
    pub(super) fn start(
        &mut self,
        set: &HarmonicSet,
        u: &[f64],
        frequency: f64,
        parameter: f64,
    ) -> Result<FoldSample, Failure> {
        self.use_set(set);
        let (b, c) = self.system.first_borders(u, frequency, parameter)?;
        let spans = self.spans(u);
        let row = (vec![0.0; u.len()], 0.0, 1.0);
        let mut point = (u.to_vec(), frequency, parameter);
        self.system.correct(&mut point, (&b, &c), (&row.0, row.1, row.2), parameter, spans)?;
        self.system.sample(point, (&b, &c), (&row.0, row.1, row.2), spans)
    }

    /// The curve through a sample, both ways.
    pub(super) fn trace(&mut self, start: &FoldSample) -> FoldCurve {
        let back = self.follow(start, -1.0);
        let closed = back.len() > 3 && is_near(&back[back.len() - 1], start);
        let mut samples: Vec<FoldSample> = back.into_iter().rev().map(reversed).collect();
        if !closed {
            let ahead = self.follow(start, 1.0);
            samples.pop();
            samples.extend(ahead);
        }
        let specials = self.specials(&samples);
        FoldCurve { samples, specials }
    }

    fn follow(&mut self, start: &FoldSample, sign: f64) -> Vec<FoldSample> {
        let first = if sign < 0.0 { reversed(start.clone()) } else { start.clone() };
        let mut samples = vec![first];
        let mut step = 0.01;
        while samples.len() < MOST_SAMPLES && !self.observer.cancelled() {
            let recent: Vec<&FoldSample> = samples.iter().rev().take(PREDICTED_FROM).collect();
            let Ok(next) = self.step(&recent, &mut step) else { break };
            let Some(last) = samples.last() else { break };
            let outside = self.outside(&next);
            if outside {
                if let Some(end) = self.border(last, &next) {
                    samples.push(end);
                }
                break;
            }
            let closed = samples.len() > 3 && returns(&samples[0], last, &next);
            samples.push(next);
            if closed {
                samples.push(samples[0].clone());
                break;
            }
        }
        samples
    }

    fn outside(&self, sample: &FoldSample) -> bool {
        let beyond = |(low, high): (f64, f64), x: f64| x < low || x > high;
        beyond(self.settings.frequency, sample.frequency)
            || beyond(self.settings.parameter, sample.parameter)
    }

    fn step(&mut self, recent: &[&FoldSample], step: &mut f64) -> Result<FoldSample, Failure> {
        loop {
            self.counted.steps += 1;
            match self.try_step(recent, *step) {
                Ok((next, miss)) => {
                    let factor = (MISS / miss.max(1e-12)).sqrt().clamp(0.3, 1.8);
                    let too_far = miss > 8.0 * MISS && *step > 1e3 * SHORTEST;
                    *step = (*step * factor).min(self.settings.longest);
                    if !too_far {
                        return Ok(next);
                    }
                }
                Err(failure) => {
                    *step *= 0.35;
                    if *step < SHORTEST {
                        return Err(failure);
                    }
                }
            }
        }
    }

    fn try_step(
        &mut self,
        recent: &[&FoldSample],
        step: f64,
    ) -> Result<(FoldSample, f64), Failure> {
        let Some(last) = recent.first() else { return Err(Failure::NotConverged) };
        let mut set = last.set.clone();
        self.use_set(&set);
        let spans = self.spans(&last.u);
        let size = norm((&last.tangent.0, last.tangent.1, last.tangent.2), spans);
        let along = (
            last.tangent.0.iter().map(|x| x / size).collect::<Vec<f64>>(),
            last.tangent.1 / size,
            last.tangent.2 / size,
        );
        let straight: Point = (
            last.u.iter().zip(&along.0).map(|(u, t)| u + step * t).collect(),
            last.frequency + step * along.1,
            last.parameter + step * along.2,
        );
        let mut row = weighted((&along.0, along.1, along.2), spans);
        let target = dot(&row, &straight);
        let mut borders = (unit(&last.w), unit(&last.v));
        let mut point = predicted(recent, &set, &along, spans, step);
        let r = (row.0.as_slice(), row.1, row.2);
        self.counted.iterations +=
            self.system.correct(&mut point, (&borders.0, &borders.1), r, target, spans)?;
        let d: Vec<f64> = point.0.iter().zip(&straight.0).map(|(a, b)| a - b).collect();
        let miss = norm((&d, point.1 - straight.1, point.2 - straight.2), spans);
        let mut sample = self.system.sample(point, (&borders.0, &borders.1), r, spans)?;
        while self.settings.harmonics.is_none()
            && sample.truncation > self.settings.tolerance
            && set.highest() < MOST_HARMONICS
        {
            let next = set.up_to(set.highest() + 2.max(set.highest() / 5).next_multiple_of(2));
            let fit = |x: &[f64]| refit(&set, &next, 1, x);
            let mut point = (fit(&sample.u), sample.frequency, sample.parameter);
            row.0 = fit(&row.0);
            borders = (unit(&fit(&sample.w)), unit(&fit(&sample.v)));
            set = next;
            self.use_set(&set);
            let r = (row.0.as_slice(), row.1, row.2);
            self.system.correct(&mut point, (&borders.0, &borders.1), r, target, spans)?;
            sample = self.system.sample(point, (&borders.0, &borders.1), r, spans)?;
        }
        let before = refit(&last.set, &set, 1, &along.0);
        let turn = inner(
            (&sample.tangent.0, sample.tangent.1, sample.tangent.2),
            (&before, along.1, along.2),
            spans,
        );
        if turn < 0.4 && step > 1e2 * SHORTEST {
            return Err(Failure::NotConverged);
        }
        // Null vectors keep their side along the curve.
        let side: f64 =
            refit(&last.set, &set, 1, &last.v).iter().zip(&sample.v).map(|(a, b)| a * b).sum();
        debug_assert!(side.is_finite());
        Ok((sample, miss))
    }

    /// The fold at a part of the way from one sample to the next, over a set of harmonics.
    fn between(
        &mut self,
        (from, to): (&FoldSample, &FoldSample),
        part: f64,
        set: &HarmonicSet,
    ) -> Result<FoldSample, Failure> {
        self.use_set(set);
        let fit = |sample: &FoldSample, x: &[f64]| refit(&sample.set, set, 1, x);
        let (a, b) = (fit(from, &from.u), fit(to, &to.u));
        let spans = self.spans(&a);
        let chord: Point = (
            b.iter().zip(&a).map(|(b, a)| b - a).collect(),
            to.frequency - from.frequency,
            to.parameter - from.parameter,
        );
        let row = weighted((&chord.0, chord.1, chord.2), spans);
        let mut point: Point = (
            a.iter().zip(&chord.0).map(|(a, d)| a + part * d).collect(),
            from.frequency + part * chord.1,
            from.parameter + part * chord.2,
        );
        let target = dot(&row, &point);
        let borders = (unit(&fit(from, &from.w)), unit(&fit(from, &from.v)));
        let r = (row.0.as_slice(), row.1, row.2);
        self.counted.iterations +=
            self.system.correct(&mut point, (&borders.0, &borders.1), r, target, spans)?;
        self.system.sample(point, (&borders.0, &borders.1), r, spans)
    }

    /// The fold on the border of the window.
    fn border(&mut self, inside: &FoldSample, outside: &FoldSample) -> Option<FoldSample> {
        let share = |(low, high): (f64, f64), a: f64, b: f64| {
            if b < low {
                (low - a) / (b - a)
            } else if b > high {
                (high - a) / (b - a)
            } else {
                1.0
            }
        };
        let (f, p) = (self.settings.frequency, self.settings.parameter);
        let by_frequency = share(f, inside.frequency, outside.frequency);
        let by_parameter = share(p, inside.parameter, outside.parameter);
        let set = outside.set.clone();
        self.use_set(&set);
        let part = by_frequency.min(by_parameter);
        let fit = |sample: &FoldSample, x: &[f64]| refit(&sample.set, &set, 1, x);
        let (a, b) = (fit(inside, &inside.u), fit(outside, &outside.u));
        let spans = self.spans(&a);
        let mut point: Point = (
            a.iter().zip(&b).map(|(a, b)| a + part * (b - a)).collect(),
            inside.frequency + part * (outside.frequency - inside.frequency),
            inside.parameter + part * (outside.parameter - inside.parameter),
        );
        let none = vec![0.0; a.len()];
        let (row, target) = if by_frequency < by_parameter {
            let at = if outside.frequency < f.0 { f.0 } else { f.1 };
            ((none.as_slice(), 1.0, 0.0), at)
        } else {
            let at = if outside.parameter < p.0 { p.0 } else { p.1 };
            ((none.as_slice(), 0.0, 1.0), at)
        };
        let borders = (unit(&fit(outside, &outside.w)), unit(&fit(outside, &outside.v)));
        self.system.correct(&mut point, (&borders.0, &borders.1), row, target, spans).ok()?;
        self.system.sample(point, (&borders.0, &borders.1), row, spans).ok()
    }

    fn specials(&mut self, samples: &[FoldSample]) -> Vec<FoldSpecial> {
        let mut found = Vec::new();
        for pair in samples.windows(2) {
            let (a, b) = (&pair[0], &pair[1]);
            let oriented = sides(a, b);
            let bend = |sample: &FoldSample| sample.bend * sides(a, sample);
            if a.bend * b.bend * oriented < 0.0 {
                if let Some((sample, precision)) = self.locate((a, b), &bend) {
                    found.push(FoldSpecial { kind: SpecialKind::Cusp, sample, precision });
                }
            } else if a.tangent.2 * b.tangent.2 < 0.0 {
                let turn = |sample: &FoldSample| sample.tangent.2;
                if let Some((sample, precision)) = self.locate((a, b), &turn) {
                    self.use_set(&sample.set.clone());
                    let kind = match self.system.hessian(&sample) {
                        Ok(determinant) if determinant > 0.0 => SpecialKind::IsolaBirth,
                        Ok(_) => SpecialKind::IsolaMerger,
                        Err(_) => continue,
                    };
                    found.push(FoldSpecial { kind, sample, precision });
                }
            }
        }
        found
    }

    /// A zero of a test between two samples, harmonics added until it stands still.
    fn locate(
        &mut self,
        pair: (&FoldSample, &FoldSample),
        test: &dyn Fn(&FoldSample) -> f64,
    ) -> Option<(FoldSample, f64)> {
        let mut set = pair.0.set.up_to(pair.0.set.highest().max(pair.1.set.highest()));
        let (mut sample, mut part) = self.close_in(pair, test, &set, (0.0, 1.0))?;
        let mut precision = 1e-12;
        if self.settings.harmonics.is_some() {
            return Some((sample, precision));
        }
        for _ in 0..MOST_ROUNDS {
            let next = set.up_to(
                (set.highest() + 2.max(set.highest() / 4).next_multiple_of(2)).min(MOST_HARMONICS),
            );
            let mut width = 1e-2;
            let better = loop {
                let bracket = ((part - width).max(-0.3), (part + width).min(1.3));
                match self.close_in(pair, test, &next, bracket) {
                    Some(found) => break Some(found),
                    None if width < 0.5 => width *= 6.0,
                    None => break None,
                }
            };
            let Some((found, place)) = better else { break };
            let moved = |a: f64, b: f64| (a - b).abs() / b.abs().max(f64::MIN_POSITIVE);
            precision = moved(sample.frequency, found.frequency)
                .max(moved(sample.parameter, found.parameter));
            (sample, part, set) = (found, place, next);
            if precision < SETTLED {
                break;
            }
        }
        Some((sample, precision))
    }

    fn close_in(
        &mut self,
        pair: (&FoldSample, &FoldSample),
        test: &dyn Fn(&FoldSample) -> f64,
        set: &HarmonicSet,
        (low, high): (f64, f64),
    ) -> Option<(FoldSample, f64)> {
        let settings = RootSettings {
            absolute_tolerance: 1e-13,
            relative_tolerance: 0.0,
            ..RootSettings::default()
        };
        let root = find_root(
            |part| self.between(pair, part, set).map_or(f64::NAN, |sample| test(&sample)),
            low,
            high,
            settings,
        )
        .ok()?;
        let sample = self.between(pair, root.value, set).ok()?;
        Some((sample, root.value))
    }
}
