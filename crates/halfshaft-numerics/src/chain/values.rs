//! Eigenvalues of `L Lᵀ` by the differential quotient-difference algorithm.
//!
//! A transform with shift `τ` leads from `L Lᵀ` to another `L Lᵀ` that has every eigenvalue less by
//! `τ`. Below the lowest one it subtracts nothing but the shift, and the last entry goes to zero, cubically
//! with the shift of Laguerre; then the sum of the shifts is an eigenvalue, and the row is left out.

use super::Squares;

/// Transforms for each eigenvalue, in the mean, before the iteration is given up.
const MOST_TRANSFORMS: usize = 40;
/// Shares of a shift that are tried when rounding has made it too large.
const SHARES: [f64; 4] = [1.0, 0.999, 0.9, 0.0];
/// What is less than this times the eigenvalue does not change it.
const ROUNDING: f64 = 4.0 * f64::EPSILON;
/// The same for what enters by its product with another entry.
const SQUARED: f64 = f64::EPSILON * f64::EPSILON;
/// Ratio of last to first entry from which a block is turned about.
const TURNED: f64 = 1.5;

/// All eigenvalues, ascending.
pub(super) fn all(squares: &Squares) -> Option<Vec<f64>> {
    let count = squares.diagonal.len();
    let mut found = Vec::with_capacity(count);
    let whole = Block {
        diagonal: squares.diagonal.clone(),
        below: squares.below.clone(),
        taken: Taken::default(),
        bound: 0.0,
    };
    let mut left = vec![whole];
    let mut room = squares.clone();
    let mut transforms = MOST_TRANSFORMS * count;
    while let Some(mut block) = left.pop() {
        while !block.diagonal.is_empty() {
            if let Some(value) = block.settled() {
                found.push(value);
                continue;
            }
            if let Some(above) = block.split() {
                left.push(above);
                continue;
            }
            transforms = transforms.checked_sub(1)?;
            block.transform(&mut room)?;
        }
    }
    found.sort_by(f64::total_cmp);
    Some(found)
}

/// Rows that hang together, with what has been taken off their eigenvalues.
struct Block {
    diagonal: Vec<f64>,
    below: Vec<f64>,
    taken: Taken,
    /// A lower bound of the lowest eigenvalue.
    bound: f64,
}

/// A sum with what rounding has kept out of it.
#[derive(Clone, Copy, Default)]
struct Taken {
    sum: f64,
    kept_out: f64,
}

impl Taken {
    fn and(self, term: f64) -> Self {
        let sum = self.sum + term;
        let of_term = sum - self.sum;
        let lost = (self.sum - (sum - of_term)) + (term - of_term);
        Self { sum, kept_out: self.kept_out + lost }
    }

    fn total(self) -> f64 {
        self.sum + self.kept_out
    }
}

impl Block {
    /// The eigenvalue of the last row where nothing couples it any more, which leaves the block.
    fn settled(&mut self) -> Option<f64> {
        let last = *self.diagonal.last()?;
        let value = self.taken.and(last).total();
        let coupling = self.below.last().copied().unwrap_or(0.0);
        if coupling > SQUARED * value {
            return None;
        }
        self.below.pop();
        self.diagonal.pop();
        self.bound = Traces::of(&self.diagonal, &self.below).laguerre(self.diagonal.len());
        Some(value)
    }

    /// The rows above the last coupling that is nothing, which leave the block.
    fn split(&mut self) -> Option<Self> {
        // No eigenvalue of the block is less than what has been taken off.
        let at = self.below.iter().rposition(|below| *below <= SQUARED * self.taken.sum)?;
        let diagonal = self.diagonal.drain(..=at).collect();
        let mut below: Vec<f64> = self.below.drain(..=at).collect();
        below.pop();
        Some(Self { diagonal, below, taken: self.taken, bound: self.bound })
    }

