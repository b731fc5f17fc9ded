//! How a line takes a disturbance: a torque pulse or a wound-up shaft.
//!
//! - [`full`]: the whole line, the method to trust;
//! - [`single`]: one equation for the load on its shaft, with the drive end held (`clamped`),
//!   with the manuscript's doubled coefficients (`published`), or for the relative twist of
//!   the free two-mass line (`twist`);
//! - [`multiple_scales`], [`closed`]: closed forms of such an equation;
//! - [`comparison`]: all of them from one and the same disturbance.

mod answer;
mod closed;
mod comparison;
mod full;
mod metrics;
mod multiple_scales;
mod single;

pub(crate) use answer::solve;
pub(crate) use full::shaft_metrics;
