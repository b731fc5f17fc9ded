//! Lanczos' iteration with the shifted inverse.

use super::{EigenPair, Pencil};
use crate::blocks::SymmetricSystem;
use crate::dense::{Matrix, dot, symmetric_eigen};
use crate::error::Error;

/// Residual of a pair in the shifted inverse that ends the iteration, relative to the largest.
const CONVERGED: f64 = 1e-13;
/// Iterations for one more round of vectors, at most, beyond those asked for twice.
const SPARE: usize = 60;
/// Rounds with new beginnings for eigenvalues that one beginning does not reach: multiple ones.
const MOST_ROUNDS: usize = 40;
/// Part by which a value is raised to count up to it: more than rounding, less than any distance that
/// would be told apart.
const JUST_ABOVE: f64 = 1e-9;

impl Pencil {
    /// The lowest `count` eigenvalues, ascending, besides those of `known` vectors (each with
    /// `xᵀ M x = 1`, of eigenvalue zero, exactly). Fewer where there are no more finite ones.
    ///
    /// # Errors
    /// [`Error::EigenvaluesNotConverged`] where some that must be there are not reached.
    pub fn lowest(&self, count: usize, known: &[Vec<f64>]) -> Result<Vec<EigenPair>, Error> {
        let near = self.floor_of(known.len() + 1).unwrap_or_else(|| self.scale() * 1e-12);
        let shift = self.under_all(near);
        let search = Search { pencil: self, factors: self.shifted(shift), shift };
        let mut basis = Basis::default();
        known.iter().for_each(|vector| basis.push(vector.clone(), self.times_inertia(vector)));
        let mut found: Vec<EigenPair> = Vec::new();
        for round in 0..MOST_ROUNDS {
            let wanted = count.saturating_sub(found.len()).max(1);
            let pairs = search.round(wanted, &mut basis, round)?;
            let ended = pairs.is_empty();
            found.extend(pairs);
            found.sort_by(|a, b| a.value.total_cmp(&b.value));
            let last = found.get(count.min(found.len()).wrapping_sub(1));
            let Some(last) = last else { return Ok(found) };
            // Clusters at the border are told whole or cut; those below must all be there.
            let below = self.below(last.value - JUST_ABOVE * last.value.abs().max(near));
            let reached = found.iter().take_while(|pair| !std::ptr::eq(*pair, last)).count();
            if (found.len() >= count && reached + known.len() >= below) || ended {
                found.truncate(count);
                return Ok(found);
            }
        }
        Err(Error::EigenvaluesNotConverged { dimension: self.pattern.nodes() })
    }
}

/// Vectors orthonormal in `M`, with their products.
#[derive(Default)]
struct Basis {
    vectors: Vec<Vec<f64>>,
    products: Vec<Vec<f64>>,
}

impl Basis {
    fn push(&mut self, vector: Vec<f64>, product: Vec<f64>) {
        self.vectors.push(vector);
        self.products.push(product);
    }

    /// Takes the parts along the basis out of `x`, twice: once leaves what rounding made of large parts.
    fn clear(&self, x: &mut [f64]) {
        for _ in 0..2 {
            for (vector, product) in self.vectors.iter().zip(&self.products) {
                let part = dot(product, x);
                x.iter_mut().zip(vector).for_each(|(x, v)| *x -= part * v);
            }
        }
    }
}

struct Search<'p> {
    pencil: &'p Pencil,
    factors: SymmetricSystem<f64>,
    shift: f64,
}

