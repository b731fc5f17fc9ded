//! What a smooth line settles to where no response is known to be stable.
//!
//! Guesses by one harmonic lead to most responses, but not to those that one harmonic is far from, nor
//! to subharmonic ones. Where no branch is stable, and where a guess led nowhere, the line is let run
//! until its motion repeats, and the branch through what it repeats is followed.

use halfshaft_numerics::harmonics::HarmonicSet;
use halfshaft_results::SpecialKind;

use super::answer::Setting;
use super::branches::{Collected, Job, NEAR, TracedBranch, on_branch};
use super::exact::{self, Guess, Kind, SETTLES};
use super::images::images;
use super::orbits::{coefficients_of, state_of};
use super::stability::Judge;
use crate::shooting::{Shooter, length};

/// Parts of a gap at which the line is let run.
const PLACES: [f64; 3] = [0.5, 0.15, 0.85];
/// States from which it is let run at each.
const STARTS: usize = 2;
/// Runs of a gap that may end without a motion that repeats.
const MOST_UNSETTLED: usize = 2;
/// Branches that are added so at most, and branches of several periods among them.
const MOST_ADDED: usize = 12;
const MOST_LONG: usize = 3;
/// Highest order, over the excitation, of the harmonics to begin with.
const ORDERS: usize = 24;

/// Adds the branches that the line settles to in gaps and where guesses were lost.
pub(super) fn settle(setting: &Setting, job: &Job<'_, '_>, all: &mut Collected) {
    let line = &setting.line;
    let fits = line.equations.groups() <= exact::MOST_GROUPS && job.settings.harmonics.is_none();
    // Without damping nothing settles.
    let equations = &line.equations;
    let damped = equations.ground_damping.iter().any(|d| *d > 0.0)
        || equations.connections.iter().any(|c| c.damping > 0.0 || c.friction.is_some());
    if !fits || !damped || setting.range.0 == setting.range.1 {
        return;
    }
    let before = all.branches.len();
    let lost = std::mem::take(&mut all.lost);
    let mut tried: Vec<f64> = Vec::new();
    for place in &lost {
        if !all.is_stable_at(*place) && !all.cut_off() {
            Runs::new(setting, job).at(*place, all);
        }
    }
    for (from, to) in all.gaps(setting.range) {
        if between_tori(all, (from, to)) {
            continue;
        }
        let mut runs = Runs::new(setting, job);
        for part in PLACES {
            let p = from + part * (to - from);
            let enough = job.observer.cancelled() || all.branches.len() > before + MOST_ADDED;
            let open = !enough && runs.unsettled < MOST_UNSETTLED;
            if open && !all.is_stable_at(p) && !all.cut_off() {
                tried.push(p);
                runs.at(p, all);
            }
        }
    }
    if all.branches.len() > before {
        job.branch_off(all);
    }
    let missing = |p: &f64| !all.is_known_at(*p);
    all.lost = lost.into_iter().filter(missing).collect();
    for (from, to) in all.gaps(setting.range) {
        let why = if between_tori(all, (from, to)) {
            "at both ends a pair of multipliers leaves the unit circle, and the motion between does not \
             repeat; see it with simulate"
                .to_owned()
        } else if !tried.iter().any(|p| from <= *p && *p <= to) {
            "what the line settles to there was not tried; ask for a narrower range".to_owned()
        } else {
            let periods = exact::MOST_MULTIPLE;
            format!("where the line was let run its motion did not repeat within {periods} periods")
        };
        all.messages.push(format!(
            "no stable periodic response was found between {from:.6} and {to:.6} rad/s: {why}"
        ));
    }
}

/// Whether a gap reaches from one Neimark-Sacker point to another: a motion on a torus fills it.
fn between_tori(all: &Collected, (from, to): (f64, f64)) -> bool {
    let specials = || all.branches.iter().flat_map(|branch| &branch.specials);
    let torus = |p: f64| {
        let mut tori = specials().filter(|special| special.kind == SpecialKind::NeimarkSacker);
        tori.any(|special| (special.sample.p - p).abs() <= 1e-9 * p.abs())
    };
    torus(from) && torus(to)
}

