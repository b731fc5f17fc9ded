//! One line at all values of a parameter.

use std::cell::RefCell;
use std::rc::Rc;

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_model::question::FoldsQuestion;
use halfshaft_model::{ChangeError, Driveline, Parameter};

use super::problem::{METHOD, Problem, Residual, nonlinear_shaft};
use super::setting::{self, Resonance};
use super::shaft_law::Balanced;
use crate::error::AnalysisError;

/// A line with a parameter.
pub(super) struct Family<'l> {
    line: &'l Driveline,
    parameter: Parameter,
    pub(super) order: f64,
    shaft: usize,
    /// The resonance at the model's own values, where no range of speeds is given.
    pub(super) resonance: Option<Resonance>,
    /// Length of the range of the parameter.
    pub(super) width: f64,
    /// The last members that were made, by their value.
    made: RefCell<Vec<(f64, Option<Rc<Problem>>)>>,
}

/// A place in the space of frequency, logarithm of the amplitude and parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Spot {
    pub(super) nu: f64,
    pub(super) u: f64,
    pub(super) parameter: f64,
    /// Mean twist of the shaft, rad.
    pub(super) mean: f64,
}

/// Members that are kept.
const KEPT: usize = 4;
/// Part of the range of the parameter over which derivatives are taken.
const DIFFERENCE: f64 = 1e-5;

impl<'l> Family<'l> {
    /// The family that a question asks about.
    pub(super) fn new(
        line: &'l Driveline,
        question: &FoldsQuestion,
    ) -> Result<Self, AnalysisError> {
        let address = question.parameter.address.as_str();
        let parameter = match line.parameter(address) {
            Ok(parameter) => parameter,
            Err(_) if address.starts_with("mode.") => {
                return Err(AnalysisError::MethodDoesNotFit {
                    method: METHOD,
                    reason: format!(
                        "\"{address}\" is a number of the averaged mode, not of the line"
                    ),
                });
            }
            Err(error) => return Err(ChangeError::Address(error).into()),
        };
        let (from, to) = (question.parameter.from, question.parameter.to);
        let equations = EquationsOfMotion::new(line)?;
        // The shaft that is nonlinear anywhere in the range: a coefficient may pass through zero.
        let inside = line.with(&parameter, from + 0.618 * (to - from))?;
        let shaft = nonlinear_shaft(&EquationsOfMotion::new(&inside)?)?;
        let resonance = match question.frequency {
            Some(_) => None,
            None => Some(setting::resonance(&equations, shaft, question.mode)?),
        };
        let order = match (question.order, order_of(line, &parameter)) {
            (Some(order), _) => setting::order(&equations, Some(order), None)?,
            // The amplitude of a torque bends the response of its own order.
            (None, Some(order)) => order,
            (None, None) => {
                let middle = question.frequency.map(|(from, to)| f64::midpoint(from, to));
                let nu = resonance.as_ref().map_or(middle, |found| Some(found.omega));
                setting::order(&equations, None, nu)?
            }
        };
        let made = RefCell::default();
        Ok(Self { line, parameter, order, shaft, resonance, width: to - from, made })
    }

    /// The member at a value; `None` where the line cannot be had.
    pub(super) fn at(&self, value: f64) -> Option<Rc<Problem>> {
        if let Some((_, member)) = self.made.borrow().iter().find(|(known, _)| *known == value) {
            return member.clone();
        }
        let member = self.make(value).map(Rc::new);
        let mut made = self.made.borrow_mut();
        if made.len() >= KEPT {
            made.remove(0);
        }
        made.push((value, member.clone()));
        member
    }

    fn make(&self, value: f64) -> Option<Problem> {
        let line = self.line.with(&self.parameter, value).ok()?;
        let equations = EquationsOfMotion::new(&line).ok()?;
        Some(Problem::of_shaft(equations, self.shaft, self.order))
    }

    /// Symbol of the unit of the parameter.
    pub(super) fn unit(&self) -> &'static str {
        self.parameter.unit()
    }

    /// The parameter's value in the model.
    pub(super) fn own_value(&self) -> Option<f64> {
        self.parameter.value(self.line)
    }

    /// The residual at a spot, with the shaft's harmonic there.
    pub(super) fn residual(&self, spot: &Spot) -> Option<(Residual, Balanced)> {
        let problem = self.at(spot.parameter)?;
        let point = problem.jet(spot.nu)?;
        let a = spot.u.exp();
        let at = problem.law.balanced_with_bend(a, spot.mean)?;
        let residual = problem.residual(&point, a, &at);
        residual.value.is_finite().then_some((residual, at))
    }

    /// Derivatives of `g` and `∂g/∂u` by the parameter at a spot, by differences.
    pub(super) fn by_parameter(&self, spot: &Spot) -> Option<[f64; 2]> {
        let step = DIFFERENCE * self.width;
        let at = |parameter: f64| self.residual(&Spot { parameter, ..*spot });
        let (mut low, mut high) = (spot.parameter - step, spot.parameter + step);
        // At the end of what is allowed on one side only.
        let below = at(low).or_else(|| {
            low = spot.parameter;
            at(low)
        })?;
        let above = at(high).or_else(|| {
            high = spot.parameter;
            at(high)
        })?;
        let slope = |a: f64, b: f64| (b - a) / (high - low);
        let slopes = [slope(below.0.value, above.0.value), slope(below.0.by_u, above.0.by_u)];
        slopes.iter().all(|s| s.is_finite()).then_some(slopes)
    }
}

/// The order that an amplitude, a phase of a torque belongs to.
fn order_of(line: &Driveline, parameter: &Parameter) -> Option<f64> {
    if !parameter.address.ends_with("amplitude") {
        return None;
    }
    // What the parameter changes shows which harmonic it is.
    let value = parameter.value(line)?;
    let changed = line.with(parameter, if value == 0.0 { 1.0 } else { 2.0 * value }).ok()?;
    let pairs = line.torques().iter().zip(changed.torques());
    pairs
        .flat_map(|(a, b)| a.harmonics.iter().zip(&b.harmonics))
        .find(|(a, b)| a.amplitude_nm != b.amplitude_nm)
        .map(|(a, _)| a.order)
}
