//! The equations of motion written out again, and shooting: what responses are held against.
//!
//! Nothing here uses condensation, the alternating frequency-time method or the Taylor series of the
//! multipliers. The waveform is summed term by term, its residual in the equations of motion taken at
//! many phases; the orbit is closed anew by shooting at a tolerance near rounding.

use std::f64::consts::{PI, TAU};

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_numerics::Complex;
use halfshaft_numerics::harmonics::HarmonicSet;
use halfshaft_numerics::ode::periodic::{PeriodicOrbit, PeriodicSettings, find_orbit};
use halfshaft_numerics::ode::{Settings, System, Tolerance};

use super::Traced;
use crate::harmonic_balance::branches::TracedBranch;
use crate::harmonic_balance::channels::group_series;
use crate::harmonic_balance::problem::{Axis, Problem};
use crate::harmonic_balance::system::{HarmonicSystem, Place};
use crate::harmonic_balance::tracer::{Sample, length, refit};
use crate::verification::ElasticMotion;

/// Angles of all groups over one period as Fourier series.
pub(super) struct Waveform<'e> {
    pub(super) equations: &'e EquationsOfMotion,
    pub(super) set: HarmonicSet,
    /// Coefficients, group by group.
    pub(super) series: Vec<f64>,
    /// Frequency of the fundamental, rad/s.
    pub(super) speed: f64,
    /// Excitation speed, rad/s.
    pub(super) frequency: f64,
}

/// Angle, speed and acceleration of every group.
pub(super) struct Moment {
    pub(super) angles: Vec<f64>,
    pub(super) speeds: Vec<f64>,
    pub(super) accelerations: Vec<f64>,
}

/// Phases at which residuals are taken.
const PHASES: usize = 240;

pub(super) fn waveform<'t>(
    traced: &'t Traced,
    branch: &TracedBranch,
    sample: &Sample,
) -> Waveform<'t> {
    let line = traced.setting.line.clone();
    let mut system = HarmonicSystem::new(line, sample.set.clone(), branch.base);
    let place = Place { frequency: sample.p, drive: 1.0 };
    Waveform {
        equations: &traced.setting.line.equations,
        series: group_series(&mut system, &sample.u, place),
        set: sample.set.clone(),
        speed: branch.base * sample.p,
        frequency: sample.p,
    }
}

/// Steady speed and steady acceleration of a free line as a whole under its mean torques.
fn steady(equations: &EquationsOfMotion) -> (f64, f64) {
    let Some(rigid) = &equations.rigid else { return (0.0, 0.0) };
    let mean = equations.excitation.mean(equations.groups());
    let torque: f64 = mean.iter().zip(&rigid.speeds).map(|(q, r)| q * r).sum();
    let dampers: f64 =
        equations.ground_damping.iter().zip(&rigid.speeds).map(|(d, r)| d * r * r).sum();
    if dampers > 0.0 { (torque / dampers, 0.0) } else { (0.0, torque / rigid.inertia) }
}

