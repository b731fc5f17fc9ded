//! Answer of `forced`.

use serde::{Deserialize, Serialize};

use crate::{Gear, Header, Table};

/// The largest value of a channel over the speeds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ForcedPeak {
    /// Channel, e.g. `half-shaft.torque`.
    pub channel: String,
    /// Half of the range over a period.
    #[serde(deserialize_with = "crate::number::read")]
    pub amplitude: f64,
    /// Unit of the amplitude.
    pub unit: String,
    /// Excitation speed Ω, rad/s.
    #[serde(deserialize_with = "crate::number::read")]
    pub speed: f64,
    /// The order with the largest part in it.
    #[serde(deserialize_with = "crate::number::read")]
    pub order: f64,
    /// Amplitude of that order alone.
    #[serde(deserialize_with = "crate::number::read")]
    pub order_amplitude: f64,
}

/// Heat in a damper at its worst speed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ForcedHeat {
    /// Shaft, mesh, damper or node.
    pub name: String,
    /// Mean power over a period, W.
    #[serde(deserialize_with = "crate::number::read")]
    pub power: f64,
    /// Excitation speed Ω, rad/s.
    #[serde(deserialize_with = "crate::number::read")]
    pub speed: f64,
}

/// Linear vibration in one gear.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ForcedGear {
    /// The gear.
    #[serde(flatten)]
    pub gear: Gear,
    /// Over the speeds `frequency` (rad/s): `<channel>.amplitude`, half of the range of the sum of all
    /// orders over a period; `<channel>.order<n>` and `.order<n>.phase`, modulus and phase of order n;
    /// `<element>.heat`, mean power, W. Channels are `<shaft>.torque`, `<shaft>.twist`,
    /// `<node>.speed` and `<node>.acceleration`.
    pub table: Table,
    /// The largest torque of each shaft and the largest acceleration of each node that is told.
    pub peaks: Vec<ForcedPeak>,
    /// What dampers turn into heat.
    pub heat: Vec<ForcedHeat>,
}

/// An order of an engine's cylinder.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EngineOrders {
    /// Name of the engine.
    pub engine: String,
    /// Crank angles at which the cylinders fire, rad.
    #[serde(deserialize_with = "crate::number::read")]
    pub firing_angles: Vec<f64>,
    /// Orders of one cylinder over its own crank angle α: `order`, and `pressure`, `gas` and `mass`
    /// as modulus with `.phase`, of `modulus · cos(order α + phase)`; `mass` at Ω = 1000 rpm.
    pub table: Table,
}

/// Answer of `forced`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ForcedResult {
    /// What every result says.
    #[serde(flatten)]
    pub header: Header,
    /// Orders that act, ascending.
    #[serde(deserialize_with = "crate::number::read")]
    pub orders: Vec<f64>,
    /// Orders of engines.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub engines: Vec<EngineOrders>,
    /// The line as it is, or each gear of a gearbox that lists its ratios.
    pub gears: Vec<ForcedGear>,
}
