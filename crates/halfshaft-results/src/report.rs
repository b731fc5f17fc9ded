//! Answer of `report`: all the answers that make its pages.

use serde::{Deserialize, Serialize};

use crate::{
    CheckResult, FoldsResult, Header, HistoryResult, ModesResult, ResonanceResult, StaticResult,
};

/// A section that the report cannot have, and why.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct MissingSection {
    /// Name of the analysis.
    pub section: String,
    /// Why there is no answer.
    pub reason: String,
    /// What to try.
    pub advice: Option<String>,
}

/// Answer of `report`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReportResult {
    /// What every result says.
    #[serde(flatten)]
    pub header: Header,
    /// The line.
    pub check: CheckResult,
    /// States of rest and capacity.
    pub statics: Option<StaticResult>,
    /// Modes about the state of rest.
    pub modes: Option<ModesResult>,
    /// Shock by all methods.
    pub shock: Option<HistoryResult>,
    /// Resonance, checked by integration.
    pub resonance: Option<ResonanceResult>,
    /// Fold curves, one plane each.
    pub folds: Vec<FoldsResult>,
    /// Sections that could not be had.
    pub missing: Vec<MissingSection>,
}
