//! TOML as JSON and back, because Python 3.10 has no reader of TOML and no version has a writer.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use serde_json::Value;

/// The tables of a TOML text as JSON, in the order of the text.
#[pyfunction]
pub fn json_of_toml(text: &str) -> PyResult<String> {
    let value: Value = toml::from_str(text).map_err(refused)?;
    Ok(value.to_string())
}

/// A JSON object as TOML.
#[pyfunction]
pub fn toml_of_json(text: &str) -> PyResult<String> {
    let value: Value = serde_json::from_str(text).map_err(refused)?;
    toml::to_string(&value).map_err(refused)
}

fn refused(error: impl std::fmt::Display) -> PyErr {
    PyValueError::new_err(error.to_string())
}
