//! The curve of folds in two parameters: a minimally augmented system and Newton's method on it.
//!
//! A fold is a response `R(u, Ω, λ) = 0` whose Jacobian `J = R_u` is singular. With fixed borders `b`,
//! `c` the number `g` of
//!
//! ```text
//! [ J  b ] [v]   [0]          [ Jᵀ c ] [w]   [0]
//! [ cᵀ 0 ] [g] = [1]          [ bᵀ 0 ] [g] = [1]
//! ```
//!
//! vanishes exactly there, and `g_x = -wᵀ J_x v` for any argument `x`. `R = 0, g = 0` with one more
//! condition along the curve is regular through cusps and turning points. Source: W. Govaerts,
//! *Numerical Methods for Bifurcations of Dynamical Equilibria* (2000), sections 4.1 and 4.3. `g_u` is
//! taken by a central difference along `v`, exact up to rounding for cubic laws.

use halfshaft_numerics::blocks::{BlockSystem, Factors};
use halfshaft_numerics::harmonics::HarmonicSet;

use super::problem::{Axis, Failure, Problem};
use super::tracer::length;

/// A fold with what continuation needs of it.
#[derive(Clone, Debug)]
pub(super) struct FoldSample {
    pub(super) set: HarmonicSet,
    pub(super) u: Vec<f64>,
    pub(super) frequency: f64,
    pub(super) parameter: f64,
    /// Unit direction along the curve: unknowns, frequency, parameter.
    pub(super) tangent: (Vec<f64>, f64, f64),
    /// Null vector of the Jacobian, and of its transpose.
    pub(super) v: Vec<f64>,
    pub(super) w: Vec<f64>,
    /// `wᵀ R_uu v v`: zero at a cusp.
    pub(super) bend: f64,
    /// `wᵀ R_Ω`.
    pub(super) push: f64,
    pub(super) truncation: f64,
    /// Lengths by which unknowns, frequency and parameter are measured.
    pub(super) spans: [f64; 3],
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

impl FoldSample {
    /// 1 where the two responses that meet exist at higher speeds, -1 at lower ones.
    pub(super) fn opens(&self) -> f64 {
        if -self.push * self.bend > 0.0 { 1.0 } else { -1.0 }
    }
}

/// The augmented system of a line over speed and a second parameter.
pub(super) struct FoldSystem<'f> {
    pub(super) problem: Problem<'f>,
    bordered: BlockSystem,
    factors: Option<Factors>,
    augmented: BlockSystem,
    augmented_factors: Option<Factors>,
    by_frequency: Vec<f64>,
    by_parameter: Vec<f64>,
    v: Vec<f64>,
    w: Vec<f64>,
    /// Derivatives of `g`.
    g: f64,
    g_u: Vec<f64>,
    g_frequency: f64,
    g_parameter: f64,
    residual: Vec<f64>,
    truncation: f64,
    /// Whether the derivatives are those of the sample made last.
    kept: bool,
}

/// Newton iterations at most.
const MOST_ITERATIONS: usize = 12;
/// A correction below this has left an error of its square (or, with difference quotients, of a small
/// part of itself).
const CONVERGED: f64 = 1e-9;
/// Error that is left by the last step, judged by the rate of those before.
const LEFT: f64 = 1e-12;
/// Steps that shorten no faster than this ask for derivatives anew.
const SLOW: f64 = 0.05;
/// Relative step of difference quotients.
const STEP: f64 = 1e-5;

impl<'f> FoldSystem<'f> {
    /// The folds of a problem whose axis is the second parameter.
    pub(super) fn new(problem: Problem<'f>) -> Self {
        let unknowns = problem.system.unknowns();
        Self {
            bordered: problem.system.blocks(1),
            augmented: problem.system.blocks(2),
            factors: None,
            augmented_factors: None,
            by_frequency: vec![0.0; unknowns],
            by_parameter: vec![0.0; unknowns],
            v: vec![0.0; unknowns],
            w: vec![0.0; unknowns],
            g: 0.0,
            g_u: vec![0.0; unknowns],
            g_frequency: 0.0,
            g_parameter: 0.0,
            residual: vec![0.0; unknowns],
            truncation: 0.0,
            kept: false,
            problem,
        }
    }

