//! The bordered block system and its factorisation.

use super::kernel::{factorise, solve, solve_transposed, subtract_product, subtract_transposed};
use super::pattern::Pattern;
use super::sized::{Work, sized};
use crate::error::Error;

/// A bordered block system being assembled. Vectors have the `m` entries of each node after those
/// of the node before, in the order of the nodes (not of elimination).
#[derive(Debug, Clone)]
pub struct BlockSystem {
    pattern: Pattern,
    size: usize,
    borders: usize,
    /// Diagonal blocks by position.
    diagonal: Vec<f64>,
    /// Blocks (earlier, later) by pair.
    upper: Vec<f64>,
    /// Blocks (later, earlier) by pair.
    lower: Vec<f64>,
    /// Border columns by position, `m` by `k` each.
    columns: Vec<f64>,
    /// Border rows by position, `k` by `m` each.
    rows: Vec<f64>,
    /// `k` by `k`.
    corner: Vec<f64>,
}

/// A factorised [`BlockSystem`].
#[derive(Debug, Clone)]
pub struct Factors {
    system: BlockSystem,
    pivots: Vec<usize>,
    root: Vec<f64>,
    root_pivots: Vec<usize>,
    sign: f64,
    scratch: Vec<f64>,
}

impl BlockSystem {
    /// A system of zeros: blocks of `size` on the pattern with `borders` rows and columns.
    pub fn new(pattern: Pattern, size: usize, borders: usize) -> Self {
        let (nodes, pairs) = (pattern.nodes(), pattern.pairs());
        Self {
            size,
            borders,
            diagonal: vec![0.0; nodes * size * size],
            upper: vec![0.0; pairs * size * size],
            lower: vec![0.0; pairs * size * size],
            columns: vec![0.0; nodes * size * borders],
            rows: vec![0.0; nodes * size * borders],
            corner: vec![0.0; borders * borders],
            pattern,
        }
    }

    /// The pattern.
    pub fn pattern(&self) -> &Pattern {
        &self.pattern
    }

    /// Number of unknowns without the border.
    pub fn unknowns(&self) -> usize {
        self.pattern.nodes() * self.size
    }

    /// Sets everything to zero.
    pub fn clear(&mut self) {
        for part in [
            &mut self.diagonal,
            &mut self.upper,
            &mut self.lower,
            &mut self.columns,
            &mut self.rows,
            &mut self.corner,
        ] {
            part.fill(0.0);
        }
    }

    /// The block in the rows of node `row` and the columns of node `column`, row-major. The nodes
    /// must be the same or joined.
    pub fn block_mut(&mut self, row: usize, column: usize) -> &mut [f64] {
        let (r, c) = (self.pattern.position(row), self.pattern.position(column));
        let square = self.size * self.size;
        let (store, place) = match r.cmp(&c) {
            std::cmp::Ordering::Equal => (&mut self.diagonal, r),
            std::cmp::Ordering::Less => (&mut self.upper, self.pattern.pair(r, c)),
            std::cmp::Ordering::Greater => (&mut self.lower, self.pattern.pair(c, r)),
        };
        &mut store[place * square..(place + 1) * square]
    }

    /// Sets border column `index` from a vector of all unknowns.
    pub fn set_column(&mut self, index: usize, values: &[f64]) {
        let (m, k) = (self.size, self.borders);
        for (node, values) in values.chunks_exact(m).enumerate() {
            let at = self.pattern.position(node) * m * k;
            for (row, value) in values.iter().enumerate() {
                self.columns[at + row * k + index] = *value;
            }
        }
    }

    /// Sets border row `index` from a vector of all unknowns.
    pub fn set_row(&mut self, index: usize, values: &[f64]) {
        let (m, k) = (self.size, self.borders);
        for (node, values) in values.chunks_exact(m).enumerate() {
            let at = self.pattern.position(node) * m * k + index * m;
            self.rows[at..at + m].copy_from_slice(values);
        }
    }

    /// Sets an entry of the corner.
    pub fn set_corner(&mut self, row: usize, column: usize, value: f64) {
        self.corner[row * self.borders + column] = value;
    }

