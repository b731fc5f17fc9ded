//! What the nonlinear shaft does over a swing `x = m + a cos φ`: its mean torque in balance with the
//! line, its first harmonic, and how both change.
//!
//! With `F = a · gain` the first harmonic and `M_k = ⟨T' cos^k φ⟩`: `∂⟨T⟩/∂m = M_0`,
//! `∂⟨T⟩/∂a = M_1`, `∂F/∂m = 2 M_1`, `∂F/∂a = 2 M_2`. The mean follows the amplitude by statics,
//! `⟨T⟩(m, a) + κ m = τ`, so that along it
//!
//! ```text
//! dm/da = -M_1 / (M_0 + κ)        dF/da = 2 M_2 - 2 M_1² / (M_0 + κ)
//! ```
//!
//! A damper `c` that acts in contact only resists with `c ν G`, where `G` is the first harmonic of a
//! law with the same contact and stiffness one: `⟨χ sin² φ⟩` for both, with `χ` one in contact.

use halfshaft_dynamics::laws::{ClearanceLaw, OneSidedContact, PolynomialLaw};
use halfshaft_dynamics::{Connection, Friction, TorqueLaw};
use halfshaft_numerics::polynomial::Polynomial;

use super::rest::Statics;

/// The nonlinear shaft with the statics that hold its mean.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ShaftLaw {
    pub(super) law: TorqueLaw,
    pub(super) friction: Option<Friction>,
    /// Damper that acts at every twist, N·m·s/rad.
    pub(super) damping: f64,
    /// Damper that acts in contact only, N·m·s/rad, and the contact as a law of stiffness one.
    pub(super) contact: Option<(f64, TorqueLaw)>,
    pub(super) statics: Statics,
    /// Whether law and load are odd, so that the mean stays at zero.
    pub(super) symmetric: bool,
}

/// Averages over a swing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Swing {
    /// Mean torque less what is asked: zero in balance.
    pub(super) imbalance: f64,
    /// First harmonic of the torque, N·m.
    pub(super) force: f64,
    /// `M_0`, `M_1`, `M_2`.
    pub(super) moments: [f64; 3],
}

/// The first harmonic over the amplitude, the mean in balance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Balanced {
    /// Mean twist, rad.
    pub(super) mean: f64,
    /// `F`, N·m.
    pub(super) force: f64,
    /// `dF/da`.
    pub(super) slope: f64,
    /// `d²F/da²`; zero where it was not asked for.
    pub(super) bend: f64,
    /// `M_0 + κ`: how strongly the mean is held.
    pub(super) held: f64,
    /// `G` of the contact with its two derivatives by the amplitude.
    pub(super) contact: [f64; 3],
}

/// Torque in phase with the rate of twist, `S(ν, a)`, with its derivatives.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Resistance {
    pub(super) torque: f64,
    pub(super) by_a: f64,
    pub(super) by_nu: f64,
    pub(super) by_a_a: f64,
    pub(super) by_a_nu: f64,
    pub(super) by_nu_nu: f64,
}

/// Torque of friction in phase with the rate over the amplitude of the rate, with its derivative.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Loss {
    pub(super) torque: f64,
    pub(super) first: f64,
}

/// Most Newton steps for the mean.
const MEAN_STEPS: usize = 60;

impl ShaftLaw {
    pub(super) fn new(connection: &Connection, statics: Statics, scale: f64) -> Self {
        let unloaded = statics.asked.abs() <= 1e-13 * scale;
        let contact = contact(&connection.law)
            .filter(|_| !connection.damps_in_gap && connection.damping != 0.0)
            .map(|law| (connection.damping, law));
        Self {
            law: connection.law.clone(),
            friction: connection.friction.filter(|friction| friction.torque_nm != 0.0),
            damping: if contact.is_some() { 0.0 } else { connection.damping },
            contact,
            symmetric: unloaded && connection.law.is_odd(),
            statics,
        }
    }

    /// Averages over a swing.
    pub(super) fn swing(&self, mean: f64, amplitude: f64) -> Swing {
        let of = self.law.describing_function(mean, amplitude);
        let asked = self.statics.asked - self.statics.parallel * mean;
        Swing {
            imbalance: of.mean_torque - asked,
            force: of.gain * amplitude,
            moments: [
                of.mean_by_mean,
                of.mean_by_amplitude,
                0.5 * (of.gain + amplitude * of.gain_by_amplitude),
            ],
        }
    }

