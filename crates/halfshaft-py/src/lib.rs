//! `halfshaft._halfshaft`, the extension module behind the Python package.
//!
//! It is thin: a `line::Line` is a validated driveline, an `answer::PyAnswer` an answer, and both go
//! through the façade crate. What makes them feel native (keywords, units, tables, errors with what was
//! reached) is Python, in `python/halfshaft`.
#![allow(clippy::needless_pass_by_value, reason = "arguments of Python arrive by value")]

mod answer;
mod columns;
mod ensemble;
mod errors;
mod function;
mod line;
mod options;
mod shared;
mod text;
mod work;

use std::ffi::OsString;

use pyo3::prelude::*;

/// Driveline models, questions and answers in Rust.
#[pymodule]
mod _halfshaft {
    #[pymodule_export]
    use super::answer::PyAnswer;
    #[pymodule_export]
    use super::ensemble::Ensemble;
    #[pymodule_export]
    use super::function::Sampled;
    #[pymodule_export]
    use super::line::Line;
    #[pymodule_export]
    use super::line::run_study;
    #[pymodule_export]
    use super::text::{json_of_toml, toml_of_json};
    #[pymodule_export]
    use super::{main, version};
}

/// The command line: `arguments` begin with the program's name. Returns the exit status; help and usage
/// errors end the process.
#[pyfunction]
fn main(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    py.detach(|| halfshaft_cli::run(&arguments))
}

/// Version of the program.
#[pyfunction]
fn version() -> &'static str {
    halfshaft::VERSION
}
