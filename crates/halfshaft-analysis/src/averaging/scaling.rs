//! The scaling of a line to the oscillator of the theory, said in full.

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_results::{ModeScaling, Named};

use super::mode_equation::ModeEquation;

/// The scaling as a result.
pub(crate) fn scaling(
    equations: &EquationsOfMotion,
    mode: &ModeEquation,
    label: String,
) -> ModeScaling {
    let flow = mode.slow_flow();
    let shaft = equations.connections[mode.reference].name.clone();
    let threshold = flow.threshold();
    let names = equations.connections.iter().map(|connection| connection.name.clone());
    let coefficients: Named<f64> =
        (2..8).map(|power| (format!("x{power}"), mode.restoring[power])).collect();
    ModeScaling {
        mode: mode.mode,
        label,
        statement: statement(mode, &shaft),
        shaft,
        modal_inertia: mode.inertia,
        order: mode.order,
        omega_1: mode.omega,
        alpha: mode.alpha(),
        beta: mode.beta,
        f: mode.f,
        kappa: flow.backbone[0],
        coefficients,
        twist_per_x: names.zip(mode.twist_per_x.iter().copied()).collect(),
        fold_threshold_f: threshold.map(|(drive, _)| 2.0 * mode.omega * drive),
        fold_threshold_factor: threshold
            .filter(|_| mode.f > 0.0)
            .map(|(drive, _)| 2.0 * mode.omega * drive / mode.f),
        fold_threshold_rho: threshold.map(|(_, z)| z.sqrt()),
    }
}

fn statement(mode: &ModeEquation, shaft: &str) -> String {
    let speed = if mode.order == 1.0 { "Ω".to_owned() } else { format!("{} Ω", mode.order) };
    let quadratic = if mode.restoring[2] == 0.0 {
        String::new()
    } else {
        format!(
            "; the quadratic term {:.6} about the loaded equilibrium softens the cubic one {:.6} to \
             alpha",
            mode.restoring[2], mode.restoring[3]
        )
    };
    format!(
        "x is the twist of the {shaft} beyond {:.6} rad, unscaled (eps = 1): x'' + {:.6}² x + ({:.6}) \
         x³ + {:.6} x' = {:.6} cos({speed} t), modal inertia {:.6} kg·m²{quadratic}",
        mode.rest_twists[mode.reference],
        mode.omega,
        mode.alpha(),
        mode.beta,
        mode.f,
        mode.inertia
    )
}
