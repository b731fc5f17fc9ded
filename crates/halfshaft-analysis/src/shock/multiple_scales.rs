//! Closed form of `θ'' + ω² θ + α θ' + γ θ³ - μ θ² = 0` by multiple scales.
//!
//! All of `α`, `γ`, `μ` count as small of the same order. With `Θ = ω t + ψ` the expansion of
//! order 2 is (order 1 stops after the second line; theory 3)
//!
//! ```text
//! θ = r cos Θ
//!   + γ r³/(32 ω²) cos 3Θ - μ r²/(6 ω²) (cos 2Θ - 3)
//!   + γ² r⁵/(1024 ω⁴) cos 5Θ - γ μ r⁴/(96 ω⁴) cos 4Θ
//!   + [μ² r³/(48 ω⁴) - 21 γ² r⁵/(1024 ω⁴)] cos 3Θ + 3 γ α r³/(128 ω³) sin 3Θ
//!   + 31 γ μ r⁴/(96 ω⁴) cos 2Θ - μ α r²/(9 ω³) sin 2Θ - 5 γ μ r⁴/(8 ω⁴)
//! r' = -(α/2) r                                  [+ 3 γ α/(16 ω²) r³]
//! ψ' = 3 γ r²/(8 ω)     [- α²/(8 ω) - 5 μ² r²/(12 ω³) - 15 γ² r⁴/(256 ω³)]
//! ```
//!
//! where brackets belong to order 2. The slow equations have closed solutions. Initial
//! conditions are met by the whole expansion, and the velocity is its exact derivative, slow
//! terms included.

use halfshaft_numerics::newton;

use crate::error::{AnalysisError, Doing};

/// Coefficients of `θ'' + ω² θ + α θ' + γ θ³ - μ θ² = 0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Oscillator {
    /// `ω`, rad/s, more than zero.
    pub(crate) omega: f64,
    /// `α`, 1/s.
    pub(crate) alpha: f64,
    /// `γ`, 1/(rad² s²).
    pub(crate) gamma: f64,
    /// `μ`, 1/(rad s²).
    pub(crate) mu: f64,
}

/// How much of the expansion is kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Expansion {
    /// Order 1.
    First,
    /// Order 1 with a velocity that holds amplitude and slow phase still, as the paper's figures
    /// have it: `θ' = ω ∂θ/∂Θ`.
    FirstAsPrinted,
    /// Order 2.
    Second,
}

/// The closed form for one set of initial values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct MultipleScales {
    oscillator: Oscillator,
    expansion: Expansion,
    /// Amplitude at time 0.
    r0: f64,
    /// Fast phase at time 0.
    phase0: f64,
}

/// One term `a r^power trig(harmonic Θ)` of the expansion.
struct Term {
    factor: f64,
    power: i32,
    harmonic: f64,
    sine: bool,
}

impl Oscillator {
    /// Terms of the expansion up to the given order.
    fn terms(&self, expansion: Expansion) -> Vec<Term> {
        let Self { omega, alpha, gamma, mu } = *self;
        let (w2, w3, w4) = (omega * omega, omega.powi(3), omega.powi(4));
        let cos = |factor, power, harmonic| Term { factor, power, harmonic, sine: false };
        let sin = |factor, power, harmonic| Term { factor, power, harmonic, sine: true };
        let mut terms = vec![
            cos(1.0, 1, 1.0),
            cos(gamma / (32.0 * w2), 3, 3.0),
            cos(-mu / (6.0 * w2), 2, 2.0),
            cos(mu / (2.0 * w2), 2, 0.0),
        ];
        if expansion == Expansion::Second {
            terms.extend([
                cos(gamma * gamma / (1024.0 * w4), 5, 5.0),
                cos(-gamma * mu / (96.0 * w4), 4, 4.0),
                cos(mu * mu / (48.0 * w4), 3, 3.0),
                cos(-21.0 * gamma * gamma / (1024.0 * w4), 5, 3.0),
                sin(3.0 * gamma * alpha / (128.0 * w3), 3, 3.0),
                cos(31.0 * gamma * mu / (96.0 * w4), 4, 2.0),
                sin(-mu * alpha / (9.0 * w3), 2, 2.0),
                cos(-5.0 * gamma * mu / (8.0 * w4), 4, 0.0),
            ]);
        }
        terms
    }

