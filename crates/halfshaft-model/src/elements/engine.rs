//! A piston engine as a source of torque orders.

use std::f64::consts::TAU;

use serde::Serialize;

use super::crank_table::{CRANK_PRESSURE, CRANK_TORQUE, CrankTable};
use crate::format::{CheckedTable, KeySpec, TableSpec, ValueSpec};
use crate::units::{QuantityKind, Sign};

/// Crank gear of one cylinder: piston travel from the top `x(α) = r (1 - cos α) + l - sqrt(l² - r² sin² α)`
/// with the crank radius `r`, half of the stroke, and the length `l` of the rod.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CrankGear {
    /// Bore, m.
    pub bore_m: f64,
    /// Stroke, m.
    pub stroke_m: f64,
    /// Length of the connecting rod, m.
    pub rod_length_m: f64,
    /// Oscillating mass, kg.
    pub oscillating_mass_kg: f64,
}

/// A piston engine: the same torque in every cylinder, later by its firing angle.
///
/// With the crank angle `α = Ω t - firing angle` of a cylinder its torque on the crank is
/// `(p(α) - p0) A x'(α) - m Ω² x'(α) x''(α)`, or what a table of torques says, as a sum of orders.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Engine {
    /// Name of the element.
    pub name: String,
    /// Node of each cylinder's crank; one for all where there is one entry.
    pub on: Vec<String>,
    /// Crank angle at which each cylinder fires, rad, in the order of the cylinders.
    pub firing_rad: Vec<f64>,
    /// Strokes of a working cycle, 2 or 4.
    pub strokes: u8,
    /// Crank gear; `None` where torques are given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub crank: Option<CrankGear>,
    /// Gas pressure over the crank angle, Pa.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pressure: Option<CrankTable>,
    /// Pressure below the piston, Pa.
    pub crankcase_pressure_pa: f64,
    /// Torque of one cylinder over the crank angle, N·m.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub torque: Option<CrankTable>,
    /// Highest order that is taken.
    pub highest_order: f64,
}

/// Most cylinders.
const MOST_CYLINDERS: u32 = 64;
/// Highest order that can be taken.
pub const MOST_HIGHEST_ORDER: f64 = 500.0;
/// Highest order that is taken where the file does not say.
const HIGHEST_ORDER: f64 = 12.0;

/// Keys of `[[engine]]`.
pub static ENGINE: TableSpec = TableSpec {
    name: "engine",
    doc: "A piston engine: torque orders from gas pressure and oscillating masses, or from a table of \
          torques. With the crank angle α = Ω t - firing angle of each cylinder its torque is \
          (p(α) - p0) A x'(α) - m Ω² x'(α) x''(α), x(α) = r (1 - cos α) + l - sqrt(l² - r² sin² α) the \
          travel of the piston. Orders 0.5, 1, 1.5, ... (1, 2, ... with two strokes) are exact for the \
          points given; the mean torque acts too.",
    keys: &[
        KeySpec::new("name", ValueSpec::Text, "Name of the element.").required(),
        KeySpec::new(
            "on",
            ValueSpec::Texts,
            "Nodes of the cranks, in the order of the cylinders; one node for all, as in [\"crank\"], \
             where the crankshaft is taken as rigid.",
        )
        .required(),
        KeySpec::new(
            "cylinders",
            ValueSpec::Count(1, MOST_CYLINDERS),
            "Number of cylinders; needed where neither firing_order nor firing_angles say it.",
        ),
        KeySpec::new(
            "firing_order",
            ValueSpec::Quantities(QuantityKind::Number, Sign::Positive),
            "Cylinders in the order in which they fire, in equal distances over the cycle, e.g. \
             [1, 3, 4, 2]. Default 1, 2, 3, ...",
        ),
        KeySpec::new(
            "firing_angles",
            ValueSpec::Quantities(QuantityKind::Angle, Sign::Any),
            "Crank angles at which the cylinders fire, in the order of the cylinders, in place of \
             firing_order.",
        ),
        KeySpec::new("strokes", ValueSpec::Count(2, 4), "Strokes of a working cycle: 4 or 2. Default 4."),
        KeySpec::of_quantity("bore", QuantityKind::Length, Sign::Positive, "Bore of a cylinder."),
        KeySpec::of_quantity("stroke", QuantityKind::Length, Sign::Positive, "Stroke of the piston, twice the crank radius r."),
        KeySpec::of_quantity("rod_length", QuantityKind::Length, Sign::Positive, "Length l of the connecting rod."),
        KeySpec::of_quantity(
            "oscillating_mass",
            QuantityKind::Mass,
            Sign::NonNegative,
            "Oscillating mass m of a cylinder: piston, pin and the upper part of the rod. Default 0.",
        ),
        KeySpec::new(
            "pressure",
            ValueSpec::TableOrText(&CRANK_PRESSURE),
            "Gas pressure p in one cylinder over a working cycle: points, or the path of a CSV file.",
        ),
        KeySpec::of_quantity(
            "crankcase_pressure",
            QuantityKind::Pressure,
            Sign::NonNegative,
            "Pressure p0 below the piston. Default 0: the pressure is told above that of the crankcase.",
        ),
        KeySpec::new(
            "torque",
            ValueSpec::TableOrText(&CRANK_TORQUE),
            "Torque of one cylinder over a working cycle in place of the pressure and the crank gear.",
        ),
        KeySpec::of_quantity(
            "highest_order",
            QuantityKind::Number,
            Sign::Positive,
            "Highest order that is taken, up to 500. Default 12.",
        ),
    ],
};

