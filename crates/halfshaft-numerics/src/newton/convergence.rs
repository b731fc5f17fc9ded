//! When a Newton iteration is done, kept apart from the iteration itself.

use super::{Settings, Trial};

/// Why a Newton iteration ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Convergence {
    /// The correction that remains is below the step tolerance.
    Step,
    /// Every residual is below the residual tolerance.
    Residual,
    /// As many Jacobians as allowed were factorised.
    IterationLimit,
    /// No part of a step, down to the smallest damping, brought the solution nearer.
    Stalled,
    /// The Jacobian has no inverse, or one that is not finite.
    SingularJacobian,
}

impl Convergence {
    /// Whether the unknowns are a solution to the tolerance.
    pub fn is_converged(self) -> bool {
        matches!(self, Self::Step | Self::Residual)
    }
}

/// One accepted step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Iteration {
    /// Share of the correction that was taken, 1 for a full step.
    pub damping: f64,
    /// Weighted length of the full correction.
    pub step_norm: f64,
    /// Weighted length of the simplified correction that remains after the step.
    pub remaining_norm: f64,
    /// Largest residual after the step.
    pub residual_norm: f64,
}

/// The account of a Newton iteration.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// Accepted steps.
    pub iterations: usize,
    /// Largest residual at the returned point.
    pub residual_norm: f64,
    /// Why the iteration ended.
    pub converged: Convergence,
    /// The accepted steps one by one.
    pub history: Vec<Iteration>,
}

/// Watches an iteration and decides when it is over.
pub(super) struct ConvergenceTest<'a> {
    settings: &'a Settings,
    residual_norm: f64,
    history: Vec<Iteration>,
    ended: Option<Convergence>,
}

impl<'a> ConvergenceTest<'a> {
    pub(super) fn new(settings: &'a Settings, residual: &[f64]) -> Self {
        let residual_norm = largest(residual);
        let done = residual_norm <= settings.residual_tolerance;
        let ended = done.then_some(Convergence::Residual);
        Self { settings, residual_norm, history: Vec::new(), ended }
    }

    /// Whether another step is due; otherwise the end is settled.
    pub(super) fn goes_on(&mut self) -> bool {
        if self.ended.is_none() && self.history.len() >= self.settings.iteration_limit {
            self.ended = Some(Convergence::IterationLimit);
        }
        self.ended.is_none()
    }

    pub(super) fn accept(&mut self, trial: &Trial) {
        self.residual_norm = largest(&trial.point.residual);
        self.history.push(Iteration {
            damping: trial.damping,
            step_norm: trial.step,
            remaining_norm: trial.remaining,
            residual_norm: self.residual_norm,
        });
        if self.residual_norm <= self.settings.residual_tolerance {
            self.end(Convergence::Residual);
        } else if trial.damping == 1.0 && trial.remaining <= self.settings.step_tolerance {
            self.end(Convergence::Step);
        }
    }

    pub(super) fn end(&mut self, reason: Convergence) {
        self.ended = Some(reason);
    }

    pub(super) fn report(self) -> Report {
        Report {
            iterations: self.history.len(),
            residual_norm: self.residual_norm,
            converged: self.ended.unwrap_or(Convergence::IterationLimit),
            history: self.history,
        }
    }
}

fn largest(residual: &[f64]) -> f64 {
    residual.iter().fold(0.0, |largest, r| r.abs().max(largest))
}
