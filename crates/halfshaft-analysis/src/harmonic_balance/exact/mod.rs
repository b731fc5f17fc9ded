//! Branches of lines whose laws have kinks, as exact orbits.
//!
//! Where a law has kinks the harmonics of a response decay like a power of their order only, and a
//! tight tolerance needs hundreds of them. Such lines are followed by shooting instead
//! ([`crate::shooting`]): pseudo-arclength continuation of the fixed points of the stroboscopic map,
//! whose derivative gives the multipliers along with each orbit. Harmonics are taken from the orbits
//! afterwards, as many as the tolerance asks for.
//!
//! | file | task |
//! |---|---|
//! | `point` | an orbit on a branch, the metric, directions |
//! | `closing` | whether a branch has come back |
//! | `curve` | pseudo-arclength continuation |
//! | `special`, `touch` | special points between two orbits |
//! | `explorer` | seeds followed, told apart, joined |
//! | `fork` | branches that branch off |
//! | `seeds` | orbits to begin with: over the drive, and by letting the line run |
//! | `gaps` | where nothing stable is known yet |
//! | `responses` | orbits as responses with harmonics |
//! | `answer` | all of it |

mod answer;
mod closing;
mod curve;
mod explorer;
mod fork;
mod gaps;
mod point;
mod responses;
mod seeds;
mod special;
mod touch;

pub(super) use answer::{MOST_GROUPS, collect};
pub(super) use explorer::Guess;
pub(super) use point::Kind;
pub(super) use seeds::{MOST_MULTIPLE, SETTLES, at_rest, is_mirrored, settled, starts};
