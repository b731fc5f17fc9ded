//! Harmonic balance: periodic responses with as many harmonics as the tolerance needs.

use halfshaft_model::Driveline;
use halfshaft_model::question::{FoldsQuestion, ResonanceQuestion};
use halfshaft_numerics::observer::Observer;
use halfshaft_results::{FoldsResult, ResonanceResult};

use crate::error::AnalysisError;

/// Answers `resonance`.
pub(crate) fn solve(
    _line: &Driveline,
    _question: &ResonanceQuestion,
    _observer: &dyn Observer,
) -> Result<ResonanceResult, AnalysisError> {
    Err(AnalysisError::MethodDoesNotFit {
        method: "harmonic-balance",
        reason: "in the making".to_owned(),
    })
}

/// Answers `folds`.
pub(crate) fn solve_folds(
    _line: &Driveline,
    _question: &FoldsQuestion,
    _observer: &dyn Observer,
) -> Result<FoldsResult, AnalysisError> {
    Err(AnalysisError::MethodDoesNotFit {
        method: "harmonic-balance",
        reason: "in the making".to_owned(),
    })
}
