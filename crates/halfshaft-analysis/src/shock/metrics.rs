//! What engineers read off a shock response.

use halfshaft_numerics::bracket::{RootSettings, find_root};
use halfshaft_results::ShaftMetrics;

use crate::time_response::{TracePoint, TurningPoint};

/// A disturbed quantity over time: the twist of a shaft, or `θ`.
pub(crate) struct Response<'t> {
    /// Fine trace of the twist.
    pub(crate) trace: &'t [TracePoint],
    /// Turning points of the twist.
    pub(crate) turning: &'t [TurningPoint],
    /// Turning points of its rate.
    pub(crate) rate_turning: &'t [TurningPoint],
    /// Twist when all has settled, rad.
    pub(crate) rest: f64,
    /// End of the disturbance, s: the vibration is free from then on.
    pub(crate) free_from: f64,
    /// Torque of largest magnitude.
    pub(crate) peak_torque: TurningPoint,
    /// Torque before the disturbance, N·m.
    pub(crate) static_torque: f64,
}

/// Part of the largest peak within which the twist has settled.
const SETTLED: f64 = 0.05;
/// Turning points smaller than this part of the largest say nothing about frequency.
const SMALLEST: f64 = 1e-6;

/// Metrics of a response.
pub(crate) fn metrics(response: &Response<'_>) -> ShaftMetrics {
    let first = first_beyond_rounding(response.turning, response.rest);
    let first_rate = first_beyond_rounding(response.rate_turning, 0.0);
    let (oscillation_frequency, decay_rate) = oscillation(response);
    let damping_ratio = match (oscillation_frequency, decay_rate) {
        (Some(frequency), Some(decay)) => Some(decay / frequency.hypot(decay)),
        _ => None,
    };
    let loaded = response.static_torque.abs() > 1e-9 * response.peak_torque.value.abs();
    ShaftMetrics {
        first_peak: first.map(|point| point.value - response.rest),
        first_peak_time: first.map(|point| point.time),
        first_rate_peak: first_rate.map(|point| point.value),
        first_rate_peak_time: first_rate.map(|point| point.time),
        peak_torque: response.peak_torque.value,
        peak_torque_time: response.peak_torque.time,
        static_torque: response.static_torque,
        dynamic_factor: loaded.then(|| response.peak_torque.value / response.static_torque),
        settling_time: settling_time(response),
        final_torque: None,
        overshoot: None,
        oscillation_frequency,
        decay_rate,
        damping_ratio,
    }
}

/// The first turning point that is more than rounding about the rest before a late disturbance.
fn first_beyond_rounding(turning: &[TurningPoint], rest: f64) -> Option<TurningPoint> {
    let size = |point: &TurningPoint| (point.value - rest).abs();
    let largest = turning.iter().map(size).fold(0.0, f64::max);
    turning.iter().copied().find(|point| size(point) > SMALLEST * largest)
}

/// Frequency and decay of the free vibration, by least squares through its turning points:
/// they come every half period, and the logarithm of their differences falls evenly.
fn oscillation(response: &Response<'_>) -> (Option<f64>, Option<f64>) {
    let free: Vec<TurningPoint> =
        response.turning.iter().copied().filter(|point| point.time >= response.free_from).collect();
    let swing = |pair: &[TurningPoint]| (pair[1].value - pair[0].value).abs();
    let largest = free.windows(2).map(swing).fold(0.0, f64::max);
    let useful = free.windows(2).take_while(|pair| swing(pair) > SMALLEST * largest).count();
    if useful < 2 {
        return (None, None);
    }
    let free = &free[..=useful];
    #[expect(clippy::cast_precision_loss, reason = "numbers of turning points are small")]
    let times: Vec<(f64, f64)> =
        free.iter().enumerate().map(|(index, point)| (index as f64, point.time)).collect();
    let decays: Vec<(f64, f64)> = free
        .windows(2)
        .map(|pair| ((pair[0].time + pair[1].time) / 2.0, swing(pair).ln()))
        .collect();
    let frequency = slope(&times).filter(|half| *half > 0.0);
    (frequency.map(|half| std::f64::consts::PI / half), slope(&decays).map(|slope| -slope))
}

