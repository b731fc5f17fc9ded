//! Eigenvalues of matrices of middle order against spectra that are known and against the library's.

use super::super::bridge;
use super::eigenvalues;
use crate::complex::Complex;
use crate::dense::Matrix;

/// Numbers in -1..1 by a linear congruence.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

fn random(order: usize, seed: u64) -> Matrix {
    let mut random = Random(seed);
    Matrix::from_fn(order, order, |_, _| random.next())
}

/// Largest distance of each wanted value from the nearest found one that is left.
#[track_caller]
fn mismatch(found: &[Complex], wanted: &[Complex]) -> f64 {
    assert_eq!(found.len(), wanted.len());
    let mut left = found.to_vec();
    let mut worst = 0.0_f64;
    for value in wanted {
        let distance = |at: &usize| (left[*at] - *value).modulus();
        let best = (0..left.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let best = best.expect("as many");
        worst = worst.max(distance(&best));
        left.swap_remove(best);
    }
    worst
}

/// `H A H` with the reflection of a random vector.
fn turned(matrix: &Matrix, seed: u64) -> Matrix {
    let order = matrix.rows();
    let mut random = Random(seed);
    let v: Vec<f64> = (0..order).map(|_| random.next()).collect();
    let square: f64 = v.iter().map(|x| x * x).sum();
    let h = Matrix::from_fn(order, order, |row, column| {
        f64::from(u8::from(row == column)) - 2.0 * v[row] * v[column] / square
    });
    h.mul(matrix).and_then(|half| half.mul(&h)).expect("square")
}

// Source: the library's eigenvalues.
#[test]
fn random_matrices_agree_with_the_library() {
    for order in [9, 10, 16, 17, 33, 64, 100, 150] {
        let matrix = random(order, order as u64);
        let (wanted, _) = bridge::general(&matrix, false).expect("converges");
        let found = eigenvalues(&matrix).expect("converges");
        let away = mismatch(&found, &wanted);
        assert!(away < 1e-12 * (order as f64), "{order}: {away:e}");
    }
}

// Source: blocks of known eigenvalues, turned by reflections.
#[test]
fn known_spectra_are_found() {
    for order in [10, 24, 60] {
        let (mut wanted, mut matrix) = (Vec::new(), Matrix::zeros(order, order));
        for block in 0..order / 2 {
            let (re, im) = (0.9 - 0.03 * block as f64, 0.1 + 0.05 * block as f64);
            wanted.extend([Complex::new(re, im), Complex::new(re, -im)]);
            let at = 2 * block;
            (matrix[(at, at)], matrix[(at + 1, at + 1)]) = (re, re);
            (matrix[(at, at + 1)], matrix[(at + 1, at)]) = (im, -im);
        }
        let turned = turned(&turned(&matrix, 5), 6);
        let found = eigenvalues(&turned).expect("converges");
        assert!(mismatch(&found, &wanted) < 1e-13, "{order}");
        let conjugate = |pair: &[Complex]| pair[0] == pair[1].conjugate();
        assert!(found.chunks_exact(2).all(conjugate), "conjugates are adjacent");
    }
}

// Source: a diagonal similarity changes no eigenvalue, whatever it does to the entries.
#[test]
fn rows_and_columns_of_any_size_are_balanced() {
    let order = 30;
    let plain = random(order, 3);
    let scale = |at: usize| 10.0_f64.powi(at as i32 % 13 - 6);
    let spread = Matrix::from_fn(order, order, |row, column| {
        plain[(row, column)] * scale(row) / scale(column)
    });
    let wanted = eigenvalues(&plain).expect("converges");
    let found = eigenvalues(&spread).expect("converges");
    assert!(mismatch(&found, &wanted) < 1e-11);
    for unit in [1e-160, 1e160] {
        let scaled = Matrix::from_fn(order, order, |row, column| unit * plain[(row, column)]);
        let found: Vec<Complex> =
            eigenvalues(&scaled).expect("converges").iter().map(|z| z.scaled(1.0 / unit)).collect();
        assert!(mismatch(&found, &wanted) < 1e-12);
    }
}

// Source: the roots of one, whose companion matrix turns every plain step in place; matrices that are
// done already.
#[test]
fn steps_that_would_stall_go_on() {
    let order = 40;
    let cycle = Matrix::from_fn(order, order, |row, column| {
        f64::from(u8::from(row == (column + 1) % order))
    });
    let turn = std::f64::consts::TAU / order as f64;
    let wanted: Vec<Complex> =
        (0..order).map(|k| Complex::from_polar(1.0, turn * k as f64)).collect();
    assert!(mismatch(&eigenvalues(&cycle).expect("converges"), &wanted) < 1e-13);
    let upper = Matrix::from_fn(
        order,
        order,
        |row, column| {
            if row <= column { 1.0 + row as f64 } else { 0.0 }
        },
    );
    let wanted: Vec<Complex> = (1..=order).map(|k| Complex::from(k as f64)).collect();
    assert!(mismatch(&eigenvalues(&upper).expect("converges"), &wanted) == 0.0);
    assert!(
        eigenvalues(&Matrix::zeros(order, order))
            .expect("converges")
            .iter()
            .all(|z| z.modulus() == 0.0)
    );
}
