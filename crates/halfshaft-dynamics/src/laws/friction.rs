//! Dry friction in parallel with a law, regularised.
//!
//! `T = F tanh(v / v0)` of the rate of twist `v`: within 0.5 % of the friction torque `F` from three
//! times the regularisation speed `v0` on. There is no true stick: a torque `τ < F` makes the
//! connection creep at `v0 artanh(τ / F)`, so sticking shows as creeping with less than about
//! `v0`.

use std::f64::consts::{FRAC_PI_2, PI};

use super::quadrature::for_points;

/// Regularised dry friction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Friction {
    /// Friction torque `F` when sliding, N·m.
    pub torque_nm: f64,
    /// Regularisation speed `v0`, rad/s, more than zero.
    pub speed_rad_s: f64,
}

/// Average effect of friction over a rate `V sin φ`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FrictionDescribingFunction {
    /// First-harmonic torque, in phase with the rate, over its amplitude: the equivalent viscous
    /// damping, N·m·s/rad.
    pub damping: f64,
    /// Derivative of it by the amplitude of the rate.
    pub by_amplitude: f64,
}

impl Friction {
    /// Torque at rate of twist `v` (rad/s), N·m.
    #[inline]
    pub fn torque(&self, v: f64) -> f64 {
        self.torque_nm * (v / self.speed_rad_s).tanh()
    }

    /// Derivative of the torque by the rate, N·m·s/rad.
    #[inline]
    pub fn slope(&self, v: f64) -> f64 {
        let part = (v / self.speed_rad_s).tanh();
        self.torque_nm / self.speed_rad_s * (1.0 - part) * (1.0 + part)
    }

    /// The equivalent damping for a rate of the given amplitude (rad/s), to rounding.
    ///
    /// Limits: `F / v0` for small amplitudes, `4 F / (π V)` for large ones.
    pub fn describing_function(&self, amplitude: f64) -> FrictionDescribingFunction {
        let reach = amplitude.abs() / self.speed_rad_s;
        let (mut damping, mut slope) = (0.0, 0.0);
        // By parts: the first harmonic over V is (4/π) ∫ T'(V sin φ) cos² φ dφ over a quarter turn,
        // and T'' = -2 T' tanh / v0.
        let mut add = |angle: f64, weight: f64| {
            let (sine, cosine) = angle.sin_cos();
            let part = (reach * sine).tanh();
            let tangent = weight * (1.0 - part) * (1.0 + part) * cosine * cosine;
            damping += tangent;
            slope -= 2.0 * tangent * part * sine;
        };
        let mut from = 0.0;
        for limit in PANELS {
            // The tangent has died out beyond the last limit.
            let to = if limit < reach { (limit / reach).asin() } else { FRAC_PI_2 };
            for_points(from, to, &mut add);
            from = to;
            if limit >= reach {
                break;
            }
        }
        let initial = self.torque_nm / self.speed_rad_s;
        FrictionDescribingFunction {
            damping: 4.0 / PI * initial * damping,
            by_amplitude: 4.0 / PI * initial * slope / self.speed_rad_s * amplitude.signum(),
        }
    }
}

/// Ends of the panels of quadrature, in regularisation speeds.
const PANELS: [f64; 6] = [1.0, 2.5, 5.0, 9.0, 14.0, 20.0];

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::{prop_assert, proptest};

    const FRICTION: Friction = Friction { torque_nm: 15.0, speed_rad_s: 0.02 };

    /// Midpoint rule over a whole turn: exact to rounding for enough points, as for any smooth
    /// periodic function.
    fn by_summation(amplitude: f64) -> f64 {
        let count = 200_000;
        let step = 2.0 * PI / f64::from(count);
        let sum: f64 = (0..count)
            .map(|i| (f64::from(i) + 0.5) * step)
            .map(|angle| FRICTION.torque(amplitude * angle.sin()) * angle.sin())
            .sum();
        sum * step / PI / amplitude
    }

    // Source: the integral by summation; 4 F / (π V) of ideal dry friction for large amplitudes.
    #[test]
    fn the_equivalent_damping_is_the_integral() {
        for amplitude in [1e-3, 0.01, 0.02, 0.05, 0.1, 0.3, 1.0, 5.0] {
            let found = FRICTION.describing_function(amplitude).damping;
            let exact = by_summation(amplitude);
            assert!((found / exact - 1.0).abs() < 1e-12, "{amplitude}: {found} {exact}");
        }
        let large = FRICTION.describing_function(1e3).damping;
        assert!((large / (4.0 * 15.0 / (PI * 1e3)) - 1.0).abs() < 1e-9);
    }

    proptest! {
        // Source: central differences.
        #[test]
        fn derivatives_agree_with_differences(v in -0.1..0.1_f64, amplitude in 1e-3..2.0_f64) {
            let h = 1e-6;
            let slope = (FRICTION.torque(v + h) - FRICTION.torque(v - h)) / (2.0 * h);
            prop_assert!((slope - FRICTION.slope(v)).abs() < 1e-5 * 750.0);
            let h = 1e-5 * amplitude;
            let at = |a| FRICTION.describing_function(a);
            let slope = (at(amplitude + h).damping - at(amplitude - h).damping) / (2.0 * h);
            let size = 750.0 / 0.02 + slope.abs();
            prop_assert!((slope - at(amplitude).by_amplitude).abs() < 1e-7 * size);
        }
    }
}
