//! Starting points at the tips of resonances, for detached branches narrower than any grid of speeds.
//!
//! The curve of phase resonance ([`super::backbone`]) runs over the tips of the response curves of all
//! drives, detached ones included, and passes drive 1 once for each of them. It begins where a curve
//! over the drive ([`super::seeds`]) meets it, or between two speeds of which the one lies below and the
//! other above a resonance of the line at rest.

use halfshaft_numerics::harmonics::HarmonicSet;
use halfshaft_numerics::observer::Observer;

use super::answer::Setting;
use super::backbone::{BackboneSettings, PhaseResonance, Resonant};
use super::problem::{Axis, Problem};
use super::seeds::{DriveCurve, FIRST_DRIVE, Quadrature, Seed, reactive};
use super::system::{HarmonicSystem, Place};
use super::tracer::{Counted, LEAST_HARMONICS, length, refit};

/// Drives between which curves are followed.
const DRIVES: (f64, f64) = (0.02, 5.0);
/// Points of a curve to either side of its start, at most.
const MOST_POINTS: usize = 60;
/// Curves at most.
const MOST_CURVES: usize = 12;
/// Step at which a curve begins, relative to the response.
const FIRST_STEP: f64 = 0.1;
/// Steps between which the length is kept.
const STEPS: (f64, f64) = (1e-4, 0.4);
/// Miss of the tangent that is aimed at, and at which a step is taken again.
const MISS: (f64, f64) = (0.04, 0.25);
/// Halvings of a step in which the drive turns.
const TURNS: usize = 6;
/// Error of a tip's waveform that is tolerated where the number of harmonics is free.
const TRUNCATION: f64 = 1e-5;
/// Harmonics of a tip at most.
const MOST_HARMONICS: usize = 31;
/// Halvings of the distance between two speeds with a resonance between them.
const HALVINGS: usize = 24;
/// A start this near to a curve, relative, lies on it.
const NEAR: f64 = 0.05;

/// Responses of drive 1 at the tips of resonances, with their speeds.
pub(super) fn tips(
    setting: &Setting,
    mut curves: Vec<DriveCurve>,
    harmonics: Option<usize>,
    observer: &dyn Observer,
    counted: &mut Counted,
) -> Vec<(Seed, f64)> {
    if setting.line.twists.is_empty() || curves.is_empty() {
        return Vec::new();
    }
    curves.sort_by(|a, b| a.frequency.total_cmp(&b.frequency));
    let mut found = Vec::new();
    let mut followed = 0;
    for (index, &order) in setting.orders().iter().enumerate() {
        let mut search = Search::new(setting, &curves[0].set, order, harmonics);
        let met = curves.iter().flat_map(|curve| &curve.quadratures);
        for start in met.filter(|start| start.order == order) {
            if observer.cancelled() || followed >= MOST_CURVES {
                return found;
            }
            followed += usize::from(search.add(start, counted));
        }
        for pair in curves.windows(2) {
            let Some(start) = search.between(&pair[0], &pair[1], index) else { continue };
            if observer.cancelled() || followed >= MOST_CURVES {
                return found;
            }
            followed += usize::from(search.add(&start, counted));
        }
        found.append(&mut search.found);
    }
    found
}

/// The search for tips at one order of the torques.
struct Search<'s> {
    setting: &'s Setting,
    resonance: PhaseResonance,
    /// Harmonics of the starts.
    rough: HarmonicSet,
    /// Harmonics of the curves.
    set: HarmonicSet,
    /// Whether the number of harmonics is free.
    adapts: bool,
    order: usize,
    curves: Vec<Vec<Resonant>>,
    found: Vec<(Seed, f64)>,
}

impl<'s> Search<'s> {
    fn new(
        setting: &'s Setting,
        rough: &HarmonicSet,
        order: usize,
        harmonics: Option<usize>,
    ) -> Self {
        let (low, high) = setting.range;
        let line = setting.line.clone();
        let set = rough.up_to(harmonics.unwrap_or(LEAST_HARMONICS.max(rough.highest())));
        let span = (high - low).max(1e-3 * high);
        Self {
            resonance: PhaseResonance::new(line, set.clone(), setting.base, order, span),
            rough: rough.clone(),
            setting,
            set,
            adapts: harmonics.is_none(),
            order,
            curves: Vec::new(),
            found: Vec::new(),
        }
    }

