//! The equations of motion as a first-order system for the integrators.
//!
//! Coordinates are the twists `x` of the spanning tree's shafts and, for a free line, the
//! mean angle `s`. So a line that turns a thousand times loses no digit of its twists, and
//! tolerances mean twists. State: `[x.., s | x'.., s' | work, heat]`, the last two where
//! the energy is kept.

use std::sync::Arc;

use halfshaft_numerics::dense::{Matrix, solve};
use halfshaft_numerics::ode::{Linearised, System};

use crate::equations::EquationsOfMotion;
use crate::excitation::{Active, Excitation, Source};
use crate::modes::{Modes, Sliding};
use halfshaft_model::elements::{Pulse, PulseShape};

/// Angles and speeds of all groups, twists and rates of all connections.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Kinematics {
    /// Angle of each group, rad.
    pub angles: Vec<f64>,
    /// Speed of each group, rad/s.
    pub speeds: Vec<f64>,
    /// Twist of each connection, rad.
    pub twists: Vec<f64>,
    /// Rate of twist of each connection, rad/s.
    pub rates: Vec<f64>,
}

/// Whether a pulse has begun and ended, which the integrator switches at break times.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Phase {
    Before,
    During,
    After,
}

/// A line in motion.
#[derive(Clone, Debug)]
pub struct Motion<'l> {
    equations: &'l EquationsOfMotion,
    active: Active,
    with_energy: bool,
    /// Whether the accelerations depend on group angles or speeds, not only on tree twists.
    needs_groups: bool,
    phases: Vec<Phase>,
    /// What connections do until the next event; `None` where laws are taken as they are.
    modes: Option<Arc<Modes>>,
    /// Torque of each connection, and the dry friction in it, at the state last evaluated.
    torques: Vec<f64>,
    friction: Vec<f64>,
    time: f64,
    kinematics: Kinematics,
    /// Scratch: torque on each group without dampers to ground, then its acceleration.
    external: Vec<f64>,
    net: Vec<f64>,
}

impl<'l> Motion<'l> {
    /// The motion of a line under the active torques; `with_energy` adds work and heat to the
    /// state.
    pub fn new(equations: &'l EquationsOfMotion, active: Active, with_energy: bool) -> Self {
        let groups = equations.groups();
        let connections = equations.connections.len();
        let mut motion = Self {
            equations,
            active,
            with_energy,
            needs_groups: with_energy
                || !equations.network.loops.is_empty()
                || equations.ground_damping.iter().any(|damping| *damping != 0.0),
            phases: vec![Phase::Before; equations.excitation.sources.len()],
            modes: None,
            torques: vec![0.0; connections],
            friction: vec![0.0; connections],
            time: 0.0,
            kinematics: Kinematics {
                angles: vec![0.0; groups],
                speeds: vec![0.0; groups],
                twists: vec![0.0; connections],
                rates: vec![0.0; connections],
            },
            external: vec![0.0; groups],
            net: vec![0.0; groups],
        };
        motion.switch_pulses(0.0);
        motion
    }

