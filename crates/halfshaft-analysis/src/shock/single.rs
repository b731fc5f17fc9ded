//! One equation for a shock: the load on its shaft, about its equilibrium.
//!
//! With `θ` the advance of the load end over the equilibrium (so the twist is `φ0 - θ`), the
//! drive end held and `J` the load's inertia,
//!
//! ```text
//! J θ'' + c θ' + p(φ0) - p(φ0 - θ) = T(t)
//! ```
//!
//! which for a cubic law is `θ'' + ω0² θ + α0 θ' + γ θ³ - μ θ² = T/J` with
//! `ω0² = (k1 + 3 k3 φ0²)/J`, `α0 = c/J`, `γ = k3/J`, `μ = 3 k3 φ0/J` (`clamped`). The
//! manuscript's (14) doubles these (`published`). The relative twist of the free line has
//! `1/J = 1/J_m + 1/J_L` (`twist`).

use halfshaft_dynamics::laws::PolynomialLaw;
use halfshaft_dynamics::{Connection, EquationsOfMotion, NodePlace, TorqueLaw};
use halfshaft_model::question::ShockEquation;
use halfshaft_model::{Network, TreeShaft};
use halfshaft_numerics::polynomial::Polynomial;

use super::multiple_scales::Oscillator;
use crate::equilibrium::RestState;
use crate::error::AnalysisError;
use crate::polynomials_only::polynomial_laws;

/// A shock reduced to one equation.
#[derive(Clone, Debug)]
pub(crate) struct SingleEquation {
    /// Which one.
    pub(crate) equation: ShockEquation,
    /// The equation as a line of one inertia on one shaft at ground, whose twist is `θ`.
    pub(crate) surrogate: EquationsOfMotion,
    /// Index of the shaft in the original line.
    pub(crate) connection: usize,
    /// Twist of the shaft before the disturbance, rad.
    pub(crate) static_twist: f64,
    /// Torque of the shaft before the disturbance, N·m.
    pub(crate) static_torque: f64,
    /// Its coefficients.
    pub(crate) oscillator: Oscillator,
    /// Coefficients of `θ⁴` and up over the inertia, which closed forms leave out.
    pub(crate) higher: Vec<f64>,
    /// Whether the line is damped against ground and the equation is not.
    pub(crate) drag_left_out: bool,
}

/// The two ends of the only shaft.
struct Ends {
    /// Inertia of the drive end at the shaft, kg·m²; `None` where it is ground.
    drive: Option<f64>,
    /// Inertia of the load end at the shaft, kg·m².
    load: f64,
    /// Group of the load and ratio of the shaft's node there.
    load_place: (usize, f64),
    /// Group of the drive and ratio of the shaft's node there.
    drive_place: Option<(usize, f64)>,
}

/// Reduces a line to one equation about `rest`.
pub(crate) fn reduce(
    equations: &EquationsOfMotion,
    rest: &RestState,
    equation: ShockEquation,
) -> Result<SingleEquation, AnalysisError> {
    let ends = ends(equations, equation)?;
    let connection = 0;
    let shaft = &equations.connections[connection];
    let (static_twist, static_torque) = (rest.twists[connection], rest.torques[connection]);
    let restoring =
        restoring(polynomial_laws(equations, name(equation))?[connection], static_twist);
    // Doubling all torques is halving the inertia and what acts on it from outside.
    let (inertia, gain) = match equation {
        ShockEquation::Clamped => (ends.load, 1.0),
        ShockEquation::Published => (ends.load / 2.0, 0.5),
        ShockEquation::Twist => {
            let inverse = 1.0 / ends.load + ends.drive.map_or(0.0, |drive| 1.0 / drive);
            (1.0 / inverse, 1.0)
        }
    };
    let stiffness = restoring[1];
    if stiffness <= 0.0 {
        return Err(AnalysisError::MethodDoesNotFit {
            method: name(equation),
            reason: "the tangent stiffness at the equilibrium is not positive".to_owned(),
        });
    }
    // Only the clamped load turns against ground as θ does; the other two have no place for that.
    let (load, ratio) = ends.load_place;
    let drag = match equation {
        ShockEquation::Clamped => equations.ground_damping[load] / (ratio * ratio),
        ShockEquation::Published | ShockEquation::Twist => 0.0,
    };
    let damped = equations.ground_damping.iter().any(|d| *d != 0.0);
    let oscillator = Oscillator {
        omega: (stiffness / inertia).sqrt(),
        alpha: (shaft.damping + drag) / inertia,
        gamma: restoring[3] / inertia,
        mu: -restoring[2] / inertia,
    };
    let higher = restoring[4..].iter().map(|k| k / inertia).collect();
    let mut surrogate = surrogate(equations, &ends, equation, inertia, gain, restoring);
    surrogate.ground_damping[0] = drag;
    Ok(SingleEquation {
        equation,
        surrogate,
        connection,
        static_twist,
        static_torque,
        oscillator,
        higher,
        drag_left_out: damped && equation != ShockEquation::Clamped,
    })
}

/// Name of the method that solves an equation.
pub(crate) fn name(equation: ShockEquation) -> &'static str {
    match equation {
        ShockEquation::Published => "published",
        ShockEquation::Clamped => "clamped",
        ShockEquation::Twist => "twist",
    }
}

