//! The one equation: a line with one nonlinear shaft at one order.
//!
//! With the twist `x = m + Re(X e^{iνt})`, `a = |X|`, the rest gives `(α + β N) X = γ` for the
//! complex stiffness `N = (F + i S)/a + i ν c` of the shaft, so that
//!
//! ```text
//! g(ν, a) = |α_c a + β (F + i S)|² - |γ|² = 0,     α_c = α + i ν c β
//! ```
//!
//! with the first harmonic `F(a)` of the law, the mean in balance, and what resists, `S(ν, a)`: dry
//! friction, dampers in contact.

use std::cell::{OnceCell, RefCell};

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_numerics::Complex;

use super::drive::Drive;
use super::jet::{Jet, Scalar};
use super::limbs::{Gathered, Seen};
use super::rest::{Rest, mean_forces};
use super::shaft_law::{Balanced, Resistance, ShaftLaw};
use crate::error::AnalysisError;

/// Name of the method in messages.
pub(super) const METHOD: &str = "first-harmonic";

/// A line with one nonlinear shaft, excited at one order.
pub(super) struct Problem {
    pub(super) equations: EquationsOfMotion,
    /// Index of the shaft.
    pub(super) shaft: usize,
    pub(super) order: f64,
    pub(super) rest: Rest,
    pub(super) drive: Drive,
    pub(super) law: ShaftLaw,
    /// Mean torques on the groups that the shafts carry, N·m.
    pub(super) forces: Vec<f64>,
    /// Mean angles of the groups with no twist and torque of the shaft, and by each of them.
    angles: OnceCell<[Vec<f64>; 3]>,
    work: RefCell<(Gathered<Jet>, Gathered<Complex>)>,
}

/// `α_c`, `β`, `γ` at a circular frequency.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Point<S> {
    pub(super) nu: f64,
    pub(super) alpha: S,
    pub(super) beta: S,
    pub(super) gamma: S,
}

/// `g / |γ|²` with its derivatives by `ν` and by `u = ln a`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Residual {
    pub(super) value: f64,
    pub(super) by_nu: f64,
    pub(super) by_u: f64,
    pub(super) by_nu_nu: f64,
    pub(super) by_nu_u: f64,
    pub(super) by_u_u: f64,
}

impl Problem {
    /// The problem of a line at an order.
    ///
    /// # Errors
    /// [`AnalysisError::MethodDoesNotFit`] for a line with several nonlinear shafts, by name, or
    /// without a shaft.
    pub(super) fn new(equations: EquationsOfMotion, order: f64) -> Result<Self, AnalysisError> {
        let shaft = nonlinear_shaft(&equations)?;
        Ok(Self::of_shaft(equations, shaft, order))
    }

    /// The problem of a line at an order with the given shaft as the nonlinear one.
    pub(super) fn of_shaft(equations: EquationsOfMotion, shaft: usize, order: f64) -> Self {
        let rest = Rest::new(&equations, shaft);
        let forces = mean_forces(&equations, shaft);
        let statics = rest.statics(&forces).unwrap_or_default();
        let scale = equations.excitation.scale();
        let law = ShaftLaw::new(&equations.connections[shaft], statics, scale);
        let drive = Drive::new(&equations, order);
        Self::assembled(equations, (shaft, order), rest, drive, law, forces)
    }

    fn assembled(
        equations: EquationsOfMotion,
        (shaft, order): (usize, f64),
        rest: Rest,
        drive: Drive,
        law: ShaftLaw,
        forces: Vec<f64>,
    ) -> Self {
        let (angles, work) = (OnceCell::new(), RefCell::default());
        Self { equations, shaft, order, rest, drive, law, forces, angles, work }
    }

    /// The same line without damping and without drive.
    pub(super) fn free(&self) -> Self {
        let mut law = self.law.clone();
        (law.damping, law.friction, law.contact) = (0.0, None, None);
        let (equations, forces) = (self.equations.clone(), self.forces.clone());
        let of = (self.shaft, self.order);
        Self::assembled(equations, of, self.rest.undamped(), Drive::default(), law, forces)
    }

    /// Mean angles of the groups for the mean twist `x` and the mean torque `torque` of the shaft;
    /// those of a free line turned so that their mean by inertia is zero.
    pub(super) fn mean_angles(&self, x: f64, torque: f64) -> Vec<f64> {
        let [constant, by_x, by_torque] = self.angles.get_or_init(|| {
            let at = |x: f64, torque: f64| {
                let angles = self.rest.angles_at_rest(&self.forces, x, torque);
                let mut angles = angles.unwrap_or_else(|| vec![0.0; self.equations.groups()]);
                if let Some(rigid) = &self.equations.rigid {
                    let turn = rigid.mean(&angles);
                    for (angle, speed) in angles.iter_mut().zip(&rigid.speeds) {
                        *angle -= speed * turn;
                    }
                }
                angles
            };
            let none = at(0.0, 0.0);
            let over = |angles: Vec<f64>| angles.iter().zip(&none).map(|(a, b)| a - b).collect();
            let (by_x, by_torque) = (over(at(1.0, 0.0)), over(at(0.0, 1.0)));
            [none, by_x, by_torque]
        });
        let slopes = by_x.iter().zip(by_torque);
        constant.iter().zip(slopes).map(|(c, (a, b))| c + a * x + b * torque).collect()
    }

    /// What the shaft sees at circular frequency `nu`, with derivatives.
    pub(super) fn jet(&self, nu: f64) -> Option<Point<Jet>> {
        let mut work = self.work.borrow_mut();
        let seen = self.rest.jet(nu, &self.drive, &mut work.0)?;
        Some(self.with_damping(nu, seen))
    }

