//! How far the averages of a law can move over a box of mean and amplitude.
//!
//! Any law is polynomials joined end to end. Where the tangent stiffness `T'` is smooth,
//! `∂M_k/∂m = ⟨T'' cos^k⟩` and `∂M_k/∂a = ⟨T'' cos^(k+1)⟩` are bounded by the greatest `|T''|` within
//! reach of the swing. Where it jumps by `Δ` at a twist `b`, `M_k` holds `Δ ⟨H(cos φ - c) cos^k φ⟩`
//! with `c = (b - m)/a`, whose range over an interval of `c` is known exactly. For a law of one
//! polynomial the first derivatives are those at the centre, and the third derivative of the torque
//! bounds the rest. All bounds shrink with the box, so that halving ends.

use std::f64::consts::{FRAC_2_PI, PI};

use halfshaft_dynamics::TorqueLaw;
use halfshaft_numerics::polynomial::Polynomial;

use super::shaft_law::curvature_moments;

/// `⟨|cos|^k⟩` for `k` from 0 to 4.
const COSINES: [f64; 5] = [1.0, FRAC_2_PI, 0.5, 4.0 / (3.0 * PI), 3.0 / 8.0];

/// A stretch of the law.
#[derive(Clone, Debug)]
struct Stretch {
    from: f64,
    to: f64,
    origin: f64,
    /// `T''` over `x - origin`.
    curvature: Polynomial,
    /// The third derivative of the torque over `x - origin`.
    third: Polynomial,
}

/// A law as far as bounds need it.
#[derive(Clone, Debug)]
pub(super) struct LawBounds {
    stretches: Vec<Stretch>,
    /// Twist and height of each jump of the tangent stiffness.
    jumps: Vec<(f64, f64)>,
    /// Beyond this size of twist law and load keep their sense.
    pub(super) far: f64,
    /// Whether the torque, with what is in parallel, never falls.
    pub(super) rises: bool,
}

/// A box of mean and amplitude.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Region {
    pub(super) mean: f64,
    pub(super) mean_radius: f64,
    pub(super) amplitude: f64,
    pub(super) amplitude_radius: f64,
}

impl LawBounds {
    /// Bounds of a law with a stiffness `parallel` beside it that is asked for a torque.
    pub(super) fn new(law: &TorqueLaw, parallel: f64, asked: f64) -> Self {
        let pieces = law.pieces();
        let list = pieces.list();
        let stretches = list.iter().map(|piece| Stretch {
            from: piece.from,
            to: piece.to,
            origin: piece.origin,
            curvature: piece.torque.derivative().derivative(),
            third: piece.torque.derivative().derivative().derivative(),
        });
        let mut jumps = Vec::new();
        for pair in list.windows(2) {
            let twist = pair[1].from;
            let slope = |piece: &halfshaft_dynamics::laws::Piece| {
                piece.torque.evaluate_with_slope(twist - piece.origin).1
            };
            let jump = slope(&pair[1]) - slope(&pair[0]);
            if jump != 0.0 {
                jumps.push((twist, jump));
            }
        }
        let (mut far, mut rises) = (0.0_f64, true);
        for piece in list {
            // Torque and load with the parallel stiffness, over the distance from the origin.
            let beside = Polynomial::new([parallel * piece.origin - asked, parallel]);
            let whole = piece.torque.add(&beside);
            let slope = whole.derivative();
            let (from, to) = (piece.from - piece.origin, piece.to - piece.origin);
            let marks =
                whole.real_roots_in(from, to).into_iter().chain(slope.real_roots_in(from, to));
            let marks = marks.map(|root| root.value + piece.origin);
            let ends = [piece.from, piece.to].into_iter().filter(|end| end.is_finite());
            far = marks.chain(ends).map(f64::abs).fold(far, f64::max);
            rises &= never_falls(&slope, from, to);
        }
        Self { stretches: stretches.collect(), jumps, far, rises }
    }

