//! Branches of exact orbits as responses with harmonics.

use halfshaft_model::question::{ResonanceQuestion, StabilityMethod};
use halfshaft_numerics::harmonics::HarmonicSet;
use halfshaft_numerics::observer::Observer;

use super::super::answer::{Setting, trace_settings};
use super::super::branches::{Collected, TracedBranch};
use super::super::orbits::{coefficients_of, state_of_series};
use super::super::special::Special;
use super::super::tracer::{BranchEnd, Counted, LEAST_HARMONICS, Sample, length};
use super::curve::{Curve, Limits};
use super::explorer::{ExactBranch, Explorer, Guess};
use super::point::{Kind, Point};
use super::seeds;
use crate::shooting::{Lost, Shooter};

/// Lines of more groups than this are left to harmonics: shooting costs the square of their number.
const MOST_GROUPS: usize = 16;
/// Steps of a period beyond which a line counts as too stiff to be followed.
const MOST_STEPS: usize = 4000;
/// Speeds at which orbits are followed over the drive.
const CURVES: usize = 3;
/// Speeds at which the line is let run.
const SETTLINGS: usize = 9;
/// Correction of a point of a branch that is the last one, relative.
const ENOUGH: f64 = 1e-8;
/// Highest orders that are tried, one after the other.
const ORDERS: [usize; 4] = [64, 200, 600, 1200];
/// Orders of sets: few different ones.
const RUNGS: [usize; 16] = [3, 5, 9, 15, 25, 39, 59, 89, 129, 199, 299, 399, 599, 799, 999, 1199];

/// All branches by shooting; `None` where that does not fit the line or the question.
pub(in super::super) fn collect(
    setting: &Setting,
    question: &ResonanceQuestion,
    observer: &dyn Observer,
) -> Option<Collected> {
    let line = &setting.line;
    let fits = line.has_kinks()
        && line.equations.groups() <= MOST_GROUPS
        && question.harmonics.is_none()
        && question.stability == StabilityMethod::Monodromy;
    if !fits {
        return None;
    }
    let search = Search::new(setting, question, observer);
    search.run()
}

/// The search for all branches of a question.
struct Search<'s> {
    setting: &'s Setting,
    explorer: Explorer<'s, 's>,
    kind: Kind,
    tolerance: f64,
    counted: Counted,
}

impl<'s> Search<'s> {
    fn new(setting: &'s Setting, question: &ResonanceQuestion, observer: &'s dyn Observer) -> Self {
        let (low, high) = setting.range;
        let numbers = trace_settings(setting, question);
        let limits = Limits {
            range: setting.range,
            miss: numbers.miss,
            longest: numbers.longest,
            most_points: numbers.most_samples,
            most_size: numbers.most_size,
            enough: ENOUGH,
        };
        let reference = f64::midpoint(low, high);
        let kind = Kind { base: setting.base, periods: 1, mirrored: setting.odd };
        let shooter = Shooter::new(&setting.line.equations, setting.base, reference, setting.odd);
        let explorer = Explorer::new(shooter, limits, setting.odd, true, observer);
        let tolerance = question.tolerance;
        Self { setting, explorer, kind, tolerance, counted: Counted::default() }
    }

    fn run(mut self) -> Option<Collected> {
        let observer = self.explorer.observer;
        let (single, several): (Vec<Guess>, Vec<Guess>) =
            self.guesses().into_iter().partition(|guess| guess.kind.periods == 1);
        for guess in single {
            if observer.cancelled() {
                break;
            }
            if self.explorer.branches.is_empty() && self.is_stiff(&guess) {
                return None;
            }
            self.explorer.add(&guess);
        }
        self.explorer.branch_off();
        for guess in &several {
            self.explorer.add(guess);
        }
        self.let_run();
        self.explorer.branch_off();
        self.explorer.merge();
        if self.explorer.branches.is_empty() {
            return None;
        }
        Some(self.collected())
    }

    /// Whether a motion takes too many steps to be followed.
    fn is_stiff(&self, guess: &Guess) -> bool {
        let mut steps = 0;
        let mut shooter = self.explorer.shooter.clone();
        let done = shooter.after(&guess.state, guess.p, 1.0, |_| steps += 1);
        matches!(done, Err(Lost::RanAway)) || steps > MOST_STEPS
    }

    /// Guesses over the drive and by few harmonics.
    fn guesses(&mut self) -> Vec<Guess> {
        let setting = self.setting;
        let observer = self.explorer.observer;
        let equations = &setting.line.equations;
        let (low, high) = setting.range;
        let mut guesses = Vec::new();
        for frequency in spread(low, high, CURVES) {
            guesses.extend(seeds::over_drive(
                equations,
                &setting.rest,
                self.kind,
                frequency,
                observer,
                &mut self.counted,
            ));
        }
        let coordinates = self.explorer.shooter.coordinates();
        // States over the drive count rates over another speed.
        for guess in &mut guesses {
            let factor = self.setting.base * guess.p / coordinates.reference;
            coordinates.scale_rates(&mut guess.state, factor);
        }
        let rough = setting.seeds(None, observer, &mut self.counted);
        for (seed, p, origin) in rough {
            let line = &setting.line;
            let state = state_of_series(line, setting.base, &seed.set, &seed.u, p, &coordinates);
            guesses.push(Guess { kind: self.kind, state, p, origin });
        }
        guesses
    }