impl Search<'_> {
    /// Up to `wanted` pairs orthogonal to the basis, which takes them up; none where nothing is left.
    fn round(
        &self,
        wanted: usize,
        basis: &mut Basis,
        round: usize,
    ) -> Result<Vec<EigenPair>, Error> {
        let nodes = self.pencil.pattern.nodes();
        let fixed = basis.vectors.len();
        let mut work = Vec::new();
        let Some(mut x) = self.beginning(nodes, round, basis) else { return Ok(Vec::new()) };
        let (mut diagonal, mut beside): (Vec<f64>, Vec<f64>) = (Vec::new(), Vec::new());
        let most = (2 * wanted + SPARE).min(nodes.saturating_sub(fixed) + 1);
        let mut ritz = Ritz::default();
        for step in 0..=most {
            basis.clear(&mut x);
            let product = self.pencil.times_inertia(&x);
            let length = dot(&x, &product).max(0.0).sqrt();
            let scale = diagonal.first().copied().unwrap_or(0.0).abs();
            let ended = length <= 1e-14 * scale || length == 0.0 || step == most;
            if step > 0 {
                beside.push(length);
                if ended || (step >= wanted && step % 5 == 0) {
                    ritz = Ritz::of(&diagonal, &beside)?;
                    if ended || ritz.converged(wanted) {
                        break;
                    }
                }
            }
            x.iter_mut().for_each(|x| *x /= length);
            let product: Vec<f64> = product.iter().map(|p| p / length).collect();
            let next = self.inverse(&product, &mut work);
            diagonal.push(dot(&product, &next));
            basis.push(std::mem::replace(&mut x, next), product);
        }
        let pairs = self.pairs(&ritz, wanted, &basis.vectors[fixed..]);
        basis.vectors.truncate(fixed);
        basis.products.truncate(fixed);
        for pair in &pairs {
            basis.push(pair.vector.clone(), self.pencil.times_inertia(&pair.vector));
        }
        Ok(pairs)
    }

    /// A vector with something of every pair that the basis does not have; `None` where there is none.
    fn beginning(&self, nodes: usize, round: usize, basis: &Basis) -> Option<Vec<f64>> {
        let mut x = beginning(nodes, round);
        let before = dot(&x, &self.pencil.times_inertia(&x));
        basis.clear(&mut x);
        let product = self.pencil.times_inertia(&x);
        // What rounding leaves of a vector of which nothing is left.
        let left = dot(&x, &product) > 1e-20 * before;
        // The inverse takes what has no inertia out of the vector.
        left.then(|| self.inverse(&product, &mut Vec::new()))
    }

    fn inverse(&self, right: &[f64], work: &mut Vec<f64>) -> Vec<f64> {
        let mut x = right.to_vec();
        self.factors.solve(&mut x, work);
        x
    }

    /// Pairs of the pencil from those of the small matrix, as far as they are good.
    fn pairs(&self, ritz: &Ritz, wanted: usize, vectors: &[Vec<f64>]) -> Vec<EigenPair> {
        let good = (0..ritz.values.len().min(wanted)).filter(|index| ritz.is_good(*index));
        good.map(|index| {
            let mut vector = vec![0.0; self.pencil.pattern.nodes()];
            for (part, basis) in ritz.parts[index].iter().zip(vectors) {
                vector.iter_mut().zip(basis).for_each(|(x, v)| *x += part * v);
            }
            let value = self.shift + 1.0 / ritz.values[index];
            let length = dot(&vector, &self.pencil.times_inertia(&vector)).sqrt();
            vector.iter_mut().for_each(|x| *x /= length);
            let quotient = self.pencil.quotient(&vector);
            // Where the two differ by more than rounding the shift's is the safer.
            let close = (quotient - value).abs() <= 1e-8 * value.abs().max(self.shift.abs());
            EigenPair { value: if close { quotient } else { value }, vector }
        })
        .collect()
    }
}

/// Eigenvalues of the small matrix, largest first, with the residuals of their pairs.
#[derive(Default)]
struct Ritz {
    values: Vec<f64>,
    parts: Vec<Vec<f64>>,
    residuals: Vec<f64>,
}

impl Ritz {
    fn of(diagonal: &[f64], beside: &[f64]) -> Result<Self, Error> {
        let n = diagonal.len();
        let matrix = Matrix::from_fn(n, n, |i, j| match i.abs_diff(j) {
            0 => diagonal[i],
            1 => beside[i.min(j)],
            _ => 0.0,
        });
        let eigen = symmetric_eigen(&matrix)?;
        let last = beside.last().copied().unwrap_or(0.0);
        let mut ritz = Self::default();
        for index in (0..n).rev() {
            let parts = eigen.vectors.column(index);
            ritz.values.push(eigen.values[index]);
            ritz.residuals.push(last * parts.last().copied().unwrap_or(0.0).abs());
            ritz.parts.push(parts);
        }
        Ok(ritz)
    }

    fn is_good(&self, index: usize) -> bool {
        let largest = self.values.first().copied().unwrap_or(0.0);
        // The residual of a vector grows with its eigenvalue in the pencil.
        self.values[index] > 1e-13 * largest
            && self.residuals[index] <= (1e-9 * self.values[index]).max(CONVERGED * largest)
    }

    fn converged(&self, wanted: usize) -> bool {
        self.values.len() >= wanted && (0..wanted).all(|index| self.is_good(index))
    }
}

