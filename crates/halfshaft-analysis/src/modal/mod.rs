//! Natural frequencies, damping and shapes of small vibrations about an equilibrium.
//!
//! The rigid-body motion is taken out exactly, orthogonal in the inertia ([`elastic`]); what
//! is left is a symmetric eigenproblem. Damping then couples the undamped modes
//! ([`damped`]).

mod answer;
mod damped;
pub(crate) mod elastic;
mod label;

pub(crate) use answer::{by_connection, choose_equilibrium, mode_label, rest_result, solve};
pub(crate) use elastic::ElasticMode;
