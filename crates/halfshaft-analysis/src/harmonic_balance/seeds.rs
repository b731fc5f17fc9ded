//! Starting points: responses at chosen speeds that other branches may have missed.
//!
//! At a fixed speed the response is followed over the drive (the factor on all harmonic torques)
//! with one harmonic only, from almost nothing to well beyond 1. That curve passes 1 once for each
//! response it is connected with, also for those on detached branches, which no sweep of the speed
//! reaches unless they are narrower than the distance of the chosen speeds: for those see
//! [`super::tips`].

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_numerics::harmonics::HarmonicSet;
use halfshaft_numerics::observer::Observer;

use super::line::Line;
use super::passages::passages;
use super::problem::{Axis, Problem};
use super::segment::Segment;
use super::system::{HarmonicSystem, Place};
use super::tracer::{Counted, Sample, TraceSettings, Tracer, work_of};

/// A guess at a response: coefficients of the kept groups over a set.
#[derive(Clone, Debug)]
pub(super) struct Seed {
    pub(super) set: HarmonicSet,
    pub(super) u: Vec<f64>,
}

/// Drive at which a curve begins.
pub(super) const FIRST_DRIVE: f64 = 1e-3;
/// The same, and lower ones for torques so strong that it is no small response.
const FIRST_DRIVES: [f64; 4] = [FIRST_DRIVE, 1e-5, 1e-7, 1e-9];
/// Drive to which a curve is followed.
const LAST_DRIVE: f64 = 20.0;
/// Samples of a curve at most, and that of long lines, where each costs as many times more as it has
/// nodes more than ten.
const MOST_SAMPLES: usize = 300;
const LEAST_MOST_SAMPLES: usize = 60;
/// First and longest step over the drive, relative to the response.
const FIRST: f64 = 1.0;
const LONGEST: f64 = 2.0;
/// Miss of the tangent on these rough curves.
const ROUGH: f64 = 0.15;
/// A correction on them below which the rest, its square, is nothing.
const ROUGH_CORRECTION: f64 = 1e-4;

/// The curve over the drive at one speed.
#[derive(Clone, Debug)]
pub(super) struct DriveCurve {
    pub(super) frequency: f64,
    pub(super) set: HarmonicSet,
    /// Every passage of the drive through 1.
    pub(super) seeds: Vec<Seed>,
    /// Where the torques of an order do no reactive work.
    pub(super) quadratures: Vec<Quadrature>,
    /// Reactive work of each order at the lowest drive, and the response there.
    pub(super) first: Option<(Vec<f64>, Vec<f64>)>,
}

/// A response near one in quadrature with the torques of an order.
#[derive(Clone, Debug)]
pub(super) struct Quadrature {
    pub(super) order: usize,
    pub(super) u: Vec<f64>,
    pub(super) frequency: f64,
    pub(super) drive: f64,
}

/// Seeds at one speed: every passage of the drive through 1.
#[expect(clippy::too_many_arguments, reason = "what a curve over the drive needs, once")]
pub(super) fn over_drive(
    line: &Line,
    rest: &[f64],
    base: f64,
    odd: bool,
    highest: usize,
    frequency: f64,
    observer: &dyn Observer,
    counted: &mut Counted,
) -> Vec<Seed> {
    let set = if odd { HarmonicSet::odd(highest) } else { HarmonicSet::all(highest) };
    drive_curve(line, rest, base, &set, &[], frequency, observer, counted).seeds
}

