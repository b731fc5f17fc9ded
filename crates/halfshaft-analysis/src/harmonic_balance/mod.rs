//! Harmonic balance: periodic responses with as many harmonics as the tolerance needs, followed by
//! arclength, with Floquet stability and located special points.
//!
//! | file | task |
//! |---|---|
//! | `skeleton`, `condensed`, `line` | the linear rest of the line taken out, harmonic by harmonic |
//! | `system` | residual and Jacobian (alternating frequency-time) |
//! | `problem` | Newton's method on a curve |
//! | `tracer` | pseudo-arclength continuation |
//! | `series`, `switching`, `monodromy`, `hill`, `stability` | Floquet multipliers, two ways |
//! | `special`, `grazing` | folds, branch points, period doublings, Neimark-Sacker points, grazing contact |
//! | `orbits`, `refine` | special points of lines with kinks, by shooting |
//! | `seeds`, `branches`, `branching` | all branches, detached ones and those that branch off included |
//! | `channels`, `jumps`, `range`, `verify`, `answer` | from branches to the answer |

mod answer;
mod branches;
mod branching;
mod channels;
mod condensed;
mod grazing;
mod hill;
mod jumps;
mod line;
mod monodromy;
mod orbits;
mod problem;
mod range;
mod refine;
mod seeds;
mod series;
mod skeleton;
mod special;
mod stability;
mod switching;
mod system;
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