/// Slope of the straight line nearest to the points.
fn slope(points: &[(f64, f64)]) -> Option<f64> {
    #[expect(clippy::cast_precision_loss, reason = "numbers of turning points are small")]
    let count = points.len() as f64;
    let mean_x = points.iter().map(|point| point.0).sum::<f64>() / count;
    let mean_y = points.iter().map(|point| point.1).sum::<f64>() / count;
    let spread: f64 = points.iter().map(|(x, _)| (x - mean_x).powi(2)).sum();
    let shared: f64 = points.iter().map(|(x, y)| (x - mean_x) * (y - mean_y)).sum();
    (spread > 0.0).then(|| shared / spread)
}

/// Last time at which the twist is farther from rest than a part of its largest peak; `None`
/// where that may still come.
fn settling_time(response: &Response<'_>) -> Option<f64> {
    let peaks = response.turning.iter().map(|point| (point.value - response.rest).abs());
    let band = SETTLED * peaks.reduce(f64::max)?;
    let outside = |point: &TracePoint| (point.value - response.rest).abs() > band;
    let last = response.trace.iter().rposition(outside)?;
    let next = response.trace.get(last + 1)?;
    // One more quiet half period is needed to call it settled.
    let quiet = response.trace.last()?.time - next.time;
    let half_period = response.turning.windows(2).map(|p| p[1].time - p[0].time).next_back()?;
    (quiet > half_period).then(|| crossing(&response.trace[last], next, response.rest, band))
}

/// Time between two trace points at which the cubic through them enters the band.
fn crossing(from: &TracePoint, to: &TracePoint, rest: f64, band: f64) -> f64 {
    let excess = |time: f64| (between(from, to, time).value - rest).abs() - band;
    // The trace is fine, so the cubic crosses the border of the band once.
    find_root(excess, from.time, to.time, RootSettings::default())
        .map_or(to.time, |root| root.value)
}

/// The point at `time` on the cubic through two trace points with their slopes.
pub(crate) fn between(from: &TracePoint, to: &TracePoint, time: f64) -> TracePoint {
    let width = to.time - from.time;
    let s = (time - from.time) / width;
    let (s2, s3) = (s * s, s * s * s);
    let rise = (to.value - from.value) / width;
    TracePoint {
        time,
        value: from.value * (2.0 * s3 - 3.0 * s2 + 1.0)
            + to.value * (3.0 * s2 - 2.0 * s3)
            + width * from.slope * (s3 - 2.0 * s2 + s)
            + width * to.slope * (s3 - s2),
        slope: rise * 6.0 * (s - s2)
            + from.slope * (3.0 * s2 - 4.0 * s + 1.0)
            + to.slope * (3.0 * s2 - 2.0 * s),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Trace, turning points and rate turning points of `exp(-d t) cos(w t)`.
    fn decaying(w: f64, d: f64, end: f64) -> (Vec<TracePoint>, Vec<TurningPoint>) {
        let value = |t: f64| (-d * t).exp() * (w * t).cos();
        let slope = |t: f64| (-d * t).exp() * (-d * (w * t).cos() - w * (w * t).sin());
        let n = 4000;
        let trace = (0..=n)
            .map(|i| end * f64::from(i) / f64::from(n))
            .map(|time| TracePoint { time, value: value(time), slope: slope(time) })
            .collect();
        // Turning points where tan(w t) = -d/w.
        let first = (std::f64::consts::PI - (d / w).atan()) / w;
        let turning = (0..)
            .map(|k| first + f64::from(k) * std::f64::consts::PI / w)
            .take_while(|t| *t <= end)
            .map(|time| TurningPoint { time, value: value(time) })
            .collect();
        (trace, turning)
    }

    // Source: the closed form of the decaying cosine.
    #[test]
    fn metrics_of_a_decaying_cosine_are_exact() {
        let (w, d) = (9.0, 0.7);
        let (trace, turning) = decaying(w, d, 12.0);
        let response = Response {
            trace: &trace,
            turning: &turning,
            rate_turning: &[],
            rest: 0.0,
            free_from: 0.0,
            peak_torque: TurningPoint { time: 0.0, value: 2.0 },
            static_torque: 1.0,
        };
        let found = metrics(&response);
        assert!((found.oscillation_frequency.expect("oscillates") - w).abs() < 1e-10);
        assert!((found.decay_rate.expect("decays") - d).abs() < 1e-10);
        assert_eq!(found.dynamic_factor, Some(2.0));
        let settled = found.settling_time.expect("settles");
        let band = SETTLED * turning[0].value.abs();
        let size = |t: f64| ((-d * t).exp() * (w * t).cos()).abs();
        assert!((size(settled) - band).abs() < 1e-8);
        assert!((1..2000).all(|k| size(settled + f64::from(k) * 1e-3) < band));
    }
}
