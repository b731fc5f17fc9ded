//! Driveline elements, units, parameter addresses and the model file.
//!
//! In goes a text, out comes a validated [`Driveline`] in SI or every mistake in the text at
//! once as [`Diagnostics`]. Nothing here solves anything.
//!
//! - [`read_file`] and [`read_model`]: from a path to a line; [`embedded`] has one built in.
//! - [`elements`]: what a line is made of, one file each.
//! - [`Driveline`], [`Topology`]: the line and which of its nodes turn rigidly together.
//! - [`Parameter`]: addresses such as `half-shaft.cubic`, for `--set` and for sweeps.
//! - [`units`]: text with units to SI and nothing else in the program parses units.
//! - [`question`] and [`study`]: what can be asked of a line, as data.
//! - [`format`](mod@format): the keys of the files, their JSON schema and reference page.

pub mod diagnostic;
mod driveline;
pub mod elements;
pub mod embedded;
pub mod format;
mod parameter;
pub mod question;
mod range;
pub mod study;
pub mod units;

pub use diagnostic::{Diagnostic, Diagnostics, Severity, Source};
pub use driveline::{
    ChangeError, Driveline, End, FunctionError, Group, LockedLoop, Network, Node, Topology,
    TopologyError, TreeShaft,
};
pub use format::{FileError, SetFlag, read_file, read_model};
pub use parameter::{AddressError, Parameter};
pub use range::{RangeError, parse_flag_quantity, parse_range};

/// Name of the fixed node.
pub const GROUND: &str = "ground";
