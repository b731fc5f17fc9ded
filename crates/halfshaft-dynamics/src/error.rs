//! Why a line has no equations of motion.

use halfshaft_model::TopologyError;

/// Why a line has no equations of motion.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DynamicsError {
    /// The gears contradict each other.
    #[error(transparent)]
    Gears(#[from] TopologyError),
    /// The line is not one connected line with inertia everywhere (validation prevents it).
    #[error("the line is not connected or has a node without inertia")]
    Degenerate,
}
