//! The torques of one order over the circular frequency.

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_numerics::Complex;

use super::jet::Scalar;

/// One source's torque of the order on its group: `amplitude · (ν / reference)^power`.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Term {
    group: usize,
    amplitude: Complex,
    power: f64,
    /// Circular frequency at which the amplitude is as stated, rad/s.
    reference: f64,
}

/// All torques of one order.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Drive {
    terms: Vec<Term>,
}

impl Drive {
    /// The torques of order `order` of a line.
    pub(super) fn new(equations: &EquationsOfMotion, order: f64) -> Self {
        let mut terms = Vec::new();
        let sources = &equations.excitation.sources;
        for source in sources.iter().filter(|source| source.own_frequency.is_none()) {
            for harmonic in source.harmonics.iter().filter(|h| h.order == order) {
                let torque = source.ratio * harmonic.amplitude_nm;
                terms.push(Term {
                    group: source.group,
                    amplitude: Complex::from_polar(torque, harmonic.phase_rad),
                    power: source.speed_power,
                    reference: order * source.reference_speed,
                });
            }
        }
        Self { terms }
    }

    /// Whether nothing drives at this order.
    pub(super) fn is_silent(&self) -> bool {
        self.terms.iter().all(|term| term.amplitude == Complex::default())
    }

    /// The real factor that makes this drive of another one, where there is such a factor.
    pub(super) fn factor_over(&self, other: &Self) -> Option<f64> {
        let mut factor = None;
        if self.terms.len() != other.terms.len() {
            return None;
        }
        for (own, theirs) in self.terms.iter().zip(&other.terms) {
            let alike = (own.group, own.power, own.reference)
                == (theirs.group, theirs.power, theirs.reference);
            let quotient = own.amplitude / theirs.amplitude;
            let same = factor.is_none_or(|known: f64| {
                (known - quotient.re).abs() <= 4.0 * f64::EPSILON * known.abs()
            });
            // A turned phase is no real factor.
            if !(alike && same && quotient.im.abs() <= 4.0 * f64::EPSILON * quotient.re.abs()) {
                return None;
            }
            factor = factor.or(Some(quotient.re));
        }
        factor.filter(|factor| factor.is_finite())
    }

    /// Adds the torques at circular frequency `nu` to one entry a group.
    pub(super) fn add_to<S: Scalar>(&self, nu: f64, torques: &mut [S]) {
        for term in &self.terms {
            let (mut value, mut first, mut second) = (1.0, 0.0, 0.0);
            if term.power != 0.0 {
                let power = term.power;
                value = (nu / term.reference).powf(power);
                first = power * value / nu;
                second = (power - 1.0) * first / nu;
            }
            let part = |factor: f64| term.amplitude.scaled(factor);
            torques[term.group] =
                torques[term.group] + S::of(part(value), part(first), part(second));
        }
    }
}
