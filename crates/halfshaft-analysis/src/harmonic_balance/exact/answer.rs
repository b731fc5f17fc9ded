//! Branches of exact orbits as responses with harmonics.

use halfshaft_model::question::{ResonanceQuestion, StabilityMethod};
use halfshaft_numerics::observer::Observer;

use super::super::answer::{Setting, trace_settings};
use super::super::branches::Collected;
use super::super::orbits::state_of_series;
use super::super::tracer::{BranchEnd, Counted};
use super::curve::Limits;
use super::explorer::{Explorer, Guess};
use super::gaps::{gaps, inside, told};
use super::point::Kind;
use super::responses::{ORDERS, Responses};
use super::seeds;
use crate::shooting::{Lost, Shooter};

/// Lines of more groups than this are left to harmonics: shooting costs the square of their number.
pub(in super::super) const MOST_GROUPS: usize = 16;
/// Steps of a period beyond which a line counts as too stiff to be followed.
const MOST_STEPS: usize = 4000;
/// Points of a branch to either side of its start at most: where a line rattles at low speeds branches
/// may fold without end, and others are not to wait for them.
const MOST_POINTS: usize = 1500;
/// Speeds at which orbits are followed over the drive.
const CURVES: usize = 3;
/// Speeds at which the line is let run.
const SETTLINGS: usize = 9;
/// States from which it is let run at each of them, and at those where nothing stable is known.
const STARTS: usize = 4;
const STARTS_IN_GAPS: usize = 2;
/// Correction of a point of a branch that is the last one, relative.
const ENOUGH: f64 = 1e-8;

/// All branches by shooting; `None` where that does not fit the line or the question.
pub(in super::super) fn collect(
    setting: &Setting,
    question: &ResonanceQuestion,
    observer: &dyn Observer,
) -> Option<Collected> {
    let line = &setting.line;
    // Friction that bends within a small speed is stiff: shooting creeps, harmonics average over it.
    let rubs = line.equations.connections.iter().any(|c| c.friction.is_some());
    let fits = line.has_kinks()
        && !rubs
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
            most_points: MOST_POINTS.min(numbers.most_samples),
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
        let (low, high) = self.setting.range;
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
        self.let_run(&spread(low, high, SETTLINGS), STARTS);
        self.explorer.branch_off();
        for gap in gaps(&self.explorer.branches, (low, high)) {
            self.let_run(&inside(gap), STARTS_IN_GAPS);
        }
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

    /// Lets the line run at speeds and adds what it settles to.
    fn let_run(&mut self, speeds: &[f64], starts: usize) {
        let points = self.explorer.branches.iter().flat_map(|branch| &branch.points);
        let size = seeds::largest(points);
        let size = if size > 0.0 { size } else { 1.0 };
        let mut shooter = self.explorer.shooter.of_kind(self.kind.base, false);
        let rest = seeds::at_rest(&self.setting.line.equations, &self.setting.rest, &shooter);
        for &p in speeds {
            for start in seeds::starts(&rest, size).into_iter().take(starts) {
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
            lost: Vec::new(),
            exact: true,
            cut: false,
        };
        all.counted.add(self.explorer.counted);
        let responses = Responses { setting: self.setting, tolerance: self.tolerance };
        let mut exhausted = false;
        for branch in self.explorer.branches.clone() {
            let mut curve = self.explorer.curve(branch.kind);
            all.branches.push(responses.branch(&mut curve, branch, &mut exhausted));
        }
        if exhausted {
            all.messages.push(format!(
                "even {} harmonics leave more than the tolerance of {:e} of some waveforms; see the \
                 column truncation",
                ORDERS[ORDERS.len() - 1],
                self.tolerance
            ));
        }
        all.messages.extend(told(&gaps(&self.explorer.branches, self.setting.range)));
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
