//! The error estimate of a step, in units of the tolerance.

use super::Settings;
use super::lanes::{Lanes, WIDTH, groups, padded_copy};

/// What an error is measured by.
#[derive(Debug, Clone)]
pub struct ErrorScale {
    /// Absolute tolerances, padded with ones.
    pub(super) absolute: Vec<f64>,
    pub(super) relative: f64,
    /// Components without the padding.
    pub(super) dimension: usize,
}

impl ErrorScale {
    /// The tolerances of a run of so many components.
    pub(super) fn new(relative: f64, absolute: &[f64]) -> Self {
        Self { absolute: padded_copy(absolute, 1.0), relative, dimension: absolute.len() }
    }

    /// The tolerances that the settings state.
    pub(super) fn from_settings(settings: &Settings, dimension: usize) -> Self {
        let absolute: Vec<f64> =
            (0..dimension).map(|component| settings.absolute_tolerance.of(component)).collect();
        Self::new(settings.relative_tolerance, &absolute)
    }

    /// `absolute + relative max(|a|, |b|)` for one group.
    #[inline(always)]
    pub(super) fn of(&self, absolute: &Lanes, a: &Lanes, b: &Lanes) -> Lanes {
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
}
