//! What holds for the line as a whole.

use serde::Serialize;

use super::shaft::is_zero;
use crate::format::{CheckedTable, KeySpec, TableSpec, ValueSpec};
use crate::units::{QuantityKind, Sign};

/// Damping of the line as a whole, for linear vibrations, and the speeds at which it is run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct WholeLine {
    /// Damping ratio of every elastic mode, in addition to what dampers do.
    #[serde(skip_serializing_if = "is_zero")]
    pub modal_damping: f64,
    /// Loss factor of every connection that has none of its own.
    #[serde(skip_serializing_if = "is_zero")]
    pub loss_factor: f64,
    /// Operating range of the excitation speed, rad/s.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub operating_rad_s: Option<(f64, f64)>,
}

/// Name under which these numbers have their addresses.
pub const WHOLE_LINE_NAME: &str = "line";

/// Keys of `[line]`.
pub static WHOLE_LINE: TableSpec = TableSpec {
    name: WHOLE_LINE_NAME,
    doc: "What holds for the line as a whole, once a file. The addresses are `line.modal_damping` and \
          `line.loss_factor`. The two dampings are of linear vibrations: `modes`, `campbell` and \
          `forced` take them, what integrates in time or balances harmonics refuses them.",
    keys: &[
        KeySpec::new(
            "modal_damping",
            ValueSpec::Quantity(QuantityKind::Number, Sign::NonNegative),
            "Damping ratio of every elastic mode, beside what dampers do: C = Σ M φ (2 ζ ω) φᵀ M with \
             φᵀ M φ = 1. Default 0.",
        ),
        KeySpec::new(
            "loss_factor",
            ValueSpec::Quantity(QuantityKind::Number, Sign::NonNegative),
            "Loss factor of every shaft and mesh that has none of its own. Default 0.",
        ),
        KeySpec::new(
            "operating",
            ValueSpec::Range(QuantityKind::Speed),
            "Range of the excitation speed at which the line is run, e.g. \"800 rpm..6000 rpm\": \
             `campbell` tells the distance of critical speeds from it. Optional.",
        ),
    ],
};

impl WholeLine {
    pub(crate) fn read(table: &CheckedTable) -> Self {
        Self {
            modal_damping: table.number_or("modal_damping", 0.0),
            loss_factor: table.number_or("loss_factor", 0.0),
            operating_rad_s: table.range("operating"),
        }
    }

    /// Whether it says nothing.
    pub(crate) fn is_plain(&self) -> bool {
        *self == Self::default()
    }

    /// The numeric value behind a key.
    pub fn parameter_mut(&mut self, key: &str) -> Option<&mut f64> {
        match key {
            "modal_damping" => Some(&mut self.modal_damping),
            "loss_factor" => Some(&mut self.loss_factor),
            _ => None,
        }
    }
}
