//! What the connections of a line do between two events.
//!
//! Each twist is on one piece of its law and each dry friction slides one way or sticks. Between events
//! the piece's polynomial holds beyond its ends and the friction torque is constant, or whatever keeps
//! the connection from sliding: so the equations are smooth, and no step of an integrator sees a kink.

use std::sync::Arc;

use crate::equations::EquationsOfMotion;
use crate::laws::{Piece, Pieces};

/// What a dry friction does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sliding {
    /// The twist grows.
    Forward,
    /// The twist falls.
    Backward,
    /// The twist stays.
    Stuck,
}

/// What one connection does.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Mode {
    /// Pieces of the law where there are several.
    pub(crate) pieces: Option<Arc<Pieces>>,
    /// The one that the twist is on.
    pub(crate) at: usize,
    /// Whether the viscous damping acts on it.
    pub(crate) damps: bool,
    /// What the dry friction does; `None` without any.
    pub(crate) sliding: Option<Sliding>,
}

/// What all connections do.
#[derive(Clone, Debug, PartialEq)]
pub struct Modes {
    pub(crate) list: Vec<Mode>,
}

impl Modes {
    /// The modes of a line at rest without twist. Dry friction slides and sticks where it is exact; else
    /// it is smoothed as in the laws.
    pub fn new(equations: &EquationsOfMotion, exact_friction: bool) -> Self {
        let mode = |connection: &crate::equations::Connection| {
            let pieces = connection.law.pieces();
            let several = pieces.list().len() > 1;
            let sliding = connection.friction.filter(|_| exact_friction).map(|_| Sliding::Stuck);
            Mode { pieces: several.then(|| Arc::new(pieces)), at: 0, damps: true, sliding }
        };
        let mut modes = Self { list: equations.connections.iter().map(mode).collect() };
        for index in 0..modes.list.len() {
            modes.place(equations, index, 0.0, 0.0);
        }
        modes
    }

    /// Whether nothing of the line ever switches.
    pub fn never_switch(&self) -> bool {
        self.list.iter().all(|mode| mode.pieces.is_none() && mode.sliding.is_none())
    }

    /// Puts a connection on the piece of its twist `x`; on an edge on that to which the rate `v` leads.
    pub(crate) fn place(&mut self, equations: &EquationsOfMotion, index: usize, x: f64, v: f64) {
        let mode = &mut self.list[index];
        if let Some(pieces) = &mode.pieces {
            let list = pieces.list();
            let beyond = |piece: &Piece| piece.to < x || (piece.to == x && v > 0.0);
            mode.at = list.partition_point(beyond).min(list.len() - 1);
        }
        self.damp(equations, index);
    }

    /// Moves a connection to another piece of its law.
    pub(crate) fn enter(&mut self, equations: &EquationsOfMotion, index: usize, at: usize) {
        self.list[index].at = at;
        self.damp(equations, index);
    }

    fn damp(&mut self, equations: &EquationsOfMotion, index: usize) {
        let mode = &mut self.list[index];
        let connection = &equations.connections[index];
        mode.damps = connection.damps_in_gap
            || mode.piece().is_none_or(|piece| connection.law.in_contact(inside(piece)));
    }

    /// Connections that stick.
    pub(crate) fn stuck(&self) -> impl Iterator<Item = usize> + '_ {
        let stuck = |mode: &Mode| mode.sliding == Some(Sliding::Stuck);
        self.list.iter().enumerate().filter(move |(_, mode)| stuck(mode)).map(|(index, _)| index)
    }
}

impl Mode {
    pub(crate) fn piece(&self) -> Option<&Piece> {
        self.pieces.as_ref().map(|pieces| &pieces.list()[self.at])
    }
}

/// A twist inside a piece.
pub(crate) fn inside(piece: &Piece) -> f64 {
    match (piece.from.is_finite(), piece.to.is_finite()) {
        (true, true) => 0.5 * (piece.from + piece.to),
        (true, false) => piece.from + piece.from.abs().max(1.0),
        (false, true) => piece.to - piece.to.abs().max(1.0),
        (false, false) => 0.0,
    }
}
