//! Where the law of a shaft stops carrying more torque.
//!
//! On the way from zero twist the torque grows until the tangent stiffness becomes negative for the
//! first time, or is zero from there on for ever: theory 2, `T_max = (2/3) k1 sqrt(k1 / (3 |k3|))`
//! for a softening cubic. Free play on the way is no limit.

use halfshaft_dynamics::TorqueLaw;
use halfshaft_dynamics::laws::{Piece, Pieces};
use halfshaft_numerics::polynomial::Multiplicity;
use halfshaft_results::{Limit, ShaftCapacity};

/// Limits of a law in both directions.
pub(crate) fn capacity(law: &TorqueLaw) -> ShaftCapacity {
    capacity_of(&law.pieces())
}

/// Those limits beyond which the law carries less: past them a shaft snaps through, where past the
/// others it slips.
pub(crate) fn snap_limits(law: &TorqueLaw) -> ShaftCapacity {
    both_ways(&law.pieces(), |law| first_limit(law).filter(|(_, falls)| *falls))
}

/// Limits of the torque over the twist in both directions.
pub(super) fn capacity_of(law: &Pieces) -> ShaftCapacity {
    both_ways(law, first_limit)
}

fn both_ways(law: &Pieces, first: impl Fn(&Pieces) -> Option<(Limit, bool)>) -> ShaftCapacity {
    let backwards =
        |(limit, _): (Limit, bool)| Limit { torque: -limit.torque, twist: -limit.twist };
    ShaftCapacity {
        positive: first(law).map(|(limit, _)| limit),
        negative: first(&law.stretched(-1.0)).map(backwards),
    }
}

/// The first limit at positive twist, and whether the torque falls beyond.
fn first_limit(law: &Pieces) -> Option<(Limit, bool)> {
    let limit = |twist: f64| Limit { torque: law.torque(twist), twist };
    // Where the torque has stopped to rise, unless it rises again.
    let mut flat: Option<f64> = None;
    for piece in law.list().iter().filter(|piece| piece.to > 0.0) {
        for (from, to) in monotone_parts(piece) {
            let slope = slope_inside(piece, from, to);
            if slope < 0.0 {
                return Some((limit(flat.unwrap_or(from)), true));
            }
            flat = if slope > 0.0 { None } else { flat.or(Some(from)) };
        }
    }
    Some((limit(flat?), false))
}

/// The parts of a piece at positive twist in which the torque does not turn.
fn monotone_parts(piece: &Piece) -> Vec<(f64, f64)> {
    let start = piece.from.max(0.0);
    // A slope that only touches zero goes on rising: no turning.
    let turning = piece.torque.derivative().real_roots().into_iter();
    let turning = turning.filter(|root| root.multiplicity == Multiplicity::Simple);
    let mut ends: Vec<f64> = turning.map(|root| root.value + piece.origin).collect();
    ends.retain(|x| *x > start && *x < piece.to);
    ends.push(piece.to);
    let mut from = start;
    let part = |to: f64| {
        let part = (from, to);
        from = to;
        part
    };
    ends.into_iter().map(part).collect()
}

/// The tangent stiffness in the middle of a part, or beyond its beginning where it has no end.
fn slope_inside(piece: &Piece, from: f64, to: f64) -> f64 {
    let x = if to.is_finite() { 0.5 * (from + to) } else { 2.0 * from + 1.0 };
    piece.torque.evaluate_with_slope(x - piece.origin).1
}

/// Largest torque that the law carries in the direction of `load`; the smaller of both
/// directions where there is no load. `None` where it is unbounded.
pub(crate) fn carries(capacity: &ShaftCapacity, load: f64) -> Option<f64> {
    // A direction in which the law carries nothing at all is no limit as long as nothing is asked.
    let carried = |limit: Limit| Some(limit.torque.abs()).filter(|t| load != 0.0 || *t != 0.0);
    let positive = capacity.positive.and_then(carried);
    let negative = capacity.negative.and_then(carried);
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
