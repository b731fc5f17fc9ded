//! The closed form of a single equation as a motion over time.

use halfshaft_model::question::{ChannelQuantity, ShockQuestion};
use halfshaft_numerics::bracket::{RootSettings, find_root};
use halfshaft_numerics::observer::Observer;
use halfshaft_results::ShaftMetrics;

use super::full::{self, disturbance_end, has_pulse};
use super::metrics::{Response, between, metrics};
use super::multiple_scales::{Expansion, MultipleScales};
use super::single::SingleEquation;
use crate::error::AnalysisError;
use crate::time_response::{TracePoint, TurningPoint};

/// A motion that is integrated until the pulses have ended and closed from then on: the closed
/// form is of the free vibration.
pub(crate) struct ClosedMotion<'s> {
    single: &'s SingleEquation,
    closed: MultipleScales,
    /// When the closed form begins, s.
    pub(crate) from: f64,
    /// What happens before: trace and turning points of the twist, turning points of its rate.
    before: Before,
}

#[derive(Clone, Debug, Default)]
struct Before {
    trace: Vec<TracePoint>,
    turning: Vec<TurningPoint>,
    rate_turning: Vec<TurningPoint>,
}

/// Trace points in one period of the small vibration.
const POINTS_PER_PERIOD: f64 = 128.0;

impl<'s> ClosedMotion<'s> {
    /// The motion from `θ(0)`, `θ'(0)` as in `start` by multiple scales.
    pub(crate) fn new(
        single: &'s SingleEquation,
        question: &ShockQuestion,
        start: (f64, f64),
        expansion: Expansion,
        observer: &dyn Observer,
    ) -> Result<Self, AnalysisError> {
        let line = &single.surrogate;
        if line.excitation.has_ramp() {
            return Err(AnalysisError::MethodDoesNotFit {
                method: "multiple-scales",
                reason: "a ramp shifts the equilibrium about which it expands".to_owned(),
            });
        }
        let (mut x, mut v) = start;
        let from = if has_pulse(line) { disturbance_end(line).min(question.duration) } else { 0.0 };
        let mut before = Before::default();
        if from > 0.0 {
            let until_free = ShockQuestion { duration: from, step: None, ..question.clone() };
            let run = full::integrate(line, &[x, v, 0.0, 0.0], &until_free, observer)?;
            if !run.termination.is_complete() {
                let reached = run.termination.detail.unwrap_or_default();
                return Err(AnalysisError::EndedEarly { doing: "the pulse was acting", reached });
            }
            let channel = |quantity| run.recorder.channels().of_connection(0, quantity);
            let (twist, rate) =
                (channel(ChannelQuantity::Twist), channel(ChannelQuantity::TwistRate));
            before = Before {
                trace: run.recorder.traces[twist].clone(),
                turning: run.recorder.turning[twist].clone(),
                rate_turning: run.recorder.turning[rate].clone(),
            };
            if let Some(last) = before.trace.last() {
                (x, v) = (last.value, last.slope);
            }
        }
        // An impulse at the very end changes the speed at once.
        v += line.excitation.impulses_at(from, 1)[0] / line.inertia[0];
        let closed = MultipleScales::new(single.oscillator, expansion, x, v)?;
        Ok(Self { single, closed, from, before })
    }

    /// `(θ, θ')` at time `t`.
    pub(crate) fn at(&self, t: f64) -> (f64, f64) {
        if t >= self.from {
            return self.closed.at(t - self.from);
        }
        let trace = &self.before.trace;
        let after = trace.partition_point(|point| point.time < t).max(1);
        match (trace.get(after - 1), trace.get(after)) {
            (Some(a), Some(b)) => {
                let point = between(a, b, t);
                (point.value, point.slope)
            }
            _ => (0.0, 0.0),
        }
    }

    /// Torque of the shaft for `θ` and `θ'`, N·m.
    pub(crate) fn torque(&self, x: f64, v: f64) -> f64 {
        let connection = &self.single.surrogate.connections[0];
        self.single.static_torque - connection.law.torque(x) - connection.damping * v
    }

    /// A fine trace up to `duration`.
    pub(crate) fn trace(&self, duration: f64) -> Vec<TracePoint> {
        let mut trace = self.before.trace.clone();
        trace.extend(self.free_trace(duration));
        trace
    }

    fn free_trace(&self, duration: f64) -> Vec<TracePoint> {
        let step = std::f64::consts::TAU / self.single.oscillator.omega / POINTS_PER_PERIOD;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "bounded")]
        let count = ((duration - self.from) / step).ceil().clamp(1.0, 2e6) as u32;
        let point = |k: u32| {
            let time = self.from + (duration - self.from) * f64::from(k) / f64::from(count);
            let (value, slope) = self.at(time);
            TracePoint { time, value, slope }
        };
        (0..=count).map(point).collect()
    }

    /// Metrics of the motion.
    pub(crate) fn metrics(&self, duration: f64) -> ShaftMetrics {
        let free = self.free_trace(duration);
        let trace = self.trace(duration);
        let peak_torque = trace
            .iter()
            .map(|point| TurningPoint {
                time: point.time,
                value: self.torque(point.value, point.slope),
            })
            .max_by(|a, b| a.value.abs().total_cmp(&b.value.abs()))
            .unwrap_or(TurningPoint { time: 0.0, value: 0.0 });
        let mut turning = self.before.turning.clone();
        turning.extend(turning_points(&free, |t| self.at(t).0, |t| self.at(t).1));
        let acceleration = |t: f64| {
            let h = 1e-6 * (1.0 + t);
            (self.at(t + h).1 - self.at((t - h).max(self.from)).1) / (2.0 * h)
        };
        let mut rate_turning = self.before.rate_turning.clone();
        rate_turning.extend(turning_points(&free, |t| self.at(t).1, acceleration));
        metrics(&Response {
            trace: &trace,
            turning: &turning,
            rate_turning: &rate_turning,
            rest: 0.0,
            free_from: self.from,
            peak_torque,
            static_torque: self.single.static_torque,
        })
    }
}

/// Turning points of a function between the times of a fine trace.
///
/// A start at rest is no turning point, though rounding may let the rate change its sign there.
fn turning_points(
    trace: &[TracePoint],
    value: impl Fn(f64) -> f64,
    slope: impl Fn(f64) -> f64,
) -> Vec<TurningPoint> {
    let turn = |pair: &[TracePoint]| {
        let (from, to) = (pair[0].time, pair[1].time);
        if slope(from) * slope(to) >= 0.0 {
            return None;
        }
        let root = find_root(&slope, from, to, RootSettings::default()).ok()?;
        let at_start = root.value - trace[0].time < 1e-6 * (to - from);
        (!at_start).then(|| TurningPoint { time: root.value, value: value(root.value) })
    };
    trace.windows(2).filter_map(turn).collect()
}
