//! A torsional vibration damper: a ring of inertia held by fluid or rubber.

use serde::Serialize;

use super::inertia::Inertia;
use super::shaft::{Shaft, is_zero};
use crate::format::{CheckedTable, KeySpec, TableSpec, ValueSpec};
use crate::units::{QuantityKind, Sign};

/// A ring on a node: `J φ'' = k x + c x'`, `x = angle(on) - φ` the twist, and the opposite torque on
/// the node. Without stiffness a viscous damper; with stiffness and damping or a loss factor a rubber
/// damper or tuned absorber.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Damper {
    /// Name of the element; its twist is `<name>.twist`, its ring the node `<name>.ring`.
    pub name: String,
    /// Node that it sits on.
    pub on: String,
    /// Inertia of the ring `J`, kg·m².
    pub inertia_kg_m2: f64,
    /// Stiffness `k`, N·m/rad.
    pub stiffness_nm_per_rad: f64,
    /// Viscous damping `c`, N·m·s/rad.
    pub damping_nm_s_per_rad: f64,
    /// Loss factor of the stiffness.
    #[serde(skip_serializing_if = "is_zero")]
    pub loss_factor: f64,
}

/// Keys of `[[damper]]`.
pub static DAMPER: TableSpec = TableSpec {
    name: "damper",
    doc: "A torsional vibration damper: a ring of inertia J on a node, J φ'' = k x + c x' with \
          x = angle(on) - φ. Without a stiffness a viscous damper, with one a rubber damper or tuned \
          absorber. Its ring is the node `<name>.ring`, its twist `<name>.twist`.",
    keys: &[
        KeySpec::new("name", ValueSpec::Text, "Name of the element.").required(),
        KeySpec::new("on", ValueSpec::Node { ground: false }, "Node it sits on.").required(),
        KeySpec::new(
            "inertia",
            ValueSpec::Quantity(QuantityKind::Inertia, Sign::Positive),
            "Inertia J of the ring.",
        )
        .required(),
        KeySpec::new(
            "stiffness",
            ValueSpec::Quantity(QuantityKind::Stiffness(1), Sign::NonNegative),
            "Stiffness k that holds the ring. Default 0: a viscous damper.",
        ),
        KeySpec::new(
            "damping",
            ValueSpec::Quantity(QuantityKind::Damping, Sign::NonNegative),
            "Viscous damping c between ring and node. Default 0.",
        ),
        KeySpec::new(
            "loss_factor",
            ValueSpec::Quantity(QuantityKind::Number, Sign::NonNegative),
            "Loss factor of the stiffness, as of a shaft. Default 0.",
        ),
    ],
};

impl Damper {
    pub(crate) fn read(table: &CheckedTable) -> Self {
        Self {
            name: table.text_or_empty("name"),
            on: table.text_or_empty("on"),
            inertia_kg_m2: table.number_or_stand_in("inertia"),
            stiffness_nm_per_rad: table.number_or("stiffness", 0.0),
            damping_nm_s_per_rad: table.number_or("damping", 0.0),
            loss_factor: table.number_or("loss_factor", 0.0),
        }
    }

    /// The ring as an inertia with a node of its own.
    pub(crate) fn ring(&self) -> Inertia {
        Inertia {
            name: format!("{}.ring", self.name),
            inertia_kg_m2: self.inertia_kg_m2,
            damping_nm_s_per_rad: 0.0,
        }
    }

    /// What holds the ring, as a shaft.
    pub(crate) fn coupling(&self) -> Shaft {
        Shaft {
            damping_nm_s_per_rad: self.damping_nm_s_per_rad,
            loss_factor: Some(self.loss_factor),
            ..Shaft::linear(
                self.name.clone(),
                [self.on.clone(), self.ring().name],
                self.stiffness_nm_per_rad,
            )
        }
    }

    /// Whether nothing holds the ring.
    pub(crate) fn is_silent(&self) -> bool {
        [self.stiffness_nm_per_rad, self.damping_nm_s_per_rad] == [0.0; 2]
    }

    /// The numeric value behind a key of this element.
    pub fn parameter_mut(&mut self, key: &str) -> Option<&mut f64> {
        match key {
            "inertia" => Some(&mut self.inertia_kg_m2),
            "stiffness" => Some(&mut self.stiffness_nm_per_rad),
            "damping" => Some(&mut self.damping_nm_s_per_rad),
            "loss_factor" => Some(&mut self.loss_factor),
            _ => None,
        }
    }
}
