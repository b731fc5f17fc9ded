//! A validated driveline.

use std::path::PathBuf;

use halfshaft::model::study::read_study;
use halfshaft::model::{SetFlag, Source, read_model};
use halfshaft::{Answer, Diagnostics, Driveline, LoadError, Loaded, load, load_embedded, report};
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::answer::PyAnswer;
use crate::errors::{self, Finding};
use crate::function::Sampled;
use crate::options;
use crate::shared::Watch;
use crate::work;

/// A driveline that has passed validation and never changes.
#[pyclass(frozen, module = "halfshaft._halfshaft")]
pub struct Line {
    pub line: Driveline,
    warnings: Diagnostics,
}

#[pymethods]
impl Line {
    /// Reads a model text; paths of measured tables in it are relative to the folder of `name`.
    #[staticmethod]
    fn read(py: Python<'_>, text: &str, name: &str, settings: Vec<String>) -> PyResult<Self> {
        let read = py.detach(|| read_model(Source::new(name, text), &flags(settings)));
        let (line, warnings) = read.map_err(|found| errors::diagnostics(py, &found))?;
        Ok(Self { line, warnings })
    }

    /// Reads a model file.
    #[staticmethod]
    fn load(py: Python<'_>, path: PathBuf, settings: Vec<String>) -> PyResult<Self> {
        let loaded = py.detach(|| load(&path, &flags(settings)));
        Self::of(py, loaded)
    }

    /// The built-in example with its text.
    #[staticmethod]
    fn example(py: Python<'_>) -> PyResult<(Self, String, String)> {
        let source = halfshaft::model::embedded::example();
        Ok((Self::of(py, load_embedded(&[]))?, source.name, source.text))
    }

    /// The line with laws from functions, by names of shafts. All of `addresses`, which were set before,
    /// must still lead somewhere.
    fn with_functions(
        &self,
        py: Python<'_>,
        laws: Vec<(String, PyRef<'_, Sampled>)>,
        addresses: Vec<String>,
    ) -> PyResult<Self> {
        let mut line = self.line.clone();
        let mut found = Vec::new();
        for (shaft, sampled) in &laws {
            match line.with_function(shaft, sampled.law.clone()) {
                Ok(with) => line = with,
                Err(error) => found.push(error.to_string()),
            }
        }
        let lost = addresses.iter().filter_map(|address| line.parameter(address).err());
        found.extend(lost.map(|error| format!("{error}: {}", error.hint(&line))));
        if !found.is_empty() {
            return Err(errors::model(py, found.join("\n")));
        }
        Ok(Self { line, warnings: self.warnings.clone() })
    }

    /// Name of the line.
    #[getter]
    fn name(&self) -> &str {
        self.line.name()
    }

    /// Free text about the line.
    #[getter]
    fn description(&self) -> &str {
        self.line.description()
    }

    /// SHA-256 over all values in SI.
    #[getter]
    fn digest(&self) -> String {
        self.line.digest()
    }

    /// What is odd about the model, never errors.
    #[getter]
    fn warnings(&self) -> Vec<Finding> {
        errors::findings(&self.warnings)
    }

    /// Names of all elements.
    #[getter]
    fn elements(&self) -> Vec<String> {
        self.line.element_names().map(str::to_owned).collect()
    }

    /// Answers a question; `True` where Ctrl-C ended it, so that the answer is what was reached.
    #[pyo3(signature = (verb, options, progress=None))]
    fn ask(
        &self,
        py: Python<'_>,
        verb: &str,
        options: &Bound<'_, PyDict>,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<(PyAnswer, bool)> {
        let question = options::question(verb, options, &self.line)?;
        let work = |watch: &Watch| halfshaft::ask(&self.line, &question, watch);
        answered(py, work::run(py, progress, work)?)
    }

    /// Everything about the line in one answer.
    #[pyo3(signature = (progress=None))]
    fn report(
        &self,
        py: Python<'_>,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<(PyAnswer, bool)> {
        let work = |watch: &Watch| {
            report(&self.line, watch).map(|report| Answer::Report(Box::new(report)))
        };
        answered(py, work::run(py, progress, work)?)
    }
}

impl Line {
    fn of(py: Python<'_>, loaded: Result<Loaded, LoadError>) -> PyResult<Self> {
        let Loaded { line, warnings } = loaded.map_err(|error| errors::load(py, &error))?;
        Ok(Self { line, warnings })
    }
}

/// All questions of a study file.
#[pyfunction]
#[pyo3(signature = (path, progress=None))]
pub fn run_study(
    py: Python<'_>,
    path: PathBuf,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<(PyAnswer, bool)> {
    let study = py.detach(|| read_study(&path)).map_err(|error| errors::study(py, &error))?;
    let work = |watch: &Watch| Ok(Answer::Study(halfshaft::run_study(&study, watch)));
    answered(py, work::run(py, progress, work)?)
}

fn flags(settings: Vec<String>) -> Vec<SetFlag> {
    settings.into_iter().map(SetFlag).collect()
}

/// An answer with whether Ctrl-C ended it. Any other exception of a signal or of the progress wins, and
/// so does Ctrl-C where nothing was reached.
fn answered(
    py: Python<'_>,
    done: work::Done<Result<Answer, halfshaft::AnalysisError>>,
) -> PyResult<(PyAnswer, bool)> {
    match (done.value, done.raised) {
        (Ok(answer), None) => Ok((PyAnswer::new(answer), false)),
        (Ok(answer), Some(raised)) if raised.is_instance_of::<PyKeyboardInterrupt>(py) => {
            Ok((PyAnswer::new(answer), true))
        }
        (_, Some(raised)) => Err(raised),
        (Err(error), None) => Err(errors::analysis(py, &error)),
    }
}
