//! Where the modes of a line in motion end, and what comes next.
//!
//! Each border is a number that is positive while its mode lasts: the distance of a twist from the end
//! of its piece, the rate of a sliding connection, what a sticking one leaves of its friction torque.

use std::sync::Arc;

use halfshaft_numerics::ode::System;

use crate::laws::TorqueLaw;
use crate::modes::{Modes, Sliding};
use crate::motion::Motion;

/// What a border of a mode is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BorderKind {
    /// The lower end of the piece that the twist is on.
    Lower,
    /// Its upper end.
    Upper,
    /// A sliding connection comes to rest.
    Rest,
    /// A sticking connection needs all of its friction torque against forward motion.
    BreakForward,
    /// The same against backward motion.
    BreakBackward,
}

/// A border of the mode of one connection.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Border {
    /// Index of the connection.
    pub connection: usize,
    /// What it is.
    pub kind: BorderKind,
}

/// What happens at an event.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EventKind {
    /// A flank of a gap, or a stop, is touched; on the drive side (positive twist) or the coast side.
    Contact {
        /// Whether on the drive side.
        drive: bool,
    },
    /// It is left.
    Separation {
        /// Whether on the drive side.
        drive: bool,
    },
    /// The twist enters another stage.
    Stage {
        /// The stage entered, counted from zero twist outwards, from 1.
        number: usize,
        /// Whether on the drive side.
        drive: bool,
    },
    /// The twist passes a point of a measured law, of no interest to anyone.
    Point,
    /// Dry friction sticks.
    Stick,
    /// Dry friction breaks away or slides on the other way.
    Slip {
        /// Whether the twist grows.
        forward: bool,
    },
}

/// A change of mode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModeEvent {
    /// Index of the connection.
    pub connection: usize,
    /// What happens.
    pub kind: EventKind,
    /// Twist, rad.
    pub twist: f64,
    /// Rate of twist, rad/s.
    pub rate: f64,
    /// Kinetic energy in the rate of twist, `v² / (2 wᵀ M⁻¹ w)`, J: what an impact has to take up.
    pub energy: f64,
}

/// Needed friction above the limit by this part is rounding.
const ROUNDING: f64 = 1e-12;

