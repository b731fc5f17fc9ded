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
use super::problem::{Axis, Metric, Problem};
use super::system::{HarmonicSystem, Place};
use super::tracer::{Counted, Sample, TraceSettings, Tracer, length, work_of};

/// A guess at a response: coefficients of the kept groups over a set.
#[derive(Clone, Debug)]
pub(super) struct Seed {
    pub(super) set: HarmonicSet,
    pub(super) u: Vec<f64>,
}

/// Halvings of the way between two samples of a curve over the drive.
const HALVINGS: usize = 6;
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
        // Without torque there is nothing but rest.
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
            curve.seeds.extend(passages(&mut tracer, &pair[0], &pair[1]));
        }
        // At one speed the torques of drive 1 are the same all along.
        let torques = tracer.problem.system.by_drive.clone();
        let mut sides = Vec::with_capacity(orders.len());
        for &order in orders {
            let reactive: Vec<f64> =
                samples.iter().map(|sample| reactive(set, &torques, &sample.u, order)).collect();
            sides.push(reactive[0]);
            let pairs = samples.windows(2).zip(reactive.windows(2));
            for (pair, values) in pairs.filter(|(_, values)| values[0] * values[1] < 0.0) {
                let part = values[0] / (values[0] - values[1]);
                let mix = |(a, b): (&f64, &f64)| a + part * (b - a);
                curve.quadratures.push(Quadrature {
                    order,
                    u: pair[0].u.iter().zip(&pair[1].u).map(mix).collect(),
                    frequency,
                    drive: mix((&pair[0].p, &pair[1].p)),
                });
            }
        }
        curve.first = Some((sides, samples[0].u.clone()));
    }
    counted.iterations += tracer.counted.iterations;
    counted.steps += tracer.counted.steps;
    curve
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

/// The responses of drive 1 between two samples of a curve over the drive: two where it turns between
/// them beyond 1.
fn passages(tracer: &mut Tracer<'_, '_>, from: &Sample, to: &Sample) -> Vec<Seed> {
    let crosses = |a: &Sample, b: &Sample| (a.p - 1.0) * (b.p - 1.0) <= 0.0;
    if crosses(from, to) {
        return passage(tracer, from, to).into_iter().collect();
    }
    let Some(part) = turn_beyond(from, to) else { return Vec::new() };
    let Ok(middle) = tracer.on_segment((from, to), part, &from.set) else { return Vec::new() };
    if !crosses(from, &middle) {
        return Vec::new();
    }
    [(from, &middle), (&middle, to)]
        .into_iter()
        .filter_map(|(a, b)| passage(tracer, a, b))
        .collect()
}

/// Part of the way between two samples on the same side of drive 1 at which the cubic through them and
/// their directions turns on the other side.
fn turn_beyond(from: &Sample, to: &Sample) -> Option<f64> {
    let metric = Metric { size: from.metric.0, span: from.metric.1 };
    let chord: Vec<f64> = to.u.iter().zip(&from.u).map(|(b, a)| b - a).collect();
    let way = to.p - from.p;
    let square = metric.norm(&chord, way).powi(2);
    // Change of the drive as the chord is passed at unit speed.
    let [first, last] = [from, to].map(|sample| {
        let share = metric.dot((&sample.tangent, sample.tangent_p), (&chord, way));
        if share > 0.0 { sample.tangent_p * square / share } else { f64::NAN }
    });
    if !(first * last < 0.0) {
        return None;
    }
    let (bend, twist) = (3.0 * way - 2.0 * first - last, first + last - 2.0 * way);
    let drive = |s: f64| from.p + s * (first + s * (bend + s * twist));
    let turns = real_quadratic(3.0 * twist, 2.0 * bend, first);
    let inside = turns.into_iter().filter(|s| *s > 0.0 && *s < 1.0);
    let mut beyond = inside.filter(|s| (drive(*s) - 1.0) * (from.p - 1.0) < 0.0);
    beyond.next()
}

/// Real roots of `a x² + b x + c`.
fn real_quadratic(a: f64, b: f64, c: f64) -> [f64; 2] {
    let sum = -0.5 * (b + (b * b - 4.0 * a * c).sqrt().copysign(b));
    [sum / a, c / sum]
}

/// The response of drive 1 between two samples of a curve over the drive.
fn passage(tracer: &mut Tracer<'_, '_>, from: &Sample, to: &Sample) -> Option<Seed> {
    if (from.p - 1.0) * (to.p - 1.0) > 0.0 || from.p == to.p {
        return None;
    }
    let part = (1.0 - from.p) / (to.p - from.p);
    let mix = |(a, b): (&f64, &f64)| a + part * (b - a);
    let guess: Vec<f64> = from.u.iter().zip(&to.u).map(mix).collect();
    let seed = |u| Seed { set: from.set.clone(), u };
    if let Some(u) = at_full_drive(tracer, &guess, (&from.u, &to.u)) {
        return Some(seed(u));
    }
    // The curve bends between them: halve the way, on the curve, until it does no more.
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..HALVINGS {
        let middle = f64::midpoint(low, high);
        let sample = tracer.on_segment((from, to), middle, &from.set).ok()?;
        if let Some(u) = at_full_drive(tracer, &sample.u, (&from.u, &to.u)) {
            return Some(seed(u));
        }
        if (sample.p - 1.0) * (from.p - 1.0) > 0.0 { low = middle } else { high = middle }
    }
    None
}

/// The response of drive 1 from a guess between two others, no further from it than they are apart.
fn at_full_drive(
    tracer: &mut Tracer<'_, '_>,
    guess: &[f64],
    (from, to): (&[f64], &[f64]),
) -> Option<Vec<f64>> {
    let mut u = guess.to_vec();
    tracer.problem.at(&mut u, 1.0, length(guess)).ok()?;
    let apart = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>();
    (apart(&u, guess) <= apart(from, to)).then_some(u)
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
