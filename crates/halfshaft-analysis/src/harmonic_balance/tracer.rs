//! Branches of responses by pseudo-arclength continuation.
//!
//! Each step predicts along the curve (by the polynomial through the last samples), corrects by
//! Newton's method in the plane across the tangent, and measures how far the tangent alone would have
//! missed: that error steers the step, so that samples lie dense where the curve bends. Lengths are
//! relative to the size of the present response and to the width of the range, so nothing needs
//! tuning. Source: H. B. Keller, in *Applications of Bifurcation Theory* (1977); step control by the
//! prediction's error as in A. Nayfeh, B. Balachandran, *Applied Nonlinear Dynamics* (1995), section 6.
//! Harmonics are added and dropped from sample to sample as the tolerance asks.

use halfshaft_numerics::blocks::Factors;
use halfshaft_numerics::harmonics::HarmonicSet;
use halfshaft_numerics::observer::Observer;

use super::closing::comes_back;
use super::predictor::{PREDICTED_FROM, predicted};
use super::problem::{Condition, Corrected, Failure, Metric, Problem};

/// A response on a branch.
#[derive(Clone, Debug)]
pub(crate) struct Sample {
    pub(crate) set: HarmonicSet,
    /// Coefficients of the kept groups.
    pub(crate) u: Vec<f64>,
    /// Running parameter.
    pub(crate) p: f64,
    /// Direction of the curve, of unit length in `metric`.
    pub(crate) tangent: Vec<f64>,
    pub(crate) tangent_p: f64,
    pub(crate) metric: (f64, f64),
    /// Sign of the determinant of the Jacobian bordered by the curve's own direction: it changes
    /// where another curve crosses.
    pub(crate) orientation: f64,
    pub(crate) truncation: f64,
}

/// Coefficients of a node from which on a sample counts for more than one.
const FEW_COEFFICIENTS: f64 = 60.0;

impl Sample {
    /// Work on the sample, over that of one of few harmonics.
    pub(super) fn work(&self) -> f64 {
        work_of(&self.set)
    }
}

/// Work on a sample over a set, over that of one of few harmonics: it grows with their square at least.
pub(super) fn work_of(set: &HarmonicSet) -> f64 {
    (set.coefficients() as f64 / FEW_COEFFICIENTS).powi(2).max(1.0)
}

/// Why a branch ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum BranchEnd {
    /// At the lower or upper end of the range.
    Range,
    /// Where it began.
    Closed,
    /// The step became too small.
    StepTooSmall,
    /// As many samples as allowed.
    SampleLimit,
    /// The response grew beyond all measure.
    Unbounded,
    /// Where a contact closes and opens too often to be followed.
    Chattering,
    /// Where a twist grazes a break of its law, nothing beyond.
    Grazing,
    /// The user stopped it.
    Cancelled,
    /// The value that was looked for has been met often enough.
    Enough,
}

/// The numbers of the continuation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TraceSettings {
    /// Range of the running parameter.
    pub(crate) range: (f64, f64),
    /// Error of the waveform that is tolerated, relative; harmonics adapt to it.
    pub(crate) tolerance: f64,
    /// Number of harmonics where it is fixed.
    pub(crate) harmonics: Option<usize>,
    /// Miss of the tangent that is aimed at, in the metric.
    pub(crate) miss: f64,
    /// Whether long steps that lead below the range are taken for jumps to another curve.
    pub(crate) floored: bool,
    /// First step, in the metric.
    pub(crate) first: f64,
    /// Longest step.
    pub(crate) longest: f64,
    /// Samples of a branch at most, those of many harmonics counted for more than one.
    pub(crate) most_samples: usize,
    /// Size of the response at which it counts as unbounded.
    pub(crate) most_size: f64,
}

