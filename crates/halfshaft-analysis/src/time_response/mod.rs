//! Time histories of the full equations, the last word on every other answer.
//!
//! [`mod@run`] integrates from a state to an end time, restarting where pulses begin and end and
//! wherever a connection changes its mode (contact, stage, stick and slip): [`watch`] meets those
//! events exactly, [`events`] lists and counts them. A [`recorder`] is shown every step, fills the
//! history and finds turning points on the dense output. Work and heat are integrated beside the motion, so that the energy
//! balance of a run measures its error.

mod answer;
mod channels;
mod engine;
mod events;
mod initial;
mod orders;
mod recorder;
mod roughness;
mod run;
mod watch;

pub(crate) use answer::{DEFAULT_PARTS, channel_metrics, energy_warning, history_columns, solve};
pub(crate) use initial::start_state;
pub(crate) use recorder::{Recorder, TracePoint, TurningPoint};
pub(crate) use run::{Run, RunSettings, reaches, run};
