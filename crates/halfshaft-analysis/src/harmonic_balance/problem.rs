//! One curve of responses: the equations with one free parameter, and Newton's method on them.

use std::rc::Rc;

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_numerics::blocks::{BlockSystem, Factors};
use halfshaft_numerics::harmonics::HarmonicSet;

use super::line::Line;
use super::system::{HarmonicSystem, Place};
use super::tracer::length;

/// A line for each value of a parameter; `None` where there is none.
pub(crate) type Family<'f> = dyn Fn(f64) -> Option<Rc<EquationsOfMotion>> + 'f;

/// What runs along a curve of responses.
#[derive(Clone, Copy)]
pub(super) enum Axis<'f> {
    /// The excitation speed, rad/s.
    Frequency,
    /// The factor on all harmonic torques.
    Drive,
    /// A number of the line, with the relative step of its derivative.
    Parameter(&'f Family<'f>),
}

/// The equations of a curve, ready for Newton's method.
pub(super) struct Problem<'f> {
    pub(super) system: HarmonicSystem,
    pub(super) axis: Axis<'f>,
    /// Speed and drive where they do not run.
    pub(super) place: Place,
    by_parameter: Vec<f64>,
    pub(super) matrix: BlockSystem,
    pub(super) factors: Option<Factors>,
    /// The value of the parameter for which the system's line was made.
    made_for: Option<f64>,
    /// A first correction below this is the last.
    first_enough: f64,
    /// Any correction below this is, on curves that need not be exact.
    pub(super) rough: f64,
}

/// Why a point could not be found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Failure {
    /// Newton's method did not converge.
    NotConverged,
    /// The bordered matrix is singular or something is not finite.
    Singular,
    /// The line does not exist at this value of the parameter.
    NoLine,
}

/// What Newton's method did.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Corrected {
    pub(super) iterations: usize,
    /// Size of the last correction in the metric.
    pub(super) last: f64,
    /// Size of the first correction.
    pub(super) first: f64,
}

/// A linear condition `row · u + corner · p = target`.
pub(super) struct Condition<'c> {
    pub(super) row: &'c [f64],
    pub(super) corner: f64,
    pub(super) target: f64,
}

/// Lengths by which unknowns and parameter are measured.
#[derive(Clone, Copy, Debug)]
pub(super) struct Metric {
    pub(super) size: f64,
    pub(super) span: f64,
}

impl Metric {
    pub(super) fn norm(&self, u: &[f64], p: f64) -> f64 {
        let sum: f64 = u.iter().map(|x| x * x).sum();
        (sum / (self.size * self.size) + (p / self.span).powi(2)).sqrt()
    }

    pub(super) fn dot(&self, (u, p): (&[f64], f64), (v, q): (&[f64], f64)) -> f64 {
        let sum: f64 = u.iter().zip(v).map(|(x, y)| x * y).sum();
        sum / (self.size * self.size) + p * q / (self.span * self.span)
    }
}

/// Newton iterations at most.
const MOST_ITERATIONS: usize = 8;
/// A correction below this has left an error of its square.
const CONVERGED: f64 = 1e-8;
/// On the way along a curve a first correction below this is the last: what it leaves is of the order
/// of its square.
const SMALL: f64 = 3e-7;
/// Steps with kept factors at most, and the slowest rate at which they may approach.
const MOST_NEARBY: usize = 10;
const SLOWEST: f64 = 0.2;
/// What may be left then, and a step below which rounding stalls them.
const LEFT: f64 = 1e-14;
const ROUNDING: f64 = 1e-11;
/// Relative step of difference quotients by a parameter of the line.
const PARAMETER_STEP: f64 = 1e-6;

impl<'f> Problem<'f> {
    pub(super) fn new(system: HarmonicSystem, axis: Axis<'f>, place: Place) -> Self {
        let matrix = system.blocks(1);
        let unknowns = system.unknowns();
        let by_parameter = vec![0.0; unknowns];
        Self {
            matrix,
            factors: None,
            by_parameter,
            system,
            axis,
            place,
            made_for: None,
            first_enough: CONVERGED,
            rough: 0.0,
        }
    }

