//! Branches that branch off: of twice the period at period doublings, of broken symmetry and others at
//! branch points.
//!
//! At such a point the Jacobian over the harmonics of the new branch, bordered by the direction of the
//! old one, is singular: its null vector is the direction of the new branch. A branch of twice the
//! period has a part that the old one lacks, the odd orders of half the fundamental, and so has one
//! that breaks the mirror symmetry, the even orders. Where that part passes through zero again the
//! branch has come back to the old one and ends; what would follow is itself, shifted by a period.

use halfshaft_numerics::harmonics::HarmonicSet;
use halfshaft_results::SpecialKind;

use super::branches::{Collected, Job, NEAR, TracedBranch, on_branch};
use super::images::turned;
use super::problem::{Condition, Metric};
use super::special::Special;
use super::stability::Judge;
use super::tracer::{BranchEnd, Sample, Tracer, length, refit};

/// Branches that are asked for what branches off.
const MOST_BRANCHES: usize = 24;
/// How far from a branch point the first response of the other branch is looked for, relative.
const OFFSETS: [f64; 4] = [1e-2, 3e-3, 3e-2, 1e-3];
/// Inverse iterations for a null vector.
const ITERATIONS: usize = 6;
/// Points nearer than this, relative, are the same.
const SAME_POINT: f64 = 1e-4;

/// What parts a branch from the one that it branches off.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Parting {
    /// Odd orders of half the fundamental.
    Doubling,
    /// Even orders.
    Mirror,
    /// Nothing but its size.
    None,
}

impl Parting {
    /// Whether responses of the new branch alone have this order.
    fn has(self, order: usize) -> bool {
        match self {
            Self::Doubling => order % 2 == 1,
            Self::Mirror => order.is_multiple_of(2),
            Self::None => true,
        }
    }

    fn words(self) -> &'static str {
        match self {
            Self::Doubling => "period doubling",
            Self::Mirror | Self::None => "branch point",
        }
    }
}

/// A point where a branch branches off, in the harmonics of the new branch.
struct Fork {
    parting: Parting,
    /// Harmonics of the old branch there.
    old: HarmonicSet,
    set: HarmonicSet,
    base: f64,
    periods: u32,
    u: Vec<f64>,
    p: f64,
}

impl Fork {
    fn new(branch: &TracedBranch, special: &Special) -> Self {
        let known = &special.sample.set;
        let parting = match special.kind {
            SpecialKind::PeriodDoubling => Parting::Doubling,
            _ if known.is_odd() => Parting::Mirror,
            _ => Parting::None,
        };
        // Points found by shooting have more harmonics than the branch needs.
        let beside = [special.after, special.after + 1];
        let enough = beside.iter().filter_map(|at| branch.samples.get(*at));
        let enough = enough.map(|sample| sample.set.highest()).max().unwrap_or(known.highest());
        let old = known.up_to(known.highest().min(enough + 2));
        let factor = if parting == Parting::Doubling { 2 } else { 1 };
        let more = usize::from(parting == Parting::Mirror);
        let set = HarmonicSet::all(factor * old.highest() + more);
        let small = refit(known, &old, 1, &special.sample.u);
        let parts = if factor == 2 { 2.0 } else { 1.0 };
        Self {
            u: refit(&old, &set, factor, &small),
            p: special.sample.p,
            base: branch.base / parts,
            periods: branch.periods * if factor == 2 { 2 } else { 1 },
            parting,
            old,
            set,
        }
    }

    /// A vector of the old branch's harmonics in those of the new one.
    fn fit(&self, from: &HarmonicSet, values: &[f64]) -> Vec<f64> {
        let factor = if self.parting == Parting::Doubling { 2 } else { 1 };
        let small = refit(from, &self.old, 1, values);
        refit(&self.old, &self.set, factor, &small)
    }

    /// Whether a branch may be the one that branches off.
    fn may_be(&self, branch: &TracedBranch) -> bool {
        let mirrored = branch.samples.first().is_some_and(|sample| sample.set.is_odd());
        branch.periods == self.periods
            && branch.base == self.base
            && !(mirrored && self.parting == Parting::Mirror)
    }

    /// The response at the fork as the first or last of the new branch.
    fn sample(&self, along: (&[f64], f64), metric: &Metric, like: &Sample) -> Sample {
        Sample {
            set: self.set.clone(),
            u: self.u.clone(),
            p: self.p,
            tangent: along.0.to_vec(),
            tangent_p: along.1,
            metric: (metric.size, metric.span),
            orientation: like.orientation,
            truncation: like.truncation,
        }
    }
}

