//! Forced vibration of a line whose modes are damped.
//!
//! Modal damping is a full matrix, `C = Σ M φ (2 ζ ω) φᵀ M`, so the motion is a sum over all modes:
//! `q = Φ y`, `(ω_r² - ω² + 2 i ζ ω_r ω) y_r + Σ_s Γ_rs y_s = φ_rᵀ T`, with `Γ` what dampers and loss
//! factors add. What a torque does to a node without inertia beside the modes is statics.

use std::sync::Arc;

use halfshaft_numerics::Complex;
use halfshaft_numerics::blocks::SymmetricSystem;
use halfshaft_numerics::dense::{Matrix, solve};
use halfshaft_numerics::pencil::{Pencil, PencilTerm, add_term};

use crate::error::AnalysisError;
use crate::modal::ElasticMode;
use crate::modal::sparse::{damping_of_terms, elastic_count, rigid_shape, terms};
use crate::modal::vibration::Vibration;

/// A line in its modes.
pub(super) struct ModalResponse {
    /// Undamped circular frequency of each mode, rad/s; the rigid-body motion has 0.
    frequencies: Vec<f64>,
    shapes: Vec<Vec<f64>>,
    modal_damping: f64,
    /// Viscous damping and hysteretic stiffness in the modes; `None` where there is neither.
    coupling: Option<(Matrix, Matrix)>,
    /// Compliance of the massless nodes with all others held.
    massless: Option<(SymmetricSystem<f64>, Vec<usize>)>,
}

/// Stiffness that holds the heavy nodes, over the largest of the line.
const HELD: f64 = 1e100;

impl ModalResponse {
    pub(super) fn new(vibration: &Vibration) -> Result<Self, AnalysisError> {
        let equations = &vibration.equations;
        let modes = vibration.modes(elastic_count(equations))?;
        let mut frequencies: Vec<f64> = modes.iter().map(ElasticMode::frequency).collect();
        let mut shapes: Vec<Vec<f64>> = modes.into_iter().map(|mode| mode.shape).collect();
        if let Some(rigid) = rigid_shape(equations) {
            frequencies.push(0.0);
            shapes.push(rigid);
        }
        let terms = terms(equations, &vibration.state.twists);
        let damping = damping_of_terms(equations, &vibration.state.twists);
        let viscous = |index: usize, _: &PencilTerm| damping[index].0;
        let hysteretic = |index: usize, term: &PencilTerm| damping[index].1 * term.stiffness;
        let coupled = damping.iter().any(|(viscous, loss)| *viscous != 0.0 || *loss != 0.0);
        let coupling = coupled
            .then(|| (projected(&terms, &shapes, viscous), projected(&terms, &shapes, hysteretic)));
        let massless: Vec<usize> =
            (0..equations.groups()).filter(|group| equations.inertia[*group] <= 0.0).collect();
        Ok(Self {
            massless: (!massless.is_empty())
                .then(|| (held(equations.groups(), &terms, &massless), massless)),
            frequencies,
            shapes,
            modal_damping: equations.modal_damping,
            coupling,
        })
    }

    pub(super) fn solve(&self, omega: f64, motion: &mut [Complex]) {
        let loaded: Vec<(usize, Complex)> =
            motion.iter().copied().enumerate().filter(|(_, t)| *t != Complex::default()).collect();
        let force = |shape: &Vec<f64>| {
            let terms = loaded.iter().map(|(group, torque)| torque.scaled(shape[*group]));
            terms.fold(Complex::default(), |sum, term| sum + term)
        };
        let forces: Vec<Complex> = self.shapes.iter().map(force).collect();
        let impedance = |natural: &f64| {
            let damping = 2.0 * self.modal_damping * natural * omega;
            Complex::new(natural * natural - omega * omega, damping)
        };
        let own: Vec<Complex> = self.frequencies.iter().map(impedance).collect();
        let parts = match &self.coupling {
            Some(coupling) => coupled(&own, coupling, omega, &forces),
            None => forces.iter().zip(&own).map(|(force, own)| *force / *own).collect(),
        };
        let extra = self.massless.as_ref().map(|(system, nodes)| statics(system, nodes, motion));
        // Real and imaginary parts apart, so that both sums run in vector registers.
        let (mut re, mut im) = (vec![0.0; motion.len()], vec![0.0; motion.len()]);
        for (shape, part) in self.shapes.iter().zip(&parts) {
            for ((re, im), shape) in re.iter_mut().zip(&mut im).zip(shape) {
                *re += part.re * shape;
                *im += part.im * shape;
            }
        }
        for ((q, re), im) in motion.iter_mut().zip(re).zip(im) {
            *q = Complex::new(re, im);
        }
        for (node, value) in extra.into_iter().flatten() {
            motion[node] = motion[node] + value;
        }
    }
}

