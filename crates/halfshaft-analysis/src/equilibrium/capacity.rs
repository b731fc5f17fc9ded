//! Where the law of a shaft stops carrying more torque.
//!
//! On the way from zero twist the torque grows until the tangent stiffness vanishes for the
//! first time: theory 2, `T_max = (2/3) k1 sqrt(k1 / (3 |k3|))` for a softening cubic.

use halfshaft_dynamics::TorqueLaw;
use halfshaft_numerics::polynomial::{Multiplicity, Polynomial};
use halfshaft_results::{Limit, ShaftCapacity};

use super::polynomial_of;

/// Limits of a law in both directions.
pub(crate) fn capacity(law: &TorqueLaw) -> ShaftCapacity {
    capacity_of(&polynomial_of(law).polynomial())
}

/// Limits of the torque `law(twist)` in both directions.
pub(super) fn capacity_of(law: &Polynomial) -> ShaftCapacity {
    let slope = law.derivative();
    // A slope that only touches zero goes on rising: no limit.
    let turning: Vec<f64> = slope
        .real_roots()
        .into_iter()
        .filter(|root| root.multiplicity == Multiplicity::Simple)
        .map(|root| root.value)
        .collect();
    let limit = |twist: f64| Limit { torque: law.evaluate(twist), twist };
    let falls_at_once = slope.evaluate(0.0) <= 0.0 && !rises_from_zero(law);
    if falls_at_once {
        let none = Some(limit(0.0));
        return ShaftCapacity { positive: none, negative: none };
    }
    let positive = turning.iter().copied().filter(|x| *x > 0.0).reduce(f64::min);
    let negative = turning.iter().copied().filter(|x| *x < 0.0).reduce(f64::max);
    ShaftCapacity { positive: positive.map(limit), negative: negative.map(limit) }
}

/// Whether a law without linear stiffness still grows from zero: its first term is odd and
/// positive.
fn rises_from_zero(law: &Polynomial) -> bool {
    let first = law.coefficients().iter().enumerate().skip(1).find(|(_, k)| **k != 0.0);
    first.is_some_and(|(power, k)| power % 2 == 1 && *k > 0.0)
}

/// Largest torque that the law carries in the direction of `load`; the smaller of both
/// directions where there is no load. `None` where it is unbounded.
pub(crate) fn carries(capacity: &ShaftCapacity, load: f64) -> Option<f64> {
    let positive = capacity.positive.map(|limit| limit.torque.abs());
    let negative = capacity.negative.map(|limit| limit.torque.abs());
    if load > 0.0 {
        positive
    } else if load < 0.0 {
        negative
    } else {
        match (positive, negative) {
            (Some(a), Some(b)) => Some(a.min(b)),
            (a, b) => a.or(b),
        }
    }
}
