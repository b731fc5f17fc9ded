//! One-sided contact: a stop that only pushes.
//!
//! `T = preload + k1 p + k2 p² + k3 p³ + ...` of the penetration `p = x - contact` where that is
//! positive, else the preload alone. For a stop on the other side the ends are exchanged.

use super::describing::DescribingFunction;
use super::polynomial::PolynomialLaw;

/// A stop that touches at one twist.
#[derive(Clone, Debug, PartialEq)]
pub struct OneSidedContact {
    contact_twist: [f64; 1],
    /// Torque over penetration; its constant is zero.
    contact: PolynomialLaw,
    preload: f64,
    /// Energy of the contact at zero twist, J.
    energy_at_zero: f64,
}

impl OneSidedContact {
    /// A stop that touches at `contact_twist` (rad), its torque over penetration (the constant is
    /// left out) and the torque without contact.
    pub fn new(contact_twist: f64, contact: &PolynomialLaw, preload: f64) -> Self {
        let mut coefficients = *contact.coefficients();
        coefficients[0] = 0.0;
        let contact = PolynomialLaw::new(coefficients);
        let energy_at_zero = contact.energy((-contact_twist).max(0.0));
        Self { contact_twist: [contact_twist], contact, preload, energy_at_zero }
    }

    /// Twist at which the stop touches, rad.
    #[inline]
    pub fn contact_twist(&self) -> f64 {
        self.contact_twist[0]
    }

    /// Torque over penetration.
    pub fn contact(&self) -> &PolynomialLaw {
        &self.contact
    }

    /// Torque without contact, N·m.
    pub fn preload(&self) -> f64 {
        self.preload
    }

    /// Torque at twist `x`, N·m.
    #[inline]
    pub fn torque(&self, x: f64) -> f64 {
        let penetration = (x - self.contact_twist()).max(0.0);
        self.preload + self.contact.torque(penetration)
    }

    /// Tangent stiffness at twist `x`, N·m/rad; where it touches, that without contact.
    #[inline]
    pub fn stiffness(&self, x: f64) -> f64 {
        let penetration = x - self.contact_twist();
        if penetration > 0.0 { self.contact.stiffness(penetration) } else { 0.0 }
    }

    /// `d²T/dx²` at twist `x`, N·m/rad²; zero where it touches.
    #[inline]
    pub fn curvature(&self, x: f64) -> f64 {
        let penetration = x - self.contact_twist();
        if penetration > 0.0 { self.contact.curvature(penetration) } else { 0.0 }
    }

    /// Potential energy above zero twist, J.
    #[inline]
    pub fn energy(&self, x: f64) -> f64 {
        let penetration = (x - self.contact_twist()).max(0.0);
        self.contact.energy(penetration) - self.energy_at_zero + self.preload * x
    }

    /// Where it touches, if the tangent stiffness jumps there.
    pub fn switching_twists(&self) -> &[f64] {
        if self.contact.coefficients()[1] == 0.0 { &[] } else { &self.contact_twist }
    }

    /// Whether the tangent stiffness is the same everywhere.
    pub fn is_linear(&self) -> bool {
        self.contact.coefficients().iter().all(|k| *k == 0.0)
    }

    /// Whether `T(-x) = -T(x)`.
    pub fn is_odd(&self) -> bool {
        self.preload == 0.0 && self.is_linear()
    }

    /// The describing function for an amplitude of zero or more: closed form for a linear contact,
    /// else by quadrature up to where it touches, exact to rounding.
    pub fn describing_function(&self, mean: f64, amplitude: f64) -> DescribingFunction {
        let touch = self.contact_twist();
        if mean + amplitude <= touch {
            return DescribingFunction::constant(self.preload);
        }
        if mean - amplitude >= touch {
            let mut result = self.contact.describing_function(mean - touch, amplitude);
            result.mean_torque += self.preload;
            return result;
        }
        if self.contact.is_linear() {
            let mut result = DescribingFunction::constant(self.preload);
            result.add_ramp_above(touch, self.contact.coefficients()[1], mean, amplitude);
            return result;
        }
        let law = |x| (self.torque(x), self.stiffness(x));
        DescribingFunction::by_parts(mean, amplitude, &self.contact_twist, law)
    }
}
