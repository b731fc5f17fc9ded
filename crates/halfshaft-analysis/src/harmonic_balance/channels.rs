//! Channels of the line along a branch: mean, first harmonic and swing of twists, torques, speeds.

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_numerics::Complex;
use halfshaft_numerics::harmonics::{HarmonicSet, Sampler};
use halfshaft_results::Named;

use super::alternating::differentiate;
use super::breaks::breaks;
use super::switching::phases;
use super::system::{HarmonicSystem, Place};

/// Mean, modulus of the first harmonic, half of peak to peak and both peaks of one channel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct ChannelValue {
    pub(crate) amplitude: f64,
    pub(crate) mean: f64,
    pub(crate) harmonic1: f64,
    pub(crate) maximum: f64,
    pub(crate) minimum: f64,
}

/// Measures the channels of responses over one set of harmonics.
pub(super) struct Channels {
    set: HarmonicSet,
    /// Order within the set that is the first harmonic of the excitation.
    first: usize,
    sampler: Sampler,
    samples: Vec<f64>,
    rates: Vec<f64>,
    /// The first harmonic at the samples.
    turns: Vec<Complex>,
}

/// Names and units of the channels of a line, in the order of their values.
pub(crate) fn names(equations: &EquationsOfMotion) -> Vec<(String, &'static str)> {
    let mut names = Vec::new();
    for connection in &equations.connections {
        for (word, unit) in [("twist", "rad"), ("twist_rate", "rad/s"), ("torque", "N·m")] {
            names.push((format!("{}.{word}", connection.name), unit));
        }
    }
    for node in &equations.nodes {
        for (word, unit) in [("angle", "rad"), ("speed", "rad/s")] {
            names.push((format!("{}.{word}", node.name), unit));
        }
    }
    names
}

/// Samples a period at least.
const LEAST_SAMPLES: usize = 32;
/// Samples a period at least where a torque is no polynomial of the twist.
const LEAST_TORQUE_SAMPLES: usize = 64;

/// A step to a crest, rad, below which the parabola there tells its height to rounding.
const NEAR_CREST: f64 = 1e-5;

impl Channels {
    /// Channels of responses whose period is `periods` periods of the excitation.
    pub(super) fn new(set: &HarmonicSet, periods: u32) -> Self {
        let least = LEAST_TORQUE_SAMPLES.max(LEAST_SAMPLES).max(6 * set.highest());
        let sampler = Sampler::new(least.next_power_of_two());
        let count = sampler.count();
        let turn = std::f64::consts::TAU * f64::from(periods) / count as f64;
        let turns = (0..count).map(|k| Complex::from_polar(1.0, -turn * k as f64)).collect();
        Self {
            turns,
            set: set.clone(),
            first: periods as usize,
            sampler,
            samples: vec![0.0; count],
            rates: vec![0.0; count],
        }
    }

    pub(super) fn set(&self) -> &HarmonicSet {
        &self.set
    }

    /// Values of all channels at a response.
    pub(super) fn measure(
        &mut self,
        system: &mut HarmonicSystem,
        u: &[f64],
        place: Place,
    ) -> Vec<ChannelValue> {
        let m = self.set.coefficients();
        let equations = std::rc::Rc::clone(&system.line.equations);
        let groups = group_series(system, u, place);
        let speed = system.fundamental(place);
        let mut values =
            Vec::with_capacity(3 * equations.connections.len() + 2 * equations.nodes.len());
        let (mut twist, mut rate) = (vec![0.0; m], vec![0.0; m]);
        // Twists of shafts to ground, which are angles as well, with their places among the values.
        let mut grounded: Vec<(usize, usize)> = Vec::new();
        for connection in &equations.connections {
            twist.fill(0.0);
            let ends = [connection.from, connection.to.map(|(group, ratio)| (group, -ratio))];
            for (group, factor) in ends.into_iter().flatten() {
                let source = &groups[group * m..(group + 1) * m];
                twist.iter_mut().zip(source).for_each(|(x, q)| *x += factor * q);
            }
            if let (Some((group, 1.0)), None) = (connection.from, connection.to) {
                grounded.push((group, values.len()));
            }
            differentiate(&self.set, &twist, speed, &mut rate);
            let value = self.series(&twist);
            values.push(value);
            values.push(self.series(&rate));
            values.push(self.torque(connection, &twist, &rate, speed, value));
        }
        for node in &equations.nodes {
            let known =
                grounded.iter().find(|(group, _)| *group == node.group && node.ratio == 1.0);
            if let Some((_, at)) = known {
                values.extend_from_within(*at..at + 2);
                continue;
            }
            let source = &groups[node.group * m..(node.group + 1) * m];
            twist.iter_mut().zip(source).for_each(|(x, q)| *x = node.ratio * q);
            differentiate(&self.set, &twist, speed, &mut rate);
            values.push(self.series(&twist));
            values.push(self.series(&rate));
        }
        values
    }

