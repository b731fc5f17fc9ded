//! First harmonic: all responses of a line with one nonlinear connection.

mod amplitude_polynomial;
mod bracketed;
mod curve;
mod drive;
mod enclosure;
mod jet;
mod limbs;
mod locate;
mod meshed;
mod path;
mod problem;
mod responses;
mod rest;
mod shaft_law;
mod sheets;

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
        method: "first-harmonic",
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
        method: "first-harmonic",
        reason: "in the making".to_owned(),
    })
}