    fn evaluate_at(&mut self, u: &[f64], frequency: f64, parameter: f64) -> Result<(), Failure> {
        self.problem.place.frequency = frequency;
        self.problem.line_at(parameter)?;
        let place = self.problem.place_at(parameter);
        self.problem.system.evaluate(u, place, true);
        Ok(())
    }

    /// Everything at a point, with borders `b`, `c`.
    fn evaluate(
        &mut self,
        (u, frequency, parameter): (&[f64], f64, f64),
        borders: (&[f64], &[f64]),
    ) -> Result<(), Failure> {
        self.evaluate_values((u, frequency, parameter), borders)?;
        self.by_frequency.copy_from_slice(&self.problem.system.by_frequency);
        self.problem.system.fill(&mut self.augmented);
        self.along_null_vector(u, parameter);
        self.along_parameter(u, parameter)
    }

    /// Residual and `g` alone at a point.
    fn evaluate_values(
        &mut self,
        (u, frequency, parameter): (&[f64], f64, f64),
        borders: (&[f64], &[f64]),
    ) -> Result<(), Failure> {
        self.evaluate_at(u, frequency, parameter)?;
        self.bordered_solutions(borders)
    }

    /// `g` with its vectors from the Jacobian at the response last evaluated.
    fn bordered_solutions(&mut self, (b, c): (&[f64], &[f64])) -> Result<(), Failure> {
        self.residual.copy_from_slice(&self.problem.system.residual);
        self.truncation = self.problem.system.truncation;
        self.problem.system.fill(&mut self.bordered);
        self.bordered.set_column(0, b);
        self.bordered.set_row(0, c);
        self.bordered.set_corner(0, 0, 0.0);
        self.bordered.factorise(&mut self.factors).map_err(|_| Failure::Singular)?;
        let Some(factors) = &mut self.factors else { return Err(Failure::Singular) };
        self.v.fill(0.0);
        let mut one = [1.0];
        factors.solve(&mut self.v, &mut one);
        self.g = one[0];
        self.w.fill(0.0);
        let mut one = [1.0];
        factors.solve_transposed(&mut self.w, &mut one);
        Ok(())
    }

    /// Derivatives of `g` by the unknowns and by the speed: the Jacobian and the residual's slope by the
    /// speed on both sides of the response along its null vector.
    fn along_null_vector(&mut self, u: &[f64], parameter: f64) {
        let scale = length(u).max(f64::MIN_POSITIVE.sqrt()) / length(&self.v);
        let step = 1e-3 * scale;
        self.g_u.fill(0.0);
        self.g_frequency = 0.0;
        let place = self.problem.place_at(parameter);
        let mut image = vec![0.0; u.len()];
        for sign in [1.0, -1.0] {
            let moved: Vec<f64> = u.iter().zip(&self.v).map(|(u, v)| u + sign * step * v).collect();
            let system = &mut self.problem.system;
            system.evaluate(&moved, place, true);
            system.fill(&mut self.bordered);
            image.fill(0.0);
            self.bordered.add_transposed_product(&self.w, &mut image);
            let factor = -sign / (2.0 * step);
            self.g_u.iter_mut().zip(&image).for_each(|(g, x)| *g += factor * x);
            self.g_frequency += factor * dot(&self.w, &system.by_frequency);
        }
    }

    /// Derivatives of the residual and of `g` by the second parameter: lines on both sides of it.
    fn along_parameter(&mut self, u: &[f64], parameter: f64) -> Result<(), Failure> {
        let Axis::Parameter(_) = self.problem.axis else {
            self.by_parameter.copy_from_slice(self.problem.by_parameter());
            self.g_parameter = 0.0;
            return Ok(());
        };
        let step = STEP * parameter.abs().max(1e-3);
        let place = self.problem.place_at(parameter);
        self.by_parameter.fill(0.0);
        self.g_parameter = 0.0;
        for sign in [1.0, -1.0] {
            self.problem.line_at(parameter + sign * step)?;
            let system = &mut self.problem.system;
            system.evaluate(u, place, true);
            let factor = sign / (2.0 * step);
            for (slope, residual) in self.by_parameter.iter_mut().zip(&system.residual) {
                *slope += factor * residual;
            }
            system.fill(&mut self.bordered);
            let mut image = vec![0.0; u.len()];
            self.bordered.add_product(&self.v, &mut image);
            self.g_parameter -= factor * dot(&self.w, &image);
        }
        self.problem.line_at(parameter)
    }

