//! Questions as data: what can be asked of a line, whoever asks.
//!
//! The command line, study files and other faces fill in [`QuestionText`]; [`read()`] turns it
//! into a [`Question`] in SI or into every mistake at once. The analyses take it from there.

mod basins;
mod bifurcation;
mod channel;
mod kinds;
mod linear;
mod parameter_axis;
mod periodic;
mod read;
mod simulate;
mod text;
mod values;

pub use bifurcation::{BifurcationQuestion, SweepDirection};
pub use channel::{Channel, ChannelQuantity, InitialValue, parse_initial};
pub use kinds::{
    BasinsQuestion, DEFAULT_POINTS, FoldsQuestion, ModesQuestion, ParameterRange, Question,
    ResonanceMethod, ResonanceQuestion, ShockEquation, ShockMethod, ShockQuestion, StabilityMethod,
    Start, Verb,
};
pub use linear::{CampbellQuestion, ForcedQuestion};
pub use read::read;
pub use simulate::{DryFriction, IntegratorChoice, SimulateQuestion};
pub use text::{OptionError, QuestionText};
