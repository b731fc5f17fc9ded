//! Responses along a number of the line at a fixed excitation speed.

use std::rc::Rc;

use halfshaft_model::question::{ParameterRange, Question, ResonanceQuestion};
use halfshaft_model::{ChangeError, Driveline};
use halfshaft_numerics::observer::Observer;
use halfshaft_results::ResonanceResult;

use super::answer::{Setting, assemble, trace_settings};
use super::branches::{Collected, Job};
use super::line::{Line, nonlinear};
use super::lines::Lines;
use super::measured::{Along, Measured};
use super::messages::messages;
use super::problem::Axis;
use super::seeds::over_drive;
use super::system::Place;
use super::tracer::Counted;
use crate::error::AnalysisError;
use crate::header::header;

/// The range of a parameter less an end at which nothing excites the line.
fn excited(lines: &Lines<'_>, range: &ParameterRange) -> (f64, f64) {
    let silent = |value: f64| {
        lines.at(value).is_some_and(|equations| equations.excitation.orders().is_empty())
    };
    let inset = |end: f64, other: f64| if silent(end) { end + INSET * (other - end) } else { end };
    (inset(range.from, range.to), inset(range.to, range.from))
}

/// Part of a range by which an end is left out at which nothing excites the line.
const INSET: f64 = 1e-6;
/// Values of the parameter at which responses are looked for.
const SLICES: u32 = 7;

/// All branches over a number of the line.
pub(super) struct OverParameter<'q> {
    lines: Lines<'q>,
    /// Which twists are nonlinear somewhere in the range.
    flags: Vec<bool>,
    pub(super) setting: Setting,
    pub(super) collected: Collected,
}

impl OverParameter<'_> {
    /// The line at a value, as harmonics see it.
    pub(super) fn member(&self, value: f64) -> Option<Line> {
        self.lines.at(value).map(|equations| Line::flagged(equations, &self.flags))
    }
}

/// Answers `resonance` with a parameter in place of the speed.
pub(super) fn solve(
    line: &Driveline,
    question: &ResonanceQuestion,
    range: &ParameterRange,
    own: &Setting,
    observer: &dyn Observer,
) -> Result<ResonanceResult, AnalysisError> {
    let frequency = own.range.0;
    let over = over_parameter(line, question, range, own, observer)?;
    let header = header(line, &Question::Resonance(question.clone()));
    let member = |value: f64| over.member(value);
    let unit = over.lines.parameter.unit();
    let along = Along { address: &range.address, unit, frequency, family: &member };
    let mut measured = Measured::new(&over.setting, Some(along));
    let mut result = assemble(&over.setting, &over.collected, &mut measured, header);
    messages(&over.setting, question, &over.collected, &mut result);
    result.header.assumptions.push(format!("at a fixed excitation speed of {frequency:.6} rad/s"));
    Ok(result)
}

/// Follows all responses over a number of the line.
pub(super) fn over_parameter<'q>(
    line: &'q Driveline,
    question: &ResonanceQuestion,
    range: &ParameterRange,
    own: &Setting,
    observer: &dyn Observer,
) -> Result<OverParameter<'q>, AnalysisError> {
    let parameter = line.parameter(&range.address).map_err(ChangeError::Address)?;
    let lines = Lines::new(line, parameter);
    let frequency = own.range.0;
    let slice =
        |k: u32| range.from + (range.to - range.from) * f64::from(k) / f64::from(SLICES - 1);
    let order = [0, SLICES - 1].into_iter().chain(1..SLICES - 1);
    let mut members = Vec::new();
    let mut odd = own.odd;
    let mut flags = nonlinear(&own.line.equations);
    for value in order.map(slice) {
        let Some(equations) = lines.at(value) else { continue };
        for (flag, other) in flags.iter_mut().zip(nonlinear(&equations)) {
            *flag |= other;
        }
        let member = match Setting::new(equations, Some((frequency, frequency)), question.mode) {
            // Without torques there is nothing to find, but beside it there may be.
            Err(AnalysisError::NoExcitation { .. }) => continue,
            member => member?,
        };
        odd &= member.odd;
        members.push((value, member));
    }
    let mut counted = Counted::default();
    let mut seeds = Vec::new();
    for (value, member) in &members {
        let flagged = Line::flagged(Rc::clone(&member.line.equations), &flags);
        let highest = member.excited();
        let found = over_drive(
            &flagged,
            &member.rest,
            own.base,
            odd,
            highest,
            frequency,
            observer,
            &mut counted,
        );
        let origin = format!("response at {} = {value}", range.address);
        seeds.extend(found.into_iter().map(|seed| (seed, *value, origin.clone())));
    }
    let family = |value: f64| lines.at(value);
    let setting = Setting {
        line: Line::flagged(Rc::clone(&own.line.equations), &flags),
        rest: own.rest.clone(),
        base: own.base,
        odd,
        range: excited(&lines, range),
    };
    let job = Job {
        line: &setting.line,
        axis: Axis::Parameter(&family),
        place: Place { frequency, drive: 1.0 },
        base: own.base,
        settings: trace_settings(&setting, question),
        observer,
        doublings: true,
        stability: question.stability,
        judged: true,
    };
    let mut collected = job.collect(&seeds);
    collected.counted.add(counted);
    Ok(OverParameter { lines, flags, setting, collected })
}
