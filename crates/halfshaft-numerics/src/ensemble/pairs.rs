//! Runge-Kutta pairs for lanes.

use super::Lanes;
use crate::ode::dop853::tableau::{
    A1, A2, A3, A4, A5, A6, A7, A8, A9, A10, A11, B, B3, C, E5, Term,
};

/// Most stages of a pair, that at the end of the step included.
pub(super) const LARGEST_STAGES: usize = 13;

/// A Runge-Kutta pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Pair {
    /// Dormand and Prince, order 8(5,3): for tolerances from 1e-6 on.
    DormandPrince8,
    /// Tsitouras, order 5(4): for loose tolerances.
    Tsitouras5,
}

/// The coefficients of a pair of which the last stage is the derivative at the end of the step.
pub(super) trait Coefficients: Copy + Send + Sync {
    /// Stages, that at the end of the step included.
    const STAGES: usize;
    /// Power of the step length with which the error estimate falls.
    const POWER: f64;
    /// Parts of the error estimate.
    const PARTS: usize;

    /// Times of the stages in the step.
    fn nodes() -> &'static [f64];

    /// What leads to a stage; the row of the last one leads to the end of the step.
    fn row(stage: usize) -> &'static [Term];

    /// One part of the error over the step length, from the stages of a component.
    fn error<L: Lanes>(part: usize, slopes: &[L; LARGEST_STAGES]) -> L;

    /// The error from the sums of squares of its parts in units of the tolerance, and the number of
    /// components.
    fn norm<L: Lanes>(length: L, squares: [L; 2], count: f64) -> L;
}

/// `Σ weight slope` over a row.
#[inline(always)]
pub(super) fn weighted<L: Lanes>(slopes: &[L; LARGEST_STAGES], row: &[Term]) -> L {
    let mut sum = L::splat(0.0);
    for &(stage, weight) in row {
        sum = L::splat(weight).mul_add(slopes[stage], sum);
    }
    sum
}

/// See [`crate::ode::dop853`].
#[derive(Clone, Copy, Debug)]
pub(super) struct Eighth;

impl Coefficients for Eighth {
    const STAGES: usize = 13;
    const POWER: f64 = 8.0;
    const PARTS: usize = 2;

    #[inline(always)]
    fn nodes() -> &'static [f64] {
        &C
    }

    #[inline(always)]
    fn row(stage: usize) -> &'static [Term] {
        let rows: [&'static [Term]; 12] =
            [&A1, &A2, &A3, &A4, &A5, &A6, &A7, &A8, &A9, &A10, &A11, &B];
        rows[stage - 1]
    }

    #[inline(always)]
    fn error<L: Lanes>(part: usize, slopes: &[L; LARGEST_STAGES]) -> L {
        if part == 0 { weighted(slopes, &E5) } else { weighted(slopes, &B) - weighted(slopes, &B3) }
    }

    /// `|h| e5² / √(e5² + 0.01 e3²)` (Hairer et al., section II.10).
    #[inline(always)]
    fn norm<L: Lanes>(length: L, [fifth, third]: [L; 2], count: f64) -> L {
        let both = third.mul_add(L::splat(0.01), fifth) * L::splat(count);
        let zero = L::splat(0.0);
        let error = length.abs() * fifth / both.sqrt();
        fifth.select(zero, |fifth, zero| fifth == zero, zero, error)
    }
}

/// Ch. Tsitouras, Computers and Mathematics with Applications 62 (2011) 770.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fifth;

const FIFTH_NODES: [f64; 7] = [0.0, 0.161, 0.327, 0.9, 0.980_025_540_904_509_7, 1.0, 1.0];
const FIFTH_1: [Term; 1] = [(0, 0.161)];
const FIFTH_2: [Term; 2] = [(0, -0.008_480_655_492_356_989), (1, 0.335_480_655_492_357)];
const FIFTH_3: [Term; 3] =
    [(0, 2.897_153_057_105_493_5), (1, -6.359_448_489_975_075), (2, 4.362_295_432_869_581_5)];
const FIFTH_4: [Term; 4] = [
    (0, 5.325_864_828_439_257),
    (1, -11.748_883_564_062_828),
    (2, 7.495_539_342_889_836_5),
    (3, -0.092_495_066_361_755_25),
];
const FIFTH_5: [Term; 5] = [
    (0, 5.861_455_442_946_42),
    (1, -12.920_969_317_847_11),
    (2, 8.159_367_898_576_159),
    (3, -0.071_584_973_281_401),
    (4, -0.028_269_050_394_068_383),
];
const FIFTH_END: [Term; 6] = [
    (0, 0.096_460_766_818_065_23),
    (1, 0.01),
    (2, 0.479_889_650_414_499_6),
    (3, 1.379_008_574_103_742),
    (4, -3.290_069_515_436_081),
    (5, 2.324_710_524_099_774),
];
const FIFTH_ERROR: [Term; 7] = [
    (0, -0.001_780_011_052_225_777),
    (1, -0.000_816_434_459_656_746_9),
    (2, 0.007_880_878_010_261_995),
    (3, -0.144_711_007_173_262_9),
    (4, 0.582_357_165_452_555_2),
    (5, -0.458_082_105_929_187),
    (6, 0.015_151_515_151_515_152),
];

impl Coefficients for Fifth {
    const STAGES: usize = 7;
    const POWER: f64 = 5.0;
    const PARTS: usize = 1;

    #[inline(always)]
    fn nodes() -> &'static [f64] {
        &FIFTH_NODES
    }

    #[inline(always)]
    fn row(stage: usize) -> &'static [Term] {
        let rows: [&'static [Term]; 6] =
            [&FIFTH_1, &FIFTH_2, &FIFTH_3, &FIFTH_4, &FIFTH_5, &FIFTH_END];
        rows[stage - 1]
    }

    #[inline(always)]
    fn error<L: Lanes>(_: usize, slopes: &[L; LARGEST_STAGES]) -> L {
        weighted(slopes, &FIFTH_ERROR)
    }

    /// Root mean square.
    #[inline(always)]
    fn norm<L: Lanes>(length: L, [square, _]: [L; 2], count: f64) -> L {
        length.abs() * (square / L::splat(count)).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::{Coefficients, Eighth, FIFTH_ERROR, Fifth};

    /// Row sums are the nodes; the weights integrate powers of time up to one less than the order.
    fn check<P: Coefficients>(order: i32) {
        for stage in 1..P::STAGES {
            let sum: f64 = P::row(stage).iter().map(|(_, weight)| weight).sum();
            assert!((sum - P::nodes()[stage]).abs() < 2e-14, "row of stage {stage}: {sum}");
        }
        for power in 0..order {
            let term = |(stage, weight): &(usize, f64)| weight * P::nodes()[*stage].powi(power);
            let sum: f64 = P::row(P::STAGES - 1).iter().map(term).sum();
            assert!((sum - 1.0 / f64::from(power + 1)).abs() < 2e-14, "power {power}: {sum}");
        }
    }

    // Source: conditions of consistency and quadrature (Hairer, Nørsett, Wanner, section II.1).
    #[test]
    fn coefficients_meet_the_conditions_of_quadrature() {
        check::<Eighth>(8);
        check::<Fifth>(5);
        for power in 0..4 {
            let term = |(stage, weight): &(usize, f64)| weight * Fifth::nodes()[*stage].powi(power);
            assert!(FIFTH_ERROR.iter().map(term).sum::<f64>().abs() < 1e-8, "power {power}");
        }
    }
}
