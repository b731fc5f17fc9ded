//! Natural frequencies, damping and shapes of small vibrations about an equilibrium.
//!
//! The rigid-body motion is taken out exactly, orthogonal in the inertia ([`elastic`]); what
//! is left is a symmetric eigenproblem. Damping then couples the undamped modes
//! ([`damped`]). Long lines, massless nodes and bars with consistent inertia go to a sparse problem of
//! which only the lowest modes are computed ([`sparse`]).

mod answer;
mod chain;
mod damped;
pub(crate) mod elastic;
mod label;
mod refined;
pub(crate) mod sparse;
mod telling;
pub(crate) mod vibration;

pub(crate) use answer::{
    by_connection, choose_equilibrium, damping_ratio, mode_label, rest_result, solve, words,
};
pub(crate) use elastic::ElasticMode;
