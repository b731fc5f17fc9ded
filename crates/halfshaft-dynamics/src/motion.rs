//! The equations of motion as a first-order system for the integrators.
//!
//! Coordinates are the twists `x` of the spanning tree's shafts and, for a free line, the
//! mean angle `s`. So a line that turns a thousand times loses no digit of its twists, and
//! tolerances mean twists. State: `[x.., s | x'.., s' | work, heat]`, the last two where
//! the energy is kept.

use halfshaft_numerics::ode::{Linearised, System};

use crate::equations::EquationsOfMotion;
use crate::excitation::{Active, Excitation, Source};
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
        let Kinematics { speeds, twists, rates, .. } = &self.kinematics;
        for (index, connection) in self.equations.connections.iter().enumerate() {
            let torque = connection.law.torque(twists[index])
                + connection.resistance(twists[index], rates[index]);
            self.equations.add_direction(index, -torque, &mut self.net);
        }
        for (group, damping) in self.equations.ground_damping.iter().enumerate() {
            self.net[group] -= damping * speeds[group];
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
    let speeds: Vec<f64> = impulses.iter().zip(&equations.inertia).map(|(p, m)| p / m).collect();
    let tree = equations.network.tree.iter();
    let mean = equations.rigid.as_ref().map(|rigid| rigid.mean(&speeds));
    Some(tree.map(|edge| equations.twist(edge.shaft, &speeds)).chain(mean).collect())
}

/// Torque of one source at time `t`.
fn source_torque(source: &Source, phase: Phase, active: &Active, t: f64) -> f64 {
    let mut torque = if active.mean { source.mean } else { 0.0 };
    let speed = match source.own_frequency {
        Some(own) => active.own_frequencies.then_some(own),
        None => active.frequency,
    };
    if let Some(speed) = speed {
        let growth = source.growth(speed);
        for harmonic in &source.harmonics {
            let angle = harmonic.order * speed * t + harmonic.phase_rad;
            torque += growth * harmonic.amplitude_nm * angle.cos();
        }
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
            let shafts = self.equations.connections.iter().zip(twists).zip(rates);
            let inside: f64 = shafts.map(|((c, x), v)| c.resistance(*x, *v) * v).sum();
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
