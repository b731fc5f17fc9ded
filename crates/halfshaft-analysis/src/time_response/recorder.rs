//! Watching an integration: the history on a grid, turning points, extremes.

use halfshaft_numerics::bracket::{RootSettings, find_root};
use halfshaft_numerics::ode::DenseStep;

use halfshaft_dynamics::Motion;

use super::channels::{Channels, Sample};
use super::orders::Track;
use super::roughness::Roughness;
use halfshaft_results::{ChannelMetrics, Named, NodeMetrics};

/// A local extreme of a channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TurningPoint {
    pub(crate) time: f64,
    pub(crate) value: f64,
}

/// Value and slope of a channel at one time, close enough together for cubics between them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TracePoint {
    pub(crate) time: f64,
    pub(crate) value: f64,
    pub(crate) slope: f64,
}

/// What is kept of a run.
pub(crate) struct Recorder<'l> {
    channels: Channels<'l>,
    /// Times of the history.
    grid: Vec<f64>,
    next: usize,
    record: (f64, f64),
    /// One column a channel.
    pub(crate) history: Vec<Vec<f64>>,
    /// Turning points of the channels that are followed, in order of time.
    pub(crate) turning: Vec<Vec<TurningPoint>>,
    /// Fine traces of the followed channels.
    pub(crate) traces: Vec<Vec<TracePoint>>,
    followed: Vec<bool>,
    extremes: Vec<Extremes>,
    roughness: Roughness,
    /// Samples at even phases of the excitation, and the states at whole revolutions.
    pub(super) track: Option<Track>,
    pub(super) section: Vec<Vec<f64>>,
    before: Option<Sample>,
    /// Scratch for a state and its rate of change.
    state: Vec<f64>,
    rate: Vec<f64>,
}

#[derive(Clone, Copy, Debug)]
struct Extremes {
    minimum: TurningPoint,
    maximum: TurningPoint,
    integral: f64,
}

impl Extremes {
    fn none() -> Self {
        let at = |value| TurningPoint { time: 0.0, value };
        Self { minimum: at(f64::INFINITY), maximum: at(f64::NEG_INFINITY), integral: 0.0 }
    }

    fn take(&mut self, time: f64, value: f64) {
        let point = TurningPoint { time, value };
        if value < self.minimum.value {
            self.minimum = point;
        }
        if value > self.maximum.value {
            self.maximum = point;
        }
    }
}

/// Parts of a step at which slopes are looked at; the steps of an 8th-order method are up to
/// a tenth of a period, so two turning points never share a part.
const PARTS: u32 = 6;

