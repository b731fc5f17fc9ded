//! Columns of an answer as arrays of numpy, without a copy where the answer holds them.

use halfshaft::Answer;
use halfshaft::results::Column;
use numpy::ndarray::ArrayView1;
use numpy::{PyArray1, PyArrayMethods};
use pyo3::prelude::*;

use crate::answer::PyAnswer;

/// Name, unit and values of a column.
pub type Named<'py> = (String, String, Bound<'py, PyArray1<f64>>);

/// The columns that hold nearly all numbers of an answer, table by table, in the order of
/// `Answer::bulk_mut`.
pub fn bulk(answer: &Answer) -> Vec<&[Column]> {
    match answer {
        Answer::History(result) => vec![&result.columns],
        Answer::Bifurcation(result) => vec![&result.columns],
        Answer::Resonance(result) => {
            result.branches.iter().map(|branch| branch.columns.as_slice()).collect()
        }
        Answer::Forced(result) => {
            result.gears.iter().map(|gear| gear.table.columns.as_slice()).collect()
        }
        Answer::Folds(result) => {
            result.curves.iter().map(|table| table.columns.as_slice()).collect()
        }
        _ => Vec::new(),
    }
}

/// Views of the columns; each keeps the answer alive and cannot be written to.
pub fn views<'py>(owner: &Bound<'py, PyAnswer>, columns: &[Column]) -> Vec<Named<'py>> {
    let view = |column: &Column| {
        (column.name.clone(), column.unit.clone(), borrowed(owner, &column.values))
    };
    columns.iter().map(view).collect()
}

/// An array over numbers that `owner` holds.
#[expect(unsafe_code, reason = "the one way to lend numbers to numpy without a copy")]
fn borrowed<'py>(owner: &Bound<'py, PyAnswer>, values: &[f64]) -> Bound<'py, PyArray1<f64>> {
    let container = owner.clone().into_any();
    // SAFETY: `values` lie in the answer that `owner` holds (every caller passes `bulk` of it). The array
    // holds a reference to `owner`, whose class is frozen and hands out no mutable access to its answer,
    // so the numbers neither move nor change while the array lives.
    let array = unsafe { PyArray1::borrow_from_array(&ArrayView1::from(values), container) };
    // The numbers are shared with Rust: numpy refuses to make the array writable again, because its base
    // is no writable buffer.
    drop(array.readwrite().make_nonwriteable());
    array
}

/// Arrays that own their numbers, for tables that are made for the occasion.
pub fn owned(py: Python<'_>, columns: Vec<Column>) -> Vec<Named<'_>> {
    let array = |column: Column| {
        let values = PyArray1::from_vec(py, column.values);
        drop(values.readwrite().make_nonwriteable());
        (column.name, column.unit, values)
    };
    columns.into_iter().map(array).collect()
}
