//! The line as the program understands it.

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_model::Driveline;
use halfshaft_model::elements::{MeanTorque, Pulse, PulseShape, Shaft};
use halfshaft_model::question::Question;
use halfshaft_results::{
    CheckResult, CheckedGear, CheckedHarmonic, CheckedPulse, CheckedShaft, CheckedTorque, Member,
    NonlinearTerm, ReducedInertia,
};

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
            })
            .collect(),
        shafts: line.shafts().iter().map(shaft).collect(),
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

fn shaft(shaft: &Shaft) -> CheckedShaft {
    let terms = [
        ("quadratic", shaft.quadratic_nm_per_rad2, "N·m/rad²"),
        ("cubic", shaft.cubic_nm_per_rad3, "N·m/rad³"),
        ("quintic", shaft.quintic_nm_per_rad5, "N·m/rad⁵"),
        ("septic", shaft.septic_nm_per_rad7, "N·m/rad⁷"),
    ];
    let effect = |key: &str, coefficient: f64| match (key, coefficient > 0.0) {
        ("quadratic", true) => "stiffer to the positive side, softer to the negative",
        ("quadratic", false) => "softer to the positive side, stiffer to the negative",
        (_, true) => "hardening",
        (_, false) => "softening: limits the torque that the shaft carries",
    };
    CheckedShaft {
        name: shaft.name.clone(),
        from: shaft.from.clone(),
        to: shaft.to.clone(),
        stiffness: shaft.stiffness_nm_per_rad,
        damping: shaft.damping_nm_s_per_rad,
        nonlinear_terms: terms
            .into_iter()
            .filter(|(_, coefficient, _)| *coefficient != 0.0)
            .map(|(key, coefficient, unit)| NonlinearTerm {
                key: key.to_owned(),
                coefficient,
                unit: unit.to_owned(),
                effect: effect(key, coefficient).to_owned(),
            })
            .collect(),
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
