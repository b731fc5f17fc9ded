//! A measured law: points of twist and torque.

use serde::Serialize;

use crate::format::{CheckedTable, KeySpec, TableSpec, ValueSpec};
use crate::units::{QuantityKind, Sign};

/// Points of twist and torque, as many of one as of the other.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct MeasuredLaw {
    /// Twists, ascending, rad.
    pub twist_rad: Vec<f64>,
    /// Torques at these twists, N·m.
    pub torque_nm: Vec<f64>,
}

/// Keys of `table = { ... }`.
pub static MEASURED: TableSpec = TableSpec {
    name: "measured law",
    doc: "Points of twist and torque. Between them a cubic that keeps their shape: it rises where they \
          rise and its stiffness is continuous (Fritsch and Butland 1984); beyond the ends it goes on \
          straight with the slope it has there. In place of the two lists a text is the path of a CSV \
          file, relative to the model file: two columns, twist and torque, with units in the header \
          (`twist [deg], torque [N·m]`) or in SI. The points have the addresses \
          `<name of the shaft>.table.twist.1`, `.table.torque.1` and so on.",
    keys: &[
        KeySpec::new(
            "twist",
            ValueSpec::Quantities(QuantityKind::Angle, Sign::Any),
            "Twists, ascending.",
        )
        .required(),
        KeySpec::new(
            "torque",
            ValueSpec::Quantities(QuantityKind::Torque, Sign::Any),
            "Torques at these twists.",
        )
        .required(),
    ],
};

impl MeasuredLaw {
    pub(crate) fn read(table: &CheckedTable) -> Self {
        Self {
            twist_rad: table.numbers("twist").to_vec(),
            torque_nm: table.numbers("torque").to_vec(),
        }
    }

    /// The points.
    pub fn points(&self) -> impl ExactSizeIterator<Item = (f64, f64)> + '_ {
        self.twist_rad.iter().copied().zip(self.torque_nm.iter().copied())
    }

    /// The numeric value behind `twist.1`, `torque.1` and so on.
    pub(super) fn parameter_mut(&mut self, key: &str) -> Option<&mut f64> {
        let (column, number) = key.split_once('.')?;
        let index = number.parse::<usize>().ok()?.checked_sub(1)?;
        match column {
            "twist" => self.twist_rad.get_mut(index),
            "torque" => self.torque_nm.get_mut(index),
            _ => None,
        }
    }
}
