//! The motion of a line about one time as Taylor series.
//!
//! With `q = Σ q_k τ^k` the equations of motion give one power after the other,
//!
//! ```text
//! (k+1)(k+2) M q_{k+2} = Q_k - D (k+1) q_{k+1} - Σ_e w_e [ T_k + c (k+1) x_{k+1} + r_k ]
//! ```
//!
//! where `T_k`, `r_k` are the coefficients of the torque along the twist and of the friction along its
//! rate (A. Griewank, A. Walther, *Evaluating Derivatives* (2008), chapter 13). They hold as long as
//! every twist stays on its piece of the law.

use halfshaft_dynamics::laws::Pieces;
use halfshaft_dynamics::{Connection, EquationsOfMotion};

use super::series::{DEGREE, GrowingFriction, GrowingLaw, Series, ZERO, cosine_and_sine, evaluate};
use crate::equilibrium::RunningState;

/// A connection with the piece of its law that it is on.
#[derive(Clone, Debug)]
pub(super) struct Acting {
    pub(super) pieces: Pieces,
    /// Whether the connection is in contact on each piece.
    contact: Vec<bool>,
    pub(super) active: usize,
    law: GrowingLaw,
    friction: Option<GrowingFriction>,
}

impl Acting {
    fn new(connection: &Connection) -> Self {
        let pieces = connection.law.pieces();
        let inside = |from: f64, to: f64| match (from.is_finite(), to.is_finite()) {
            (true, true) => f64::midpoint(from, to),
            (true, false) => from + from.abs().max(1.0),
            (false, true) => to - to.abs().max(1.0),
            (false, false) => 0.0,
        };
        let touching = |piece: &halfshaft_dynamics::laws::Piece| {
            connection.law.in_contact(inside(piece.from, piece.to))
        };
        let contact = pieces.list().iter().map(touching).collect();
        let friction = connection.friction.as_ref();
        Self {
            law: GrowingLaw::new(&pieces.list()[0]),
            friction: friction.map(|f| GrowingFriction::new(f.torque_nm, f.speed_rad_s)),
            active: 0,
            contact,
            pieces,
        }
    }

    /// Goes to another piece.
    pub(super) fn go_to(&mut self, piece: usize) {
        if piece != self.active {
            self.active = piece;
            self.law = GrowingLaw::new(&self.pieces.list()[piece]);
        }
    }

    /// Viscous damping on the present piece.
    pub(super) fn damping(&self, connection: &Connection) -> f64 {
        let acts = connection.damps_in_gap || self.contact[self.active];
        if acts { connection.damping } else { 0.0 }
    }

    /// Tangent stiffness and damping along the motion.
    pub(super) fn tangents(&self, connection: &Connection, twist: &Series) -> (Series, Series) {
        let mut damping = self.friction.as_ref().map_or(ZERO, GrowingFriction::tangent);
        damping[0] += self.damping(connection);
        (self.law.tangent(twist), damping)
    }
}

/// Series of all groups and connections about one time.
#[derive(Clone, Debug)]
pub(super) struct Motion<'e> {
    pub(super) equations: &'e EquationsOfMotion,
    /// Mean torques that running leaves, N·m.
    mean: Vec<f64>,
    pub(super) acting: Vec<Acting>,
    /// Angles of the groups beyond the line's running as a whole.
    pub(super) angles: Vec<Series>,
    pub(super) twists: Vec<Series>,
    loads: Vec<Series>,
    net: Vec<f64>,
    /// Factor on all harmonic torques.
    pub(super) drive: f64,
}

impl<'e> Motion<'e> {
    pub(super) fn new(equations: &'e EquationsOfMotion) -> Self {
        let groups = equations.groups();
        Self {
            mean: RunningState::of(equations).forces,
            acting: equations.connections.iter().map(Acting::new).collect(),
            angles: vec![ZERO; groups],
            twists: vec![ZERO; equations.connections.len()],
            loads: vec![ZERO; groups],
            net: vec![0.0; groups],
            drive: 1.0,
            equations,
        }
    }

    /// Sets every connection to the piece that its twist is on, given angles and speeds.
    pub(super) fn settle(&mut self) {
        for index in 0..self.twists.len() {
            let (x, v) = (self.twist_term(index, 0), self.twist_term(index, 1));
            let list = self.acting[index].pieces.list();
            let mut at = list.partition_point(|piece| piece.to < x).min(list.len() - 1);
            if list[at].to == x && v > 0.0 {
                at = (at + 1).min(list.len() - 1);
            }
            self.acting[index].go_to(at);
        }
    }

    fn twist_term(&self, index: usize, power: usize) -> f64 {
        let connection = &self.equations.connections[index];
        let term = |end: Option<(usize, f64)>| {
            end.map_or(0.0, |(group, ratio)| ratio * self.angles[group][power])
        };
        term(connection.from) - term(connection.to)
    }

