//! A gear between two nodes, rigid or with an elastic mesh.

use serde::Serialize;

use super::shaft::{DAMPING_ACTS, IN_CONTACT, is_true};
use crate::format::{CheckedTable, KeySpec, TableSpec, ValueSpec};
use crate::units::{QuantityKind, Sign};

/// A massless, lossless gear.
///
/// Rigid: `input speed = ratio · output speed`, and so `output torque = ratio · input torque`. With
/// an elastic mesh it is a connection like a shaft, of the twist
/// `x = angle(input) / ratio - angle(output)` and with the torque at the output.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Gear {
    /// Name of the element; channels of an elastic mesh are `<name>.twist` and so on.
    pub name: String,
    /// Node on the fast side where the ratio is more than 1.
    pub input: String,
    /// Node on the other side.
    pub output: String,
    /// Input speed over output speed; negative where the direction reverses.
    pub ratio: f64,
    /// The ratios that this gearbox can be switched to, for answers gear by gear.
    pub ratios: Vec<f64>,
    /// Whether stiffness, damping and clearance of the mesh are those at the input.
    #[serde(skip_serializing_if = "is_false")]
    pub refers_to_input: bool,
    /// Stiffness of the mesh at the side told, N·m/rad; `None` for a rigid gear.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stiffness_nm_per_rad: Option<f64>,
    /// Viscous damping of the mesh at the side told, N·m·s/rad; `None` for none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub damping_nm_s_per_rad: Option<f64>,
    /// Whether the damping of the mesh acts in its backlash too.
    #[serde(skip_serializing_if = "is_true")]
    pub damps_in_gap: bool,
    /// Total backlash of the mesh at the side told, rad; `None` for none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub clearance_rad: Option<f64>,
}

fn is_false(value: &bool) -> bool {
    !*value
}

/// Sides of a gear.
const SIDES: [&str; 2] = ["output", INPUT];
const INPUT: &str = "input";

/// Keys of `[[gear]]`.
pub static GEAR: TableSpec = TableSpec {
    name: "gear",
    doc: "A gear, massless and lossless: input speed = ratio · output speed. With a stiffness its mesh \
          is elastic: a connection like a shaft, twist = angle(input) / ratio - angle(output), torque at \
          the output.",
    keys: &[
        KeySpec::new("name", ValueSpec::Text, "Name of the element.").required(),
        KeySpec::new("input", ValueSpec::Node { ground: false }, "Node at the input.").required(),
        KeySpec::new(
            "output",
            ValueSpec::Node { ground: false },
            "Node at the output. A node that no [[inertia]] names has none of its own, which only a \
             rigid gear allows.",
        )
        .required(),
        KeySpec::new(
            "ratio",
            ValueSpec::Quantity(QuantityKind::Number, Sign::NonZero),
            "Input speed over output speed; negative where the direction reverses.",
        )
        .required(),
        KeySpec::new(
            "ratios",
            ValueSpec::Quantities(QuantityKind::Number, Sign::NonZero),
            "All ratios that the gearbox offers; `static` and `report` answer for each of them. \
             Optional. Address of the first: `<name>.ratios.1`.",
        ),
        KeySpec::new(
            "stiffness",
            ValueSpec::Quantity(QuantityKind::Stiffness(1), Sign::Positive),
            "Stiffness of the mesh, at the output unless told otherwise; without it the gear is rigid.",
        ),
        KeySpec::new(
            "damping",
            ValueSpec::Quantity(QuantityKind::Damping, Sign::NonNegative),
            "Viscous damping of an elastic mesh, at the same side. Default 0.",
        ),
        KeySpec::new(
            "referred_to",
            ValueSpec::Choice(&SIDES),
            "Side at which stiffness, damping and clearance of the mesh are told: \"output\" or \
             \"input\"; at the output the stiffness is ratio² times that at the input. Twist and \
             torque are those at the output all the same. Default \"output\".",
        ),
        DAMPING_ACTS,
        KeySpec::new(
            "clearance",
            ValueSpec::Quantity(QuantityKind::Angle, Sign::NonNegative),
            "Total backlash of an elastic mesh, at the same side. Default 0.",
        ),
    ],
};

impl Gear {
    pub(crate) fn read(table: &CheckedTable) -> Self {
        // An unsound stiffness still says that the mesh is elastic.
        let elastic = table.mentions("stiffness");
        Self {
            name: table.text_or_empty("name"),
            input: table.text_or_empty("input"),
            output: table.text_or_empty("output"),
            ratio: table.number_or_stand_in("ratio"),
            ratios: table.numbers("ratios").to_vec(),
            refers_to_input: table.word("referred_to") == Some(INPUT),
            stiffness_nm_per_rad: elastic.then(|| table.number_or_stand_in("stiffness")),
            damping_nm_s_per_rad: table.number("damping"),
            damps_in_gap: table.word("damping_acts") != Some(IN_CONTACT),
            clearance_rad: table.number("clearance"),
        }
    }

    /// Stiffness (N·m/rad), damping (N·m·s/rad) and total backlash (rad) of the mesh at the output;
    /// `None` for a rigid gear.
    pub fn mesh_at_output(&self) -> Option<[f64; 3]> {
        let (turns, stiffness) = (self.ratio.abs(), self.stiffness_nm_per_rad?);
        let lever = if self.refers_to_input { turns } else { 1.0 };
        let damping = self.damping_nm_s_per_rad.unwrap_or(0.0);
        let clearance = self.clearance_rad.unwrap_or(0.0);
        Some([stiffness * lever * lever, damping * lever * lever, clearance / lever])
    }

    /// Whether the mesh is elastic, so that the gear is a connection like a shaft.
    pub fn is_elastic(&self) -> bool {
        self.stiffness_nm_per_rad.is_some()
    }

    /// The numeric value behind a key of this element: `ratio`, `ratios.1` for the first of
    /// `ratios`; those of the mesh only where it is elastic, but for its stiffness.
    pub fn parameter_mut(&mut self, key: &str) -> Option<&mut f64> {
        if let Some(number) = key.strip_prefix("ratios.") {
            let index = number.parse::<usize>().ok()?.checked_sub(1)?;
            return self.ratios.get_mut(index);
        }
        let elastic = self.is_elastic();
        match key {
            "ratio" => Some(&mut self.ratio),
            "stiffness" => Some(self.stiffness_nm_per_rad.get_or_insert(0.0)),
            "damping" if elastic => Some(self.damping_nm_s_per_rad.get_or_insert(0.0)),
            "clearance" if elastic => Some(self.clearance_rad.get_or_insert(0.0)),
            _ => None,
        }
    }
}
