//! An external torque on a node.

use serde::Serialize;

use super::order_table::{self, ORDER_TABLE};
use super::pulse::{PULSE, Pulse};
use super::torque_table::{TORQUE_TABLE, TorqueTable};
use crate::format::{CheckedTable, KeySpec, TableSpec, ValueSpec};
use crate::units::{QuantityKind, Sign};

/// The steady part of a torque.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum MeanTorque {
    /// So many N·m.
    Value(f64),
    /// Whatever keeps the line in steady running against all other mean torques, as a road
    /// load does at constant speed.
    Balance,
}

/// One harmonic of a torque: `amplitude · cos(order Ω t + phase)`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Harmonic {
    /// Cycles per revolution of the excitation speed Ω; need not be whole.
    pub order: f64,
    /// Amplitude, N·m.
    pub amplitude_nm: f64,
    /// Phase, rad.
    pub phase_rad: f64,
}

/// An external torque, positive in the direction of positive angle:
/// `mean + Σ amplitude · cos(order Ω t + phase) + pulse(t) + table(t)`, the amplitudes times
/// `(Ω / reference speed)^power` where they grow with the speed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Torque {
    /// Name of the element.
    pub name: String,
    /// Node it acts on.
    pub on: String,
    /// Steady part.
    pub mean: MeanTorque,
    /// Harmonic parts; the first is the one of the keys `amplitude`, `order`, `phase`.
    pub harmonics: Vec<Harmonic>,
    /// A speed of its own, rad/s, that takes the place of Ω in this torque.
    pub frequency_rad_s: Option<f64>,
    /// A part that acts once.
    pub pulse: Option<Pulse>,
    /// Torque over time by points.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub table: Option<TorqueTable>,
    /// Power of the speed with which all harmonics grow; `None` where they do not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub speed_power: Option<f64>,
    /// Speed at which the harmonics have their amplitudes, rad/s.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reference_speed_rad_s: Option<f64>,
}

/// The word for a mean torque that balances the others.
pub(crate) const BALANCE: &str = "balance";

const fn order(doc: &'static str) -> KeySpec {
    KeySpec::new("order", ValueSpec::Quantity(QuantityKind::Number, Sign::Positive), doc)
}

const AMPLITUDE: KeySpec = KeySpec::new(
    "amplitude",
    ValueSpec::Quantity(QuantityKind::Torque, Sign::Any),
    "Amplitude of the harmonic part: amplitude · cos(order · Ω t + phase). Default 0.",
);
const PHASE: KeySpec = KeySpec::new(
    "phase",
    ValueSpec::Quantity(QuantityKind::Angle, Sign::Any),
    "Phase of the harmonic part. Default 0.",
);

/// Keys of one entry of `harmonics = [ ... ]`.
pub static HARMONIC: TableSpec = TableSpec {
    name: "harmonic",
    doc: "One more harmonic of a torque. The numbers of the first one have the addresses \
          `<name of the torque>.harmonics.1.amplitude`, `.harmonics.1.order` and so on.",
    keys: &[order("Order, cycles per revolution of Ω.").required(), AMPLITUDE.required(), PHASE],
};

/// Keys of `[[torque]]`.
pub static TORQUE: TableSpec = TableSpec {
    name: "torque",
    doc: "An external torque on a node, positive in the direction of positive angle: \
          mean + Σ amplitude · cos(order · Ω t + phase) + pulse(t) + table(t); with a speed_power every amplitude \
          times (Ω / reference_speed)^speed_power.",
    keys: &[
        KeySpec::new("name", ValueSpec::Text, "Name of the element.").required(),
        KeySpec::new("on", ValueSpec::Node { ground: false }, "Node it acts on.").required(),
        KeySpec::new(
            "mean",
            ValueSpec::QuantityOr(QuantityKind::Torque, Sign::Any, &[BALANCE]),
            "Steady part; \"balance\" for a load that keeps the line in steady running against \
             all other mean torques. Default 0.",
        ),
        AMPLITUDE,
        order("Order of the harmonic part: cycles per revolution of Ω. Default 1."),
        PHASE,
        KeySpec::new("harmonics", ValueSpec::Tables(&HARMONIC), "Further harmonics."),
        KeySpec::new(
            "orders",
            ValueSpec::TableOrText(&ORDER_TABLE),
            "Further harmonics as lists of order, amplitude and phase, or the path of a CSV file of them.",
        ),
        KeySpec::new(
            "frequency",
            ValueSpec::Quantity(QuantityKind::Speed, Sign::Positive),
            "A fixed speed that takes the place of Ω in this torque, for `simulate`. Optional.",
        ),
        KeySpec::new(
            "speed_power",
            ValueSpec::Quantity(QuantityKind::Number, Sign::NonNegative),
            "Power of Ω with which all harmonics of this torque grow: 2 for an unbalance. Optional.",
        ),
        KeySpec::new(
            "reference_speed",
            ValueSpec::Quantity(QuantityKind::Speed, Sign::Positive),
            "Ω at which the harmonics have the stated amplitudes; goes with speed_power.",
        ),
        KeySpec::new("pulse", ValueSpec::Table(&PULSE), "A part that acts once."),
        KeySpec::new(
            "table",
            ValueSpec::TableOrText(&TORQUE_TABLE),
            "A part given over time: points, or the path of a CSV file.",
        ),
    ],
};