    /// Newton's method under the linear condition `row · (u, Ω, λ) = target`, lengths by `spans`. The
    /// derivatives are made anew only where those of the first step no longer lead on.
    pub(super) fn correct(
        &mut self,
        point: &mut (Vec<f64>, f64, f64),
        borders: (&[f64], &[f64]),
        (row, row_frequency, row_parameter): (&[f64], f64, f64),
        target: f64,
        spans: [f64; 3],
    ) -> Result<usize, Failure> {
        let (mut before, mut rate) = (f64::INFINITY, f64::INFINITY);
        // Those of the fold before may still do.
        if self.kept && self.factorise_augmented((row, row_frequency, row_parameter)).is_ok() {
            rate = 0.0;
        }
        self.kept = false;
        for iteration in 1..=MOST_ITERATIONS {
            let here = (&point.0[..], point.1, point.2);
            let fresh = rate > SLOW;
            if fresh {
                self.evaluate(here, borders)?;
                self.factorise_augmented((row, row_frequency, row_parameter))?;
                rate = 0.0;
            } else {
                self.evaluate_values(here, borders)?;
            }
            let mut step: Vec<f64> = self.residual.iter().map(|r| -r).collect();
            let held: f64 = row.iter().zip(&point.0).map(|(a, b)| a * b).sum::<f64>()
                + row_frequency * point.1
                + row_parameter * point.2;
            let mut border = [-self.g, target - held];
            self.solve_augmented(&mut step, &mut border);
            let size = ((length(&step) / spans[0]).powi(2)
                + (border[0] / spans[1]).powi(2)
                + (border[1] / spans[2]).powi(2))
            .sqrt();
            if !fresh && size > 0.7 * before && size.is_finite() {
                // The kept derivatives lead no further.
                rate = f64::INFINITY;
                continue;
            }
            if !size.is_finite() || (iteration > 3 && size > 0.7 * before) {
                return if before < 1e3 * CONVERGED {
                    Ok(iteration)
                } else {
                    Err(Failure::NotConverged)
                };
            }
            point.0.iter_mut().zip(&step).for_each(|(u, s)| *u += s);
            point.1 += border[0];
            point.2 += border[1];
            if before.is_finite() {
                rate = rate.max(size / before);
            }
            if size <= CONVERGED && size * rate <= LEFT {
                return Ok(iteration);
            }
            before = size;
        }
        Err(Failure::NotConverged)
    }

    fn factorise_augmented(&mut self, (row, f, p): (&[f64], f64, f64)) -> Result<(), Failure> {
        // The matrix holds the Jacobian at the point, from `derivatives`.
        self.augmented.set_column(0, &self.by_frequency);
        self.augmented.set_column(1, &self.by_parameter);
        self.augmented.set_row(0, &self.g_u);
        self.augmented.set_row(1, row);
        self.augmented.set_corner(0, 0, self.g_frequency);
        self.augmented.set_corner(0, 1, self.g_parameter);
        self.augmented.set_corner(1, 0, f);
        self.augmented.set_corner(1, 1, p);
        self.augmented.factorise(&mut self.augmented_factors).map_err(|_| Failure::Singular)
    }

    fn solve_augmented(&mut self, u: &mut [f64], border: &mut [f64; 2]) {
        if let Some(factors) = &mut self.augmented_factors {
            factors.solve(u, border);
        }
    }

