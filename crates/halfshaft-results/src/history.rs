//! Answer of `simulate` and `shock`: one time history with its metrics.

use serde::{Deserialize, Serialize};

use crate::{Column, Header, Named, Table};

/// Where the energy went; what is left over is the error of the integration.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct EnergyBalance {
    /// Kinetic and potential energy at the start, J.
    #[serde(deserialize_with = "crate::number::read")]
    pub initial: f64,
    /// Kinetic and potential energy at the end, J.
    #[serde(deserialize_with = "crate::number::read")]
    pub stored: f64,
    /// Work done by the external torques, J.
    #[serde(deserialize_with = "crate::number::read")]
    pub work: f64,
    /// Heat in the dampers, J.
    #[serde(deserialize_with = "crate::number::read")]
    pub dissipated: f64,
    /// `initial + work - dissipated - stored`, J.
    #[serde(deserialize_with = "crate::number::read")]
    pub residual: f64,
    /// The residual over the energy that was turned over.
    #[serde(deserialize_with = "crate::number::read")]
    pub relative_residual: f64,
}

/// Extremes of one channel over the recorded time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ChannelMetrics {
    /// Smallest value.
    #[serde(deserialize_with = "crate::number::read")]
    pub minimum: f64,
    /// Largest value.
    #[serde(deserialize_with = "crate::number::read")]
    pub maximum: f64,
    /// Half of peak to peak.
    #[serde(deserialize_with = "crate::number::read")]
    pub amplitude: f64,
    /// Mean over time.
    #[serde(deserialize_with = "crate::number::read")]
    pub mean: f64,
}

/// How a shaft takes a disturbance.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ShaftMetrics {
    /// Twist at the first turning point after the disturbance, less the final twist, rad; `None`
    /// where it does not turn in the time simulated.
    pub first_peak: Option<f64>,
    /// When, s.
    pub first_peak_time: Option<f64>,
    /// Rate of twist at its first turning point, rad/s.
    pub first_rate_peak: Option<f64>,
    /// When, s.
    pub first_rate_peak_time: Option<f64>,
    /// Torque of largest magnitude, with its sign, N·m.
    #[serde(deserialize_with = "crate::number::read")]
    pub peak_torque: f64,
    /// When, s.
    #[serde(deserialize_with = "crate::number::read")]
    pub peak_torque_time: f64,
    /// Torque at the state before the disturbance, N·m.
    #[serde(deserialize_with = "crate::number::read")]
    pub static_torque: f64,
    /// Peak torque over static torque; `None` where the shaft was unloaded.
    pub dynamic_factor: Option<f64>,
    /// Torque when all has settled, N·m; `None` where nothing settles.
    #[serde(default)]
    pub final_torque: Option<f64>,
    /// First peak beyond the final twist over the way to that, from the twist before.
    #[serde(default)]
    pub overshoot: Option<f64>,
    /// When the twist stays within 5 % of its largest peak for good, s; `None` where it does
    /// not settle in the time simulated.
    pub settling_time: Option<f64>,
    /// Frequency of the free oscillation, rad/s, from its turning points; `None` where there
    /// are too few.
    pub oscillation_frequency: Option<f64>,
    /// Rate at which the oscillation decays, 1/s.
    pub decay_rate: Option<f64>,
    /// Decay rate over frequency of oscillation, as a damping ratio.
    pub damping_ratio: Option<f64>,
}

/// How unevenly and how roughly a node turns over the recorded time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct NodeMetrics {
    /// Largest less smallest speed over the magnitude of the mean; `None` where it does not turn
    /// one way all the time.
    pub speed_irregularity: Option<f64>,
    /// Acceleration of largest magnitude, with its sign, rad/s².
    #[serde(deserialize_with = "crate::number::read")]
    pub peak_acceleration: f64,
    /// When, s.
    #[serde(deserialize_with = "crate::number::read")]
    pub peak_acceleration_time: f64,
    /// Rate of acceleration of largest magnitude where that moves without a jump, rad/s³: its mean over a
    /// sixth of a step of the integration.
    #[serde(deserialize_with = "crate::number::read")]
    pub peak_jerk: f64,
    /// When, s.
    #[serde(deserialize_with = "crate::number::read")]
    pub peak_jerk_time: f64,
}