impl Engine {
    pub(crate) fn read(table: &CheckedTable) -> Self {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "2 or 4")]
        let strokes = table.number_or("strokes", 4.0) as u8;
        let crank = table.mentions("bore").then(|| CrankGear {
            bore_m: table.number_or_stand_in("bore"),
            stroke_m: table.number_or_stand_in("stroke"),
            rod_length_m: table.number_or_stand_in("rod_length"),
            oscillating_mass_kg: table.number_or("oscillating_mass", 0.0),
        });
        Self {
            name: table.text_or_empty("name"),
            on: table.text_list("on"),
            firing_rad: firing(table, strokes),
            strokes,
            crank,
            pressure: table.table("pressure").map(|table| CrankTable::read(table, "pressure")),
            crankcase_pressure_pa: table.number_or("crankcase_pressure", 0.0),
            torque: table.table("torque").map(|table| CrankTable::read(table, "torque")),
            highest_order: table.number_or("highest_order", HIGHEST_ORDER),
        }
    }

    /// Revolutions of a working cycle.
    pub fn revolutions(&self) -> f64 {
        f64::from(self.strokes) / 2.0
    }

    /// Node of a cylinder's crank (cylinders from 0).
    pub fn node(&self, cylinder: usize) -> &str {
        let node = if self.on.len() == 1 { self.on.first() } else { self.on.get(cylinder) };
        node.map_or("", String::as_str)
    }

    /// The table that it is made from.
    pub fn table(&self) -> Option<&CrankTable> {
        self.torque.as_ref().or(self.pressure.as_ref())
    }

    /// The numeric value behind a key of this element.
    pub fn parameter_mut(&mut self, key: &str) -> Option<&mut f64> {
        let crank = self.crank.as_mut();
        match key {
            "bore" => crank.map(|crank| &mut crank.bore_m),
            "stroke" => crank.map(|crank| &mut crank.stroke_m),
            "rod_length" => crank.map(|crank| &mut crank.rod_length_m),
            "oscillating_mass" => crank.map(|crank| &mut crank.oscillating_mass_kg),
            "crankcase_pressure" => Some(&mut self.crankcase_pressure_pa),
            "highest_order" => Some(&mut self.highest_order),
            _ => {
                let (list, number) = key.rsplit_once('.')?;
                match list {
                    "firing_angles" => {
                        let index = number.parse::<usize>().ok()?.checked_sub(1)?;
                        self.firing_rad.get_mut(index)
                    }
                    "pressure.pressure" => self.pressure.as_mut()?.value_mut(number),
                    "torque.torque" => self.torque.as_mut()?.value_mut(number),
                    _ => None,
                }
            }
        }
    }
}

/// Firing angles of the cylinders, in their order.
fn firing(table: &CheckedTable, strokes: u8) -> Vec<f64> {
    if table.mentions("firing_angles") {
        return table.numbers("firing_angles").to_vec();
    }
    let order = firing_order(table);
    let cycle = f64::from(strokes) / 2.0 * TAU;
    let mut angles = vec![0.0; order.len()];
    for (turn, cylinder) in order.iter().enumerate() {
        #[expect(clippy::cast_precision_loss, reason = "a few cylinders")]
        let angle = cycle * turn as f64 / order.len() as f64;
        if let Some(place) = cylinder.checked_sub(1).and_then(|index| angles.get_mut(index)) {
            *place = angle;
        }
    }
    angles
}

/// Numbers of the cylinders as they fire, from 1.
pub(super) fn firing_order(table: &CheckedTable) -> Vec<usize> {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "checked elsewhere"
    )]
    let whole = |number: &f64| number.round() as usize;
    if table.mentions("firing_order") {
        return table.numbers("firing_order").iter().map(whole).collect();
    }
    let nodes = table.texts("on").len();
    #[expect(clippy::cast_precision_loss, reason = "a few cylinders")]
    let cylinders = table.number_or("cylinders", nodes.max(1) as f64);
    (1..=whole(&cylinders)).collect()
}