    /// The line.
    pub fn equations(&self) -> &'l EquationsOfMotion {
        self.equations
    }

    /// What connections do until the next event; `None` where laws are taken as they are.
    pub fn modes(&self) -> Option<&Arc<Modes>> {
        self.modes.as_ref()
    }

    /// Takes the connections as doing this until told otherwise.
    pub fn set_modes(&mut self, modes: Arc<Modes>) {
        self.modes = Some(modes);
    }

    /// Torque of each connection at the state last evaluated by [`System::derivative`], N·m.
    pub fn torques(&self) -> &[f64] {
        &self.torques
    }

    /// Dry friction torque of each connection at the state last evaluated, N·m; where it sticks what
    /// that takes.
    pub fn friction(&self) -> &[f64] {
        &self.friction
    }

    /// Dry friction torque that a connection can bear at time `t`, N·m.
    pub fn capacity(&self, index: usize, t: f64) -> f64 {
        let connection = &self.equations.connections[index];
        let engaged = connection.engagement.map_or(1.0, |engagement| engagement.share(t));
        connection.friction.map_or(0.0, |friction| engaged * friction.torque_nm)
    }

    /// Number of coordinates: twists of the spanning tree and the mean angle of a free line.
    pub fn coordinates(&self) -> usize {
        self.equations.groups()
    }

    /// Number of twists among the coordinates.
    pub fn tree_twists(&self) -> usize {
        self.equations.network.tree.len()
    }

    /// A state of the right length with everything at zero.
    pub fn zero_state(&self) -> Vec<f64> {
        vec![0.0; self.dimension()]
    }

    /// Sets the pulses to what they are from time `t` on.
    pub fn switch_pulses(&mut self, t: f64) {
        for (phase, source) in self.phases.iter_mut().zip(&self.equations.excitation.sources) {
            *phase = match &source.pulse {
                Some(pulse) if t >= pulse.end_s() => Phase::After,
                Some(pulse) if t >= pulse.start_s => Phase::During,
                _ => Phase::Before,
            };
        }
    }

    /// Adds the speed jump of impulses at time `t` to `state`, and their work.
    pub fn apply_impulses(&mut self, t: f64, state: &mut [f64]) {
        if !self.active.pulses {
            return;
        }
        let Some(jumps) = rate_jumps(self.equations, t) else { return };
        let before = self.energy(state);
        let n = self.coordinates();
        state[n..2 * n].iter_mut().zip(jumps).for_each(|(rate, jump)| *rate += jump);
        if self.with_energy {
            state[2 * n] += self.energy(state) - before;
        }
    }

    /// Kinetic and potential energy of a state, J.
    pub fn energy(&mut self, state: &[f64]) -> f64 {
        self.kinematics(state);
        self.equations.kinetic_energy(&self.kinematics.speeds)
            + self.equations.potential_energy(&self.kinematics.twists)
    }

    /// Angles, speeds, twists and rates of a state.
    pub fn kinematics(&mut self, state: &[f64]) -> &Kinematics {
        self.update(state, true);
        &self.kinematics
    }

    /// Kinematics of a state; group angles and speeds only where something asks for them.
    fn update(&mut self, state: &[f64], groups: bool) {
        let n = self.coordinates();
        let m = self.tree_twists();
        let Kinematics { angles, speeds, twists, rates } = &mut self.kinematics;
        if groups {
            let mean = state.get(m).filter(|_| m < n).copied();
            placed(self.equations, &state[..m], mean, angles);
            let rate_of_mean = state.get(n + m).filter(|_| m < n).copied();
            placed(self.equations, &state[n..n + m], rate_of_mean, speeds);
        }
        for (index, edge) in self.equations.network.tree.iter().enumerate() {
            twists[edge.shaft] = state[index];
            rates[edge.shaft] = state[n + index];
        }
        for &shaft in &self.equations.network.loops {
            twists[shaft] = self.equations.twist(shaft, angles);
            rates[shaft] = self.equations.twist(shaft, speeds);
        }
    }

    /// The state of given group angles and speeds (energies at zero).
    pub fn state_of(&self, angles: &[f64], speeds: &[f64]) -> Vec<f64> {
        let mut state = self.zero_state();
        let n = self.coordinates();
        for (index, edge) in self.equations.network.tree.iter().enumerate() {
            state[index] = self.equations.twist(edge.shaft, angles);
            state[n + index] = self.equations.twist(edge.shaft, speeds);
        }
        if let Some(rigid) = &self.equations.rigid {
            state[n - 1] = rigid.mean(angles);
            state[2 * n - 1] = rigid.mean(speeds);
        }
        state
    }

    /// Torques on the groups at time `t` without dampers to ground, to `external`.
    fn load(&mut self, t: f64) {
        self.time = t;
        self.external.fill(0.0);
        let Excitation { sources } = &self.equations.excitation;
        for (source, phase) in sources.iter().zip(&self.phases) {
            let torque = source_torque(source, *phase, &self.active, t);
            self.external[source.group] += source.ratio * torque;
        }
    }

    /// Torques of all connections and dampers on the groups, to `net`, beside the external
    /// ones. Needs the kinematics.
    fn assemble(&mut self) {
        self.net.copy_from_slice(&self.external);
        for index in 0..self.equations.connections.len() {
            let torque = self.connection_torque(index);
            self.torques[index] = torque;
            self.equations.add_direction(index, -torque, &mut self.net);
        }
        let speeds = &self.kinematics.speeds;
        for (group, damping) in self.equations.ground_damping.iter().enumerate() {
            self.net[group] -= damping * speeds[group];
        }
        self.hold_stuck();
    }

    /// Torque of a connection but for what makes it stick.
    fn connection_torque(&mut self, index: usize) -> f64 {
        let connection = &self.equations.connections[index];
        let (x, v) = (self.kinematics.twists[index], self.kinematics.rates[index]);
        let Some(modes) = &self.modes else {
            return connection.law.torque(x) + connection.resistance(x, v);
        };
        let mode = &modes.list[index];
        let elastic = match mode.piece() {
            Some(piece) => piece.torque.evaluate(x - piece.origin),
            None => connection.law.torque(x),
        };
        let viscous = if mode.damps { connection.damping * v } else { 0.0 };
        let dry = match mode.sliding {
            None => connection.friction.map_or(0.0, |friction| friction.torque(v)),
            Some(Sliding::Forward) => self.capacity(index, self.time),
            Some(Sliding::Backward) => -self.capacity(index, self.time),
            Some(Sliding::Stuck) => 0.0,
        };
        self.friction[index] = dry;
        elastic + viscous + dry
    }

    /// Adds the friction torques that keep sticking connections from sliding: with `w` their directions
    /// `wᵀ M⁻¹ (net - Σ w λ) = 0`.
    fn hold_stuck(&mut self) {
        let Some(modes) = &self.modes else { return };
        let stuck: Vec<usize> = modes.stuck().collect();
        if stuck.is_empty() {
            return;
        }
        let equations = self.equations;
        let accelerations: Vec<f64> =
            self.net.iter().zip(&equations.inertia).map(|(q, m)| q / m).collect();
        let pushed: Vec<f64> =
            stuck.iter().map(|index| equations.twist(*index, &accelerations)).collect();
        let compliance = |i: usize, j: usize| {
            let mut direction = vec![0.0; equations.groups()];
            equations.add_direction(stuck[j], 1.0, &mut direction);
            direction.iter_mut().zip(&equations.inertia).for_each(|(w, m)| *w /= m);
            equations.twist(stuck[i], &direction)
        };
        let matrix = Matrix::from_fn(stuck.len(), stuck.len(), compliance);
        // Connections that stick in a loop hold each other: any share does.
        let Ok(held) = solve(&matrix, &pushed) else { return };
        for (index, torque) in stuck.iter().zip(held) {
            self.friction[*index] = torque;
            self.torques[*index] += torque;
            equations.add_direction(*index, -torque, &mut self.net);
        }
    }

    /// Accelerations of the coordinates from the net torques in `net`, to `out`.
    fn accelerate(&mut self, out: &mut [f64]) {
        let rigid_torque = self.equations.rigid.as_ref().map(|rigid| {
            let Kinematics { speeds, .. } = &self.kinematics;
            let external = rigid.torque(&self.external);
            let damping = &self.equations.ground_damping;
            // Torques inside the line cancel exactly, so they are left out rather than summed.
            let drag: f64 =
                damping.iter().zip(speeds).zip(&rigid.speeds).map(|((d, v), r)| d * v * r).sum();
            (external - drag) / rigid.inertia
        });
        for (net, inertia) in self.net.iter_mut().zip(&self.equations.inertia) {
            *net /= inertia;
        }
        for (index, edge) in self.equations.network.tree.iter().enumerate() {
            out[index] = self.equations.twist(edge.shaft, &self.net);
            let sliding = self.modes.as_ref().and_then(|modes| modes.list[edge.shaft].sliding);
            if sliding == Some(Sliding::Stuck) {
                out[index] = 0.0;
            }
        }
        if let Some(acceleration) = rigid_torque {
            out[self.coordinates() - 1] = acceleration;
        }
    }
}

