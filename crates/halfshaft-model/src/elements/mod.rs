//! The elements of a driveline, one file each: values in SI, keys of the model file,
//! parameter addresses.
//!
//! To add an element: a file here with its struct, its [`TableSpec`](crate::format::TableSpec)
//! and its `read` function, and a line in [`crate::format::MODEL`].

mod engagement;
mod gear;
mod inertia;
mod law_keys;
mod law_order;
mod measured;
mod pulse;
mod shaft;
mod stage;
mod torque;
mod torque_table;

pub use engagement::{ENGAGEMENT, Engagement};
pub use gear::{GEAR, Gear};
pub use inertia::{INERTIA, Inertia};
pub(crate) use law_keys::{check_gear, check_shaft, check_torque};
pub use law_order::LawFault;
pub use measured::{MEASURED, MeasuredLaw};
pub use pulse::{PULSE, Pulse, PulseShape};
pub use shaft::{FRICTION_SPEED_RAD_S, SHAFT, Shaft};
pub use stage::{STAGE, Stage};
pub(crate) use torque::BALANCE as BALANCE_WORD;
pub use torque::{HARMONIC, Harmonic, MeanTorque, TORQUE, Torque};
pub use torque_table::{TORQUE_TABLE, TorqueTable};
