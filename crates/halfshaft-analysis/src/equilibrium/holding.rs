//! Whether a twist that is in balance holds: the torque must bring it back from both sides.

use halfshaft_dynamics::laws::{Piece, Pieces};

/// A derivative below this part of its terms has vanished: the limit of a law.
pub(super) const VANISHING: f64 = 1e-10;

/// Whether the shaft stays near the twist `x`, which is in balance with its load.
///
/// The torque less the load must not push away: above `x` it must not be negative, below not
/// positive. Where the law is flat there (inside a gap) its next parts decide; a flat part that goes
/// on for ever pushes nowhere.
pub(super) fn holds(law: &Pieces, x: f64) -> bool {
    above(law, x) >= 0.0 && above(&law.stretched(-1.0), -x) >= 0.0
}

/// Whether the law is flat on both sides of `x`.
pub(super) fn is_flat(law: &Pieces, x: f64) -> bool {
    let flat = |law: &Pieces, x: f64| {
        let piece = law.list().iter().find(|piece| piece.to > x);
        piece.is_some_and(|piece| rise(piece, x) == 0.0)
    };
    flat(law, x) && flat(&law.stretched(-1.0), -x)
}

/// Sign of the change of torque above `x`, beyond a flat part if there is one.
fn above(law: &Pieces, x: f64) -> f64 {
    let pieces = law.list().iter().filter(|piece| piece.to > x);
    pieces.map(|piece| rise(piece, piece.from.max(x))).find(|sign| *sign != 0.0).unwrap_or(0.0)
}

/// Sign of the first derivative at `x` that has not vanished, as the piece goes on upwards.
fn rise(piece: &Piece, x: f64) -> f64 {
    let d = x - piece.origin;
    let mut derivative = piece.torque.derivative();
    while !derivative.is_zero() {
        let terms = derivative.coefficients().iter().rev();
        let size = terms.fold(0.0, |sum, k| sum * d.abs() + k.abs());
        let value = derivative.evaluate(d);
        if value.abs() > VANISHING * size {
            return value.signum();
        }
        derivative = derivative.derivative();
    }
    0.0
}