/// Jumps of the coordinates' rates by the impulses at time `t`, if there are any.
pub(crate) fn rate_jumps(equations: &EquationsOfMotion, t: f64) -> Option<Vec<f64>> {
    let impulses = equations.excitation.impulses_at(t, equations.groups());
    if impulses.iter().all(|impulse| *impulse == 0.0) {
        return None;
    }
    Some(equations.rate_jumps(&impulses))
}

/// Torque of one source at time `t`.
fn source_torque(source: &Source, phase: Phase, active: &Active, t: f64) -> f64 {
    let mut torque = if active.mean { source.mean } else { 0.0 };
    let speed = match source.own_frequency {
        Some(own) => active.own_frequencies.then_some((own, 0.0)),
        None => active.frequency.map(|speed| (speed, active.acceleration)),
    };
    if let Some((speed, acceleration)) = speed {
        let growth = source.growth(speed + acceleration * t);
        let turned = (speed + 0.5 * acceleration * t) * t;
        for harmonic in &source.harmonics {
            let angle = harmonic.order * turned + harmonic.phase_rad;
            torque += growth * harmonic.amplitude_nm * angle.cos();
        }
    }
    if let Some(table) = source.table.as_ref().filter(|_| active.pulses) {
        torque += table.torque(t);
    }
    if let Some(pulse) = source.pulse.as_ref().filter(|_| active.pulses) {
        torque += pulse_torque(pulse, phase, t);
    }
    torque
}

