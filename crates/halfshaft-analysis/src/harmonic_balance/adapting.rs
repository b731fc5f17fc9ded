//! How many harmonics a response takes.

use halfshaft_numerics::harmonics::HarmonicSet;

use super::tracer::{LEAST_HARMONICS, MOST_HARMONICS, Tracer, length};

/// A last harmonic below this part of the tolerance is dropped.
const SPARE: f64 = 0.01;
/// The same for lines with kinks.
const SPARE_AT_KINKS: f64 = 0.3;

impl Tracer<'_, '_> {
    /// Another set of harmonics where the tolerance asks for one.
    pub(super) fn adapted(&mut self, set: &HarmonicSet, u: &[f64]) -> Option<HarmonicSet> {
        if self.settings.harmonics.is_some() {
            return None;
        }
        let highest = set.highest();
        let tolerance = self.settings.tolerance;
        let truncation = self.problem.system.truncation;
        if truncation > tolerance && highest < MOST_HARMONICS {
            let more = 2.max(highest / 5).next_multiple_of(2);
            return Some(set.up_to((highest + more).min(MOST_HARMONICS)));
        }
        self.exhausted |= truncation > tolerance;
        // Where harmonics converge slowly a hundredth would take many more of them.
        let spare = if self.problem.system.line.has_kinks() { SPARE_AT_KINKS } else { SPARE };
        let enough = (truncation < spare * tolerance)
            .then(|| enough(set, u, spare * tolerance * length(u)))
            .filter(|enough| *enough < highest);
        enough.map(|enough| set.up_to(enough))
    }
}

/// The lowest highest order beyond which the coefficients of no node are longer than `rest`.
fn enough(set: &HarmonicSet, u: &[f64], rest: f64) -> usize {
    let m = set.coefficients();
    let (mut highest, step) = (set.highest(), if set.is_odd() { 2 } else { 1 });
    let mut beyond = vec![0.0; u.len() / m];
    while highest >= LEAST_HARMONICS + step {
        let Some(place) = set.place_of(highest) else { break };
        for (sum, node) in beyond.iter_mut().zip(u.chunks_exact(m)) {
            *sum += node[place] * node[place] + node[place + 1] * node[place + 1];
        }
        if beyond.iter().any(|sum| sum.sqrt() >= rest) {
            break;
        }
        highest -= step;
    }
    highest
}