impl Waveform<'_> {
    pub(super) fn at(&self, theta: f64) -> Moment {
        let m = self.set.coefficients();
        let groups = self.series.len() / m;
        let zero = vec![0.0; groups];
        let mut moment = Moment { angles: zero.clone(), speeds: zero.clone(), accelerations: zero };
        for (group, x) in self.series.chunks_exact(m).enumerate() {
            for (order, place) in self.set.places() {
                if order == 0 {
                    moment.angles[group] += x[place];
                    continue;
                }
                let (nu, angle) = (order as f64 * self.speed, order as f64 * theta);
                let (a, b) = (x[place], x[place + 1]);
                let (value, slope) =
                    (a * angle.cos() + b * angle.sin(), b * angle.cos() - a * angle.sin());
                moment.angles[group] += value;
                moment.speeds[group] += nu * slope;
                moment.accelerations[group] -= nu * nu * value;
            }
        }
        moment
    }

    /// What is missing in the equation of motion of each group at a phase, and the sum of all
    /// magnitudes there, N·m.
    fn missing(&self, theta: f64) -> (Vec<f64>, f64) {
        let equations = self.equations;
        let moment = self.at(theta);
        let (whole_speed, whole_acceleration) = steady(equations);
        let whole = |group: usize| equations.rigid.as_ref().map_or(0.0, |r| r.speeds[group]);
        let mut out = vec![0.0; equations.groups()];
        let mut size = 0.0;
        for (group, out) in out.iter_mut().enumerate() {
            let inertia = equations.inertia[group]
                * (moment.accelerations[group] + whole_acceleration * whole(group));
            let damper = equations.ground_damping[group]
                * (moment.speeds[group] + whole_speed * whole(group));
            *out += inertia + damper;
            size += inertia.abs() + damper.abs();
        }
        for connection in &equations.connections {
            let end = |end: halfshaft_model::End, q: &[f64]| end.map_or(0.0, |(g, r)| r * q[g]);
            let x = end(connection.from, &moment.angles) - end(connection.to, &moment.angles);
            let v = end(connection.from, &moment.speeds) - end(connection.to, &moment.speeds);
            let friction = connection.friction.as_ref().map_or(0.0, |friction| friction.torque(v));
            let torque = connection.law.torque(x) + connection.damping * v + friction;
            size += torque.abs();
            if let Some((group, ratio)) = connection.from {
                out[group] += ratio * torque;
            }
            if let Some((group, ratio)) = connection.to {
                out[group] -= ratio * torque;
            }
        }
        let time = theta / self.speed;
        for source in &equations.excitation.sources {
            let mut torque = source.mean;
            let growth = (self.frequency / source.reference_speed).powf(source.speed_power);
            for h in &source.harmonics {
                let angle = h.order * self.frequency * time + h.phase_rad;
                torque += growth * h.amplitude_nm * angle.cos();
            }
            out[source.group] -= source.ratio * torque;
            size += (source.ratio * torque).abs();
        }
        (out, size)
    }

    /// Largest missing torque over the period, and largest harmonic of it among the orders kept,
    /// both relative to all torques.
    pub(super) fn residual(&self) -> (f64, f64) {
        let groups = self.equations.groups();
        let mut rows = Vec::new();
        let mut size = 0.0_f64;
        // Enough for a law of degree seven not to fold its orders back on those of the set.
        let phases = PHASES.max(8 * self.set.highest() + 2);
        for k in 0..phases {
            let (row, sum) = self.missing(TAU * k as f64 / phases as f64);
            size = size.max(sum);
            rows.push(row);
        }
        let worst = rows.iter().flatten().fold(0.0_f64, |most, value| most.max(value.abs()));
        let mut kept = 0.0_f64;
        for group in 0..groups {
            for &order in self.set.orders() {
                let mut sum = Complex::default();
                for (k, row) in rows.iter().enumerate() {
                    let angle = TAU * (order * k) as f64 / phases as f64;
                    sum = sum + Complex::from_polar(row[group], -angle);
                }
                kept = kept.max(2.0 * sum.modulus() / phases as f64);
            }
        }
        (worst / size, kept / size)
    }

    /// The state of the elastic motion at a phase.
    pub(super) fn state(&self, theta: f64, motion: &ElasticMotion<'_>) -> Vec<f64> {
        let moment = self.at(theta);
        let mut state = vec![0.0; motion.dimension()];
        for (index, edge) in self.equations.network.tree.iter().enumerate() {
            state[index] = self.equations.twist(edge.shaft, &moment.angles);
            state[motion.twists() + index] = self.equations.twist(edge.shaft, &moment.speeds);
        }
        if let (Some(rigid), true) =
            (&self.equations.rigid, motion.dimension() > 2 * motion.twists())
        {
            state[2 * motion.twists()] = rigid.mean(&moment.speeds) + steady(self.equations).0;
        }
        state
    }
}

/// A response closed anew by shooting.
pub(super) struct Shot {
    pub(super) orbit: PeriodicOrbit,
    /// Largest difference from the waveform over the period, twists over the largest twist and
    /// rates over the largest rate.
    pub(super) difference: f64,
}

/// Times of a period at which orbits are compared.
const MOMENTS: usize = 24;

/// The periodic orbit of the full equations from the state of a waveform.
pub(super) fn shoot(wave: &Waveform<'_>) -> Option<Shot> {
    let mut motion = ElasticMotion::new(wave.equations, wave.frequency);
    let (n, dimension) = (motion.twists(), motion.dimension());
    let states: Vec<Vec<f64>> =
        (0..MOMENTS).map(|k| wave.state(TAU * k as f64 / MOMENTS as f64, &motion)).collect();
    let largest = |range: std::ops::Range<usize>| {
        states.iter().flat_map(|s| s[range.clone()].to_vec()).fold(0.0_f64, |a, b| a.max(b.abs()))
    };
    let (twist, rate) = (largest(0..n), largest(n..dimension));
    let size = |k: usize| if k < n { twist } else { rate };
    let integration = Settings::with_tolerance(1e-13);
    let mut settings = PeriodicSettings { integration, ..PeriodicSettings::default() };
    settings.integration.absolute_tolerance =
        Tolerance::PerComponent((0..dimension).map(|k| 1e-13 * size(k)).collect());
    settings.integration.step_limit = 100_000;
    settings.newton.step_tolerance = 1e-11;
    settings.newton.typical = (0..dimension).map(size).collect();
    let period = TAU / wave.speed;
    let orbit = find_orbit(&mut motion, 0.0, period, &states[0], &settings).ok()?;
    if !orbit.report.converged.is_converged() {
        return None;
    }
    let found = orbit.sample(&mut motion, MOMENTS, &settings.integration).ok()?;
    let mut difference = 0.0_f64;
    for (moment, state) in states.iter().enumerate() {
        for (k, value) in state.iter().enumerate() {
            difference = difference.max((value - found[(k, moment)]).abs() / size(k));
        }
    }
    Some(Shot { orbit, difference })
}

