//! The dynamic stiffness of a line and its solution.

use std::sync::Arc;

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_numerics::Complex;
use halfshaft_numerics::blocks::SymmetricSystem;
use halfshaft_numerics::pencil::{Pencil, PencilTerm, add_term};

use super::modal_damping::ModalResponse;
use crate::error::AnalysisError;
use crate::modal::sparse::terms;
use crate::modal::vibration::Vibration;

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
        let damping = damping(equations, twists);
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
    pub(super) fn solve(&mut self, omega: f64, motion: &mut Vec<Complex>) {
        if let Some(modal) = &mut self.modal {
            modal.solve(omega, motion);
            return;
        }
        self.system.clear();
        for DynamicTerm { term, damping, loss_factor } in &self.terms {
            let re = term.stiffness - omega * omega * term.inertia;
            let im = omega * damping + loss_factor * term.stiffness;
            add_term(&mut self.system, term, Complex::new(re, im));
        }
        self.system.factor();
        self.system.solve(motion, &mut self.work);
    }
}

/// Viscous damping and loss factor of each term of [`terms`].
pub(super) fn damping(equations: &EquationsOfMotion, twists: &[f64]) -> Vec<(f64, f64)> {
    let ends = equations.connections.iter().zip(twists);
    let connections = ends
        .filter(|(connection, _)| connection.from.is_some() || connection.to.is_some())
        .map(|(connection, x)| (connection.damping_at(*x), connection.loss_factor));
    connections.chain(equations.ground_damping.iter().map(|damping| (*damping, 0.0))).collect()
}