/// Runs of the line.
struct Runs<'r, 's, 'f> {
    setting: &'r Setting,
    job: &'r Job<'s, 'f>,
    shooter: Shooter<'r>,
    unsettled: usize,
}

impl<'r, 's, 'f> Runs<'r, 's, 'f> {
    fn new(setting: &'r Setting, job: &'r Job<'s, 'f>) -> Self {
        let middle = f64::midpoint(setting.range.0, setting.range.1);
        let shooter = Shooter::new(&setting.line.equations, setting.base, middle, false);
        Self { setting, job, shooter, unsettled: 0 }
    }

    /// Lets the line run at one speed and follows what it settles to.
    fn at(&mut self, p: f64, all: &mut Collected) {
        let setting = self.setting;
        let rest = exact::at_rest(&setting.line.equations, &setting.rest, &self.shooter);
        let kind = Kind { base: setting.base, periods: 1, mirrored: false };
        let size = self.size(all);
        for start in exact::starts(&rest, size).into_iter().take(STARTS) {
            let Some(mut guess) = exact::settled(&mut self.shooter, kind, &start, p) else {
                self.unsettled += 1;
                return;
            };
            let odd = setting.odd && guess.kind.periods == 1;
            guess.kind.mirrored =
                odd && exact::is_mirrored(&mut self.shooter, &guess.state, guess.p);
            self.follow(&guess, all);
        }
    }

    /// Size of the states of the largest responses.
    fn size(&self, all: &Collected) -> f64 {
        let coordinates = self.shooter.coordinates();
        let sizes = all.branches.iter().filter_map(|branch| {
            let largest =
                branch.samples.iter().max_by(|a, b| length(&a.u).total_cmp(&length(&b.u)));
            let line = &self.setting.line;
            largest.map(|sample| length(&state_of(line, branch.base, sample, &coordinates)))
        });
        let size = sizes.fold(0.0, f64::max);
        if size > 0.0 { size } else { 1.0 }
    }

    /// Follows the branch through a motion that repeats, unless that is known.
    fn follow(&mut self, guess: &Guess, all: &mut Collected) {
        let Kind { base, periods, mirrored } = guess.kind;
        let long = all.branches.iter().filter(|branch| branch.origin.starts_with(SETTLES));
        if periods > 1 && long.filter(|branch| branch.periods > 1).count() >= MOST_LONG {
            return;
        }
        let mut shooter = self.shooter.of_kind(base, mirrored);
        let Ok(orbit) = shooter.at(&guess.state, guess.p) else { return };
        let highest = ORDERS.max(self.setting.excited()) * periods as usize;
        let set = if mirrored { HarmonicSet::odd(highest) } else { HarmonicSet::all(highest) };
        let line = &self.setting.line;
        let Ok(u) = coefficients_of(line, base, &mut shooter, &orbit, &set) else { return };
        let same_kind = |branch: &&TracedBranch| branch.base == base;
        let mut others = all.branches.iter().filter(same_kind);
        let images = images(&set, &u, periods, self.setting.odd);
        if others.any(|branch| images.iter().any(|u| on_branch(branch, &set, u, guess.p, NEAR))) {
            return;
        }
        let mut tracer = self.job.tracer(set.clone(), base);
        let Ok(start) = tracer.seed(&set, &u, guess.p) else { return };
        let mut judge = Judge::new(&tracer.problem.system, self.job.stability);
        let origin = guess.origin.clone();
        let mut branch = self.job.both_ways(&mut tracer, &mut judge, &start, origin);
        branch.periods = periods;
        all.counted.add(tracer.counted);
        all.counted.seeds += 1;
        all.exhausted |= tracer.exhausted;
        all.branches.push(branch);
    }
}