/// Amplitudes of one channel over orders and excitation speed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OrderMap {
    /// The channel.
    pub channel: String,
    /// Unit of the amplitudes.
    pub unit: String,
    /// Revolutions of a block, under Hann's window; three quarters of them are shared with the next
    /// block.
    pub revolutions: usize,
    /// Excitation speed in the middle of each block, rad/s.
    #[serde(deserialize_with = "crate::number::read")]
    pub frequency: Vec<f64>,
    /// Orders, cycles per revolution of the excitation.
    #[serde(deserialize_with = "crate::number::read")]
    pub order: Vec<f64>,
    /// Amplitudes, a row a speed.
    #[serde(deserialize_with = "crate::number::read")]
    pub amplitude: Vec<Vec<f64>>,
    /// Orders worth a curve of their own: excited ones and the strongest others.
    #[serde(deserialize_with = "crate::number::read")]
    pub cuts: Vec<f64>,
}

impl OrderMap {
    /// Amplitudes over the speed at the order nearest to the given one.
    pub fn cut(&self, order: f64) -> Vec<f64> {
        let away = |at: &usize| (self.order[*at] - order).abs();
        let nearest = (0..self.order.len()).min_by(|a, b| away(a).total_cmp(&away(b)));
        let of = |row: &Vec<f64>| nearest.and_then(|at| row.get(at)).copied().unwrap_or(f64::NAN);
        self.amplitude.iter().map(of).collect()
    }
}

/// An integrator with the time from which it was used.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct IntegratorUse {
    /// Name of the method.
    pub method: String,
    /// From when on, s.
    #[serde(deserialize_with = "crate::number::read")]
    pub from: f64,
    /// Why it was chosen.
    pub why: String,
}

/// A contact, a stage, a stick or a slip.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HistoryEvent {
    /// When, s.
    #[serde(deserialize_with = "crate::number::read")]
    pub time: f64,
    /// Name of the shaft or gear.
    pub element: String,
    /// `contact`, `separation`, `stage`, `stick` or `slip`.
    pub kind: String,
    /// What happens, in words, with the element.
    pub text: String,
    /// Twist, rad.
    #[serde(deserialize_with = "crate::number::read")]
    pub twist: f64,
    /// Rate of twist, rad/s: the impact speed of a contact.
    #[serde(deserialize_with = "crate::number::read")]
    pub twist_rate: f64,
    /// Of a contact: the kinetic energy in the rate of twist, J.
    #[serde(default)]
    pub energy: Option<f64>,
}

/// What happened at one connection over the recorded time.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ConnectionEvents {
    /// Contacts.
    pub contacts: u64,
    /// Contacts lost.
    pub separations: u64,
    /// Contacts on the other side than the one before.
    pub lash_crossings: u64,
    /// Changes from one stage to another.
    pub stage_changes: u64,
    /// How often dry friction came to stick.
    pub sticks: u64,
    /// How often it broke away or turned its direction.
    pub slips: u64,
    /// Largest rate of twist at a contact, rad/s.
    #[serde(deserialize_with = "crate::number::read")]
    pub hardest_impact_speed: f64,
    /// Largest energy at a contact, J.
    #[serde(deserialize_with = "crate::number::read")]
    pub hardest_impact_energy: f64,
    /// Energies at all contacts together, J.
    #[serde(deserialize_with = "crate::number::read")]
    pub impact_energy: f64,
    /// Part of the time in free play.
    #[serde(deserialize_with = "crate::number::read")]
    pub free_share: f64,
    /// Part of the time in which dry friction sticks.
    #[serde(deserialize_with = "crate::number::read")]
    pub stuck_share: f64,
}