    fn first_harmonic(&self, coefficients: &[f64]) -> f64 {
        self.set.modulus(coefficients, self.first)
    }

    /// Values of a series.
    fn series(&mut self, coefficients: &[f64]) -> ChannelValue {
        let mean = if self.set.is_odd() { 0.0 } else { coefficients[0] };
        let harmonic1 = self.first_harmonic(coefficients);
        self.sampler.samples(&self.set, coefficients, &mut self.samples);
        let top = self.extreme(coefficients, 1.0);
        let bottom = if self.set.is_odd() { -top } else { self.extreme(coefficients, -1.0) };
        ChannelValue {
            amplitude: 0.5 * (top - bottom),
            mean,
            harmonic1,
            maximum: top,
            minimum: bottom,
        }
    }

    /// The greatest value (least for a sign of -1) of a series whose samples are at hand.
    fn extreme(&self, coefficients: &[f64], sign: f64) -> f64 {
        let near = self.near(sign);
        let mut theta = near.start + near.offset;
        let mut value = near.value;
        let mut keep = |candidate: f64| {
            if sign * candidate > sign * value {
                value = candidate;
            }
        };
        for _ in 0..6 {
            let [here, slope, curvature] = with_slopes(&self.set, coefficients, theta);
            keep(here);
            let step = -slope / curvature;
            let away = (theta + step - near.start).abs();
            if !step.is_finite() || away > near.spacing || sign * curvature > 0.0 {
                break;
            }
            if step.abs() < NEAR_CREST {
                keep(here + 0.5 * slope * step);
                break;
            }
            theta += step;
        }
        value
    }

    /// The greatest sample (least for a sign of -1), and how far beyond it the parabola through its
    /// neighbours has its crest.
    fn near(&self, sign: f64) -> Near {
        let count = self.samples.len();
        let best = (0..count).fold(0, |best, at| {
            if sign * self.samples[at] > sign * self.samples[best] { at } else { best }
        });
        let spacing = std::f64::consts::TAU / count as f64;
        let value = self.samples[best];
        let before = self.samples[if best == 0 { count - 1 } else { best - 1 }];
        let after = self.samples[if best + 1 == count { 0 } else { best + 1 }];
        let bend = before - 2.0 * value + after;
        let offset = if bend == 0.0 { 0.0 } else { 0.5 * spacing * (before - after) / bend };
        Near { start: spacing * best as f64, spacing, offset, sign, value }
    }

    /// Values of the torque of a connection: its law, friction and damper.
    fn torque(
        &mut self,
        connection: &halfshaft_dynamics::Connection,
        twist: &[f64],
        rate: &[f64],
        speed: f64,
        of_twist: ChannelValue,
    ) -> ChannelValue {
        if connection.law.is_linear() && connection.friction.is_none() {
            let k = connection.law.stiffness(0.0);
            let sum: Vec<f64> =
                twist.iter().zip(rate).map(|(x, v)| k * x + connection.damping * v).collect();
            let mut value = self.series(&sum);
            let preload = connection.law.torque(0.0);
            value.mean = preload + k * of_twist.mean;
            value.maximum += preload;
            value.minimum += preload;
            return value;
        }
        self.sampler.samples(&self.set, twist, &mut self.samples);
        self.sampler.samples(&self.set, rate, &mut self.rates);
        let phases = phases(&connection.law.pieces(), &self.set, twist, &self.samples);
        let breaks = breaks(connection, &self.set, (twist, rate), &phases);
        let of = |x: f64, v: f64| connection.law.torque(x) + connection.resistance(x, v);
        for (x, v) in self.samples.iter_mut().zip(&self.rates) {
            *x = of(*x, *v);
        }
        let count = self.samples.len();
        let spacing = std::f64::consts::TAU / count as f64;
        let mut ends = [0.0; 2];
        // Of a motion that mirrors itself the one end is the other's image.
        let both = if self.set.is_odd() { 1 } else { 2 };
        for (end, sign) in ends.iter_mut().zip([1.0, -1.0]).take(both) {
            let near = self.near(sign);
            let smooth = connection.law.polynomial().is_some() && connection.friction.is_none();
            let crest = if smooth { self.crest(connection, twist, speed, near) } else { None };
            *end = crest.unwrap_or_else(|| {
                let at = |theta: f64| {
                    let (x, slope) = self.set.evaluate(twist, theta);
                    of(x, speed * slope)
                };
                climb(&at, near)
            });
            for torque in breaks.iter().flat_map(|one| one.torque) {
                if sign * torque > sign * *end {
                    *end = torque;
                }
            }
        }
        if both == 1 {
            ends[1] = -ends[0];
        }
        let mut mean = 0.0;
        let mut sum = Complex::default();
        for (torque, turn) in self.samples.iter().zip(&self.turns) {
            mean += torque;
            sum = sum + turn.scaled(*torque);
        }
        for one in &breaks {
            mean += one.missed(spacing, 0.0).re / spacing;
            sum = sum + one.missed(spacing, self.first as f64).scaled(1.0 / spacing);
        }
        let scale = 1.0 / count as f64;
        ChannelValue {
            amplitude: 0.5 * (ends[0] - ends[1]),
            mean: scale * mean,
            harmonic1: 2.0 * scale * sum.modulus(),
            maximum: ends[0],
            minimum: ends[1],
        }
    }