/// A pulse inside its phase is smooth, also a little beyond its ends where the integrator's
/// stages look.
fn pulse_torque(pulse: &Pulse, phase: Phase, t: f64) -> f64 {
    let u = (t - pulse.start_s) / pulse.duration_s;
    match (phase, pulse.shape) {
        (Phase::During, PulseShape::HalfSine) => pulse.peak_nm * (std::f64::consts::PI * u).sin(),
        (Phase::During, PulseShape::Rectangle) => pulse.peak_nm,
        (Phase::During, PulseShape::Ramp) => pulse.peak_nm * u,
        (Phase::After, PulseShape::Ramp) => pulse.peak_nm,
        _ => 0.0,
    }
}

/// Group values (angles or speeds) from the twists of the spanning tree and the mean.
pub(crate) fn placed(
    equations: &EquationsOfMotion,
    twists: &[f64],
    mean: Option<f64>,
    out: &mut [f64],
) {
    equations.group_angles(twists, out);
    if let (Some(rigid), Some(mean)) = (&equations.rigid, mean) {
        let shift = mean - rigid.mean(out);
        for (value, speed) in out.iter_mut().zip(&rigid.speeds) {
            *value += speed * shift;
        }
    }
}

impl System for Motion<'_> {
    fn dimension(&self) -> usize {
        2 * self.coordinates() + if self.with_energy { 2 } else { 0 }
    }

    fn derivative(&mut self, t: f64, state: &[f64], rate: &mut [f64]) {
        let n = self.coordinates();
        self.update(state, self.needs_groups);
        self.load(t);
        self.assemble();
        rate[..n].copy_from_slice(&state[n..2 * n]);
        self.accelerate(&mut rate[n..2 * n]);
        if self.with_energy {
            let Kinematics { speeds, twists, rates, .. } = &self.kinematics;
            rate[2 * n] = self.external.iter().zip(speeds).map(|(q, v)| q * v).sum();
            let shafts = self.equations.connections.iter().zip(twists).zip(rates).enumerate();
            let resistance = |index: usize, c: &crate::Connection, x: f64, v: f64| match &self.modes
            {
                None => c.resistance(x, v),
                Some(modes) => {
                    let damps = modes.list[index].damps;
                    self.friction[index] + if damps { c.damping * v } else { 0.0 }
                }
            };
            let inside: f64 =
                shafts.map(|(index, ((c, x), v))| resistance(index, c, *x, *v) * v).sum();
            let ground = self.equations.ground_damping.iter().zip(speeds);
            let outside: f64 = ground.map(|(d, v)| d * v * v).sum();
            rate[2 * n + 1] = inside + outside;
        }
    }
}

impl Linearised for Motion<'_> {
    /// Only for a motion without energies in its state.
    fn linearised(&mut self, _: f64, state: &[f64], direction: &[f64], out: &mut [f64]) {
        let n = self.coordinates();
        let Kinematics { twists, rates, .. } = self.kinematics(state).clone();
        self.kinematics(direction);
        self.external.fill(0.0);
        self.net.fill(0.0);
        for (index, connection) in self.equations.connections.iter().enumerate() {
            let torque = connection.law.stiffness(twists[index]) * self.kinematics.twists[index]
                + connection.resistance_slope(twists[index], rates[index])
                    * self.kinematics.rates[index];
            self.equations.add_direction(index, -torque, &mut self.net);
        }
        for (group, damping) in self.equations.ground_damping.iter().enumerate() {
            self.net[group] -= damping * self.kinematics.speeds[group];
        }
        out[..n].copy_from_slice(&direction[n..2 * n]);
        self.accelerate(&mut out[n..2 * n]);
        out[2 * n..].fill(0.0);
    }
}
