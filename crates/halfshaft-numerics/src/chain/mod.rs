//! Eigenvalues of chains `M x'' + K x = 0`: bodies in a row, springs between neighbours and to ground.
//!
//! With `T = M^(-1/2) K M^(-1/2)`, the factor of `T = L Lᵀ` is bidiagonal and its entries come from
//! masses and stiffnesses by sums, products and quotients of positive numbers alone. They fix every
//! eigenvalue to as many digits as they have themselves, the low ones of a line with stiff parts too,
//! where a matrix `K` has lost them. The eigenvalues are taken by the differential quotient-difference
//! algorithm with shifts of Laguerre (K. V. Fernando and B. N. Parlett, Numer. Math. 67 (1994) 191; U. von
//! Matt, SIAM J. Sci. Comput. 18 (1997) 1163), the vectors by twisted factorisation (I. S. Dhillon and
//! B. N. Parlett, SIAM J. Matrix Anal. Appl. 25 (2004) 858), each in time proportional to the number of
//! bodies.

mod values;
mod vectors;

use crate::pencil::EigenPair;

/// Bodies in a row, each linked to the next.
#[derive(Clone, Debug, PartialEq)]
pub struct Chain {
    inertia: Vec<f64>,
    squares: Squares,
}

/// Squares of the entries of `L`: diagonal and, one fewer, below it.
#[derive(Clone, Debug, PartialEq)]
struct Squares {
    diagonal: Vec<f64>,
    below: Vec<f64>,
}

impl Chain {
    /// The chain of that many inertias as `inertia` has, with one link fewer between them, and a spring
    /// from each to ground (0 for none). `None` unless inertias and links are positive, nothing is
    /// negative, and all quotients stay within the numbers.
    pub fn new(inertia: Vec<f64>, links: &[f64], ground: &[f64]) -> Option<Self> {
        let positive = |values: &[f64]| values.iter().all(|value| *value > 0.0);
        let fits = inertia.len() == links.len() + 1 && inertia.len() == ground.len();
        let grounded = ground.iter().all(|value| *value >= 0.0);
        if !(fits && positive(&inertia) && positive(links) && grounded) {
            return None;
        }
        let squares = Squares::of(&inertia, links, ground);
        let all = || squares.diagonal.iter().chain(&squares.below);
        let inner = &squares.diagonal[..links.len()];
        let sound = all().all(|value| value.is_finite()) && positive(inner);
        (sound && positive(&squares.below)).then_some(Self { inertia, squares })
    }

    /// All eigenvalues, ascending; a chain that is free has one of exactly 0. `None` where the iteration
    /// does not end.
    pub fn eigenvalues(&self) -> Option<Vec<f64>> {
        values::all(&self.squares)
    }

    /// The eigenvalues from number `first` (from 0) on, at most `count`, with vectors of `xᵀ M x = 1`.
    /// `None` where the iteration does not end, or where eigenvalues are so close that vectors made one
    /// by one are not orthogonal.
    pub fn eigenpairs(&self, first: usize, count: usize) -> Option<Vec<EigenPair>> {
        let mut values = self.eigenvalues()?;
        values.drain(..first.min(values.len()));
        values.truncate(count);
        vectors::pairs(&self.inertia, &self.squares, values)
    }
}

impl Squares {
    /// With `s` the stiffness that a body feels on its left, to ground: `q = (s + k) / m`, below it
    /// `k² / (m_next (s + k))`, and `s_next = g_next + k s / (s + k)`.
    fn of(inertia: &[f64], links: &[f64], ground: &[f64]) -> Self {
        let (mut diagonal, mut below) = (Vec::new(), Vec::new());
        let mut felt = ground.first().copied().unwrap_or(0.0);
        for (index, link) in links.iter().enumerate() {
            let sum = felt + link;
            let share = link / sum;
            diagonal.push(sum / inertia[index]);
            below.push(share * link / inertia[index + 1]);
            felt = ground[index + 1] + share * felt;
        }
        diagonal.extend(inertia.last().map(|last| felt / last));
        Self { diagonal, below }
    }
}

#[cfg(test)]
mod tests;
