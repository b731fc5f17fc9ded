//! External torques over time, as torques on the groups.

use halfshaft_model::elements::{Harmonic, MeanTorque, Pulse, PulseShape, TorqueTable};
use halfshaft_model::{Driveline, Topology};

use crate::engine::{self, EngineTorque};

/// One external torque of the line.
#[derive(Clone, Debug, PartialEq)]
pub struct Source {
    /// Name of the torque.
    pub name: String,
    /// Group that it acts on.
    pub group: usize,
    /// Speed of its node over the group's: a torque `T` on the node is `ratio · T` on the
    /// group.
    pub ratio: f64,
    /// Mean torque on the node, N·m; follows from the others where it balances them.
    pub mean: f64,
    /// Whether the mean follows from the others.
    pub balances: bool,
    /// Harmonics with an amplitude.
    pub harmonics: Vec<Harmonic>,
    /// A speed of its own in place of Ω, rad/s.
    pub own_frequency: Option<f64>,
    /// A part that acts once.
    pub pulse: Option<Pulse>,
    /// Torque over time, added while pulses act.
    pub table: Option<TorqueTable>,
    /// Power of the speed with which the harmonics grow; 0 where they do not.
    pub speed_power: f64,
    /// Speed at which the harmonics have the stated amplitudes, rad/s.
    pub reference_speed: f64,
}

impl Source {
    /// Factor on the harmonics at excitation speed `frequency` (rad/s):
    /// `(frequency / reference)^power`.
    #[inline]
    pub fn growth(&self, frequency: f64) -> f64 {
        if self.speed_power == 0.0 {
            return 1.0;
        }
        (frequency / self.reference_speed).abs().powf(self.speed_power)
    }

    /// Derivative of [`Source::growth`] by the speed, s/rad.
    #[inline]
    pub fn growth_slope(&self, frequency: f64) -> f64 {
        if self.speed_power == 0.0 {
            return 0.0;
        }
        let part = (frequency / self.reference_speed).abs().powf(self.speed_power - 1.0);
        self.speed_power * part / self.reference_speed * frequency.signum()
    }
}

/// Which parts of the torques act.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Active {
    /// Mean torques.
    pub mean: bool,
    /// Excitation speed Ω (rad/s) for harmonics of an order; `None` silences those. At time zero, where
    /// the speed moves.
    pub frequency: Option<f64>,
    /// Rate at which Ω moves, rad/s²: a run-up or run-down.
    pub acceleration: f64,
    /// Harmonics with a frequency of their own.
    pub own_frequencies: bool,
    /// Pulses.
    pub pulses: bool,
}

impl Active {
    /// Everything, at excitation speed `frequency`.
    pub fn all(frequency: Option<f64>) -> Self {
        Self { mean: true, frequency, own_frequencies: true, pulses: true, acceleration: 0.0 }
    }

    /// Mean torques and pulses only.
    pub fn shock() -> Self {
        Self { mean: true, pulses: true, ..Self::default() }
    }

    /// Mean torques and harmonics of an order, as for periodic responses.
    pub fn periodic(frequency: f64) -> Self {
        Self { mean: true, frequency: Some(frequency), ..Self::default() }
    }
}

/// All external torques of a line.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Excitation {
    /// One entry a torque, in file order, and then those of engines.
    pub sources: Vec<Source>,
}

impl Excitation {
    pub(crate) fn new(line: &Driveline, topology: &Topology) -> Self {
        let source = |torque: &halfshaft_model::elements::Torque| {
            let (group, ratio) = topology.place(&torque.on)?;
            let (mean, balances) = match torque.mean {
                MeanTorque::Value(value) => (value, false),
                MeanTorque::Balance => (0.0, true),
            };
            let loud = torque.harmonics.iter().filter(|harmonic| harmonic.amplitude_nm != 0.0);
            Some(Source {
                name: torque.name.clone(),
                group,
                ratio,
                mean,
                balances,
                harmonics: loud.copied().collect(),
                own_frequency: torque.frequency_rad_s,
                pulse: torque.pulse.clone(),
                table: torque.table.clone(),
                speed_power: torque.speed_power.unwrap_or(0.0),
                reference_speed: torque.reference_speed_rad_s.unwrap_or(1.0),
            })
        };
        let engines = line.engines().iter().flat_map(engine::torques);
        let of_engines = engines.filter_map(|torque| of_engine(torque, topology));
        Self { sources: line.torques().iter().filter_map(source).chain(of_engines).collect() }
    }

    /// Mean torques on the groups, N·m.
    pub fn mean(&self, groups: usize) -> Vec<f64> {
        let mut torques = vec![0.0; groups];
        for source in &self.sources {
            torques[source.group] += source.ratio * source.mean;
        }
        torques
    }