impl<'l> Recorder<'l> {
    /// A recorder of all channels on the grid `record.0 + k step`; turning points are kept of
    /// the channels that `followed` marks.
    pub(crate) fn new(
        channels: Channels<'l>,
        record: (f64, f64),
        step: f64,
        followed: Vec<bool>,
    ) -> Self {
        let count = channels.list.len();
        // A grid that should end on the end time does so despite rounding.
        let steps = ((record.1 - record.0) / step * (1.0 + 1e-12) + 1e-9).floor();
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "bounded")]
        let steps = steps as usize;
        #[expect(clippy::cast_precision_loss, reason = "at most 2e7 samples")]
        let grid: Vec<f64> =
            (0..=steps).map(|k| (record.0 + step * k as f64).min(record.1)).collect();
        Self {
            history: vec![Vec::with_capacity(grid.len()); count],
            turning: vec![Vec::new(); count],
            traces: vec![Vec::new(); count],
            extremes: vec![Extremes::none(); count],
            roughness: Roughness::new(&channels),
            track: None,
            section: Vec::new(),
            before: None,
            state: vec![0.0; channels.dimension()],
            rate: vec![0.0; channels.dimension()],
            channels,
            grid,
            next: 0,
            record,
            followed,
        }
    }

    pub(crate) fn channels(&self) -> &Channels<'l> {
        &self.channels
    }

    /// Times of the samples that were reached.
    pub(crate) fn times(&self) -> &[f64] {
        &self.grid[..self.history.first().map_or(0, Vec::len)]
    }

    /// Takes the initial state.
    pub(crate) fn start(&mut self, time: f64, state: &[f64], rate: &[f64]) {
        let mut sample = Sample::default();
        self.channels.sample(time, state, rate, &mut sample);
        while self.next < self.grid.len() && self.grid[self.next] <= time {
            self.keep(&sample);
        }
        self.measure(&sample);
        self.before = Some(sample);
    }

    /// Takes a jump of the state at the start of a step: what follows does not join what came
    /// before. A sample of the history at that very time is the state after the jump.
    pub(crate) fn jump(&mut self, dense: &DenseStep<'_>, time: f64) {
        let sample = self.sample(dense, time);
        if self.next > 0 && self.grid[self.next - 1] == time {
            for column in &mut self.history {
                column.pop();
            }
            self.next -= 1;
            self.keep(&sample);
        }
        self.measure(&sample);
        self.before = Some(sample);
    }

    /// Takes over the modes and pulses of a motion as they are from time `t` on.
    pub(crate) fn follow(&mut self, motion: &Motion<'l>, t: f64) {
        self.channels.follow(motion, t);
    }

    /// Takes one accepted step.
    pub(crate) fn step(&mut self, dense: &DenseStep<'_>, from: f64, to: f64) {
        let (begin, end) = (from.max(self.record.0), to.min(self.record.1));
        if begin > end {
            return;
        }
        // What is measured begins and ends with the record, not with a step.
        if self.before.as_ref().is_none_or(|before| before.time != begin) {
            let sample = self.sample(dense, begin);
            self.measure(&sample);
            self.before = Some(sample);
        }
        while self.next < self.grid.len() && self.grid[self.next] <= to {
            let sample = self.sample(dense, self.grid[self.next]);
            self.keep(&sample);
        }
        self.track(dense, to);
        for part in 1..=PARTS {
            let share = f64::from(part) / f64::from(PARTS);
            let time = if part == PARTS { end } else { begin + (end - begin) * share };
            let sample = self.sample(dense, time);
            if let Some(before) = self.before.take() {
                self.between(dense, &before, &sample);
                self.roughness.between(&before, &sample);
            }
            self.measure(&sample);
            self.before = Some(sample);
        }
    }

    fn sample(&mut self, dense: &DenseStep<'_>, time: f64) -> Sample {
        dense.evaluate(time, &mut self.state);
        for (component, rate) in self.rate.iter_mut().enumerate() {
            *rate = dense.derivative(component, time);
        }
        let mut sample = Sample::default();
        self.channels.sample(time, &self.state, &self.rate, &mut sample);
        sample
    }

    /// Samples at even phases of the excitation until the end of a step.
    fn track(&mut self, dense: &DenseStep<'_>, to: f64) {
        let Some(mut track) = self.track.take() else { return };
        while let Some(time) = track.next_time().filter(|time| *time <= to.min(self.record.1)) {
            let sample = self.sample(dense, time);
            if track.begins_revolution() {
                let mut row = vec![time];
                row.extend(self.channels.of_section().map(|at| sample.values[at]));
                self.section.push(row);
            }
            track.take(sample.values[track.channel]);
        }
        self.track = Some(track);
    }

    fn keep(&mut self, sample: &Sample) {
        for (column, value) in self.history.iter_mut().zip(&sample.values) {
            column.push(*value);
        }
        self.next += 1;
    }

    fn in_record(&self, time: f64) -> bool {
        time >= self.record.0 && time <= self.record.1
    }

    fn measure(&mut self, sample: &Sample) {
        if !self.in_record(sample.time) {
            return;
        }
        for (extremes, value) in self.extremes.iter_mut().zip(&sample.values) {
            extremes.take(sample.time, *value);
        }
        for (channel, trace) in self.traces.iter_mut().enumerate() {
            if self.followed[channel] {
                let (value, slope) = (sample.values[channel], sample.slopes[channel]);
                trace.push(TracePoint { time: sample.time, value, slope });
            }
        }
    }

    /// Turning points and the integral between two samples inside a step.
    fn between(&mut self, dense: &DenseStep<'_>, before: &Sample, after: &Sample) {
        let width = after.time - before.time;
        for channel in 0..before.values.len() {
            let (v0, v1) = (before.values[channel], after.values[channel]);
            let (s0, s1) = (before.slopes[channel], after.slopes[channel]);
            // Hermite quadrature: exact for cubics.
            let integral = width * (v0 + v1) / 2.0 + width * width * (s0 - s1) / 12.0;
            self.extremes[channel].integral += integral;
            let turns = (s0 < 0.0 && s1 >= 0.0) || (s0 > 0.0 && s1 <= 0.0);
            if !turns || width <= 0.0 {
                continue;
            }
            let estimate = v0 + width * s0 * s0 / (2.0 * (s0 - s1));
            let (low, high) =
                (self.extremes[channel].minimum.value, self.extremes[channel].maximum.value);
            let slack = 1e-2 * low.abs().max(high.abs());
            let could_be_extreme = estimate > high - slack || estimate < low + slack;
            if self.followed[channel] || could_be_extreme {
                self.turn(dense, channel, before.time, after.time);
            }
        }
    }

    /// Locates a turning point of a channel between two times.
    fn turn(&mut self, dense: &DenseStep<'_>, channel: usize, from: f64, to: f64) {
        let settings = RootSettings::default();
        let slope = |time| self.sample(dense, time).slopes[channel];
        let Ok(root) = find_root(slope, from, to, settings) else { return };
        let value = self.sample(dense, root.value).values[channel];
        self.extremes[channel].take(root.value, value);
        if self.followed[channel] {
            self.turning[channel].push(TurningPoint { time: root.value, value });
        }
    }

    /// How the nodes turn over the recorded time.
    pub(crate) fn nodes(&self) -> Named<NodeMetrics> {
        self.roughness.metrics(|channel| self.metrics(channel))
    }

    /// The value of largest magnitude of a channel over the recorded time.
    pub(crate) fn largest(&self, channel: usize) -> TurningPoint {
        let Extremes { minimum, maximum, .. } = self.extremes[channel];
        if -minimum.value > maximum.value { minimum } else { maximum }
    }

    /// Extremes, half of peak to peak and mean of a channel over the recorded time.
    pub(crate) fn metrics(&self, channel: usize) -> ChannelMetrics {
        let Extremes { minimum, maximum, integral } = self.extremes[channel];
        let (minimum, maximum) = (minimum.value, maximum.value);
        let reached = self.before.as_ref().map_or(self.record.0, |sample| sample.time);
        let length = reached.min(self.record.1) - self.record.0;
        if !minimum.is_finite() || !maximum.is_finite() {
            return ChannelMetrics::default();
        }
        let mean = if length > 0.0 { integral / length } else { minimum };
        ChannelMetrics { minimum, maximum, amplitude: (maximum - minimum) / 2.0, mean }
    }
}
