//! The matrix type: a row-major list of numbers with its shape.

use std::ops::{Index, IndexMut};

use crate::error::{Error, has_length};

/// A real matrix, stored row after row.
#[derive(Debug, Clone, PartialEq)]
pub struct Matrix {
    rows: usize,
    columns: usize,
    entries: Vec<f64>,
}

impl Matrix {
    /// The matrix of zeros.
    pub fn zeros(rows: usize, columns: usize) -> Self {
        Self { rows, columns, entries: vec![0.0; rows * columns] }
    }

    /// The identity of the given order.
    pub fn identity(order: usize) -> Self {
        let mut result = Self::zeros(order, order);
        (0..order).for_each(|i| result[(i, i)] = 1.0);
        result
    }

    /// The matrix with `entry(row, column)` everywhere.
    pub fn from_fn(
        rows: usize,
        columns: usize,
        mut entry: impl FnMut(usize, usize) -> f64,
    ) -> Self {
        let mut entries = Vec::with_capacity(rows * columns);
        for row in 0..rows {
            entries.extend((0..columns).map(|column| entry(row, column)));
        }
        Self { rows, columns, entries }
    }

    /// A matrix from its rows, written as in a book: `Matrix::from_rows([[1.0, 2.0], [3.0, 4.0]])`.
    pub fn from_rows<const R: usize, const C: usize>(rows: [[f64; C]; R]) -> Self {
        Self { rows: R, columns: C, entries: rows.concat() }
    }

    /// A matrix from its entries, row after row.
    ///
    /// # Errors
    ///
    /// [`Error::Length`] if there are not `rows * columns` entries.
    pub fn from_row_major(rows: usize, columns: usize, entries: Vec<f64>) -> Result<Self, Error> {
        has_length("matrix", rows * columns, entries.len())?;
        Ok(Self { rows, columns, entries })
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Number of columns.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// One row. Panics, like any index, if there is no such row.
    pub fn row(&self, row: usize) -> &[f64] {
        &self.entries[row * self.columns..(row + 1) * self.columns]
    }

    /// One row, to be changed. Panics, like any index, if there is no such row.
    pub fn row_mut(&mut self, row: usize) -> &mut [f64] {
        &mut self.entries[row * self.columns..(row + 1) * self.columns]
    }

    /// Adds `factor · part partᵀ`, the part in the first rows and columns.
    ///
    /// # Panics
    /// Where the part is longer than the matrix has rows.
    pub fn add_square(&mut self, factor: f64, part: &[f64]) {
        for (row, first) in part.iter().enumerate() {
            let scaled = factor * first;
            for (entry, second) in self.row_mut(row).iter_mut().zip(part) {
                *entry += scaled * second;
            }
        }
    }

    /// A copy of one column. Panics, like any index, if there is no such column.
    pub fn column(&self, column: usize) -> Vec<f64> {
        (0..self.rows).map(|row| self[(row, column)]).collect()
    }

    /// All entries, row after row.
    pub fn as_slice(&self) -> &[f64] {
        &self.entries
    }

    /// All entries, row after row, to be changed.
    pub fn as_mut_slice(&mut self) -> &mut [f64] {
        &mut self.entries
    }

    /// The transpose.
    pub fn transpose(&self) -> Self {
        Self::from_fn(self.columns, self.rows, |row, column| self[(column, row)])
    }

    /// The product `self other`.
    ///
    /// # Errors
    ///
    /// [`Error::Length`] if `other` has not as many rows as `self` has columns.
    pub fn mul(&self, other: &Self) -> Result<Self, Error> {
        has_length("rows of the right factor", self.columns, other.rows)?;
        let mut result = Self::zeros(self.rows, other.columns);
        for i in 0..self.rows {
            for (k, &factor) in self.row(i).iter().enumerate() {
                for (sum, term) in result.row_mut(i).iter_mut().zip(other.row(k)) {
                    *sum += factor * term;
                }
            }
        }
        Ok(result)
    }

    /// The product `self vector`.
    ///
    /// # Errors
    ///
    /// [`Error::Length`] if `vector` has not as many entries as `self` has columns.
    pub fn mul_vector(&self, vector: &[f64]) -> Result<Vec<f64>, Error> {
        has_length("vector beside a matrix", self.columns, vector.len())?;
        let product = |row: usize| self.row(row).iter().zip(vector).map(|(a, x)| a * x).sum();
        Ok((0..self.rows).map(product).collect())
    }

    /// The order of a square matrix.
    pub(super) fn order(&self, operation: &'static str) -> Result<usize, Error> {
        if self.rows == self.columns {
            Ok(self.rows)
        } else {
            Err(Error::NotSquare { operation, rows: self.rows, columns: self.columns })
        }
    }
}

impl Index<(usize, usize)> for Matrix {
    type Output = f64;

    fn index(&self, (row, column): (usize, usize)) -> &f64 {
        &self.row(row)[column]
    }
}

impl IndexMut<(usize, usize)> for Matrix {
    fn index_mut(&mut self, (row, column): (usize, usize)) -> &mut f64 {
        &mut self.row_mut(row)[column]
    }
}
