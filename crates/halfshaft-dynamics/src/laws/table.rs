//! A measured law: a curve through points of twist and torque that keeps their shape.
//!
//! Between neighbours a cubic with given slopes at the points. The slopes are those of Fritsch and
//! Butland (SIAM J. Sci. Stat. Comput. 5, 1984): the weighted harmonic mean of the chords on both
//! sides, zero where these differ in sign. So the curve rises where the points rise, has its highest
//! and lowest torques at points, and its tangent stiffness is continuous. Beyond the first and
//! the last point the curve goes on straight with the slope that it has there.

use super::describing::DescribingFunction;

/// One stretch of the curve: `T = c0 + c1 d + c2 d² + c3 d³`, `d = x - origin`.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Stretch {
    origin: f64,
    coefficients: [f64; 4],
    /// Energy at the origin above zero twist, J.
    energy: f64,
}

/// A curve through measured points.
#[derive(Clone, Debug, PartialEq)]
pub struct TableLaw {
    /// Twists of the points, ascending.
    twists: Vec<f64>,
    /// Before the first point, between neighbours, beyond the last: one more than points.
    stretches: Vec<Stretch>,
    is_odd: bool,
}

impl TableLaw {
    /// The law through `points` of twist (rad, ascending) and torque (N·m), with `preload` (N·m)
    /// added; points that do not ascend are skipped. `None` for fewer than two points.
    pub fn new(points: &[(f64, f64)], preload: f64) -> Option<Self> {
        let mut kept: Vec<(f64, f64)> = Vec::with_capacity(points.len());
        for (twist, torque) in points {
            if kept.last().is_none_or(|(last, _)| twist > last) {
                kept.push((*twist, torque + preload));
            }
        }
        let ((first, first_torque), (last, last_torque)) = match kept.as_slice() {
            [first, .., last] => (*first, *last),
            _ => return None,
        };
        let slopes = slopes(&kept);
        let mut stretches = Vec::with_capacity(kept.len() + 1);
        stretches.push(Stretch::straight(first, first_torque, slopes[0]));
        for (pair, ends) in kept.windows(2).zip(slopes.windows(2)) {
            stretches.push(Stretch::between(pair[0], pair[1], ends[0], ends[1]));
        }
        stretches.push(Stretch::straight(last, last_torque, slopes[slopes.len() - 1]));
        let mirrored = kept.iter().zip(kept.iter().rev());
        let is_odd = mirrored.into_iter().all(|((x, t), (y, u))| *x == -*y && *t == -*u);
        let twists = kept.iter().map(|(twist, _)| *twist).collect();
        let mut law = Self { twists, stretches, is_odd };
        law.level_energy();
        Some(law)
    }

    /// Makes the energy continuous, and zero at zero twist.
    fn level_energy(&mut self) {
        // The first two stretches begin at the first point.
        let mut energy = 0.0;
        for index in 1..self.stretches.len() {
            self.stretches[index].energy = energy;
            if let Some(next) = self.twists.get(index) {
                energy = self.stretches[index].energy(*next);
            }
        }
        let zero = self.energy(0.0);
        self.stretches.iter_mut().for_each(|stretch| stretch.energy -= zero);
    }

    /// Twists of the points, ascending, rad.
    pub fn points(&self) -> &[f64] {
        &self.twists
    }

    #[inline]
    fn at(&self, x: f64) -> &Stretch {
        &self.stretches[self.twists.partition_point(|twist| *twist < x)]
    }

    /// Torque at twist `x`, N·m.
    #[inline]
    pub fn torque(&self, x: f64) -> f64 {
        let Stretch { origin, coefficients: [c0, c1, c2, c3], .. } = self.at(x);
        let d = x - origin;
        c0 + d * (c1 + d * (c2 + d * c3))
    }

    /// Tangent stiffness at twist `x`, N·m/rad.
    #[inline]
    pub fn stiffness(&self, x: f64) -> f64 {
        let Stretch { origin, coefficients: [_, c1, c2, c3], .. } = self.at(x);
        let d = x - origin;
        c1 + d * (2.0 * c2 + d * 3.0 * c3)
    }

    /// `d²T/dx²` at twist `x`, N·m/rad²; at a point that below it.
    #[inline]
    pub fn curvature(&self, x: f64) -> f64 {
        let Stretch { origin, coefficients: [.., c2, c3], .. } = self.at(x);
        2.0 * c2 + 6.0 * c3 * (x - origin)
    }

    /// Potential energy above zero twist, J.
    #[inline]
    pub fn energy(&self, x: f64) -> f64 {
        self.at(x).energy(x)
    }

