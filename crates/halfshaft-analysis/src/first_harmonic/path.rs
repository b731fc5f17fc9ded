//! One step along a response curve in frequency and complex twist.
//!
//! The unknowns are `ν` and `X`; the equations the two parts of `(α_c + β (F + i S)/a) X = γ`. In
//! this form nothing is singular where the twist passes through zero (an antiresonance without
//! damping), and a fold is a point like any other. Lengths are measured by the width of the range for
//! `ν` and by `|X|` itself for `X`, so that a resonance takes as many steps however sharp it is.

use halfshaft_numerics::Complex;

use super::jet::Jet;
use super::problem::{Point, Problem};
use super::shaft_law::Balanced;

/// A point of the curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    pub(super) nu: f64,
    pub(super) twist: Complex,
    pub(super) at: Balanced,
}

/// Scaled direction `(dν/W, dX/|X|)` of length one.
pub(super) type Direction = [f64; 3];

/// The curve of a problem with its scales.
pub(super) struct Path<'p> {
    pub(super) problem: &'p Problem,
    /// Length of one unit in `ν`, rad/s.
    pub(super) width: f64,
    /// Twists below this are measured by it, rad.
    pub(super) least: f64,
}

/// The equations at a place, scaled, with their derivatives.
struct Equations {
    values: [f64; 2],
    rows: [[f64; 3]; 2],
}

/// What a corrector found.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corrected {
    pub(super) place: Place,
    pub(super) direction: Direction,
    /// Sense of the direction against that which the equations give by themselves: the same all
    /// along a branch, and another where a step has hopped over a saddle to a branch close by.
    pub(super) forward: bool,
    pub(super) iterations: usize,
    /// Scaled distance from the predicted place.
    pub(super) moved: f64,
}

/// Most Newton steps of a corrector.
const STEPS: usize = 8;

