//! Answer of `campbell`.

use serde::{Deserialize, Serialize};

use crate::{Column, Gear, Header, Table};

/// A speed at which an order of the excitation meets a natural frequency.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CriticalSpeed {
    /// Number of the elastic mode, from 1.
    pub mode: usize,
    /// Order that meets it.
    #[serde(deserialize_with = "crate::number::read")]
    pub order: f64,
    /// Excitation speed Ω, rad/s: natural frequency over order.
    #[serde(deserialize_with = "crate::number::read")]
    pub speed: f64,
    /// Natural frequency, rad/s.
    #[serde(deserialize_with = "crate::number::read")]
    pub frequency: f64,
    /// Distance from the operating range over its nearer end: 0 inside; `None` without a range.
    #[serde(default)]
    pub margin: Option<f64>,
    /// The shaft that the mode would load most there.
    #[serde(default)]
    pub shaft: Option<String>,
    /// Amplitude of that shaft's torque by this order and mode alone, N·m; `None` without damping
    /// or excitation.
    #[serde(default)]
    pub torque: Option<f64>,
}

/// Natural frequencies and critical speeds in one gear.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CampbellGear {
    /// The gear.
    #[serde(flatten)]
    pub gear: Gear,
    /// Undamped natural frequencies of the elastic modes, ascending, rad/s.
    #[serde(deserialize_with = "crate::number::read")]
    pub frequency: Vec<f64>,
    /// Damping over critical damping.
    #[serde(deserialize_with = "crate::number::read")]
    pub damping_ratio: Vec<f64>,
    /// What each mode is, in words.
    pub label: Vec<String>,
    /// Critical speeds in the range of the diagram, ascending.
    pub critical: Vec<CriticalSpeed>,
}

/// Answer of `campbell`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CampbellResult {
    /// What every result says.
    #[serde(flatten)]
    pub header: Header,
    /// Range of the excitation speed Ω, rad/s.
    #[serde(deserialize_with = "crate::number::read")]
    pub frequency: (f64, f64),
    /// Orders, ascending.
    #[serde(deserialize_with = "crate::number::read")]
    pub orders: Vec<f64>,
    /// Operating range, rad/s.
    #[serde(default, deserialize_with = "crate::number::read")]
    pub operating: Option<(f64, f64)>,
    /// The line as it is, or each gear of a gearbox that lists its ratios.
    pub gears: Vec<CampbellGear>,
}

impl CampbellResult {
    /// Critical speeds of one gear as a table.
    pub fn table(gear: &CampbellGear) -> Table {
        let column = |name: &str, unit: &str, value: &dyn Fn(&CriticalSpeed) -> f64| {
            Column::new(name, unit, gear.critical.iter().map(value).collect())
        };
        #[expect(clippy::cast_precision_loss, reason = "a small number")]
        Table::new(vec![
            column("speed", "rad/s", &|c| c.speed),
            column("frequency", "rad/s", &|c| c.frequency),
            column("mode", "1", &|c| c.mode as f64),
            column("order", "1", &|c| c.order),
            column("margin", "1", &|c| c.margin.unwrap_or(f64::NAN)),
            column("torque", "N·m", &|c| c.torque.unwrap_or(f64::NAN)),
        ])
    }
}