    /// The sample at a converged point, with its direction along `row`.
    pub(super) fn sample(
        &mut self,
        (u, frequency, parameter): (Vec<f64>, f64, f64),
        borders: (&[f64], &[f64]),
        row: (&[f64], f64, f64),
        spans: [f64; 3],
    ) -> Result<FoldSample, Failure> {
        self.evaluate((&u, frequency, parameter), borders)?;
        self.factorise_augmented(row)?;
        let mut direction = vec![0.0; u.len()];
        let mut border = [0.0, 1.0];
        self.solve_augmented(&mut direction, &mut border);
        let size = ((length(&direction) / spans[0]).powi(2)
            + (border[0] / spans[1]).powi(2)
            + (border[1] / spans[2]).powi(2))
        .sqrt();
        direction.iter_mut().for_each(|x| *x /= size);
        self.kept = true;
        Ok(FoldSample {
            set: self.problem.system.set.clone(),
            tangent: (direction, border[0] / size, border[1] / size),
            bend: -dot(&self.g_u, &self.v),
            push: dot(&self.w, &self.by_frequency),
            v: self.v.clone(),
            w: self.w.clone(),
            truncation: self.truncation,
            u,
            frequency,
            parameter,
            spans,
        })
    }

    /// Borders for a first fold: approximate null vectors by inverse iteration.
    pub(super) fn first_borders(
        &mut self,
        u: &[f64],
        frequency: f64,
        parameter: f64,
    ) -> Result<(Vec<f64>, Vec<f64>), Failure> {
        let n = u.len();
        let start: Vec<f64> = (0..n).map(|k| 1.0 + 0.3 * (k as f64 * 1.7).sin()).collect();
        let size = length(&start);
        let mut b: Vec<f64> = start.iter().map(|x| x / size).collect();
        let mut c = b.clone();
        for _ in 0..4 {
            self.evaluate_values((u, frequency, parameter), (&b, &c))?;
            let normal = |x: &[f64]| {
                let size = length(x);
                x.iter().map(|x| x / size).collect::<Vec<f64>>()
            };
            (b, c) = (normal(&self.w), normal(&self.v));
        }
        Ok((b, c))
    }

    /// Determinant of the Hessian of the fold equation over the response's own direction and the
    /// speed: positive where a detached response is born (or vanishes), negative where two join.
    pub(super) fn hessian(&mut self, sample: &FoldSample) -> Result<f64, Failure> {
        let (u, frequency, parameter) = (&sample.u, sample.frequency, sample.parameter);
        let unit = |x: &[f64]| {
            let size = length(x);
            x.iter().map(|x| x / size).collect::<Vec<f64>>()
        };
        let (b, c) = (unit(&sample.w), unit(&sample.v));
        self.evaluate((u, frequency, parameter), (&b, &c))?;
        // The response's change with the speed, beside the null direction.
        let mut y: Vec<f64> = self.by_frequency.iter().map(|r| -r).collect();
        let mut border = [0.0];
        // The bordered factors of `evaluate` still hold the Jacobian at the point.
        if let Some(factors) = &mut self.factors {
            factors.solve(&mut y, &mut border);
        }
        let w = self.w.clone();
        let v = self.v.clone();
        let size = length(u);
        let (along, over) =
            (1e-3 * size / length(&v), 1e-3 * size / length(&y).max(size / frequency));
        let mut phi = |s: f64, t: f64| -> Result<f64, Failure> {
            let moved: Vec<f64> = u
                .iter()
                .zip(&v)
                .zip(&y)
                .map(|((u, v), y)| u + s * along * v + t * over * y)
                .collect();
            self.evaluate_at(&moved, frequency + t * over, parameter)?;
            Ok(self.problem.system.residual.iter().zip(&w).map(|(r, w)| r * w).sum())
        };
        let centre = phi(0.0, 0.0)?;
        let ss = phi(1.0, 0.0)? - 2.0 * centre + phi(-1.0, 0.0)?;
        let tt = phi(0.0, 1.0)? - 2.0 * centre + phi(0.0, -1.0)?;
        let st = 0.25 * (phi(1.0, 1.0)? - phi(1.0, -1.0)? - phi(-1.0, 1.0)? + phi(-1.0, -1.0)?);
        Ok(ss * tt - st * st)
    }
}