    /// Complex amplitude (real, imaginary) on each group of the torques of order `order` at
    /// excitation speed `frequency` Ω (rad/s): `Re[(a + i b) exp(i order Ω t)]`, N·m.
    pub fn harmonic(&self, groups: usize, order: f64, frequency: f64) -> Vec<(f64, f64)> {
        self.weighted(groups, order, |source| source.growth(frequency))
    }

    /// Derivative of [`Excitation::harmonic`] by the excitation speed, N·m·s/rad.
    pub fn harmonic_slope(&self, groups: usize, order: f64, frequency: f64) -> Vec<(f64, f64)> {
        self.weighted(groups, order, |source| source.growth_slope(frequency))
    }

    /// The first torque of an order whose amplitudes grow with the excitation speed.
    pub fn growing(&self) -> Option<&Source> {
        self.sources.iter().find(|source| {
            source.speed_power != 0.0
                && source.own_frequency.is_none()
                && !source.harmonics.is_empty()
        })
    }

    /// Torques of one order on the groups, each source times a factor of its own.
    fn weighted(
        &self,
        groups: usize,
        order: f64,
        factor: impl Fn(&Source) -> f64,
    ) -> Vec<(f64, f64)> {
        let mut torques = vec![(0.0, 0.0); groups];
        for source in self.sources.iter().filter(|source| source.own_frequency.is_none()) {
            let factor = factor(source);
            for harmonic in source.harmonics.iter().filter(|h| h.order == order) {
                let (sin, cos) = harmonic.phase_rad.sin_cos();
                let amplitude = source.ratio * harmonic.amplitude_nm * factor;
                torques[source.group].0 += amplitude * cos;
                torques[source.group].1 += amplitude * sin;
            }
        }
        torques
    }

    /// Orders at which the line is excited, ascending.
    pub fn orders(&self) -> Vec<f64> {
        let free = self.sources.iter().filter(|source| source.own_frequency.is_none());
        let mut orders: Vec<f64> =
            free.flat_map(|source| source.harmonics.iter().map(|h| h.order)).collect();
        orders.sort_by(f64::total_cmp);
        orders.dedup();
        orders
    }

    /// Whether a pulse or a table leaves a torque behind.
    pub fn has_ramp(&self) -> bool {
        if self.sources.iter().any(|source| source.table.is_some()) {
            return true;
        }
        let pulses = self.sources.iter().filter_map(|source| source.pulse.as_ref());
        pulses.into_iter().any(|pulse| pulse.shape == PulseShape::Ramp)
    }

    /// Times at which pulses begin or end or a table has a point, ascending, each once.
    pub fn breaks(&self) -> Vec<f64> {
        let pulses = self.sources.iter().filter_map(|source| source.pulse.as_ref());
        let mut times: Vec<f64> = pulses.flat_map(|pulse| [pulse.start_s, pulse.end_s()]).collect();
        let tables = self.sources.iter().filter_map(|source| source.table.as_ref());
        times.extend(tables.flat_map(|table| table.time_s.iter().copied()));
        times.sort_by(f64::total_cmp);
        times.dedup();
        times
    }

    /// Angular impulses on the groups that come all at once at time `t`, N·m·s.
    pub fn impulses_at(&self, t: f64, groups: usize) -> Vec<f64> {
        let mut impulses = vec![0.0; groups];
        for source in &self.sources {
            if let Some(pulse) = &source.pulse
                && pulse.shape == PulseShape::Impulse
                && pulse.start_s == t
            {
                impulses[source.group] += source.ratio * pulse.impulse_nm_s;
            }
        }
        impulses
    }

    /// Sum of the magnitudes of all torques on the groups: the scale of the loading, N·m.
    pub fn scale(&self) -> f64 {
        let of = |source: &Source| {
            let harmonics: f64 = source.harmonics.iter().map(|h| h.amplitude_nm.abs()).sum();
            let pulse = source.pulse.as_ref().map_or(0.0, |pulse| pulse.peak_nm.abs());
            let table = source.table.as_ref().map_or(0.0, TorqueTable::largest);
            source.ratio.abs() * (source.mean.abs() + harmonics + pulse + table)
        };
        self.sources.iter().map(of).sum()
    }
}

/// A torque of an engine as a source.
fn of_engine(torque: EngineTorque, topology: &Topology) -> Option<Source> {
    let (group, ratio) = topology.place(&torque.node)?;
    Some(Source {
        name: torque.name,
        group,
        ratio,
        mean: torque.mean,
        balances: false,
        harmonics: torque.harmonics,
        own_frequency: None,
        pulse: None,
        table: None,
        speed_power: if torque.grows { 2.0 } else { 0.0 },
        reference_speed: engine::REFERENCE_SPEED,
    })
}
