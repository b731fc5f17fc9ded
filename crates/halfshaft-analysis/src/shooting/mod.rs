//! Shooting: periodic orbits of the full line as it moves, independent of harmonics.
//!
//! The motion goes by Taylor series of degree 20 from one switching of a law to the next, with its
//! variations, so that orbits, their multipliers and their special points come out to rounding for
//! laws with kinks as for smooth ones.
//!
//! | file | task |
//! |---|---|
//! | `series` | Taylor series of laws, friction, cosines |
//! | `motion`, `columns` | the line and its variations about one time |
//! | `coordinates`, `flow` | the state, and its motion over any time |
//! | `orbit`, `waves` | periodic orbits and what they look like |

mod columns;
mod coordinates;
mod flow;
mod motion;
mod orbit;
mod series;
#[cfg(test)]
mod tests;
mod waves;

pub(crate) use coordinates::Coordinates;
pub(crate) use flow::{Flow, Lost, Step};
pub(crate) use orbit::{Orbit, Plane, Shooter, length};
pub(crate) use waves::{Sampled, Swing, Turn};
