//! The elements of a driveline, one file each: values in SI, keys of the model file,
//! parameter addresses.
//!
//! To add an element: a file here with its struct, its [`TableSpec`](crate::format::TableSpec)
//! and its `read` function, and a line in [`crate::format::MODEL`].

mod crank_table;
mod damper;
mod dimensions;
mod engagement;
mod engine;
mod engine_keys;
mod gear;
mod inertia;
mod law_keys;
mod law_order;
mod measured;
mod order_table;
mod pulse;
mod sampled;
mod shaft;
mod stage;
mod torque;
mod torque_table;
mod whole_line;

pub use crank_table::{CRANK_PRESSURE, CRANK_TORQUE, CrankTable};
pub use damper::{DAMPER, Damper};
pub use dimensions::Dimensions;
pub use engagement::{ENGAGEMENT, Engagement};
pub use engine::{CrankGear, ENGINE, Engine, MOST_HIGHEST_ORDER};
pub(crate) use engine_keys::check_engine;
pub use gear::{GEAR, Gear};
pub use inertia::{INERTIA, Inertia};
pub(crate) use law_keys::{check_gear, check_shaft, check_torque};
pub use law_order::LawFault;
pub use measured::{MEASURED, MeasuredLaw};
pub use order_table::ORDER_TABLE;
pub use pulse::{PULSE, Pulse, PulseShape};
pub use sampled::SampledLaw;
pub use shaft::{FRICTION_SPEED_RAD_S, SHAFT, Shaft};
pub use stage::{STAGE, Stage};
pub(crate) use torque::BALANCE as BALANCE_WORD;
pub use torque::{HARMONIC, Harmonic, MeanTorque, TORQUE, Torque};
pub use torque_table::{TORQUE_TABLE, TorqueTable};
pub use whole_line::{WHOLE_LINE, WHOLE_LINE_NAME, WholeLine};
