//! How a clutch engages: its friction comes to bear over time.

use serde::Serialize;

use crate::format::{CheckedTable, KeySpec, TableSpec, ValueSpec};
use crate::units::{QuantityKind, Sign};

/// The friction torque rises in a straight line from nothing to all of it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Engagement {
    /// When the rise begins, s.
    pub start_s: f64,
    /// How long it takes, s.
    pub duration_s: f64,
}

/// Keys of `engagement = { ... }`.
pub static ENGAGEMENT: TableSpec = TableSpec {
    name: "engagement",
    doc: "How a clutch engages, for `simulate` and `shock`: its friction torque rises in a straight line \
          from nothing at start to all of it a duration later. Everywhere else the clutch is engaged.",
    keys: &[
        KeySpec::new(
            "start",
            ValueSpec::Quantity(QuantityKind::Time, Sign::NonNegative),
            "When the rise begins. Default 0.",
        ),
        KeySpec::new(
            "duration",
            ValueSpec::Quantity(QuantityKind::Time, Sign::Positive),
            "How long it takes.",
        )
        .required(),
    ],
};

impl Engagement {
    pub(crate) fn read(table: &CheckedTable) -> Self {
        Self {
            start_s: table.number_or("start", 0.0),
            duration_s: table.number_or_stand_in("duration"),
        }
    }

    /// When it is complete, s.
    pub fn end_s(&self) -> f64 {
        self.start_s + self.duration_s
    }

    /// Part of the friction torque that bears at time `t` (s), from 0 to 1.
    pub fn share(&self, t: f64) -> f64 {
        ((t - self.start_s) / self.duration_s).clamp(0.0, 1.0)
    }

    /// The numeric value behind a key.
    pub(super) fn parameter_mut(&mut self, key: &str) -> Option<&mut f64> {
        match key {
            "start" => Some(&mut self.start_s),
            "duration" => Some(&mut self.duration_s),
            _ => None,
        }
    }
}