    /// Follows the curve through a start unless that is known; whether it did.
    fn add(&mut self, start: &Quadrature, counted: &mut Counted) -> bool {
        let u = refit(&self.rough, &self.set, 1, &start.u);
        if self.curves.iter().any(|curve| lies_on(curve, &u, start.frequency)) {
            return false;
        }
        let none = vec![0.0; u.len()];
        let row = (none.as_slice(), 0.0, 1.0);
        let mut point = (u, start.frequency, start.drive);
        if self.resonance.correct(&mut point, row, start.drive).is_err() {
            return false;
        }
        if self.curves.iter().any(|curve| lies_on(curve, &point.0, point.1)) {
            return false;
        }
        let Ok(first) = self.resonance.sample(point, row) else { return false };
        let mut curve = self.follow(reversed(first.clone()), counted);
        curve.reverse();
        curve.extend(self.follow(first, counted).into_iter().skip(1));
        for pair in curve.windows(2) {
            self.passages(&pair[0], &pair[1]);
        }
        self.curves.push(curve);
        true
    }

    /// Every passage of the drive through 1 between two points of a curve, also where it turns between
    /// them.
    fn passages(&mut self, from: &Resonant, to: &Resonant) {
        let side = |point: &Resonant| point.drive < 1.0;
        if side(from) != side(to) {
            let tip = self.tip(from, to);
            self.found.extend(tip);
            return;
        }
        // Slope of the drive on the way from the one to the other.
        let slope = |point: &Resonant| {
            let way = to.u.iter().zip(&from.u).map(|(b, a)| b - a);
            let along: f64 = way.zip(&point.tangent.0).map(|(d, t)| d * t).sum();
            point.tangent.2 * along.signum()
        };
        let first = slope(from);
        if first * slope(to) >= 0.0 {
            return;
        }
        let (mut a, mut b) = (from.clone(), to.clone());
        for _ in 0..TURNS {
            let Some(middle) = self.middle(&a, &b) else { return };
            if side(&middle) != side(from) {
                for tip in [self.tip(&a, &middle), self.tip(&middle, &b)] {
                    self.found.extend(tip);
                }
                return;
            }
            if slope(&middle) * first > 0.0 {
                a = middle;
            } else {
                b = middle;
            }
        }
    }

    /// The point of a curve midway between two.
    fn middle(&mut self, from: &Resonant, to: &Resonant) -> Option<Resonant> {
        let square = length(&from.u).powi(2);
        let row: Vec<f64> = to.u.iter().zip(&from.u).map(|(b, a)| (b - a) / square).collect();
        let span = self.setting.range.1 - self.setting.range.0;
        let by_frequency = (to.frequency - from.frequency) / span.powi(2);
        let mut point = (
            to.u.iter().zip(&from.u).map(|(a, b)| f64::midpoint(*a, *b)).collect::<Vec<f64>>(),
            f64::midpoint(from.frequency, to.frequency),
            f64::midpoint(from.drive, to.drive),
        );
        let target =
            row.iter().zip(&point.0).map(|(a, b)| a * b).sum::<f64>() + by_frequency * point.1;
        let row = (row.as_slice(), by_frequency, 0.0);
        self.resonance.correct(&mut point, row, target).ok()?;
        self.resonance.sample(point, row).ok()
    }

    fn follow(&mut self, start: Resonant, counted: &mut Counted) -> Vec<Resonant> {
        let (low, high) = self.setting.range;
        let settings = BackboneSettings {
            frequency: (0.5 * low, 1.5 * high),
            tolerance: 1.0,
            harmonics: Some(self.set.highest()),
            most_drive: DRIVES.1,
            most_size: f64::INFINITY,
        };
        let mut curve = vec![start];
        let mut step = FIRST_STEP;
        while curve.len() < MOST_POINTS {
            let Some(last) = curve.last() else { break };
            counted.steps += 1;
            match self.resonance.try_step(last, step, &settings) {
                Ok((next, miss)) if miss < MISS.1 => {
                    let rising = next.drive > last.drive;
                    let inside = (settings.frequency.0..=settings.frequency.1)
                        .contains(&next.frequency)
                        && next.drive <= DRIVES.1
                        && (rising || next.drive >= DRIVES.0);
                    curve.push(next);
                    if !inside {
                        break;
                    }
                    let factor = (MISS.0 / miss.max(1e-9)).sqrt().clamp(0.4, 1.8);
                    step = (factor * step).clamp(STEPS.0, STEPS.1);
                }
                _ => {
                    step *= 0.35;
                    if step < STEPS.0 {
                        break;
                    }
                }
            }
        }
        curve
    }

