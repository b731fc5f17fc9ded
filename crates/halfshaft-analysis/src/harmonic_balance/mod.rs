//! Harmonic balance: periodic responses with as many harmonics as the tolerance needs, followed by
//! arclength, with Floquet stability and located special points.
//!
//! | file | task |
//! |---|---|
//! | `skeleton`, `condensed`, `line` | the linear rest of the line taken out, harmonic by harmonic |
//! | `system`, `kinks` | residual and Jacobian (alternating frequency-time; from kink to kink) |
//! | `problem` | Newton's method on a curve |
//! | `tracer`, `predictor`, `adapting`, `closing` | pseudo-arclength continuation |
//! | `series`, `tangents`, `switching`, `lanes`, `panels`, `horner`, `structure`, `whole_line`, `monodromy`, `side_by_side`, `hill`, `stability` | Floquet multipliers, two ways |
//! | `special`, `grazing` | folds, branch points, period doublings, Neimark-Sacker points, grazing contact |
//! | `orbits`, `refine` | special points of lines with kinks, by shooting |
//! | `exact` | branches of lines with kinks, by shooting |
//! | `seeds`, `passages`, `tips`, `branches`, `branching` | all branches, detached ones and those that branch off included |
//! | `lines`, `fold_system`, `fold_points`, `fold_trace`, `fold_answer` | curves of folds in a plane, cusps, births of detached responses |
//! | `backbone` | phase resonance, and free oscillation without damping |
//! | `parameter_answer` | a number of the line in place of the speed |
//! | `strobed` | branches as states at the beginning of periods |
//! | `channels`, `breaks`, `measured`, `jumps`, `range`, `verify`, `messages`, `answer` | from branches to the answer |
//! | `layers` | single layers, for benches |

mod adapting;
mod alternating;
mod answer;
mod at_speed;
mod backbone;
mod branches;
mod branching;
mod breaks;
mod channels;
mod closing;
mod condensed;
mod exact;
mod fold_answer;
mod fold_count;
mod fold_points;
mod fold_system;
mod fold_trace;
mod gaps;
mod grazing;
mod hill;
mod horner;
mod images;
mod jumps;
mod kinks;
mod lanes;
pub mod layers;
mod line;
mod lines;
mod locating;
mod measured;
mod messages;
mod modes;
mod monodromy;
mod orbits;
mod panels;
mod parameter_answer;
mod passages;
mod predictor;
mod problem;
mod range;
mod receptance;
mod reduction;
mod refine;
mod seeds;
mod segment;
mod series;
mod settling;
mod side_by_side;
mod skeleton;
mod special;
mod stability;
mod strobed;
mod structure;
mod switching;
mod system;
mod tangents;
#[cfg(test)]
mod tests;
mod tips;
mod tracer;
mod verify;
mod whole_line;

pub(crate) use answer::solve;
pub(crate) use at_speed::{AtSpeed, Response};
pub(crate) use fold_answer::solve as solve_folds;
pub(crate) use strobed::{Prepared, Strobe, StrobedResponses, strobed};
