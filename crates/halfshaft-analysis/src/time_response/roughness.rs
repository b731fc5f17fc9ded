//! How roughly the nodes of a line turn: acceleration and jerk.

use halfshaft_model::question::ChannelQuantity;
use halfshaft_results::{ChannelMetrics, Named, NodeMetrics};

use super::channels::{Channels, Sample};
use super::recorder::TurningPoint;

/// Largest accelerations and jerks of the nodes.
#[derive(Clone, Debug)]
pub(super) struct Roughness {
    /// Name of each node and the channel of its speed.
    nodes: Vec<(String, usize)>,
    acceleration: Vec<TurningPoint>,
    jerk: Vec<TurningPoint>,
}

impl Roughness {
    pub(super) fn new(channels: &Channels<'_>) -> Self {
        let suffix = format!(".{}", ChannelQuantity::Speed.word());
        let speed = |(at, info): (usize, &super::channels::ChannelInfo)| {
            Some((info.name.strip_suffix(&suffix)?.to_owned(), at))
        };
        let nodes: Vec<(String, usize)> =
            channels.list.iter().enumerate().filter_map(speed).collect();
        let none = vec![TurningPoint { time: 0.0, value: 0.0 }; nodes.len()];
        Self { nodes, acceleration: none.clone(), jerk: none }
    }

    /// Takes two samples of one step.
    pub(super) fn between(&mut self, before: &Sample, after: &Sample) {
        let width = after.time - before.time;
        for (at, (_, channel)) in self.nodes.iter().enumerate() {
            let (a, b) = (before.slopes[*channel], after.slopes[*channel]);
            for (time, value) in [(before.time, a), (after.time, b)] {
                take(&mut self.acceleration[at], time, value);
            }
            if width > 0.0 {
                take(&mut self.jerk[at], before.time + 0.5 * width, (b - a) / width);
            }
        }
    }

    /// The metrics, with the extremes of the speeds from their channels.
    pub(super) fn metrics(
        &self,
        of_channel: impl Fn(usize) -> ChannelMetrics,
    ) -> Named<NodeMetrics> {
        let of = |(at, (name, channel)): (usize, &(String, usize))| {
            let speed = of_channel(*channel);
            // A node that stands still in between has no speed to be uneven about.
            let turns = speed.minimum * speed.maximum > 0.0;
            let irregularity = (2.0 * speed.amplitude / speed.mean).abs();
            let (acceleration, jerk) = (self.acceleration[at], self.jerk[at]);
            let metrics = NodeMetrics {
                speed_irregularity: (turns && irregularity.is_finite()).then_some(irregularity),
                peak_acceleration: acceleration.value,
                peak_acceleration_time: acceleration.time,
                peak_jerk: jerk.value,
                peak_jerk_time: jerk.time,
            };
            (name.clone(), metrics)
        };
        self.nodes.iter().enumerate().map(of).collect()
    }
}

fn take(most: &mut TurningPoint, time: f64, value: f64) {
    if value.abs() > most.value.abs() {
        *most = TurningPoint { time, value };
    }
}
