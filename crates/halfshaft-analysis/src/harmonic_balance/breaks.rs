//! Torques that bend or jump where a twist passes a break of its law: what uniform samples miss there.
//!
//! For samples `h` apart, the first of them `a h` behind a break at which `f` jumps by `J` and its slope
//! by `J'`, the sum of the samples falls short of the integral by
//!
//! ```text
//! ∫ f - h Σ f = h B₁(a) J + h²/2 B₂(a) J' + O(h³),   B₁ = a - 1/2,   B₂ = a² - a + 1/6
//! ```
//!
//! (the formula of Euler and Maclaurin from the break on, DLMF 24.17).

use halfshaft_dynamics::Connection;
use halfshaft_numerics::Complex;
use halfshaft_numerics::harmonics::HarmonicSet;

/// A passage of a break.
#[derive(Clone, Copy, Debug)]
pub(super) struct Break {
    theta: f64,
    /// Torque before and behind it, N·m.
    pub(super) torque: [f64; 2],
    /// Slope of the torque by the phase before and behind it, N·m.
    slope: [f64; 2],
}

/// How far to both sides of a break its law is looked at, relative.
const BESIDE: f64 = 1e-9;

/// The passages of a connection's torque along a motion at the given phases.
pub(super) fn breaks(
    connection: &Connection,
    set: &HarmonicSet,
    (twist, rate): (&[f64], &[f64]),
    phases: &[f64],
) -> Vec<Break> {
    let levels = connection.law.pieces();
    let levels: Vec<f64> = levels.list().iter().skip(1).map(|piece| piece.from).collect();
    let at = |theta: f64| {
        let ((x, bend), (v, turn)) = (set.evaluate(twist, theta), set.evaluate(rate, theta));
        let level = levels.iter().copied().min_by(|a, b| (a - x).abs().total_cmp(&(b - x).abs()));
        let level = level.unwrap_or(x);
        let beside = BESIDE * level.abs().max(1e-6) * bend.signum();
        let side = |x: f64| {
            let torque = connection.law.torque(level) + connection.resistance(x, v);
            let slope =
                connection.law.stiffness(x) * bend + connection.resistance_slope(x, v) * turn;
            (torque, slope)
        };
        let (before, behind) = (side(level - beside), side(level + beside));
        Break { theta, torque: [before.0, behind.0], slope: [before.1, behind.1] }
    };
    phases.iter().map(|theta| at(*theta)).collect()
}

impl Break {
    /// What the sum of samples `spacing` apart, times the spacing, misses of the integral of the torque
    /// times `exp(-i order θ)`.
    pub(super) fn missed(&self, spacing: f64, order: f64) -> Complex {
        let part = (self.theta / spacing).fract();
        let a = 1.0 - part;
        let jump = self.torque[1] - self.torque[0];
        let bend = self.slope[1] - self.slope[0];
        let wave = Complex::from_polar(1.0, -order * self.theta);
        let slope = Complex::new(bend, -order * jump);
        let first = Complex::from(spacing * (a - 0.5) * jump);
        let second = slope.scaled(0.5 * spacing * spacing * (a * a - a + 1.0 / 6.0));
        wave * (first + second)
    }
}

#[cfg(test)]
mod tests {
    use halfshaft_dynamics::laws::{OneSidedContact, PolynomialLaw, TorqueLaw};

    use super::*;

    // Source: integrals by hand. A stop at 0 along x = sin(θ - b), with v = cos(θ - b) over the phase:
    // the torque k x + c v in contact has the integral 2 k and ∫ f e^(-iθ) = (c - i k) π/2 e^(-ib).
    #[test]
    fn sums_with_what_they_miss_are_the_integrals() {
        const SHIFT: f64 = 0.3;
        let (k, c) = (3.0, 2.0);
        let law = PolynomialLaw::new([0.0, k, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        let connection = Connection {
            name: "stop".to_owned(),
            from: Some((0, 1.0)),
            to: None,
            law: TorqueLaw::OneSided(OneSidedContact::new(0.0, &law, 0.0)),
            damping: c,
            damps_in_gap: false,
            friction: None,
            engagement: None,
            loss_factor: 0.0,
            inertance: 0.0,
        };
        let set = HarmonicSet::all(1);
        let (sin, cos) = f64::sin_cos(SHIFT);
        let (twist, rate) = ([0.0, -sin, cos], [0.0, cos, sin]);
        let phases = [SHIFT, SHIFT + std::f64::consts::PI];
        let list = breaks(&connection, &set, (&twist, &rate), &phases);
        let mut errors = Vec::new();
        for count in [64, 128] {
            let h = std::f64::consts::TAU / f64::from(count);
            let of = |order: f64| {
                let mut sum = Complex::default();
                for at in 0..count {
                    let theta = h * f64::from(at);
                    let (x, v) = (theta - SHIFT).sin_cos();
                    let torque = if x > 0.0 { k * x + c * v } else { 0.0 };
                    sum = sum + Complex::from_polar(h * torque, -order * theta);
                }
                list.iter().fold(sum, |sum, one| sum + one.missed(h, order))
            };
            let mean = (of(0.0) - Complex::from(2.0 * k)).modulus();
            let exact = Complex::new(c, -k).scaled(std::f64::consts::FRAC_PI_2);
            let first = (of(1.0) - exact * Complex::from_polar(1.0, -SHIFT)).modulus();
            errors.push(mean.max(first));
        }
        assert!(errors[0] < 1e-3 && errors[1] < 0.25 * errors[0], "{errors:?}");
    }
}
