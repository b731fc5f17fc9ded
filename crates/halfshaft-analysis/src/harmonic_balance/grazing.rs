//! Grazing contact: a turning point of a twist touches a twist at which the stiffness jumps.

use halfshaft_numerics::harmonics::{HarmonicSet, Sampler};

use super::line::Line;
use super::tracer::Sample;

/// Which twist touches what.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Touch {
    /// Index of the nonlinear twist.
    index: usize,
    /// Index of the connection.
    pub(crate) connection: usize,
    /// The switching twist, rad.
    pub(crate) level: f64,
    /// Passages of the level below which the response counts as not touching.
    fewer: usize,
}

/// A turning point of a series: its value, and whether it is a maximum.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Extreme {
    value: f64,
    top: bool,
}

/// Samples a wave of the highest order.
const SAMPLES_PER_WAVE: usize = 8;

/// What begins or ceases to touch between two samples of a branch.
pub(super) fn touches(line: &Line, from: &Sample, to: &Sample) -> Vec<Touch> {
    let mut found = Vec::new();
    for (index, twist) in line.twists.iter().enumerate() {
        let law = &line.equations.connections[twist.connection].law;
        if law.switching_twists().is_empty() {
            continue;
        }
        let ends = [from, to].map(|sample| extremes(line, index, sample));
        // A mirrored response touches the mirrored level half a period later.
        let mirrored = from.set.is_odd();
        for &level in law.switching_twists().iter().filter(|level| !mirrored || **level >= 0.0) {
            let [before, behind] = ends.each_ref().map(|list| passages(list, level));
            if before != behind {
                let fewer = before.min(behind);
                found.push(Touch { index, connection: twist.connection, level, fewer });
            }
        }
    }
    found
}

impl Touch {
    /// How far the nearest turning point is beyond the level, negative while it does not reach it, rad.
    pub(super) fn beyond(&self, line: &Line, sample: &Sample) -> f64 {
        let list = extremes(line, self.index, sample);
        let touching = passages(&list, self.level) > self.fewer;
        let over =
            list.iter().map(|e| if e.top { e.value - self.level } else { self.level - e.value });
        let near = over.filter(|over| (*over > 0.0) == touching).map(f64::abs);
        let near = near.reduce(f64::min).unwrap_or(f64::NAN);
        if touching { near } else { -near }
    }

    /// As a sentence.
    pub(super) fn words(&self, line: &Line, sample: &Sample) -> String {
        let list = extremes(line, self.index, sample);
        let nearest = list
            .iter()
            .min_by(|a, b| (a.value - self.level).abs().total_cmp(&(b.value - self.level).abs()));
        let side = if nearest.is_none_or(|extreme| extreme.top) { "below" } else { "above" };
        let name = &line.equations.connections[self.connection].name;
        format!("the twist of `{name}` touches {} rad from {side}", six_digits(self.level))
    }
}

/// A number rounded to six digits, for words.
pub(super) fn six_digits(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

/// How often a series with these turning points passes a level within a period.
fn passages(list: &[Extreme], level: f64) -> usize {
    let next = list.iter().cycle().skip(1);
    list.iter().zip(next).filter(|(a, b)| (a.value > level) != (b.value > level)).count()
}

/// Turning points of a nonlinear twist, in the order of a period.
fn extremes(line: &Line, index: usize, sample: &Sample) -> Vec<Extreme> {
    let set = &sample.set;
    let m = set.coefficients();
    let mut twist = vec![0.0; m];
    for (node, factor) in &line.twists[index].parts {
        let source = &sample.u[node * m..(node + 1) * m];
        twist.iter_mut().zip(source).for_each(|(x, q)| *x += factor * q);
    }
    let count = (SAMPLES_PER_WAVE * set.highest().max(8)).next_power_of_two();
    let mut samples = vec![0.0; count];
    Sampler::new(count).samples(set, &twist, &mut samples);
    let spacing = std::f64::consts::TAU / count as f64;
    let mut found = Vec::new();
    for at in 0..count {
        let (before, here) = (samples[(at + count - 1) % count], samples[at]);
        let behind = samples[(at + 1) % count];
        let top = here > before && here >= behind;
        if top || (here < before && here <= behind) {
            let value = turning(set, &twist, spacing * at as f64, spacing, top);
            found.push(Extreme { value, top });
        }
    }
    found
}

/// The value at the turning point within a spacing of a phase.
fn turning(set: &HarmonicSet, twist: &[f64], theta: f64, spacing: f64, top: bool) -> f64 {
    let slope = |at: f64| set.evaluate(twist, at).1 * if top { 1.0 } else { -1.0 };
    let (mut low, mut high) = (theta - spacing, theta + spacing);
    let (mut at_low, mut at_high) = (slope(low), slope(high));
    if at_low <= 0.0 || at_high >= 0.0 {
        return set.evaluate(twist, theta).0;
    }
    // Regula falsi with the weights of the Illinois rule: the value is flat there, half the digits do.
    let mut side = 0;
    for _ in 0..40 {
        let at = (low * at_high - high * at_low) / (at_high - at_low);
        let here = slope(at);
        if here > 0.0 {
            (low, at_low) = (at, here);
            at_high *= if side == 1 { 0.5 } else { 1.0 };
            side = 1;
        } else {
            (high, at_high) = (at, here);
            at_low *= if side == -1 { 0.5 } else { 1.0 };
            side = -1;
        }
        if high - low <= 1e-9 * spacing || here == 0.0 {
            break;
        }
        if (at_low.abs().min(at_high.abs())) <= 1e-12 * (at_low.abs().max(at_high.abs())) {
            break;
        }
    }
    let ends = [low, high].map(|at| set.evaluate(twist, at).0);
    if top { ends[0].max(ends[1]) } else { ends[0].min(ends[1]) }
}
