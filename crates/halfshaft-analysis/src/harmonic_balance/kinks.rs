//! Fourier coefficients of torques with kinks, integrated from kink to kink.
//!
//! Uniform samples see a kink to the square of their distance only, which spoils a response long before
//! its harmonics run out. Here the phases at which a twist passes from one piece of its law to another
//! are located first, and Gauss-Legendre quadrature does the smooth parts between them. The boundary
//! terms of the derivatives cancel, as torques are continuous: residual and Jacobian are those of
//! Galerkin's method, to rounding.

use halfshaft_dynamics::laws::{Friction, Piece, Pieces};
use halfshaft_numerics::Complex;
use halfshaft_numerics::harmonics::{HarmonicSet, Spectrum};

/// Points of the rule on each panel.
const POINTS: usize = 24;
/// Half of the phase that the fastest wave may turn through within a panel, rad: the rule is good to
/// rounding for that.
const TURN: f64 = 18.0;

/// What a torque depends on.
pub(super) struct Force<'f> {
    pub(super) set: &'f HarmonicSet,
    /// Coefficients of the twist.
    pub(super) twist: &'f [f64],
    /// Coefficients of its rate, where friction acts.
    pub(super) rate: &'f [f64],
    pub(super) pieces: &'f Pieces,
    pub(super) friction: Option<&'f Friction>,
}

/// Spectra of torque, tangent stiffness and slope of the friction.
#[derive(Clone, Debug, Default)]
pub(super) struct Spectra {
    pub(super) torque: Spectrum,
    pub(super) slope: Spectrum,
    pub(super) rate_slope: Spectrum,
}

/// Integrates torques from kink to kink; keeps its store.
#[derive(Clone, Debug, Default)]
pub(super) struct KinkTransform {
    rule: Vec<(f64, f64)>,
    /// Cosines and sines of all orders at one phase.
    cosines: Vec<f64>,
    sines: Vec<f64>,
    /// Sums by order: real and imaginary parts.
    torque: Sums,
    slope: Sums,
    rate_slope: Sums,
}

#[derive(Clone, Debug, Default)]
struct Sums {
    real: Vec<f64>,
    imaginary: Vec<f64>,
}

impl Sums {
    fn clear(&mut self, orders: usize) {
        for list in [&mut self.real, &mut self.imaginary] {
            list.clear();
            list.resize(orders, 0.0);
        }
    }

    /// Adds `value · exp(-i k θ)`.
    fn add(&mut self, value: f64, cosines: &[f64], sines: &[f64]) {
        self.real.iter_mut().zip(cosines).for_each(|(sum, c)| *sum += value * c);
        self.imaginary.iter_mut().zip(sines).for_each(|(sum, s)| *sum -= value * s);
    }

    fn store(&self, out: &mut Spectrum) {
        let scale = 1.0 / std::f64::consts::TAU;
        let pairs = self.real.iter().zip(&self.imaginary);
        out.replace(pairs.map(|(re, im)| Complex::new(scale * re, scale * im)));
    }
}

impl KinkTransform {
    /// Spectra of a torque whose twist passes from piece to piece at the given phases, ascending
    /// within `[0, 2π)`; up to twice the highest order of the set.
    pub(super) fn transform(&mut self, force: &Force<'_>, phases: &[f64], out: &mut Spectra) {
        if self.rule.is_empty() {
            self.rule = gauss_legendre(POINTS);
        }
        let orders = 2 * force.set.highest() + 1;
        self.torque.clear(orders);
        self.slope.clear(orders);
        self.rate_slope.clear(orders);
        for (at, from) in phases.iter().enumerate() {
            let to = phases.get(at + 1).copied().unwrap_or(phases[0] + std::f64::consts::TAU);
            self.part(force, *from, to);
        }
        self.torque.store(&mut out.torque);
        self.slope.store(&mut out.slope);
        self.rate_slope.store(&mut out.rate_slope);
    }

    /// Adds a smooth part.
    fn part(&mut self, force: &Force<'_>, from: f64, to: f64) {
        let middle = force.set.evaluate(force.twist, f64::midpoint(from, to)).0;
        let piece = at(force.pieces, middle);
        let degree = piece.torque.degree().max(1) + if force.friction.is_some() { 4 } else { 0 };
        let fastest = ((degree + 2) * force.set.highest()) as f64;
        let panels = (0.5 * (to - from) * fastest / TURN).ceil().max(1.0);
        let width = (to - from) / panels;
        let mut start = from;
        let mut done = 0.0;
        while done < panels {
            for index in 0..self.rule.len() {
                let (node, weight) = self.rule[index];
                let theta = start + width * node;
                self.point(force, piece, theta, width * weight);
            }
            done += 1.0;
            start = from + width * done;
        }
    }

