//! All branches of one question: seeds followed, joined, told apart, and those that branch off.

use halfshaft_numerics::harmonics::HarmonicSet;
use halfshaft_numerics::observer::Observer;
use halfshaft_results::SpecialKind;

use super::line::Line;
use super::problem::{Axis, Condition, Problem};
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
    /// Whether stability and what depends on it are wanted, or folds only.
    pub(super) judged: bool,
}

/// Responses this near to a branch, relative, are on it.
const SAME: f64 = 1e-5;
/// Responses farther than this from the chord of two samples are not between them, in the metric.
const REACH: f64 = 0.1;
/// Guesses this near to a branch are not worth a try.
const NEAR: f64 = 0.02;
/// How far from a branch point the first response of the other branch is looked for, relative.
const OFFSET: f64 = 1e-2;

impl<'j, 'f> Job<'j, 'f> {
    fn tracer(&self, set: HarmonicSet, base: f64) -> Tracer<'j, 'f> {
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
        };
        let Some((first, _, _)) = seeds.first() else { return all };
        let mut tracer = self.tracer(first.set.clone(), self.base);
        let mut judge = Judge::new(&tracer.problem.system);
        for (seed, p, origin) in seeds {
            if self.observer.cancelled() {
                all.cancelled = true;
                break;
            }
            let near = |branch: &TracedBranch| on_branch(branch, &seed.set, &seed.u, *p, NEAR);
            if all.branches.iter().any(near) {
                continue;
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
                Err(_) => all.messages.push(format!(
                    "a response guessed by one harmonic at {p:.6} could not be made one of more harmonics"
                )),
            }
        }
        all.counted.seeds = tracer.counted.seeds;
        all.counted.steps += tracer.counted.steps;
        all.counted.iterations += tracer.counted.iterations;
        all.exhausted |= tracer.exhausted;
        drop(tracer);
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

