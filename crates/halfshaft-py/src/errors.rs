//! From the errors of Rust to the exceptions of the package, which are Python classes.

use halfshaft::model::question::OptionError;
use halfshaft::model::study::StudyError;
use halfshaft::model::{ChangeError, FileError, Severity};
use halfshaft::{AnalysisError, Diagnostics, LoadError, OutputError};
use pyo3::exceptions::PyFileNotFoundError;
use pyo3::prelude::*;

/// One finding as Python takes it: severity, file, line, column, message, excerpt, hint.
pub type Finding = (&'static str, String, usize, usize, String, String, Option<String>);

/// An exception of the package by its name, with what its class takes.
fn exception<'py, A>(py: Python<'py>, name: &str, arguments: A) -> PyErr
where
    A: pyo3::call::PyCallArgs<'py>,
{
    let made = py
        .import("halfshaft._errors")
        .and_then(|module| module.getattr(name))
        .and_then(|class| class.call1(arguments));
    made.map_or_else(|error| error, PyErr::from_value)
}

/// The findings with their places, all of them.
pub fn findings(found: &Diagnostics) -> Vec<Finding> {
    let lines: Vec<_> = found.sources.iter().map(|source| source.lines()).collect();
    let finding = |item: &halfshaft::model::Diagnostic| {
        let source = found.sources.get(item.source)?;
        let (line, column) = lines.get(item.source)?.position(item.span.start);
        let severity = match item.severity {
            Severity::Error => "error",
            Severity::Warning => "warning",
        };
        let excerpt = source.excerpt(&item.span).to_owned();
        let (file, message) = (known_here(&source.name), item.message.clone());
        Some((severity, file, line, column, message, excerpt, item.hint.clone()))
    };
    found.items.iter().filter_map(finding).collect()
}

/// Text about the flag of the command line that `with_` fills, in the words of Python.
fn known_here(text: &str) -> String {
    text.replace("--set", "with_")
}

/// `ModelError` with all findings.
pub fn diagnostics(py: Python<'_>, found: &Diagnostics) -> PyErr {
    let message = known_here(&format!("the model has mistakes:\n{}", found.plain().trim_end()));
    exception(py, "ModelError", (message, findings(found)))
}

/// What hinders a file from being read.
pub fn file(py: Python<'_>, error: &FileError) -> PyErr {
    match error {
        FileError::Unreadable { source, .. } if source.kind() == std::io::ErrorKind::NotFound => {
            PyFileNotFoundError::new_err(error.to_string())
        }
        _ => exception(py, "ModelError", (error.to_string(),)),
    }
}

/// `ModelError`, or `FileNotFoundError` where there is no file.
pub fn load(py: Python<'_>, error: &LoadError) -> PyErr {
    match error {
        LoadError::Diagnostics(found) => diagnostics(py, found),
        LoadError::File(error) => file(py, error),
    }
}

/// The same for a study file.
pub fn study(py: Python<'_>, error: &StudyError) -> PyErr {
    match error {
        StudyError::Diagnostics(found) => diagnostics(py, found),
        StudyError::File(error) => file(py, error),
    }
}

/// `QuestionError` with what is wrong with each option.
pub fn options(py: Python<'_>, errors: &[OptionError]) -> PyErr {
    let name = |error: &OptionError| error.option.replace('-', "_");
    let told: Vec<_> = errors
        .iter()
        .map(|error| (name(error), error.text.clone(), error.message.clone(), error.hint.clone()))
        .collect();
    exception(py, "QuestionError", (told,))
}

/// `ModelError` for a value that the line cannot have.
pub fn change(py: Python<'_>, error: &ChangeError) -> PyErr {
    exception(py, "ModelError", (error.to_string(),))
}

/// `ModelError` with a plain message.
pub fn model(py: Python<'_>, message: String) -> PyErr {
    exception(py, "ModelError", (message,))
}

/// `QuestionError` about one option.
pub fn option(py: Python<'_>, name: &str, message: &str) -> PyErr {
    exception(py, "QuestionError", (vec![(name, "", message, "")],))
}

/// Why a question has no answer: bad input, mathematics that did not converge, or the line itself.
pub fn analysis(py: Python<'_>, error: &AnalysisError) -> PyErr {
    let (message, advice) = (error.to_string(), error.advice());
    match error {
        AnalysisError::InitialValues { .. }
        | AnalysisError::NoSuchMode { .. }
        | AnalysisError::NoSuchEquilibrium { .. } => {
            let hint = advice.unwrap_or_default();
            exception(py, "QuestionError", (vec![("", String::new(), message, hint)],))
        }
        AnalysisError::Numerics { .. } | AnalysisError::EndedEarly { .. } => {
            exception(py, "ConvergenceError", (message, advice))
        }
        _ => exception(py, "AnalysisError", (message, advice)),
    }
}

/// `OutputError` with what to do.
pub fn output(py: Python<'_>, error: &OutputError) -> PyErr {
    exception(py, "OutputError", (error.to_string(), error.advice()))
}

/// `OutputError` with a plain message.
pub fn unwritable(py: Python<'_>, message: String) -> PyErr {
    exception(py, "OutputError", (message,))
}