/// Default of [`TraceSettings::miss`].
pub(crate) const MISS: f64 = 0.001;
/// Default of [`TraceSettings::first`].
pub(crate) const FIRST: f64 = 0.02;
/// Default of [`TraceSettings::longest`].
pub(crate) const LONGEST: f64 = 0.08;
/// Shortest step, in the metric.
const SHORTEST: f64 = 1e-9;
/// A step no longer than this stays on its curve, in the metric.
const SURELY_ON: f64 = 0.05;
/// Highest order of harmonics that is tried.
pub(crate) const MOST_HARMONICS: usize = 200;
/// Samples of a branch that there is room for at first.
const FIRST_ROOM: usize = 64;
/// Harmonics that are always kept.
pub(super) const LEAST_HARMONICS: usize = 3;

/// Effort of a continuation.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Counted {
    pub(crate) steps: usize,
    pub(crate) iterations: usize,
    pub(crate) seeds: usize,
}

impl Counted {
    /// Adds the effort of another part of the work.
    pub(super) fn add(&mut self, other: Self) {
        self.steps += other.steps;
        self.iterations += other.iterations;
        self.seeds += other.seeds;
    }
}

/// Follows branches of one curve problem.
pub(super) struct Tracer<'t, 'f> {
    pub(super) problem: Problem<'f>,
    /// Problems of other numbers of harmonics, for later use.
    spare: Vec<Problem<'f>>,
    pub(super) settings: TraceSettings,
    pub(super) observer: &'t dyn Observer,
    pub(super) counted: Counted,
    /// Whether the tolerance asked for more harmonics than there are.
    pub(super) exhausted: bool,
}

/// Euclidean length.
pub(super) fn length(u: &[f64]) -> f64 {
    u.iter().map(|x| x * x).sum::<f64>().sqrt()
}

impl<'t, 'f> Tracer<'t, 'f> {
    pub(super) fn new(
        problem: Problem<'f>,
        settings: TraceSettings,
        observer: &'t dyn Observer,
    ) -> Self {
        let counted = Counted::default();
        Self { problem, spare: Vec::new(), settings, observer, counted, exhausted: false }
    }

    /// Makes the problem one of the given harmonics and fits `u` to it.
    pub(super) fn use_set(&mut self, set: &HarmonicSet, u: &mut Vec<f64>, from: &HarmonicSet) {
        self.choose(set);
        if from != set {
            *u = refit(from, set, 1, u);
        }
    }

    /// Makes the problem one of the given harmonics.
    pub(super) fn choose(&mut self, set: &HarmonicSet) {
        if self.problem.system.set != *set {
            let known = self.spare.iter().position(|problem| problem.system.set == *set);
            let mut next = match known {
                Some(at) => self.spare.swap_remove(at),
                None => self.problem.with_set(set.clone()),
            };
            next.place = self.problem.place;
            std::mem::swap(&mut self.problem, &mut next);
            self.spare.push(next);
        }
    }

    pub(super) fn metric(&self, u: &[f64]) -> Metric {
        let (low, high) = self.settings.range;
        let floor = f64::MIN_POSITIVE.sqrt();
        Metric { size: length(u).max(floor), span: (high - low).max(floor) }
    }

    /// A sample from a guess at a fixed value of the running parameter, harmonics adapted.
    pub(super) fn seed(
        &mut self,
        set: &HarmonicSet,
        guess: &[f64],
        p: f64,
    ) -> Result<Sample, Failure> {
        let mut u = guess.to_vec();
        self.choose(set);
        self.counted.seeds += 1;
        let mut set = set.clone();
        for _ in 0..MOST_HARMONICS {
            let size = length(&u).max(f64::MIN_POSITIVE.sqrt());
            let done = self.problem.at(&mut u, p, size)?;
            self.counted.iterations += done.iterations;
            let Some(next) = self.adapted(&set, &u) else { break };
            self.use_set(&next, &mut u, &set);
            set = next;
        }
        let metric = self.metric(&u);
        self.finish_sample(set, u, p, &metric, None)
    }