    fn both_ways(
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

    fn judged(
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
        let stability: Vec<Stability> =
            samples.iter().map(|sample| tracer.judge(judge, sample).unwrap_or_default()).collect();
        let specials = tracer.specials(judge, &samples, &stability);
        let base = tracer.problem.system.base;
        TracedBranch { samples, stability, specials, base, periods, origin, ends }
    }

    /// Follows what branches off at branch points and period doublings.
    fn branch_off(&self, all: &mut Collected) {
        let mut at = 0;
        // Branches that branch off are not asked again where they double: period 2 and no more.
        while at < all.branches.len() && at < MOST_BRANCHES {
            let branch = all.branches[at].clone();
            for special in branch.specials.iter().filter(|special| special.located) {
                let doubling = special.kind == SpecialKind::PeriodDoubling;
                let follows = match special.kind {
                    SpecialKind::PeriodDoubling => self.doublings && branch.periods == 1,
                    SpecialKind::BranchPoint => true,
                    _ => false,
                };
                if !follows || self.observer.cancelled() {
                    continue;
                }
                if let Some(found) = self.switch(all, &branch, special, doubling) {
                    all.branches.push(found);
                }
            }
            at += 1;
        }
    }

    /// The branch that crosses at a special point.
    fn switch(
        &self,
        all: &mut Collected,
        branch: &TracedBranch,
        special: &Special,
        doubling: bool,
    ) -> Option<TracedBranch> {
        let old = &special.sample.set;
        let factor = if doubling { 2 } else { 1 };
        let set = HarmonicSet::all(factor * old.highest() + if old.is_odd() { 1 } else { 0 });
        let base = branch.base / f64::from(if doubling { 2_u8 } else { 1 });
        let u = refit(old, &set, factor, &special.sample.u);
        let p = special.sample.p;
        let mut tracer = self.tracer(set.clone(), base);
        let null = null_direction(&mut tracer, &u, p, old, factor, &special.sample)?;
        let size = length(&u).max(f64::MIN_POSITIVE.sqrt());
        let metric = tracer.metric(&u);
        let row: Vec<f64> = null.iter().map(|x| x / (size * size)).collect();
        let mut start = None;
        for offset in [OFFSET, 0.3 * OFFSET, 3.0 * OFFSET, 0.1 * OFFSET] {
            let mut v: Vec<f64> = u.iter().zip(&null).map(|(u, n)| u + offset * size * n).collect();
            let mut q = p;
            let held: f64 = row.iter().zip(&v).map(|(r, v)| r * v).sum();
            let condition = Condition { row: &row, corner: 0.0, target: held };
            if tracer.problem.correct(&mut v, &mut q, &condition, &metric).is_ok() {
                let unit = (null.as_slice(), 0.0);
                start = tracer.finish_sample(set.clone(), v, q, &metric, Some(unit)).ok();
                break;
            }
        }
        let start = start?;
        let periods = branch.periods * if doubling { 2 } else { 1 };
        let known = all.branches.iter().any(|other| {
            let ends_here = other.samples.last().is_some_and(|sample| sample.p == p);
            let alike = other.periods == periods && other.base == base;
            alike && (ends_here || on_mirrored(other, &start))
        });
        if known {
            return None;
        }
        let mut judge = Judge::new(&tracer.problem.system);
        let name = if doubling { "period doubling" } else { "branch point" };
        let origin = format!("{name} at {p:.6}");
        let what = if doubling { Parting::Doubling } else { Parting::Mirror };
        let along = start.tangent.iter().zip(&null).map(|(t, n)| t * n).sum::<f64>();
        let (samples, end) = tracer.follow(&start, if along < 0.0 { -1.0 } else { 1.0 });
        let (mut samples, end) = until_rejoined(samples, end, what, old.is_odd() || doubling);
        if end == BranchEnd::Enough {
            samples.extend(last_point(&mut tracer, branch, special, &samples, factor));
        }
        // The branch begins at the point where it parts; the harmonics have changed on the way.
        let mut u = u;
        tracer.use_set(&set, &mut u, &set);
        let point = tracer.finish_sample(set, u, p, &metric, Some((&null, 0.0))).ok();
        if let Some(mut point) = point {
            // It turns back there, but that is no fold of its own.
            point.tangent_p = 0.0;
            samples.insert(0, point);
        }
        all.counted.steps += tracer.counted.steps;
        all.counted.iterations += tracer.counted.iterations;
        Some(self.judged(
            &mut tracer,
            &mut judge,
            samples,
            [BranchEnd::Enough, end],
            periods,
            origin,
        ))
    }
}

/// Branches that are asked for what branches off.
const MOST_BRANCHES: usize = 24;

/// A part that distinguishes two branches, relative, below which they are about to meet.
const REJOINS: f64 = 0.3;

/// What parts a branch from the one it branched off.
#[derive(Clone, Copy)]
enum Parting {
    /// Odd orders of half the base.
    Doubling,
    /// Even orders.
    Mirror,
}

/// The point at which a branch comes back to the one that it branched off: the nearest point of that
/// kind other than its own beginning.
fn last_point(
    tracer: &mut Tracer<'_, '_>,
    parent: &TracedBranch,
    begin: &Special,
    samples: &[Sample],
    factor: usize,
) -> Option<Sample> {
    let last = samples.last()?;
    let others = parent.specials.iter().filter(|special| {
        special.kind == begin.kind && special.located && special.sample.p != begin.sample.p
    });
    let near = others.min_by(|a, b| {
        let away = |special: &Special| (special.sample.p - last.p).abs();
        away(a).total_cmp(&away(b))
    })?;
    let mut u = refit(&near.sample.set, &last.set, factor, &near.sample.u);
    let d: Vec<f64> = u.iter().zip(&last.u).map(|(a, b)| a - b).collect();
    if length(&d) > REJOINS * length(&u) {
        return None;
    }
    tracer.use_set(&last.set, &mut u, &last.set);
    let metric = tracer.metric(&u);
    let along = (last.tangent.as_slice(), last.tangent_p);
    let point = tracer.finish_sample(last.set.clone(), u, near.sample.p, &metric, Some(along));
    // It turns back there, but that is no fold of its own.
    point.ok().map(|point| Sample { tangent_p: 0.0, ..point })
}

/// Cuts a branch where it comes back to the one that it branched off: what parts them passes through
/// zero there, and what follows is the same branch shifted in time.
fn until_rejoined(
    samples: Vec<Sample>,
    end: BranchEnd,
    what: Parting,
    parted: bool,
) -> (Vec<Sample>, BranchEnd) {
    if !parted {
        return (samples, end);
    }
    let part = |sample: &Sample| -> Vec<f64> {
        let m = sample.set.coefficients();
        let keep = |order: usize| match what {
            Parting::Doubling => order % 2 == 1,
            Parting::Mirror => order % 2 == 0,
        };
        let places: Vec<usize> = sample
            .set
            .places()
            .filter(|(order, _)| keep(*order) && *order <= 3)
            .flat_map(
                |(order, place)| if order == 0 { vec![place] } else { vec![place, place + 1] },
            )
            .collect();
        sample
            .u
            .chunks_exact(m)
            .flat_map(|node| places.iter().map(|p| node[*p]).collect::<Vec<_>>())
            .collect()
    };
    for at in 1..samples.len() {
        let (a, b) = (part(&samples[at - 1]), part(&samples[at]));
        let dot: f64 = a.iter().zip(&b).map(|(a, b)| a * b).sum();
        if dot < 0.0 && length(&a) < REJOINS * length(&samples[at - 1].u) {
            let mut kept = samples;
            kept.truncate(at);
            return (kept, BranchEnd::Enough);
        }
    }
    (samples, end)
}

fn flip(sample: &mut Sample) {
    sample.tangent.iter_mut().for_each(|x| *x = -*x);
    sample.tangent_p = -sample.tangent_p;
    sample.orientation = -sample.orientation;
}

/// The null vector of the Jacobian in a larger set that the old branch's direction does not have: by
/// inverse iteration, with what the old set knows taken out.
fn null_direction(
    tracer: &mut Tracer<'_, '_>,
    u: &[f64],
    p: f64,
    old: &HarmonicSet,
    factor: usize,
    sample: &Sample,
) -> Option<Vec<f64>> {
    let set = tracer.problem.system.set.clone();
    let metric = tracer.metric(u);
    let along = refit(old, &set, factor, &sample.tangent);
    let weights: Vec<f64> = along.iter().map(|x| x / (metric.size * metric.size)).collect();
    tracer.problem.evaluate(u, p).ok()?;
    tracer.problem.factorise(&weights, sample.tangent_p / (metric.span * metric.span)).ok()?;
    // A fixed start that has a share of everything.
    let mut v: Vec<f64> = (0..u.len()).map(|k| 1.0 + 0.3 * (k as f64 * 1.7).sin()).collect();
    let mut q = 0.0;
    for _ in 0..6 {
        tracer.problem.solve(&mut v, &mut q);
        let size = length(&v);
        if !size.is_finite() || size == 0.0 {
            return None;
        }
        v.iter_mut().for_each(|x| *x /= size);
        q = 0.0;
    }
    Some(v)
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

/// Whether a response, or the same half a period later, lies on a branch.
fn on_mirrored(branch: &TracedBranch, sample: &Sample) -> bool {
    let m = sample.set.coefficients();
    let mut shifted = sample.u.clone();
    for node in shifted.chunks_exact_mut(m) {
        for (order, place) in sample.set.places().filter(|(order, _)| order % 2 == 1) {
            let _ = order;
            node[place] = -node[place];
            node[place + 1] = -node[place + 1];
        }
    }
    let mut mirrored = shifted.clone();
    mirrored.iter_mut().for_each(|x| *x = -*x);
    on_branch(branch, &sample.set, &sample.u, sample.p, NEAR)
        || on_branch(branch, &sample.set, &shifted, sample.p, NEAR)
        || on_branch(branch, &sample.set, &mirrored, sample.p, NEAR)
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
