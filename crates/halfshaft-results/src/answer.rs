//! One type for all answers.

use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize};

use crate::{
    BasinsResult, BifurcationResult, CampbellResult, CheckResult, Column, FoldsResult,
    ForcedResult, Header, HistoryResult, ModesResult, Named, ReportResult, ResonanceResult,
    StaticResult, StudyResult, Table,
};

/// Any result; which one, its `analysis` says.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Answer {
    /// Of `check`.
    Check(CheckResult),
    /// Of `static`.
    Static(StaticResult),
    /// Of `modes`.
    Modes(ModesResult),
    /// Of `campbell`.
    Campbell(CampbellResult),
    /// Of `forced`.
    Forced(ForcedResult),
    /// Of `simulate` and `shock`.
    History(HistoryResult),
    /// Of `resonance`.
    Resonance(ResonanceResult),
    /// Of `folds`.
    Folds(FoldsResult),
    /// Of `basins`.
    Basins(BasinsResult),
    /// Of `bifurcation`.
    Bifurcation(BifurcationResult),
    /// Of `run`.
    Study(StudyResult),
    /// Of `report`.
    Report(Box<ReportResult>),
}

impl<'de> Deserialize<'de> for Answer {
    /// By the analysis that the object names, so that a mistake is told of that kind.
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let value = serde_json::Value::deserialize(deserializer)?;
        let analysis = value.get("analysis").and_then(serde_json::Value::as_str).unwrap_or("");
        let from = match analysis {
            "check" => serde_json::from_value(value).map(Self::Check),
            "static" => serde_json::from_value(value).map(Self::Static),
            "modes" => serde_json::from_value(value).map(Self::Modes),
            "campbell" => serde_json::from_value(value).map(Self::Campbell),
            "forced" => serde_json::from_value(value).map(Self::Forced),
            "simulate" | "shock" => serde_json::from_value(value).map(Self::History),
            "resonance" => serde_json::from_value(value).map(Self::Resonance),
            "folds" => serde_json::from_value(value).map(Self::Folds),
            "basins" => serde_json::from_value(value).map(Self::Basins),
            "bifurcation" => serde_json::from_value(value).map(Self::Bifurcation),
            "run" => serde_json::from_value(value).map(Self::Study),
            "report" => serde_json::from_value(value).map(Self::Report),
            other => {
                let message = format!("\"{other}\" is no analysis that this version knows");
                return Err(D::Error::custom(message));
            }
        };
        from.map_err(D::Error::custom)
    }
}

impl Answer {
    /// The head of the result.
    pub fn header(&self) -> &Header {
        match self {
            Self::Check(result) => &result.header,
            Self::Static(result) => &result.header,
            Self::Modes(result) => &result.header,
            Self::Campbell(result) => &result.header,
            Self::Forced(result) => &result.header,
            Self::History(result) => &result.header,
            Self::Resonance(result) => &result.header,
            Self::Folds(result) => &result.header,
            Self::Basins(result) => &result.header,
            Self::Bifurcation(result) => &result.header,
            Self::Study(result) => &result.header,
            Self::Report(result) => &result.header,
        }
    }

    /// The columns that hold nearly all of the result's numbers, table by table: a history,
    /// branches, fold curves. Empty for results that are small.
    pub fn bulk_mut(&mut self) -> Vec<&mut Vec<Column>> {
        match self {
            Self::History(result) => vec![&mut result.columns],
            Self::Bifurcation(result) => vec![&mut result.columns],
            Self::Resonance(result) => {
                result.branches.iter_mut().map(|branch| &mut branch.columns).collect()
            }
            Self::Forced(result) => {
                result.gears.iter_mut().map(|gear| &mut gear.table.columns).collect()
            }
            Self::Folds(result) => {
                result.curves.iter_mut().map(|table| &mut table.columns).collect()
            }
            _ => Vec::new(),
        }
    }

    /// The result as named tables, for CSV and other flat files. Empty for results that are
    /// no tables.
    pub fn tables(&self) -> Vec<(String, Table)> {
        match self {
            Self::History(result) => vec![("history".to_owned(), result.table())],
            Self::Resonance(result) => numbered(
                "branch",
                result.branches.iter().map(|branch| Table::new(branch.columns.clone())),
            ),
            Self::Folds(result) => numbered("curve", result.curves.iter().cloned()),
            Self::Static(result) => vec![("equilibria".to_owned(), equilibria(result))],
            Self::Modes(result) => vec![("modes".to_owned(), modes(result))],
            Self::Campbell(result) => {
                numbered("gear", result.gears.iter().map(CampbellResult::table))
            }
            Self::Forced(result) => {
                numbered("gear", result.gears.iter().map(|gear| gear.table.clone()))
            }
            Self::Basins(result) => vec![("basins".to_owned(), result.table())],
            Self::Bifurcation(result) => vec![("points".to_owned(), result.table())],
            Self::Check(_) | Self::Study(_) | Self::Report(_) => Vec::new(),
        }
    }
}

fn numbered(name: &str, tables: impl Iterator<Item = Table>) -> Vec<(String, Table)> {
    tables.enumerate().map(|(index, table)| (format!("{name} {}", index + 1), table)).collect()
}

/// The number of that name; a file from elsewhere may lack it.
fn of(values: &Named<f64>, name: &str) -> f64 {
    values.get(name).copied().unwrap_or(f64::NAN)
}

fn equilibria(result: &StaticResult) -> Table {
    let rows = &result.equilibria;
    let shafts = rows.first().map(|row| row.twist.keys()).into_iter().flatten();
    let mut columns = Vec::new();
    for shaft in shafts {
        let twist = rows.iter().map(|row| of(&row.twist, shaft)).collect();
        let torque = rows.iter().map(|row| of(&row.torque, shaft)).collect();
        columns.push(Column::new(format!("{shaft}.twist"), "rad", twist));
        columns.push(Column::new(format!("{shaft}.torque"), "N·m", torque));
    }
    let stable = rows.iter().map(|row| f64::from(u8::from(row.stable))).collect();
    columns.push(Column::new("stable", "1", stable));
    Table::new(columns)
}

fn modes(result: &ModesResult) -> Table {
    let rows = &result.modes;
    let column = |name: &str, unit: &str, value: fn(&crate::Mode) -> f64| {
        Column::new(name, unit, rows.iter().map(value).collect())
    };
    let mut columns = vec![
        column("frequency", "rad/s", |mode| mode.frequency),
        column("damped_frequency", "rad/s", |mode| mode.damped_frequency),
        column("damping_ratio", "1", |mode| mode.damping_ratio),
    ];
    for node in rows.first().map(|mode| mode.shape.keys()).into_iter().flatten() {
        let shape = rows.iter().map(|mode| of(&mode.shape, node)).collect();
        columns.push(Column::new(format!("{node}.shape"), "1", shape));
    }
    Table::new(columns)
}