    /// How far `M_0`, `M_1`, `M_2` over the region are from those at its centre.
    pub(super) fn moment_radii(&self, region: &Region) -> [f64; 3] {
        if let [only] = self.stretches.as_slice() {
            return of_polynomial(only, region);
        }
        let curvature = self.largest_curvature(region);
        let mut radii = [0.0; 3];
        for (k, radius) in radii.iter_mut().enumerate() {
            *radius = curvature
                * (COSINES[k] * region.mean_radius + COSINES[k + 1] * region.amplitude_radius);
        }
        for (twist, jump) in &self.jumps {
            let arcs = arc_radii(*twist, region);
            for (radius, arc) in radii.iter_mut().zip(arcs) {
                *radius += jump.abs() * arc;
            }
        }
        radii
    }

    /// Greatest `|T''|` in smooth parts within reach of the swings of the region.
    fn largest_curvature(&self, region: &Region) -> f64 {
        let (low, high) = region.reach();
        let within = self.stretches.iter().filter(|s| s.to >= low && s.from <= high);
        within.map(|stretch| stretch.bound(&stretch.curvature, (low, high))).fold(0.0, f64::max)
    }
}

impl Region {
    /// Least and greatest twist of its swings.
    fn reach(&self) -> (f64, f64) {
        let reach = self.mean_radius + self.amplitude + self.amplitude_radius;
        (self.mean - reach, self.mean + reach)
    }
}

impl Stretch {
    /// A bound on the size of a polynomial over what lies of an interval in the stretch.
    fn bound(&self, polynomial: &Polynomial, (low, high): (f64, f64)) -> f64 {
        let from = (low.max(self.from) - self.origin).abs();
        let size = from.max((high.min(self.to) - self.origin).abs());
        let terms = polynomial.coefficients().iter().rev();
        terms.fold(0.0, |sum, c| sum * size + c.abs())
    }
}

/// Radii of the moments of a law of one polynomial: linear terms at the centre, then the bound.
fn of_polynomial(stretch: &Stretch, region: &Region) -> [f64; 3] {
    let (m, a) = (region.mean_radius, region.amplitude_radius);
    let third = stretch.bound(&stretch.third, region.reach());
    let first =
        curvature_moments(&stretch.curvature, region.mean - stretch.origin, region.amplitude);
    let mut radii = [0.0; 3];
    for (k, radius) in radii.iter_mut().enumerate() {
        let square = COSINES[k] * m * m + 2.0 * COSINES[k + 1] * m * a + COSINES[k + 2] * a * a;
        *radius = first[k].abs() * m + first[k + 1].abs() * a + 0.5 * third * square;
    }
    radii
}

/// Whether a slope is nowhere below zero on an interval.
fn never_falls(slope: &Polynomial, from: f64, to: f64) -> bool {
    let mut marks: Vec<f64> = slope.real_roots_in(from, to).iter().map(|root| root.value).collect();
    marks.sort_by(f64::total_cmp);
    let start =
        if from.is_finite() { from } else { marks.first().map_or(0.0, |m| m - 1.0).min(to) };
    let end = if to.is_finite() { to } else { marks.last().map_or(0.0, |m| m + 1.0).max(start) };
    let mut all = vec![start.min(end)];
    all.extend(marks);
    all.push(end.max(start));
    let scale = slope.coefficients().iter().map(|c| c.abs()).fold(0.0, f64::max);
    all.windows(2).all(|pair| slope.evaluate(f64::midpoint(pair[0], pair[1])) >= -1e-12 * scale)
}

/// `⟨H(cos φ - c) cos^k φ⟩` for `k` = 0, 1, 2.
fn arcs(c: f64) -> [f64; 3] {
    let c = c.clamp(-1.0, 1.0);
    let angle = c.acos();
    let sine = ((1.0 - c) * (1.0 + c)).sqrt();
    [angle / PI, sine / PI, (angle + c * sine) / (2.0 * PI)]
}