    /// `out += A x` without the border.
    pub fn add_product(&self, x: &[f64], out: &mut [f64]) {
        let m = self.size;
        let square = m * m;
        let add = |block: &[f64], from: usize, to: usize, out: &mut [f64]| {
            let source = &x[from * m..(from + 1) * m];
            let target = &mut out[to * m..(to + 1) * m];
            for (row, target) in block.chunks_exact(m).zip(target) {
                *target += row.iter().zip(source).map(|(a, b)| a * b).sum::<f64>();
            }
        };
        let order = |position: usize| self.pattern.node(position);
        for position in 0..self.pattern.nodes() {
            let node = order(position);
            add(&self.diagonal[position * square..(position + 1) * square], node, node, out);
            for (offset, &later) in self.pattern.later(position).iter().enumerate() {
                let pair = (self.pattern.first(position) + offset) * square;
                add(&self.upper[pair..pair + square], order(later), node, out);
                add(&self.lower[pair..pair + square], node, order(later), out);
            }
        }
    }

    /// `out += Aᵀ x` without the border.
    pub fn add_transposed_product(&self, x: &[f64], out: &mut [f64]) {
        let m = self.size;
        let square = m * m;
        let add = |block: &[f64], from: usize, to: usize, out: &mut [f64]| {
            let target = &mut out[to * m..(to + 1) * m];
            for (row, factor) in block.chunks_exact(m).zip(&x[from * m..(from + 1) * m]) {
                for (target, entry) in target.iter_mut().zip(row) {
                    *target += factor * entry;
                }
            }
        };
        let order = |position: usize| self.pattern.node(position);
        for position in 0..self.pattern.nodes() {
            let node = order(position);
            add(&self.diagonal[position * square..(position + 1) * square], node, node, out);
            for (offset, &later) in self.pattern.later(position).iter().enumerate() {
                let pair = (self.pattern.first(position) + offset) * square;
                add(&self.upper[pair..pair + square], node, order(later), out);
                add(&self.lower[pair..pair + square], order(later), node, out);
            }
        }
    }

    /// Factorises the system into `factors`, whose store is used again.
    ///
    /// # Errors
    /// [`Error::Singular`] where the bordered matrix is singular, or a part of the graph that is cut
    /// off by holding its neighbours is.
    pub fn factorise(&self, factors: &mut Option<Factors>) -> Result<(), Error> {
        let nodes = self.pattern.nodes();
        let order = self.size + self.borders;
        match factors {
            Some(known) if known.system.same_shape(self) => {
                known.system.copy_from(self);
            }
            _ => {
                *factors = Some(Factors {
                    system: self.clone(),
                    pivots: vec![0; nodes * self.size],
                    root: vec![0.0; order * order],
                    root_pivots: vec![0; order],
                    sign: 1.0,
                    scratch: vec![0.0; order.max(self.unknowns())],
                });
            }
        }
        match factors {
            Some(factors) => sized(factors.order(), Run(factors)),
            None => Ok(()),
        }
    }

    fn same_shape(&self, other: &Self) -> bool {
        self.size == other.size && self.borders == other.borders && self.pattern == other.pattern
    }

    fn copy_from(&mut self, other: &Self) {
        self.diagonal.copy_from_slice(&other.diagonal);
        self.upper.copy_from_slice(&other.upper);
        self.lower.copy_from_slice(&other.lower);
        self.columns.copy_from_slice(&other.columns);
        self.rows.copy_from_slice(&other.rows);
        self.corner.copy_from_slice(&other.corner);
    }
}

/// The factorisation.
struct Run<'f>(&'f mut Factors);

impl Work for Run<'_> {
    type Output = Result<(), Error>;

    #[inline(always)]
    fn run<const M: usize, const R: usize>(self) -> Self::Output {
        self.0.run::<M, R>()
    }
}

/// The solution for one right-hand side and its border.
struct Solve<'s>(&'s mut Factors, &'s mut [f64], &'s mut [f64]);

impl Work for Solve<'_> {
    type Output = ();

    #[inline(always)]
    fn run<const M: usize, const R: usize>(self) {
        self.0.solve_sized::<M, R>(self.1, self.2);
    }
}

impl Factors {
    /// Sign of the determinant of the bordered matrix.
    pub fn sign(&self) -> f64 {
        self.sign
    }

    /// The order of blocks with one border; 0 of those with others.
    fn order(&self) -> usize {
        if self.system.borders == 1 { self.system.size } else { 0 }
    }

