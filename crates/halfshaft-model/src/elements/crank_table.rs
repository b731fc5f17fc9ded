//! What acts in one cylinder over a working cycle, by points over the crank angle.

use std::f64::consts::TAU;

use serde::Serialize;

use crate::format::{CheckedTable, KeySpec, TableSpec, ValueSpec};
use crate::units::{QuantityKind, Sign};

/// Points of crank angle and gas pressure, or torque, of one cylinder, equally spaced over one whole
/// working cycle; crank angle zero is the top dead centre at firing.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct CrankTable {
    /// Crank angles, ascending, rad.
    pub angle_rad: Vec<f64>,
    /// Pressure (Pa) or torque (N·m) at these angles.
    pub values: Vec<f64>,
}

const ANGLE: KeySpec = KeySpec::new(
    "angle",
    ValueSpec::Quantities(QuantityKind::Angle, Sign::Any),
    "Crank angles from the top dead centre at firing, ascending in equal steps over one working cycle. \
     The end of the cycle may be there or not: it is the beginning of the next.",
);

const WHERE: &str = "In place of the two lists a text is the path of a CSV file, relative to the model \
    file: two columns with units in the header or in SI.";

/// Keys of `pressure = { ... }` of an engine.
pub static CRANK_PRESSURE: TableSpec = TableSpec {
    name: "pressure table",
    doc: WHERE,
    keys: &[
        ANGLE.required(),
        KeySpec::new(
            "pressure",
            ValueSpec::Quantities(QuantityKind::Pressure, Sign::Any),
            "Gas pressure in one cylinder at these angles.",
        )
        .required(),
    ],
};

/// Keys of `torque = { ... }` of an engine.
pub static CRANK_TORQUE: TableSpec = TableSpec {
    name: "crank torque table",
    doc: WHERE,
    keys: &[
        ANGLE.required(),
        KeySpec::new(
            "torque",
            ValueSpec::Quantities(QuantityKind::Torque, Sign::Any),
            "Torque of one cylinder at the crank at these angles.",
        )
        .required(),
    ],
};

/// Most points.
const MOST_POINTS: usize = 10_000;
/// Share of a step by which angles may be off an equal spacing: files are written with few digits.
const UNEVEN: f64 = 1e-3;

/// Where the steps between ascending angles change, if they do.
fn uneven(angles: &[f64]) -> Option<String> {
    let mut steps: Vec<f64> = angles.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let at = |usual: f64| steps.iter().position(|step| (step - usual).abs() > UNEVEN * usual.abs());
    let mut sorted = steps.clone();
    sorted.sort_by(f64::total_cmp);
    let usual = sorted.get(sorted.len() / 2).copied().filter(|usual| *usual > 0.0)?;
    let at = at(usual)?;
    let step = steps.swap_remove(at);
    Some(format!(
        "the crank angles are not equally spaced: from point {} to {} ({:.3} degrees) by {:.3} degrees, \
         elsewhere by {:.3}",
        at + 1,
        at + 2,
        angles[at].to_degrees(),
        step.to_degrees(),
        usual.to_degrees()
    ))
}

impl CrankTable {
    pub(super) fn read(table: &CheckedTable, column: &str) -> Self {
        Self { angle_rad: table.numbers("angle").to_vec(), values: table.numbers(column).to_vec() }
    }

    /// Values over one cycle of `revolutions` without the point that begins the next one, and the
    /// angle of the first (rad).
    ///
    /// # Errors
    /// What keeps the points from being a cycle, and what to write instead.
    pub fn cycle(&self, revolutions: f64) -> Result<(f64, &[f64]), (String, &'static str)> {
        let (angles, values) = (&self.angle_rad, &self.values);
        if angles.len() != values.len() {
            let message =
                format!("the table has {} angles and {} values", angles.len(), values.len());
            return Err((message, "each angle needs its value"));
        }
        if angles.len() > MOST_POINTS {
            let message = format!("the table has {} points", angles.len());
            return Err((message, "thin it out: up to 10 000 points are taken"));
        }
        let [first, .., last] = angles[..] else {
            return Err(("the table has fewer than four points".to_owned(), "add points"));
        };
        let cycle = revolutions * TAU;
        #[expect(clippy::cast_precision_loss, reason = "a few thousand points")]
        let step = (last - first) / (angles.len() - 1) as f64;
        if let Some(message) = uneven(angles) {
            return Err((message, "give the cycle in equal steps of the crank angle"));
        }
        if angles.len() < 4 || step <= 0.0 {
            let message = "the crank angles do not ascend, or are fewer than four".to_owned();
            return Err((message, "give the cycle in equal steps of the crank angle"));
        }
        let covered = last - first;
        if (covered - cycle).abs() <= UNEVEN * step {
            return Ok((first, &values[..values.len() - 1]));
        }
        if (covered + step - cycle).abs() <= UNEVEN * step {
            return Ok((first, values));
        }
        let message = format!(
            "the crank angles cover {:.1} degrees, not the {:.0} degrees of a working cycle",
            covered.to_degrees(),
            cycle.to_degrees()
        );
        Err((message, "give one whole cycle; strokes = 2 or 4 says how long it is"))
    }

    pub(super) fn value_mut(&mut self, number: &str) -> Option<&mut f64> {
        let index = number.parse::<usize>().ok()?.checked_sub(1)?;
        self.values.get_mut(index)
    }
}
