//! Harmonics of a torque as lists.

use super::torque::Harmonic;
use crate::format::{CheckedTable, KeySpec, TableSpec, ValueSpec};
use crate::units::{QuantityKind, Sign};

/// Keys of `orders = { ... }` of a torque.
pub static ORDER_TABLE: TableSpec = TableSpec {
    name: "order table",
    doc: "Harmonics of a torque as three lists of equal length. In place of the lists a text is the path \
          of a CSV file, relative to the model file: three columns, with units in the header \
          (`order, amplitude [N·m], phase [deg]`) or in SI. They follow those of `harmonics` in the \
          addresses `<name of the torque>.harmonics.1.amplitude` and so on.",
    keys: &[
        KeySpec::new(
            "order",
            ValueSpec::Quantities(QuantityKind::Number, Sign::Positive),
            "Orders, cycles per revolution of Ω.",
        )
        .required(),
        KeySpec::new(
            "amplitude",
            ValueSpec::Quantities(QuantityKind::Torque, Sign::Any),
            "Amplitudes.",
        )
        .required(),
        KeySpec::new(
            "phase",
            ValueSpec::Quantities(QuantityKind::Angle, Sign::Any),
            "Phases. Default 0.",
        ),
    ],
};

/// The harmonics; lists of unequal length are told by [`super::check_torque`].
pub(super) fn read(table: &CheckedTable) -> Vec<Harmonic> {
    let phases = table.numbers("phase");
    let pairs = table.numbers("order").iter().zip(table.numbers("amplitude"));
    pairs
        .enumerate()
        .map(|(index, (order, amplitude))| Harmonic {
            order: *order,
            amplitude_nm: *amplitude,
            phase_rad: phases.get(index).copied().unwrap_or(0.0),
        })
        .collect()
}
