//! Clearance (backlash): no torque inside a gap, a polynomial of the penetration outside.
//!
//! With `h` half of the total clearance and `p = |x| - h` the penetration,
//! `T = preload + sign(x) (k1 p + k2 p² + k3 p³ + ...)` for `p > 0`, else the preload alone. The law
//! is mirrored: both flanks are alike whatever the powers. A mean torque moves the working point
//! onto a flank by itself.

use super::describing::DescribingFunction;
use super::polynomial::PolynomialLaw;

/// A gap with elastic flanks.
#[derive(Clone, Debug, PartialEq)]
pub struct ClearanceLaw {
    /// Lower and upper edge of the gap, rad.
    edges: [f64; 2],
    /// Torque over penetration; its constant is zero.
    contact: PolynomialLaw,
    preload: f64,
}

impl ClearanceLaw {
    /// A law of the given total clearance (rad; a negative one counts as none), torque over
    /// penetration (its constant is left out) and torque inside the gap.
    pub fn new(clearance: f64, contact: &PolynomialLaw, preload: f64) -> Self {
        let half = 0.5 * clearance.max(0.0);
        let mut coefficients = *contact.coefficients();
        coefficients[0] = 0.0;
        Self { edges: [-half, half], contact: PolynomialLaw::new(coefficients), preload }
    }

    /// Half of the total clearance, rad.
    #[inline]
    pub fn half_gap(&self) -> f64 {
        self.edges[1]
    }

    /// Torque over penetration on either flank.
    pub fn contact(&self) -> &PolynomialLaw {
        &self.contact
    }

    /// Torque inside the gap, N·m.
    pub fn preload(&self) -> f64 {
        self.preload
    }

    /// Torque at twist `x`, N·m.
    #[inline]
    pub fn torque(&self, x: f64) -> f64 {
        let penetration = x.abs() - self.half_gap();
        if penetration > 0.0 {
            self.preload + self.contact.torque(penetration) * x.signum()
        } else {
            self.preload
        }
    }

    /// Tangent stiffness at twist `x`, N·m/rad; at the edges that inside the gap.
    #[inline]
    pub fn stiffness(&self, x: f64) -> f64 {
        let penetration = x.abs() - self.half_gap();
        // Without a gap there is no inside.
        if penetration > 0.0 || self.half_gap() == 0.0 {
            self.contact.stiffness(penetration)
        } else {
            0.0
        }
    }

    /// `d²T/dx²` at twist `x`, N·m/rad²; zero at the edges.
    #[inline]
    pub fn curvature(&self, x: f64) -> f64 {
        let penetration = x.abs() - self.half_gap();
        if penetration > 0.0 { self.contact.curvature(penetration) * x.signum() } else { 0.0 }
    }

    /// Potential energy above zero twist, J.
    #[inline]
    pub fn energy(&self, x: f64) -> f64 {
        let penetration = x.abs() - self.half_gap();
        let contact = if penetration > 0.0 { self.contact.energy(penetration) } else { 0.0 };
        contact + self.preload * x
    }

    /// The edges of the gap where the tangent stiffness jumps there.
    pub fn switching_twists(&self) -> &[f64] {
        let jumps = self.half_gap() > 0.0 && self.contact.coefficients()[1] != 0.0;
        if jumps { &self.edges } else { &[] }
    }

    /// Whether the tangent stiffness is the same everywhere.
    pub fn is_linear(&self) -> bool {
        self.contact.is_linear()
            && (self.half_gap() == 0.0 || self.contact.coefficients()[1] == 0.0)
    }

    /// Whether `T(-x) = -T(x)`.
    pub fn is_odd(&self) -> bool {
        self.preload == 0.0
    }

    /// The describing function for an amplitude of zero or more: closed form for a linear contact, else by quadrature between the
    /// edges, exact to rounding.
    pub fn describing_function(&self, mean: f64, amplitude: f64) -> DescribingFunction {
        let [lower, upper] = self.edges;
        // A swing on one flank is that of a polynomial.
        if mean - amplitude >= upper {
            return self.on_flank(mean, amplitude, 1.0);
        }
        if mean + amplitude <= lower {
            return self.on_flank(mean, amplitude, -1.0);
        }
        let mut result = DescribingFunction::constant(self.preload);
        if mean - amplitude >= lower && mean + amplitude <= upper {
            return result;
        }
        if self.contact.is_linear() {
            let k = self.contact.coefficients()[1];
            result.add_ramp_above(upper, k, mean, amplitude);
            result.add_ramp_below(lower, k, mean, amplitude);
            return result;
        }
        let law = |x| (self.torque(x), self.stiffness(x));
        DescribingFunction::by_parts(mean, amplitude, &self.edges, law)
    }

    /// The describing function of a swing that never leaves the flank of the given sign.
    fn on_flank(&self, mean: f64, amplitude: f64, side: f64) -> DescribingFunction {
        let penetration = side * mean - self.half_gap();
        let mut result = self.contact.describing_function(penetration, amplitude);
        result.mean_torque = self.preload + side * result.mean_torque;
        result.mean_by_amplitude *= side;
        result.gain_by_mean *= side;
        result
    }
}
