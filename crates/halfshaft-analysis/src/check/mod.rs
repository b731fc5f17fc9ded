//! The line as the program understands it.

mod shaft;
mod sheet;

use halfshaft_dynamics::{EquationsOfMotion, NodePlace, Source};
use halfshaft_model::Driveline;
use halfshaft_model::elements::{MeanTorque, Pulse, PulseShape, WholeLine};
use halfshaft_model::question::Question;
use halfshaft_results::{
    CheckResult, CheckedGear, CheckedGrowth, CheckedHarmonic, CheckedLine, CheckedMesh,
    CheckedPulse, CheckedTorque, Member, ReducedInertia,
};

use shaft::shaft;

use crate::error::AnalysisError;
use crate::header::header;

/// Answers `check`.
pub(crate) fn solve(line: &Driveline) -> Result<CheckResult, AnalysisError> {
    let freedom = EquationsOfMotion::new(line)?.groups();
    // Drawings and tables have each bar in one piece.
    let whole = &*line.with_whole_bars();
    let equations = EquationsOfMotion::new(whole)?;
    let listed = line.torques().len();
    Ok(CheckResult {
        header: header(line, &Question::Check),
        description: line.description().to_owned(),
        grounded: equations.network.grounded,
        degrees_of_freedom: freedom,
        mass_elastic: Some(sheet::sheet(line, whole, &equations)),
        line: of_the_whole(line.whole()),
        reduced_inertias: reduced(line, &equations),
        gears: line
            .gears()
            .iter()
            .map(|gear| CheckedGear {
                name: gear.name.clone(),
                input: gear.input.clone(),
                output: gear.output.clone(),
                ratio: gear.ratio,
                ratios: gear.ratios.clone(),
                mesh: gear.mesh_at_output().map(|[stiffness, damping, clearance]| CheckedMesh {
                    stiffness,
                    damping,
                    clearance,
                }),
            })
            .collect(),
        // Connections begin with the shafts.
        shafts: whole
            .shafts()
            .iter()
            .zip(&equations.connections)
            .enumerate()
            .map(|(index, (element, connection))| {
                // The line's own shafts come first, and those of dampers after them.
                shaft(element, line.shafts().get(index), connection)
            })
            .collect(),
        torques: line
            .torques()
            .iter()
            .map(torque)
            .chain(
                equations.excitation.sources.iter().skip(listed).map(|s| of_engine(&equations, s)),
            )
            .collect(),
    })
}

/// What is said of the line as a whole, if anything is.
fn of_the_whole(whole: &WholeLine) -> Option<CheckedLine> {
    let told = CheckedLine {
        modal_damping: whole.modal_damping,
        loss_factor: whole.loss_factor,
        operating: whole.operating_rad_s,
    };
    (*whole != WholeLine::default()).then_some(told)
}

fn reduced(line: &Driveline, equations: &EquationsOfMotion) -> Vec<ReducedInertia> {
    let damping = |name: &str| {
        let inertia = line.inertias().iter().find(|inertia| inertia.name == name);
        inertia.map_or(0.0, |inertia| inertia.damping_nm_s_per_rad)
    };
    let group = |(index, inertia): (usize, &f64)| ReducedInertia {
        reference: equations.nodes[equations.reference[index]].name.clone(),
        inertia: *inertia,
        members: equations
            .nodes
            .iter()
            .filter(|node| node.group == index)
            .map(|node| Member {
                node: node.name.clone(),
                inertia: node.inertia,
                ratio: node.ratio,
                damping: damping(&node.name),
            })
            .collect(),
    };
    equations.inertia.iter().enumerate().map(group).collect()
}

/// A torque of an engine.
fn of_engine(equations: &EquationsOfMotion, source: &Source) -> CheckedTorque {
    // The node is the one that turns with the source.
    let fits = |node: &&NodePlace| node.group == source.group && node.ratio == source.ratio;
    CheckedTorque {
        name: source.name.clone(),
        on: equations.nodes.iter().find(fits).map(|node| node.name.clone()).unwrap_or_default(),
        mean: Some(source.mean),
        harmonics: source
            .harmonics
            .iter()
            .map(|harmonic| CheckedHarmonic {
                order: harmonic.order,
                amplitude: harmonic.amplitude_nm,
                phase: harmonic.phase_rad,
            })
            .collect(),
        pulse: None,
        growth: (source.speed_power != 0.0).then_some(CheckedGrowth {
            power: source.speed_power,
            reference_speed: source.reference_speed,
        }),
    }
}

fn torque(torque: &halfshaft_model::elements::Torque) -> CheckedTorque {
    CheckedTorque {
        name: torque.name.clone(),
        on: torque.on.clone(),
        mean: match torque.mean {
            MeanTorque::Value(value) => Some(value),
            MeanTorque::Balance => None,
        },
        harmonics: torque
            .harmonics
            .iter()
            .filter(|harmonic| harmonic.amplitude_nm != 0.0)
            .map(|harmonic| CheckedHarmonic {
                order: harmonic.order,
                amplitude: harmonic.amplitude_nm,
                phase: harmonic.phase_rad,
            })
            .collect(),
        pulse: torque.pulse.as_ref().map(pulse),
        growth: torque
            .speed_power
            .zip(torque.reference_speed_rad_s)
            .filter(|(power, _)| *power != 0.0)
            .map(|(power, reference_speed)| CheckedGrowth { power, reference_speed }),
    }
}

fn pulse(pulse: &Pulse) -> CheckedPulse {
    CheckedPulse {
        shape: pulse.shape.name().to_owned(),
        peak: (pulse.shape != PulseShape::Impulse).then_some(pulse.peak_nm),
        start: pulse.start_s,
        duration: pulse.duration_s,
        angular_impulse: pulse.angular_impulse(),
    }
}
