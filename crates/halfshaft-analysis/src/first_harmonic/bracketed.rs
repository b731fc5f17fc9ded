//! All amplitudes under any law: the equation tried on certified cells.
//!
//! On a cell `U(a) = α_c a + β (F + i S)` lies in a disc about its value at the middle, and so does
//! its slope `V`. A cell whose disc keeps clear of `|U| = |γ|` has no root. One on which `Re(Ū V)`
//! keeps its sign has one root if the signs at its ends differ, and none if not. Any other is halved.

use halfshaft_numerics::Complex;

use super::problem::{Point, Problem};
use super::shaft_law::{Balanced, loss};
use super::sheets::{Cell, Sheets};

/// Cells are halved down to this part of their amplitude.
const NARROWEST: f64 = 1e-9;
/// Amplitudes above this many times the smallest possible one are not searched where nothing damps
/// the line.
const UNDAMPED_REACH: f64 = 1e5;

/// All responses found at a frequency.
#[derive(Clone, Debug, Default)]
pub(super) struct Bracketed {
    /// Amplitudes with what the shaft does there.
    pub(super) roots: Vec<(f64, Balanced)>,
    /// Places at which two responses are too close to be told apart, or from none.
    pub(super) open: usize,
}

/// Finds all responses at a frequency.
pub(super) fn all(problem: &Problem, sheets: &Sheets, point: &Point<Complex>) -> Bracketed {
    let mut found = Bracketed::default();
    let Some((least, most)) = bounds(problem, point) else { return found };
    let search = Search { problem, sheets, point, target: point.gamma.modulus() };
    sheets.each(least, most, |cell| {
        if search.may_hold(cell) {
            search.halve(cell, &mut found);
        }
    });
    found.roots.sort_by(|a, b| a.0.total_cmp(&b.0));
    found.roots.dedup_by(|b, a| {
        let close = |a: f64, b: f64, size: f64| (a - b).abs() <= 1e-11 * size;
        close(a.0, b.0, a.0) && close(a.1.mean, b.1.mean, a.0 + a.1.mean.abs())
    });
    found
}

/// Amplitudes between which all responses lie: below, inertia and the steepest part of the law
/// cannot balance the drive; above, damping takes more than it gives.
fn bounds(problem: &Problem, point: &Point<Complex>) -> Option<(f64, f64)> {
    let Point { nu, alpha, beta, gamma } = *point;
    let target = gamma.modulus();
    if target <= 0.0 || target.is_nan() {
        return None;
    }
    let law = &problem.law;
    let mut least = target / (alpha.modulus() + beta.modulus());
    for _ in 0..200 {
        // |F| ≤ max |T - T(m)| is below the steepest slope over the swing times the amplitude; the
        // slope is looked up about the means at rest and at this amplitude.
        let steepest = steepest(law, least);
        let contact = law.contact.as_ref().map_or(0.0, |(damping, _)| nu * damping * least);
        let friction = law.friction.map_or(0.0, |friction| loss(&friction, nu * least).torque);
        let loss = friction + contact;
        let reach = alpha.modulus() * least + beta.modulus() * (steepest * least + loss);
        if reach < target {
            break;
        }
        least *= 0.5;
    }
    // Im(D) with D = α_c/β.
    let drain = (alpha * beta.conjugate()).im / beta.modulus();
    let most = if drain > 0.0 { target / drain } else { f64::INFINITY };
    Some((least, (1.0001 * most).min(UNDAMPED_REACH * least).max(2.0 * least)))
}

/// Steepest tangent stiffness that swings of an amplitude may meet.
fn steepest(law: &super::shaft_law::ShaftLaw, amplitude: f64) -> f64 {
    let mut steepest = 0.0_f64;
    for mean in law.law.twists_at(law.statics.asked).into_iter().chain([0.0]) {
        for k in -16..=16 {
            let twist = mean + 2.0 * amplitude * f64::from(k) / 16.0;
            steepest = steepest.max(law.law.stiffness(twist).abs());
        }
    }
    for switch in law.law.switching_twists() {
        let beside = 1e-9 * switch.abs().max(1e-9);
        steepest = steepest.max(law.law.stiffness(switch + beside).abs());
        steepest = steepest.max(law.law.stiffness(switch - beside).abs());
    }
    2.0 * steepest
}

struct Search<'s> {
    problem: &'s Problem,
    sheets: &'s Sheets,
    point: &'s Point<Complex>,
    /// `|γ|`.
    target: f64,
}

