//! Answer of `bifurcation`.

use serde::{Deserialize, Serialize};

use crate::{Column, Header, SpecialPoint, Table};

/// Answer of `bifurcation`: what the line settles to along a stepwise sweep.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BifurcationResult {
    /// What every result says.
    #[serde(flatten)]
    pub header: Header,
    /// Name of the column that is swept: `frequency` or the address of a number of the line.
    pub swept: String,
    /// Excitation speed where another number is swept, rad/s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frequency: Option<f64>,
    /// The shaft that is looked at.
    pub shaft: String,
    /// How the motion was followed.
    pub integrator: String,
    /// The Poincaré points: the swept number, `direction` (1 up, -1 down), twist and rate of twist of the
    /// shaft whenever a period of the excitation begins. A motion that repeats has the points of one
    /// repetition, any other one as many as were asked for.
    pub columns: Vec<Column>,
    /// One row a value and direction, in the order of the sweep: the swept number, `direction`, `period`
    /// (periods of the excitation after which the motion repeats, 0 where it does not within 16),
    /// `lyapunov_exponent` (the largest, 1/s), `lyapunov_sum` (of all, 1/s), `amplitude` (half of peak to
    /// peak of the twist, rad), `matches_branch` (index into `branches`; missing where none),
    /// `escaped` (1 where the motion ran away), `periods_followed`.
    pub values: Table,
    /// Where the amplitude jumps from a value to the next.
    pub jumps: Vec<SweepJump>,
    /// The responses that `resonance` continues over the same range.
    #[serde(default)]
    pub branches: Vec<StrobedBranch>,
}

/// A jump on a stepwise sweep.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SweepJump {
    /// 1 up, -1 down.
    pub direction: f64,
    /// Swept number at the last value before the jump.
    #[serde(deserialize_with = "crate::number::read")]
    pub last: f64,
    /// Swept number at the first value after it.
    #[serde(deserialize_with = "crate::number::read")]
    pub first: f64,
    /// Amplitude (half of peak to peak of the twist) before, rad.
    #[serde(deserialize_with = "crate::number::read")]
    pub before: f64,
    /// The same after, rad.
    #[serde(deserialize_with = "crate::number::read")]
    pub after: f64,
}

/// A continued branch, seen whenever a period of the excitation begins.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StrobedBranch {
    /// Periods of the excitation after which the responses repeat.
    pub periods: u32,
    /// Where the branch comes from.
    pub origin: String,
    /// The swept number, twist and rate of twist of the shaft at the beginning of a period, for responses
    /// of several periods also at the following ones (`….twist.2` and so on), and `stable` (0/1).
    pub columns: Vec<Column>,
    /// Folds, period doublings and the like, with the swept number and the twist.
    pub special_points: Vec<SpecialPoint>,
}

impl BifurcationResult {
    /// The Poincaré points.
    pub fn table(&self) -> Table {
        Table::new(self.columns.clone())
    }

    /// Name of the column of twists.
    pub fn twist(&self) -> String {
        format!("{}.twist", self.shaft)
    }
}

impl StrobedBranch {
    /// Values of the column of that name; empty where there is none.
    pub fn values(&self, name: &str) -> &[f64] {
        let found = self.columns.iter().find(|column| column.name == name);
        found.map_or(&[], |column| &column.values)
    }
}
