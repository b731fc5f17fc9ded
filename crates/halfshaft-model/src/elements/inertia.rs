//! A rigid inertia on a node.

use serde::Serialize;

use crate::format::{CheckedTable, KeySpec, TableSpec, ValueSpec};
use crate::units::{QuantityKind, Sign};

/// A rigid body that turns with its node; the node has the inertia's name.
///
/// Equation: `J φ'' = sum of torques - d φ'`, with `J` the inertia and `d` the damping to
/// ground.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Inertia {
    /// Name of the element and of its node.
    pub name: String,
    /// Mass moment of inertia `J`, kg·m², more than zero.
    pub inertia_kg_m2: f64,
    /// Viscous damping to ground `d`, N·m·s/rad, not negative.
    pub damping_nm_s_per_rad: f64,
}

/// Keys of `[[inertia]]`.
pub static INERTIA: TableSpec = TableSpec {
    name: "inertia",
    doc: "A rigid body that turns; its name is also the name of its node.",
    keys: &[
        KeySpec::new("name", ValueSpec::Text, "Name of the element and of its node.").required(),
        KeySpec::new(
            "inertia",
            ValueSpec::Quantity(QuantityKind::Inertia, Sign::Positive),
            "Mass moment of inertia J.",
        )
        .required(),
        KeySpec::new(
            "damping",
            ValueSpec::Quantity(QuantityKind::Damping, Sign::NonNegative),
            "Viscous damping to ground: torque = -damping · speed. Default 0.",
        ),
    ],
};

impl Inertia {
    pub(crate) fn read(table: &CheckedTable) -> Self {
        Self {
            name: table.text_or_empty("name"),
            inertia_kg_m2: table.number_or_stand_in("inertia"),
            damping_nm_s_per_rad: table.number_or("damping", 0.0),
        }
    }

    /// The numeric value behind a key of this element.
    pub fn parameter_mut(&mut self, key: &str) -> Option<&mut f64> {
        match key {
            "inertia" => Some(&mut self.inertia_kg_m2),
            "damping" => Some(&mut self.damping_nm_s_per_rad),
            _ => None,
        }
    }
}