/// `U` and `V` on a cell: values at the middle and radii.
struct Discs {
    whole: Complex,
    whole_radius: f64,
    slope: Complex,
    slope_radius: f64,
}

impl Search<'_> {
    fn discs(&self, cell: &Cell) -> Discs {
        let Point { nu, beta, .. } = *self.point;
        let law = &self.problem.law;
        let (whole, slope) = self.problem.whole_and_slope(self.point, cell.middle, &cell.at);
        let mut slope_radius = cell.slope_radius;
        if let Some((damping, _)) = &law.contact {
            slope_radius += nu * damping * cell.contact_radius;
        }
        if let Some(friction) = &law.friction {
            // The friction rises more and more slowly with the rate.
            let first = |a: f64| loss(friction, nu * a).first;
            let middle = first(cell.middle);
            let away = (first(cell.from) - middle).abs().max((first(cell.to) - middle).abs());
            slope_radius += nu * away;
        }
        let slope_radius = slope_radius * beta.modulus();
        let whole_radius = (slope.modulus() + slope_radius) * cell.radius();
        Discs { whole, whole_radius, slope, slope_radius }
    }

    fn may_hold(&self, cell: &Cell) -> bool {
        if let Some(friction) = &self.problem.law.friction {
            // Friction is at most 4/π of its torque; what that leaves out needs no closer look.
            let Point { alpha, beta, .. } = *self.point;
            let bare = (alpha.scaled(cell.middle) + beta.scaled(cell.at.force)).modulus();
            let steepest = cell.at.slope.abs() + cell.slope_radius;
            let slope = (alpha.modulus() + beta.modulus() * steepest) * cell.radius();
            let most = friction.torque_nm * (4.0 / std::f64::consts::PI) * beta.modulus();
            if self.problem.law.contact.is_none() && (bare - self.target).abs() > slope + most {
                return false;
            }
        }
        let discs = self.discs(cell);
        (discs.whole.modulus() - self.target).abs() <= discs.whole_radius * (1.0 + 1e-9)
    }

    fn halve(&self, cell: &Cell, found: &mut Bracketed) {
        let discs = self.discs(cell);
        if (discs.whole.modulus() - self.target).abs() > discs.whole_radius * (1.0 + 1e-9) {
            return;
        }
        let Discs { whole, whole_radius, slope, slope_radius } = discs;
        let along = whole.re * slope.re + whole.im * slope.im;
        let room = whole.modulus() * slope_radius
            + slope.modulus() * whole_radius
            + whole_radius * slope_radius;
        let narrow = cell.radius() <= NARROWEST * cell.middle;
        if along.abs() > room || narrow {
            let ends = [cell.from, cell.to].map(|a| self.excess(a, cell.at.mean));
            let [Some(low), Some(high)] = ends else { return };
            if (low < 0.0) != (high < 0.0) {
                found.roots.extend(self.close_in(cell, low < 0.0));
            } else if narrow && along.abs() <= room {
                found.open += 1;
            }
            return;
        }
        for (from, to) in [(cell.from, cell.middle), (cell.middle, cell.to)] {
            if let Some(part) = self.sheets.part(cell, from, to) {
                self.halve(&part, found);
            }
        }
    }

    /// `|U| - |γ|`.
    fn excess(&self, amplitude: f64, guess: f64) -> Option<f64> {
        let at = self.problem.law.balanced(amplitude, guess)?;
        Some(self.problem.whole(self.point, amplitude, &at).modulus() - self.target)
    }

    /// The root of a cell with different signs at its ends, to rounding.
    fn close_in(&self, cell: &Cell, rising: bool) -> Option<(f64, Balanced)> {
        let law = &self.problem.law;
        let (mut low, mut high) = (cell.from, cell.to);
        let mut amplitude = cell.middle;
        let mut at = law.balanced(amplitude, cell.at.mean)?;
        for _ in 0..80 {
            let (whole, slope) = self.problem.whole_and_slope(self.point, amplitude, &at);
            let value = whole.modulus() - self.target;
            if (value < 0.0) == rising {
                low = amplitude;
            } else {
                high = amplitude;
            }
            let along = (whole.re * slope.re + whole.im * slope.im) / whole.modulus();
            let newton = amplitude - value / along;
            let next =
                if newton > low && newton < high { newton } else { f64::midpoint(low, high) };
            let step = (next - amplitude).abs();
            let done = value == 0.0 || step <= 2.0 * f64::EPSILON * amplitude;
            if done {
                break;
            }
            amplitude = next;
            at = law.balanced(amplitude, at.mean)?;
        }
        Some((amplitude, at))
    }
}