/// Numbers without any pattern in [-1, 1), the same each time (Steele, Lea, Flood: SplitMix64).
fn beginning(nodes: usize, round: usize) -> Vec<f64> {
    let mut state = 0x5851_f42d_4c95_7f2d_u64.wrapping_mul(round as u64 + 1);
    let mut next = || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        #[expect(clippy::cast_precision_loss, reason = "53 bits fit")]
        let unit = ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64;
        2.0 * unit - 1.0
    };
    (0..nodes).map(|_| next()).collect()
}

#[cfg(test)]
mod tests {
    use super::super::{Pencil, PencilTerm};

    fn spring(a: usize, b: usize, stiffness: f64) -> PencilTerm {
        PencilTerm { first: (a, 1.0), second: Some((b, -1.0)), stiffness, inertia: 0.0 }
    }

    fn mass(node: usize, inertia: f64) -> PencilTerm {
        PencilTerm { first: (node, 1.0), second: None, stiffness: 0.0, inertia }
    }

    fn chain(nodes: usize) -> Pencil {
        let mut terms: Vec<_> = (0..nodes).map(|node| mass(node, 1.0)).collect();
        terms.extend((1..nodes).map(|node| spring(node - 1, node, 1.0)));
        Pencil::new(nodes, terms)
    }

    // Source: a free chain of equal masses has the eigenvalues (2 sin(j π / 2 n))².
    #[test]
    fn lowest_of_a_free_chain_are_those_of_the_formula() {
        for (nodes, count) in [(5, 4), (60, 20), (3000, 20)] {
            #[expect(clippy::cast_precision_loss, reason = "small")]
            let n = nodes as f64;
            let rigid = vec![1.0 / n.sqrt(); nodes];
            let pairs = chain(nodes).lowest(count, &[rigid]).expect("converges");
            assert_eq!(pairs.len(), count);
            for (index, pair) in pairs.iter().enumerate() {
                #[expect(clippy::cast_precision_loss, reason = "small")]
                let j = (index + 1) as f64;
                let exact = (2.0 * (j * std::f64::consts::PI / 2.0 / n).sin()).powi(2);
                let error = (pair.value / exact - 1.0).abs();
                assert!(error < 1e-10, "{nodes}: {j}: {error:e}");
            }
        }
    }

    // Source: a star of equal arms has each eigenvalue of an arm clamped at the hub once less than
    // there are arms; two masses m on springs k, (3 ± sqrt 5)/2 · k/m.
    #[test]
    fn multiple_eigenvalues_are_told_as_often_as_they_are() {
        let arms = 6;
        let mut terms = vec![mass(0, 1.0)];
        for arm in 0..arms {
            let (inner, outer) = (1 + 2 * arm, 2 + 2 * arm);
            terms.extend([mass(inner, 1.0), mass(outer, 1.0)]);
            terms.extend([spring(0, inner, 1.0), spring(inner, outer, 1.0)]);
        }
        let nodes = 1 + 2 * arms;
        #[expect(clippy::cast_precision_loss, reason = "small")]
        let rigid = vec![1.0 / (nodes as f64).sqrt(); nodes];
        let pairs = Pencil::new(nodes, terms).lowest(nodes - 1, &[rigid]).expect("converges");
        assert_eq!(pairs.len(), nodes - 1);
        for exact in [(3.0 - 5.0_f64.sqrt()) / 2.0, (3.0 + 5.0_f64.sqrt()) / 2.0] {
            let times = pairs.iter().filter(|pair| (pair.value - exact).abs() < 1e-11).count();
            assert_eq!(times, arms - 1);
        }
    }

    // Source: springs in series without mass between them are one spring.
    #[test]
    fn nodes_without_mass_have_no_eigenvalue() {
        let terms = vec![mass(0, 2.0), mass(2, 3.0), spring(0, 1, 10.0), spring(1, 2, 15.0)];
        let rigid = vec![1.0 / 5.0_f64.sqrt(); 3];
        let pairs = Pencil::new(3, terms).lowest(3, &[rigid]).expect("converges");
        assert_eq!(pairs.len(), 1);
        let exact = 6.0 * (1.0 / 2.0 + 1.0 / 3.0);
        assert!((pairs[0].value - exact).abs() < 1e-12 * exact);
        // The mass in between hangs on both springs.
        let middle = (10.0 * pairs[0].vector[0] + 15.0 * pairs[0].vector[2]) / 25.0;
        assert!((pairs[0].vector[1] - middle).abs() < 1e-13);
    }
}
