//! halfshaft: nonlinear torsional dynamics of automotive drivelines.
//!
//! The whole program in four steps: [`load()`] a model file, [`ask`] a question about the line,
//! look at the answer ([`present`]), write it down ([`write()`]).
//!
//! ```
//! use halfshaft::{Answer, Question, Silent, ask, load_embedded};
//!
//! let loaded = load_embedded(&[])?;
//! let answer = ask(&loaded.line, &Question::Static, &Silent)?;
//! let Answer::Static(statics) = &answer else { unreachable!("static answers static") };
//! let capacity = statics.torque_capacity["half-shaft"];
//! assert!(capacity.is_some_and(|torque| (torque - 7814.175).abs() < 1e-3)); // N·m
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Faces (command line, Python, web) use this crate and no other of the workspace.

mod function;
mod load;
mod output;
mod parquet;
mod report;
mod study;
mod target;

pub use halfshaft_analysis::{AnalysisError, ask};
pub use halfshaft_model as model;
pub use halfshaft_model::question::{Question, QuestionText, Verb};
pub use halfshaft_model::{Diagnostics, Driveline, SetFlag};
pub use halfshaft_numerics::observer::{Observer, Silent};
pub use halfshaft_present as present;
pub use halfshaft_results as results;
pub use halfshaft_results::Answer;

pub use function::{LawError, SampleError, Sampling, sample_law, with_law};
pub use load::{LoadError, Loaded, load, load_embedded};
pub use output::write;
pub use report::report;
pub use study::run_study;
pub use target::{Format, OutputError, Target};

/// Version of the program.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// The README's program is compiled and run with the documentation's.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
