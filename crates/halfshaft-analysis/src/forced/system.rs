//! The dynamic stiffness of a line and its solution.

use std::sync::Arc;

use halfshaft_numerics::Complex;
use halfshaft_numerics::blocks::{Pattern, SymmetricSystem};
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

/// The sums of the terms.
struct Matrices {
    stiffness: SymmetricSystem<f64>,
    /// Loss factors times stiffnesses.
    lost: SymmetricSystem<f64>,
    damping: SymmetricSystem<f64>,
    inertia: SymmetricSystem<f64>,
}

/// A line about its equilibrium, ready to be solved at any frequency.
pub(super) struct LinearLine {
    terms: Vec<DynamicTerm>,
    matrices: Matrices,
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
        let terms: Vec<DynamicTerm> = terms.collect();
        Ok(Self {
            matrices: Matrices::of(&terms, pencil.pattern()),
            terms,
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
        self.system.set_sum(&self.matrices.parts(omega));
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

impl Matrices {
    fn of(terms: &[DynamicTerm], pattern: &Arc<Pattern>) -> Self {
        let sum = |value: fn(&DynamicTerm) -> f64| {
            let mut system = SymmetricSystem::new(Arc::clone(pattern));
            terms.iter().for_each(|term| add_term(&mut system, &term.term, value(term)));
            system
        };
        Self {
            stiffness: sum(|term| term.term.stiffness),
            lost: sum(|term| term.loss_factor * term.term.stiffness),
            damping: sum(|term| term.damping),
            inertia: sum(|term| term.term.inertia),
        }
    }

    /// `K + i H + i ω C - ω² M`.
    fn parts(&self, omega: f64) -> [(&SymmetricSystem<f64>, Complex); 4] {
        [
            (&self.stiffness, Complex::from(1.0)),
            (&self.lost, Complex::new(0.0, 1.0)),
            (&self.damping, Complex::new(0.0, omega)),
            (&self.inertia, Complex::from(-omega * omega)),
        ]
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
