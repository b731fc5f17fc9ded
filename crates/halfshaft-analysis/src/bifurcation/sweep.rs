//! Value after value, each motion going on from where the one before it ended.

use std::rc::Rc;

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_model::question::{BifurcationQuestion, SweepDirection};
use halfshaft_model::{ChangeError, Driveline, Parameter};
use halfshaft_numerics::dense::eigenvalues;
use halfshaft_numerics::observer::Observer;

use super::stroboscope::{Ended, Look, Stroboscope};
use super::visit::{Limits, Visit, visit};
use crate::error::AnalysisError;

/// The lines of a sweep.
pub(super) struct Family<'q> {
    pub(super) line: &'q Driveline,
    pub(super) equations: Rc<EquationsOfMotion>,
    /// What is swept in place of the excitation speed.
    pub(super) parameter: Option<Parameter>,
    /// Range of the excitation speed, rad/s.
    pub(super) speeds: (f64, f64),
    pub(super) look: Look,
}

/// The motion at one value.
pub(super) struct Row {
    pub(super) value: f64,
    /// 1 up, -1 down.
    pub(super) direction: f64,
    pub(super) seen: Result<Visit, Ended>,
    /// Twist and rate of twist of the shaft at the states that are recorded.
    pub(super) points: Vec<[f64; 2]>,
    /// Number of the branch that a motion which repeats is on.
    pub(super) branch: Option<usize>,
}

impl<'q> Family<'q> {
    /// The family of a line over what a question sweeps.
    pub(super) fn new(
        line: &'q Driveline,
        equations: Rc<EquationsOfMotion>,
        question: &BifurcationQuestion,
        speeds: (f64, f64),
        look: Look,
    ) -> Result<Self, AnalysisError> {
        let address = question.parameter.as_ref().map(|range| line.parameter(&range.address));
        let parameter = address.transpose().map_err(ChangeError::Address)?;
        Ok(Self { line, equations, parameter, speeds, look })
    }

    /// The equations and the excitation speed at a value.
    pub(super) fn at(&self, value: f64) -> Result<(Rc<EquationsOfMotion>, f64), AnalysisError> {
        let Some(parameter) = &self.parameter else {
            return Ok((Rc::clone(&self.equations), value));
        };
        let line = self.line.with(parameter, value)?;
        Ok((Rc::new(EquationsOfMotion::new(&line)?), self.speeds.0))
    }
}

/// The values in the order of the sweep, each with its direction.
pub(super) fn values(question: &BifurcationQuestion, speeds: (f64, f64)) -> Vec<(f64, f64)> {
    let (from, to) = question.parameter.as_ref().map_or(speeds, |range| (range.from, range.to));
    let last = question.steps.max(2) - 1;
    let at = |k: usize| if k == last { to } else { from + (to - from) * k as f64 / last as f64 };
    let up = (0..=last).map(|k| (at(k), 1.0));
    let down = (0..=last).rev().map(|k| (at(k), -1.0));
    match question.direction {
        SweepDirection::Up => up.collect(),
        SweepDirection::Down => down.collect(),
        SweepDirection::Both => up.chain(down).collect(),
    }
}

/// Goes through all values, or until it is stopped.
pub(super) fn sweep(
    family: &Family<'_>,
    question: &BifurcationQuestion,
    observer: &dyn Observer,
) -> Result<Vec<Row>, AnalysisError> {
    let mut limits =
        Limits { transient: 0, points: question.points, tolerance: question.tolerance };
    let values = values(question, family.speeds);
    let mut rows: Vec<Row> = Vec::with_capacity(values.len());
    let mut state: Option<Vec<f64>> = None;
    for (index, (value, direction)) in values.iter().enumerate() {
        observer.progress(index as f64 / values.len() as f64);
        let (equations, frequency) = family.at(*value)?;
        let mut strobe = Stroboscope::new(&equations, family.look, frequency);
        limits.transient = question.transient.unwrap_or_else(|| settling_periods(&mut strobe));
        let start = started(state.take(), &strobe.rest);
        let seen = visit(&mut strobe, &start, limits, observer);
        if matches!(seen, Err(Ended::Cancelled)) {
            break;
        }
        let states = seen.as_ref().map_or(&[][..], |visit| visit.states.as_slice());
        let points = states.iter().map(|state| strobe.point(state)).collect();
        state = seen.as_ref().ok().map(|visit| visit.end.clone());
        rows.push(Row { value: *value, direction: *direction, seen, points, branch: None });
    }
    Ok(rows)
}

/// Part of a deviation that is left after the time for settling, where nobody says how long that is.
const LEFT: f64 = 1e-6;
/// Fewest and most periods for settling then.
const SETTLING: (f64, f64) = (200.0, 20_000.0);

/// Periods after which a small motion about rest has died out but for a part.
fn settling_periods(strobe: &mut Stroboscope<'_>) -> usize {
    let rest = strobe.rest.clone();
    let matrix = strobe.varied(&rest, &mut (0.0, 0.0)).map(|(_, matrix)| matrix);
    let multipliers = matrix.ok().and_then(|matrix| eigenvalues(&matrix).ok()).unwrap_or_default();
    let largest = multipliers.iter().map(|m| m.modulus()).fold(0.0, f64::max);
    let periods = LEFT.ln() / largest.ln();
    let periods = if periods.is_finite() && periods > 0.0 { periods } else { SETTLING.0 };
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
    let count = periods.clamp(SETTLING.0, SETTLING.1).ceil() as usize;
    count
}

/// The state to start from: that of the value before, or rest. Whether the speed of the whole belongs to
/// the state depends on dampers, which may come and go along a sweep.
fn started(before: Option<Vec<f64>>, rest: &[f64]) -> Vec<f64> {
    let mut start = before.unwrap_or_else(|| rest.to_vec());
    start.resize(rest.len(), 0.0);
    start
}
