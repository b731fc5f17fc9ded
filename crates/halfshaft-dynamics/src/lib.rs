//! Equations of motion of a torsional driveline.
//!
//! In goes a validated [`Driveline`](halfshaft_model::Driveline), out come
//!
//! ```text
//! M q'' + D q' + Σ w_e [ c_e x_e' + r_e(x_e') + p_e(x_e) ] = Q(t),      x_e = w_eᵀ q
//! ```
//!
//! with the gears taken out: one coordinate `q` for each group of nodes that turn rigidly
//! together. Nothing here knows a solver's settings.
//!
//! - [`laws`]: torque over twist, one file a law.
//! - [`EquationsOfMotion`]: inertias, connections, rigid-body motion, mean torques.
//! - [`Excitation`]: torques over time; [`engine`]: the orders of piston engines.
//! - [`Motion`]: the same as a first-order system for the integrators, in twists of the
//!   spanning tree and the mean angle, with work and heat beside it.
//! - [`Modes`]: what connections do between two events (contact, stages, stick and slip), and where that
//!   ends.
//! - [`lanes`]: many motions at once, by Taylor series over vector registers.

pub mod engine;
mod equations;
mod error;
mod excitation;
mod jacobian;
pub mod lanes;
pub mod laws;
mod linear;
mod modes;
mod motion;
mod rigid;
mod switching;

pub use equations::{Connection, EquationsOfMotion, NodePlace};
pub use error::DynamicsError;
pub use excitation::{Active, Excitation, Source};
pub use laws::{DescribingFunction, Friction, TorqueLaw};
pub use modes::{Modes, Sliding};
pub use motion::{Kinematics, Motion};
pub use rigid::RigidBody;
pub use switching::{Border, BorderKind, EventKind, ModeEvent};
