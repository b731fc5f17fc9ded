//! Where dense problems meet `faer`: its matrices go no further. (Large blocks of
//! [`BlockSystem`](crate::blocks::BlockSystem)s are the other place.)
//!
//! Every call passes `Par::Seq` itself. The library's global setting would follow whichever crate
//! of a program turns its threads on, and threads only slow these sizes down.

use faer::diag::Diag;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::evd::{
    ComputeEigenvectors, EvdError, evd_real, evd_scratch, self_adjoint_evd,
    self_adjoint_evd_scratch,
};
use faer::linalg::lu::partial_pivoting::{factor, solve};
use faer::{Mat, MatMut, MatRef, Par, Spec};

use super::matrix::Matrix;
use crate::complex::Complex;
use crate::error::Error;

fn view(matrix: &Matrix) -> MatRef<'_, f64> {
    MatRef::from_row_major_slice(matrix.as_slice(), matrix.rows(), matrix.columns())
}

fn not_converged(dimension: usize) -> impl Fn(EvdError) -> Error {
    move |EvdError::NoConvergence| Error::EigenvaluesNotConverged { dimension }
}

/// Ascending eigenvalues and, in the columns, orthonormal vectors of a symmetric matrix, of which
/// the lower triangle is read.
pub(super) fn symmetric(matrix: &Matrix) -> Result<(Vec<f64>, Matrix), Error> {
    let order = matrix.rows();
    let mut values = Diag::<f64>::zeros(order);
    let mut vectors = Mat::<f64>::zeros(order, order);
    let scratch =
        self_adjoint_evd_scratch::<f64>(order, ComputeEigenvectors::Yes, Par::Seq, Spec::default());
    self_adjoint_evd(
        view(matrix),
        values.as_mut(),
        Some(vectors.as_mut()),
        Par::Seq,
        MemStack::new(&mut MemBuffer::new(scratch)),
        Spec::default(),
    )
    .map_err(not_converged(order))?;
    let vectors = Matrix::from_fn(order, order, |row, column| vectors[(row, column)]);
    Ok((values.column_vector().iter().copied().collect(), vectors))
}

/// Eigenvalues, conjugates adjacent, and the vectors if asked for: one real column for a real
/// eigenvalue; for a conjugate pair the real part in its first column and the imaginary part in its
/// second, the vector of the first of the pair.
pub(super) fn general(
    matrix: &Matrix,
    with_vectors: bool,
) -> Result<(Vec<Complex>, Option<Matrix>), Error> {
    let order = matrix.rows();
    let (mut real, mut imaginary) = (Diag::<f64>::zeros(order), Diag::<f64>::zeros(order));
    let mut vectors = with_vectors.then(|| Mat::<f64>::zeros(order, order));
    let wanted = if with_vectors { ComputeEigenvectors::Yes } else { ComputeEigenvectors::No };
    let scratch =
        evd_scratch::<f64>(order, ComputeEigenvectors::No, wanted, Par::Seq, Spec::default());
    evd_real(
        view(matrix),
        real.as_mut(),
        imaginary.as_mut(),
        None,
        vectors.as_mut().map(Mat::as_mut),
        Par::Seq,
        MemStack::new(&mut MemBuffer::new(scratch)),
        Spec::default(),
    )
    .map_err(not_converged(order))?;
    let real = real.column_vector().iter().copied();
    let imaginary = imaginary.column_vector().iter().copied();
    let values = real.zip(imaginary).map(|(re, im)| Complex { re, im }).collect();
    let vectors = vectors.map(|v| Matrix::from_fn(order, order, |row, column| v[(row, column)]));
    Ok((values, vectors))
}

/// The library's factorisation with row exchanges.
#[derive(Debug, Clone)]
pub(super) struct LargeLu {
    factors: Mat<f64>,
    forward: Vec<usize>,
    backward: Vec<usize>,
}

impl LargeLu {
    pub(super) fn new(matrix: &Matrix, order: usize) -> Result<Self, Error> {
        let mut factors = view(matrix).to_owned();
        let (mut forward, mut backward) = (vec![0; order], vec![0; order]);
        let scratch =
            factor::lu_in_place_scratch::<usize, f64>(order, order, Par::Seq, Spec::default());
        factor::lu_in_place(
            factors.as_mut(),
            &mut forward,
            &mut backward,
            Par::Seq,
            MemStack::new(&mut MemBuffer::new(scratch)),
            Spec::default(),
        );
        let usable = |&k: &usize| factors[(k, k)] != 0.0 && factors[(k, k)].is_finite();
        match (0..order).find(|k| !usable(k)) {
            Some(column) => Err(Error::Singular { dimension: order, column }),
            None => Ok(Self { factors, forward, backward }),
        }
    }

    pub(super) fn order(&self) -> usize {
        self.forward.len()
    }

    pub(super) fn solve(&self, right: &mut [f64]) {
        let order = self.order();
        let permutation = faer::perm::PermRef::new_checked(&self.forward, &self.backward, order);
        let scratch = solve::solve_in_place_scratch::<usize, f64>(order, 1, Par::Seq);
        solve::solve_in_place(
            self.factors.as_ref(),
            self.factors.as_ref(),
            permutation,
            MatMut::from_column_major_slice_mut(right, order, 1),
            Par::Seq,
            MemStack::new(&mut MemBuffer::new(scratch)),
        );
    }
}
