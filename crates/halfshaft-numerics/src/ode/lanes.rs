//! Arithmetic on a few neighbouring components at once.
//!
//! The components of the state are taken in groups of [`WIDTH`], each with all its stage
//! derivatives side by side. Vectors are padded with zeros to whole groups, so loops have no tails,
//! and the compiler turns each group into one vector register.

/// A stage and its coefficient.
pub(crate) type Term = (usize, f64);

/// Components in a group.
pub(super) const WIDTH: usize = 2;

/// A group of components.
pub(super) type Lanes = [f64; WIDTH];

/// Length of a vector of `dimension` components, padded to whole groups.
pub(super) fn padded(dimension: usize) -> usize {
    dimension.next_multiple_of(WIDTH)
}

/// A vector padded with `filler`.
pub(super) fn padded_copy(values: &[f64], filler: f64) -> Vec<f64> {
    let mut copy = values.to_vec();
    copy.resize(padded(values.len()), filler);
    copy
}

/// The groups of a padded vector.
#[inline(always)]
pub(super) fn groups(vector: &[f64]) -> &[Lanes] {
    vector.as_chunks().0
}

/// The groups of a padded vector, to be changed.
#[inline(always)]
pub(super) fn groups_mut(vector: &mut [f64]) -> &mut [Lanes] {
    vector.as_chunks_mut().0
}

/// `Σ weight slope[stage]` over a row of the tableau.
///
/// The newest stage comes last in every row: the processor then adds up all others while that one
/// is still being computed.
#[inline(always)]
pub(super) fn weighted<const STAGES: usize, const N: usize>(
    slopes: &[Lanes; STAGES],
    row: &[Term; N],
) -> Lanes {
    let (stage, weight) = row[0];
    let mut sum = slopes[stage].map(|slope| weight * slope);
    for &(stage, weight) in &row[1..] {
        for lane in 0..WIDTH {
            sum[lane] += weight * slopes[stage][lane];
        }
    }
    sum
}

/// `start + factor slope`.
#[inline(always)]
pub(super) fn advanced(start: &Lanes, factor: f64, slope: &Lanes) -> Lanes {
    std::array::from_fn(|lane| start[lane] + factor * slope[lane])
}
