//! Dense linear algebra.

mod reference;

use std::f64::consts::{PI, TAU};

use halfshaft_numerics::Error;
use halfshaft_numerics::dense::{Complex, Lu, Matrix, eigen, eigenvalues, solve, symmetric_eigen};
use reference::Random;

fn random(rows: usize, columns: usize, seed: u64) -> Matrix {
    let mut random = Random(seed);
    Matrix::from_fn(rows, columns, |_, _| random.next())
}

fn largest(matrix: &Matrix) -> f64 {
    matrix.as_slice().iter().fold(0.0, |largest, entry| entry.abs().max(largest))
}

fn difference(a: &Matrix, b: &Matrix) -> f64 {
    let entry = |i, j| a[(i, j)] - b[(i, j)];
    largest(&Matrix::from_fn(a.rows(), a.columns(), entry))
}

/// Source of truth: the definition of products and transposes on a hand-made example.
#[test]
fn products_and_transposes() {
    let a = Matrix::from_rows([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]);
    let b = Matrix::from_rows([[1.0, 0.0], [-1.0, 2.0], [0.5, 1.0]]);
    let product = Matrix::from_rows([[0.5, 7.0], [2.0, 16.0]]);
    assert_eq!(a.mul(&b), Ok(product.clone()));
    assert_eq!(b.transpose().mul(&a.transpose()), Ok(product.transpose()));
    assert_eq!(a.mul_vector(&[1.0, -1.0, 2.0]), Ok(vec![5.0, 11.0]));
    assert_eq!(Matrix::identity(2).mul(&a), Ok(a.clone()));
    assert_eq!(a.column(1), [2.0, 5.0]);
    let mut c = Matrix::from_row_major(1, 2, vec![1.0, 2.0]).expect("two entries");
    c[(0, 1)] = 7.0;
    c.row_mut(0)[0] = 5.0;
    assert_eq!(c, Matrix::from_rows([[5.0, 7.0]]));
}

/// Source of truth: the residual of the equations, in units of rounding.
#[test]
fn linear_systems_of_every_size_are_solved() {
    for order in (1..12).chain([20, 31, 32, 33, 34, 60, 150]) {
        let matrix = random(order, order, order as u64);
        let mut numbers = Random(99);
        let known: Vec<f64> = (0..order).map(|_| numbers.next()).collect();
        let right = matrix.mul_vector(&known).expect("fits");
        let solution = solve(&matrix, &right).expect("regular");
        let back = matrix.mul_vector(&solution).expect("fits");
        for (a, b) in back.iter().zip(&right) {
            assert!((a - b).abs() < 1e-14 * (order * order) as f64, "order {order}");
        }
        let mut again = right.clone();
        Lu::new(&matrix).and_then(|lu| lu.solve_in_place(&mut again)).expect("regular");
        for (a, b) in again.iter().zip(&solution) {
            assert!((a - b).abs() < 1e-8, "order {order}: {a} against {b}");
        }
    }
}

/// Source of truth: exact solutions; a zero on the diagonal asks for an exchange of rows.
#[test]
fn small_systems_pivot() {
    let swap = Matrix::from_rows([[0.0, 2.0], [3.0, 1.0]]);
    assert_eq!(solve(&swap, &[4.0, 5.0]), Ok(vec![1.0, 2.0]));
    let tiny = Matrix::from_rows([[1e-20, 1.0], [1.0, 1.0]]);
    assert_eq!(solve(&tiny, &[1.0, 2.0]), Ok(vec![1.0, 1.0]));
    let cycle = Matrix::from_rows([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]]);
    assert_eq!(solve(&cycle, &[1.0, 2.0, 3.0]), Ok(vec![3.0, 1.0, 2.0]));
}

