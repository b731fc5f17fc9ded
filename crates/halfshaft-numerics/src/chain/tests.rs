//! Chains against formulas and against dense matrices.

use std::f64::consts::PI;

use proptest::prelude::*;

use super::Chain;
use crate::dense::{Matrix, dot, symmetric_eigen};
use crate::pencil::EigenPair;

fn uniform(count: usize, left: f64, right: f64) -> Chain {
    let mut ground = vec![0.0; count];
    ground[0] = left;
    ground[count - 1] += right;
    Chain::new(vec![0.5; count], &vec![2e5; count - 1], &ground).unwrap()
}

fn assert_near(found: &[f64], wanted: impl Fn(usize) -> f64, tolerance: f64) {
    for (index, value) in found.iter().enumerate() {
        let wanted = wanted(index);
        assert!((value - wanted).abs() <= tolerance * wanted, "{index}: {value:e}, {wanted:e}");
    }
}

// Source: the eigenvalues of a uniform chain, 4 k/m sin²(θ/2), with θ = j π / n free, (2j - 1) π / (2n + 1)
// held at one end, j π / (n + 1) held at both.
#[test]
fn uniform_chains_have_their_sines() {
    for count in [1, 2, 3, 7, 50, 200, 400] {
        let sine = |theta: f64| 1.6e6 * (theta / 2.0).sin().powi(2);
        #[expect(clippy::cast_precision_loss, reason = "small")]
        let (j, n) = (|index: usize| index as f64, count as f64);
        let free = uniform(count, 0.0, 0.0).eigenvalues().unwrap();
        assert_eq!((free.len(), free[0]), (count, 0.0));
        let pairs = uniform(count, 0.0, 0.0).eigenpairs(0, count).unwrap();
        assert_orthonormal(&pairs, &vec![0.5; count]);
        assert_near(&free, |index| sine(j(index) * PI / n), 1e-14);
        for (left, right) in [(2e5, 0.0), (0.0, 2e5)] {
            let held = uniform(count, left, right).eigenvalues().unwrap();
            assert_near(&held, |i| sine((2.0 * j(i) + 1.0) * PI / (2.0 * n + 1.0)), 1e-14);
        }
        let held = uniform(count, 2e5, 2e5).eigenvalues().unwrap();
        assert_near(&held, |index| sine((j(index) + 1.0) * PI / (n + 1.0)), 1e-14);
    }
}

// Source: the antisymmetric motions (a, b, -b, -a) of four equal bodies, roots of a quadratic by Vieta. In a
// matrix of stiffnesses the soft link would have one digit left.
#[test]
fn a_soft_link_between_stiff_ones_keeps_its_digits() {
    let (stiff, soft) = (1e15_f64, 1.0_f64);
    let chain = Chain::new(vec![1.0; 4], &[stiff, soft, stiff], &[0.0; 4]).unwrap();
    let pairs = chain.eigenpairs(1, 1).unwrap();
    let half = stiff + soft;
    let high = half + (half * half - 2.0 * stiff * soft).sqrt();
    let low = 2.0 * stiff * soft / high;
    assert!((pairs[0].value - low).abs() <= 4e-16 * low, "{:e} {low:e}", pairs[0].value);
}

// Source: the two nearly equal halves of a line move as one against the other and with each other: two
// eigenvalues that agree to nine digits.
#[test]
fn eigenvalues_of_two_equal_halves_are_both_found() {
    let mut links = vec![1.0; 39];
    links[19] = 1e-9;
    let chain = Chain::new(vec![1.0; 40], &links, &[0.0; 40]).unwrap();
    let values = chain.eigenvalues().unwrap();
    assert_near(&values[2..4], |_| 4.0 * (PI / 40.0).sin().powi(2), 1e-8);
    if let Some(pairs) = chain.eigenpairs(0, 40) {
        assert_orthonormal(&pairs, &[1.0; 40]);
    }
}

