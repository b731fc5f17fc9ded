//! One stage of a multi-stage law.

use serde::Serialize;

use crate::format::{CheckedTable, KeySpec, TableSpec, ValueSpec};
use crate::units::{QuantityKind, Sign};

/// A stiffness up to a twist, counted from zero twist outwards.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Stage {
    /// Magnitude of the twist at which the next stage begins, rad; `None` for the last stage.
    pub until_rad: Option<f64>,
    /// Stiffness within the stage, N·m/rad.
    pub stiffness_nm_per_rad: f64,
}

/// Keys of one entry of `stages = [ ... ]`.
pub static STAGE: TableSpec = TableSpec {
    name: "stage",
    doc: "A stiffness up to a twist. The torque is continuous; a stage of no stiffness is free play. \
          The numbers of the first one have the addresses `<name of the shaft>.stages.1.until` and \
          `.stages.1.stiffness`, or with `coast_stages`.",
    keys: &[
        KeySpec::new(
            "until",
            ValueSpec::Quantity(QuantityKind::Angle, Sign::Positive),
            "Twist, counted from zero twist outwards, at which the next stage begins; the last stage \
             has none and goes on.",
        ),
        KeySpec::new(
            "stiffness",
            ValueSpec::Quantity(QuantityKind::Stiffness(1), Sign::NonNegative),
            "Stiffness within the stage.",
        )
        .required(),
    ],
};

impl Stage {
    pub(crate) fn read(table: &CheckedTable) -> Self {
        Self {
            until_rad: table.number("until"),
            stiffness_nm_per_rad: table.number_or_stand_in("stiffness"),
        }
    }

    /// The numeric value behind a key of a stage.
    pub(super) fn parameter_mut(&mut self, key: &str) -> Option<&mut f64> {
        match key {
            "until" => self.until_rad.as_mut(),
            "stiffness" => Some(&mut self.stiffness_nm_per_rad),
            _ => None,
        }
    }
}
