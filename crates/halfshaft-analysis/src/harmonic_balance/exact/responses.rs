//! Orbits as responses with harmonics, as many as the tolerance asks for.

use halfshaft_numerics::harmonics::HarmonicSet;

use super::super::alternating::combine;
use super::super::answer::Setting;
use super::super::branches::TracedBranch;
use super::super::line::Line;
use super::super::orbits::coefficients_of;
use super::super::special::Special;
use super::super::tracer::{LEAST_HARMONICS, Sample, length, refit};
use super::curve::Curve;
use super::explorer::ExactBranch;
use super::point::Point;

/// Highest orders that are tried, one after the other.
pub(super) const ORDERS: [usize; 4] = [64, 200, 600, 1200];
/// Orders from which those beyond the highest are judged.
const LAST: usize = 16;
/// Part of the tolerance that special points are told to.
const SPECIAL: f64 = 0.05;
/// Orders of sets: few different ones.
const RUNGS: [usize; 16] = [3, 5, 9, 15, 25, 39, 59, 89, 129, 199, 299, 399, 599, 799, 999, 1199];

/// Makes responses of orbits.
pub(super) struct Responses<'s> {
    pub(super) setting: &'s Setting,
    pub(super) tolerance: f64,
}

impl Responses<'_> {
    pub(super) fn branch(
        &self,
        curve: &mut Curve<'_, '_>,
        branch: ExactBranch,
        exhausted: &mut bool,
    ) -> TracedBranch {
        let mut samples = Vec::with_capacity(branch.points.len());
        for point in &branch.points {
            samples.extend(self.sample(curve, point, self.tolerance, exhausted));
        }
        // What is said of special points has more digits.
        let fine = SPECIAL * self.tolerance;
        let mut beyond = false;
        let mut specials = Vec::new();
        for special in &branch.specials {
            let Some(sample) = self.sample(curve, &special.point, fine, &mut beyond) else {
                continue;
            };
            specials.push(Special {
                kind: special.kind,
                after: special.after,
                sample,
                stability: Some(special.point.stability.clone()),
                precision: special.precision,
                located: special.located,
                change: special.change,
                note: special.note.clone(),
                touch: None,
            });
        }
        TracedBranch { samples, specials, ..TracedBranch::from(branch) }
    }

    /// The response of an orbit with as many harmonics as the tolerance asks for.
    fn sample(
        &self,
        curve: &mut Curve<'_, '_>,
        point: &Point,
        tolerance: f64,
        exhausted: &mut bool,
    ) -> Option<Sample> {
        let line = &self.setting.line;
        let base = curve.kind.base;
        let of = |highest: usize| {
            if curve.kind.mirrored { HarmonicSet::odd(highest) } else { HarmonicSet::all(highest) }
        };
        let least = LEAST_HARMONICS.max(self.setting.excited() * curve.kind.periods as usize);
        let mut known = None;
        for most in ORDERS {
            let set = of(most.max(least));
            let u = coefficients_of(line, base, &mut curve.shooter, &point.orbit, &set).ok()?;
            let tails = tails(line, &set, &u);
            let enough = tails.iter().position(|tail| *tail < tolerance);
            known = Some((set, u, tails, enough.unwrap_or(most)));
            if enough.is_some() {
                break;
            }
        }
        let (set, u, tails, enough) = known?;
        let highest = RUNGS.into_iter().find(|rung| *rung >= enough).unwrap_or(set.highest());
        let kept = of(highest.clamp(least, set.highest().max(least)));
        let truncation = tails.get(kept.highest()).copied().unwrap_or(0.0);
        *exhausted |= truncation > tolerance;
        Some(Sample {
            u: refit(&set, &kept, 1, &u),
            set: kept,
            p: point.p(),
            tangent: Vec::new(),
            tangent_p: point.tangent_p,
            metric: (point.size, 1.0),
            orientation: point.orientation,
            truncation,
        })
    }
}

/// What the orders above each order leave of the vibration at most, relative, for the node or the
/// nonlinear twist where it is most: moduli add up where a law bends.
fn tails(line: &Line, set: &HarmonicSet, u: &[f64]) -> Vec<f64> {
    let m = set.coefficients();
    let mut tails = vec![0.0_f64; set.highest() + 1];
    for node in u.chunks_exact(m) {
        add_tails(set, node, &mut tails);
    }
    let mut twist = vec![0.0; m];
    for connection in &line.twists {
        combine(connection, u, m, &mut twist);
        add_tails(set, &twist, &mut tails);
    }
    tails
}

/// Raises the tails to those of one series.
fn add_tails(set: &HarmonicSet, series: &[f64], tails: &mut [f64]) {
    let whole = length(&series[usize::from(!set.is_odd())..]);
    if whole == 0.0 {
        return;
    }
    // Orders beyond the highest: no slower than the third power, as where a damper begins to act.
    let mut sum = 0.5 * set.highest() as f64 * last(set, series);
    let mut above = tails.len();
    for (order, place) in set.places().collect::<Vec<_>>().into_iter().rev() {
        // The tail beyond `order`, and beyond those left out between it and the next.
        for tail in &mut tails[order..above] {
            *tail = tail.max(sum / whole);
        }
        above = order;
        if order > 0 {
            sum += series[place].hypot(series[place + 1]);
        }
    }
    for tail in &mut tails[..above] {
        *tail = tail.max(sum / whole);
    }
}

/// Mean modulus of the last orders of a series.
fn last(set: &HarmonicSet, series: &[f64]) -> f64 {
    let count = set.orders().len();
    let least = count.saturating_sub(LAST).max(1);
    let places = set.places().skip(least).map(|(_, place)| place);
    let sum: f64 = places.map(|place| series[place].hypot(series[place + 1])).sum();
    sum / LAST as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    // Source: sums by hand. Orders 1 to 30 of modulus 1/k⁴ leave beyond order 3 the sum of the rest,
    // and what is guessed of orders beyond 30 from the last sixteen: more than there is.
    #[test]
    fn tails_are_the_sums_beyond() {
        let set = HarmonicSet::all(30);
        let term = |k: i32| f64::from(k).powi(-4);
        let mut series = vec![7.0; set.coefficients()];
        for (order, place) in set.places().skip(1) {
            let size = (order as f64).powi(-4);
            (series[place], series[place + 1]) = (0.6 * size, -0.8 * size);
        }
        let mut tails = vec![0.0; 31];
        add_tails(&set, &series, &mut tails);
        let whole = (1..=30).map(|k| term(k).powi(2)).sum::<f64>().sqrt();
        let seen: f64 = (4..=30).map(term).sum();
        let guessed: f64 = 15.0 / 16.0 * (15..=30).map(term).sum::<f64>();
        assert!((tails[3] * whole - seen - guessed).abs() < 1e-15);
        let unseen: f64 = (31..10_000).map(term).sum();
        assert!(tails[30] * whole > unseen && tails[30] * whole < 20.0 * unseen);
    }
}