/// Source of truth: the documented errors.
#[test]
fn misuse_is_told() {
    let wide = Matrix::zeros(2, 3);
    assert!(matches!(eigenvalues(&wide), Err(Error::NotSquare { rows: 2, columns: 3, .. })));
    assert!(matches!(solve(&wide, &[0.0; 2]), Err(Error::NotSquare { .. })));
    let long = solve(&Matrix::identity(2), &[1.0]);
    assert!(matches!(long, Err(Error::Length { expected: 2, found: 1, .. })));
    assert!(wide.mul(&wide).is_err() && wide.mul_vector(&[1.0]).is_err());
    assert!(Matrix::from_row_major(2, 2, vec![1.0]).is_err());
    for order in [1, 2, 5, 40] {
        let singular = solve(&Matrix::zeros(order, order), &vec![1.0; order]);
        assert_eq!(singular, Err(Error::Singular { dimension: order, column: 0 }));
        let mut poisoned = Matrix::identity(order);
        poisoned[(0, 0)] = f64::NAN;
        assert!(matches!(eigenvalues(&poisoned), Err(Error::NonFinite { .. })));
        assert!(matches!(symmetric_eigen(&poisoned), Err(Error::NonFinite { .. })));
        assert!(eigen(&poisoned).is_err() && solve(&poisoned, &vec![1.0; order]).is_err());
    }
    let dependent = Matrix::from_rows([[1.0, 2.0, 3.0], [2.0, 4.0, 6.0], [0.0, 1.0, 1.0]]);
    let column = solve(&dependent, &[1.0; 3]);
    assert_eq!(column, Err(Error::Singular { dimension: 3, column: 2 }));
    assert_eq!(eigenvalues(&Matrix::zeros(0, 0)), Ok(Vec::new()));
}

/// Source of truth: the eigenvalues `4 sin²(π k / (2 (n + 1)))` of a chain, orthonormality of the
/// vectors, and `A V = V Λ`.
#[test]
fn symmetric_eigenvalues_of_a_chain() {
    for order in [1, 2, 3, 5, 10, 20, 60] {
        let matrix = Matrix::from_fn(order, order, |i, j| match i.abs_diff(j) {
            0 => 2.0,
            1 => -1.0,
            _ => 0.0,
        });
        let found = symmetric_eigen(&matrix).expect("converges");
        for (k, value) in found.values.iter().enumerate() {
            let angle = PI * (k + 1) as f64 / (2 * (order + 1)) as f64;
            assert!((value - 4.0 * angle.sin().powi(2)).abs() < 1e-14 * order as f64);
        }
        check_decomposition(&matrix, &found.values, &found.vectors);
    }
}

fn check_decomposition(matrix: &Matrix, values: &[f64], vectors: &Matrix) {
    let order = matrix.rows();
    let tolerance = 1e-14 * order as f64;
    let gram = vectors.transpose().mul(vectors).expect("fits");
    assert!(difference(&gram, &Matrix::identity(order)) < tolerance);
    let left = matrix.mul(vectors).expect("fits");
    let right = Matrix::from_fn(order, order, |i, j| vectors[(i, j)] * values[j]);
    assert!(difference(&left, &right) < tolerance * largest(matrix).max(1.0));
    assert!(values.windows(2).all(|pair| pair[0] <= pair[1]));
}

/// Source of truth: orthonormality and `A V = V Λ` over all ratios of the entries.
#[test]
fn symmetric_matrices_of_order_two_over_all_scales() {
    let mut random = Random(5);
    for _ in 0..2000 {
        let mut entry = || random.next() * 10.0_f64.powi((random.next() * 9.0) as i32);
        let (a, b, d) = (entry(), entry(), entry());
        let matrix = Matrix::from_rows([[a, b], [b, d]]);
        let found = symmetric_eigen(&matrix).expect("finite");
        let scaled = Matrix::from_fn(2, 2, |i, j| matrix[(i, j)] / largest(&matrix));
        let values: Vec<f64> = found.values.iter().map(|v| v / largest(&matrix)).collect();
        check_decomposition(&scaled, &values, &found.vectors);
    }
    let diagonal = symmetric_eigen(&Matrix::from_rows([[3.0, 0.0], [0.0, -1.0]])).expect("finite");
    assert_eq!(diagonal.values, [-1.0, 3.0]);
    let huge = symmetric_eigen(&Matrix::from_rows([[0.0, 1e300], [1e300, 0.0]])).expect("finite");
    assert_eq!(huge.values, [-1e300, 1e300]);
}

