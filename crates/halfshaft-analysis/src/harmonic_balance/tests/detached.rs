//! Detached branches.
