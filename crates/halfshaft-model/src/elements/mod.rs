//! The elements of a driveline, one file each: values in SI, keys of the model file,
//! parameter addresses.
//!
//! To add an element: a file here with its struct, its [`TableSpec`](crate::format::TableSpec)
//! and its `read` function, and a line in [`crate::format::MODEL`].

mod gear;
mod inertia;
mod pulse;
mod shaft;
mod torque;

pub use gear::{GEAR, Gear};
pub use inertia::{INERTIA, Inertia};
pub use pulse::{PULSE, Pulse, PulseShape};
pub use shaft::{SHAFT, Shaft};
pub(crate) use torque::BALANCE as BALANCE_WORD;
pub use torque::{HARMONIC, Harmonic, MeanTorque, TORQUE, Torque};