/// Source of truth: `A v = λ v`, and the trace as the sum of the eigenvalues.
#[test]
fn general_eigenvectors_satisfy_their_equation() {
    for order in [1, 2, 3, 4, 6, 12, 13, 20, 40] {
        for seed in 0..20 {
            let matrix = random(order, order, 100 * seed + order as u64);
            let found = eigen(&matrix).expect("converges");
            let trace: f64 = (0..order).map(|k| matrix[(k, k)]).sum();
            let sum = found.values.iter().fold(Complex::default(), |sum, z| sum + *z);
            assert!((sum - Complex::from(trace)).modulus() < 1e-12 * order as f64);
            for (value, vector) in found.values.iter().zip(&found.vectors) {
                let length: f64 = vector.iter().map(|z| z.modulus().powi(2)).sum();
                assert!((length - 1.0).abs() < 1e-13);
                for i in 0..order {
                    let image = (0..order)
                        .fold(Complex::default(), |sum, j| sum + vector[j].scaled(matrix[(i, j)]));
                    let error = (image - *value * vector[i]).modulus();
                    assert!(error < 1e-13 * order as f64, "order {order}: error {error}");
                }
            }
            assert!(found.values.windows(2).all(|w| w[0].modulus() >= w[1].modulus()));
            let alone = eigenvalues(&matrix).expect("converges");
            for (a, b) in alone.iter().zip(&found.values) {
                assert!((*a - *b).modulus() < 1e-11, "order {order}: {a:?} against {b:?}");
            }
        }
    }
}

/// Source of truth: the eigenvalues of a cyclic permutation are the roots of unity. All have
/// modulus one, which lets iterations without exceptional shifts run for ever.
#[test]
fn eigenvalues_on_the_unit_circle() {
    for order in [2, 3, 4, 8, 16, 30] {
        let cycle = Matrix::from_fn(order, order, |i, j| f64::from((i + 1) % order == j));
        let found = eigenvalues(&cycle).expect("converges");
        for k in 0..order {
            let root = Complex::from_polar(1.0, TAU * k as f64 / order as f64);
            let nearest = found.iter().fold(1.0_f64, |d, z| d.min((*z - root).modulus()));
            assert!(nearest < 1e-13, "order {order}, root {k}: {nearest}");
        }
    }
}

/// Source of truth: rotation by φ with damping ρ has the multipliers `ρ exp(±i φ)`; triangular
/// matrices show their eigenvalues; conjugates stand together, positive imaginary part first.
#[test]
fn eigenvalues_of_order_two() {
    let (rho, phi) = (0.9, 1.1_f64);
    let rotation = Matrix::from_rows([
        [rho * phi.cos(), -rho * phi.sin()],
        [rho * phi.sin(), rho * phi.cos()],
    ]);
    let found = eigenvalues(&rotation).expect("finite");
    assert!((found[0] - Complex::from_polar(rho, phi)).modulus() < 1e-15);
    assert_eq!(found[1], found[0].conjugate());
    let triangular = eigenvalues(&Matrix::from_rows([[1e-8, 5e9], [0.0, -3.0]])).expect("finite");
    assert_eq!(triangular, [Complex::from(-3.0), Complex::from(1e-8)]);
    // λ² = 1e300 exactly, without overflow on the way.
    let large = eigenvalues(&Matrix::from_rows([[0.0, 1e200], [1e100, 0.0]])).expect("finite");
    assert!((large[0].re / 1e150 - 1.0).abs() < 1e-15);
    // Defective: one direction only.
    let jordan = eigen(&Matrix::from_rows([[1.0, 1.0], [0.0, 1.0]])).expect("finite");
    assert_eq!(jordan.values, [Complex::from(1.0); 2]);
    assert!(jordan.vectors.iter().all(|v| v[1].modulus() == 0.0));
}