    /// The mean in balance at an amplitude, near a guess; `None` where none is held there.
    pub(super) fn mean(&self, amplitude: f64, guess: f64) -> Option<f64> {
        if self.symmetric {
            return Some(0.0);
        }
        let mut mean = guess;
        let mut last = f64::INFINITY;
        for _ in 0..MEAN_STEPS {
            let swing = self.swing(mean, amplitude);
            let held = swing.moments[0] + self.statics.parallel;
            if held <= 0.0 || held.is_nan() {
                return (swing.imbalance == 0.0).then_some(mean);
            }
            let step = swing.imbalance / held;
            let next = mean - step;
            let size = next.abs().max(amplitude);
            // Steps that no longer shrink are rounding.
            if step == 0.0 || (step.abs() <= 1e-9 * size && step.abs() >= 0.25 * last) {
                return Some(mean);
            }
            if step.abs() <= f64::EPSILON * size {
                return Some(next);
            }
            (mean, last) = (next, step.abs());
        }
        (last <= 1e-9 * mean.abs().max(amplitude)).then_some(mean)
    }

    /// First harmonic and its slope at an amplitude, the mean in balance near a guess; `None` where
    /// no mean is held there.
    pub(super) fn balanced(&self, amplitude: f64, guess: f64) -> Option<Balanced> {
        let mean = self.mean(amplitude, guess)?;
        Some(self.at(mean, amplitude))
    }

    /// The same with the bend.
    pub(super) fn balanced_with_bend(&self, amplitude: f64, guess: f64) -> Option<Balanced> {
        let mut found = self.balanced(amplitude, guess)?;
        found.bend = self.bend(amplitude, &found);
        if self.contact.is_some() {
            found.contact[2] = self.sixth_order(amplitude, &found, |at| at.contact[1]);
        }
        Some(found)
    }

    fn at(&self, mean: f64, amplitude: f64) -> Balanced {
        let Swing { force, moments: [m0, m1, m2], .. } = self.swing(mean, amplitude);
        let held = m0 + self.statics.parallel;
        // An odd law keeps its mean at zero, held or not.
        let follows = if self.symmetric || m1 == 0.0 { 0.0 } else { m1 * m1 / held };
        let contact = self.contact.as_ref().map_or([0.0; 3], |(_, law)| {
            let [force, c1, c2] = contact_moments(law, mean, amplitude);
            let follows = if self.symmetric { 0.0 } else { c1 * m1 / held };
            [force, 2.0 * (c2 - follows), 0.0]
        });
        Balanced { mean, force, slope: 2.0 * (m2 - follows), bend: 0.0, held, contact }
    }

    /// `d²F/da²`: in closed form for polynomials, else by differences of sixth order of the slope.
    fn bend(&self, amplitude: f64, at: &Balanced) -> f64 {
        if let Some(polynomial) = self.law.polynomial() {
            let curvature = polynomial.polynomial().derivative().derivative();
            let [k0, k1, k2, k3] = curvature_moments(&curvature, at.mean, amplitude);
            let [_, m1, _] = self.swing(at.mean, amplitude).moments;
            if self.symmetric {
                return 2.0 * k3;
            }
            let drift = -m1 / at.held;
            let along = |by_amplitude: f64, by_mean: f64| by_amplitude + by_mean * drift;
            let (d0, d1, d2) = (along(k1, k0), along(k2, k1), along(k3, k2));
            return 2.0 * d2 + 4.0 * drift * d1 + 2.0 * drift * drift * d0;
        }
        self.sixth_order(amplitude, at, |at| at.slope)
    }

    /// Derivative by the amplitude of a quantity in balance, by differences of sixth order.
    fn sixth_order(
        &self,
        amplitude: f64,
        at: &Balanced,
        quantity: impl Fn(&Balanced) -> f64,
    ) -> f64 {
        let step = 2e-3 * amplitude;
        let there = |k: f64| {
            self.balanced(amplitude + k * step, at.mean).map_or(f64::NAN, |found| quantity(&found))
        };
        let odd = |k: f64| there(k) - there(-k);
        (45.0 * odd(1.0) - 9.0 * odd(2.0) + odd(3.0)) / (60.0 * step)
    }

