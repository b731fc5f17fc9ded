//! The motion of a free line without any twist.

/// Rigid-body motion `q = speeds · s` of a free line.
///
/// The coordinate `s = Σ M_g R_g q_g / Σ M_g R_g²` is the angle of the line as a whole, with
/// `R` the speeds; what is left after taking it out is orthogonal to it in the inertia.
#[derive(Clone, Debug, PartialEq)]
pub struct RigidBody {
    /// Speed of each group, `R`; 1 at the first.
    pub speeds: Vec<f64>,
    /// `Σ M R²`, kg·m².
    pub inertia: f64,
    /// `Σ D R²`, N·m·s/rad: damping to ground of the line as a whole.
    pub ground_damping: f64,
    /// `M_g R_g / Σ M R²`: weight of each group's angle in `s`.
    pub weights: Vec<f64>,
}

impl RigidBody {
    pub(crate) fn new(speeds: Vec<f64>, inertia: &[f64], ground_damping: &[f64]) -> Self {
        let total: f64 = inertia.iter().zip(&speeds).map(|(m, r)| m * r * r).sum();
        let damping = ground_damping.iter().zip(&speeds).map(|(d, r)| d * r * r).sum();
        let weights = inertia.iter().zip(&speeds).map(|(m, r)| m * r / total).collect();
        Self { speeds, inertia: total, ground_damping: damping, weights }
    }

    /// Torque that accelerates the line as a whole, for group torques `torques`: `Σ R Q`.
    pub fn torque(&self, torques: &[f64]) -> f64 {
        self.speeds.iter().zip(torques).map(|(r, q)| r * q).sum()
    }

    /// The coordinate `s` of group angles (or of speeds).
    pub fn mean(&self, angles: &[f64]) -> f64 {
        self.weights.iter().zip(angles).map(|(w, q)| w * q).sum()
    }
}
