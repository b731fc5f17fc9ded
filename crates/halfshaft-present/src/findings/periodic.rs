//! What harmonic balance or the first harmonic find: how far shafts swing, and how far the line is
//! from a jump.

use halfshaft_results::{ReportResult, ResonanceResult, StaticResult};

use super::reserve::excitation;
use super::{COMFORTABLE, Finding, Standing, jumps, rest_twist, vibration::room};
use crate::account::periodic::{losses, unstable_gaps};
use crate::reading::{Reading, bounds};
use crate::words::{frequency_words, number, percent, plain, quantity};

/// How far a shaft swings where it does so most.
struct Swing {
    shaft: String,
    /// Excitation speed, rad/s.
    speed: f64,
    /// Half of peak to peak of the twist, rad.
    swing: f64,
    /// How far the twist goes from rest, rad: the mean moves as well.
    reach: f64,
    /// Half of peak to peak of the torque, N·m.
    torque: Option<f64>,
    /// What is left to the limit of its law from rest, rad.
    room: Option<f64>,
}

impl Swing {
    /// Room over reach; infinite where no law has a limit.
    fn margin(&self) -> f64 {
        self.room.map_or(f64::INFINITY, |room| room / self.reach)
    }
}

/// The shaft that swings nearest to the limit of its law, or else the one that swings most.
pub(super) fn vibration(report: &ReportResult, result: &ResonanceResult) -> Option<Finding> {
    let swings = swings(result, report.statics.as_ref());
    let tightest = swings.iter().filter(|swing| swing.room.is_some());
    let tightest = tightest.min_by(|a, b| a.margin().total_cmp(&b.margin()));
    let swing = tightest.or_else(|| swings.iter().max_by(|a, b| a.swing.total_cmp(&b.swing)))?;
    let place = format!(
        "At {} the twist of the {} swings by ±{}",
        frequency_words(swing.speed),
        swing.shaft,
        quantity(swing.swing, 4, "rad")
    );
    let torque = swing.torque.map_or_else(String::new, |torque| {
        format!(", and its torque by ±{}", quantity(torque, 4, "N·m"))
    });
    Some(match swing.room {
        Some(room) if swing.reach >= room => {
            let text = format!(
                "{place}, past the {} that are left to the limit of its law: the shaft gives way, and \
                 what lies beyond means nothing.",
                quantity(room, 4, "rad")
            );
            Finding::new(Standing::Unsafe, "Resonance", text)
        }
        Some(room) => {
            let share = percent(swing.reach / room, 3);
            let left = quantity(room, 4, "rad");
            let text =
                format!("{place} ({share} of the {left} left to the limit of its law){torque}.");
            Finding::new(Standing::of_margin(swing.margin()), "Resonance", text)
        }
        None => {
            let text = format!("{place}{torque}; no law has a limit to hold that against.");
            Finding::new(Standing::Note, "Resonance", text)
        }
    })
}

/// The largest swing of every shaft, on the responses that a slow sweep shows.
fn swings(result: &ResonanceResult, statics: Option<&StaticResult>) -> Vec<Swing> {
    let mut swings: Vec<Swing> = Vec::new();
    for branch in result.branches.iter().filter(|branch| !branch.is_detached()) {
        let speeds = branch.values("frequency");
        for column in &branch.columns {
            let Some(shaft) = column.name.strip_suffix(".twist.amplitude") else { continue };
            let rows = column.values.iter().zip(speeds).enumerate();
            let finite = rows.filter(|(_, (swing, _))| swing.is_finite());
            let Some((row, (swing, speed))) = finite.max_by(|a, b| a.1.0.total_cmp(b.1.0)) else {
                continue;
            };
            let at = |name: String| branch.values(&name).get(row).copied();
            let rest = statics.and_then(|statics| rest_twist(statics, shaft));
            let moved = at(format!("{shaft}.twist.mean")).zip(rest);
            let moved = moved.map_or(0.0, |(mean, rest)| (mean - rest).abs());
            let found = Swing {
                shaft: plain(shaft),
                speed: *speed,
                swing: *swing,
                reach: swing + if moved.is_finite() { moved } else { 0.0 },
                torque: at(format!("{shaft}.torque.amplitude")),
                room: room(statics, shaft),
            };
            match swings.iter_mut().find(|known| known.shaft == found.shaft) {
                Some(known) if known.swing >= found.swing => {}
                Some(known) => *known = found,
                None => swings.push(found),
            }
        }
    }
    swings
}

/// Speeds at which no periodic response is stable: what the line does there is not known to be small.
pub(super) fn unsettled(report: &ReportResult) -> Option<Finding> {
    let reading = Reading::of(report.best_resonance()?);
    let gaps = unstable_gaps(&reading);
    if gaps.is_empty() {
        return None;
    }
    let places: Vec<String> =
        gaps.into_iter().map(|(from, to)| reading.x.between(from, to)).collect();
    let mut sentences = vec![format!(
        "No periodic response is stable {}: the line beats or wanders there.",
        crate::words::list(&places)
    )];
    sentences.extend(losses(&reading));
    Some(Finding::new(Standing::Unsafe, "Stability of the response", sentences.join(" ")))
}

/// What there is to say where no slow sweep jumps.
pub(super) fn no_jump(report: &ReportResult, result: &ResonanceResult) -> Finding {
    let reading = Reading::of(result);
    let mut sentences = Vec::new();
    let mut standing = Standing::Safe;
    for branch in result.branches.iter().filter(|branch| branch.is_detached()) {
        let x = branch.values(&reading.x.column).iter().copied();
        if let Some((from, to)) = bounds(x) {
            standing = Standing::Watch;
            sentences.push(format!(
                "A detached response exists {}: no slow sweep shows it, but a shock can throw the line \
                 onto it.",
                reading.x.between(from, to)
            ));
        }
    }
    let channel = reading.channel.as_deref().unwrap_or_default();
    let shaft = channel.strip_suffix(".twist").unwrap_or(channel);
    match excitation(report).filter(|threshold| threshold.factor() > 1.0) {
        Some(threshold) => {
            if threshold.factor() < COMFORTABLE {
                standing = Standing::Watch;
            }
            sentences.push(format!(
                "No jump: the excitation would have to be {}\u{a0}times larger{}.",
                number(threshold.factor(), 4),
                jumps::less_damping(report, shaft)
            ));
        }
        None => sentences.push("No slow sweep over the speeds shown jumps.".to_owned()),
    }
    Finding::new(standing, "Jumps", sentences.join(" "))
}