    #[inline(always)]
    fn run<const M: usize, const R: usize>(&mut self) -> Result<(), Error> {
        self.sign = 1.0;
        let last = self.system.pattern.nodes() - 1;
        for position in 0..last {
            self.eliminate::<M>(position)?;
        }
        let (m, k) = if M > 0 { (M, 1) } else { (self.system.size, self.system.borders) };
        let order = m + k;
        let system = &self.system;
        for row in 0..m {
            let target = &mut self.root[row * order..(row + 1) * order];
            let at = last * m * m + row * m;
            target[..m].copy_from_slice(&system.diagonal[at..at + m]);
            let at = (last * m + row) * k;
            target[m..].copy_from_slice(&system.columns[at..at + k]);
        }
        for row in 0..k {
            let target = &mut self.root[(m + row) * order..(m + row + 1) * order];
            let at = (last * k + row) * m;
            target[..m].copy_from_slice(&system.rows[at..at + m]);
            target[m..].copy_from_slice(&system.corner[row * k..(row + 1) * k]);
        }
        if factorise::<R>(&mut self.root, order, &mut self.root_pivots, &mut self.sign) {
            Ok(())
        } else {
            Err(Error::Singular { dimension: self.system.unknowns() + k, column: last * m })
        }
    }

    /// Takes one node out: divides its row of blocks and subtracts from what is joined.
    #[inline(always)]
    fn eliminate<const M: usize>(&mut self, position: usize) -> Result<(), Error> {
        let BlockSystem { pattern, size, borders, diagonal, upper, lower, columns, rows, corner } =
            &mut self.system;
        let (m, k) = if M > 0 { (M, 1) } else { (*size, *borders) };
        let square = m * m;
        let pivots = &mut self.pivots[position * m..(position + 1) * m];
        let (before, after) = diagonal.split_at_mut((position + 1) * square);
        let own = &mut before[position * square..];
        if !factorise::<M>(own, m, pivots, &mut self.sign) {
            let dimension = pattern.nodes() * m + k;
            return Err(Error::Singular { dimension, column: position * m });
        }
        let (later, first) = (pattern.later(position), pattern.first(position));
        let pairs = first * square..(first + later.len()) * square;
        for block in upper[pairs].chunks_exact_mut(square) {
            solve::<M>(own, m, pivots, block, m);
        }
        let offset = (position + 1) * m * k;
        let (own_columns, later_columns) = columns.split_at_mut(offset);
        let own_columns = &mut own_columns[position * m * k..];
        let (own_rows, later_rows) = rows.split_at_mut(offset);
        let own_rows = &own_rows[position * m * k..];
        if k > 0 {
            solve::<M>(own, m, pivots, own_columns, k);
            subtract_product::<M>(own_rows, own_columns, m, k, corner);
        }
        for (at, &row) in later.iter().enumerate() {
            let pair = (first + at) * square..(first + at + 1) * square;
            let (left, right) = (&lower[pair.clone()], &upper[pair]);
            if k > 0 {
                let place = row * m * k - offset..(row + 1) * m * k - offset;
                let target = &mut later_columns[place.clone()];
                subtract_product::<M>(left, own_columns, m, k, target);
                subtract_product::<M>(own_rows, right, m, m, &mut later_rows[place]);
            }
            let place = (row - position - 1) * square;
            subtract_product::<M>(left, right, m, m, &mut after[place..place + square]);
        }
        let joined = later.iter().enumerate();
        let others = joined.clone().flat_map(|one| joined.clone().map(move |other| (one, other)));
        for ((at, &row), (other, &column)) in others.filter(|(one, other)| one.0 != other.0) {
            let block = |at: usize| (first + at) * square..(first + at + 1) * square;
            let (left, right) = (lower[block(at)].to_vec(), upper[block(other)].to_vec());
            let (store, target) = if row < column {
                (&mut *upper, pattern.pair(row, column))
            } else {
                (&mut *lower, pattern.pair(column, row))
            };
            let target = &mut store[target * square..(target + 1) * square];
            subtract_product::<M>(&left, &right, m, m, target);
        }
        Ok(())
    }

    /// Solves for `x` (all unknowns) and `y` (the border), given in them the right-hand sides.
    pub fn solve(&mut self, x: &mut [f64], y: &mut [f64]) {
        sized(self.order(), Solve(self, x, y));
    }

