//! One mode of a line as an oscillator.
//!
//! With `φ` the shape of the mode, `x` the twist of its reference shaft beyond equilibrium, and
//! `τ_e` the twist of shaft `e` per unit of `x`:
//!
//! ```text
//! m = φᵀ M φ / (twist of the reference)²           modal inertia
//! a_i = (1/m) Σ_e τ_e^(i+1) p_e^(i)(x_e0) / i!      a_1 = ω1²
//! β = φᵀ C φ / φᵀ M φ                               f cos(ω t + phase) = φᵀ Q(t) / m
//! ```
//!
//! For the two-mass line `m = J_m J_L/(J_m + J_L)` and `f` is (29) with `F = T_m/J_m + T_L/J_L`.

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_dynamics::laws::PolynomialLaw;
use halfshaft_numerics::polynomial::Polynomial;

use super::responses::SlowFlow;
use crate::equilibrium::RestState;
use crate::error::AnalysisError;
use crate::modal::ElasticMode;
use crate::modal::elastic::lowest_modes;
use crate::polynomials_only::polynomial_laws;

/// Name of the method in messages.
const METHOD: &str = "averaged";

/// Highest power of the expansion about the equilibrium.
const POWERS: usize = 8;

/// `x'' + ω1² x + a2 x² + ... + a7 x⁷ + β x' = f cos(ω t + phase)`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ModeEquation {
    /// Which elastic mode, from 1.
    pub(crate) mode: usize,
    /// Order of the excitation.
    pub(crate) order: f64,
    /// Index of the shaft whose twist is `x`.
    pub(crate) reference: usize,
    /// Inertia per unit of `x`, kg·m².
    pub(crate) inertia: f64,
    /// Natural frequency `ω1`, rad/s.
    pub(crate) omega: f64,
    /// `a_i` at index `i`; the first two are zero and `ω1²`.
    pub(crate) restoring: [f64; POWERS],
    /// Damping coefficient, 1/s.
    pub(crate) beta: f64,
    /// Excitation amplitude, rad/s².
    pub(crate) f: f64,
    /// Excitation phase, rad.
    pub(crate) phase: f64,
    /// Twist of every connection at rest, rad.
    pub(crate) rest_twists: Vec<f64>,
    /// Twist of every connection per unit of `x`.
    pub(crate) twist_per_x: Vec<f64>,
    /// Motion of every group per unit of `x`.
    pub(crate) group_per_x: Vec<f64>,
}

impl ModeEquation {
    /// Reduces a line about an equilibrium to its elastic mode number `mode` (from 1) under the
    /// torques of `order`.
    pub(crate) fn new(
        equations: &EquationsOfMotion,
        rest: &RestState,
        mode: usize,
        order: f64,
    ) -> Result<Self, AnalysisError> {
        let laws = polynomial_laws(equations, METHOD)?;
        if let Some(source) = equations.excitation.growing() {
            let reason = format!("the amplitude of {} grows with the speed", source.name);
            return Err(AnalysisError::MethodDoesNotFit { method: METHOD, reason });
        }
        let modes = lowest_modes(equations, &rest.twists, mode)?;
        let shape = modes
            .get(mode - 1)
            .ok_or(AnalysisError::NoSuchMode { asked: mode, found: modes.len() })?;
        if shape.eigenvalue <= 0.0 {
            let reason = "the equilibrium is not stable in this mode".to_owned();
            return Err(AnalysisError::NotAveraged { mode, reason });
        }
        let reference = reference(equations, rest, shape);
        let scale = shape.twists[reference];
        let twist_per_x: Vec<f64> = shape.twists.iter().map(|twist| twist / scale).collect();
        let inertia = 1.0 / (scale * scale);
        let frequency = shape.eigenvalue.sqrt() / order;
        let (f, phase) = drive(equations, shape, scale, order, frequency);
        Ok(Self {
            mode,
            order,
            reference,
            inertia,
            omega: shape.eigenvalue.sqrt(),
            restoring: restoring(&laws, rest, &twist_per_x, inertia),
            beta: damping(equations, shape),
            f,
            phase,
            rest_twists: rest.twists.clone(),
            group_per_x: shape.shape.iter().map(|motion| motion / scale).collect(),
            twist_per_x,
        })
    }