    /// The same curve with other harmonics.
    pub(super) fn with_set(&self, set: HarmonicSet) -> Self {
        let system = HarmonicSystem::new(self.system.line.clone(), set, self.system.base);
        let mut problem = Self::new(system, self.axis, self.place);
        (problem.made_for, problem.rough) = (self.made_for, self.rough);
        problem
    }

    /// Speed and drive at a value of the running parameter.
    pub(super) fn place_at(&self, p: f64) -> Place {
        match self.axis {
            Axis::Frequency => Place { frequency: p, ..self.place },
            Axis::Drive => Place { drive: p, ..self.place },
            Axis::Parameter(_) => self.place,
        }
    }

    /// Makes the line of the parameter's value.
    pub(super) fn line_at(&mut self, p: f64) -> Result<(), Failure> {
        let Axis::Parameter(family) = self.axis else { return Ok(()) };
        if self.made_for == Some(p) {
            return Ok(());
        }
        let equations = family(p).ok_or(Failure::NoLine)?;
        let skeleton = Rc::clone(&self.system.line.skeleton);
        self.system.replace(Line::with_skeleton(equations, skeleton));
        self.made_for = Some(p);
        Ok(())
    }

    /// Evaluates residual, Jacobian and the derivative by the running parameter.
    pub(super) fn evaluate(&mut self, u: &[f64], p: f64) -> Result<(), Failure> {
        let place = self.place_at(p);
        if matches!(self.axis, Axis::Parameter(_)) {
            let step = PARAMETER_STEP * p.abs().max(1e-3);
            self.line_at(p + step)?;
            self.system.evaluate(u, place, false);
            self.by_parameter.copy_from_slice(&self.system.residual);
            self.line_at(p - step)?;
            self.system.evaluate(u, place, false);
            for (slope, below) in self.by_parameter.iter_mut().zip(&self.system.residual) {
                *slope = (*slope - below) / (2.0 * step);
            }
            self.line_at(p)?;
        }
        self.system.evaluate(u, place, true);
        Ok(())
    }

    /// Derivative of the residual by the running parameter at the response last evaluated.
    pub(super) fn by_parameter(&self) -> &[f64] {
        match self.axis {
            Axis::Frequency => &self.system.by_frequency,
            Axis::Drive => &self.system.by_drive,
            Axis::Parameter(_) => &self.by_parameter,
        }
    }

    /// Factorises the Jacobian bordered by the parameter's column and a row.
    pub(super) fn factorise(&mut self, row: &[f64], corner: f64) -> Result<(), Failure> {
        self.system.fill(&mut self.matrix);
        let column = match self.axis {
            Axis::Frequency => &self.system.by_frequency,
            Axis::Drive => &self.system.by_drive,
            Axis::Parameter(_) => &self.by_parameter,
        };
        self.matrix.set_column(0, column);
        self.matrix.set_row(0, row);
        self.matrix.set_corner(0, 0, corner);
        self.matrix.factorise(&mut self.factors).map_err(|_| Failure::Singular)
    }

    /// Solves with the factors; `u` and `p` hold the right-hand side.
    pub(super) fn solve(&mut self, u: &mut [f64], p: &mut f64) {
        if let Some(factors) = &mut self.factors {
            let mut border = [*p];
            factors.solve(u, &mut border);
            *p = border[0];
        }
    }

    /// Newton's step from the residual last evaluated with the factors as they are; gives the
    /// parameter's share.
    fn step(&mut self, u: &[f64], p: f64, condition: &Condition<'_>, step: &mut [f64]) -> f64 {
        step.iter_mut().zip(&self.system.residual).for_each(|(s, r)| *s = -r);
        let held: f64 = condition.row.iter().zip(u).map(|(a, b)| a * b).sum();
        let mut step_p = condition.target - held - condition.corner * p;
        self.solve(step, &mut step_p);
        step_p
    }