    /// Direction and orientation of the curve at a converged response.
    pub(super) fn finish_sample(
        &mut self,
        set: HarmonicSet,
        u: Vec<f64>,
        p: f64,
        metric: &Metric,
        along: Option<(&[f64], f64)>,
    ) -> Result<Sample, Failure> {
        let fallback = vec![0.0; u.len()];
        let (row, corner) = along.unwrap_or((&fallback, 1.0));
        let weighted: Vec<f64> = row.iter().map(|x| x / (metric.size * metric.size)).collect();
        self.problem.evaluate(&u, p)?;
        self.problem.factorise(&weighted, corner / (metric.span * metric.span))?;
        Ok(self.sample_of_factors(set, u, p, metric))
    }

    /// The same with the factors as they are.
    fn sample_of_factors(
        &mut self,
        set: HarmonicSet,
        u: Vec<f64>,
        p: f64,
        metric: &Metric,
    ) -> Sample {
        let (tangent, tangent_p) = self.problem.tangent(metric);
        let orientation = self.problem.factors.as_ref().map_or(1.0, Factors::sign);
        let truncation = self.problem.system.truncation;
        let metric = (metric.size, metric.span);
        Sample { set, u, p, tangent, tangent_p, metric, orientation, truncation }
    }

    /// Follows the curve from `start` in the direction of `sign` times its tangent.
    pub(super) fn follow(&mut self, start: &Sample, sign: f64) -> (Vec<Sample>, BranchEnd) {
        let mut samples = Vec::with_capacity(FIRST_ROOM);
        samples.push(oriented(start, sign));
        let mut step = self.settings.first;
        let mut set = start.set.clone();
        self.choose(&set);
        let mut work = 0.0;
        let end = loop {
            if self.observer.cancelled() {
                break BranchEnd::Cancelled;
            }
            work += samples.last().map_or(0.0, Sample::work);
            if work >= self.settings.most_samples as f64 {
                break BranchEnd::SampleLimit;
            }
            let (low, high) = self.settings.range;
            match self.advance(&samples, &mut step, &mut set) {
                Ok(next) if next.p < low || next.p > high => {
                    let border = if next.p < low { low } else { high };
                    if let Some(last) = samples.last()
                        && let Some(end) = self.border(last, &next, border)
                    {
                        samples.push(end);
                    }
                    break BranchEnd::Range;
                }
                Ok(next) => {
                    let closed = samples.len() > 3 && comes_back(&samples, &next);
                    if closed {
                        samples.push(oriented(&samples[0].clone(), 1.0));
                        break BranchEnd::Closed;
                    }
                    let unbounded = length(&next.u) > self.settings.most_size;
                    samples.push(next);
                    if unbounded {
                        break BranchEnd::Unbounded;
                    }
                }
                Err(_) => break BranchEnd::StepTooSmall,
            }
        };
        (samples, end)
    }

