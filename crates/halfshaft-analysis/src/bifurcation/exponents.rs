//! Lyapunov exponents: how fast neighbouring motions part.
//!
//! G. Benettin, L. Galgani, A. Giorgilli, J.-M. Strelcyn, *Meccanica* 15 (1980) 9 and 21: a basis of
//! variations is carried along and made orthonormal again after each period; the logarithms of the lengths
//! add up. The time, whose exponent is zero, is no part of the state of a forced line.

use halfshaft_numerics::dense::Matrix;

/// Variations carried along.
#[derive(Clone, Debug)]
pub(super) struct Exponents {
    /// Orthonormal.
    basis: Vec<Vec<f64>>,
    /// Sums of logarithms.
    sums: Vec<f64>,
    periods: usize,
}

impl Exponents {
    pub(super) fn new(dimension: usize) -> Self {
        // Nothing is special about these directions; a unit vector might be.
        let entry = |i: usize, j: usize| (1.3 + 0.7 * i as f64 + 1.9 * (i * j + j) as f64).sin();
        let basis = (0..dimension).map(|j| (0..dimension).map(|i| entry(i, j)).collect()).collect();
        let mut exponents = Self { basis, sums: vec![0.0; dimension], periods: 0 };
        exponents.orthonormalise();
        exponents.restart();
        exponents
    }

    /// Counts from here on, with the directions found so far.
    pub(super) fn restart(&mut self) {
        self.sums.fill(0.0);
        self.periods = 0;
    }

    /// Takes in the derivatives of a state by that a period before.
    pub(super) fn push(&mut self, matrix: &Matrix) {
        for vector in &mut self.basis {
            if let Ok(moved) = matrix.mul_vector(vector) {
                *vector = moved;
            }
        }
        self.orthonormalise();
        self.periods += 1;
    }

    /// By Gram and Schmidt, each projection twice where much cancels.
    fn orthonormalise(&mut self) {
        for index in 0..self.basis.len() {
            let (before, behind) = self.basis.split_at_mut(index);
            let Some(vector) = behind.first_mut() else { continue };
            for _ in 0..2 {
                for other in before.iter() {
                    let along: f64 = vector.iter().zip(other).map(|(x, o)| x * o).sum();
                    vector.iter_mut().zip(other).for_each(|(x, o)| *x -= along * o);
                }
            }
            let size = crate::shooting::length(vector);
            self.sums[index] += size.ln();
            if size > 0.0 {
                vector.iter_mut().for_each(|x| *x /= size);
            }
        }
    }

    /// The largest exponent and the sum of all, 1/s, for a period in s.
    pub(super) fn rates(&self, period: f64) -> (f64, f64) {
        let time = self.periods as f64 * period;
        let largest = self.sums.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        (largest / time, self.sums.iter().sum::<f64>() / time)
    }

    /// The direction that grows most.
    pub(super) fn direction(&self) -> &[f64] {
        self.basis.first().map_or(&[], Vec::as_slice)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    // Source: a linear map, whose exponents are the logarithms of its eigenvalues' moduli.
    #[test]
    fn exponents_of_a_linear_map_are_its_eigenvalues() {
        let matrix = Matrix::from_rows([[1.5, 1.0], [0.0, 0.25]]);
        let mut exponents = Exponents::new(2);
        (0..60).for_each(|_| exponents.push(&matrix));
        exponents.restart();
        (0..10).for_each(|_| exponents.push(&matrix));
        let (largest, sum) = exponents.rates(2.0);
        assert!((largest - 0.5 * 1.5_f64.ln()).abs() < 1e-13, "{largest}");
        assert!((sum - 0.5 * 0.375_f64.ln()).abs() < 1e-13, "{sum}");
        assert!((exponents.direction()[0].abs() - 1.0).abs() < 1e-13);
    }
}
