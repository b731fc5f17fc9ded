//! Eigenvectors of `L Lᵀ` by twisted factorisation.
//!
//! `L Lᵀ - λ` is factored from the first row down and from the last row up; where the two meet is chosen
//! such that what is left there is smallest. Then the vector follows by multiplication alone, and its
//! smallest entries have as many digits as its largest.

use super::Squares;
use crate::dense::dot;
use crate::pencil::EigenPair;

/// Steps of the Rayleigh quotient, which converges cubically from an eigenvalue with nearly all digits.
const MOST_STEPS: usize = 4;
/// Relative change that ends them.
const SETTLED: f64 = 4.0 * f64::EPSILON;
/// Neighbours nearer than this part of themselves are made orthogonal.
const CLOSE: f64 = 1e-3;
/// Cosine of two vectors from which they are not trusted to span what they should.
const TOO_CLOSE: f64 = 1e-3;

/// Pairs of the given eigenvalues, ascending.
pub(super) fn pairs(
    inertia: &[f64],
    squares: &Squares,
    values: Vec<f64>,
) -> Option<Vec<EigenPair>> {
    let mut twisted = Twisted::new(squares);
    let mut pairs: Vec<EigenPair> = Vec::with_capacity(values.len());
    // First of the vectors that are close to the next one.
    let mut first = 0;
    for value in values {
        let mut pair = if value == 0.0 { rigid(inertia) } else { twisted.pair(value)? };
        if pairs.last().is_none_or(|last| pair.value - last.value > CLOSE * pair.value) {
            first = pairs.len();
        }
        for earlier in &pairs[first..] {
            let cosine = dot(&earlier.vector, &pair.vector);
            if cosine.is_nan() || cosine.abs() > TOO_CLOSE {
                return None;
            }
            pair.vector.iter_mut().zip(&earlier.vector).for_each(|(x, e)| *x -= cosine * e);
        }
        normalise(&mut pair.vector)?;
        pairs.push(pair);
    }
    for pair in &mut pairs {
        pair.vector.iter_mut().zip(inertia).for_each(|(x, m)| *x /= m.sqrt());
    }
    Some(pairs)
}

/// All bodies turning as one.
fn rigid(inertia: &[f64]) -> EigenPair {
    EigenPair { value: 0.0, vector: inertia.iter().map(|m| m.sqrt()).collect() }
}

fn normalise(vector: &mut [f64]) -> Option<()> {
    let length = dot(vector, vector).sqrt();
    if !(length.is_finite() && length > 0.0) {
        return None;
    }
    vector.iter_mut().for_each(|x| *x /= length);
    Some(())
}

/// A pivot; where it is zero by chance, what another rounding of `entry` would have made of it.
fn sum_of(entry: f64, pivot: f64) -> f64 {
    let sum = entry + pivot;
    if sum == 0.0 { f64::EPSILON * entry } else { sum }
}

/// The two factorisations, with their room.
struct Twisted<'s> {
    squares: &'s Squares,
    /// Entries of the unit factor below the diagonal: how much of it a body takes of the motion of the next one. The entries
    /// themselves are negative, as are those of `T`.
    root: Vec<f64>,
    /// Pivots from above less the diagonal, and multipliers.
    from_above: Vec<f64>,
    down: Vec<f64>,
    up: Vec<f64>,
}

impl<'s> Twisted<'s> {
    fn new(squares: &'s Squares) -> Self {
        let Squares { diagonal, below } = squares;
        let (count, links) = (diagonal.len(), below.len());
        Self {
            squares,
            root: below.iter().zip(diagonal).map(|(e, q)| (e / q).sqrt()).collect(),
            from_above: vec![0.0; count],
            down: vec![0.0; links],
            up: vec![0.0; links],
        }
    }

    fn pair(&mut self, mut value: f64) -> Option<EigenPair> {
        let mut vector = vec![0.0; self.from_above.len()];
        for _ in 0..MOST_STEPS {
            let (place, left) = self.factor(value);
            self.fill(place, &mut vector);
            let change = left / dot(&vector, &vector);
            if !change.is_finite() {
                return None;
            }
            value += change;
            if change.abs() <= SETTLED * value {
                return Some(EigenPair { value, vector });
            }
        }
        None
    }

    /// Both factorisations; where they meet best, and what is left there.
    fn factor(&mut self, value: f64) -> (usize, f64) {
        let Squares { diagonal, below } = self.squares;
        let mut pivot = -value;
        for (index, (q, e)) in diagonal.iter().zip(below).enumerate() {
            self.from_above[index] = pivot;
            let inverse = 1.0 / sum_of(*q, pivot);
            self.down[index] = q * self.root[index] * inverse;
            pivot = e * pivot * inverse - value;
        }
        let last = diagonal.len() - 1;
        self.from_above[last] = pivot;
        let mut best = (last, pivot + diagonal[last]);
        let mut pivot = diagonal[last] - value;
        for index in (0..last).rev() {
            let (q, e) = (diagonal[index], below[index]);
            let ratio = q / sum_of(e, pivot);
            self.up[index] = self.root[index] * ratio;
            let left = self.from_above[index] + ratio * pivot;
            pivot = ratio * pivot - value;
            if left.abs() < best.1.abs() {
                best = (index, left);
            }
        }
        best
    }

    /// The vector with 1 at the place where the factorisations meet.
    fn fill(&self, place: usize, vector: &mut [f64]) {
        vector[place] = 1.0;
        for index in (0..place).rev() {
            vector[index] = self.down[index] * vector[index + 1];
        }
        for index in place..self.up.len() {
            vector[index + 1] = self.up[index] * vector[index];
        }
    }
}