    /// The same without derivatives.
    pub(super) fn value(&self, nu: f64) -> Option<Point<Complex>> {
        let mut work = self.work.borrow_mut();
        let seen = self.rest.value(nu, &self.drive, &mut work.1)?;
        Some(self.with_damping(nu, seen))
    }

    fn with_damping<S: Scalar>(&self, nu: f64, seen: Seen<S>) -> Point<S> {
        let rate = Complex::new(0.0, self.law.damping);
        let damper = S::of(rate.scaled(nu), rate, Complex::default());
        Point { nu, alpha: seen.alpha + damper * seen.beta, beta: seen.beta, gamma: seen.gamma }
    }

    /// The residual at a frequency and an amplitude with its harmonic.
    pub(super) fn residual(&self, point: &Point<Jet>, a: f64, at: &Balanced) -> Residual {
        residual(point, a, at, &self.law.resistance_with_bend(point.nu, a, at))
    }

    /// The complex twist at a root.
    pub(super) fn twist(&self, point: &Point<Complex>, a: f64, at: &Balanced) -> Complex {
        let whole = self.whole(point, a, at);
        // Of the modulus a also where rounding leaves the equation not quite fulfilled.
        let turned = point.gamma / whole;
        let size = turned.modulus();
        if size > 0.0 { turned.scaled(a / size) } else { Complex::from(a) }
    }

    /// `α_c a + β (F + i S)`.
    pub(super) fn whole(&self, point: &Point<Complex>, a: f64, at: &Balanced) -> Complex {
        let resistance = self.law.resistance(point.nu, a, at).torque;
        point.alpha.scaled(a) + point.beta * Complex::new(at.force, resistance)
    }

    /// The same and its derivative by the amplitude.
    pub(super) fn whole_and_slope(
        &self,
        point: &Point<Complex>,
        a: f64,
        at: &Balanced,
    ) -> (Complex, Complex) {
        let resistance = self.law.resistance(point.nu, a, at);
        (
            point.alpha.scaled(a) + point.beta * Complex::new(at.force, resistance.torque),
            point.alpha + point.beta * Complex::new(at.slope, resistance.by_a),
        )
    }

    /// Whether anything takes energy out of the motion of the shaft at a frequency.
    pub(super) fn is_damped(&self, point: &Point<Complex>) -> bool {
        let mixed = point.alpha * point.beta.conjugate();
        let size = point.alpha.modulus() * point.beta.modulus();
        !self.law.is_plain() || mixed.im > 1e-14 * size
    }
}

fn residual(point: &Point<Jet>, a: f64, at: &Balanced, resistance: &Resistance) -> Residual {
    let Point { alpha, beta, gamma, .. } = *point;
    let i = |value: f64| Complex::new(0.0, value);
    let torque = Complex::new(at.force, resistance.torque);
    let by_a = Complex::new(at.slope, resistance.by_a);
    let by_nu = i(resistance.by_nu);
    let u = alpha.value.scaled(a) + beta.value * torque;
    let u_a = alpha.value + beta.value * by_a;
    let u_nu = alpha.first.scaled(a) + beta.first * torque + beta.value * by_nu;
    let u_aa = beta.value * Complex::new(at.bend, resistance.by_a_a);
    let u_anu = alpha.first + beta.first * by_a + beta.value * i(resistance.by_a_nu);
    let u_nunu = alpha.second.scaled(a)
        + beta.second * torque
        + (beta.first * by_nu).scaled(2.0)
        + beta.value * i(resistance.by_nu_nu);
    let part = |x: Complex, y: Complex| 2.0 * (x.re * y.re + x.im * y.im);
    let size = 1.0 / (0.5 * part(gamma.value, gamma.value));
    let by_a = part(u, u_a);
    Residual {
        value: size * 0.5 * (part(u, u) - part(gamma.value, gamma.value)),
        by_nu: size * (part(u, u_nu) - part(gamma.value, gamma.first)),
        by_u: size * a * by_a,
        by_nu_nu: size
            * (part(u_nu, u_nu) + part(u, u_nunu)
                - part(gamma.first, gamma.first)
                - part(gamma.value, gamma.second)),
        by_nu_u: size * a * (part(u_nu, u_a) + part(u, u_anu)),
        by_u_u: size * a * (by_a + a * (part(u_a, u_a) + part(u, u_aa))),
    }
}

/// The one nonlinear shaft of a line; without any, the first shaft.
pub(super) fn nonlinear_shaft(equations: &EquationsOfMotion) -> Result<usize, AnalysisError> {
    let acts = |connection: &halfshaft_dynamics::Connection| {
        let rubs = connection.friction.is_some_and(|friction| friction.torque_nm != 0.0);
        !connection.law.is_linear() || rubs
    };
    let nonlinear: Vec<usize> = (0..equations.connections.len())
        .filter(|index| acts(&equations.connections[*index]))
        .collect();
    match nonlinear.as_slice() {
        [] if equations.connections.is_empty() => Err(AnalysisError::MethodDoesNotFit {
            method: METHOD,
            reason: "it has no shaft".to_owned(),
        }),
        [] => Ok(0),
        [one] => Ok(*one),
        several => {
            let names: Vec<&str> =
                several.iter().map(|index| equations.connections[*index].name.as_str()).collect();
            let reason = format!(
                "it is for one nonlinear shaft, and the line has {}: {}",
                several.len(),
                names.join(", ")
            );
            Err(AnalysisError::MethodDoesNotFit { method: METHOD, reason })
        }
    }
}