    /// Newton's method from `u`, `p` under a linear condition; the factors of the last iteration
    /// stay.
    pub(super) fn correct(
        &mut self,
        u: &mut [f64],
        p: &mut f64,
        condition: &Condition<'_>,
        metric: &Metric,
    ) -> Result<Corrected, Failure> {
        let mut step = vec![0.0; u.len()];
        let mut done = Corrected::default();
        let mut before = f64::INFINITY;
        for iteration in 1..=MOST_ITERATIONS {
            self.evaluate(u, *p)?;
            self.factorise(condition.row, condition.corner)?;
            let step_p = self.step(u, *p, condition, &mut step);
            // A guess of nothing has no size to measure by but that of the first step.
            let reach = if iteration == 1 { length(&step) + length(u) } else { length(u) };
            let metric = Metric { size: metric.size.max(reach), span: metric.span };
            let size = metric.norm(&step, step_p);
            if !size.is_finite() || (iteration > 2 && size > 0.7 * before) {
                // Rounding may stall the last digits.
                return if before < 1e3 * CONVERGED * CONVERGED.sqrt() {
                    Ok(done)
                } else {
                    Err(Failure::NotConverged)
                };
            }
            u.iter_mut().zip(&step).for_each(|(u, s)| *u += s);
            *p += step_p;
            done.iterations = iteration;
            done.last = size;
            if iteration == 1 {
                done.first = size;
            }
            let enough = if iteration == 1 { self.first_enough } else { CONVERGED };
            if size <= enough.max(self.rough) {
                return Ok(done);
            }
            before = size;
        }
        Err(Failure::NotConverged)
    }

    /// The response close by one whose factors are kept: steps with these alone, which approach it at a
    /// constant rate and cost a residual each.
    pub(super) fn correct_nearby(
        &mut self,
        u: &mut [f64],
        p: &mut f64,
        condition: &Condition<'_>,
        metric: &Metric,
    ) -> Result<Corrected, Failure> {
        let mut step = vec![0.0; u.len()];
        let mut before = f64::INFINITY;
        for iteration in 1..=MOST_NEARBY {
            self.line_at(*p)?;
            self.system.evaluate(u, self.place_at(*p), false);
            let step_p = self.step(u, *p, condition, &mut step);
            let size = metric.norm(&step, step_p);
            if !size.is_finite() || size > SLOWEST * before {
                let settled = before < ROUNDING;
                let done = Corrected { iterations: iteration, last: size, first: 0.0 };
                return if settled { Ok(done) } else { Err(Failure::NotConverged) };
            }
            u.iter_mut().zip(&step).for_each(|(u, s)| *u += s);
            *p += step_p;
            // What is left is smaller by the rate of the last two steps.
            let rate = if iteration == 1 { SLOWEST } else { size / before };
            if size * rate < LEFT {
                return Ok(Corrected { iterations: iteration, last: size, first: 0.0 });
            }
            before = size;
        }
        Err(Failure::NotConverged)
    }

    /// Newton's method on the way along a curve, where the guess is good and the Jacobian far from singular.
    pub(super) fn correct_next(
        &mut self,
        u: &mut [f64],
        p: &mut f64,
        condition: &Condition<'_>,
        metric: &Metric,
    ) -> Result<Corrected, Failure> {
        self.first_enough = SMALL;
        let done = self.correct(u, p, condition, metric);
        self.first_enough = CONVERGED;
        done
    }

    /// The response at a fixed value of the parameter, from a guess.
    pub(super) fn at(&mut self, u: &mut [f64], p: f64, size: f64) -> Result<Corrected, Failure> {
        let row = vec![0.0; u.len()];
        let condition = Condition { row: &row, corner: 1.0, target: p };
        let metric = Metric { size, span: p.abs().max(1.0) };
        let mut held = p;
        self.correct(u, &mut held, &condition, &metric)
    }

    /// Direction of the curve at the response last factorised, of unit length in the metric.
    pub(super) fn tangent(&mut self, metric: &Metric) -> (Vec<f64>, f64) {
        let mut direction = vec![0.0; self.system.unknowns()];
        let mut p = 1.0;
        self.solve(&mut direction, &mut p);
        let length = metric.norm(&direction, p);
        direction.iter_mut().for_each(|x| *x /= length);
        (direction, p / length)
    }
}