/// Distance of the arcs over the region from those at its centre.
fn arc_radii(twist: f64, region: &Region) -> [f64; 3] {
    let centre = (twist - region.mean) / region.amplitude;
    let least = region.amplitude - region.amplitude_radius;
    let most = region.amplitude + region.amplitude_radius;
    let (low, high) =
        (twist - region.mean - region.mean_radius, twist - region.mean + region.mean_radius);
    let lowest = if low >= 0.0 { low / most } else { low / least };
    let highest = if high >= 0.0 { high / least } else { high / most };
    if lowest >= 1.0 || highest <= -1.0 {
        return [0.0; 3];
    }
    let (at, first, last) = (arcs(centre), arcs(lowest), arcs(highest));
    let mut radii = [0.0; 3];
    for (k, radius) in radii.iter_mut().enumerate() {
        *radius = (first[k] - at[k]).abs().max((last[k] - at[k]).abs());
    }
    // The middle one has its greatest value at c = 0.
    if lowest < 0.0 && highest > 0.0 {
        radii[1] = radii[1].max(1.0 / PI - at[1]);
    }
    radii
}

#[cfg(test)]
mod tests {
    use super::*;
    use halfshaft_dynamics::laws::{
        ClearanceLaw, PiecewiseLinearLaw, PolynomialLaw, Stage, TableLaw,
    };
    use proptest::prelude::{prop_assert, proptest};

    fn laws() -> Vec<TorqueLaw> {
        let cubic = PolynomialLaw::new([0.0, 10.0, 3.0, -2.0, 0.0, 0.5, 0.0, 0.1]);
        let contact = PolynomialLaw::new([0.0, 50.0, 0.0, 20.0, 0.0, 0.0, 0.0, 0.0]);
        let stage = |until, stiffness| Stage { until, stiffness };
        let stages = [stage(0.4, 5.0), stage(1.1, 30.0), stage(f64::INFINITY, 12.0)];
        let table = [(-1.0, -20.0), (-0.3, -4.0), (0.2, 1.0), (0.9, 15.0), (1.4, 40.0)];
        vec![
            TorqueLaw::Polynomial(cubic),
            TorqueLaw::Clearance(ClearanceLaw::new(0.6, &contact, 0.0)),
            TorqueLaw::PiecewiseLinear(PiecewiseLinearLaw::new(&stages, &stages[1..], 0.5)),
            TorqueLaw::Table(TableLaw::new(&table, 0.0).expect("ascending points")),
        ]
    }

    fn moments(law: &TorqueLaw, mean: f64, amplitude: f64) -> [f64; 3] {
        let of = law.describing_function(mean, amplitude);
        let last = 0.5 * (of.gain + amplitude * of.gain_by_amplitude);
        [of.mean_by_mean, of.mean_by_amplitude, last]
    }

    proptest! {
        // Source: the averages themselves at random points of random regions.
        #[test]
        fn bounds_hold_over_the_region(
            which in 0..4_usize, mean in -1.5..1.5_f64, amplitude in 0.05..2.0_f64,
            wide in 0.0..0.3_f64, share in 0.0..0.9_f64, at in -1.0..1.0_f64, there in -1.0..1.0_f64,
        ) {
            let law = &laws()[which];
            let bounds = LawBounds::new(law, 0.0, 0.0);
            let region = Region {
                mean, mean_radius: wide, amplitude, amplitude_radius: share * amplitude,
            };
            let centre = moments(law, mean, amplitude);
            let here = moments(law, mean + at * wide, amplitude + there * share * amplitude);
            for ((c, h), radius) in centre.iter().zip(here).zip(bounds.moment_radii(&region)) {
                prop_assert!((c - h).abs() <= radius + 1e-9, "{c} {h} {radius}");
            }
        }
    }
}