/// Follows the response over the drive at one speed.
#[expect(clippy::too_many_arguments, reason = "what a curve over the drive needs, once")]
pub(super) fn drive_curve(
    line: &Line,
    rest: &[f64],
    base: f64,
    set: &HarmonicSet,
    orders: &[usize],
    frequency: f64,
    observer: &dyn Observer,
    counted: &mut Counted,
) -> DriveCurve {
    let system = HarmonicSystem::new(line.clone(), set.clone(), base);
    let place = Place { frequency, drive: FIRST_DRIVE };
    let u = at_rest(line, rest, set);
    let mut problem = Problem::new(system, Axis::Drive, place);
    problem.rough = ROUGH_CORRECTION;
    let settings = TraceSettings {
        range: (0.0, LAST_DRIVE),
        tolerance: 1.0,
        harmonics: Some(set.highest()),
        miss: ROUGH,
        // With damping no torque moves nothing but rest.
        floored: true,
        // Weak responses grow with the drive: nothing bends there.
        first: FIRST,
        longest: LONGEST,
        most_samples: (10 * MOST_SAMPLES / line.nodes().max(10)).max(LEAST_MOST_SAMPLES)
            * work_of(set).ceil() as usize,
        most_size: f64::INFINITY,
    };
    let mut tracer = Tracer::new(problem, settings, observer);
    let mut curve = DriveCurve {
        frequency,
        set: set.clone(),
        seeds: Vec::new(),
        quadratures: Vec::new(),
        first: None,
    };
    let first = FIRST_DRIVES.into_iter().find_map(|drive| tracer.seed(set, &u, drive).ok());
    if let Some(start) = first {
        let sign = if start.tangent_p < 0.0 { -1.0 } else { 1.0 };
        let (samples, _) = tracer.follow(&start, sign);
        for pair in samples.windows(2) {
            let found = passages(&mut tracer, &pair[0], &pair[1]);
            curve.seeds.extend(found.into_iter().map(|u| Seed { set: set.clone(), u }));
        }
        let mut sides = Vec::with_capacity(orders.len());
        for &order in orders {
            let (side, mut met) = quadratures(&mut tracer, &samples, order);
            sides.push(side);
            curve.quadratures.append(&mut met);
        }
        curve.first = Some((sides, samples[0].u.clone()));
    }
    counted.iterations += tracer.counted.iterations;
    counted.steps += tracer.counted.steps;
    curve
}

/// Reactive work of the torques of an order at the first sample, and where it is zero between samples.
fn quadratures(
    tracer: &mut Tracer<'_, '_>,
    samples: &[Sample],
    order: usize,
) -> (f64, Vec<Quadrature>) {
    let set = &samples[0].set;
    // At one speed the torques of drive 1 are the same all along.
    let torques = tracer.problem.system.by_drive.clone();
    let frequency = tracer.problem.place.frequency;
    let work = |u: &[f64]| reactive(set, &torques, u, order);
    let works: Vec<f64> = samples.iter().map(|sample| work(&sample.u)).collect();
    let pairs = samples.windows(2).zip(works.windows(2));
    let changes = pairs.filter(|(_, works)| works[0] * works[1] < 0.0);
    let met = changes.filter_map(|(pair, _)| {
        let segment = Segment::new(tracer, (&pair[0], &pair[1]), set);
        let (u, drive) = segment.guess(Segment::zero(|part| work(&segment.guess(part).0))?);
        Some(Quadrature { order, u, frequency, drive })
    });
    let met = met.collect();
    (works[0], met)
}

/// Reactive work of the torques of an order, up to a positive factor: zero in phase resonance.
pub(super) fn reactive(set: &HarmonicSet, torques: &[f64], u: &[f64], order: usize) -> f64 {
    let Some(place) = set.place_of(order) else { return 0.0 };
    let m = set.coefficients();
    let of = |(torque, response): (&[f64], &[f64])| {
        torque[place] * response[place] + torque[place + 1] * response[place + 1]
    };
    torques.chunks_exact(m).zip(u.chunks_exact(m)).map(of).sum()
}

/// The line at rest: the mean of every kept group, nothing else.
pub(super) fn at_rest(line: &Line, rest: &[f64], set: &HarmonicSet) -> Vec<f64> {
    let m = set.coefficients();
    let mut u = vec![0.0; line.nodes() * m];
    if set.is_odd() {
        return u;
    }
    let angles = rest_angles(&line.equations, rest);
    let pinned =
        if line.free { angles[line.skeleton.kept[line.skeleton.pattern.last()]] } else { 0.0 };
    for (node, group) in line.skeleton.kept.iter().enumerate() {
        let speed = line.equations.rigid.as_ref().map_or(0.0, |rigid| rigid.speeds[*group]);
        let last = line.skeleton.kept[line.skeleton.pattern.last()];
        let unit = line.equations.rigid.as_ref().map_or(1.0, |rigid| rigid.speeds[last]);
        u[node * m] = angles[*group] - pinned * speed / unit;
    }
    u
}

/// Angles of the groups from the twists of all connections.
fn rest_angles(equations: &EquationsOfMotion, twists: &[f64]) -> Vec<f64> {
    let tree: Vec<f64> = equations.network.tree.iter().map(|edge| twists[edge.shaft]).collect();
    let mut angles = vec![0.0; equations.groups()];
    equations.group_angles(&tree, &mut angles);
    angles
}
