//! Small vibrations of a line about its equilibrium: what `modes`, `campbell` and `forced` begin with.

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_model::Driveline;
use halfshaft_results::Gear;

use super::answer::choose_equilibrium;
use super::damped::{DampedPairs, damped};
use super::elastic::{ElasticMode, lowest_modes};
use crate::equilibrium::{self, RestState, RestStates};
use crate::error::AnalysisError;

/// A line with its equilibrium.
pub(crate) struct Vibration {
    pub(crate) equations: EquationsOfMotion,
    pub(crate) state: RestState,
}

impl Vibration {
    /// The line about the equilibrium of that number (from 1), or the stable one nearest to zero twist.
    pub(crate) fn of(line: &Driveline, number: Option<usize>) -> Result<Self, AnalysisError> {
        let equations = EquationsOfMotion::consistent(line)?;
        let states: RestStates = match number {
            Some(_) => equilibrium::find(&equations)?,
            None => equilibrium::find_stable(&equations)?,
        };
        let state = choose_equilibrium(line, &equations, &states, number)?.clone();
        Ok(Self { equations, state })
    }

    /// The lowest elastic modes.
    pub(crate) fn modes(&self, count: usize) -> Result<Vec<ElasticMode>, AnalysisError> {
        lowest_modes(&self.equations, &self.state.twists, count)
    }

    /// Damped eigenvalues of the lowest modes.
    pub(crate) fn damped(&self, modes: &[ElasticMode]) -> Result<DampedPairs, AnalysisError> {
        damped(&self.equations, modes, &self.state.twists)
    }

    /// What is assumed, and warned of.
    pub(crate) fn told(&self, header: &mut halfshaft_results::Header) {
        let nonlinear = self.equations.connections.iter().any(|c| !c.law.is_linear());
        header.assumptions.push(if nonlinear {
            "small vibrations about the equilibrium: each shaft acts by its tangent stiffness there"
                .to_owned()
        } else {
            "small vibrations about the equilibrium".to_owned()
        });
        header.assumptions.extend(super::answer::friction_left_out(&self.equations));
        header.warnings.extend(equilibrium::free_play(&self.equations, &self.state));
        if !self.state.stable {
            header.warnings.push("this equilibrium is not stable: small motions grow".to_owned());
        }
    }
}

/// A line in a gear, with its equilibrium there.
pub(crate) struct InGear {
    pub(crate) gear: Gear,
    pub(crate) line: Driveline,
    pub(crate) vibration: Vibration,
}

/// The gears of a question in which the line has a stable state; the others are warned of.
pub(crate) fn at_rest_in_gears(
    line: &Driveline,
    only_this: bool,
    header: &mut halfshaft_results::Header,
) -> Result<Vec<InGear>, AnalysisError> {
    let mut resting = Vec::new();
    for (gear, line) in gears(line, only_this)? {
        match Vibration::of(&line, None) {
            Ok(vibration) => resting.push(InGear { gear, line, vibration }),
            Err(AnalysisError::NoEquilibrium { reason }) => {
                let which = match (&gear.gearbox, gear.ratio) {
                    (Some(gearbox), Some(ratio)) => format!("{gearbox} at ratio {ratio}"),
                    _ => "the line".to_owned(),
                };
                header.warnings.push(format!("{which} is left out: {reason}"));
            }
            Err(error) => return Err(error),
        }
    }
    Ok(resting)
}

/// Every gear of every gearbox that lists its ratios, with the line in it; the line as it is where there
/// is none, or where only its gear is wanted.
pub(crate) fn gears(
    line: &Driveline,
    only_this: bool,
) -> Result<Vec<(Gear, Driveline)>, AnalysisError> {
    let mut gears = Vec::new();
    for gear in line.gears().iter().filter(|gear| gear.ratios.len() > 1 && !only_this) {
        let Ok(parameter) = line.parameter(&format!("{}.ratio", gear.name)) else { continue };
        for ratio in &gear.ratios {
            let which = Gear { gearbox: Some(gear.name.clone()), ratio: Some(*ratio) };
            gears.push((which, line.with(&parameter, *ratio)?));
        }
    }
    if gears.is_empty() {
        gears.push((Gear { gearbox: None, ratio: None }, line.clone()));
    }
    Ok(gears)
}
