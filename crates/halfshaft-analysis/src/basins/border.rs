//! The smallest shock near those that were tried: down to the border of a basin, then along it.

use super::shocks::{Hit, Shock, Shocks};
use crate::error::AnalysisError;

/// Hits that are followed down to the border, and of these along it.
const MOST_DOWN: usize = 12;
const MOST_ALONG: usize = 2;
/// Parts of a stretch of sizes that are tried at a time.
const PARTS: usize = 4;
/// Relative width of a border that is narrow enough, and enough to choose by.
const NARROW: f64 = 1e-7;
const ROUGHLY: f64 = 1e-3;
/// Moments tried to each side of the best.
const SIDE: i32 = 4;
/// Finest step between them, in periods: sizes are flat about their smallest.
const FINEST: f64 = 1e-5;
/// Part of the size by which a neighbouring moment may do with less, at first.
const DROP: f64 = 1.0 / 16.0;
/// Rounds along the border at most.
const MOST_ROUNDS: usize = 24;

impl Shocks<'_> {
    /// The smallest shock from a response to another, by hits at moments that are `step` apart.
    pub(super) fn smallest_of(
        &self,
        from: usize,
        to: i32,
        hits: &[Hit],
        step: f64,
    ) -> Result<Option<Shock>, AnalysisError> {
        let least = hits.iter().map(|hit| hit.at).fold(f64::INFINITY, f64::min);
        let mut down: Vec<Hit> = hits.iter().copied().filter(|hit| hit.below <= least).collect();
        down.sort_by(|a, b| a.at.total_cmp(&b.at));
        down.truncate(MOST_DOWN);
        let mut down = self.lowered(from, to, down, ROUGHLY)?;
        down.sort_by(|a, b| a.at.total_cmp(&b.at));
        let mut apart: Vec<Hit> = Vec::new();
        for hit in down {
            let near = |other: &Hit| {
                other.sign == hit.sign && (other.moment - hit.moment).abs() < 1.5 * step
            };
            if apart.len() < MOST_ALONG && !apart.iter().any(near) {
                apart.push(hit);
            }
        }
        let mut best: Option<Hit> = None;
        for hit in apart {
            let hit = self.along(from, to, hit, step)?;
            if best.is_none_or(|best| hit.at < best.at) {
                best = Some(hit);
            }
        }
        Ok(best.map(|hit| Shock { moment: hit.moment, impulse: hit.sign * hit.at }))
    }

    /// Goes along the border to where the smallest shock is enough, in ever finer steps.
    fn along(&self, from: usize, to: i32, start: Hit, step: f64) -> Result<Hit, AnalysisError> {
        let (mut best, mut step, mut drop) = (start, step / f64::from(SIDE), DROP);
        let periods = self.periods(from);
        for _ in 0..MOST_ROUNDS {
            let floor = best.at * (1.0 - drop);
            let tries: Vec<Hit> = (-SIDE..=SIDE)
                .map(|side| Hit {
                    moment: (best.moment + f64::from(side) * step).rem_euclid(periods),
                    below: floor,
                    ..best
                })
                .collect();
            let lowered = self.lowered(from, to, tries, NARROW)?;
            let Some(least) = lowered.into_iter().min_by(|a, b| a.at.total_cmp(&b.at)) else {
                break;
            };
            let moved = (least.moment - best.moment).abs();
            let at_floor = least.below <= floor;
            best = least;
            // At the end of what was tried it goes on in steps of the same length.
            if at_floor || moved > (f64::from(SIDE) - 0.5) * step {
                continue;
            }
            if step <= FINEST {
                break;
            }
            step /= f64::from(SIDE);
            drop = (0.25 * drop).max(4.0 * NARROW);
        }
        Ok(best)
    }

    /// Brings the sizes of every hit together to a relative width; those whose larger size turns out
    /// to lead elsewhere, like everything tried below it, are left out.
    fn lowered(
        &self,
        from: usize,
        to: i32,
        mut hits: Vec<Hit>,
        width: f64,
    ) -> Result<Vec<Hit>, AnalysisError> {
        let size =
            |hit: &Hit, part: usize| hit.below + (hit.at - hit.below) * part as f64 / PARTS as f64;
        let wide = |hit: &Hit| hit.at - hit.below > width * hit.at;
        let mut known = false;
        while !hits.is_empty() && (!known || hits.iter().any(wide)) {
            // Where the larger size leads has to be asked once only.
            let tried = if known { PARTS - 1 } else { PARTS };
            let shock = |hit: &Hit, part: usize| Shock {
                moment: hit.moment,
                impulse: hit.sign * size(hit, part),
            };
            let shocks: Vec<Shock> =
                hits.iter().flat_map(|hit| (1..=tried).map(move |part| shock(hit, part))).collect();
            let outcomes = self.outcomes(from, &shocks)?;
            let narrower = |(hit, ends): (&Hit, &[i32])| {
                let first = ends.iter().position(|end| *end == to);
                let part = first.map(|at| at + 1).or(known.then_some(PARTS))?;
                Some(Hit { below: size(hit, part - 1), at: size(hit, part), ..*hit })
            };
            hits = hits.iter().zip(outcomes.chunks(tried)).filter_map(narrower).collect();
            known = true;
        }
        Ok(hits)
    }
}
