//! Computations beside the interpreter: its lock is free meanwhile, and its signals are heeded.

use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{self, Thread};
use std::time::Duration;

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

use crate::shared::Watch;

/// Time between two looks at Python's signals: short for whoever presses Ctrl-C.
pub const LOOK: Duration = Duration::from_millis(40);
/// Stack of a computation: what the main thread of a program has.
pub const STACK: usize = 8 << 20;

/// What a computation gave, with the exception that a signal or the progress raised meanwhile.
pub struct Done<T> {
    /// The result.
    pub value: T,
    /// What was raised; the computation was then asked to end.
    pub raised: Option<PyErr>,
}

/// Runs `work` on a thread of its own. The calling thread looks at signals, which only Python's main
/// thread sees, and tells `progress` the finished share; where one of them raises, the work is asked to
/// end.
///
/// # Errors
/// `RuntimeError` where the work panics or no thread can be had.
pub fn run<T: Send>(
    py: Python<'_>,
    progress: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&Watch) -> T + Send,
) -> PyResult<Done<T>> {
    let (watch, done) = (Watch::default(), AtomicBool::new(false));
    let caller = thread::current();
    thread::scope(|scope| {
        let (inner, done) = (&watch, &done);
        let job = move || {
            let _bell = Bell { done, caller };
            work(inner)
        };
        let handle = thread::Builder::new()
            .stack_size(STACK)
            .spawn_scoped(scope, job)
            .map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
        let raised = attend(py, progress, &watch, done);
        let joined = py.detach(|| handle.join());
        let value = joined.map_err(|_| PyRuntimeError::new_err("the computation panicked"))?;
        Ok(Done { value, raised })
    })
}

/// Waits for the end of the work; returns what was raised first meanwhile.
fn attend(
    py: Python<'_>,
    progress: Option<&Bound<'_, PyAny>>,
    watch: &Watch,
    done: &AtomicBool,
) -> Option<PyErr> {
    let (mut raised, mut told) = (None, -1.0);
    while !done.load(Ordering::Acquire) {
        py.detach(|| thread::park_timeout(LOOK));
        let mut look = py.check_signals();
        let share = watch.share();
        if let Some(progress) = progress.filter(|_| look.is_ok() && share > told) {
            told = share;
            look = progress.call1((share,)).map(drop);
        }
        if let Err(error) = look {
            watch.stop();
            raised.get_or_insert(error);
        }
    }
    raised
}

/// Wakes the caller when the work ends, also by a panic.
struct Bell<'d> {
    done: &'d AtomicBool,
    caller: Thread,
}

impl Drop for Bell<'_> {
    fn drop(&mut self) {
        self.done.store(true, Ordering::Release);
        self.caller.unpark();
    }
}
