//! The range of speeds that is shown where nobody gives one.

use halfshaft_dynamics::EquationsOfMotion;

use crate::averaging::{ModeEquation, default_window};
use crate::equilibrium::RestStates;
use crate::error::AnalysisError;
use crate::modal::elastic::lowest_modes;

/// Range about the resonances of an elastic mode (from 1) with all orders of the torques.
pub(super) fn default_range(
    equations: &EquationsOfMotion,
    states: &RestStates,
    mode: usize,
) -> Result<(f64, f64), AnalysisError> {
    let Some(rest) = states.primary() else {
        let reason = "so no mode tells where its resonance is; give --frequency".to_owned();
        return Err(AnalysisError::NoEquilibrium { reason });
    };
    let mut range: Option<(f64, f64)> = None;
    for order in equations.excitation.orders() {
        let (low, high) = match ModeEquation::new(equations, rest, mode, order) {
            Ok(averaged) => default_window(&averaged),
            Err(AnalysisError::NoSuchMode { asked, found }) => {
                return Err(AnalysisError::NoSuchMode { asked, found });
            }
            Err(_) => about(equations, &rest.twists, mode, order)?,
        };
        range = Some(range.map_or((low, high), |(a, b)| (a.min(low), b.max(high))));
    }
    let (low, high) = range.unwrap_or((0.0, 1.0));
    Ok((low.max(1e-3 * high), high))
}

/// Half of the natural frequency to either side.
fn about(
    equations: &EquationsOfMotion,
    twists: &[f64],
    mode: usize,
    order: f64,
) -> Result<(f64, f64), AnalysisError> {
    let modes = lowest_modes(equations, twists, mode)?;
    let Some(asked) = modes.get(mode - 1) else {
        return Err(AnalysisError::NoSuchMode { asked: mode, found: modes.len() });
    };
    let natural = asked.frequency() / order;
    if natural == 0.0 {
        return Err(AnalysisError::MethodDoesNotFit {
            method: "harmonic-balance",
            reason: format!(
                "mode {mode} has no stiffness at rest, so that no natural frequency tells where to look; \
                 give --frequency A..B"
            ),
        });
    }
    Ok((0.5 * natural, 1.5 * natural))
}