#[test]
fn chains_that_are_none_are_refused() {
    assert_eq!(Chain::new(vec![1.0, 0.0], &[1.0], &[0.0; 2]), None);
    assert_eq!(Chain::new(vec![1.0, 1.0], &[-1.0], &[0.0; 2]), None);
    assert_eq!(Chain::new(vec![1.0, 1.0], &[1.0], &[0.0, -1.0]), None);
    assert_eq!(Chain::new(vec![1.0, 1.0], &[f64::NAN], &[0.0; 2]), None);
    assert_eq!(Chain::new(vec![1e-300, 1.0], &[1e300], &[0.0; 2]), None);
    assert_eq!(Chain::new(vec![1.0], &[1.0], &[0.0]), None);
    assert_eq!(Chain::new(Vec::new(), &[], &[]), None);
}

fn assert_orthonormal(pairs: &[EigenPair], inertia: &[f64]) {
    let scaled: Vec<Vec<f64>> = pairs
        .iter()
        .map(|pair| pair.vector.iter().zip(inertia).map(|(x, m)| x * m.sqrt()).collect())
        .collect();
    for (row, first) in scaled.iter().enumerate() {
        for (column, second) in scaled.iter().enumerate() {
            let wanted = f64::from(u8::from(row == column));
            let product = dot(first, second);
            assert!((product - wanted).abs() < 1e-10, "{row} {column}: {product:e}");
        }
    }
}

fn stiffness(links: &[f64], ground: &[f64]) -> Matrix {
    let count = ground.len();
    let mut matrix = Matrix::zeros(count, count);
    for (index, ground) in ground.iter().enumerate() {
        matrix[(index, index)] += ground;
    }
    for (index, link) in links.iter().enumerate() {
        matrix[(index, index)] += link;
        matrix[(index + 1, index + 1)] += link;
        matrix[(index, index + 1)] -= link;
        matrix[(index + 1, index)] -= link;
    }
    matrix
}

fn decade() -> impl Strategy<Value = f64> {
    (-3.0..3.0_f64).prop_map(|power| 10.0_f64.powf(power))
}

proptest! {
    // Source: the dense solver, whose error is absolute, and the equation `K x = λ M x` itself.
    #[test]
    fn any_chain_has_the_eigenvalues_of_its_matrix(
        bodies in prop::collection::vec((decade(), decade(), prop::option::of(decade())), 1..60)
    ) {
        let inertia: Vec<f64> = bodies.iter().map(|body| body.0).collect();
        let links: Vec<f64> = bodies.iter().skip(1).map(|body| body.1).collect();
        let ground: Vec<f64> =
            bodies.iter().map(|body| body.2.filter(|g| *g < 1.0).unwrap_or(0.0)).collect();
        let chain = Chain::new(inertia.clone(), &links, &ground).unwrap();
        let values = chain.eigenvalues().unwrap();
        let matrix = stiffness(&links, &ground);
        let root: Vec<f64> = inertia.iter().map(|m| m.sqrt()).collect();
        let scaled = Matrix::from_fn(root.len(), root.len(), |row, column| {
            matrix[(row, column)] / (root[row] * root[column])
        });
        let dense = symmetric_eigen(&scaled).unwrap();
        let largest = dense.values.last().copied().unwrap();
        for (found, wanted) in values.iter().zip(&dense.values) {
            prop_assert!((found - wanted).abs() <= 1e-13 * largest, "{found:e} {wanted:e}");
        }
        let apart = values.windows(2).all(|pair| pair[1] - pair[0] > 1e-9 * pair[1]);
        let pairs = chain.eigenpairs(0, values.len());
        prop_assert!(pairs.is_some() || !apart, "{values:?}");
        if let Some(pairs) = pairs {
            assert_orthonormal(&pairs, &inertia);
            for (pair, value) in pairs.iter().zip(&values) {
                prop_assert!((pair.value - value).abs() <= 1e-14 * value);
                for (row, (root, x)) in root.iter().zip(&pair.vector).enumerate() {
                    let force = dot(matrix.row(row), &pair.vector) / root;
                    let wanted = pair.value * root * x;
                    prop_assert!((force - wanted).abs() <= 1e-11 * largest);
                }
            }
        }
    }
}