    /// What resists the rate of twist, dampers that act at every twist left out; with first
    /// derivatives only.
    pub(super) fn resistance(&self, nu: f64, a: f64, at: &Balanced) -> Resistance {
        let mut sum = Resistance::default();
        if let Some(friction) = &self.friction {
            let Loss { torque, first } = loss(friction, nu * a);
            sum = Resistance { torque, by_a: nu * first, by_nu: a * first, ..sum };
        }
        if let Some((damping, _)) = &self.contact {
            sum.torque += nu * damping * at.contact[0];
            sum.by_a += nu * damping * at.contact[1];
            sum.by_nu += damping * at.contact[0];
        }
        sum
    }

    /// The same with second derivatives.
    pub(super) fn resistance_with_bend(&self, nu: f64, a: f64, at: &Balanced) -> Resistance {
        let mut sum = self.resistance(nu, a, at);
        if let Some(friction) = &self.friction {
            let rate = nu * a;
            let step = 1e-3 * rate.abs().max(1e-3 * friction.speed_rad_s);
            let there = |k: f64| loss(friction, rate + k * step).first;
            let odd = |k: f64| there(k) - there(-k);
            let second = (45.0 * odd(1.0) - 9.0 * odd(2.0) + odd(3.0)) / (60.0 * step);
            sum.by_a_a = nu * nu * second;
            sum.by_a_nu = loss(friction, rate).first + nu * a * second;
            sum.by_nu_nu = a * a * second;
        }
        if let Some((damping, _)) = &self.contact {
            sum.by_a_a += nu * damping * at.contact[2];
            sum.by_a_nu += damping * at.contact[1];
        }
        sum
    }

    /// Whether only the amplitude matters: no friction, no damper in contact.
    pub(super) fn is_plain(&self) -> bool {
        self.friction.is_none() && self.contact.is_none()
    }
}

/// Friction at an amplitude of the rate.
pub(super) fn loss(friction: &Friction, rate: f64) -> Loss {
    let of = friction.describing_function(rate);
    Loss { torque: of.damping * rate, first: of.damping + rate * of.by_amplitude }
}

/// The contact of a law with free play as a law of stiffness one.
fn contact(law: &TorqueLaw) -> Option<TorqueLaw> {
    let one = PolynomialLaw::new([0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    match law {
        TorqueLaw::Clearance(law) if law.half_gap() > 0.0 => {
            Some(TorqueLaw::Clearance(ClearanceLaw::new(2.0 * law.half_gap(), &one, 0.0)))
        }
        TorqueLaw::OneSided(law) => {
            Some(TorqueLaw::OneSided(OneSidedContact::new(law.contact_twist(), &one, 0.0)))
        }
        _ => None,
    }
}

/// First harmonic, `M_1` and `M_2` of the contact.
pub(super) fn contact_moments(law: &TorqueLaw, mean: f64, amplitude: f64) -> [f64; 3] {
    let of = law.describing_function(mean, amplitude);
    let second = 0.5 * (of.gain + amplitude * of.gain_by_amplitude);
    [of.gain * amplitude, of.mean_by_amplitude, second]
}

/// Means of `cos^n` for `n` from 0 to 10.
const COSINES: [f64; 11] =
    [1.0, 0.0, 1.0 / 2.0, 0.0, 3.0 / 8.0, 0.0, 5.0 / 16.0, 0.0, 35.0 / 128.0, 0.0, 63.0 / 256.0];

/// `⟨T'' cos^k φ⟩` for `k` from 0 to 3, with `T''` a polynomial of degree five at most.
pub(super) fn curvature_moments(curvature: &Polynomial, mean: f64, amplitude: f64) -> [f64; 4] {
    let about = curvature.shifted(mean);
    let mut moments = [0.0; 4];
    let mut power = 1.0;
    for (n, coefficient) in about.coefficients().iter().enumerate() {
        for (k, moment) in moments.iter_mut().enumerate() {
            *moment += coefficient * power * COSINES.get(n + k).copied().unwrap_or(0.0);
        }
        power *= amplitude;
    }
    moments
}
