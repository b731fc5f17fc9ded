//! Which planes of fold curves a report shows, and how far they reach.

use halfshaft_model::Driveline;
use halfshaft_model::question::ParameterRange;
use halfshaft_results::{FoldsResult, ModeScaling, ReportResult, ResonanceResult};

/// Parameters and ranges that hold both the model's own value and the cusp of the closed form, where
/// there is one; wide ones about the model's own value where there is no closed form.
pub(super) fn planes(line: &Driveline, report: &ReportResult) -> Vec<ParameterRange> {
    let closed = report.closed_form.as_ref().and_then(|form| form.scaling.first());
    match closed {
        Some(scaling) => about_cusps(line, scaling),
        None => report.best_resonance().map_or_else(Vec::new, |best| about_model(line, best)),
    }
}

/// Part of the speed of resonance at which a plane begins: the folds of the resonances of second and
/// third order are above it. Below, ever narrower ones crowd together at torques that throw the line
/// over its capacity, with dozens of harmonics each, and no picture resolves them.
const LOWEST: f64 = 0.25;

/// The speeds of a plane in closed form that hold all its curves, with as much again on both sides, as
/// far as they belong to the resonance; `None` where it has no curve.
pub(super) fn speeds(plane: &FoldsResult, scaling: &ModeScaling) -> Option<(f64, f64)> {
    let all = plane.curves.iter().flat_map(|curve| curve.values("frequency")).copied();
    let (low, high) = all
        .filter(|speed| speed.is_finite())
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
    let margin = (high - low).max(1e-3 * high);
    let resonance = scaling.omega_1 / scaling.order;
    // Curves may be all below that: then it is their own speeds that matter.
    let lowest = (LOWEST * resonance).min(0.5 * high);
    (low <= high).then(|| ((low - margin).max(0.3 * low).max(lowest), high + margin))
}

/// Planes about the model's own values.
fn about_model(line: &Driveline, resonance: &ResonanceResult) -> Vec<ParameterRange> {
    let mut planes = Vec::new();
    let mut add = |address: String, own: f64, most: f64| {
        if line.parameter(&address).is_ok() && own.is_finite() && own != 0.0 {
            let (from, to) = (0.05 * own, most * own);
            planes.push(ParameterRange { address, from: from.min(to), to: from.max(to) });
        }
    };
    let following = line.torques().iter().filter(|torque| torque.frequency_rad_s.is_none());
    let loud: Vec<_> = following.filter(|torque| torque.harmonics[0].amplitude_nm != 0.0).collect();
    if let [torque] = loud.as_slice() {
        add(format!("{}.amplitude", torque.name), torque.harmonics[0].amplitude_nm, 4.0);
    }
    let channel = resonance.leading_channel().unwrap_or_default();
    let name = channel.strip_suffix(".twist").unwrap_or_default();
    if let Some(shaft) = line.shafts().iter().find(|shaft| shaft.name == name) {
        add(format!("{name}.damping"), shaft.damping_nm_s_per_rad, 4.0);
    }
    planes
}

/// Planes that hold the cusps of the closed form.
fn about_cusps(line: &Driveline, scaling: &ModeScaling) -> Vec<ParameterRange> {
    let mut planes = Vec::new();
    let mut add = |address: String, from: f64, to: f64| {
        if line.parameter(&address).is_ok() && from < to {
            planes.push(ParameterRange { address, from, to });
        }
    };
    // The excitation scales all amplitudes of its order together only where there is one.
    let loud: Vec<_> = line
        .torques()
        .iter()
        .filter(|torque| torque.harmonics[0].amplitude_nm != 0.0)
        .filter(|torque| torque.harmonics[0].order == scaling.order)
        .collect();
    if let ([torque], Some(factor)) = (loud.as_slice(), scaling.fold_threshold_factor) {
        let own = torque.harmonics[0].amplitude_nm.abs();
        let to = own * (1.6 * factor).max(1.4);
        add(format!("{}.amplitude", torque.name), own * 1e-3, to);
    }
    let shaft = line.shafts().iter().find(|shaft| shaft.name == scaling.shaft);
    if let Some(shaft) = shaft.filter(|shaft| shaft.damping_nm_s_per_rad > 0.0) {
        let own = shaft.damping_nm_s_per_rad;
        let critical = own * critical_damping(scaling) / scaling.beta;
        if critical.is_finite() && critical > 0.0 {
            add(
                format!("{}.damping", shaft.name),
                (0.25 * critical).min(0.5 * own),
                (1.6 * critical).max(1.2 * own),
            );
        }
    }
    if let Some(shaft) = shaft.filter(|shaft| shaft.cubic_nm_per_rad3 != 0.0) {
        let own = shaft.cubic_nm_per_rad3;
        let reach = 2.0 * own.abs();
        add(format!("{}.cubic", shaft.name), -reach, reach);
    }
    planes
}

/// Damping coefficient below which the response folds at the model's own excitation:
/// `β_c³ = 9 √3 |α| f²/(32 ω1³)` (theory 5).
fn critical_damping(scaling: &ModeScaling) -> f64 {
    let ModeScaling { alpha, f, omega_1, .. } = scaling;
    (9.0 * 3.0_f64.sqrt() * alpha.abs() * f * f / (32.0 * omega_1.powi(3))).cbrt()
}
