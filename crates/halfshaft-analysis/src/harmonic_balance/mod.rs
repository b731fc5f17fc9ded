//! Harmonic balance: periodic responses with as many harmonics as the tolerance needs, followed by
//! arclength, with Floquet stability and located special points.
//!
//! | file | task |
//! |---|---|
//! | `skeleton`, `condensed`, `line` | the linear rest of the line taken out, harmonic by harmonic |
//! | `system` | residual and Jacobian (alternating frequency-time) |
//! | `problem` | Newton's method on a curve |
//! | `tracer` | pseudo-arclength continuation |
//! | `series`, `switching`, `monodromy`, `stability` | Floquet multipliers |
//! | `special` | folds, branch points, period doublings, Neimark-Sacker points |
//! | `seeds`, `branches` | all branches, detached ones included |
//! | `channels`, `jumps`, `range`, `verify`, `answer` | from branches to the answer |

mod answer;
mod branches;
mod channels;
mod condensed;
mod jumps;
mod line;
mod monodromy;
mod problem;
mod range;
mod seeds;
mod series;
mod skeleton;
mod special;
mod stability;
mod switching;
mod system;
#[cfg(test)]
mod tests;
mod tracer;
mod verify;

use halfshaft_model::Driveline;
use halfshaft_model::question::FoldsQuestion;
use halfshaft_numerics::observer::Observer;
use halfshaft_results::FoldsResult;

use crate::error::AnalysisError;

pub(crate) use answer::solve;

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
