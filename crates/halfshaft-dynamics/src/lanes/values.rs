//! The values of a trajectory's parameters.

use halfshaft_model::elements::PulseShape;
use halfshaft_numerics::ensemble::{Parameters, Trajectory};

use super::LaneError;
use super::build::{LaneLine, PIECE_HEAD, Shaft, Tone};
use crate::equations::EquationsOfMotion;
use crate::excitation::{Active, Source};
use crate::motion::{placed, rate_jumps};

/// What torques on the groups do to the coordinates, and coordinates to the groups.
pub(super) struct Factors {
    /// Acceleration of each coordinate by a unit torque on each group: row by row.
    accelerations: Vec<Vec<f64>>,
    /// Angle of each group for a unit of each coordinate: coordinate by coordinate.
    angles: Vec<Vec<f64>>,
    /// Whether a coordinate is the mean angle, which torques inside the line do not change.
    mean: Option<usize>,
}

impl Factors {
    pub(super) fn new(equations: &EquationsOfMotion) -> Self {
        let count = equations.groups();
        let tree = &equations.network.tree;
        let mut accelerations = vec![vec![0.0; count]; count];
        let mut unit = vec![0.0; count];
        for group in 0..count {
            unit.fill(0.0);
            unit[group] = 1.0 / equations.inertia[group];
            for (row, edge) in tree.iter().enumerate() {
                accelerations[row][group] = equations.twist(edge.shaft, &unit);
            }
            if let Some(rigid) = &equations.rigid {
                accelerations[count - 1][group] = rigid.speeds[group] / rigid.inertia;
            }
        }
        let mut angles = vec![vec![0.0; count]; count];
        for (coordinate, angles) in angles.iter_mut().enumerate() {
            let mut twists = vec![0.0; tree.len()];
            if let Some(twist) = twists.get_mut(coordinate) {
                *twist = 1.0;
            }
            let mean = if coordinate < tree.len() { 0.0 } else { 1.0 };
            placed(equations, &twists, Some(mean), angles);
        }
        let mean = equations.rigid.as_ref().map(|_| count - 1);
        Self { accelerations, angles, mean }
    }

    /// Acceleration of a coordinate by a unit torque of a connection.
    pub(super) fn torque(&self, equations: &EquationsOfMotion, row: usize, index: usize) -> f64 {
        if self.mean == Some(row) {
            return 0.0;
        }
        let mut groups = vec![0.0; equations.groups()];
        equations.add_direction(index, -1.0, &mut groups);
        self.accelerations[row].iter().zip(&groups).map(|(a, torque)| a * torque).sum()
    }

    /// Acceleration of a coordinate by a unit torque of a source.
    pub(super) fn source(&self, equations: &EquationsOfMotion, row: usize, source: usize) -> f64 {
        let Source { group, ratio, .. } = &equations.excitation.sources[source];
        self.accelerations[row][*group] * ratio
    }

    /// Acceleration of a coordinate by a unit rate of a coordinate, through dampers to ground.
    pub(super) fn drag(&self, equations: &EquationsOfMotion, row: usize, of: usize) -> f64 {
        let groups = equations.ground_damping.iter().zip(&self.angles[of]);
        let of_group = |(a, (damping, angle)): (&f64, (&f64, &f64))| -a * damping * angle;
        self.accelerations[row].iter().zip(groups).map(of_group).sum()
    }

    /// Twist of a connection for a unit of a coordinate.
    fn share(&self, equations: &EquationsOfMotion, index: usize, coordinate: usize) -> f64 {
        equations.twist(index, &self.angles[coordinate])
    }
}

