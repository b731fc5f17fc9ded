//! What an equilibrium does not decide: twists inside free play, and laws beyond their measurement.

use halfshaft_dynamics::laws::Piece;
use halfshaft_dynamics::{Connection, EquationsOfMotion, TorqueLaw};

use super::RestState;

/// Warnings about shafts that rest where their law is flat or was not measured.
pub(crate) fn free_play(equations: &EquationsOfMotion, state: &RestState) -> Vec<String> {
    let twists = equations.connections.iter().zip(&state.twists);
    twists
        .flat_map(|(connection, x)| [flat(connection, *x), beyond(connection, *x)])
        .flatten()
        .collect()
}

/// The flat part of a law around a twist.
fn flat(connection: &Connection, x: f64) -> Option<String> {
    let pieces = connection.law.pieces();
    let touches = |piece: &&Piece| {
        piece.torque.degree() == 0 && piece.from <= x && x <= piece.to && piece.from < piece.to
    };
    // A law without any stiffness is a damper; there is no play to speak of.
    let piece = pieces.list().iter().find(touches).filter(|_| pieces.list().len() > 1)?;
    let name = &connection.name;
    let range = match (piece.from.is_finite(), piece.to.is_finite()) {
        (true, true) => format!("from {:.6} to {:.6} rad", piece.from, piece.to),
        (true, false) => format!("above {:.6} rad", piece.from),
        _ => format!("below {:.6} rad", piece.to),
    };
    Some(format!(
        "{name} rests where its law is flat: every twist {range} is in balance, and {x:.6} rad stands \
         for them"
    ))
}

/// A twist beyond the points of a measured law.
fn beyond(connection: &Connection, x: f64) -> Option<String> {
    let TorqueLaw::Table(law) = &connection.law else { return None };
    let (first, last) = (law.points().first()?, law.points().last()?);
    (x < *first || x > *last).then(|| {
        format!(
            "{} is twisted to {x:.6} rad, beyond its table ({first:.6} to {last:.6} rad): the law goes \
             on straight there",
            connection.name
        )
    })
}
