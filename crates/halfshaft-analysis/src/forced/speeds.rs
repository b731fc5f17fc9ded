//! The speeds at which the vibration is told.

use halfshaft_model::question::ForcedQuestion;

use crate::error::AnalysisError;
use crate::modal::damping_ratio;
use crate::modal::vibration::Vibration;

/// Equally spaced speeds where nobody says how many.
const SPACED: u32 = 400;
/// Further speeds about a resonance, in half widths of its peak.
const ABOUT: [f64; 17] =
    [-12.0, -6.0, -3.0, -2.0, -1.4, -1.0, -0.6, -0.3, 0.0, 0.3, 0.6, 1.0, 1.4, 2.0, 3.0, 6.0, 12.0];
/// Least half width of a peak over its speed that is resolved: without damping there is none.
const NARROWEST: f64 = 1e-5;
/// Half width of a peak in steps of the spaced speeds that needs no further ones.
const BROAD: f64 = 2.0;
/// Modes whose resonances are looked at.
const MODES: usize = 60;
/// Part of the upper end from which a range begins by itself: at zero speed a free line runs away.
const BEGINNING: f64 = 1e-3;

/// Speeds of a question for one gear, ascending, rad/s.
pub(super) fn speeds(
    vibration: &Vibration,
    question: &ForcedQuestion,
    orders: &[f64],
    (from, to): (f64, f64),
) -> Result<Vec<f64>, AnalysisError> {
    let from = if question.frequency.is_none() { from.max(BEGINNING * to) } else { from };
    let spaced = |count: usize| -> Vec<f64> {
        #[expect(clippy::cast_precision_loss, reason = "bounded")]
        let part = |k: usize| k as f64 / (count.max(2) - 1) as f64;
        (0..count).map(|k| from + (to - from) * part(k)).collect()
    };
    if let Some(points) = question.points {
        return Ok(spaced(points));
    }
    let mut speeds = spaced(SPACED as usize);
    let step = (to - from) / f64::from(SPACED);
    for (critical, ratio) in resonances(vibration, orders)? {
        let width = ratio.max(NARROWEST);
        if critical * width > BROAD * step {
            continue; // seen anyway
        }
        // An undamped line has no value at the resonance itself.
        let about = ABOUT.iter().filter(|part| **part != 0.0 || width > NARROWEST);
        speeds.extend(about.map(|part| critical * (1.0 + part * width)));
    }
    speeds.retain(|speed| *speed >= from && *speed <= to && *speed > 0.0);
    speeds.sort_by(f64::total_cmp);
    speeds.dedup();
    Ok(speeds)
}

/// Speeds at which orders meet modes, and the half width of the peak over the speed: the damping ratio.
fn resonances(vibration: &Vibration, orders: &[f64]) -> Result<Vec<(f64, f64)>, AnalysisError> {
    let modes = vibration.modes(MODES)?;
    let pairs = vibration.damped(&modes)?.elastic;
    let each = modes.iter().zip(pairs).flat_map(|(mode, pair)| {
        let (natural, ratio) = (mode.frequency(), damping_ratio(pair).abs());
        orders.iter().map(move |order| (natural / order, ratio))
    });
    Ok(each.collect())
}

/// A warning where speeds that someone has spaced may step over a peak.
pub(super) fn too_wide(
    vibration: &Vibration,
    question: &ForcedQuestion,
    orders: &[f64],
) -> Result<Option<String>, AnalysisError> {
    let (Some(points), Some((from, to))) = (question.points, question.frequency) else {
        return Ok(None);
    };
    #[expect(clippy::cast_precision_loss, reason = "bounded")]
    let step = (to - from) / points.max(2).saturating_sub(1) as f64;
    let narrow = resonances(vibration, orders)?
        .into_iter()
        .any(|(speed, ratio)| speed > from && speed < to && speed * ratio < step);
    Ok(narrow.then(|| {
        "some peaks are narrower than the step between the speeds: leave --points out, or take more, \
         to see how high they are"
            .to_owned()
    }))
}