/// `Φᵀ (Σ value w wᵀ) Φ`.
fn projected(
    terms: &[PencilTerm],
    shapes: &[Vec<f64>],
    value: impl Fn(usize, &PencilTerm) -> f64,
) -> Matrix {
    let mut matrix = Matrix::zeros(shapes.len(), shapes.len());
    for (index, term) in terms.iter().enumerate() {
        let factor = value(index, term);
        if factor == 0.0 {
            continue;
        }
        let parts: Vec<f64> = shapes.iter().map(|shape| term.along(shape)).collect();
        matrix.add_square(factor, &parts);
    }
    matrix
}

/// Solves the modes together, as twice as many real equations; NaN where they have no solution.
fn coupled(
    own: &[Complex],
    (viscous, hysteretic): &(Matrix, Matrix),
    omega: f64,
    forces: &[Complex],
) -> Vec<Complex> {
    let n = own.len();
    let imaginary = |i: usize, j: usize| {
        let own = if i == j { own[i].im } else { 0.0 };
        own + omega * viscous[(i, j)] + hysteretic[(i, j)]
    };
    let matrix = Matrix::from_fn(2 * n, 2 * n, |row, column| {
        let (i, j) = (row % n, column % n);
        match (row < n, column < n) {
            (true, true) | (false, false) => {
                if i == j {
                    own[i].re
                } else {
                    0.0
                }
            }
            (true, false) => -imaginary(i, j),
            (false, true) => imaginary(i, j),
        }
    });
    let mut right: Vec<f64> = forces.iter().map(|force| force.re).collect();
    right.extend(forces.iter().map(|force| force.im));
    let solution = solve(&matrix, &right).unwrap_or_else(|_| vec![f64::NAN; 2 * n]);
    (0..n).map(|i| Complex::new(solution[i], solution[n + i])).collect()
}

/// The stiffness of the massless nodes, all others held.
fn held(groups: usize, terms: &[PencilTerm], massless: &[usize]) -> SymmetricSystem<f64> {
    let pencil = Pencil::new(groups, terms.to_vec());
    let mut system = SymmetricSystem::new(Arc::clone(pencil.pattern()));
    terms.iter().for_each(|term| add_term(&mut system, term, term.stiffness));
    let largest = terms.iter().map(|term| term.stiffness.abs()).fold(0.0, f64::max);
    for group in (0..groups).filter(|group| !massless.contains(group)) {
        system.add(group, HELD * largest);
    }
    system.factor();
    system
}

/// Motion of the massless nodes under the torques on them.
fn statics(
    system: &SymmetricSystem<f64>,
    nodes: &[usize],
    torques: &[Complex],
) -> Vec<(usize, Complex)> {
    let mut work = Vec::new();
    let mut part = |of: fn(&Complex) -> f64| {
        let mut x = vec![0.0; torques.len()];
        nodes.iter().for_each(|node| x[*node] = of(&torques[*node]));
        system.solve(&mut x, &mut work);
        x
    };
    let (re, im) = (part(|torque| torque.re), part(|torque| torque.im));
    nodes.iter().map(|node| (*node, Complex::new(re[*node], im[*node]))).collect()
}
