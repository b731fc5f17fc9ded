//! An ideal gear between two nodes.

use serde::Serialize;

use crate::format::{CheckedTable, KeySpec, TableSpec, ValueSpec};
use crate::units::{QuantityKind, Sign};

/// A massless, lossless, rigid gear: `input speed = ratio · output speed`, and so
/// `output torque = ratio · input torque`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Gear {
    /// Name of the element.
    pub name: String,
    /// Node on the fast side where the ratio is more than 1.
    pub input: String,
    /// Node on the other side.
    pub output: String,
    /// Input speed over output speed; negative where the direction reverses.
    pub ratio: f64,
    /// The ratios that this gearbox can be switched to, for answers gear by gear.
    pub ratios: Vec<f64>,
}

const PLANNED_MESH: &str = "this version knows ideal gears; model an elastic mesh as a [[shaft]] \
     behind the gear";

/// Keys of `[[gear]]`.
pub static GEAR: TableSpec = TableSpec {
    name: "gear",
    doc: "An ideal gear, massless and rigid: input speed = ratio · output speed.",
    keys: &[
        KeySpec::new("name", ValueSpec::Text, "Name of the element.").required(),
        KeySpec::new("input", ValueSpec::Node { ground: false }, "Node at the input.").required(),
        KeySpec::new(
            "output",
            ValueSpec::Node { ground: false },
            "Node at the output. A node that no [[inertia]] names has none of its own.",
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
            "Stiffness of the mesh, at the output.",
        )
        .refused(PLANNED_MESH),
        KeySpec::new(
            "damping",
            ValueSpec::Quantity(QuantityKind::Damping, Sign::NonNegative),
            "Damping of the mesh, at the output.",
        )
        .refused(PLANNED_MESH),
        KeySpec::new(
            "clearance",
            ValueSpec::Quantity(QuantityKind::Angle, Sign::NonNegative),
            "Total backlash of the mesh, at the output.",
        )
        .refused(PLANNED_MESH),
    ],
};

impl Gear {
    pub(crate) fn read(table: &CheckedTable) -> Self {
        Self {
            name: table.text_or_empty("name"),
            input: table.text_or_empty("input"),
            output: table.text_or_empty("output"),
            ratio: table.number_or_stand_in("ratio"),
            ratios: table.numbers("ratios").to_vec(),
        }
    }

    /// The numeric value behind a key of this element: `ratio`, `ratios.1` for the first of
    /// `ratios`.
    pub fn parameter_mut(&mut self, key: &str) -> Option<&mut f64> {
        if let Some(number) = key.strip_prefix("ratios.") {
            let index = number.parse::<usize>().ok()?.checked_sub(1)?;
            return self.ratios.get_mut(index);
        }
        match key {
            "ratio" => Some(&mut self.ratio),
            _ => None,
        }
    }
}
