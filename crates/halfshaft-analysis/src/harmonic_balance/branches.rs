//! All branches of one question: seeds followed, joined, told apart, and those that branch off.

use halfshaft_model::question::StabilityMethod;
use halfshaft_numerics::harmonics::HarmonicSet;
use halfshaft_numerics::observer::Observer;
use halfshaft_results::SpecialKind;

use super::gaps::{stretch, uncovered};
use super::line::Line;
use super::problem::{Axis, Problem};
use super::refine::refine;
use super::seeds::Seed;
use super::special::Special;
use super::stability::{Judge, Stability};
use super::system::{HarmonicSystem, Place};
use super::tracer::{BranchEnd, Counted, Sample, TraceSettings, Tracer, length, refit};

/// A branch with what is known of it.
#[derive(Clone, Debug)]
pub(crate) struct TracedBranch {
    pub(crate) samples: Vec<Sample>,
    pub(crate) stability: Vec<Stability>,
    pub(crate) specials: Vec<Special>,
    /// Order of the fundamental of its harmonics.
    pub(crate) base: f64,
    pub(crate) periods: u32,
    pub(crate) origin: String,
    pub(crate) ends: [BranchEnd; 2],
}

impl TracedBranch {
    /// The stable part of the stretch from a sample to the next.
    pub(super) fn stable_between(&self, at: usize) -> Option<(f64, f64)> {
        let special = self.specials.iter().find(|special| special.after == at);
        let end = |at: usize| (self.samples[at].p, self.stability[at].is_stable());
        stretch(end(at), end(at + 1), special.map(|special| special.sample.p))
    }

    pub(crate) fn closed(&self) -> bool {
        self.ends[1] == BranchEnd::Closed
    }
}

/// Everything that was found over one axis.
pub(crate) struct Collected {
    pub(crate) branches: Vec<TracedBranch>,
    pub(crate) counted: Counted,
    pub(crate) exhausted: bool,
    pub(crate) cancelled: bool,
    pub(crate) messages: Vec<String>,
    /// Values of the parameter at which a guess by one harmonic led to no response.
    pub(crate) lost: Vec<f64>,
    /// Whether branches are exact orbits.
    pub(crate) exact: bool,
    /// Whether something was not followed since enough had been found.
    pub(crate) cut: bool,
}

/// Work on one question after which nothing further is followed, in samples of few harmonics.
const MOST_WORK: f64 = 6000.0;
impl Collected {
    /// Whether so much has been found that nothing further is followed, which is noted.
    pub(super) fn cut_off(&mut self) -> bool {
        let samples = self.branches.iter().flat_map(|branch| &branch.samples);
        let full = samples.map(Sample::work).sum::<f64>() > MOST_WORK;
        self.cut |= full;
        full
    }

    /// Ranges over which no branch is stable, apart from narrow ones.
    pub(super) fn gaps(&self, range: (f64, f64)) -> Vec<(f64, f64)> {
        uncovered(self.stretches(TracedBranch::stable_between), range)
    }

    /// Whether a branch is stable at a value of the parameter.
    pub(super) fn is_stable_at(&self, p: f64) -> bool {
        let list = self.stretches(TracedBranch::stable_between);
        list.iter().any(|(low, high)| *low <= p && p <= *high)
    }

    /// Whether there is a response at a value of the parameter.
    pub(super) fn is_known_at(&self, p: f64) -> bool {
        let whole = |branch: &TracedBranch, at: usize| {
            stretch((branch.samples[at].p, true), (branch.samples[at + 1].p, true), None)
        };
        self.stretches(whole).iter().any(|(low, high)| *low <= p && p <= *high)
    }

    fn stretches(
        &self,
        of: impl Fn(&TracedBranch, usize) -> Option<(f64, f64)>,
    ) -> Vec<(f64, f64)> {
        let all = self
            .branches
            .iter()
            .flat_map(|branch| (1..branch.samples.len()).map(move |next| (branch, next - 1)));
        all.filter_map(|(branch, at)| of(branch, at)).collect()
    }
}

/// What is being traced and how.
pub(super) struct Job<'j, 'f> {
    pub(super) line: &'j Line,
    pub(super) axis: Axis<'f>,
    pub(super) place: Place,
    pub(super) base: f64,
    pub(super) settings: TraceSettings,
    pub(super) observer: &'j dyn Observer,
    /// Whether responses of twice the period are followed where they branch off.
    pub(super) doublings: bool,
    pub(super) stability: StabilityMethod,
    /// Whether stability and what depends on it are wanted, or folds only.
    pub(super) judged: bool,
}

