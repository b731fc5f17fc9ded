//! Folds and peaks to the last digits, by Newton's method on `g = 0` with `∂g/∂u = 0` or
//! `∂g/∂ν = 0` in `(ν, u = ln a)`.

use super::path::Place;
use super::problem::{Problem, Residual};

/// What vanishes beside `g`.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Condition {
    /// Two responses meet.
    Fold,
    /// The amplitude is greatest or least over the frequency.
    Peak,
}

/// Most Newton steps.
const STEPS: usize = 40;
/// Corrections below this part are rounding.
const SETTLED: f64 = 1e-10;

/// The fold between two places on both sides of it.
pub(super) fn fold(problem: &Problem, from: &Place, to: &Place) -> Option<Place> {
    let found = newton(problem, &middle(from, to), Condition::Fold)?;
    let gap = (from.twist - to.twist).modulus();
    let near = |place: &Place| (found.twist - place.twist).modulus() <= 1.5 * gap;
    (near(from) && near(to)).then_some(found)
}

/// The greatest amplitude near a place.
pub(super) fn peak(problem: &Problem, near: &Place) -> Option<Place> {
    newton(problem, near, Condition::Peak)
}

fn middle(from: &Place, to: &Place) -> Place {
    let twist = (from.twist + to.twist).scaled(0.5);
    Place { nu: f64::midpoint(from.nu, to.nu), twist, at: from.at }
}

fn newton(problem: &Problem, start: &Place, condition: Condition) -> Option<Place> {
    let (mut nu, mut u) = (start.nu, start.twist.modulus().ln());
    let mut mean = start.at.mean;
    let mut last = f64::INFINITY;
    for _ in 0..STEPS {
        let point = problem.jet(nu)?;
        let at = problem.law.balanced_with_bend(u.exp(), mean)?;
        mean = at.mean;
        let g = problem.residual(&point, u.exp(), &at);
        let (by_nu, by_u) = step(&g, condition)?;
        // Far from the root a step may overshoot: keep it within a tenth of its size.
        let size = (by_nu / nu).abs().max(by_u.abs());
        let damping = (0.1 / size).min(1.0);
        nu += damping * by_nu;
        u += damping * by_u;
        if size <= 4.0 * f64::EPSILON || (size <= SETTLED && size >= 0.25 * last) {
            return place(problem, nu, u, mean);
        }
        last = size;
    }
    (last <= SETTLED).then(|| place(problem, nu, u, mean)).flatten()
}

/// The Newton step of a pair of equations.
fn step(g: &Residual, condition: Condition) -> Option<(f64, f64)> {
    let (second, by_nu, by_u) = match condition {
        Condition::Fold => (g.by_u, g.by_nu_u, g.by_u_u),
        Condition::Peak => (g.by_nu, g.by_nu_nu, g.by_nu_u),
    };
    let determinant = g.by_nu * by_u - g.by_u * by_nu;
    let nu = (-g.value * by_u + second * g.by_u) / determinant;
    let u = (-g.by_nu * second + by_nu * g.value) / determinant;
    (nu.is_finite() && u.is_finite()).then_some((nu, u))
}

fn place(problem: &Problem, nu: f64, u: f64, mean: f64) -> Option<Place> {
    let point = problem.value(nu)?;
    let at = problem.law.balanced(u.exp(), mean)?;
    let twist = problem.twist(&point, u.exp(), &at);
    (nu > 0.0).then_some(Place { nu, twist, at })
}
