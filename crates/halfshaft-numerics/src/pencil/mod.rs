//! Lowest eigenvalues of large symmetric pencils `K x = λ M x` on a graph.
//!
//! `K` and `M` are sums over the edges and nodes of a graph, `M` not negative; nodes without any `M` are
//! allowed and have no eigenvalue of their own. [`Pencil::lowest`] takes Lanczos' iteration with the
//! shifted inverse `(K - σ M)⁻¹ M`, orthogonal in `M`, below the spectrum, and counts eigenvalues by
//! signs of pivots (Sylvester), so that none is missed and none is told twice, multiple ones included.
//! Compare Z. Bai and others (eds.), *Templates for the Solution of Algebraic Eigenvalue Problems*
//! (2000), section 5.5.

mod count;
mod lanczos;

use std::sync::Arc;

use crate::blocks::{Pattern, Scalar, SymmetricSystem};
use crate::dense::dot;

/// One term `value · w wᵀ` of `K` and of `M`, with `w` of one or two entries.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PencilTerm {
    /// Node and entry of `w`.
    pub first: (usize, f64),
    /// The other, if there is one.
    pub second: Option<(usize, f64)>,
    /// Factor in `K`.
    pub stiffness: f64,
    /// Factor in `M`.
    pub inertia: f64,
}

/// `K` and `M` as sums of terms.
#[derive(Clone, Debug)]
pub struct Pencil {
    pattern: Arc<Pattern>,
    terms: Vec<PencilTerm>,
}

/// An eigenvalue with its vector, `xᵀ M x = 1`.
#[derive(Clone, Debug, PartialEq)]
pub struct EigenPair {
    /// The eigenvalue.
    pub value: f64,
    /// The vector, by node.
    pub vector: Vec<f64>,
}

impl Pencil {
    /// The pencil of `nodes` nodes.
    pub fn new(nodes: usize, terms: Vec<PencilTerm>) -> Self {
        let edges = terms.iter().filter_map(|term| Some((term.first.0, term.second?.0)));
        let pattern = Arc::new(Pattern::new(nodes, edges));
        Self { pattern, terms }
    }

    /// Order of elimination of the graph.
    pub fn pattern(&self) -> &Arc<Pattern> {
        &self.pattern
    }

    /// `K - shift M`, factored.
    fn shifted(&self, shift: f64) -> SymmetricSystem<f64> {
        let mut system = SymmetricSystem::new(Arc::clone(&self.pattern));
        for term in &self.terms {
            add_term(&mut system, term, term.stiffness - shift * term.inertia);
        }
        system.factor();
        system
    }

    /// `M x`.
    fn times_inertia(&self, x: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; x.len()];
        for term in self.terms.iter().filter(|term| term.inertia != 0.0) {
            term.scatter(term.inertia * term.along(x), &mut product);
        }
        product
    }

    /// `xᵀ K x / xᵀ M x`, from the twists of the edges, which keeps the digits of small ones.
    fn quotient(&self, x: &[f64]) -> f64 {
        let energy: f64 =
            self.terms.iter().map(|term| term.stiffness * term.along(x).powi(2)).sum();
        energy / dot(x, &self.times_inertia(x))
    }
}

impl PencilTerm {
    /// `wᵀ x`.
    #[inline]
    pub fn along<T: Scalar>(&self, x: &[T]) -> T {
        let (node, entry) = self.first;
        let second = self.second.map_or(T::default(), |(node, entry)| x[node].scaled(entry));
        x[node].scaled(entry) + second
    }

    /// Adds `w value` to `out`.
    #[inline]
    pub fn scatter<T: Scalar>(&self, value: T, out: &mut [T]) {
        for (node, entry) in [Some(self.first), self.second].into_iter().flatten() {
            out[node] = out[node] + value.scaled(entry);
        }
    }
}

/// Adds `value · w wᵀ` to a system on the graph of the term.
pub fn add_term<T: Scalar>(system: &mut SymmetricSystem<T>, term: &PencilTerm, value: T) {
    let (node, entry) = term.first;
    system.add(node, value * T::from(entry * entry));
    let Some((other, second)) = term.second else { return };
    if other == node {
        system.add(node, value * T::from(second * second + 2.0 * entry * second));
        return;
    }
    system.add(other, value * T::from(second * second));
    system.add_pair(node, other, value * T::from(entry * second));
}