    /// `(r', ψ')` at amplitude `r`.
    fn slow(&self, r: f64, expansion: Expansion) -> (f64, f64) {
        let Self { omega, alpha, gamma, mu } = *self;
        let mut growth = -alpha / 2.0 * r;
        let mut drift = 3.0 * gamma * r * r / (8.0 * omega);
        if expansion == Expansion::Second {
            let w3 = omega.powi(3);
            growth += 3.0 * gamma * alpha / (16.0 * omega * omega) * r.powi(3);
            drift += -alpha * alpha / (8.0 * omega)
                - 5.0 * mu * mu * r * r / (12.0 * w3)
                - 15.0 * gamma * gamma * r.powi(4) / (256.0 * w3);
        }
        (growth, drift)
    }

    /// `(θ, θ')` at amplitude `r` and fast phase `phase`.
    fn motion(&self, r: f64, phase: f64, expansion: Expansion) -> (f64, f64) {
        let (growth, drift) = match expansion {
            Expansion::FirstAsPrinted => (0.0, 0.0),
            _ => self.slow(r, expansion),
        };
        let turning = self.omega + drift;
        self.terms(expansion).iter().fold((0.0, 0.0), |(x, v), term| {
            let Term { factor, power, harmonic, sine } = *term;
            let (s, c) = (harmonic * phase).sin_cos();
            let (wave, slope) = if sine { (s, c) } else { (c, -s) };
            let size = factor * r.powi(power);
            let growing = factor * f64::from(power) * r.powi(power - 1) * growth;
            (x + size * wave, v + growing * wave + size * slope * harmonic * turning)
        })
    }
}

impl MultipleScales {
    /// The closed form through `θ(0) = x0`, `θ'(0) = v0`.
    ///
    /// # Errors
    /// Where no amplitude and phase meet the initial values: the motion is too large for the
    /// expansion.
    pub(crate) fn new(
        oscillator: Oscillator,
        expansion: Expansion,
        x0: f64,
        v0: f64,
    ) -> Result<Self, AnalysisError> {
        let omega = oscillator.omega;
        // Unknowns r cos Θ and r sin Θ: unlike r and Θ they are regular at rest.
        let start = [x0, -v0 / omega];
        let size = start[0].hypot(start[1]);
        if size == 0.0 {
            return Ok(Self { oscillator, expansion, r0: 0.0, phase0: 0.0 });
        }
        let miss = |unknowns: &[f64], out: &mut [f64]| {
            let (r, phase) = (unknowns[0].hypot(unknowns[1]), unknowns[1].atan2(unknowns[0]));
            let (x, v) = oscillator.motion(r, phase, expansion);
            out[0] = x - x0;
            out[1] = (v - v0) / omega;
        };
        let solution = newton::solve(
            miss,
            |unknowns, jacobian| {
                // Central differences: the iteration corrects what they lack.
                let h = 1e-6 * size;
                for column in 0..2 {
                    let mut sides = [[0.0; 2]; 2];
                    for (side, sign) in sides.iter_mut().zip([1.0, -1.0]) {
                        let mut shifted = [unknowns[0], unknowns[1]];
                        shifted[column] += sign * h;
                        miss(&shifted, side);
                    }
                    for row in 0..2 {
                        jacobian[(row, column)] = (sides[0][row] - sides[1][row]) / (2.0 * h);
                    }
                }
            },
            &start,
            &newton::Settings {
                typical: vec![size; 2],
                step_tolerance: 1e-13,
                ..newton::Settings::default()
            },
        )
        .doing("fitting the closed form to the initial values")?;
        if !solution.report.converged.is_converged() {
            return Err(AnalysisError::MethodDoesNotFit {
                method: "multiple-scales",
                reason: format!(
                    "a start at {x0:.4} rad and {v0:.4} rad/s is too far out for the expansion"
                ),
            });
        }
        let [a, b] = [solution.unknowns[0], solution.unknowns[1]];
        let found = Self { oscillator, expansion, r0: a.hypot(b), phase0: b.atan2(a) };
        if expansion == Expansion::Second && oscillator.alpha > 0.0 {
            // Where the cubic term outweighs the damping of the amplitude it would grow for ever.
            let growth = found.bend() * found.r0 * found.r0;
            if growth >= 1.0 {
                return Err(AnalysisError::MethodDoesNotFit {
                    method: "multiple-scales",
                    reason: format!(
                        "a swing of {:.4} rad is too large for the expansion, whose amplitude would \
                         grow in spite of the damping",
                        found.r0
                    ),
                });
            }
        }
        Ok(found)
    }

