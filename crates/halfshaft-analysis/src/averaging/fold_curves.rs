//! Folds over a parameter, joined through their cusps.
//!
//! At every value `p` of the parameter the folds are the positive roots `z` of the fold polynomial
//! `h(z; p)`; between cusps they keep their order. A cusp is where two neighbouring roots
//! merge: there the least (or greatest) value of `h` between them passes through zero, and that
//! is a scalar equation in `p` solved to the last digits.

use halfshaft_numerics::bracket::{RootSettings, find_root};
use halfshaft_numerics::observer::Observer;

use super::responses::{Response, SlowFlow};
use crate::error::AnalysisError;

/// A fold at a value of the parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FoldPoint {
    pub(crate) parameter: f64,
    pub(crate) response: Response,
}

/// Folds joined to curves, and the cusps on them.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct FoldCurves {
    pub(crate) curves: Vec<Vec<FoldPoint>>,
    pub(crate) cusps: Vec<FoldPoint>,
    /// Sampled values of the parameter at which the mode could not be had.
    pub(crate) gaps: usize,
}

/// All folds at one value.
struct Slice {
    parameter: f64,
    folds: Vec<Response>,
}

/// Two neighbouring folds that merge at a cusp at one side of an interval of slices.
struct Merger {
    /// Position of the lower of the two among the folds next to the cusp.
    lower: usize,
    cusp: FoldPoint,
}

/// The slow flow at each value of a parameter, and the fold curves over a range of it.
pub(crate) struct FoldTracer<'t> {
    /// The slow flow at a value; `None` where the mode cannot be had.
    pub(crate) flow: &'t dyn Fn(f64) -> Result<Option<SlowFlow>, AnalysisError>,
    /// Detunings that will be shown, rad/s: outside them a curve needs no points.
    pub(crate) shown: (f64, f64),
    /// About how many points a curve has.
    pub(crate) points: usize,
}

/// Rounds of halving between slices.
const ROUNDS: usize = 8;