    #[inline(always)]
    fn solve_sized<const M: usize, const R: usize>(&mut self, x: &mut [f64], y: &mut [f64]) {
        let system = &self.system;
        let (m, k) = if M > 0 { (M, 1) } else { (system.size, system.borders) };
        let square = m * m;
        let last = system.pattern.nodes() - 1;
        for position in 0..last {
            let node = system.pattern.node(position) * m;
            let lu = &system.diagonal[position * square..(position + 1) * square];
            let own = &mut self.scratch[..m];
            own.copy_from_slice(&x[node..node + m]);
            solve::<M>(lu, m, &self.pivots[position * m..(position + 1) * m], own, 1);
            x[node..node + m].copy_from_slice(own);
            let first = system.pattern.first(position);
            for (at, &row) in system.pattern.later(position).iter().enumerate() {
                let pair = (first + at) * square;
                let target = system.pattern.node(row) * m;
                let block = &system.lower[pair..pair + square];
                subtract_product::<M>(block, own, m, 1, &mut x[target..target + m]);
            }
            let rows = &system.rows[position * m * k..(position + 1) * m * k];
            subtract_product::<M>(rows, own, m, 1, y);
        }
        let node = system.pattern.node(last) * m;
        let root = &mut self.scratch[..m + k];
        root[..m].copy_from_slice(&x[node..node + m]);
        root[m..].copy_from_slice(y);
        solve::<R>(&self.root, m + k, &self.root_pivots, root, 1);
        x[node..node + m].copy_from_slice(&root[..m]);
        y.copy_from_slice(&root[m..]);
        for position in (0..last).rev() {
            let node = system.pattern.node(position) * m;
            let own = &mut self.scratch[..m];
            own.copy_from_slice(&x[node..node + m]);
            let first = system.pattern.first(position);
            for (at, &column) in system.pattern.later(position).iter().enumerate() {
                let pair = (first + at) * square;
                let from = system.pattern.node(column) * m;
                subtract_product::<M>(
                    &system.upper[pair..pair + square],
                    &x[from..from + m],
                    m,
                    1,
                    own,
                );
            }
            if k > 0 {
                let columns = &system.columns[position * m * k..(position + 1) * m * k];
                subtract_product::<0>(columns, y, k, 1, own);
            }
            x[node..node + m].copy_from_slice(own);
        }
    }

    /// Solves the transposed system, rows and columns of the border exchanged.
    pub fn solve_transposed(&mut self, x: &mut [f64], y: &mut [f64]) {
        let system = &self.system;
        let (m, k) = (system.size, system.borders);
        let square = m * m;
        let last = system.pattern.nodes() - 1;
        for position in 0..last {
            let node = system.pattern.node(position) * m;
            let own = &mut self.scratch[..m];
            own.copy_from_slice(&x[node..node + m]);
            let first = system.pattern.first(position);
            for (at, &row) in system.pattern.later(position).iter().enumerate() {
                let pair = (first + at) * square;
                let target = system.pattern.node(row) * m;
                let block = &system.upper[pair..pair + square];
                subtract_transposed(block, own, &mut x[target..target + m]);
            }
            if k > 0 {
                subtract_transposed(
                    &system.columns[position * m * k..(position + 1) * m * k],
                    own,
                    y,
                );
            }
        }
        let node = system.pattern.node(last) * m;
        let root = &mut self.scratch[..m + k];
        root[..m].copy_from_slice(&x[node..node + m]);
        root[m..].copy_from_slice(y);
        solve_transposed(&self.root, m + k, &self.root_pivots, root);
        x[node..node + m].copy_from_slice(&root[..m]);
        y.copy_from_slice(&root[m..]);
        for position in (0..last).rev() {
            let node = system.pattern.node(position) * m;
            let own = &mut self.scratch[..m];
            own.copy_from_slice(&x[node..node + m]);
            let first = system.pattern.first(position);
            for (at, &row) in system.pattern.later(position).iter().enumerate() {
                let pair = (first + at) * square;
                let from = system.pattern.node(row) * m;
                subtract_transposed(&system.lower[pair..pair + square], &x[from..from + m], own);
            }
            if k > 0 {
                subtract_transposed(&system.rows[position * m * k..(position + 1) * m * k], y, own);
            }
            let lu = &system.diagonal[position * square..(position + 1) * square];
            solve_transposed(lu, m, &self.pivots[position * m..(position + 1) * m], own);
            x[node..node + m].copy_from_slice(own);
        }
    }
}