    /// How the amplitude's own decay bends with its square, 1/rad².
    fn bend(&self) -> f64 {
        let Oscillator { omega, gamma, .. } = self.oscillator;
        match self.expansion {
            Expansion::Second => 3.0 * gamma / (8.0 * omega * omega),
            Expansion::First | Expansion::FirstAsPrinted => 0.0,
        }
    }

    /// Amplitude and fast phase at time `t`.
    fn slow_state(&self, t: f64) -> (f64, f64) {
        let Oscillator { omega, alpha, gamma, mu } = self.oscillator;
        let u0 = self.r0 * self.r0;
        // E/α with E = 1 - exp(-α t), and its limit t without damping.
        let decayed = -(-alpha * t).exp_m1();
        let time = if alpha == 0.0 { t } else { decayed / alpha };
        // The amplitude equation of order 2 is Bernoulli's: u = r², u' = -α u + 3 γ α u²/(8 ω²).
        let second = self.expansion == Expansion::Second;
        let z = self.bend() * u0 * decayed;
        let u = u0 * (1.0 - decayed) / (1.0 - z);
        let (log, rest) = logarithms(z);
        let integral_u = u0 * time * log;
        let integral_u2 = u0 * u0 * time * (1.0 / (1.0 - z) - decayed * rest);
        let mut psi = 3.0 * gamma / (8.0 * omega) * integral_u;
        if second {
            let w3 = omega.powi(3);
            psi += -alpha * alpha / (8.0 * omega) * t
                - 5.0 * mu * mu / (12.0 * w3) * integral_u
                - 15.0 * gamma * gamma / (256.0 * w3) * integral_u2;
        }
        (u.max(0.0).sqrt(), omega * t + self.phase0 + psi)
    }

    /// `(θ, θ')` at time `t`, rad and rad/s.
    pub(crate) fn at(&self, t: f64) -> (f64, f64) {
        let (r, phase) = self.slow_state(t);
        self.oscillator.motion(r, phase, self.expansion)
    }
}