impl LaneLine {
    /// The parameters of a line of this build under the active torques, with the pulses as they are
    /// from time `t` on, for motions that are then put on their pieces by [`LaneLine::settle`].
    ///
    /// # Errors
    /// [`LaneError::OtherBuild`].
    pub fn values(
        &self,
        equations: &EquationsOfMotion,
        active: &Active,
        t: f64,
    ) -> Result<Vec<f64>, LaneError> {
        self.check(equations)?;
        let factors = Factors::new(equations);
        let mut values = vec![0.0; self.parameters];
        for (index, shaft) in self.shafts.iter().enumerate() {
            for (coordinate, place) in &shaft.shares {
                values[*place] = factors.share(equations, index, *coordinate);
            }
            write_pieces(equations, index, shaft, &mut values);
            let friction = &equations.connections[index].friction;
            if let (Some([torque, speed]), Some(friction)) = (shaft.friction, friction) {
                values[torque] = friction.torque_nm;
                values[speed] = 1.0 / friction.speed_rad_s;
            }
            go_to(shaft, 0, &mut values.as_mut_slice());
        }
        for row in 0..self.rows.len() {
            for (index, place) in &self.rows[row].torques {
                values[*place] = factors.torque(equations, row, *index);
            }
            for (of, place) in &self.rows[row].drags {
                values[*place] = factors.drag(equations, row, *of);
            }
        }
        self.write_sources(equations, &factors, active, t, &mut values);
        Ok(values)
    }

    /// Puts every connection on the piece of its law that its twist is on, or goes to.
    pub fn settle(&self, state: &[f64], values: &mut [f64]) {
        let count = self.rows.len();
        for shaft in self.shafts.iter().filter(|shaft| shaft.pieces > 1) {
            let of = |part: &[f64], values: &[f64]| match shaft.coordinate {
                Some(coordinate) => part[coordinate],
                None => shaft.shares.iter().map(|(of, place)| part[*of] * values[*place]).sum(),
            };
            let (x, v) = (of(&state[..count], values), of(&state[count..2 * count], values));
            let to = |piece: usize| values[shaft.table + piece * shaft.stride()];
            let mut piece = (0..shaft.pieces - 1).find(|piece| to(*piece) >= x);
            if let Some(at) = piece.filter(|at| to(*at) == x && v > 0.0) {
                piece = Some(at + 1);
            }
            go_to(shaft, piece.unwrap_or(shaft.pieces - 1), &mut &mut *values);
        }
    }

    /// Carries a trajectory over a break time of the excitation
    /// ([`Excitation::breaks`](crate::Excitation::breaks)): pulses begin and end, impulses change the
    /// rates.
    ///
    /// # Errors
    /// [`LaneError::OtherBuild`].
    pub fn over_break(
        &self,
        equations: &EquationsOfMotion,
        active: &Active,
        trajectory: &mut Trajectory<'_>,
    ) -> Result<(), LaneError> {
        self.check(equations)?;
        let t = trajectory.time;
        let factors = Factors::new(equations);
        self.write_sources(equations, &factors, active, t, trajectory.parameters);
        let count = self.rows.len();
        if active.pulses
            && let Some(jumps) = rate_jumps(equations, t)
        {
            trajectory.state[count..].iter_mut().zip(jumps).for_each(|(v, jump)| *v += jump);
        }
        self.settle(trajectory.state, trajectory.parameters);
        Ok(())
    }

    /// Constants, slopes and tones.
    fn write_sources(
        &self,
        equations: &EquationsOfMotion,
        factors: &Factors,
        active: &Active,
        t: f64,
        values: &mut [f64],
    ) {
        let sources = &equations.excitation.sources;
        let steady: Vec<[f64; 2]> =
            sources.iter().map(|source| steady(source, active, t)).collect();
        for (row, places) in self.rows.iter().enumerate() {
            let sum = |part: usize| -> f64 {
                let of = |(source, torque): (usize, &[f64; 2])| {
                    factors.source(equations, row, source) * torque[part]
                };
                steady.iter().enumerate().map(of).sum()
            };
            values[places.constant] = sum(0);
            values[places.slope] = sum(1);
            for (index, place) in &places.tones {
                let tone = &self.tones[*index];
                let torque = amplitude(&sources[tone.source], tone, active, t);
                values[*place] = torque * factors.source(equations, row, tone.source);
            }
        }
        for tone in &self.tones {
            let (speed, phase) = cosine(&sources[tone.source], tone, active);
            values[tone.speed] = speed;
            values[tone.phase] = phase;
        }
    }
}