impl Path<'_> {
    fn size(&self, twist: Complex) -> f64 {
        twist.modulus().max(self.least)
    }

    /// The equations at `ν`, `X`; the mean near a guess.
    fn equations(&self, nu: f64, twist: Complex, guess: f64) -> Option<(Equations, Balanced)> {
        self.equations_at(&self.problem.jet(nu)?, twist, guess)
    }

    fn equations_at(
        &self,
        point: &Point<Jet>,
        twist: Complex,
        guess: f64,
    ) -> Option<(Equations, Balanced)> {
        let amplitude = twist.modulus().max(1e-9 * self.least);
        let at = self.problem.law.balanced(amplitude, guess)?;
        Some((self.filled(point, twist, amplitude, &at), at))
    }

    fn filled(&self, point: &Point<Jet>, twist: Complex, a: f64, at: &Balanced) -> Equations {
        let Point { nu, alpha, beta, gamma } = *point;
        let resistance = self.problem.law.resistance(nu, a, at);
        let gain = Complex::new(at.force / a, resistance.torque / a);
        let whole = alpha.value + beta.value * gain;
        let slopes = Complex::new(at.slope, resistance.by_a);
        let bend = beta.value * (slopes - gain).scaled(1.0 / a);
        let value = whole * twist - gamma.value;
        let by_nu = (alpha.first
            + beta.first * gain
            + beta.value * Complex::new(0.0, resistance.by_nu / a))
            * twist
            - gamma.first;
        // a moves by Re(conj(X) dX)/a.
        let by_re = whole + (bend * twist).scaled(twist.re / a);
        let by_im = Complex::new(-whole.im, whole.re) + (bend * twist).scaled(twist.im / a);
        let scale = self.size(twist);
        let row = 1.0 / (gamma.value.modulus() + whole.modulus() * scale).max(f64::MIN_POSITIVE);
        let columns = [by_nu.scaled(self.width), by_re.scaled(scale), by_im.scaled(scale)];
        Equations {
            values: [value.re * row, value.im * row],
            rows: [columns.map(|c| c.re * row), columns.map(|c| c.im * row)],
        }
    }

    /// Direction of the curve at a place, turned to go along `towards`, and its sense.
    pub(super) fn direction(
        &self,
        place: &Place,
        towards: &Direction,
    ) -> Option<(Direction, bool)> {
        let (equations, _) = self.equations(place.nu, place.twist, place.at.mean)?;
        tangent(&equations.rows, towards)
    }

    /// The place at a scaled distance along a direction.
    pub(super) fn ahead(&self, place: &Place, direction: &Direction, length: f64) -> Place {
        let scale = length * self.size(place.twist);
        let [nu, re, im] = *direction;
        Place {
            nu: place.nu + length * self.width * nu,
            twist: place.twist + Complex::new(scale * re, scale * im),
            at: place.at,
        }
    }

    /// Brings a predicted place back onto the curve, across the direction.
    pub(super) fn correct(&self, predicted: &Place, direction: &Direction) -> Option<Corrected> {
        self.newton(predicted, direction)
    }

    /// The place of the curve at a given frequency near a guess.
    pub(super) fn at_frequency(&self, guess: &Place, nu: f64) -> Option<Corrected> {
        self.newton(&Place { nu, ..*guess }, &[1.0, 0.0, 0.0])
    }

    fn newton(&self, start: &Place, fixed: &Direction) -> Option<Corrected> {
        let mut place = *start;
        let mut last = f64::INFINITY;
        let mut moved = [0.0; 3];
        // At a fixed frequency the rest of the line is asked once.
        let stays = fixed[1] == 0.0 && fixed[2] == 0.0;
        let mut point = self.problem.jet(place.nu)?;
        for iterations in 0..STEPS {
            if iterations > 0 && !stays {
                point = self.problem.jet(place.nu)?;
            }
            let (equations, at) = self.equations_at(&point, place.twist, place.at.mean)?;
            place.at = at;
            let [a, b] = equations.rows;
            let step =
                solve_three(&[a, b, *fixed], &[-equations.values[0], -equations.values[1], 0.0])?;
            let length = norm(&step);
            if !length.is_finite() || (iterations > 1 && length > 0.7 * last && length > 1e-11) {
                return None;
            }
            let scale = self.size(place.twist);
            if !stays {
                place.nu += self.width * step[0];
            }
            place.twist = place.twist + Complex::new(scale * step[1], scale * step[2]);
            moved = [moved[0] + step[0], moved[1] + step[1], moved[2] + step[2]];
            if length <= 1e-13 || (iterations > 0 && length <= 1e-11 && length > 0.2 * last) {
                return self.settled(place, fixed, iterations + 1, norm(&moved));
            }
            last = length;
        }
        (last <= 1e-10).then(|| self.settled(place, fixed, STEPS, norm(&moved))).flatten()
    }

    fn settled(
        &self,
        mut place: Place,
        towards: &Direction,
        iterations: usize,
        moved: f64,
    ) -> Option<Corrected> {
        let (equations, at) = self.equations(place.nu, place.twist, place.at.mean)?;
        place.at = at;
        let (direction, forward) = tangent(&equations.rows, towards)?;
        Some(Corrected { place, direction, forward, iterations, moved })
    }

    /// Scaled vector from one place to another, by the size of the first.
    pub(super) fn between(&self, from: &Place, to: &Place) -> [f64; 3] {
        let gap = (to.twist - from.twist).scaled(1.0 / self.size(from.twist));
        [(to.nu - from.nu) / self.width, gap.re, gap.im]
    }
}

/// Vector of length one that both rows send to zero, turned to go along `towards`, and whether it
/// is their cross product rather than the opposite.
pub(super) fn tangent([a, b]: &[[f64; 3]; 2], towards: &Direction) -> Option<(Direction, bool)> {
    let cross = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    let along = dot(&cross, towards);
    let length = norm(&cross).copysign(along);
    let direction = cross.map(|c| c / length);
    direction.iter().all(|c| c.is_finite()).then_some((direction, along > 0.0))
}

pub(super) fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

pub(super) fn norm(a: &[f64; 3]) -> f64 {
    dot(a, a).sqrt()
}

/// Three linear equations by Cramer's rule on scaled rows.
pub(super) fn solve_three(rows: &[[f64; 3]; 3], right: &[f64; 3]) -> Option<[f64; 3]> {
    let det = |m: &[[f64; 3]; 3]| {
        m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1])
            - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
            + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0])
    };
    let whole = det(rows);
    let mut out = [0.0; 3];
    for (column, out) in out.iter_mut().enumerate() {
        let mut replaced = *rows;
        for (row, value) in replaced.iter_mut().zip(right) {
            row[column] = *value;
        }
        *out = det(&replaced) / whole;
    }
    out.iter().all(|x| x.is_finite()).then_some(out)
}
