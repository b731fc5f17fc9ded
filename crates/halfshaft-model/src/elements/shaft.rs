//! A torsional connection between two nodes.

use serde::Serialize;

use crate::format::{CheckedTable, KeySpec, TableSpec, ValueSpec};
use crate::units::{QuantityKind, Sign};

/// A massless torsional spring with a polynomial law and viscous damping in parallel:
/// `torque = c x' + k1 x + k2 x² + k3 x³ + k5 x⁵ + k7 x⁷`, `x = angle(from) - angle(to)`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Shaft {
    /// Name of the element; its channels are `<name>.twist` and so on.
    pub name: String,
    /// Node whose angle counts positive in the twist.
    pub from: String,
    /// Node whose angle counts negative in the twist; may be ground.
    pub to: String,
    /// Linear stiffness `k1`, N·m/rad.
    pub stiffness_nm_per_rad: f64,
    /// `k2`, N·m/rad²: makes drive and coast side differ.
    pub quadratic_nm_per_rad2: f64,
    /// `k3`, N·m/rad³: hardening above zero, softening below.
    pub cubic_nm_per_rad3: f64,
    /// `k5`, N·m/rad⁵.
    pub quintic_nm_per_rad5: f64,
    /// `k7`, N·m/rad⁷.
    pub septic_nm_per_rad7: f64,
    /// Viscous damping `c`, N·m·s/rad.
    pub damping_nm_s_per_rad: f64,
}

const PLANNED_LAW: &str = "this version knows polynomial shafts: stiffness, quadratic, cubic, \
     quintic, septic and damping";
const PLANNED_DIMENSIONS: &str = "this version takes the stiffness of a shaft: stiffness = \
     \"... N·m/rad\" (for a round bar shear modulus · π (D⁴ - d⁴) / (32 · length))";

const fn stiffness(name: &'static str, degree: u8, doc: &'static str) -> KeySpec {
    KeySpec::new(name, ValueSpec::Quantity(QuantityKind::Stiffness(degree), Sign::Any), doc)
}

/// Keys of `[[shaft]]`.
pub static SHAFT: TableSpec = TableSpec {
    name: "shaft",
    doc: "A torsional connection between two nodes; \"ground\" is the fixed node. \
          torque = c x' + k1 x + k2 x² + k3 x³ + k5 x⁵ + k7 x⁷ with x = angle(from) - angle(to).",
    keys: &[
        KeySpec::new("name", ValueSpec::Text, "Name of the element.").required(),
        KeySpec::new(
            "from",
            ValueSpec::Node { ground: true },
            "Node whose angle counts positive in the twist.",
        )
        .required(),
        KeySpec::new(
            "to",
            ValueSpec::Node { ground: true },
            "Node whose angle counts negative in the twist.",
        )
        .required(),
        KeySpec::new(
            "stiffness",
            ValueSpec::Quantity(QuantityKind::Stiffness(1), Sign::NonNegative),
            "Linear stiffness k1.",
        )
        .required(),
        KeySpec::new(
            "damping",
            ValueSpec::Quantity(QuantityKind::Damping, Sign::NonNegative),
            "Viscous damping c in parallel. Default 0.",
        ),
        stiffness("quadratic", 2, "k2: makes drive and coast side differ. Default 0."),
        stiffness("cubic", 3, "k3: hardening above zero, softening below. Default 0."),
        stiffness("quintic", 5, "k5. Default 0."),
        stiffness("septic", 7, "k7. Default 0."),
        KeySpec::new("stages", ValueSpec::Text, "Stages of a multi-stage damper.")
            .refused(PLANNED_LAW),
        KeySpec::new("friction", ValueSpec::Text, "Dry friction torque in parallel.")
            .refused(PLANNED_LAW),
        KeySpec::new("clearance", ValueSpec::Text, "Total backlash.").refused(PLANNED_LAW),
        KeySpec::new("table", ValueSpec::Text, "Measured law.").refused(PLANNED_LAW),
        KeySpec::new("length", ValueSpec::Text, "Length.").refused(PLANNED_DIMENSIONS),
        KeySpec::new("outer_diameter", ValueSpec::Text, "Outer diameter.")
            .refused(PLANNED_DIMENSIONS),
        KeySpec::new("inner_diameter", ValueSpec::Text, "Inner diameter.")
            .refused(PLANNED_DIMENSIONS),
        KeySpec::new("shear_modulus", ValueSpec::Text, "Shear modulus.")
            .refused(PLANNED_DIMENSIONS),
        KeySpec::new("density", ValueSpec::Text, "Density.").refused(PLANNED_DIMENSIONS),
        KeySpec::new("elements", ValueSpec::Text, "Number of elements.")
            .refused(PLANNED_DIMENSIONS),
    ],
};

impl Shaft {
    pub(crate) fn read(table: &CheckedTable) -> Self {
        Self {
            name: table.text_or_empty("name"),
            from: table.text_or_empty("from"),
            to: table.text_or_empty("to"),
            stiffness_nm_per_rad: table.number_or_stand_in("stiffness"),
            quadratic_nm_per_rad2: table.number_or("quadratic", 0.0),
            cubic_nm_per_rad3: table.number_or("cubic", 0.0),
            quintic_nm_per_rad5: table.number_or("quintic", 0.0),
            septic_nm_per_rad7: table.number_or("septic", 0.0),
            damping_nm_s_per_rad: table.number_or("damping", 0.0),
        }
    }

    /// Coefficients of the spring torque, ascending from the constant (always zero).
    pub fn polynomial(&self) -> [f64; 8] {
        [
            0.0,
            self.stiffness_nm_per_rad,
            self.quadratic_nm_per_rad2,
            self.cubic_nm_per_rad3,
            0.0,
            self.quintic_nm_per_rad5,
            0.0,
            self.septic_nm_per_rad7,
        ]
    }

    /// The numeric value behind a key of this element.
    pub fn parameter_mut(&mut self, key: &str) -> Option<&mut f64> {
        match key {
            "stiffness" => Some(&mut self.stiffness_nm_per_rad),
            "quadratic" => Some(&mut self.quadratic_nm_per_rad2),
            "cubic" => Some(&mut self.cubic_nm_per_rad3),
            "quintic" => Some(&mut self.quintic_nm_per_rad5),
            "septic" => Some(&mut self.septic_nm_per_rad7),
            "damping" => Some(&mut self.damping_nm_s_per_rad),
            _ => None,
        }
    }
}
