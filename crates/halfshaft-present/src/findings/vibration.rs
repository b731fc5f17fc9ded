//! How far the shafts swing at resonance.

use halfshaft_results::{ModeScaling, Named, ReportResult, ResonanceResult, StaticResult};

use super::{Finding, Standing, limit_twist, rest_twist};
use crate::words::{frequency_words, percent, plain, quantity};

/// The largest response of the strongest exciting order.
pub(super) fn vibration(report: &ReportResult) -> Option<Finding> {
    let result = report.best_resonance()?;
    if result.scaling.is_empty() {
        return super::periodic::vibration(report, result);
    }
    let (index, rho) = largest(result)?;
    let scaling = result.scaling.get(index)?;
    let shaft = plain(&scaling.shaft);
    let room = room(report.statics.as_ref(), &scaling.shaft);
    if let Some(room) = room.filter(|room| rho >= *room) {
        let text = format!(
            "Mode {}: the averaged response would swing the twist of the {shaft} by ±{}, past the {} \
             that are left to the limit of its law: the shaft gives way, and what lies beyond means \
             nothing.",
            scaling.mode,
            quantity(rho, 4, "rad"),
            quantity(room, 4, "rad")
        );
        return Some(Finding::new(Standing::Unsafe, "Resonance", text));
    }
    let text = swing(scaling, result.peaks.get(index)?, rho, room)?;
    Some(match room {
        Some(room) => Finding::new(Standing::of_margin(room / rho), "Resonance", text + "."),
        None => {
            let text = text + "; no law has a limit to hold that against.";
            Finding::new(Standing::Note, "Resonance", text)
        }
    })
}

/// Where a mode swings most, how far, and what that is of the room.
fn swing(scaling: &ModeScaling, peak: &Named<f64>, rho: f64, room: Option<f64>) -> Option<String> {
    let frequency = peak.get("frequency").copied()?;
    let share = room.map_or_else(String::new, |room| {
        let left = quantity(room, 4, "rad");
        format!(" ({} of the {left} left to the limit of its law)", percent(rho / room, 3))
    });
    let torque = peak.get(&format!("{}.torque.harmonic1", scaling.shaft));
    let torque = torque.map_or_else(String::new, |torque| {
        format!(", and its torque by ±{}", quantity(*torque, 4, "N·m"))
    });
    Some(format!(
        "Mode {}: at {} the twist of the {} swings by ±{}{share}{torque}",
        scaling.mode,
        frequency_words(frequency),
        plain(&scaling.shaft),
        quantity(rho, 4, "rad")
    ))
}

/// Room to the nearer limit of a shaft's law, on both sides of the state about which it swings.
pub(super) fn room(statics: Option<&StaticResult>, shaft: &str) -> Option<f64> {
    let statics = statics?;
    let rest = rest_twist(statics, shaft).unwrap_or(0.0);
    let limit = |side: f64| limit_twist(statics, shaft, side);
    let rooms = [limit(1.0).map(|limit| limit - rest), limit(-1.0).map(|limit| limit + rest)];
    rooms.into_iter().flatten().filter(|room| *room > 0.0).reduce(f64::min)
}

/// Which exciting order swings most, and how far.
fn largest(result: &ResonanceResult) -> Option<(usize, f64)> {
    let peaks = result.peaks.iter().enumerate();
    let rho = peaks.filter_map(|(index, peak)| Some((index, *peak.get("rho")?)));
    rho.filter(|(_, rho)| rho.is_finite()).max_by(|a, b| a.1.total_cmp(&b.1))
}
