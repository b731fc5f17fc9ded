//! Eigenvalues of matrices without symmetry.

use super::bridge;
use super::matrix::Matrix;
use super::middle;
use super::small;
use crate::complex::Complex;
use crate::error::{Error, all_finite};

/// Eigenvalues and eigenvectors of a real matrix.
#[derive(Debug, Clone, PartialEq)]
pub struct Eigen {
    /// The eigenvalues in the order of [`eigenvalues`].
    pub values: Vec<Complex>,
    /// For each eigenvalue its eigenvector of Euclidean length one.
    ///
    /// A defective matrix has fewer directions than eigenvalues; then some vectors coincide.
    pub vectors: Vec<Vec<Complex>>,
}

/// The eigenvalues of a real matrix, largest modulus first.
///
/// Of a conjugate pair the one with positive imaginary part comes first, directly before the other.
///
/// # Errors
///
/// [`Error::NotSquare`], [`Error::NonFinite`], or [`Error::EigenvaluesNotConverged`].
pub fn eigenvalues(matrix: &Matrix) -> Result<Vec<Complex>, Error> {
    check(matrix)?;
    let mut values = match *matrix.as_slice() {
        [] => Vec::new(),
        [a] => vec![Complex::from(a)],
        [a, b, c, d] => two_by_two(a, b, c, d).to_vec(),
        _ => {
            let order = matrix.rows();
            let own = if order <= small::MOST {
                small::eigenvalues(matrix)
            } else if order <= middle::MOST {
                middle::eigenvalues(matrix)
            } else {
                None
            };
            match own {
                Some(values) => values,
                None => bridge::general(matrix, false)?.0,
            }
        }
    };
    values.sort_by(order);
    Ok(values)
}

/// The eigenvalues of a real matrix with their eigenvectors.
///
/// # Errors
///
/// Those of [`eigenvalues`].
pub fn eigen(matrix: &Matrix) -> Result<Eigen, Error> {
    check(matrix)?;
    let mut pairs = match *matrix.as_slice() {
        [] => Vec::new(),
        [a] => vec![(Complex::from(a), vec![Complex::from(1.0)])],
        [a, b, c, d] => two_by_two(a, b, c, d)
            .into_iter()
            .enumerate()
            .map(|(which, value)| (value, vector_of_two(a, b, c, d, value, which)))
            .collect(),
        _ => {
            let (values, columns) = bridge::general(matrix, true)?;
            let columns = columns.unwrap_or_else(|| Matrix::zeros(0, 0));
            with_vectors(&values, &columns)
        }
    };
    pairs.sort_by(|a, b| order(&a.0, &b.0));
    let (values, vectors) = pairs.into_iter().unzip();
    Ok(Eigen { values, vectors })
}

fn check(matrix: &Matrix) -> Result<usize, Error> {
    all_finite("matrix entry", matrix.as_slice())?;
    matrix.order("eigenvalues")
}

/// Descending modulus, then descending real part, then descending imaginary part. Members of a
/// conjugate pair agree in the first two exactly, so nothing can come between them.
fn order(a: &Complex, b: &Complex) -> std::cmp::Ordering {
    b.modulus().total_cmp(&a.modulus()).then(b.re.total_cmp(&a.re)).then(b.im.total_cmp(&a.im))
}

/// Roots of the characteristic equation as corrections of the diagonal: `a + b c / z`, `d - b c /
/// z` with `z² - 2 p z - b c = 0`, `p = (a - d)/2`, which loses nothing when `b c` is small.
pub(super) fn two_by_two(a: f64, b: f64, c: f64, d: f64) -> [Complex; 2] {
    let p = 0.5 * a - 0.5 * d;
    let scale = p.abs().max(b.abs()).max(c.abs());
    if b == 0.0 || c == 0.0 {
        return [Complex::from(a), Complex::from(d)];
    }
    let discriminant = (p / scale) * (p / scale) + (b / scale) * (c / scale);
    if discriminant >= 0.0 {
        let z = p + (scale * discriminant.sqrt()).copysign(p);
        // Only a discriminant that underflowed leaves z at zero.
        let change = if z == 0.0 { 0.0 } else { (b / z) * c };
        [Complex::from(a + change), Complex::from(d - change)]
    } else {
        let (re, im) = (0.5 * a + 0.5 * d, scale * (-discriminant).sqrt());
        [Complex { re, im }, Complex { re, im: -im }]
    }
}

/// A vector orthogonal to the larger row of `A - λ`; any unit vector if both rows vanish.
fn vector_of_two(a: f64, b: f64, c: f64, d: f64, value: Complex, which: usize) -> Vec<Complex> {
    let rows = [
        [Complex::from(a) - value, Complex::from(b)],
        [Complex::from(c), Complex::from(d) - value],
    ];
    let size = |row: &[Complex; 2]| row[0].modulus().max(row[1].modulus());
    let row = if size(&rows[0]) >= size(&rows[1]) { rows[0] } else { rows[1] };
    if size(&row) == 0.0 {
        return (0..2).map(|i| Complex::from(if i == which { 1.0 } else { 0.0 })).collect();
    }
    normalised(vec![-row[1], row[0]])
}

/// Reads the vectors from the columns in which conjugate pairs share real and imaginary part.
fn with_vectors(values: &[Complex], columns: &Matrix) -> Vec<(Complex, Vec<Complex>)> {
    let order = columns.rows();
    let mut pairs = Vec::with_capacity(order);
    let mut k = 0;
    while k < values.len() {
        if values[k].im == 0.0 || k + 1 == values.len() {
            let vector = (0..order).map(|i| Complex::from(columns[(i, k)])).collect();
            pairs.push((values[k], normalised(vector)));
            k += 1;
        } else {
            let vector: Vec<Complex> =
                (0..order).map(|i| Complex::new(columns[(i, k)], columns[(i, k + 1)])).collect();
            let vector = normalised(vector);
            let conjugate = vector.iter().map(|z| z.conjugate()).collect();
            pairs.push((values[k], vector));
            pairs.push((values[k + 1], conjugate));
            k += 2;
        }
    }
    pairs
}

/// The vector divided by its largest entry in size, then by its Euclidean length.
fn normalised(mut vector: Vec<Complex>) -> Vec<Complex> {
    let largest = vector.iter().fold(0.0_f64, |largest, z| largest.max(z.modulus()));
    if largest > 0.0 {
        vector.iter_mut().for_each(|z| *z = z.scaled(1.0 / largest));
        let square: f64 = vector.iter().map(|z| z.re * z.re + z.im * z.im).sum();
        vector.iter_mut().for_each(|z| *z = z.scaled(1.0 / square.sqrt()));
    }
    vector
}
