//! Integration to an end, through break times, under the eyes of an observer.

use std::ops::ControlFlow;

use super::{DenseStep, OneStep};
use crate::error::{Error, all_finite};

/// How an integration came to its end.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Finish {
    /// At the end time.
    Reached,
    /// Where the observer asked to stop.
    Interrupted,
}

/// A step that has just been accepted, as shown to an observer.
#[derive(Debug)]
pub struct AcceptedStep<'a, I: ?Sized> {
    integrator: &'a mut I,
}

impl<I: OneStep + ?Sized> AcceptedStep<'_, I> {
    /// The time at the start of the step.
    pub fn previous_time(&self) -> f64 {
        self.integrator.previous_time()
    }

    /// The time at the end of the step.
    pub fn time(&self) -> f64 {
        self.integrator.time()
    }

    /// The state at the start of the step.
    pub fn previous_state(&self) -> &[f64] {
        self.integrator.previous_state()
    }

    /// The state at the end of the step.
    pub fn state(&self) -> &[f64] {
        self.integrator.state()
    }

    /// The derivative of the state at the end of the step.
    pub fn rate(&self) -> &[f64] {
        self.integrator.rate()
    }

    /// The system.
    pub fn system(&self) -> &I::System {
        self.integrator.system()
    }

    /// The solution inside the step, prepared when first asked for.
    pub fn dense(&mut self) -> DenseStep<'_> {
        self.integrator.dense()
    }
}

/// Integrates to `t_end`, restarting exactly at every break time on the way.
///
/// `breaks` are times in the order of integration; those from the present time on, up to but not
/// including `t_end`, are honoured, so that two consecutive calls handle each break once. At a
/// break `at_break(time, system, state)` may change the system and the state. A system whose
/// right-hand side jumps at a known time should be switched there rather than look at `t` itself,
/// since both the step before and the step after evaluate it at exactly that time.
///
/// `observe` sees every accepted step and ends the integration by returning
/// [`ControlFlow::Break`].
///
/// # Errors
///
/// [`Error::BreaksNotOrdered`], [`Error::NonFinite`] if a break leaves such a state, and
/// [`Error::Stopped`] if a step could not be taken; the integrator then still holds what was
/// reached.
pub fn integrate<I: OneStep + ?Sized>(
    integrator: &mut I,
    t_end: f64,
    breaks: &[f64],
    mut at_break: impl FnMut(f64, &mut I::System, &mut [f64]),
    mut observe: impl FnMut(AcceptedStep<'_, I>) -> ControlFlow<()>,
) -> Result<Finish, Error> {
    let direction = if t_end < integrator.time() { -1.0 } else { 1.0 };
    check_order(breaks, direction)?;
    for &time in breaks {
        if direction * time < direction * integrator.time() {
            continue;
        }
        if direction * time >= direction * t_end {
            break;
        }
        if run_to(integrator, time, &mut observe)? == Finish::Interrupted {
            return Ok(Finish::Interrupted);
        }
        integrator.restart_with(&mut |system, state| at_break(time, system, state))?;
    }
    run_to(integrator, t_end, &mut observe)
}

fn run_to<I: OneStep + ?Sized>(
    integrator: &mut I,
    goal: f64,
    observe: &mut impl FnMut(AcceptedStep<'_, I>) -> ControlFlow<()>,
) -> Result<Finish, Error> {
    while integrator.time() != goal {
        integrator.step(goal)?;
        if observe(AcceptedStep { integrator }).is_break() {
            return Ok(Finish::Interrupted);
        }
    }
    Ok(Finish::Reached)
}

fn check_order(breaks: &[f64], direction: f64) -> Result<(), Error> {
    all_finite("break time", breaks)?;
    let misplaced = |pair: &[f64]| direction * pair[0] > direction * pair[1];
    match breaks.windows(2).position(misplaced) {
        Some(before) => {
            Err(Error::BreaksNotOrdered { index: before + 1, time: breaks[before + 1] })
        }
        None => Ok(()),
    }
}