/// The table of all pieces of a connection's law.
fn write_pieces(equations: &EquationsOfMotion, index: usize, shaft: &Shaft, values: &mut [f64]) {
    let connection = &equations.connections[index];
    for (piece, entry) in connection.law.pieces().list().iter().enumerate() {
        let inside = match (entry.from.is_finite(), entry.to.is_finite()) {
            (true, true) => f64::midpoint(entry.from, entry.to),
            (true, false) => entry.from + entry.from.abs().max(1.0),
            (false, true) => entry.to - entry.to.abs().max(1.0),
            (false, false) => 0.0,
        };
        let acts = connection.damps_in_gap || connection.law.in_contact(inside);
        let at = shaft.table + piece * shaft.stride();
        values[at] = entry.to;
        values[at + 1] = entry.origin;
        values[at + 2] = if acts { connection.damping } else { 0.0 };
        let coefficients = entry.torque.coefficients();
        values[at + PIECE_HEAD..][..coefficients.len()].copy_from_slice(coefficients);
    }
}

/// Puts a connection on a piece.
pub(super) fn go_to(shaft: &Shaft, piece: usize, values: &mut dyn Parameters) {
    let at = shaft.table + piece * shaft.stride();
    let (to, origin) = (values.get(at), values.get(at + 1));
    let from = if piece == 0 { f64::NEG_INFINITY } else { values.get(at - shaft.stride()) };
    values.set(shaft.piece, piece as f64);
    values.set(shaft.ends[0], from - origin);
    values.set(shaft.ends[1], to - origin);
    values.set(shaft.origin, origin);
    values.set(shaft.damping, values.get(at + 2));
    for power in 0..=shaft.degree {
        values.set(shaft.law + power, values.get(at + PIECE_HEAD + power));
    }
}

/// Constant and slope over time of what a source gives beside its tones.
fn steady(source: &Source, active: &Active, t: f64) -> [f64; 2] {
    let mean = if active.mean { source.mean } else { 0.0 };
    let Some(pulse) = source.pulse.as_ref().filter(|_| active.pulses) else { return [mean, 0.0] };
    let (begun, ended) = (t >= pulse.start_s, t >= pulse.end_s());
    let slope = pulse.peak_nm / pulse.duration_s;
    match pulse.shape {
        PulseShape::Rectangle if begun && !ended => [mean + pulse.peak_nm, 0.0],
        PulseShape::Ramp if ended => [mean + pulse.peak_nm, 0.0],
        PulseShape::Ramp if begun => [mean - slope * pulse.start_s, slope],
        _ => [mean, 0.0],
    }
}

/// Speed of a source's harmonics, if they act.
fn own_speed(source: &Source, active: &Active) -> Option<f64> {
    match source.own_frequency {
        Some(own) => active.own_frequencies.then_some(own),
        None => active.frequency,
    }
}

/// Torque of a tone.
fn amplitude(source: &Source, tone: &Tone, active: &Active, t: f64) -> f64 {
    match tone.harmonic.map(|index| &source.harmonics[index]) {
        Some(harmonic) => own_speed(source, active)
            .map_or(0.0, |speed| source.growth(speed) * harmonic.amplitude_nm),
        None => {
            let acts = |pulse: &halfshaft_model::elements::Pulse| {
                active.pulses && t >= pulse.start_s && t < pulse.end_s()
            };
            source.pulse.as_ref().filter(|pulse| acts(pulse)).map_or(0.0, |pulse| pulse.peak_nm)
        }
    }
}

/// Speed and phase of a tone.
fn cosine(source: &Source, tone: &Tone, active: &Active) -> (f64, f64) {
    use std::f64::consts::{FRAC_PI_2, PI};
    match (tone.harmonic.map(|index| &source.harmonics[index]), &source.pulse) {
        (Some(harmonic), _) => {
            let speed = own_speed(source, active).unwrap_or(0.0);
            (harmonic.order * speed, harmonic.phase_rad)
        }
        (None, Some(pulse)) => {
            let speed = PI / pulse.duration_s;
            (speed, -speed * pulse.start_s - FRAC_PI_2)
        }
        (None, None) => (0.0, 0.0),
    }
}