    /// The tip of drive 1 between two points of a curve.
    fn tip(&mut self, from: &Resonant, to: &Resonant) -> Option<(Seed, f64)> {
        let part = (1.0 - from.drive) / (to.drive - from.drive);
        let mix = |a: f64, b: f64| a + part * (b - a);
        let u: Vec<f64> = from.u.iter().zip(&to.u).map(|(a, b)| mix(*a, *b)).collect();
        let mut point = (u, mix(from.frequency, to.frequency), 1.0);
        let none = vec![0.0; point.0.len()];
        self.resonance.correct(&mut point, (&none, 0.0, 1.0), 1.0).ok()?;
        let set = self.refine(&mut point);
        self.resonance.use_set(&self.set);
        let (low, high) = self.setting.range;
        let seed = Seed { set: set?, u: point.0 };
        (low..=high).contains(&point.1).then_some((seed, point.1))
    }

    /// Adds harmonics to a tip of drive 1 until they hardly move it: a detached branch may be narrower
    /// than a harmonic shifts it, and there may be none with all of them.
    fn refine(&mut self, point: &mut (Vec<f64>, f64, f64)) -> Option<HarmonicSet> {
        let mut set = self.set.clone();
        while self.adapts && self.resonance.system.truncation > TRUNCATION {
            let next = set.up_to(set.highest() + 2);
            if next.highest() > MOST_HARMONICS {
                break;
            }
            point.0 = refit(&set, &next, 1, &point.0);
            set = next;
            self.resonance.use_set(&set);
            let none = vec![0.0; point.0.len()];
            self.resonance.correct(point, (&none, 0.0, 1.0), 1.0).ok()?;
        }
        Some(set)
    }

    /// A start at the lowest drive between two speeds on different sides of a resonance that no
    /// known curve begins at.
    fn between(&self, low: &DriveCurve, high: &DriveCurve, index: usize) -> Option<Quadrature> {
        let (first, last) = (low.first.as_ref()?, high.first.as_ref()?);
        if first.0[index] * last.0[index] >= 0.0 {
            return None;
        }
        let inside = low.frequency..=high.frequency;
        let begins =
            |point: &Resonant| point.drive < 2.0 * DRIVES.0 && inside.contains(&point.frequency);
        if self.curves.iter().flatten().any(begins) {
            return None;
        }
        let (line, base) = (self.setting.line.clone(), self.setting.base);
        let system = HarmonicSystem::new(line, self.rough.clone(), base);
        let place = Place { frequency: low.frequency, drive: FIRST_DRIVE };
        let mut problem = Problem::new(system, Axis::Frequency, place);
        let (mut a, mut b) = (low.frequency, high.frequency);
        let mut u = first.1.clone();
        for _ in 0..HALVINGS {
            let middle = f64::midpoint(a, b);
            let size = length(&u);
            problem.at(&mut u, middle, size).ok()?;
            let work = reactive(&self.rough, &problem.system.by_drive, &u, self.order);
            if work * first.0[index] > 0.0 {
                a = middle;
            } else {
                b = middle;
            }
        }
        Some(Quadrature {
            order: self.order,
            u,
            frequency: f64::midpoint(a, b),
            drive: FIRST_DRIVE,
        })
    }
}

fn reversed(mut point: Resonant) -> Resonant {
    point.tangent.0.iter_mut().for_each(|x| *x = -*x);
    point.tangent.1 = -point.tangent.1;
    point.tangent.2 = -point.tangent.2;
    point
}

/// Whether a response lies on a curve, as far as its points tell.
fn lies_on(curve: &[Resonant], u: &[f64], frequency: f64) -> bool {
    curve.windows(2).any(|pair| {
        let (a, b) = (&pair[0], &pair[1]);
        let size = length(&a.u).max(length(&b.u));
        let (mut along, mut chord) = (0.0, 0.0);
        for ((a, b), x) in a.u.iter().zip(&b.u).zip(u) {
            along += (x - a) * (b - a);
            chord += (b - a) * (b - a);
        }
        let part = (along / chord).clamp(0.0, 1.0);
        let mixed = a.u.iter().zip(&b.u).map(|(a, b)| a + part * (b - a));
        let away: f64 = mixed.zip(u).map(|(x, y)| (x - y) * (x - y)).sum();
        let there = a.frequency + part * (b.frequency - a.frequency);
        away.sqrt() < NEAR * size && (there / frequency - 1.0).abs() < NEAR
    })
}