    /// Lets the line run at speeds over the range and adds what it settles to.
    fn let_run(&mut self) {
        let (low, high) = self.setting.range;
        let points = self.explorer.branches.iter().flat_map(|branch| &branch.points);
        let size = seeds::largest(points);
        let size = if size > 0.0 { size } else { 1.0 };
        let mut shooter = self.explorer.shooter.of_kind(self.kind.base, false);
        let rest = seeds::at_rest(&self.setting.line.equations, &self.setting.rest, &shooter);
        for p in spread(low, high, SETTLINGS) {
            for start in seeds::starts(&rest, size) {
                if self.explorer.observer.cancelled() {
                    return;
                }
                let Some(mut guess) = seeds::settled(&mut shooter, self.kind, &start, p) else {
                    continue;
                };
                let odd = self.setting.odd && guess.kind.periods == 1;
                guess.kind.mirrored = odd && seeds::is_mirrored(&mut shooter, &guess.state, p);
                self.explorer.add(&guess);
            }
        }
    }

    fn collected(self) -> Collected {
        let cancelled = self.explorer.observer.cancelled();
        let mut all = Collected {
            branches: Vec::new(),
            counted: self.counted,
            exhausted: false,
            cancelled,
            messages: self.explorer.messages.clone(),
        };
        all.counted.add(self.explorer.counted);
        let mut responses = Responses { setting: self.setting, tolerance: self.tolerance };
        for branch in self.explorer.branches.clone() {
            let mut curve = self.explorer.curve(branch.kind);
            all.branches.push(responses.branch(&mut curve, branch, &mut all.exhausted));
        }
        all.cancelled |= all.branches.iter().any(|b| b.ends.contains(&BranchEnd::Cancelled));
        all
    }
}

/// Speeds over a range, its ends among them, ends first.
fn spread(low: f64, high: f64, count: usize) -> Vec<f64> {
    let low = if low == 0.0 { 1e-3 * high } else { low };
    if low == high {
        return vec![low];
    }
    let at = |k: usize| low + (high - low) * k as f64 / (count - 1) as f64;
    let mut places = vec![low, high];
    places.extend((1..count - 1).map(at));
    places
}

/// Makes responses of orbits.
struct Responses<'s> {
    setting: &'s Setting,
    tolerance: f64,
}

impl Responses<'_> {
    fn branch(
        &mut self,
        curve: &mut Curve<'_, '_>,
        branch: ExactBranch,
        exhausted: &mut bool,
    ) -> TracedBranch {
        let mut samples = Vec::with_capacity(branch.points.len());
        for point in &branch.points {
            samples.extend(self.sample(curve, point, exhausted));
        }
        let mut specials = Vec::new();
        for special in &branch.specials {
            let Some(sample) = self.sample(curve, &special.point, exhausted) else { continue };
            specials.push(Special {
                kind: special.kind,
                after: special.after,
                sample,
                stability: Some(special.point.stability.clone()),
                precision: special.precision,
                located: special.located,
                change: special.change,
                note: special.note.clone(),
                touch: None,
            });
        }
        TracedBranch { samples, specials, ..TracedBranch::from(branch) }
    }

    /// The response of an orbit with as many harmonics as the tolerance asks for.
    fn sample(
        &self,
        curve: &mut Curve<'_, '_>,
        point: &Point,
        exhausted: &mut bool,
    ) -> Option<Sample> {
        let line = &self.setting.line;
        let base = curve.kind.base;
        let of = |highest: usize| {
            if curve.kind.mirrored { HarmonicSet::odd(highest) } else { HarmonicSet::all(highest) }
        };
        let least = LEAST_HARMONICS.max(self.setting.excited() * curve.kind.periods as usize);
        let mut known = None;
        for most in ORDERS {
            let set = of(most.max(least));
            let u = coefficients_of(line, base, &mut curve.shooter, &point.orbit, &set).ok()?;
            let tails = tails(&set, &u);
            let enough = tails.iter().position(|tail| *tail < self.tolerance);
            let enough = enough.unwrap_or(most);
            known = Some((set, u, tails, enough));
            // Beyond two thirds of the orders the tail is not all seen.
            if 3 * enough <= 2 * most {
                break;
            }
        }
        let (set, u, tails, enough) = known?;
        let highest = RUNGS.into_iter().find(|rung| *rung >= enough).unwrap_or(set.highest());
        let kept = of(highest.clamp(least, set.highest().max(least)));
        let truncation = tails.get(kept.highest()).copied().unwrap_or(0.0);
        *exhausted |= 3 * enough > 2 * ORDERS[ORDERS.len() - 1];
        Some(Sample {
            u: super::super::tracer::refit(&set, &kept, 1, &u),
            set: kept,
            p: point.p(),
            tangent: Vec::new(),
            tangent_p: point.tangent_p,
            metric: (point.size, 1.0),
            orientation: point.orientation,
            truncation,
        })
    }
}

/// What the orders above each order leave of the vibration, relative, for the node where it is most.
fn tails(set: &HarmonicSet, u: &[f64]) -> Vec<f64> {
    let m = set.coefficients();
    let mean = usize::from(!set.is_odd());
    let mut tails = vec![0.0_f64; set.highest() + 1];
    for node in u.chunks_exact(m) {
        let whole = length(&node[mean..]);
        if whole == 0.0 {
            continue;
        }
        let mut sum = 0.0_f64;
        let mut above = set.highest() + 1;
        for (order, place) in set.places().collect::<Vec<_>>().into_iter().rev() {
            // The tail beyond `order`, and beyond those left out between it and the next.
            for tail in &mut tails[order..above] {
                *tail = tail.max(sum.sqrt() / whole);
            }
            above = order;
            if order > 0 {
                sum += node[place] * node[place] + node[place + 1] * node[place + 1];
            }
        }
        for tail in &mut tails[..above] {
            *tail = tail.max(sum.sqrt() / whole);
        }
    }
    tails
}
