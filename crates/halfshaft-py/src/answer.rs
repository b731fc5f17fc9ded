//! An answer.

use std::path::PathBuf;

use halfshaft::present::figure::{Figure, SvgOptions, plotly, png, svg};
use halfshaft::present::{figures, html, sketch, summary};
use halfshaft::results::io;
use halfshaft::{Answer, Target};
use pyo3::exceptions::{PyIndexError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::columns::{self, Named};
use crate::{errors, work};

/// An answer that never changes; arrays over its numbers keep it alive.
#[pyclass(frozen, module = "halfshaft._halfshaft", name = "Answer")]
pub struct PyAnswer {
    answer: Answer,
}

impl PyAnswer {
    pub fn new(answer: Answer) -> Self {
        Self { answer }
    }

    fn figure(&self, index: usize) -> PyResult<Figure> {
        let there = figures::of(&self.answer).into_iter().nth(index);
        there.ok_or_else(|| PyIndexError::new_err(format!("there is no figure number {index}")))
    }
}

#[pymethods]
impl PyAnswer {
    /// Reads the JSON of an answer.
    #[staticmethod]
    fn from_json(py: Python<'_>, text: &str) -> PyResult<Self> {
        let read = py.detach(|| io::from_json(text));
        read.map(Self::new).map_err(|error| PyValueError::new_err(error.to_string()))
    }

    /// The answer as JSON.
    fn to_json(&self, py: Python<'_>, pretty: bool) -> PyResult<String> {
        let text = py.detach(|| io::to_json(&self.answer, pretty));
        text.map_err(|error| PyValueError::new_err(error.to_string()))
    }

    /// The answer as JSON, with the values of the columns of `bulk` left out.
    fn outline(&self, py: Python<'_>) -> PyResult<String> {
        let text = py.detach(|| {
            let mut answer = self.answer.clone();
            let tables = answer.bulk_mut();
            tables.into_iter().flatten().for_each(|column| column.values = Vec::new());
            io::to_json(&answer, false)
        });
        text.map_err(|error| PyValueError::new_err(error.to_string()))
    }

    /// Name, unit and values of the columns that `outline` leaves out, table by table, without a copy.
    fn bulk<'py>(slf: &Bound<'py, Self>) -> Vec<Vec<Named<'py>>> {
        let tables = columns::bulk(&slf.get().answer);
        tables.into_iter().map(|table| columns::views(slf, table)).collect()
    }

    /// The named tables of an answer that has no bulk; each column owns its numbers.
    fn tables<'py>(&self, py: Python<'py>) -> Vec<(String, Vec<Named<'py>>)> {
        let tables = io::tables_of(&self.answer).into_iter();
        tables.map(|(name, table)| (name, columns::owned(py, table.columns))).collect()
    }

    /// Name of the analysis.
    #[getter]
    fn analysis(&self) -> &str {
        &self.answer.header().analysis
    }

    /// Why the analysis ended, and where it got to where it ended early.
    #[getter]
    fn termination(&self) -> PyResult<(String, Option<String>)> {
        let termination = &self.answer.header().termination;
        let reason = serde_json::to_value(termination.reason)
            .map_err(|error| PyValueError::new_err(error.to_string()))?;
        Ok((reason.as_str().unwrap_or_default().to_owned(), termination.detail.clone()))
    }

    /// What is told of the answer, as text for a terminal.
    fn summary(&self, py: Python<'_>) -> String {
        py.detach(|| summary::text(&self.answer))
    }

    /// One self-contained page.
    fn page(&self, py: Python<'_>) -> String {
        py.detach(|| html::page(&self.answer))
    }

    /// Id, title and caption of each figure.
    fn figures(&self, py: Python<'_>) -> Vec<(String, String, String)> {
        let figures = py.detach(|| figures::of(&self.answer));
        figures.into_iter().map(|figure| (figure.id, figure.title, figure.caption)).collect()
    }

    /// A figure as SVG; for a page without a declaration of its own where `embed`.
    fn figure_svg(&self, py: Python<'_>, index: usize, embed: bool) -> PyResult<String> {
        let options = SvgOptions { embed_in_html: embed };
        py.detach(|| Ok(svg::render(&self.figure(index)?, &options)))
    }

    /// A figure for plotly.js, as JSON: data, layout, config.
    fn figure_plotly(&self, py: Python<'_>, index: usize) -> PyResult<String> {
        py.detach(|| Ok(plotly::figure_json(&self.figure(index)?).to_string()))
    }

    /// A figure as PNG.
    fn figure_png<'py>(
        &self,
        py: Python<'py>,
        index: usize,
        scale: f64,
    ) -> PyResult<Bound<'py, PyBytes>> {
        let drawn = py.detach(|| Ok::<_, PyErr>(png::render(&self.figure(index)?, scale)))?;
        let bytes = drawn.map_err(|error| errors::unwritable(py, error.to_string()))?;
        Ok(PyBytes::new(py, &bytes))
    }

    /// The drawing of the line as SVG, where this is an answer of `check`.
    fn sketch(&self) -> Option<String> {
        match &self.answer {
            Answer::Check(check) => Some(sketch::sketch(check)),
            _ => None,
        }
    }

    /// Writes the answer in the form of the path's ending, or in all forms into a folder; returns the
    /// files written.
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<Vec<PathBuf>> {
        let analysis = self.answer.header().analysis.clone();
        let target =
            Target::prepare(&path, &analysis).map_err(|error| errors::output(py, &error))?;
        let done = work::run(py, None, |watch| halfshaft::write(&self.answer, &target, watch))?;
        match done.raised {
            Some(raised) => Err(raised),
            None => done.value.map_err(|error| errors::output(py, &error)),
        }
    }

    /// Equal to the last bit.
    fn __eq__(&self, other: &Self) -> bool {
        self.answer == other.answer
    }
}