impl Motion<'_> {
    /// The borders of all modes at hand from time `t` on.
    pub fn borders(&self, t: f64) -> Vec<Border> {
        let Some(modes) = self.modes() else { return Vec::new() };
        let mut borders = Vec::new();
        for (connection, mode) in modes.list.iter().enumerate() {
            let mut add = |kind| borders.push(Border { connection, kind });
            if let Some(piece) = mode.piece() {
                if piece.from.is_finite() {
                    add(BorderKind::Lower);
                }
                if piece.to.is_finite() {
                    add(BorderKind::Upper);
                }
            }
            match mode.sliding {
                Some(Sliding::Stuck) => {
                    add(BorderKind::BreakForward);
                    add(BorderKind::BreakBackward);
                }
                // A friction that has not come to bear cannot stick.
                Some(_) if self.bears(connection, t) => add(BorderKind::Rest),
                Some(_) | None => {}
            }
        }
        borders
    }

    /// Whether a connection is in free play: on a piece of its law without contact.
    pub fn is_free(&self, connection: usize) -> bool {
        let law = &self.equations().connections[connection].law;
        let piece = self.modes().and_then(|modes| modes.list[connection].piece());
        piece.is_some_and(|piece| !law.in_contact(crate::modes::inside(piece)))
    }

    /// Whether the dry friction of a connection sticks.
    pub fn is_stuck(&self, connection: usize) -> bool {
        self.modes().is_some_and(|modes| modes.list[connection].sliding == Some(Sliding::Stuck))
    }

    fn bears(&self, connection: usize, t: f64) -> bool {
        let engagement = self.equations().connections[connection].engagement;
        engagement.is_none_or(|engagement| t >= engagement.start_s)
    }

    /// Value of each border at a state with its rate of change, and its slope over time, NaN where that
    /// is not known.
    pub fn distances(
        &mut self,
        t: f64,
        (state, rate): (&[f64], &[f64]),
        borders: &[Border],
        out: &mut [(f64, f64)],
    ) {
        let breaks = |border: &Border| {
            matches!(border.kind, BorderKind::BreakForward | BorderKind::BreakBackward)
        };
        let needed = borders.iter().any(breaks).then(|| {
            let mut scratch = vec![0.0; state.len()];
            self.derivative(t, state, &mut scratch);
            self.friction().to_vec()
        });
        let accelerations = self.kinematics(rate).rates.clone();
        let kinematics = self.kinematics(state).clone();
        let Some(modes) = self.modes() else { return };
        for (border, out) in borders.iter().zip(out) {
            let index = border.connection;
            let (x, v, a) =
                (kinematics.twists[index], kinematics.rates[index], accelerations[index]);
            let mode = &modes.list[index];
            let ends = mode.piece().map_or((f64::NAN, f64::NAN), |piece| (piece.from, piece.to));
            let torque = needed.as_ref().map_or(0.0, |needed| needed[index]);
            *out = match border.kind {
                BorderKind::Lower => (x - ends.0, v),
                BorderKind::Upper => (ends.1 - x, -v),
                BorderKind::Rest if mode.sliding == Some(Sliding::Backward) => (-v, -a),
                BorderKind::Rest => (v, a),
                BorderKind::BreakForward => (self.capacity(index, t) - torque, f64::NAN),
                BorderKind::BreakBackward => (self.capacity(index, t) + torque, f64::NAN),
            };
        }
    }

    /// Chooses all modes anew for a state, as at the start and after impulses.
    pub fn choose_modes(&mut self, t: f64, state: &[f64]) {
        let Some(mut modes) = self.modes().map(|modes| Modes::clone(modes)) else { return };
        let kinematics = self.kinematics(state).clone();
        let fastest = kinematics.rates.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
        for index in 0..modes.list.len() {
            let (x, v) = (kinematics.twists[index], kinematics.rates[index]);
            modes.place(self.equations(), index, x, v);
            if let Some(sliding) = &mut modes.list[index].sliding {
                *sliding = match v {
                    v if v.abs() <= ROUNDING * fastest => Sliding::Stuck,
                    v if v > 0.0 => Sliding::Forward,
                    _ => Sliding::Backward,
                };
            }
        }
        self.set_modes(Arc::new(modes));
        self.release(t, state);
    }

    /// Lets those connections slide whose friction does not suffice to stick.
    pub fn release(&mut self, t: f64, state: &[f64]) {
        let mut scratch = vec![0.0; state.len()];
        loop {
            let Some(modes) = self.modes().map(Arc::clone) else { return };
            if modes.stuck().next().is_none() {
                return;
            }
            self.derivative(t, state, &mut scratch);
            let over = |index: usize| {
                let torque = self.friction()[index];
                (index, torque, torque.abs() - (1.0 + ROUNDING) * self.capacity(index, t))
            };
            let worst = modes.stuck().map(over).filter(|(_, _, over)| *over > 0.0);
            let Some((index, torque, _)) = worst.max_by(|a, b| a.2.total_cmp(&b.2)) else { return };
            self.slide(index, torque > 0.0);
        }
    }

    fn slide(&mut self, index: usize, forward: bool) {
        self.set_sliding(index, if forward { Sliding::Forward } else { Sliding::Backward });
    }

    fn set_sliding(&mut self, index: usize, sliding: Sliding) {
        let Some(modes) = self.modes() else { return };
        let mut modes = Modes::clone(modes);
        modes.list[index].sliding = Some(sliding);
        self.set_modes(Arc::new(modes));
    }

    /// Passes a border: the state is set on it exactly where a coordinate can be, and the modes become
    /// those beyond it.
    pub fn pass(&mut self, border: Border, t: f64, state: &mut [f64]) -> ModeEvent {
        let index = border.connection;
        self.set_on(border, state);
        let kinematics = self.kinematics(state);
        let (twist, rate) = (kinematics.twists[index], kinematics.rates[index]);
        let energy = 0.5 * rate * rate / self.equations().compliance_of(index);
        let kind = match border.kind {
            BorderKind::Lower | BorderKind::Upper => self.enter(border),
            BorderKind::Rest => self.come_to_rest(index, t, state),
            BorderKind::BreakForward | BorderKind::BreakBackward => {
                let forward = border.kind == BorderKind::BreakForward;
                self.slide(index, forward);
                EventKind::Slip { forward }
            }
        };
        // Where contact brings its damper along, torques jump.
        self.release(t, state);
        ModeEvent { connection: index, kind, twist, rate, energy }
    }

    fn enter(&mut self, border: Border) -> EventKind {
        let index = border.connection;
        let equations = self.equations();
        let Some(modes) = self.modes() else { return EventKind::Point };
        let mut modes = Modes::clone(modes);
        let before = modes.list[index].at;
        let up = border.kind == BorderKind::Upper;
        let after = if up { before + 1 } else { before.saturating_sub(1) };
        modes.enter(equations, index, after);
        let law = &equations.connections[index].law;
        let kind = match law {
            TorqueLaw::Clearance(law) if law.half_gap() == 0.0 => EventKind::Contact { drive: up },
            TorqueLaw::Clearance(_) => match (before, after) {
                (0, _) => EventKind::Separation { drive: false },
                (2, _) => EventKind::Separation { drive: true },
                (_, after) => EventKind::Contact { drive: after == 2 },
            },
            TorqueLaw::OneSided(_) if up => EventKind::Contact { drive: true },
            TorqueLaw::OneSided(_) => EventKind::Separation { drive: true },
            TorqueLaw::PiecewiseLinear(law) => {
                let (number, drive) = law.stage(after);
                EventKind::Stage { number, drive }
            }
            TorqueLaw::Table(_) | TorqueLaw::Polynomial(_) | TorqueLaw::Function(_) => {
                EventKind::Point
            }
        };
        self.set_modes(Arc::new(modes));
        kind
    }

    /// A sliding connection at rest sticks if its friction suffices, else it slides as it is driven.
    fn come_to_rest(&mut self, index: usize, t: f64, state: &[f64]) -> EventKind {
        self.set_sliding(index, Sliding::Stuck);
        let mut scratch = vec![0.0; state.len()];
        self.derivative(t, state, &mut scratch);
        let torque = self.friction()[index];
        if torque.abs() <= (1.0 + ROUNDING) * self.capacity(index, t) {
            return EventKind::Stick;
        }
        let forward = torque > 0.0;
        self.slide(index, forward);
        EventKind::Slip { forward }
    }

    /// Sets the coordinate on the border where the connection is one of the spanning tree.
    fn set_on(&self, border: Border, state: &mut [f64]) {
        let tree = &self.equations().network.tree;
        let Some(at) = tree.iter().position(|edge| edge.shaft == border.connection) else { return };
        let Some(modes) = self.modes() else { return };
        let piece = modes.list[border.connection].piece();
        match (border.kind, piece) {
            (BorderKind::Lower, Some(piece)) => state[at] = piece.from,
            (BorderKind::Upper, Some(piece)) => state[at] = piece.to,
            (BorderKind::Rest, _) => state[self.coordinates() + at] = 0.0,
            _ => {}
        }
    }
}