    /// The next sample after the last.
    fn advance(
        &mut self,
        samples: &[Sample],
        step: &mut f64,
        set: &mut HarmonicSet,
    ) -> Result<Sample, Failure> {
        let recent: Vec<&Sample> = samples.iter().rev().take(PREDICTED_FROM).collect();
        loop {
            self.counted.steps += 1;
            let tried = self.try_step(&recent, *step, set).and_then(|(next, miss)| {
                let long = self.settings.floored && *step > SURELY_ON;
                let below = long && next.p <= self.settings.range.0;
                if below { Err(Failure::NotConverged) } else { Ok((next, miss)) }
            });
            match tried {
                Ok((next, miss)) => {
                    // The tangent misses by the square of the step.
                    let factor = (self.settings.miss / miss.max(1e-12)).sqrt().clamp(0.3, 1.8);
                    let too_far = miss > 6.0 * self.settings.miss && *step > 1e3 * SHORTEST;
                    *step = (*step * factor).min(self.settings.longest);
                    if too_far {
                        continue;
                    }
                    return Ok(next);
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

    /// One step of the given length from the latest of the recent samples; also how far the tangent alone misses.
    fn try_step(
        &mut self,
        recent: &[&Sample],
        step: f64,
        set: &mut HarmonicSet,
    ) -> Result<(Sample, f64), Failure> {
        let Some(last) = recent.first() else { return Err(Failure::NotConverged) };
        self.choose(set);
        let from = refit(&last.set, set, 1, &last.u);
        let metric = self.metric(&from);
        let mut along = refit(&last.set, set, 1, &last.tangent);
        let mut along_p = last.tangent_p;
        let norm = metric.norm(&along, along_p);
        along.iter_mut().for_each(|x| *x /= norm);
        along_p /= norm;
        let mut straight = from;
        straight.iter_mut().zip(&along).for_each(|(u, t)| *u += step * t);
        let straight_p = last.p + step * along_p;
        let (mut u, mut p) = predicted(recent, set, &metric, step, (&along, along_p));
        let weights: Vec<f64> = along.iter().map(|x| x / (metric.size * metric.size)).collect();
        let corner = along_p / (metric.span * metric.span);
        let target = |weights: &[f64], at: &[f64], at_p: f64| {
            weights.iter().zip(at).map(|(w, x)| w * x).sum::<f64>() + corner * at_p
        };
        let held = target(&weights, &straight, straight_p);
        let condition = Condition { row: &weights, corner, target: held };
        let done = self.problem.correct_next(&mut u, &mut p, &condition, &metric)?;
        self.counted.iterations += done.iterations;
        straight.iter_mut().zip(&u).for_each(|(a, b)| *a -= b);
        let miss = metric.norm(&straight, p - straight_p);
        // More or fewer harmonics where the tolerance asks for them.
        let mut resized = weights;
        for _ in 0..MOST_HARMONICS {
            let Some(next) = self.adapted(set, &u) else { break };
            resized = refit(set, &next, 1, &resized);
            self.use_set(&next, &mut u, set);
            *set = next;
            let condition = Condition { row: &resized, corner, target: held };
            let done: Corrected = self.problem.correct(&mut u, &mut p, &condition, &metric)?;
            self.counted.iterations += done.iterations;
        }
        let along = refit(&last.set, set, 1, &last.tangent);
        let sample = self.sample_of_factors(set.clone(), u, p, &metric);
        let turn = metric.dot((&sample.tangent, sample.tangent_p), (&along, last.tangent_p));
        let turn = turn / metric.norm(&along, last.tangent_p);
        if turn < 0.5 && step > 1e2 * SHORTEST {
            return Err(Failure::NotConverged);
        }
        Ok((sample, miss))
    }

    /// The response at the border of the range, between two samples.
    fn border(&mut self, inside: &Sample, outside: &Sample, border: f64) -> Option<Sample> {
        let part = (border - inside.p) / (outside.p - inside.p);
        let set = outside.set.clone();
        let inner = refit(&inside.set, &set, 1, &inside.u);
        let mut u: Vec<f64> =
            inner.iter().zip(&outside.u).map(|(a, b)| a + part * (b - a)).collect();
        self.choose(&set);
        let metric = self.metric(&u);
        self.problem.at(&mut u, border, metric.size).ok()?;
        let metric = self.metric(&u);
        let along = refit(&inside.set, &set, 1, &inside.tangent);
        self.finish_sample(set, u, border, &metric, Some((&along, inside.tangent_p))).ok()
    }
}

/// Coefficients of all nodes over another set of harmonics.
pub(super) fn refit(from: &HarmonicSet, to: &HarmonicSet, factor: usize, u: &[f64]) -> Vec<f64> {
    let (m, n) = (from.coefficients(), to.coefficients());
    // Room for one more: a running parameter is often put behind.
    let mut out = Vec::with_capacity(u.len() / m * n + 1);
    if from == to && factor == 1 {
        out.extend_from_slice(u);
        return out;
    }
    out.resize(u.len() / m * n, 0.0);
    for (source, target) in u.chunks_exact(m).zip(out.chunks_exact_mut(n)) {
        to.take(from, factor, source, target);
    }
    out
}

fn oriented(sample: &Sample, sign: f64) -> Sample {
    let mut sample = sample.clone();
    if sign < 0.0 {
        sample.tangent.iter_mut().for_each(|x| *x = -*x);
        sample.tangent_p = -sample.tangent_p;
        // The border row changes its sign with the direction, and the determinant with it.
        sample.orientation = -sample.orientation;
    }
    sample
}
