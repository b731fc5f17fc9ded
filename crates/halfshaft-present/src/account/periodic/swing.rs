//! Where the response is largest, and how large it is there.

use crate::reading::{Reading, Sample};
use crate::words::{angle, capital, frequency_words, quantity};

/// A largest response.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Peak {
    /// Where it lies.
    pub(crate) x: f64,
    /// Half of peak to peak of the twist that is told, rad.
    pub(crate) swing: f64,
    /// The same of the torque of that shaft, N·m.
    pub(crate) torque: Option<f64>,
    /// Whether it is stable.
    pub(crate) stable: bool,
}

/// The largest response that a slow sweep can reach, or any where there is none such; of the stable
/// ones alone where that is asked.
pub(crate) fn largest(reading: &Reading<'_>, only_stable: bool) -> Option<Peak> {
    let samples = reading.samples();
    let reached = |sample: &&Sample| {
        let branch = reading.result.branches.get(sample.branch);
        branch.is_some_and(|branch| !branch.is_detached() && branch.periods <= 1)
    };
    let any = !samples.iter().any(|sample| reached(&sample));
    let wanted = samples.iter().filter(|sample| any || reached(sample));
    let wanted = wanted.filter(|sample| sample.stable || !only_stable);
    let top = wanted.max_by(|a, b| a.swing.total_cmp(&b.swing))?;
    let sampled =
        Peak { x: top.x, swing: top.swing, torque: torque(reading, top), stable: top.stable };
    Some(located(reading, &sampled).unwrap_or(sampled))
}

/// The peak as the analysis located it, where that is the one which the samples show.
fn located(reading: &Reading<'_>, sampled: &Peak) -> Option<Peak> {
    let column = reading.swing_column();
    let peaks = reading.result.peaks.iter().filter_map(|peak| {
        let (x, swing) = (*peak.get(&reading.x.column)?, *peak.get(&column)?);
        let same = swing >= 0.999 * sampled.swing && swing <= 1.1 * sampled.swing;
        let torque = torque_columns(reading).find_map(|name| peak.get(&name).copied());
        same.then_some(Peak { x, swing, torque: torque.or(sampled.torque), ..*sampled })
    });
    peaks.max_by(|a, b| a.swing.total_cmp(&b.swing))
}

/// Columns of the torque of the shaft that is told, the best first.
fn torque_columns(reading: &Reading<'_>) -> impl Iterator<Item = String> + use<> {
    let shaft = reading.channel.as_deref().and_then(|channel| channel.strip_suffix(".twist"));
    let shaft = shaft.map(str::to_owned);
    ["amplitude", "harmonic1"]
        .into_iter()
        .filter_map(move |measure| Some(format!("{}.torque.{measure}", shaft.as_ref()?)))
}

/// Swing of the torque at a sample.
fn torque(reading: &Reading<'_>, sample: &Sample) -> Option<f64> {
    let branch = reading.result.branches.get(sample.branch)?;
    let row = branch.values(&reading.x.column).iter().position(|x| *x == sample.x)?;
    torque_columns(reading).find_map(|name| branch.values(&name).get(row).copied())
}

/// The peak as sentences.
pub(super) fn told(reading: &Reading<'_>) -> String {
    let (Some(peak), Some((low, high))) = (largest(reading, false), reading.range()) else {
        return String::new();
    };
    let shaft = reading.shaft().unwrap_or_else(|| "line".to_owned());
    let swings = swings(&peak);
    let edge = (peak.x - low).min(high - peak.x) <= 1e-6 * (high - low);
    let mut text = if reading.x.is_speed() && edge {
        format!(
            "The {shaft} swings most at an end of the range, at {}: {swings}. The resonance itself may \
             lie outside the range.",
            frequency_words(peak.x)
        )
    } else if reading.x.is_speed() {
        format!("Excitation drives the {shaft} most at {}: {swings}.", frequency_words(peak.x))
    } else {
        let speed = fixed_speed(reading).map_or_else(String::new, |speed| {
            format!("at an excitation speed of {}, ", frequency_words(speed))
        });
        let (name, place) = (reading.x.name(), reading.x.told(peak.x));
        capital(&format!("{speed}the {shaft} swings most where the {name} is {place}: {swings}."))
    };
    if !peak.stable
        && let Some(stable) = largest(reading, true)
    {
        text += &format!(
            " That response is not stable; the largest stable one swings by ±{}, at {}.",
            angle(stable.swing),
            reading.x.told(stable.x)
        );
    } else if !peak.stable {
        text += " No response in the range is stable.";
    }
    text
}

fn swings(peak: &Peak) -> String {
    let torque = peak.torque.filter(|torque| torque.is_finite());
    let torque = torque.map_or_else(String::new, |torque| {
        format!(", its torque by ±{}", quantity(torque, 5, "N·m"))
    });
    format!("its twist swings by ±{}{torque}", angle(peak.swing))
}

/// The excitation speed that stays while a parameter is gone through, rad/s.
pub(super) fn fixed_speed(reading: &Reading<'_>) -> Option<f64> {
    let branch = reading.result.branches.first()?;
    branch.values("frequency").first().copied().or_else(|| {
        reading.result.header.settings.pointer("/frequency/0").and_then(serde_json::Value::as_f64)
    })
}
