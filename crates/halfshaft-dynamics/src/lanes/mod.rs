//! A line over lanes: many motions of lines of one build at once, each with its own start, speed,
//! excitation and values, by Taylor series from one switching of a law to the next.
//!
//! The coordinates are those of [`Motion`](crate::Motion): twists of the spanning tree and, for a free
//! line, the mean angle, then their rates. In them
//!
//! ```text
//! x_i'' = b_i + s_i t + Σ_h g_ih cos(speed_h t + phase_h) - Σ_e a_ie T_e - Σ_j d_ij x_j'
//! ```
//!
//! with the torque `T_e` of a connection: the present piece of its law along its twist, its damping and
//! its regularised friction.
//! The build of a line ([`LaneLine`]) says which of these factors there are; their values are the
//! parameters of a trajectory.
//!
//! | file | task |
//! |---|---|
//! | `build` | which factors there are, and their places among the parameters |
//! | `values` | their values, pieces of laws, pulses |
//! | `recurrence` | the Taylor coefficients, one power after the other |

mod build;
mod recurrence;
mod values;

pub use build::LaneLine;

/// Why a line cannot be integrated beside others.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum LaneError {
    /// A trajectory's line has other parts than the one that was prepared.
    #[error("the lines of an ensemble differ in {what}, not only in values")]
    OtherBuild {
        /// What differs.
        what: &'static str,
    },
}