impl Job<'_, '_> {
    /// Follows what branches off at branch points and period doublings.
    pub(super) fn branch_off(&self, all: &mut Collected) {
        let mut at = 0;
        while at < all.branches.len() && at < MOST_BRANCHES {
            let branch = &all.branches[at];
            let follows = |special: &&Special| match special.kind {
                // Branches of twice the period are not asked where they double again.
                SpecialKind::PeriodDoubling => self.doublings && branch.periods == 1,
                SpecialKind::BranchPoint => true,
                _ => false,
            };
            let parting = branch.specials.iter().filter(|special| special.located).filter(follows);
            let forks: Vec<(Special, Fork)> =
                parting.map(|special| (special.clone(), Fork::new(branch, special))).collect();
            for (special, fork) in &forks {
                if self.observer.cancelled() {
                    break;
                }
                if is_end(&all.branches, fork) || all.cut_off() {
                    continue;
                }
                match self.switch(all, at, special, fork) {
                    Switched::Found(found) => all.branches.push(found),
                    Switched::Known => {}
                    Switched::Lost => all.messages.push(format!(
                        "the branch that parts at the {} at {:.6} was not found",
                        fork.parting.words(),
                        fork.p
                    )),
                }
            }
            at += 1;
        }
    }

    /// The branch that crosses at a fork.
    fn switch(
        &self,
        all: &mut Collected,
        parent: usize,
        special: &Special,
        fork: &Fork,
    ) -> Switched {
        let mut tracer = self.tracer(fork.set.clone(), fork.base);
        let metric = tracer.metric(&fork.u);
        let old =
            (fork.fit(&special.sample.set, &special.sample.tangent), special.sample.tangent_p);
        let Some(null) = null_direction(&mut tracer, fork, (&old.0, old.1), &metric) else {
            return Switched::Lost;
        };
        let Some(start) = first(&mut tracer, fork, (&null.0, null.1), &metric) else {
            return Switched::Lost;
        };
        let mut others = all.branches.iter().enumerate().filter(|(at, _)| *at != parent);
        if others.any(|(_, other)| fork.may_be(other) && on_mirrored(other, &start)) {
            return Switched::Known;
        }
        let mut judge = Judge::new(&tracer.problem.system, self.stability);
        let origin = format!("{} at {:.6}", fork.parting.words(), fork.p);
        let branch = if fork.parting == Parting::None {
            let mut branch = self.both_ways(&mut tracer, &mut judge, &start, origin);
            branch.periods = fork.periods;
            branch
        } else {
            let along = metric.dot((&start.tangent, start.tangent_p), (&null.0, null.1));
            let (samples, end) = tracer.follow(&start, if along < 0.0 { -1.0 } else { 1.0 });
            let (mut samples, end) = until_rejoined(samples, end, fork, &all.branches);
            // The branch begins where it parts.
            samples.insert(0, fork.sample((&null.0, null.1), &metric, &samples[0]));
            let ends = [BranchEnd::Enough, end];
            self.judged(&mut tracer, &mut judge, samples, ends, fork.periods, origin)
        };
        all.counted.steps += tracer.counted.steps;
        all.counted.iterations += tracer.counted.iterations;
        all.exhausted |= tracer.exhausted;
        Switched::Found(branch)
    }
}

/// What became of a fork.
enum Switched {
    Found(TracedBranch),
    Known,
    Lost,
}

/// The direction of the new branch: the null vector of the Jacobian bordered by the old direction, by
/// inverse iteration.
fn null_direction(
    tracer: &mut Tracer<'_, '_>,
    fork: &Fork,
    old: (&[f64], f64),
    metric: &Metric,
) -> Option<(Vec<f64>, f64)> {
    let weights: Vec<f64> = old.0.iter().map(|x| x / (metric.size * metric.size)).collect();
    tracer.problem.evaluate(&fork.u, fork.p).ok()?;
    tracer.problem.factorise(&weights, old.1 / (metric.span * metric.span)).ok()?;
    // A fixed start that has a share of everything.
    let mut v: Vec<f64> = (0..fork.u.len()).map(|k| 1.0 + 0.3 * (k as f64 * 1.7).sin()).collect();
    let mut q = 0.0;
    for _ in 0..ITERATIONS {
        fork.only_parting(&mut v, &mut q);
        tracer.problem.solve(&mut v, &mut q);
        let size = metric.norm(&v, q);
        if !size.is_finite() || size == 0.0 {
            return None;
        }
        v.iter_mut().for_each(|x| *x /= size);
        q /= size;
    }
    fork.only_parting(&mut v, &mut q);
    let size = metric.norm(&v, q);
    v.iter_mut().for_each(|x| *x /= size);
    (size > 0.0).then_some((v, q / size))
}

impl Fork {
    /// Leaves of a direction what parts the new branch from the old one.
    fn only_parting(&self, v: &mut [f64], q: &mut f64) {
        if self.parting == Parting::None {
            return;
        }
        *q = 0.0;
        for node in v.chunks_exact_mut(self.set.coefficients()) {
            for (order, place) in self.set.places().filter(|(order, _)| !self.parting.has(*order)) {
                node[place] = 0.0;
                if order > 0 {
                    node[place + 1] = 0.0;
                }
            }
        }
    }
}

