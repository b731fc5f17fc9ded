//! Lines along one of their numbers.

use std::cell::RefCell;
use std::collections::HashMap;
use std::rc::Rc;

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_model::{Driveline, Parameter};

/// The line for each value of the parameter, made once.
pub(super) struct Lines<'q> {
    line: &'q Driveline,
    pub(super) parameter: Parameter,
    made: RefCell<HashMap<u64, Option<Rc<EquationsOfMotion>>>>,
}

/// Lines that are kept.
const MOST_LINES: usize = 512;

impl<'q> Lines<'q> {
    /// The family of a line along one of its numbers.
    pub(super) fn new(line: &'q Driveline, parameter: Parameter) -> Self {
        Self { line, parameter, made: RefCell::default() }
    }

    /// The equations at a value; `None` where the line cannot have it.
    pub(super) fn at(&self, value: f64) -> Option<Rc<EquationsOfMotion>> {
        if let Some(known) = self.made.borrow().get(&value.to_bits()) {
            return known.clone();
        }
        let line = self.line.with(&self.parameter, value).ok();
        let made = line.and_then(|line| EquationsOfMotion::new(&line).ok()).map(Rc::new);
        let mut store = self.made.borrow_mut();
        if store.len() >= MOST_LINES {
            store.clear();
        }
        store.insert(value.to_bits(), made.clone());
        made
    }
}