impl Harmonic {
    fn read(table: &CheckedTable) -> Self {
        Self {
            order: table.number_or_stand_in("order"),
            amplitude_nm: table.number_or_stand_in("amplitude"),
            phase_rad: table.number_or("phase", 0.0),
        }
    }

    fn parameter_mut(&mut self, key: &str) -> Option<&mut f64> {
        match key {
            "order" => Some(&mut self.order),
            "amplitude" => Some(&mut self.amplitude_nm),
            "phase" => Some(&mut self.phase_rad),
            _ => None,
        }
    }
}

impl Torque {
    pub(crate) fn read(table: &CheckedTable) -> Self {
        let main = Harmonic {
            order: table.number_or("order", 1.0),
            amplitude_nm: table.number_or("amplitude", 0.0),
            phase_rad: table.number_or("phase", 0.0),
        };
        let mut harmonics = vec![main];
        harmonics.extend(table.tables("harmonics").iter().map(Harmonic::read));
        harmonics.extend(table.table("orders").into_iter().flat_map(order_table::read));
        let mean = match table.word("mean") {
            Some(_) => MeanTorque::Balance,
            None => MeanTorque::Value(table.number_or("mean", 0.0)),
        };
        Self {
            name: table.text_or_empty("name"),
            on: table.text_or_empty("on"),
            mean,
            harmonics,
            frequency_rad_s: table.number("frequency"),
            pulse: table.table("pulse").map(Pulse::read),
            table: table.table("table").map(TorqueTable::read),
            speed_power: table.number("speed_power"),
            reference_speed_rad_s: table.number("reference_speed"),
        }
    }

    /// The numeric value behind a key of this element: `mean`, `amplitude`, `pulse.peak`,
    /// `harmonics.1.amplitude` for the first further harmonic.
    pub fn parameter_mut(&mut self, key: &str) -> Option<&mut f64> {
        if let Some(key) = key.strip_prefix("pulse.") {
            return self.pulse.as_mut()?.parameter_mut(key);
        }
        if let Some(key) = key.strip_prefix("table.") {
            return self.table.as_mut()?.parameter_mut(key);
        }
        match key {
            "mean" => {
                if self.mean == MeanTorque::Balance {
                    self.mean = MeanTorque::Value(0.0);
                }
                match &mut self.mean {
                    MeanTorque::Value(value) => Some(value),
                    MeanTorque::Balance => None,
                }
            }
            "frequency" => Some(self.frequency_rad_s.get_or_insert(0.0)),
            // Without a reference a power says nothing.
            "speed_power" if self.reference_speed_rad_s.is_some() => {
                Some(self.speed_power.get_or_insert(0.0))
            }
            "reference_speed" => self.reference_speed_rad_s.as_mut(),
            _ => {
                let (index, key) = harmonic_key(key)?;
                self.harmonics.get_mut(index)?.parameter_mut(key)
            }
        }
    }

    /// The harmonic that a key of this element belongs to, and its key within that.
    pub(crate) fn harmonic<'k>(&self, key: &'k str) -> Option<(&Harmonic, &'k str)> {
        let (index, key) = harmonic_key(key)?;
        let known = HARMONIC.key(key).is_some();
        self.harmonics.get(index).filter(|_| known).map(|harmonic| (harmonic, key))
    }
}

/// Which harmonic a key of a torque belongs to, and the key within that.
fn harmonic_key(key: &str) -> Option<(usize, &str)> {
    let Some(rest) = key.strip_prefix("harmonics.") else { return Some((0, key)) };
    let (index, key) = rest.split_once('.')?;
    // Entry 0 is the main harmonic, so the first further one is number 1.
    let index: usize = index.parse().ok().filter(|index| *index > 0)?;
    Some((index, key))
}
