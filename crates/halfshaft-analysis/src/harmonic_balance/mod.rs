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
//! | `fold_system`, `fold_trace`, `fold_answer` | curves of folds in a plane, cusps, births of detached responses |
//! | `channels`, `jumps`, `range`, `verify`, `answer` | from branches to the answer |

mod answer;
mod branches;
mod channels;
mod condensed;
mod fold_answer;
mod fold_system;
mod fold_trace;
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

pub(crate) use answer::solve;
pub(crate) use fold_answer::solve as solve_folds;