impl FoldTracer<'_> {
    /// Fold curves between two values; those up to where the user stopped.
    pub(crate) fn trace(
        &self,
        from: f64,
        to: f64,
        observer: &dyn Observer,
    ) -> Result<FoldCurves, AnalysisError> {
        let mut result = FoldCurves::default();
        let count = (self.points / 5).clamp(8, 100_000);
        let mut runs: Vec<Vec<Slice>> = vec![Vec::new()];
        #[expect(clippy::cast_precision_loss, reason = "counts are small")]
        for index in 0..count {
            if observer.cancelled() {
                break;
            }
            let share = index as f64 / (count - 1) as f64;
            observer.progress(share);
            let parameter = if index == count - 1 { to } else { from + (to - from) * share };
            match self.slice(parameter)? {
                Some(slice) => {
                    if let Some(run) = runs.last_mut() {
                        run.push(slice);
                    }
                }
                None => {
                    result.gaps += 1;
                    runs.push(Vec::new());
                }
            }
        }
        for run in runs.into_iter().filter(|run| !run.is_empty()) {
            self.join(run, &mut result)?;
        }
        Ok(result)
    }

    fn slice(&self, parameter: f64) -> Result<Option<Slice>, AnalysisError> {
        let flow = (self.flow)(parameter)?;
        Ok(flow.map(|flow| Slice { parameter, folds: flow.folds() }))
    }

    /// Joins slices of equal numbers of folds, and where the number changes looks for the cusp.
    fn join(&self, run: Vec<Slice>, result: &mut FoldCurves) -> Result<(), AnalysisError> {
        let mut start: Option<Merger> = None;
        let mut group: Vec<Slice> = Vec::new();
        for slice in run {
            let before = group.last().map(|last| (last.parameter, last.folds.len()));
            if let Some((parameter, folds)) = before
                && folds != slice.folds.len()
            {
                let ends_fewer = slice.folds.len() < folds;
                let merger = self.merger(parameter, slice.parameter, ends_fewer)?;
                let (end, next) = if ends_fewer { (merger, None) } else { (None, merger) };
                self.finish(
                    start.take().as_ref(),
                    std::mem::take(&mut group),
                    end.as_ref(),
                    result,
                )?;
                start = next;
            }
            group.push(slice);
        }
        self.finish(start.as_ref(), group, None, result)
    }

    /// The cusp between two values with different numbers of folds. `many_first` says at which
    /// side there are more.
    fn merger(&self, a: f64, b: f64, many_first: bool) -> Result<Option<Merger>, AnalysisError> {
        let (many, few) = if many_first { (a, b) } else { (b, a) };
        let Some(mut slice) = self.slice(many)? else { return Ok(None) };
        let (mut inner, mut outer) = (many, few);
        // Bisection closes in so that only the merging pair is near; then the pair is known.
        for _ in 0..6 {
            let middle = f64::midpoint(inner, outer);
            match self.slice(middle)? {
                Some(closer) if closer.folds.len() == slice.folds.len() => {
                    (inner, slice) = (middle, closer);
                }
                Some(_) => outer = middle,
                None => return Ok(None),
            }
        }
        let gap = |pair: &[Response]| pair[1].z / pair[0].z;
        let lower = slice
            .folds
            .windows(2)
            .enumerate()
            .min_by(|(_, x), (_, y)| gap(x).total_cmp(&gap(y)))
            .map(|(index, _)| index);
        let Some(lower) = lower else { return Ok(None) };
        let (z0, z1) = (slice.folds[lower].z, slice.folds[lower + 1].z);
        self.cusp(inner, outer, (z0, z1)).map(|cusp| cusp.map(|cusp| Merger { lower, cusp }))
    }

    /// Root over the parameter of the extreme value of `h` between the merging pair.
    fn cusp(
        &self,
        inner: f64,
        outer: f64,
        (z0, z1): (f64, f64),
    ) -> Result<Option<FoldPoint>, AnalysisError> {
        let middle = (z0 * z1).sqrt();
        let extreme = |parameter: f64| -> Option<(f64, f64)> {
            let flow = (self.flow)(parameter).ok()??;
            let h = flow.fold_polynomial();
            let turning = h.derivative().real_roots();
            let nearest = turning
                .into_iter()
                .map(|root| root.value)
                .filter(|z| *z > 0.0)
                .min_by(|a, b| (a / middle).ln().abs().total_cmp(&(b / middle).ln().abs()))?;
            Some((nearest, h.evaluate(nearest) / h.coefficients()[0]))
        };
        let value = |parameter: f64| extreme(parameter).map_or(f64::NAN, |(_, value)| value);
        let settings = RootSettings::default();
        let Ok(root) = find_root(value, inner, outer, settings) else { return Ok(None) };
        let (Some((z, _)), Some(flow)) = (extreme(root.value), (self.flow)(root.value)?) else {
            return Ok(None);
        };
        Ok(Some(FoldPoint { parameter: root.value, response: flow.fold_at(z) }))
    }

    /// Turns a group of slices with equal numbers of folds into curves, joined at the cusps of
    /// its two ends.
    fn finish(
        &self,
        start: Option<&Merger>,
        mut group: Vec<Slice>,
        end: Option<&Merger>,
        result: &mut FoldCurves,
    ) -> Result<(), AnalysisError> {
        if let (Some(merger), Some(first)) = (start, group.first()) {
            let mut near = self.towards(merger.cusp.parameter, first)?;
            near.append(&mut group);
            group = near;
        }
        if let (Some(merger), Some(last)) = (end, group.last()) {
            let mut near = self.towards(merger.cusp.parameter, last)?;
            near.reverse();
            group.append(&mut near);
        }
        let group = self.refined(group)?;
        let count = group.first().map_or(0, |slice| slice.folds.len());
        let mut strands: Vec<Vec<FoldPoint>> = (0..count)
            .map(|index| {
                let point = |slice: &Slice| FoldPoint {
                    parameter: slice.parameter,
                    response: slice.folds[index],
                };
                group.iter().map(point).collect()
            })
            .collect();
        let cusps = [start, end].map(|merger| merger.map(|m| (m.lower, m.cusp)));
        result.cusps.extend(cusps.iter().flatten().map(|(_, cusp)| *cusp));
        weave(&mut strands, cusps);
        result.curves.extend(strands.into_iter().filter(|strand| strand.len() > 1));
        Ok(())
    }

    /// A group with further slices where neighbouring points of a curve lie far apart in the plane
    /// that is shown.
    fn refined(&self, mut group: Vec<Slice>) -> Result<Vec<Slice>, AnalysisError> {
        let (Some(first), Some(last)) = (group.first(), group.last()) else { return Ok(group) };
        let height = (last.parameter - first.parameter).abs().max(f64::MIN_POSITIVE);
        let seen = |sigma: f64| sigma.clamp(self.shown.0, self.shown.1);
        let sigmas = group.iter().flat_map(|slice| &slice.folds).map(|fold| seen(fold.sigma));
        let (low, high) = sigmas.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), sigma| {
            (low.min(sigma), high.max(sigma))
        });
        let width = (high - low).max(f64::MIN_POSITIVE);
        #[expect(clippy::cast_precision_loss, reason = "counts are small")]
        let step = 5.0 / self.points as f64;
        let far = |a: &Slice, b: &Slice| {
            let rise = (a.parameter - b.parameter) / height;
            let pairs = a.folds.iter().zip(&b.folds);
            pairs
                .into_iter()
                .any(|(x, y)| rise.hypot((seen(x.sigma) - seen(y.sigma)) / width) > step)
        };
        for _ in 0..ROUNDS {
            let mut finer: Vec<Slice> = Vec::with_capacity(group.len());
            let before = group.len();
            for slice in group {
                if let Some(last) = finer.last().filter(|last| far(last, &slice)) {
                    let middle = f64::midpoint(last.parameter, slice.parameter);
                    let between = self.slice(middle)?;
                    finer.extend(between.filter(|new| new.folds.len() == slice.folds.len()));
                }
                finer.push(slice);
            }
            group = finer;
            if group.len() == before || group.len() > 2 * self.points {
                break;
            }
        }
        Ok(group)
    }

    /// Slices between a cusp and the nearest one, closer and closer: there the folds part as the
    /// square root of the distance.
    fn towards(&self, cusp: f64, nearest: &Slice) -> Result<Vec<Slice>, AnalysisError> {
        const STEPS: u32 = 12;
        let mut slices = Vec::new();
        for k in 1..STEPS {
            let share = f64::from(k) / f64::from(STEPS);
            let parameter = cusp + (nearest.parameter - cusp) * share * share;
            if let Some(slice) = self.slice(parameter)?
                && slice.folds.len() == nearest.folds.len()
            {
                slices.push(slice);
            }
        }
        Ok(slices)
    }
}

/// Joins the strands that merge at a cusp at the start or end into one curve through it.
fn weave(strands: &mut [Vec<FoldPoint>], [start, end]: [Option<(usize, FoldPoint)>; 2]) {
    let closes = matches!((&start, &end), (Some((a, _)), Some((b, _))) if a == b);
    if let Some((lower, cusp)) = start
        && strands.len() > lower + 1
    {
        let upper = strands[lower + 1].clone();
        let mut joined: Vec<FoldPoint> = strands[lower].iter().rev().copied().collect();
        joined.push(cusp);
        joined.extend(upper);
        strands[lower] = joined;
        strands[lower + 1].clear();
        if let (true, Some((_, other))) = (closes, end) {
            strands[lower].insert(0, other);
            strands[lower].push(other);
            return;
        }
    }
    if let Some((lower, cusp)) = end
        && strands.len() > lower + 1
        && !closes
    {
        // Strands may already be joined at the other end; the merging ends are then the last
        // points of two curves.
        let upper: Vec<FoldPoint> = strands[lower + 1].iter().rev().copied().collect();
        if strands[lower].is_empty() || upper.is_empty() {
            return;
        }
        strands[lower].push(cusp);
        strands[lower].extend(upper);
        strands[lower + 1].clear();
    }
}