/// Metrics of a time history.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct HistoryMetrics {
    /// How each shaft takes the disturbance; only for `shock`.
    pub shafts: Named<ShaftMetrics>,
    /// Extremes of every channel over the recorded time.
    pub channels: Named<ChannelMetrics>,
    /// Energy balance of the whole run, where the method is an integration.
    pub energy_balance: Option<EnergyBalance>,
    /// How unevenly and roughly each node turns.
    #[serde(default, skip_serializing_if = "Named::is_empty")]
    pub nodes: Named<NodeMetrics>,
    /// What happened at each connection with free play, stages or dry friction.
    #[serde(default, skip_serializing_if = "Named::is_empty")]
    pub events: Named<ConnectionEvents>,
    /// The integrators that took the steps.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub integrators: Vec<IntegratorUse>,
    /// Accepted steps of the integration.
    pub steps: u64,
    /// Evaluations of the equations of motion.
    pub evaluations: u64,
}

/// One method of answering a shock, beside the others.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MethodRow {
    /// Name of the method, with its order where it has one.
    pub method: String,
    /// What it solves.
    pub equation: String,
    /// First peak of the disturbance, rad.
    pub first_peak: Option<f64>,
    /// When, s.
    pub first_peak_time: Option<f64>,
    /// First peak of its rate, rad/s.
    pub first_rate_peak: Option<f64>,
    /// Frequency of the free oscillation, rad/s.
    pub oscillation_frequency: Option<f64>,
    /// Decay rate, 1/s.
    pub decay_rate: Option<f64>,
    /// First peak over that of the reference, less 1.
    pub first_peak_error: Option<f64>,
    /// First peak of the rate over that of the reference, less 1.
    pub first_rate_peak_error: Option<f64>,
    /// Largest difference to the reference over the whole history, over its first peak.
    pub largest_difference: Option<f64>,
    /// Phase behind (negative) or ahead of the reference at 2 s, rad.
    pub phase_error: Option<f64>,
    /// Name of the method that the errors are against.
    pub reference: Option<String>,
}

/// What `shock` says beyond its history.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ShockDetails {
    /// Name of the method.
    pub method: String,
    /// The shaft whose twist is disturbed.
    pub shaft: String,
    /// Meaning of the history's variables, as a sentence.
    pub variable: String,
    /// Twist of each shaft before the disturbance, rad.
    #[serde(deserialize_with = "crate::number::read")]
    pub equilibrium: Named<f64>,
    /// Coefficients of the equation solved, where it is a single one: `omega_0`, `alpha_0`,
    /// `mu`, `gamma`.
    #[serde(deserialize_with = "crate::number::read")]
    pub coefficients: Named<f64>,
    /// All methods side by side, where that was asked.
    pub comparison: Vec<MethodRow>,
    /// Time histories of all methods, where that was asked: `time`, then one column a method
    /// with the twist less its value before the disturbance.
    pub comparison_history: Option<Table>,
}

/// Answer of `simulate` and `shock`: a table, first column `time`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HistoryResult {
    /// What every result says.
    #[serde(flatten)]
    pub header: Header,
    /// Columns: `time`, then the channels.
    pub columns: Vec<Column>,
    /// Metrics.
    pub metrics: HistoryMetrics,
    /// Contacts, stages, stick and slip in order of time, up to ten thousand.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub events: Vec<HistoryEvent>,
    /// Spectra over the orders of the excitation, where a speed was given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub orders: Option<Box<OrderMap>>,
    /// State whenever a revolution of the excitation begins: `time`, then twist and rate of each
    /// connection.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub section: Option<Table>,
    /// What `shock` says beyond its history.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shock: Option<Box<ShockDetails>>,
}

impl HistoryResult {
    /// The history as a table.
    pub fn table(&self) -> Table {
        Table::new(self.columns.clone())
    }

    /// Values of the column of that name; empty where there is none.
    pub fn values(&self, name: &str) -> &[f64] {
        self.columns
            .iter()
            .find(|column| column.name == name)
            .map_or(&[], |column| column.values.as_slice())
    }
}
