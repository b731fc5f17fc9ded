//! The line as the program understands it.

mod shaft;

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_model::Driveline;
use halfshaft_model::elements::{MeanTorque, Pulse, PulseShape};
use halfshaft_model::question::Question;
use halfshaft_results::{
    CheckResult, CheckedGear, CheckedGrowth, CheckedHarmonic, CheckedMesh, CheckedPulse,
    CheckedTorque, Member, ReducedInertia,
};

use shaft::shaft;

use crate::error::AnalysisError;
use crate::header::header;

/// Answers `check`.
pub(crate) fn solve(line: &Driveline) -> Result<CheckResult, AnalysisError> {
    let equations = EquationsOfMotion::new(line)?;
    Ok(CheckResult {
        header: header(line, &Question::Check),
        description: line.description().to_owned(),
        grounded: equations.network.grounded,
        degrees_of_freedom: equations.groups(),
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
                mesh: gear.stiffness_nm_per_rad.map(|stiffness| CheckedMesh {
                    stiffness,
                    damping: gear.damping_nm_s_per_rad.unwrap_or(0.0),
                    clearance: gear.clearance_rad.unwrap_or(0.0),
                }),
            })
            .collect(),
        // Connections begin with the shafts.
        shafts: line
            .shafts()
            .iter()
            .zip(&equations.connections)
            .map(|(element, connection)| shaft(element, connection))
            .collect(),
        torques: line.torques().iter().map(torque).collect(),
    })
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