    /// Effective cubic coefficient: the quadratic term softens at second order,
    /// `α = a3 - 10 a2²/(9 ω1²)`.
    pub(crate) fn alpha(&self) -> f64 {
        let [_, _, a2, a3, ..] = self.restoring;
        a3 - 10.0 * a2 * a2 / (9.0 * self.omega * self.omega)
    }

    /// The slow flow: `g(z) = (3 α/8 z + 5 a5/16 z² + 35 a7/128 z³)/ω1`.
    pub(crate) fn slow_flow(&self) -> SlowFlow {
        let w = self.omega;
        SlowFlow {
            beta: self.beta,
            drive: self.f / (2.0 * w),
            backbone: [
                3.0 * self.alpha() / (8.0 * w),
                5.0 * self.restoring[5] / (16.0 * w),
                35.0 * self.restoring[7] / (128.0 * w),
            ],
        }
    }

    /// Excitation speed Ω at a detuning, rad/s.
    pub(crate) fn frequency(&self, sigma: f64) -> f64 {
        (self.omega + sigma) / self.order
    }

    /// Detuning at an excitation speed Ω, rad/s.
    pub(crate) fn sigma(&self, frequency: f64) -> f64 {
        self.order * frequency - self.omega
    }

    /// Shift of the mean of `x` at amplitude squared `z`: `-a2 z/(2 ω1²)`.
    pub(crate) fn mean_shift(&self, z: f64) -> f64 {
        -self.restoring[2] * z / (2.0 * self.omega * self.omega)
    }
}

/// The shaft whose twist measures the mode: the nonlinear one that holds most of the strain
/// energy, or the one that holds most where all that count are linear.
fn reference(equations: &EquationsOfMotion, rest: &RestState, mode: &ElasticMode) -> usize {
    let energy = |index: usize| {
        let law = &equations.connections[index].law;
        (law.stiffness(rest.twists[index]) * mode.twists[index].powi(2)).abs()
    };
    let total: f64 = (0..equations.connections.len()).map(energy).sum();
    let most = |nonlinear: bool| {
        (0..equations.connections.len())
            .filter(|index| !nonlinear || !equations.connections[*index].law.is_linear())
            .max_by(|a, b| energy(*a).total_cmp(&energy(*b)))
    };
    most(true).filter(|index| energy(*index) > 0.01 * total).or_else(|| most(false)).unwrap_or(0)
}

/// Amplitude and phase of the modal excitation.
fn drive(
    equations: &EquationsOfMotion,
    mode: &ElasticMode,
    scale: f64,
    order: f64,
    frequency: f64,
) -> (f64, f64) {
    let torques = equations.excitation.harmonic(equations.groups(), order, frequency);
    let (re, im) = torques
        .iter()
        .zip(&mode.shape)
        .fold((0.0, 0.0), |(re, im), ((a, b), phi)| (re + scale * phi * a, im + scale * phi * b));
    (re.hypot(im), im.atan2(re))
}

fn damping(equations: &EquationsOfMotion, mode: &ElasticMode) -> f64 {
    let shafts: f64 = equations
        .connections
        .iter()
        .zip(&mode.twists)
        .map(|(c, twist)| c.damping * twist * twist)
        .sum();
    let ground: f64 =
        equations.ground_damping.iter().zip(&mode.shape).map(|(d, phi)| d * phi * phi).sum();
    shafts + ground
}

fn restoring(
    laws: &[&PolynomialLaw],
    rest: &RestState,
    twist_per_x: &[f64],
    inertia: f64,
) -> [f64; POWERS] {
    let mut sum = [0.0; POWERS];
    for ((law, x0), per_x) in laws.iter().zip(&rest.twists).zip(twist_per_x) {
        let about = Polynomial::new(law.coefficients()).shifted(*x0);
        let mut lever = *per_x;
        for (power, (sum, k)) in sum.iter_mut().zip(about.coefficients()).enumerate() {
            if power > 0 {
                lever *= per_x;
                *sum += k * lever / inertia;
            }
        }
    }
    sum
}
