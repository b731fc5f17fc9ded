//! The dynamic stiffness of a line and its solution.

use std::sync::Arc;

use halfshaft_numerics::Complex;
use halfshaft_numerics::blocks::SymmetricSystem;
use halfshaft_numerics::pencil::{Pencil, PencilTerm, add_term};

use super::modal_damping::ModalResponse;
use crate::error::AnalysisError;
use crate::modal::sparse::{damping_of_terms, terms};
use crate::modal::vibration::Vibration;

/// Steps of iterative refinement at most.
const MOST_REFINEMENTS: usize = 6;
/// Change by a step that ends it.
const SETTLED: f64 = 1e-15;

/// A term of the dynamic stiffness.
struct DynamicTerm {
    term: PencilTerm,
    damping: f64,
    loss_factor: f64,
}

/// A line about its equilibrium, ready to be solved at any frequency.
pub(super) struct LinearLine {
    terms: Vec<DynamicTerm>,
    system: SymmetricSystem<Complex>,
    work: Vec<Complex>,
    /// With damping of the modes, which no sparse matrix has.
    modal: Option<ModalResponse>,
}

impl LinearLine {
    pub(super) fn new(vibration: &Vibration) -> Result<Self, AnalysisError> {
        let equations = &vibration.equations;
        let twists = &vibration.state.twists;
        let terms = terms(equations, twists);
        let pencil = Pencil::new(equations.groups(), terms.clone());
        let modal =
            if equations.modal_damping > 0.0 { Some(ModalResponse::new(vibration)?) } else { None };
        let damping = damping_of_terms(equations, twists);
        let terms = terms.into_iter().zip(damping);
        let terms =
            terms.map(|(term, (damping, loss_factor))| DynamicTerm { term, damping, loss_factor });
        Ok(Self {
            terms: terms.collect(),
            system: SymmetricSystem::new(Arc::clone(pencil.pattern())),
            work: Vec::new(),
            modal,
        })
    }

    /// Motion of the groups at circular frequency `omega` (rad/s), complex amplitudes in rad; the
    /// torques on the groups (N·m) on entry.
    pub(super) fn solve(&mut self, omega: f64, motion: &mut [Complex]) {
        if let Some(modal) = &self.modal {
            modal.solve(omega, motion);
            return;
        }
        self.system.clear();
        for term in &self.terms {
            add_term(&mut self.system, &term.term, term.value(omega));
        }
        let weak = self.system.factor_strengthened();
        let torques = if weak { motion.to_vec() } else { Vec::new() };
        self.system.solve(motion, &mut self.work);
        if weak {
            self.refine(omega, &torques, motion);
        }
    }

    /// Iterative refinement, until a step changes no digit any more.
    fn refine(&mut self, omega: f64, torques: &[Complex], motion: &mut [Complex]) {
        for _ in 0..MOST_REFINEMENTS {
            let mut rest = torques.to_vec();
            for term in &self.terms {
                let torque = term.value(omega) * term.term.along(motion);
                term.term.scatter(-torque, &mut rest);
            }
            self.system.solve(&mut rest, &mut self.work);
            let largest = |values: &[Complex]| {
                values.iter().map(|value| value.re.abs().max(value.im.abs())).fold(0.0, f64::max)
            };
            motion.iter_mut().zip(&rest).for_each(|(q, step)| *q = *q + *step);
            let (step, size) = (largest(&rest), largest(motion));
            if step <= SETTLED * size || !size.is_finite() {
                return;
            }
        }
    }
}

impl DynamicTerm {
    /// `k (1 + i η) + i ω c - ω² m`.
    fn value(&self, omega: f64) -> Complex {
        let Self { term, damping, loss_factor } = self;
        Complex::new(
            term.stiffness - omega * omega * term.inertia,
            omega * damping + loss_factor * term.stiffness,
        )
    }
}