    /// The greatest (least) torque of a smooth law near a sample, by secants on its slope.
    fn crest(
        &self,
        connection: &halfshaft_dynamics::Connection,
        twist: &[f64],
        speed: f64,
        near: Near,
    ) -> Option<f64> {
        let at = |theta: f64| {
            let [x, slope, bend] = with_slopes(&self.set, twist, theta);
            let torque = connection.law.torque(x) + connection.damping * speed * slope;
            (torque, connection.law.stiffness(x) * slope + connection.damping * speed * bend)
        };
        let here = near.start + near.offset;
        let (mut before, mut here) = (here - 0.02 * near.spacing, here);
        let mut slope_before = at(before).1;
        for _ in 0..8 {
            let (torque, slope) = at(here);
            let step = -slope * (here - before) / (slope - slope_before);
            if slope == 0.0 || step.abs() < NEAR_CREST {
                let crest = if slope == 0.0 { torque } else { torque + 0.5 * slope * step };
                // Not the crest if that falls off.
                return (near.sign * crest >= near.sign * near.value).then_some(crest);
            }
            (before, slope_before) = (here, slope);
            here += step;
            if !step.is_finite() || (here - near.start).abs() > near.spacing {
                return None;
            }
        }
        None
    }
}

/// Where an extreme of samples is.
#[derive(Clone, Copy)]
struct Near {
    start: f64,
    spacing: f64,
    offset: f64,
    /// 1 for the greatest, -1 for the least.
    sign: f64,
    value: f64,
}

/// Value, first and second derivative by the phase.
fn with_slopes(set: &HarmonicSet, coefficients: &[f64], theta: f64) -> [f64; 3] {
    let (sin1, cos1) = theta.sin_cos();
    let (mut sine, mut cosine, mut at) = (0.0, 1.0, 0);
    let mut out = [0.0; 3];
    for (order, place) in set.places() {
        while at < order {
            (sine, cosine) = (sine * cos1 + cosine * sin1, cosine * cos1 - sine * sin1);
            at += 1;
        }
        if order == 0 {
            out[0] += coefficients[place];
            continue;
        }
        let n = order as f64;
        let (a, b) = (coefficients[place], coefficients[place + 1]);
        let (even, odd) = (a * cosine + b * sine, b * cosine - a * sine);
        out[0] += even;
        out[1] += n * odd;
        out[2] -= n * n * even;
    }
    out
}

/// The greatest (least) value near a sample by parabolas of shrinking width.
fn climb(value: &dyn Fn(f64) -> f64, near: Near) -> f64 {
    let (mut best, mut theta, mut width) = (near.value, near.start, near.spacing);
    for _ in 0..5 {
        let (before, here, after) = (value(theta - width), value(theta), value(theta + width));
        let bend = before - 2.0 * here + after;
        let offset = if bend == 0.0 { 0.0 } else { 0.5 * width * (before - after) / bend };
        theta += offset.clamp(-width, width);
        for candidate in [before, here, after] {
            if near.sign * candidate > near.sign * best {
                best = candidate;
            }
        }
        width *= 0.2;
    }
    let last = value(theta);
    if near.sign * last > near.sign * best { last } else { best }
}

/// Coefficients of the angles of all groups, group by group.
pub(super) fn group_series(system: &mut HarmonicSystem, u: &[f64], place: Place) -> Vec<f64> {
    let set = system.set.clone();
    let m = set.coefficients();
    let groups = system.line.equations.groups();
    if system.line.skeleton.steps.is_empty() {
        return u.to_vec();
    }
    let mut series = vec![0.0; groups * m];
    for (index, (order, at)) in set.places().enumerate() {
        for (group, amplitude) in system.group_amplitudes(u, place, index).iter().enumerate() {
            series[group * m + at] = amplitude.re;
            if order > 0 {
                series[group * m + at + 1] = -amplitude.im;
            }
        }
    }
    series
}

/// Values by column name.
pub(super) fn named(equations: &EquationsOfMotion, values: &[ChannelValue]) -> Named<f64> {
    let mut out = Named::default();
    for ((name, _), value) in names(equations).into_iter().zip(values) {
        out.insert(format!("{name}.amplitude"), value.amplitude);
        out.insert(format!("{name}.mean"), value.mean);
        out.insert(format!("{name}.harmonic1"), value.harmonic1);
        out.insert(format!("{name}.maximum"), value.maximum);
        out.insert(format!("{name}.minimum"), value.minimum);
    }
    out
}