/// `L = -ln(1 - z)/z` and `(1/(1 - z) - L)/z`, with their series near zero.
fn logarithms(z: f64) -> (f64, f64) {
    if z.abs() < 1e-3 {
        let series = |first: &dyn Fn(f64) -> f64| {
            (0..6).rev().fold(0.0, |sum, k| sum * z + first(f64::from(k)))
        };
        // L = Σ z^k/(k+1); 1/(1-z) - L = Σ z^k k/(k+1).
        return (series(&|k| 1.0 / (k + 1.0)), series(&|k| (k + 1.0) / (k + 2.0)));
    }
    let log = -(-z).ln_1p() / z;
    (log, (1.0 / (1.0 - z) - log) / z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use halfshaft_numerics::ode::dop853::Dop853;
    use halfshaft_numerics::ode::{Settings, function};

    fn integrated(oscillator: Oscillator, x0: f64, v0: f64, t: f64) -> (f64, f64) {
        let Oscillator { omega, alpha, gamma, mu } = oscillator;
        let system = function(2, move |_, y: &[f64], rate: &mut [f64]| {
            rate[0] = y[1];
            rate[1] =
                -omega * omega * y[0] - alpha * y[1] - gamma * y[0].powi(3) + mu * y[0] * y[0];
        });
        let mut integrator =
            Dop853::new(system, 0.0, &[x0, v0], Settings::with_tolerance(1e-13)).expect("starts");
        while integrator.time() < t {
            integrator.step(t).expect("steps");
        }
        (integrator.state()[0], integrator.state()[1])
    }

    /// Largest error over a few times when the small terms are scaled by `epsilon`.
    fn error(order: Expansion, epsilon: f64) -> f64 {
        let oscillator = Oscillator {
            omega: 2.0,
            alpha: 0.5 * epsilon,
            gamma: 1.2 * epsilon,
            mu: 0.9 * epsilon,
        };
        let (x0, v0) = (0.8, 0.7);
        let closed = MultipleScales::new(oscillator, order, x0, v0).expect("fits");
        let miss = |t: f64| {
            let ((x, v), (x1, v1)) = (closed.at(t), integrated(oscillator, x0, v0, t));
            (x - x1).abs().max((v - v1).abs() / 2.0)
        };
        [0.3, 1.1, 2.6, 4.0].into_iter().map(miss).fold(0.0, f64::max)
    }

    // Source: theory of the method; the error at fixed times falls as epsilon to the order plus
    // one, against tight integration.
    #[test]
    fn the_error_falls_with_the_order_of_the_expansion() {
        for (order, expected) in [(Expansion::First, 2.0), (Expansion::Second, 3.0)] {
            let rate = (error(order, 0.04) / error(order, 0.02)).log2();
            assert!((rate - expected).abs() < 0.15, "{order:?}: rate {rate}");
        }
    }

    // Source: the definition of the initial conditions.
    #[test]
    fn the_whole_expansion_meets_the_initial_values() {
        let oscillator = Oscillator { omega: 13.0, alpha: 2.2, gamma: -15.0, mu: -38.0 };
        for order in [Expansion::First, Expansion::Second] {
            let closed = MultipleScales::new(oscillator, order, 0.9, -3.0).expect("fits");
            let (x, v) = closed.at(0.0);
            assert!((x - 0.9).abs() < 1e-12 && (v + 3.0).abs() < 1e-10, "{order:?}: {x} {v}");
        }
    }

    // Source: central differences in time.
    #[test]
    fn the_velocity_is_the_derivative_of_the_motion() {
        let oscillator = Oscillator { omega: 13.0, alpha: 2.2, gamma: 15.0, mu: 30.0 };
        for order in [Expansion::First, Expansion::Second] {
            let closed = MultipleScales::new(oscillator, order, 0.5, 2.0).expect("fits");
            for t in [0.05, 0.4, 1.7] {
                let h = 1e-6;
                let slope = (closed.at(t + h).0 - closed.at(t - h).0) / (2.0 * h);
                assert!((slope - closed.at(t).1).abs() < 1e-6, "{order:?} at {t}");
            }
        }
    }

    // Source: the exact solution of the linear equation in its slow-flow limit: for γ = μ = 0
    // order 2 knows the damped frequency to the fourth power of the damping.
    #[test]
    fn without_nonlinearity_order_two_has_the_damped_frequency() {
        let oscillator = Oscillator { omega: 10.0, alpha: 0.4, gamma: 0.0, mu: 0.0 };
        let closed = MultipleScales::new(oscillator, Expansion::Second, 1.0, 0.0).expect("fits");
        let (x, _) = closed.at(3.0);
        let (exact, _) = integrated(oscillator, 1.0, 0.0, 3.0);
        assert!((x - exact).abs() < 1e-5, "{x} {exact}");
    }
}