/// The ends of the only shaft, where the line is of that kind.
fn ends(equations: &EquationsOfMotion, equation: ShockEquation) -> Result<Ends, AnalysisError> {
    let refuse =
        |reason: String| AnalysisError::MethodDoesNotFit { method: name(equation), reason };
    if equations.connections.len() != 1 {
        return Err(refuse(format!(
            "it is for two inertias on one shaft, and this line has {} shafts",
            equations.connections.len()
        )));
    }
    let shaft = &equations.connections[0];
    let at_shaft = |(group, ratio): (usize, f64)| equations.inertia[group] / (ratio * ratio);
    match (shaft.from, shaft.to) {
        (drive, Some(load)) if drive.is_some() || equation != ShockEquation::Published => {
            Ok(Ends {
                drive: drive.map(at_shaft),
                load: at_shaft(load),
                load_place: load,
                drive_place: drive,
            })
        }
        (Some(load), None) if equation != ShockEquation::Published => {
            Ok(Ends { drive: None, load: at_shaft(load), load_place: load, drive_place: None })
        }
        _ => Err(refuse("it needs an inertia at both ends of the shaft".to_owned())),
    }
}

/// Coefficients in `θ` of `p(φ0) - p(φ0 - θ)`.
fn restoring(law: &PolynomialLaw, static_twist: f64) -> [f64; PolynomialLaw::COUNT] {
    let about = Polynomial::new(law.coefficients()).shifted(static_twist);
    let mut coefficients = [0.0; PolynomialLaw::COUNT];
    for (power, (out, k)) in coefficients.iter_mut().zip(about.coefficients()).enumerate().skip(1) {
        // p(φ0 - θ) = Σ k (-θ)^power, so odd powers change their sign twice.
        *out = if power % 2 == 1 { *k } else { -*k };
    }
    coefficients
}

/// The equation as a line of one inertia at ground.
fn surrogate(
    equations: &EquationsOfMotion,
    ends: &Ends,
    equation: ShockEquation,
    inertia: f64,
    gain: f64,
    restoring: [f64; PolynomialLaw::COUNT],
) -> EquationsOfMotion {
    let shaft = &equations.connections[0];
    let node = equations.reference[ends.load_place.0];
    let mut excitation = equations.excitation.clone();
    // The shaft's node of the load turns by θ against the direction of the twist.
    let load_is_to = shaft.to.is_some();
    for source in &mut excitation.sources {
        let lever = if source.group == ends.load_place.0 {
            // θ is the motion of the load end where that is `to`, and its reverse at `from`.
            let sign = if load_is_to { 1.0 } else { -1.0 };
            sign * source.ratio / ends.load_place.1
        } else {
            match (equation, ends.drive_place, ends.drive) {
                // The relative twist feels a torque on the drive end by J_eff/J_m, reversed.
                (ShockEquation::Twist, Some((_, ratio)), Some(drive)) => {
                    -source.ratio / ratio * inertia / drive
                }
                _ => 0.0,
            }
        };
        let share = match (equation, source.group == ends.load_place.0) {
            (ShockEquation::Twist, true) => inertia / ends.load,
            _ => 1.0,
        };
        source.group = 0;
        source.ratio = lever * gain * share;
        source.mean = 0.0;
        source.harmonics.clear();
    }
    EquationsOfMotion {
        inertia: vec![inertia],
        ground_damping: vec![0.0],
        reference: vec![0],
        connections: vec![Connection {
            name: shaft.name.clone(),
            from: Some((0, 1.0)),
            to: None,
            law: TorqueLaw::Polynomial(PolynomialLaw::new(restoring)),
            damping: shaft.damping,
            damps_in_gap: true,
            friction: None,
            engagement: None,
            loss_factor: 0.0,
            inertance: 0.0,
        }],
        nodes: vec![NodePlace {
            name: equations.nodes[node].name.clone(),
            group: 0,
            ratio: 1.0,
            inertia,
        }],
        network: Network {
            ends: vec![[Some((0, 1.0)), None]],
            grounded: true,
            tree: vec![TreeShaft { shaft: 0, parent: None, child: (0, 1.0), from_parent: false }],
            loops: Vec::new(),
            unreached: Vec::new(),
        },
        rigid: None,
        excitation,
        meshes: 0,
        modal_damping: 0.0,
    }
}

impl SingleEquation {
    /// What `θ` is, as a sentence.
    pub(crate) fn variable(&self, shaft: &str) -> String {
        format!(
            "{shaft}.twist is θ, the advance of the load end over the equilibrium: the shaft itself \
             is twisted by {:.6} rad - θ; {shaft}.torque is the torque of the shaft",
            self.static_twist
        )
    }

    /// The equation with its numbers.
    pub(crate) fn formula(&self) -> String {
        let Oscillator { omega, alpha, gamma, mu } = self.oscillator;
        format!(
            "θ'' + {:.6} θ + {alpha:.6} θ' {} θ³ {} θ² = 0",
            omega * omega,
            signed(gamma),
            signed(-mu)
        )
    }
}

fn signed(value: f64) -> String {
    if value < 0.0 { format!("- {:.6}", -value) } else { format!("+ {value:.6}") }
}
