//! Torque laws of connections: torque, its derivative and its energy over the twist.
//!
//! To add a law: a file here, a variant of [`TorqueLaw`], a line in each of its methods.

mod polynomial;

pub use polynomial::PolynomialLaw;

/// Torque of a connection as a function of its twist.
#[derive(Clone, Debug, PartialEq)]
pub enum TorqueLaw {
    /// `k1 x + k2 x² + k3 x³ + k5 x⁵ + k7 x⁷`.
    Polynomial(PolynomialLaw),
}

impl TorqueLaw {
    /// Torque at twist `x` (rad), N·m.
    #[inline]
    pub fn torque(&self, x: f64) -> f64 {
        match self {
            Self::Polynomial(law) => law.torque(x),
        }
    }

    /// Tangent stiffness at twist `x` (rad), N·m/rad.
    #[inline]
    pub fn stiffness(&self, x: f64) -> f64 {
        match self {
            Self::Polynomial(law) => law.stiffness(x),
        }
    }

    /// Potential energy at twist `x` (rad) above the untwisted state, J.
    #[inline]
    pub fn energy(&self, x: f64) -> f64 {
        match self {
            Self::Polynomial(law) => law.energy(x),
        }
    }

    /// Whether the torque is proportional to the twist.
    pub fn is_linear(&self) -> bool {
        match self {
            Self::Polynomial(law) => law.is_linear(),
        }
    }
}