    /// All powers from those of angle and speed, at time `t` and excitation speed `frequency`.
    pub(super) fn expand(&mut self, t: f64, frequency: f64) {
        self.load(t, frequency);
        for power in 0..DEGREE - 1 {
            for (net, load) in self.net.iter_mut().zip(&self.loads) {
                *net = load[power];
            }
            for index in 0..self.twists.len() {
                if power == 0 {
                    self.twists[index][0] = self.twist_term(index, 0);
                }
                self.twists[index][power + 1] = self.twist_term(index, power + 1);
                let connection = &self.equations.connections[index];
                let (acting, twist) = (&mut self.acting[index], &self.twists[index]);
                let mut torque = acting.law.next(twist, power);
                torque += acting.damping(connection) * (power + 1) as f64 * twist[power + 1];
                if let Some(friction) = &mut acting.friction {
                    torque += friction.next(twist, power);
                }
                if let Some((group, ratio)) = connection.from {
                    self.net[group] -= ratio * torque;
                }
                if let Some((group, ratio)) = connection.to {
                    self.net[group] += ratio * torque;
                }
            }
            let factor = (power + 1) as f64;
            for (group, series) in self.angles.iter_mut().enumerate() {
                let drag = self.equations.ground_damping[group] * factor * series[power + 1];
                let inertia = self.equations.inertia[group] * factor * (factor + 1.0);
                series[power + 2] = (self.net[group] - drag) / inertia;
            }
        }
        for index in 0..self.twists.len() {
            self.twists[index][DEGREE] = self.twist_term(index, DEGREE);
        }
    }

    /// External torques on the groups.
    fn load(&mut self, t: f64, frequency: f64) {
        for (load, mean) in self.loads.iter_mut().zip(&self.mean) {
            *load = ZERO;
            load[0] = *mean;
        }
        for source in &self.equations.excitation.sources {
            if source.own_frequency.is_some() {
                continue;
            }
            let growth = source.ratio * source.growth(frequency);
            for harmonic in &source.harmonics {
                let speed = harmonic.order * frequency;
                let (cosine, _) = cosine_and_sine(speed, t, harmonic.phase_rad);
                let factor = self.drive * growth * harmonic.amplitude_nm;
                let load = &mut self.loads[source.group];
                load.iter_mut().zip(cosine).for_each(|(load, c)| *load += factor * c);
            }
        }
    }

    /// Derivatives of the external torques by the excitation speed, group by group.
    pub(super) fn loads_by_frequency(&self, t: f64, frequency: f64, out: &mut [Series]) {
        out.fill(ZERO);
        for source in &self.equations.excitation.sources {
            if source.own_frequency.is_some() {
                continue;
            }
            let growth = source.ratio * source.growth(frequency);
            let slope = source.ratio * source.growth_slope(frequency);
            for harmonic in &source.harmonics {
                let speed = harmonic.order * frequency;
                let (cosine, sine) = cosine_and_sine(speed, t, harmonic.phase_rad);
                let amplitude = self.drive * harmonic.amplitude_nm;
                let turning = -growth * amplitude * harmonic.order;
                let growing = slope * amplitude;
                let out = &mut out[source.group];
                for power in 0..=DEGREE {
                    let before = if power == 0 { 0.0 } else { sine[power - 1] };
                    out[power] += turning * (t * sine[power] + before) + growing * cosine[power];
                }
            }
        }
    }

    /// Derivatives of the external torques by the drive, group by group.
    pub(super) fn loads_by_drive(&self, t: f64, frequency: f64, out: &mut [Series]) {
        out.fill(ZERO);
        for source in &self.equations.excitation.sources {
            if source.own_frequency.is_some() {
                continue;
            }
            let growth = source.ratio * source.growth(frequency);
            for harmonic in &source.harmonics {
                let speed = harmonic.order * frequency;
                let (cosine, _) = cosine_and_sine(speed, t, harmonic.phase_rad);
                let factor = growth * harmonic.amplitude_nm;
                let out = &mut out[source.group];
                out.iter_mut().zip(cosine).for_each(|(load, c)| *load += factor * c);
            }
        }
    }

    /// Moves angles and speeds on by `step`.
    pub(super) fn advance(&mut self, step: f64) {
        for series in &mut self.angles {
            (series[0], series[1]) = evaluate(series, step);
        }
    }

    /// The step after which the last terms are rounding beside angles and speeds.
    pub(super) fn reach(&self, speed: f64, rounding: f64) -> f64 {
        let size = |power: usize| {
            self.angles.iter().fold(0.0_f64, |most, series| most.max(series[power].abs()))
        };
        let scale = size(0).max(size(1) / speed).max(f64::MIN_POSITIVE.sqrt());
        reach(scale, [size(DEGREE - 1), size(DEGREE)], rounding)
    }
}

/// The step after which terms of the two highest powers are `rounding` beside `scale`.
pub(super) fn reach(scale: f64, last: [f64; 2], rounding: f64) -> f64 {
    let of = |size: f64, power: usize| {
        if size == 0.0 {
            return f64::INFINITY;
        }
        (rounding * scale / size).powf(1.0 / power as f64)
    };
    of(last[0], DEGREE - 1).min(of(last[1], DEGREE))
}
