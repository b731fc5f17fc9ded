//! Torque laws from functions of Python.

use halfshaft::model::elements::SampledLaw;
use halfshaft::model::units::QuantityKind;
use halfshaft::model::{parse_flag_quantity, parse_range};
use halfshaft::{SampleError, Sampling, sample_law};
use numpy::PyArray1;
use pyo3::prelude::*;

use crate::errors;

/// Breaks, origins, coefficients and kinks of a law.
type Parts = (Vec<f64>, Vec<f64>, Vec<Vec<f64>>, Vec<f64>);

/// A law as the polynomials that a function was sampled into; it never changes.
#[pyclass(frozen, module = "halfshaft._halfshaft")]
pub struct Sampled {
    pub law: SampledLaw,
}

#[pymethods]
impl Sampled {
    /// Samples `values`, which takes an array of twists and gives a list of torques. `name` is what the
    /// function is called in errors.
    #[staticmethod]
    fn sample(
        py: Python<'_>,
        values: &Bound<'_, PyAny>,
        name: &str,
        range: Option<&str>,
        kinks: Vec<String>,
    ) -> PyResult<Self> {
        let sampling = sampling(range, &kinks).map_err(|told| errors::model(py, told))?;
        let ask = |twists: &[f64]| {
            let torques = values.call1((PyArray1::from_slice(py, twists),))?;
            torques.extract::<Vec<f64>>()
        };
        match sample_law(ask, &sampling) {
            Ok(law) => Ok(Self { law }),
            Err(SampleError::Function(raised)) => Err(raised),
            Err(error) => Err(errors::model(py, told(&error, name, sampling.range_rad))),
        }
    }

    /// The law of numbers that `parts` gave.
    #[staticmethod]
    fn of_parts(py: Python<'_>, parts: Parts) -> PyResult<Self> {
        let (breaks, origins, coefficients, kinks) = parts;
        let law = SampledLaw::new(breaks, origins, coefficients, kinks);
        let refused = || errors::model(py, "these numbers are no torque law".to_owned());
        Ok(Self { law: law.ok_or_else(refused)? })
    }

    /// Breaks, origins, coefficients and kinks.
    fn parts(&self) -> Parts {
        let pieces = self.law.pieces();
        let (origins, coefficients) =
            pieces.map(|(origin, powers)| (origin, powers.to_vec())).unzip();
        (self.law.breaks_rad().to_vec(), origins, coefficients, self.law.kinks_rad().to_vec())
    }
}

/// Range and kinks from their texts; tells everything that is wrong with them.
fn sampling(range: Option<&str>, kinks: &[String]) -> Result<Sampling, String> {
    let mut sampling = Sampling::default();
    let mut found = Vec::new();
    match range.map(|text| parse_range(text, QuantityKind::Angle)) {
        None => {}
        Some(Ok(ends)) => sampling.range_rad = ends,
        Some(Err(error)) => found.push(with_hint("range", &error, error.hint())),
    }
    for text in kinks {
        match parse_flag_quantity(text, QuantityKind::Angle) {
            Ok(kink) => sampling.kinks_rad.push(kink),
            Err(error) => found.push(with_hint("kinks", &error, error.hint())),
        }
    }
    if found.is_empty() { Ok(sampling) } else { Err(found.join("\n")) }
}

fn with_hint(name: &str, error: &impl std::fmt::Display, hint: Option<String>) -> String {
    hint.map_or_else(|| format!("{name}: {error}"), |hint| format!("{name}: {error} ({hint})"))
}

/// What is wrong with a function, and what to do.
fn told(error: &SampleError<PyErr>, name: &str, (from, to): (f64, f64)) -> String {
    match error {
        SampleError::NotFinite { at, value } => format!(
            "the torque function {name} gives {value} at a twist of {at:.5} rad: give the range of \
             twists that it holds for, range=(least, greatest)"
        ),
        SampleError::Rough { at } => {
            let places: Vec<String> = at.iter().map(|x| format!("{x:.6}")).collect();
            let places = places.join(", ");
            format!(
                "the torque function {name} bends or jumps near {places} rad: where its slope jumps, \
                 say so with kinks=[{places}]; a jump of the torque itself is not possible"
            )
        }
        SampleError::Range => format!(
            "kinks must lie within the range of the torque function {name}, {from} to {to} rad"
        ),
        SampleError::TooFine => format!(
            "the torque function {name} has too fine a structure over {from} to {to} rad: give the \
             range of twists that matters, range=(..., ...), or measured points as table=..."
        ),
        other => format!("the torque function {name}: {other}"),
    }
}