    /// Whether the tangent stiffness is the same everywhere.
    pub fn is_linear(&self) -> bool {
        let slope = self.stretches[0].coefficients[1];
        let same = |stretch: &Stretch| {
            let [_, c1, c2, c3] = stretch.coefficients;
            c1 == slope && c2 == 0.0 && c3 == 0.0
        };
        self.stretches.iter().all(same)
    }

    /// Whether `T(-x) = -T(x)`.
    pub fn is_odd(&self) -> bool {
        self.is_odd
    }

    /// The describing function for an amplitude of zero or more, by quadrature from point to point,
    /// exact to rounding.
    pub fn describing_function(&self, mean: f64, amplitude: f64) -> DescribingFunction {
        let crosses = self.twists.iter().any(|twist| (twist - mean).abs() < amplitude);
        if !crosses {
            let Stretch { origin, coefficients, .. } = self.at(mean);
            let mut all = [0.0; super::PolynomialLaw::COUNT];
            all[..4].copy_from_slice(coefficients);
            return super::PolynomialLaw::new(all).describing_function(mean - origin, amplitude);
        }
        let law = |x| {
            let Stretch { origin, coefficients: [c0, c1, c2, c3], .. } = self.at(x);
            let d = x - origin;
            (c0 + d * (c1 + d * (c2 + d * c3)), c1 + d * (2.0 * c2 + d * 3.0 * c3))
        };
        DescribingFunction::by_parts(mean, amplitude, &self.twists, law)
    }

    /// Origin and coefficients of the stretches, ascending.
    pub(super) fn cubic_pieces(&self) -> impl Iterator<Item = (f64, [f64; 4])> + '_ {
        self.stretches.iter().map(|stretch| (stretch.origin, stretch.coefficients))
    }
}

impl Stretch {
    fn straight(origin: f64, torque: f64, slope: f64) -> Self {
        Self { origin, coefficients: [torque, slope, 0.0, 0.0], energy: 0.0 }
    }

    /// The cubic between two points with the given slopes there.
    fn between(from: (f64, f64), to: (f64, f64), slope: f64, next: f64) -> Self {
        let width = to.0 - from.0;
        let chord = (to.1 - from.1) / width;
        let quadratic = (3.0 * chord - 2.0 * slope - next) / width;
        let cubic = (slope + next - 2.0 * chord) / (width * width);
        Self { origin: from.0, coefficients: [from.1, slope, quadratic, cubic], energy: 0.0 }
    }

    #[inline]
    fn energy(&self, x: f64) -> f64 {
        let [c0, c1, c2, c3] = self.coefficients;
        let d = x - self.origin;
        self.energy + d * (c0 + d * (c1 / 2.0 + d * (c2 / 3.0 + d * c3 / 4.0)))
    }
}

/// Slopes at the points that keep the shape of the points.
fn slopes(points: &[(f64, f64)]) -> Vec<f64> {
    let widths: Vec<f64> = points.windows(2).map(|pair| pair[1].0 - pair[0].0).collect();
    let chords: Vec<f64> =
        points.windows(2).zip(&widths).map(|(pair, w)| (pair[1].1 - pair[0].1) / w).collect();
    let last = chords.len() - 1;
    if last == 0 {
        return vec![chords[0]; 2];
    }
    let mut slopes = Vec::with_capacity(points.len());
    slopes.push(end_slope(widths[0], widths[1], chords[0], chords[1]));
    for (w, s) in widths.windows(2).zip(chords.windows(2)) {
        slopes.push(inner_slope(w[0], w[1], s[0], s[1]));
    }
    slopes.push(end_slope(widths[last], widths[last - 1], chords[last], chords[last - 1]));
    slopes
}

/// The harmonic mean of two chords, weighted so that the nearer point counts more.
fn inner_slope(before: f64, after: f64, chord_before: f64, chord_after: f64) -> f64 {
    if chord_before * chord_after <= 0.0 {
        return 0.0;
    }
    if chord_before == chord_after {
        return chord_before;
    }
    let (a, b) = (2.0 * after + before, after + 2.0 * before);
    (a + b) / (a / chord_before + b / chord_after)
}

/// The slope at an end by the parabola through three points, bent no further than the shape of the
/// points allows.
fn end_slope(width: f64, next_width: f64, chord: f64, next_chord: f64) -> f64 {
    if chord == next_chord {
        return chord;
    }
    let total = width + next_width;
    let slope = chord + (chord - next_chord) * width / total;
    if slope * chord <= 0.0 {
        0.0
    } else if chord * next_chord < 0.0 && slope.abs() > 3.0 * chord.abs() {
        3.0 * chord
    } else {
        slope
    }
}
