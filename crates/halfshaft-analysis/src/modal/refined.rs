//! Damped eigenvalues of a long line from those of its lowest modes alone.

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_numerics::Complex;
use halfshaft_numerics::blocks::SymmetricSystem;
use halfshaft_numerics::pencil::{Pencil, PencilTerm, add_term};

use super::elastic::ElasticMode;
use super::sparse::{damping_of_terms, terms};

/// Steps of inverse iteration: it converges cubically.
const MOST_STEPS: usize = 12;
/// Relative change of the eigenvalue that ends it.
const SETTLED: f64 = 1e-13;

/// Terms of stiffness and inertia with the damping of each.
struct Damped {
    pencil: Pencil,
    terms: Vec<(PencilTerm, f64)>,
}

/// Iterates on each oscillating pair of `λ² M + λ C + K` from its estimate and the undamped shape; what
/// does not settle near by stays as it is.
pub(super) fn refined(
    equations: &EquationsOfMotion,
    twists: &[f64],
    modes: &[ElasticMode],
    pairs: &mut [[Complex; 2]],
) {
    let terms = terms(equations, twists);
    let damping = damping_of_terms(equations, twists).into_iter().map(|(viscous, _)| viscous);
    let terms: Vec<(PencilTerm, f64)> = terms.into_iter().zip(damping).collect();
    if terms.iter().all(|(_, damping)| *damping == 0.0) {
        return;
    }
    let pencil = Pencil::new(equations.groups(), terms.iter().map(|(term, _)| *term).collect());
    let line = Damped { pencil, terms };
    for (mode, pair) in modes.iter().zip(pairs).filter(|(_, pair)| pair[0].im != 0.0) {
        if let Some(value) = line.iterate(&mode.shape, pair[0]) {
            *pair = [value, value.conjugate()];
        }
    }
}

impl Damped {
    fn iterate(&self, shape: &[f64], start: Complex) -> Option<Complex> {
        let mut vector: Vec<Complex> = shape.iter().copied().map(Complex::from).collect();
        let (mut value, mut work) = (start, Vec::new());
        for _ in 0..MOST_STEPS {
            let mut system = SymmetricSystem::new(std::sync::Arc::clone(self.pencil.pattern()));
            for (term, damping) in &self.terms {
                let inertia = (value * value).scaled(term.inertia);
                let entry = Complex::from(term.stiffness) + value.scaled(*damping) + inertia;
                add_term(&mut system, term, entry);
            }
            system.factor();
            vector = self.slope_times(value, &vector);
            system.solve(&mut vector, &mut work);
            let largest = vector.iter().map(|x| x.modulus()).fold(0.0, f64::max);
            vector.iter_mut().for_each(|x| *x = x.scaled(1.0 / largest));
            let next = self.nearest_root(&vector, value)?;
            let change = (next - value).modulus();
            value = next;
            if change <= SETTLED * value.modulus() {
                let near = (value - start).modulus() <= 0.5 * start.modulus();
                return Some(value).filter(|value| near && value.im > 0.0);
            }
        }
        None
    }

    /// `(2 λ M + C) x`.
    fn slope_times(&self, value: Complex, x: &[Complex]) -> Vec<Complex> {
        let mut product = vec![Complex::default(); x.len()];
        for (term, damping) in &self.terms {
            let factor = value.scaled(2.0 * term.inertia) + Complex::from(*damping);
            term.scatter(factor * term.along(x), &mut product);
        }
        product
    }

    /// The root next to `value` of `λ² xᵀ M x + λ xᵀ C x + xᵀ K x`.
    fn nearest_root(&self, x: &[Complex], value: Complex) -> Option<Complex> {
        let mut sums = [Complex::default(); 3];
        for (term, damping) in &self.terms {
            let part = term.along(x);
            let square = part * part;
            for (sum, factor) in sums.iter_mut().zip([term.stiffness, *damping, term.inertia]) {
                *sum = *sum + square.scaled(factor);
            }
        }
        let [c, b, a] = sums;
        if a == Complex::default() {
            return None;
        }
        let root = square_root(b * b - (a * c).scaled(4.0));
        let roots = [root, -root].map(|root| (root - b) / a.scaled(2.0));
        roots.into_iter().min_by(|p, q| (*p - value).modulus().total_cmp(&(*q - value).modulus()))
    }
}

fn square_root(z: Complex) -> Complex {
    Complex::from_polar(z.modulus().sqrt(), z.argument() / 2.0)
}