/// Largest distance of a multiplier from its partner in the other list, over the larger of 1 and its
/// modulus; partners are the nearest that are left.
pub(super) fn apart(a: &[Complex], b: &[Complex]) -> f64 {
    assert_eq!(a.len(), b.len());
    let mut left = b.to_vec();
    let mut most = 0.0_f64;
    for one in a {
        let distance = |other: &Complex| (*one - *other).modulus();
        let nearest =
            (0..left.len()).min_by(|i, j| distance(&left[*i]).total_cmp(&distance(&left[*j])));
        let other = left.swap_remove(nearest.expect("as many in both"));
        most = most.max(distance(&other) / one.modulus().max(1.0));
    }
    most
}

/// States at time 0 of all responses at an excitation speed, and of the same half a period later with
/// the other sign, one list for each passage of a branch.
pub(super) fn responses_at(found: &Traced, frequency: f64) -> Vec<Vec<Vec<f64>>> {
    let mut list = Vec::new();
    for branch in &found.collected.branches {
        for pair in branch.samples.windows(2) {
            if (pair[0].p < frequency) == (pair[1].p < frequency) {
                continue;
            }
            let set = &pair[1].set;
            let part = (frequency - pair[0].p) / (pair[1].p - pair[0].p);
            let from = refit(&pair[0].set, set, 1, &pair[0].u);
            let mut u: Vec<f64> =
                from.iter().zip(&pair[1].u).map(|(a, b)| a + part * (b - a)).collect();
            let line = found.setting.line.clone();
            let place = Place { frequency, drive: 1.0 };
            let system = HarmonicSystem::new(line, set.clone(), branch.base);
            let mut problem = Problem::new(system, Axis::Frequency, place);
            let size = length(&u);
            if problem.at(&mut u, frequency, size).is_err() {
                continue;
            }
            let sample = Sample { u, p: frequency, ..pair[1].clone() };
            let wave = waveform(found, branch, &sample);
            let motion = ElasticMotion::new(wave.equations, frequency);
            let mut states = Vec::new();
            for period in 0..branch.periods {
                let theta = TAU * f64::from(period) / f64::from(branch.periods);
                states.push(wave.state(theta, &motion));
                let half = wave.state(theta + PI / f64::from(branch.periods), &motion);
                states.push(half.iter().map(|x| -x).collect());
            }
            list.push(states);
        }
    }
    list
}

/// States at time 0 of all periodic orbits that shooting finds from `starts` states of about `size`.
pub(super) fn brute_force(
    equations: &EquationsOfMotion,
    frequency: f64,
    base: f64,
    size: f64,
    starts: usize,
) -> Vec<Vec<f64>> {
    let mut motion = ElasticMotion::new(equations, frequency);
    let (n, dimension) = (motion.twists(), motion.dimension());
    let integration = Settings::with_tolerance(1e-9);
    let mut settings = PeriodicSettings { integration, ..PeriodicSettings::default() };
    settings.integration.step_limit = 3000;
    settings.newton.iteration_limit = 15;
    let period = TAU / (base * frequency);
    let mut found: Vec<Vec<f64>> = Vec::new();
    for start in 0..starts {
        // A low-discrepancy sequence (the additive recurrence of irrational numbers).
        let part = |k: usize| {
            let irrational = (2.0 + k as f64).sqrt() + 0.618 * k as f64;
            2.0 * (irrational * (start as f64 + 0.5)).fract() - 1.0
        };
        let speed = base * frequency;
        let guess: Vec<f64> =
            (0..dimension).map(|k| size * part(k) * if k < n { 1.0 } else { speed }).collect();
        let Ok(orbit) = find_orbit(&mut motion, 0.0, period, &guess, &settings) else { continue };
        let largest = orbit.state[..n].iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        if !orbit.report.converged.is_converged() || orbit.residual > 1e-6 || largest > 10.0 * size
        {
            continue;
        }
        let same = |other: &Vec<f64>| {
            let away = other.iter().zip(&orbit.state).map(|(a, b)| (a - b).powi(2)).sum::<f64>();
            away.sqrt() < 1e-4 * size
        };
        if !found.iter().any(same) {
            found.push(orbit.state);
        }
    }
    found
}