/// Responses this near to a branch, relative, are on it.
const SAME: f64 = 1e-5;
/// Responses farther than this from the chord of two samples are not between them, in the metric.
const REACH: f64 = 0.1;
/// Samples this near to a branch, relative, run along it: the miss of its straight pieces.
const ALONG: f64 = 5e-3;
/// Guesses this near to a branch are not worth a try.
pub(super) const NEAR: f64 = 0.02;

impl<'j, 'f> Job<'j, 'f> {
    pub(super) fn tracer(&self, set: HarmonicSet, base: f64) -> Tracer<'j, 'f> {
        let system = HarmonicSystem::new(self.line.clone(), set, base);
        Tracer::new(Problem::new(system, self.axis, self.place), self.settings, self.observer)
    }

    /// Follows every seed that is not on a branch yet, then what branches off.
    pub(super) fn collect(&self, seeds: &[(Seed, f64, String)]) -> Collected {
        let mut all = Collected {
            branches: Vec::new(),
            counted: Counted::default(),
            exhausted: false,
            cancelled: false,
            messages: Vec::new(),
            lost: Vec::new(),
            exact: false,
            cut: false,
        };
        let Some((first, _, _)) = seeds.first() else { return all };
        let mut tracer = self.tracer(first.set.clone(), self.base);
        let mut judge = Judge::new(&tracer.problem.system, self.stability);
        for (seed, p, origin) in seeds {
            if self.observer.cancelled() {
                all.cancelled = true;
                break;
            }
            let near = |branch: &TracedBranch| on_branch(branch, &seed.set, &seed.u, *p, NEAR);
            if all.branches.iter().any(near) {
                continue;
            }
            if all.cut_off() {
                break;
            }
            let start = self.start_set(&seed.set);
            let guess = refit(&seed.set, &start, 1, &seed.u);
            match tracer.seed(&start, &guess, *p) {
                Ok(sample) => {
                    let known = |branch: &TracedBranch| {
                        on_branch(branch, &sample.set, &sample.u, *p, SAME)
                            || refined(&mut tracer, branch, &sample)
                    };
                    if all.branches.iter().any(known) {
                        continue;
                    }
                    let branch = self.both_ways(&mut tracer, &mut judge, &sample, origin.clone());
                    all.branches.push(branch);
                }
                Err(_) => all.lost.push(*p),
            }
        }
        all.counted.seeds = tracer.counted.seeds;
        all.counted.steps += tracer.counted.steps;
        all.counted.iterations += tracer.counted.iterations;
        all.exhausted |= tracer.exhausted;
        drop(tracer);
        merge_duplicates(&mut all.branches);
        if self.judged {
            self.branch_off(&mut all);
        }
        all.cancelled |= all.branches.iter().any(|b| b.ends.contains(&BranchEnd::Cancelled));
        all
    }

    /// Harmonics to begin with.
    fn start_set(&self, set: &HarmonicSet) -> HarmonicSet {
        let least = super::tracer::LEAST_HARMONICS.max(set.highest());
        set.up_to(self.settings.harmonics.unwrap_or(least))
    }

    pub(super) fn both_ways(
        &self,
        tracer: &mut Tracer<'_, '_>,
        judge: &mut Judge,
        start: &Sample,
        origin: String,
    ) -> TracedBranch {
        let (low, high) = self.settings.range;
        let (mut samples, mut ends) = (Vec::new(), [BranchEnd::Range; 2]);
        let rising = if start.tangent_p < 0.0 { -1.0 } else { 1.0 };
        let first_sign = if start.p <= low { None } else { Some(-rising) };
        if let Some(sign) = first_sign {
            let (back, end) = tracer.follow(start, sign);
            ends[0] = end;
            samples = back;
            if end == BranchEnd::Closed {
                ends[1] = end;
            } else {
                samples.reverse();
                samples.iter_mut().for_each(flip);
            }
        }
        if ends[1] != BranchEnd::Closed && start.p < high {
            let (ahead, end) = tracer.follow(start, rising);
            ends[1] = end;
            samples.truncate(samples.len().saturating_sub(1));
            samples.extend(ahead);
        }
        self.judged(tracer, judge, samples, ends, 1, origin)
    }