/// The first response beside a fork on the new branch.
fn first(
    tracer: &mut Tracer<'_, '_>,
    fork: &Fork,
    null: (&[f64], f64),
    metric: &Metric,
) -> Option<Sample> {
    let row: Vec<f64> = null.0.iter().map(|x| x / (metric.size * metric.size)).collect();
    let corner = null.1 / (metric.span * metric.span);
    for offset in OFFSETS {
        let mut v: Vec<f64> = fork.u.iter().zip(null.0).map(|(u, n)| u + offset * n).collect();
        let mut q = fork.p + offset * null.1;
        let held: f64 = row.iter().zip(&v).map(|(r, v)| r * v).sum();
        let condition = Condition { row: &row, corner, target: held + corner * q };
        if tracer.problem.correct(&mut v, &mut q, &condition, metric).is_ok() {
            return tracer.finish_sample(fork.set.clone(), v, q, metric, Some(null)).ok();
        }
    }
    None
}

/// Cuts a branch where it comes back to the one that it branched off, and ends it there.
fn until_rejoined(
    samples: Vec<Sample>,
    end: BranchEnd,
    fork: &Fork,
    branches: &[TracedBranch],
) -> (Vec<Sample>, BranchEnd) {
    for at in 1..samples.len() {
        let (a, b) = (&samples[at - 1], &samples[at]);
        let (own_a, own_b) = (fork.own_part(a), fork.own_part(b));
        let dot: f64 = own_a.iter().zip(&own_b).map(|(a, b)| a * b).sum();
        if dot < 0.0 && length(&own_a) < 0.3 * length(&a.u) {
            let share = length(&own_a) / (length(&own_a) + length(&own_b));
            let last = meeting(a, b, share, fork, branches);
            let mut kept = samples;
            kept.truncate(at);
            kept.extend(last);
            return (kept, BranchEnd::Enough);
        }
    }
    (samples, end)
}

impl Fork {
    /// The part of a response that the old branch lacks.
    fn own_part(&self, sample: &Sample) -> Vec<f64> {
        let m = sample.set.coefficients();
        let places: Vec<usize> = (sample.set.places())
            .filter(|(order, _)| self.parting.has(*order) && *order <= 4)
            .flat_map(|(order, at)| if order == 0 { vec![at] } else { vec![at, at + 1] })
            .collect();
        sample.u.chunks_exact(m).flat_map(|node| places.iter().map(|p| node[*p])).collect()
    }
}

/// The fork at which a branch comes back between two samples.
fn meeting(
    a: &Sample,
    b: &Sample,
    share: f64,
    fork: &Fork,
    branches: &[TracedBranch],
) -> Option<Sample> {
    let other = refit(&b.set, &a.set, 1, &b.u);
    let metric = Metric { size: a.metric.0, span: a.metric.1 };
    let step: Vec<f64> = other.iter().zip(&a.u).map(|(b, a)| b - a).collect();
    let reach = metric.norm(&step, b.p - a.p);
    let u: Vec<f64> = a.u.iter().zip(&step).map(|(a, s)| a + share * s).collect();
    let p = a.p + share * (b.p - a.p);
    let forks = branches.iter().flat_map(|branch| {
        let same = branch.specials.iter().filter(|special| special.located);
        same.map(move |special| (branch, special)).filter(|(_, special)| {
            matches!(special.kind, SpecialKind::PeriodDoubling | SpecialKind::BranchPoint)
        })
    });
    let near = forks
        .map(|(branch, special)| Fork::new(branch, special))
        .filter(|other| other.parting == fork.parting && other.base == fork.base)
        .map(|other| {
            let there = refit(&other.set, &a.set, 1, &other.u);
            let away: Vec<f64> = there.iter().zip(&u).map(|(x, y)| x - y).collect();
            (metric.norm(&away, other.p - p), other)
        })
        .filter(|(away, _)| *away < reach)
        .min_by(|a, b| a.0.total_cmp(&b.0))?;
    let fork = near.1;
    let along = refit(&a.set, &fork.set, 1, &a.tangent);
    Some(fork.sample((&along, a.tangent_p), &metric, a))
}

/// Whether a branch already begins or ends at a fork.
fn is_end(branches: &[TracedBranch], fork: &Fork) -> bool {
    let close = |sample: &Sample| {
        let there = refit(&sample.set, &fork.set, 1, &sample.u);
        let away: f64 = there.iter().zip(&fork.u).map(|(x, y)| (x - y).powi(2)).sum();
        let near = away.sqrt() < SAME_POINT * length(&fork.u);
        near && (sample.p - fork.p).abs() < SAME_POINT * fork.p.abs()
    };
    branches
        .iter()
        .filter(|other| fork.may_be(other) && other.ends.contains(&BranchEnd::Enough))
        .any(|other| [other.samples.first(), other.samples.last()].into_iter().flatten().any(close))
}

/// Whether a response, or the same half a period later, or its mirror image, lies on a branch.
fn on_mirrored(branch: &TracedBranch, sample: &Sample) -> bool {
    let half = |sign: f64| turned(&sample.set, &sample.u, std::f64::consts::PI, sign);
    let (shifted, mirrored) = (half(1.0), half(-1.0));
    [&sample.u, &shifted, &mirrored]
        .into_iter()
        .any(|u| on_branch(branch, &sample.set, u, sample.p, NEAR))
}
