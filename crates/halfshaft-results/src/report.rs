//! Answer of `report`: all the answers that make its pages.

use serde::{Deserialize, Serialize};

use crate::{
    BasinsResult, CampbellResult, CheckResult, FoldsResult, ForcedResult, Header, HistoryResult,
    ModesResult, ResonanceResult, StaticResult,
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

/// One value by every method that tells it: what a report holds side by side.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct LevelRow {
    /// What it is, in words: "peak: speed".
    pub what: String,
    /// Excitation speed at which it is taken, rad/s, where the speed is not itself what differs.
    pub at: Option<f64>,
    /// Symbol of its unit.
    pub unit: String,
    /// By the closed form of one mode.
    pub closed_form: Option<f64>,
    /// By one harmonic of the whole line.
    pub first_harmonic: Option<f64>,
    /// By as many harmonics as the tolerance needs.
    pub harmonic_balance: Option<f64>,
    /// By a periodic motion of the full equations.
    pub integration: Option<f64>,
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
    /// Critical speeds in the gear of the model.
    #[serde(default)]
    pub campbell: Option<CampbellResult>,
    /// Linear vibration over the speed in the gear of the model.
    #[serde(default)]
    pub forced: Option<ForcedResult>,
    /// Shock by all methods.
    pub shock: Option<HistoryResult>,
    /// Resonance by harmonic balance, checked by integration.
    pub resonance: Option<ResonanceResult>,
    /// The same by one harmonic.
    #[serde(default)]
    pub first_harmonic: Option<ResonanceResult>,
    /// The same in closed form, checked by integration.
    #[serde(default)]
    pub closed_form: Option<ResonanceResult>,
    /// Which start leads where, and the smallest shocks, at a speed with several stable responses.
    #[serde(default)]
    pub basins: Option<BasinsResult>,
    /// Values by every method side by side.
    #[serde(default)]
    pub levels: Vec<LevelRow>,
    /// Fold curves by harmonic balance, one plane each.
    pub folds: Vec<FoldsResult>,
    /// Fold curves in closed form, one plane each.
    #[serde(default)]
    pub closed_folds: Vec<FoldsResult>,
    /// Sections that could not be had; a method of the resonance is named as such: `resonance`,
    /// `first-harmonic`, `closed-form`.
    pub missing: Vec<MissingSection>,
}

impl ReportResult {
    /// The resonance by the best method that has one.
    pub fn best_resonance(&self) -> Option<&ResonanceResult> {
        self.resonance.as_ref().or(self.closed_form.as_ref()).or(self.first_harmonic.as_ref())
    }

    /// The fold curves over a parameter by the best method that has them.
    pub fn best_folds(&self, parameter: &str) -> Option<&FoldsResult> {
        let all = self.folds.iter().chain(&self.closed_folds);
        all.into_iter().find(|plane| plane.parameter == parameter)
    }
}
