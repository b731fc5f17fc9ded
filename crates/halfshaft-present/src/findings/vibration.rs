//! How far the shafts swing at resonance.

use halfshaft_results::{ReportResult, ResonanceResult};

use super::{Finding, Standing, limit_twist, rest_twist};
use crate::words::{frequency_words, percent, plain, quantity};

/// The largest response of the strongest exciting order.
pub(super) fn vibration(report: &ReportResult) -> Option<Finding> {
    let result = report.resonance.as_ref()?;
    let (index, rho) = largest(result)?;
    let scaling = result.scaling.get(index)?;
    let peak = result.peaks.get(index)?;
    let frequency = peak.get("frequency").copied()?;
    let torque = peak.get(&format!("{}.torque.harmonic1", scaling.shaft));
    let torque = torque.map_or_else(String::new, |torque| {
        format!(" and its torque by ±{}", quantity(*torque, 4, "N·m"))
    });
    let mut text = format!(
        "At {} the twist of the {} swings by ±{}{torque}",
        frequency_words(frequency),
        plain(&scaling.shaft),
        quantity(rho, 4, "rad")
    );
    let statics = report.statics.as_ref();
    let rest = statics.and_then(|statics| rest_twist(statics, &scaling.shaft)).unwrap_or(0.0);
    let limit = |side: f64| limit_twist(statics?, &scaling.shaft, side);
    // Room to the limits on both sides of the state about which it swings.
    let rooms = [limit(1.0).map(|limit| limit - rest), limit(-1.0).map(|limit| limit + rest)];
    let room = rooms.into_iter().flatten().filter(|room| *room > 0.0).reduce(f64::min);
    let standing = match room {
        Some(room) => {
            text += &format!(
                ", {} of the {} that are left to the limit of its law",
                percent(rho / room, 3),
                quantity(room, 4, "rad")
            );
            Standing::of_margin(room / rho)
        }
        None => {
            text += "; no law has a limit to hold that against";
            Standing::Open
        }
    };
    Some(Finding::new(standing, "Resonance", text + "."))
}

/// Which exciting order swings most, and how far.
fn largest(result: &ResonanceResult) -> Option<(usize, f64)> {
    let peaks = result.peaks.iter().enumerate();
    let rho = peaks.filter_map(|(index, peak)| Some((index, *peak.get("rho")?)));
    rho.filter(|(_, rho)| rho.is_finite()).max_by(|a, b| a.1.total_cmp(&b.1))
}
