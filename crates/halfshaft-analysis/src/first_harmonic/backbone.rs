//! Backbone: free motion without damping, one frequency for each amplitude.
//!
//! With all damping and the drive taken away `α_c a + β F(a) = 0` is real. Its curve starts at each
//! natural frequency of the line about rest that moves the shaft, and is followed over the amplitude.
//! Responses peak near it.

use halfshaft_numerics::Complex;
use halfshaft_results::{Column, Table};

use super::channels;
use super::problem::Problem;
use super::responses::Response;
use super::shaft_law::Balanced;

/// Points on a backbone.
const POINTS: u32 = 120;
/// Newton steps for a point.
const STEPS: usize = 30;

/// All backbones that start within a range of circular frequencies, looked for on a grid of them, up
/// to an amplitude; none where the line has no rest.
pub(super) fn all(
    problem: &Problem,
    rest: f64,
    highest: f64,
    range: (f64, f64),
    grid: &[f64],
) -> Vec<Table> {
    let free = problem.free();
    let small = 1e-9 * highest;
    let Some(at) = free.law.balanced(small, rest) else { return Vec::new() };
    let left = |nu: &f64| {
        let point = free.value(*nu)?;
        Some(point.alpha.re + point.beta.re * at.force / small)
    };
    let values: Vec<Option<f64>> = grid.iter().map(left).collect();
    let mut tables = Vec::new();
    for (ends, values) in grid.windows(2).zip(values.windows(2)) {
        let (Some(a), Some(b)) = (values[0], values[1]) else { continue };
        if (a < 0.0) == (b < 0.0) {
            continue;
        }
        // Where a limb of the rest resonates by itself the left side changes sign by scale only.
        let guess = ends[0] + (ends[1] - ends[0]) * (a / (a - b));
        if let Some(nu) = frequency(&free, guess, small, &at)
            && nu >= ends[0]
            && nu <= ends[1]
        {
            tables.extend(backbone(&free, rest, nu, highest, range));
        }
    }
    tables
}

/// The backbone that starts at a natural circular frequency `nu`; `None` where it has fewer than two
/// points in the range.
fn backbone(free: &Problem, rest: f64, nu: f64, highest: f64, range: (f64, f64)) -> Option<Table> {
    let mut points: Vec<Response> = Vec::new();
    let (mut nu, mut mean) = (nu, rest);
    for k in 0..=POINTS {
        let a = highest * f64::from(k) / f64::from(POINTS);
        // At amplitude zero the harmonic is the tangent stiffness.
        let Some(at) = free.law.balanced(a.max(1e-9 * highest), mean) else { break };
        let Some(next) = frequency(free, nu, a.max(1e-9 * highest), &at) else { break };
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
    (points.len() > 1).then(|| table(free, &points))
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
