//! Backbone: free motion without damping, one frequency for each amplitude.
//!
//! With all damping and the drive taken away `α_c a + β F(a) = 0` is real. Its curve starts at each
//! natural frequency of the line about rest and is followed over the amplitude. Responses peak near
//! it.

use halfshaft_numerics::Complex;
use halfshaft_results::{Column, Table};

use super::channels;
use super::drive::Drive;
use super::problem::Problem;
use super::responses::Response;
use super::shaft_law::Balanced;

/// Points on a backbone.
const POINTS: u32 = 120;
/// Newton steps for a point.
const STEPS: usize = 30;

impl Problem {
    /// The same line without damping and without drive.
    pub(super) fn free(&self) -> Self {
        let mut law = self.law.clone();
        (law.damping, law.friction, law.contact) = (0.0, None, None);
        Self {
            equations: self.equations.clone(),
            shaft: self.shaft,
            order: self.order,
            rest: self.rest.undamped(),
            drive: Drive::default(),
            law,
            forces: self.forces.clone(),
            work: std::cell::RefCell::default(),
        }
    }
}

/// The backbone that starts at a natural circular frequency `nu`, up to an amplitude, within a
/// range of circular frequencies; `None` where it has fewer than two points there.
pub(super) fn backbone(
    problem: &Problem,
    rest: f64,
    nu: f64,
    highest: f64,
    range: (f64, f64),
) -> Option<Table> {
    let free = problem.free();
    let mut points: Vec<Response> = Vec::new();
    let (mut nu, mut mean) = (nu, rest);
    for k in 0..=POINTS {
        let a = highest * f64::from(k) / f64::from(POINTS);
        // At amplitude zero the harmonic is the tangent stiffness.
        let Some(at) = free.law.balanced(a.max(1e-9 * highest), mean) else { break };
        let Some(next) = frequency(&free, nu, a.max(1e-9 * highest), &at) else { break };
        if points.len() > 1 && (next / nu - 1.0).abs() > 0.2 {
            break;
        }
        (nu, mean) = (next, at.mean);
        if nu < range.0 || nu > range.1 {
            break;
        }
        let twist = Complex::from(a);
        points.push(Response { nu, twist, at, rises: true, damped: false });
    }
    (points.len() > 1).then(|| table(&free, &points))
}

/// The frequency of an amplitude near a guess.
fn frequency(free: &Problem, guess: f64, a: f64, at: &Balanced) -> Option<f64> {
    let mut nu = guess;
    let mut last = f64::INFINITY;
    for _ in 0..STEPS {
        let point = free.jet(nu)?;
        let gain = at.force / a;
        let value = point.alpha.value.re + point.beta.value.re * gain;
        let slope = point.alpha.first.re + point.beta.first.re * gain;
        let step = (value / slope).clamp(-0.05 * nu, 0.05 * nu);
        if !step.is_finite() {
            return None;
        }
        nu -= step;
        if step.abs() <= 2.0 * f64::EPSILON * nu || (step.abs() < 1e-10 * nu && step.abs() >= last)
        {
            return Some(nu);
        }
        last = step.abs();
    }
    (last < 1e-10 * nu).then_some(nu)
}

fn table(free: &Problem, points: &[Response]) -> Table {
    let frequencies = points.iter().map(|point| point.nu / free.order).collect();
    let mut columns = vec![Column::new("frequency", "rad/s", frequencies)];
    let rows: Vec<Vec<f64>> = points.iter().map(|p| channels::harmonics(free, p)).collect();
    for (index, (name, unit)) in channels::names(free).into_iter().enumerate() {
        let values = rows.iter().map(|row| row[index]).collect();
        columns.push(Column::new(format!("{name}.harmonic1"), unit, values));
    }
    Table::new(columns)
}