    /// One transform with as large a shift as is safe.
    fn transform(&mut self, room: &mut Squares) -> Option<()> {
        let last = self.diagonal.len() - 1;
        if TURNED * self.diagonal[0] < self.diagonal[last] {
            self.diagonal.reverse();
            self.below.reverse();
        }
        room.diagonal.resize(last + 1, 0.0);
        room.below.resize(last, 0.0);
        for share in SHARES {
            let shift = share * self.bound;
            let taken = self.taken.and(shift);
            if let Some(traces) = self.shifted(shift, ROUNDING * taken.sum, room) {
                std::mem::swap(&mut self.diagonal, &mut room.diagonal);
                std::mem::swap(&mut self.below, &mut room.below);
                (self.taken, self.bound) = (taken, traces.laguerre(last + 1));
                return Some(());
            }
        }
        None
    }

    /// The transform with that shift, with its traces; `None` where the shift is above an eigenvalue. What
    /// is less than `rounding` is nothing.
    fn shifted(&self, shift: f64, rounding: f64, next: &mut Squares) -> Option<Traces> {
        let mut traces = Traces::default();
        let (first, rest) = self.diagonal.split_first()?;
        let mut pivot = first - shift;
        let mut lowest = pivot;
        let given = self.below.iter().zip(rest);
        let made = next.diagonal.iter_mut().zip(&mut next.below);
        for ((below, entry), (new_entry, new_below)) in given.zip(made) {
            let sum = pivot + below;
            let ratio = entry / sum;
            let coupling = below * ratio;
            (*new_entry, *new_below) = (sum, coupling);
            traces.take(sum, coupling);
            pivot = pivot * ratio - shift;
            lowest = if pivot < lowest { pivot } else { lowest };
        }
        // The last pivot is what is left of the eigenvalue.
        if pivot < 0.0 && pivot >= -rounding && pivot <= lowest {
            (pivot, lowest) = (0.0, 0.0);
        }
        *next.diagonal.last_mut()? = pivot;
        traces.take(pivot, 0.0);
        (lowest >= 0.0 && pivot >= 0.0).then_some(traces)
    }
}

/// Traces of the first two powers of the inverse of `L Lᵀ`.
///
/// With the pivots `D` of `L Lᵀ - τ` as functions of `τ`, both are sums of positive terms in
/// `slope = -D'` and `curvature = -D''` at `τ = 0`.
struct Traces {
    slope: f64,
    curvature: f64,
    first: f64,
    second: f64,
}

impl Default for Traces {
    fn default() -> Self {
        Self { slope: 1.0, curvature: 0.0, first: 0.0, second: 0.0 }
    }
}

impl Traces {
    fn of(diagonal: &[f64], below: &[f64]) -> Self {
        let mut traces = Self::default();
        let couplings = below.iter().copied().chain([0.0]);
        diagonal.iter().zip(couplings).for_each(|(entry, below)| traces.take(*entry, below));
        traces
    }

    /// Takes a row with what stands below its diagonal.
    #[inline]
    fn take(&mut self, diagonal: f64, below: f64) {
        let inverse = 1.0 / diagonal;
        let part = self.slope * inverse;
        self.first += part;
        self.second += part * part + self.curvature * inverse;
        let ratio = below * inverse;
        self.curvature = ratio * (self.curvature + 2.0 * self.slope * part);
        self.slope = 1.0 + ratio * self.slope;
    }

    /// A lower bound of the lowest of `count` eigenvalues, cubically near where that is far below the
    /// others; 0 where the traces are out of the numbers.
    fn laguerre(&self, count: usize) -> f64 {
        let Self { first, second, .. } = self;
        #[expect(clippy::cast_precision_loss, reason = "a size")]
        let count = count as f64;
        let spread = ((count - 1.0) * (count * second - first * first)).max(0.0);
        let bound = count / (first + spread.sqrt());
        if bound.is_finite() { bound } else { 0.0 }
    }
}
