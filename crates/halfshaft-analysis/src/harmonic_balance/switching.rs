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
    let breaks: Vec<f64> = pieces.list().iter().skip(1).map(|piece| piece.from).collect();
    let mut times = Vec::new();
    if breaks.is_empty() {
        return Passage { times };
    }
    let count = (SAMPLES_PER_WAVE * set.highest().max(8)).next_power_of_two();
    let mut sampler = Sampler::new(count);
    let mut samples = vec![0.0; sampler.count()];
    sampler.samples(set, twist, &mut samples);
    let step = std::f64::consts::TAU / samples.len() as f64;
    for at in 0..samples.len() {
        let (from, to) = (samples[at], samples[(at + 1) % samples.len()]);
        for &level in breaks.iter().filter(|level| (from < **level) != (to < **level)) {
            let theta = cross(set, twist, level, (at as f64 * step, (at + 1) as f64 * step));
            times.push(theta / speed);
        }
    }
    times.retain(|time| *time > 0.0 && *time < end);
    times.sort_by(f64::total_cmp);
    Passage { times }
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
