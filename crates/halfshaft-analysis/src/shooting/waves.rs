//! What an orbit looks like: samples of angles, turning points of twists.

use super::flow::Step;
use super::series::{Series, evaluate};

/// A turning point of a twist.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Turn {
    /// Time, s.
    pub(crate) time: f64,
    /// Twist there, rad.
    pub(crate) twist: f64,
    /// Whether it is a maximum.
    pub(crate) top: bool,
}

/// Parts of a step that are looked at for a turn each.
const PARTS: usize = 6;

impl Step<'_> {
    /// Angles of the groups at a time within the step.
    pub(crate) fn angles(&self, time: f64, out: &mut [f64]) {
        for (series, out) in self.angles.iter().zip(out) {
            *out = evaluate(series, time - self.from).0;
        }
    }

    /// Adds the turning points of the twist of a connection within the step.
    pub(crate) fn turns(&self, connection: usize, out: &mut Vec<Turn>) {
        let twist = &self.twists[connection];
        let rate = |t: f64| evaluate(twist, t).1;
        let part = self.length / PARTS as f64;
        for index in 0..PARTS {
            let (low, high) = (part * index as f64, part * (index + 1) as f64);
            let (before, behind) = (rate(low), rate(high));
            if (before > 0.0) == (behind > 0.0) || low == high {
                continue;
            }
            let time = turning(twist, low, high, before > 0.0);
            let value = evaluate(twist, time).0;
            out.push(Turn { time: self.from + time, twist: value, top: before > 0.0 });
        }
    }
}

/// Where the rate changes its sign, by halving.
fn turning(twist: &Series, mut low: f64, mut high: f64, falling: bool) -> f64 {
    for _ in 0..60 {
        let middle = f64::midpoint(low, high);
        if middle <= low || middle >= high {
            break;
        }
        if (evaluate(twist, middle).1 > 0.0) == falling {
            low = middle;
        } else {
            high = middle;
        }
    }
    f64::midpoint(low, high)
}

/// Angles of the groups at `count` times spread evenly over a period, group by group.
#[derive(Clone, Debug)]
pub(crate) struct Sampled {
    spacing: f64,
    count: usize,
    at: usize,
    scratch: Vec<f64>,
    pub(crate) angles: Vec<Vec<f64>>,
}

impl Sampled {
    pub(crate) fn new(groups: usize, count: usize, period: f64) -> Self {
        Self {
            spacing: period / count as f64,
            count,
            at: 0,
            scratch: vec![0.0; groups],
            angles: vec![Vec::with_capacity(count); groups],
        }
    }

    /// Takes the samples that fall into a step.
    pub(crate) fn see(&mut self, step: &Step<'_>) {
        while self.at < self.count {
            let time = self.at as f64 * self.spacing;
            if time > step.from + step.length {
                break;
            }
            step.angles(time, &mut self.scratch);
            for (list, angle) in self.angles.iter_mut().zip(&self.scratch) {
                list.push(*angle);
            }
            self.at += 1;
        }
    }
}

/// The swing of twists and rates over an orbit: half of peak to peak of each, seen at a few times of
/// every step.
#[derive(Clone, Debug)]
pub(crate) struct Swing {
    connections: Vec<usize>,
    reference: f64,
    /// Least and greatest twist and rate of each connection.
    ranges: Vec<[f64; 4]>,
}

/// Times of a step at which the swing is seen.
const LOOKS: u32 = 4;

impl Swing {
    /// Of the given connections; rates count over a reference speed.
    pub(crate) fn new(connections: Vec<usize>, reference: f64) -> Self {
        let none = [f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY];
        Self { ranges: vec![none; connections.len()], connections, reference }
    }

    /// Takes in a step.
    pub(crate) fn see(&mut self, step: &Step<'_>) {
        for (connection, range) in self.connections.iter().zip(&mut self.ranges) {
            for look in 0..LOOKS {
                let t = step.length * f64::from(look) / f64::from(LOOKS);
                let (twist, rate) = evaluate(&step.twists[*connection], t);
                let rate = rate / self.reference;
                range[0] = range[0].min(twist);
                range[1] = range[1].max(twist);
                range[2] = range[2].min(rate);
                range[3] = range[3].max(rate);
            }
        }
    }

    /// Euclidean length of all swings.
    pub(crate) fn size(&self) -> f64 {
        let of = |r: &[f64; 4]| 0.25 * ((r[1] - r[0]).powi(2) + (r[3] - r[2]).powi(2));
        self.ranges.iter().map(of).sum::<f64>().sqrt()
    }
}