    pub(super) fn judged(
        &self,
        tracer: &mut Tracer<'_, '_>,
        judge: &mut Judge,
        samples: Vec<Sample>,
        ends: [BranchEnd; 2],
        periods: u32,
        origin: String,
    ) -> TracedBranch {
        if !self.judged {
            let unknown = vec![Stability::default(); samples.len()];
            let specials = tracer.folds(judge, &samples);
            let base = tracer.problem.system.base;
            return TracedBranch {
                samples,
                stability: unknown,
                specials,
                base,
                periods,
                origin,
                ends,
            };
        }
        let stability = tracer.judge_all(judge, &samples);
        let mut specials = tracer.specials(judge, &samples, &stability);
        let base = tracer.problem.system.base;
        if tracer.shoots() {
            for special in specials.iter_mut().filter(|special| special.located) {
                let pair = (&samples[special.after], &samples[special.after + 1]);
                refine(self.line, base, pair, special);
            }
            // Harmonics that come and go make a curve with kinks waver: what no orbit confirms is no
            // fold.
            specials.retain(|special| {
                special.kind != SpecialKind::Fold || special.precision.is_finite()
            });
        }
        TracedBranch { samples, stability, specials, base, periods, origin, ends }
    }
}

/// Drops branches that run along another: pieces of it that were followed from a seed of their own.
fn merge_duplicates(branches: &mut Vec<TracedBranch>) {
    let along = |piece: &TracedBranch, whole: &TracedBranch| {
        let count = piece.samples.len();
        count > 0
            && piece.base == whole.base
            && [count / 4, count / 2, 3 * count / 4].into_iter().all(|at| {
                let sample = &piece.samples[at];
                on_branch(whole, &sample.set, &sample.u, sample.p, ALONG)
            })
    };
    let mut at = 0;
    while at < branches.len() {
        let piece = &branches[at];
        let longer = |other: &TracedBranch| other.samples.len() > piece.samples.len();
        let duplicate = branches.iter().any(|whole| longer(whole) && along(piece, whole));
        if duplicate {
            branches.remove(at);
        } else {
            at += 1;
        }
    }
}

pub(super) fn flip(sample: &mut Sample) {
    sample.tangent.iter_mut().for_each(|x| *x = -*x);
    sample.tangent_p = -sample.tangent_p;
    sample.orientation = -sample.orientation;
}

/// Whether a response lies on a branch, to a part of its size.
pub(super) fn on_branch(
    branch: &TracedBranch,
    set: &HarmonicSet,
    u: &[f64],
    p: f64,
    part: f64,
) -> bool {
    distance(branch, set, u, p).is_some_and(|near| near < part)
}

/// Least distance of a response from the branch at its parameter, relative to its size.
fn distance(branch: &TracedBranch, set: &HarmonicSet, u: &[f64], p: f64) -> Option<f64> {
    let size = length(u).max(f64::MIN_POSITIVE.sqrt());
    let pairs = branch.samples.windows(2).filter(|pair| (pair[0].p - p) * (pair[1].p - p) <= 0.0);
    pairs
        .map(|pair| {
            let (a, b) =
                (refit(&pair[0].set, set, 1, &pair[0].u), refit(&pair[1].set, set, 1, &pair[1].u));
            let span = pair[1].p - pair[0].p;
            let part = if span == 0.0 { 0.5 } else { (p - pair[0].p) / span };
            let d = a.iter().zip(&b).zip(u).map(|((a, b), u)| (a + part * (b - a) - u).powi(2));
            d.sum::<f64>().sqrt() / size
        })
        .reduce(f64::min)
}

/// Whether a response is met by correcting the nearest places of a branch, each in the plane across
/// the branch in which the response lies: that works at folds as well as elsewhere.
fn refined(tracer: &mut Tracer<'_, '_>, branch: &TracedBranch, sample: &Sample) -> bool {
    let size = length(&sample.u).max(f64::MIN_POSITIVE.sqrt());
    branch.samples.windows(2).any(|pair| {
        let fit = |s: &Sample| refit(&s.set, &sample.set, 1, &s.u);
        let (a, b) = (fit(&pair[0]), fit(&pair[1]));
        let metric = tracer.metric(&a);
        let from_a = |u: &[f64]| u.iter().zip(&a).map(|(u, a)| u - a).collect::<Vec<f64>>();
        let (chord, chord_p) = (from_a(&b), pair[1].p - pair[0].p);
        let (d, d_p) = (from_a(&sample.u), sample.p - pair[0].p);
        let square = metric.norm(&chord, chord_p).powi(2);
        let part = metric.dot((&d, d_p), (&chord, chord_p)) / square;
        if !(-0.05..=1.05).contains(&part) {
            return false;
        }
        let off: Vec<f64> = d.iter().zip(&chord).map(|(d, c)| d - part * c).collect();
        if metric.norm(&off, d_p - part * chord_p) > REACH {
            return false;
        }
        let Ok(place) = tracer.on_segment((&pair[0], &pair[1]), part, &sample.set) else {
            return false;
        };
        let away = place.u.iter().zip(&sample.u).map(|(a, b)| (a - b) * (a - b)).sum::<f64>();
        away.sqrt() < SAME * size && (place.p - sample.p).abs() < SAME * metric.span
    })
}