    fn point(&mut self, force: &Force<'_>, piece: &Piece, theta: f64, weight: f64) {
        let orders = self.torque.real.len();
        waves(theta, orders, &mut self.cosines, &mut self.sines);
        let x = series(force.set, force.twist, &self.cosines, &self.sines);
        let (mut torque, slope) = piece.torque.evaluate_with_slope(x - piece.origin);
        if let Some(friction) = force.friction {
            let v = series(force.set, force.rate, &self.cosines, &self.sines);
            torque += friction.torque(v);
            self.rate_slope.add(weight * friction.slope(v), &self.cosines, &self.sines);
        }
        self.torque.add(weight * torque, &self.cosines, &self.sines);
        if slope != 0.0 {
            self.slope.add(weight * slope, &self.cosines, &self.sines);
        }
    }
}

fn at(pieces: &Pieces, x: f64) -> &Piece {
    let list = pieces.list();
    &list[list.partition_point(|piece| piece.to < x).min(list.len() - 1)]
}

/// Cosines and sines of `0 .. orders` times a phase.
fn waves(theta: f64, orders: usize, cosines: &mut Vec<f64>, sines: &mut Vec<f64>) {
    let (sin, cos) = theta.sin_cos();
    cosines.clear();
    sines.clear();
    let (mut c, mut s) = (1.0, 0.0);
    for _ in 0..orders {
        cosines.push(c);
        sines.push(s);
        (c, s) = (c * cos - s * sin, s * cos + c * sin);
    }
}

fn series(set: &HarmonicSet, coefficients: &[f64], cosines: &[f64], sines: &[f64]) -> f64 {
    let term = |(order, place): (usize, usize)| {
        if order == 0 {
            coefficients[place]
        } else {
            coefficients[place] * cosines[order] + coefficients[place + 1] * sines[order]
        }
    };
    set.places().map(term).sum()
}

/// Nodes and weights on `[0, 1]` by Newton's method on the Legendre polynomial.
fn gauss_legendre(points: usize) -> Vec<(f64, f64)> {
    let n = points as f64;
    let legendre = |x: f64| {
        let (mut before, mut here) = (1.0, x);
        for k in 2..=points {
            let k = k as f64;
            (before, here) = (here, ((2.0 * k - 1.0) * x * here - (k - 1.0) * before) / k);
        }
        (here, n * (x * here - before) / (x * x - 1.0))
    };
    let rule = (0..points).map(|index| {
        let mut x = (std::f64::consts::PI * (index as f64 + 0.75) / (n + 0.5)).cos();
        for _ in 0..20 {
            let (value, slope) = legendre(x);
            x -= value / slope;
        }
        let slope = legendre(x).1;
        (0.5 * (1.0 + x), 1.0 / ((1.0 - x * x) * slope * slope))
    });
    rule.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    // Source: exact for powers up to twice the number of points less one; integrals by hand.
    #[test]
    fn the_rule_is_that_of_gauss() {
        let rule = gauss_legendre(POINTS);
        for power in [0, 1, 5, 30, 47] {
            let sum: f64 = rule.iter().map(|(x, w)| w * x.powi(power)).sum();
            assert!((sum * f64::from(power + 1) - 1.0).abs() < 1e-13, "{power}: {sum}");
        }
    }

    // Source: the half-wave rectified cosine has mean 1/π, first harmonic 1/2, even harmonics
    // 2 (-1)^(n/2+1) / (π (n² - 1)) and no odd ones; its stiffness is a square wave.
    #[test]
    fn a_rectified_cosine_has_its_known_series() {
        use std::f64::consts::{FRAC_PI_2, PI};
        let law = halfshaft_dynamics::laws::TorqueLaw::OneSided(
            halfshaft_dynamics::laws::OneSidedContact::new(
                0.0,
                &halfshaft_dynamics::laws::PolynomialLaw::new([
                    0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
                ]),
                0.0,
            ),
        );
        let set = HarmonicSet::all(6);
        let mut twist = vec![0.0; set.coefficients()];
        twist[1] = 1.0;
        let pieces = law.pieces();
        let rate = vec![0.0; twist.len()];
        let force =
            Force { set: &set, twist: &twist, rate: &rate, pieces: &pieces, friction: None };
        let mut spectra = Spectra::default();
        KinkTransform::default().transform(&force, &[FRAC_PI_2, 3.0 * FRAC_PI_2], &mut spectra);
        let mut f = vec![0.0; set.coefficients()];
        spectra.torque.coefficients(&set, &mut f);
        assert!((f[0] - 1.0 / PI).abs() < 1e-15);
        assert!((f[1] - 0.5).abs() < 1e-15);
        for (order, place) in set.places().filter(|(order, _)| *order > 1) {
            let n = order as f64;
            let sign = if (order / 2) % 2 == 1 { 1.0 } else { -1.0 };
            let exact = if order % 2 == 1 { 0.0 } else { sign * 2.0 / (PI * (n * n - 1.0)) };
            assert!((f[place] - exact).abs() < 1e-15 && f[place + 1].abs() < 1e-15, "{order}");
        }
        assert!((spectra.slope.cosine(0) - 0.5).abs() < 1e-15);
        assert!((spectra.slope.cosine(11) + 1.0 / (11.0 * PI)).abs() < 1e-14);
    }
}
