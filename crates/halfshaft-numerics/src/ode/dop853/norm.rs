//! The error estimate of a step, in units of the tolerance.

use super::lanes::{Lanes, Slopes, WIDTH, groups, weighted};
use super::tableau::{B, B3, E5};

/// What an error is measured by.
#[derive(Debug, Clone)]
pub(super) struct ErrorScale {
    /// Absolute tolerances, padded with ones.
    pub(super) absolute: Vec<f64>,
    pub(super) relative: f64,
    /// Components without the padding.
    pub(super) dimension: usize,
}

impl ErrorScale {
    /// `absolute + relative max(|a|, |b|)` for one group.
    #[inline(always)]
    fn of(&self, absolute: &Lanes, a: &Lanes, b: &Lanes) -> Lanes {
        std::array::from_fn(|lane| {
            absolute[lane] + self.relative * a[lane].abs().max(b[lane].abs())
        })
    }

    /// Root mean square of `vector / (absolute + relative |state|)`.
    pub(super) fn norm(&self, vector: &[f64], state: &[f64]) -> f64 {
        let mut sum = 0.0;
        for ((vector, state), absolute) in
            groups(vector).iter().zip(groups(state)).zip(groups(&self.absolute))
        {
            let scale = self.of(absolute, state, state);
            for lane in 0..WIDTH {
                let share = vector[lane] / scale[lane];
                sum += share * share;
            }
        }
        (sum / self.dimension as f64).sqrt()
    }

    /// The error of a step of the given length; accepted if at most one, NaN if not finite.
    ///
    /// With the norms `e5`, `e3` of the two estimates it is `|h| e5² / √(e5² + 0.01 e3²)`, which
    /// behaves like the power 8 of the step length (Hairer et al., section II.10).
    #[inline]
    pub(super) fn of_step(
        &self,
        length: f64,
        slopes: &[Slopes],
        start: &[f64],
        end: &[f64],
    ) -> f64 {
        let (mut fifth, mut third) = ([0.0; WIDTH], [0.0; WIDTH]);
        let tolerances = groups(&self.absolute).iter();
        for (((slopes, start), end), absolute) in
            slopes.iter().zip(groups(start)).zip(groups(end)).zip(tolerances)
        {
            let scale = self.of(absolute, start, end);
            let (e5, b, b3) = (weighted(slopes, &E5), weighted(slopes, &B), weighted(slopes, &B3));
            for lane in 0..WIDTH {
                let inverse = 1.0 / scale[lane];
                let (five, three) = (e5[lane] * inverse, (b[lane] - b3[lane]) * inverse);
                fifth[lane] += five * five;
                third[lane] += three * three;
            }
        }
        let (fifth, third): (f64, f64) = (fifth.iter().sum(), third.iter().sum());
        if fifth == 0.0 {
            return 0.0;
        }
        length.abs() * fifth / ((fifth + 0.01 * third) * self.dimension as f64).sqrt()
    }
}
