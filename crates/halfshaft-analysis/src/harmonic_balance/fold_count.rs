//! How many responses coexist at each point of the plane of fold curves.
//!
//! The number follows from the curves: every fold on the way from low speed opens or closes two
//! responses, and how many there are at the lowest speed is counted at a few values of the parameter.

use halfshaft_numerics::observer::Observer;
use halfshaft_results::ResponseCount;

use super::answer::Setting;
use super::fold_answer::{Plane, Shape};
use super::fold_trace::FoldCurve;
use super::seeds::over_drive;
use super::tracer::{Counted, LEAST_HARMONICS};

/// Values at which responses at the lowest speed are counted.
const COUNTED: usize = 7;
/// Rows and columns of the count of responses.
const GRID: usize = 121;
/// Part of the speeds next to the lowest whose folds tell how many harmonics responses have there.
const BESIDE: f64 = 0.1;
/// Harmonics with which these responses are counted at most.
const MOST_COUNTED: usize = 32;

impl Plane<'_, '_> {
    /// Responses over a grid of the plane: those at the lowest speed, and two more or less at each
    /// fold from there.
    pub(super) fn count(
        &self,
        shape: &Shape,
        curves: &[FoldCurve],
        observer: &dyn Observer,
    ) -> Option<ResponseCount> {
        let (low, high) = self.window;
        let (from, to) = (self.question.parameter.from, self.question.parameter.to);
        let share = |k: usize| k as f64 / (GRID - 1) as f64;
        let frequency: Vec<f64> = (0..GRID).map(|k| low + (high - low) * share(k)).collect();
        // Half a step inside, so that a curve's ends on the border do not decide.
        let parameter: Vec<f64> =
            (0..GRID).map(|k| from + (to - from) * (0.5 + k as f64) / GRID as f64).collect();
        let first = self.responses_at_low_speed(shape, curves, &parameter, observer);
        let mut count = Vec::with_capacity(GRID);
        for (value, first) in parameter.iter().zip(first) {
            let mut folds: Vec<(f64, f64)> = Vec::new();
            for pair in curves.iter().flat_map(|curve| curve.samples.windows(2)) {
                let (a, b) = (&pair[0], &pair[1]);
                if (a.parameter < *value) == (b.parameter < *value) {
                    continue;
                }
                let part = (value - a.parameter) / (b.parameter - a.parameter);
                let near = if part < 0.5 { a } else { b };
                folds.push((a.frequency + part * (b.frequency - a.frequency), near.opens()));
            }
            let row = frequency.iter().map(|frequency| {
                let change: f64 = folds
                    .iter()
                    .filter(|(at, _)| at < frequency)
                    .map(|(_, opens)| 2.0 * opens)
                    .sum();
                #[expect(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "a small count"
                )]
                let total = (f64::from(first) + change).max(0.0) as u32;
                total
            });
            count.push(row.collect());
        }
        Some(ResponseCount { frequency, parameter, count })
    }

    /// Responses at the lowest speed for each value: counted at a few values by following the drive;
    /// from the nearest of them to each other value two more or less for each fold that leaves the
    /// window there.
    fn responses_at_low_speed(
        &self,
        shape: &Shape,
        curves: &[FoldCurve],
        values: &[f64],
        observer: &dyn Observer,
    ) -> Vec<u32> {
        let every = values.len().div_ceil(COUNTED);
        let highest = self.harmonics_at_low_speed(curves);
        let counted: Vec<(usize, f64)> = (0..values.len())
            .filter(|index| index % every == every / 2)
            .filter_map(|index| {
                let count = self.followed_over_drive(shape, values[index], highest, observer)?;
                Some((index, count - self.beyond_low_speed(curves, values[index])))
            })
            .collect();
        let at = |index: usize| {
            let nearest = counted.iter().min_by_key(|(known, _)| known.abs_diff(index));
            let rest = nearest.map_or(1.0, |(_, rest)| *rest);
            rest + self.beyond_low_speed(curves, values[index])
        };
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small counts")]
        (0..values.len()).map(|index| at(index).max(0.0) as u32).collect()
    }

    /// Half the harmonics of the folds near the lowest speed, enough to tell responses apart: with far
    /// fewer some are counted that are none.
    fn harmonics_at_low_speed(&self, curves: &[FoldCurve]) -> usize {
        let (low, high) = self.window;
        let samples = curves.iter().flat_map(|curve| &curve.samples);
        let beside = samples.filter(|sample| sample.frequency < low + BESIDE * (high - low));
        let most = beside.map(|sample| sample.set.highest()).max().unwrap_or(0);
        most.div_ceil(2).clamp(LEAST_HARMONICS, MOST_COUNTED)
    }

    /// Responses at the lowest speed that the curve over the drive passes.
    fn followed_over_drive(
        &self,
        shape: &Shape,
        value: f64,
        highest: usize,
        observer: &dyn Observer,
    ) -> Option<f64> {
        let equations = self.lines.at(value)?;
        let mut setting = Setting::new(equations, Some(self.window), 1).ok()?;
        setting.odd = shape.odd;
        let seeds = over_drive(
            &setting.line,
            &setting.rest,
            shape.base,
            shape.odd,
            highest,
            self.window.0.max(1e-3 * self.window.1),
            observer,
            &mut Counted::default(),
        );
        (!seeds.is_empty()).then_some(seeds.len() as f64)
    }

    /// Responses at the lowest speed for a value of the parameter that open or close at folds below
    /// it, against those where these folds are within the window.
    fn beyond_low_speed(&self, curves: &[FoldCurve], value: f64) -> f64 {
        let (low, high) = self.window;
        let mut sum = 0.0;
        for samples in curves.iter().map(|curve| &curve.samples).filter(|list| list.len() > 1) {
            let last = samples.len() - 1;
            for (end, next) in [(&samples[0], &samples[1]), (&samples[last], &samples[last - 1])] {
                let leaves = (end.frequency - low).abs() <= 1e-6 * (high - low);
                let inside = (value - end.parameter) * (next.parameter - end.parameter) > 0.0;
                if leaves && !inside {
                    sum += 2.0 * end.opens();
                }
            }
        }
        sum
    }
}
