//! One question of many lines that differ in some numbers, on all cores, in bounded memory.

use std::collections::BTreeMap;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

use halfshaft::model::{ChangeError, Parameter, parse_flag_quantity};
use halfshaft::{AnalysisError, Answer, Driveline, Observer, Question};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::answer::PyAnswer;
use crate::line::Line;
use crate::shared::Watch;
use crate::{errors, options, work};

/// A number of a table: in SI, or a text with its unit.
#[derive(FromPyObject)]
enum Cell {
    Number(f64),
    Text(String),
}

/// Why a row has no answer.
enum Fault {
    Change(ChangeError),
    Analysis(AnalysisError),
    Panic,
}

/// What is to be done; nothing of it changes.
struct Task {
    line: Driveline,
    question: Question,
    parameters: Vec<Parameter>,
    /// Values in SI, row by row.
    rows: Vec<Vec<f64>>,
    /// Rows that may be under way or waiting to be fetched at one time.
    window: usize,
}

/// How far the work is.
#[derive(Default)]
struct State {
    /// The first row that nobody has begun.
    next: usize,
    /// The first row that has not been fetched.
    fetched: usize,
    finished: BTreeMap<usize, Result<Answer, Fault>>,
}

#[derive(Default)]
struct Board {
    state: Mutex<State>,
    bell: Condvar,
    watch: Watch,
}

/// Answers in the order of the rows; an iterator. Where nobody fetches answers, the threads pause.
#[pyclass(frozen, module = "halfshaft._halfshaft")]
pub struct Ensemble {
    task: Arc<Task>,
    board: Arc<Board>,
}

#[pymethods]
impl Ensemble {
    /// Begins to answer `verb` with `options` for the line with each row of `columns`, which give an
    /// address and its values.
    #[new]
    fn new(
        line: &Bound<'_, Line>,
        verb: &str,
        options: &Bound<'_, PyDict>,
        columns: Vec<(String, Vec<Cell>)>,
        threads: usize,
        window: usize,
    ) -> PyResult<Self> {
        let py = line.py();
        let line = line.get().line.clone();
        let question = options::question(verb, options, &line)?;
        let (parameters, rows) = table(py, &line, columns)?;
        let window = window.max(threads);
        let task = Arc::new(Task { line, question, parameters, rows, window });
        let board = Arc::new(Board::default());
        for _ in 0..threads.clamp(1, task.rows.len().max(1)) {
            let (task, board) = (Arc::clone(&task), Arc::clone(&board));
            let named = thread::Builder::new().name("halfshaft".to_owned()).stack_size(work::STACK);
            named
                .spawn(move || labour(&task, &board))
                .map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
        }
        Ok(Self { task, board })
    }

    fn __len__(&self) -> usize {
        self.task.rows.len()
    }

    fn __iter__(slf: PyRef<'_, Self>) -> PyRef<'_, Self> {
        slf
    }

    /// The answer of the next row; raises where that row has none, and goes on behind it when called again.
    fn __next__(&self, py: Python<'_>) -> PyResult<Option<PyAnswer>> {
        loop {
            let fetched = py.detach(|| self.fetch());
            match fetched {
                Fetched::End => return Ok(None),
                Fetched::Row(row) => {
                    let answer = row.map_err(|fault| fault.exception(py))?;
                    return Ok(Some(PyAnswer::new(answer)));
                }
                // Ctrl-C leaves the work as it is: whoever catches it may go on fetching.
                Fetched::Later => py.check_signals()?,
            }
        }
    }

    /// Ends the work that is under way.
    fn close(&self) {
        self.board.watch.stop();
        self.board.bell.notify_all();
    }
}

impl Drop for Ensemble {
    fn drop(&mut self) {
        self.close();
    }
}

enum Fetched {
    Row(Box<Result<Answer, Fault>>),
    Later,
    End,
}

impl Ensemble {
    /// Waits a moment for the next row.
    fn fetch(&self) -> Fetched {
        let mut state = self.board.lock();
        if state.fetched >= self.task.rows.len() || self.board.watch.cancelled() {
            return Fetched::End;
        }
        let wanted = state.fetched;
        if !state.finished.contains_key(&wanted) {
            state = self.board.wait(state, work::LOOK);
        }
        match state.finished.remove(&wanted) {
            Some(answer) => {
                state.fetched += 1;
                drop(state);
                self.board.bell.notify_all();
                Fetched::Row(Box::new(answer))
            }
            None => Fetched::Later,
        }
    }
}

impl Board {
    /// A thread that panicked has left the state whole: it changes in single steps only.
    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn wait<'s>(&self, state: MutexGuard<'s, State>, time: Duration) -> MutexGuard<'s, State> {
        let waited = self.bell.wait_timeout(state, time);
        waited.unwrap_or_else(PoisonError::into_inner).0
    }

    /// The next row to work on; waits while too many wait to be fetched. `None` where all is done.
    fn take(&self, task: &Task) -> Option<usize> {
        let mut state = self.lock();
        loop {
            if state.next >= task.rows.len() || self.watch.cancelled() {
                return None;
            }
            if state.next < state.fetched + task.window {
                state.next += 1;
                return Some(state.next - 1);
            }
            state = self.wait(state, Duration::from_secs(1));
        }
    }
}

/// The work of one thread.
fn labour(task: &Task, board: &Board) {
    while let Some(row) = board.take(task) {
        let one = std::panic::AssertUnwindSafe(|| task.answer(row, board));
        let answer = std::panic::catch_unwind(one).unwrap_or(Err(Fault::Panic));
        board.lock().finished.insert(row, answer);
        board.bell.notify_all();
    }
}

impl Task {
    fn answer(&self, row: usize, board: &Board) -> Result<Answer, Fault> {
        let mut line = self.line.clone();
        for (parameter, value) in self.parameters.iter().zip(&self.rows[row]) {
            line = line.with(parameter, *value).map_err(Fault::Change)?;
        }
        halfshaft::ask(&line, &self.question, &board.watch).map_err(Fault::Analysis)
    }
}

impl Fault {
    fn exception(&self, py: Python<'_>) -> PyErr {
        match self {
            Self::Change(error) => errors::change(py, error),
            Self::Analysis(error) => errors::analysis(py, error),
            Self::Panic => PyRuntimeError::new_err("the computation panicked"),
        }
    }
}

/// Parameters and rows of a table of columns.
fn table(
    py: Python<'_>,
    line: &Driveline,
    columns: Vec<(String, Vec<Cell>)>,
) -> PyResult<(Vec<Parameter>, Vec<Vec<f64>>)> {
    let count = columns.first().map_or(0, |(_, cells)| cells.len());
    let (mut parameters, mut rows) = (Vec::new(), vec![Vec::new(); count]);
    for (address, cells) in columns {
        let parameter = line
            .parameter(&address)
            .map_err(|error| errors::model(py, format!("{error}: {}", error.hint(line))))?;
        if cells.len() != count {
            return Err(errors::model(py, format!("{address} has another number of values")));
        }
        for (row, cell) in rows.iter_mut().zip(cells) {
            row.push(match cell {
                Cell::Number(value) => value,
                Cell::Text(text) => parse_flag_quantity(&text, parameter.kind)
                    .map_err(|error| errors::model(py, format!("{address}: {error}")))?,
            });
        }
        parameters.push(parameter);
    }
    Ok((parameters, rows))
}
