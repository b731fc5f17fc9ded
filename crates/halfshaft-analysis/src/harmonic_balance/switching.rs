//! Times at which the twists of an orbit pass from one piece of a law to another.

use halfshaft_dynamics::laws::Pieces;
use halfshaft_numerics::harmonics::{HarmonicSet, Sampler};

/// A connection's law in pieces with its twist along the orbit.
#[derive(Clone, Debug)]
pub(super) struct Passage {
    /// Times of passing a break within `(0, end)`, ascending, s.
    pub(super) times: Vec<f64>,
}

/// Samples a wave of the highest order.
const SAMPLES_PER_WAVE: usize = 8;

/// Times in `(0, end)` at which the twist of the given coefficients passes a break of its law.
pub(super) fn passages(
    pieces: &Pieces,
    set: &HarmonicSet,
    twist: &[f64],
    speed: f64,
    end: f64,
) -> Passage {
    if pieces.list().len() < 2 {
        return Passage { times: Vec::new() };
    }
    let count = (SAMPLES_PER_WAVE * set.highest().max(8)).next_power_of_two();
    let mut sampler = Sampler::new(count);
    let mut samples = vec![0.0; sampler.count()];
    sampler.samples(set, twist, &mut samples);
    let mut times = phases(pieces, set, twist, &samples);
    times.iter_mut().for_each(|time| *time /= speed);
    times.retain(|time| *time > 0.0 && *time < end);
    Passage { times }
}

/// Phases in `[0, 2π)` at which a twist passes a break of its law, ascending, given uniform samples of
/// it; passages between two samples are found at the turning point there.
pub(super) fn phases(
    pieces: &Pieces,
    set: &HarmonicSet,
    twist: &[f64],
    samples: &[f64],
) -> Vec<f64> {
    let mut found = Vec::new();
    if pieces.list().len() < 2 {
        return found;
    }
    let count = samples.len();
    let step = std::f64::consts::TAU / count as f64;
    let levels = || pieces.list().iter().skip(1).map(|piece| piece.from);
    for at in 0..count {
        let (from, to) = (samples[at], samples[(at + 1) % count]);
        let theta = at as f64 * step;
        for level in levels().filter(|level| (from < *level) != (to < *level)) {
            found.push(cross(set, twist, level, (theta, theta + step)));
        }
        let before = samples[(at + count - 1) % count];
        if (from > before) == (from >= to) && from != to {
            let turn = Turn { before, here: from, behind: to, theta, step };
            turn.hidden(set, twist, levels(), &mut found);
        }
    }
    found.iter_mut().for_each(|theta| *theta = theta.rem_euclid(std::f64::consts::TAU));
    found.sort_by(f64::total_cmp);
    found
}

/// Three samples about a turning point.
struct Turn {
    before: f64,
    here: f64,
    behind: f64,
    theta: f64,
    step: f64,
}

impl Turn {
    /// Passages of levels that lie between the turning point and its samples.
    fn hidden(
        &self,
        set: &HarmonicSet,
        twist: &[f64],
        levels: impl Iterator<Item = f64>,
        found: &mut Vec<f64>,
    ) {
        let bend = 0.5 * (self.before + self.behind) - self.here;
        let lean = 0.5 * (self.behind - self.before);
        // The parabola through the samples goes so far beyond the middle one; twice that is safe.
        let beyond = -0.25 * lean * lean / bend;
        let reach = self.here + 2.0 * beyond;
        let top = bend < 0.0;
        let between = |level: f64| {
            if top {
                level > self.here && level < reach
            } else {
                level <= self.here && level > reach
            }
        };
        let mut turn = None;
        for level in levels.filter(|level| between(*level)) {
            let theta = *turn.get_or_insert_with(|| self.place(set, twist));
            let value = set.evaluate(twist, theta).0;
            if (value > level) == top && value != level {
                found.push(cross(set, twist, level, (self.theta - self.step, theta)));
                found.push(cross(set, twist, level, (theta, self.theta + self.step)));
            }
        }
    }

    /// The turning point, by halving.
    fn place(&self, set: &HarmonicSet, twist: &[f64]) -> f64 {
        let (mut low, mut high) = (self.theta - self.step, self.theta + self.step);
        let rising = set.evaluate(twist, low).1 > 0.0;
        while high - low > 1e-10 * self.step {
            let middle = f64::midpoint(low, high);
            if (set.evaluate(twist, middle).1 > 0.0) == rising {
                low = middle;
            } else {
                high = middle;
            }
        }
        f64::midpoint(low, high)
    }
}

/// The phase in an interval at which the series passes a level: Newton's method kept in the
/// bracket.
fn cross(set: &HarmonicSet, twist: &[f64], level: f64, (mut low, mut high): (f64, f64)) -> f64 {
    let rising = set.evaluate(twist, low).0 < level;
    let mut theta = f64::midpoint(low, high);
    for _ in 0..60 {
        let (value, slope) = set.evaluate(twist, theta);
        if (value < level) == rising {
            low = theta;
        } else {
            high = theta;
        }
        let newton = theta - (value - level) / slope;
        let next = if newton > low && newton < high { newton } else { f64::midpoint(low, high) };
        let moved = (next - theta).abs();
        theta = next;
        if moved <= 4.0 * f64::EPSILON * theta.abs().max(1.0) {
            break;
        }
    }
    theta
}

#[cfg(test)]
mod tests {
    use halfshaft_dynamics::laws::{OneSidedContact, PolynomialLaw, TorqueLaw};

    use super::*;

    // Source: cos θ passes a level c at ± arccos c, however near to its crest and between whichever
    // samples.
    #[test]
    fn passages_near_a_crest_are_found_between_samples() {
        let set = HarmonicSet::all(2);
        let contact = PolynomialLaw::new([0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        for shift in [0.0, 0.013, 0.031, 0.049] {
            let (sin, cos) = f64::sin_cos(shift);
            let twist = [0.0, cos, sin, 0.0, 0.0];
            let samples: Vec<f64> = (0..64)
                .map(|k| (f64::from(k) * std::f64::consts::TAU / 64.0 - shift).cos())
                .collect();
            for gap in [1e-2, 1e-4, 1e-6, 1e-8] {
                let level = 1.0 - gap;
                let law = TorqueLaw::OneSided(OneSidedContact::new(level, &contact, 0.0));
                let found = phases(&law.pieces(), &set, &twist, &samples);
                let half = level.acos();
                let mut exact =
                    [shift - half, shift + half].map(|x| x.rem_euclid(std::f64::consts::TAU));
                exact.sort_by(f64::total_cmp);
                assert_eq!(found.len(), 2, "{shift} {gap}");
                for (a, b) in found.iter().zip(exact) {
                    assert!((a - b).abs() < 4e-15 / half, "{shift} {gap}: {a} {b}");
                }
            }
            let law = TorqueLaw::OneSided(OneSidedContact::new(1.0 + 1e-12, &contact, 0.0));
            assert!(phases(&law.pieces(), &set, &twist, &samples).is_empty());
        }
    }
}
