//! Order spectra: amplitudes over the orders of the excitation, at every speed of a run.
//!
//! The channel is sampled at even phases of the excitation, so that an order stays in its line however the
//! speed moves. Blocks of whole revolutions under Hann's window, three quarters of each shared with the next.

use halfshaft_numerics::harmonics::{Sampler, Spectrum};
use halfshaft_results::OrderMap;

/// Phases of a motion whose excitation speed may move: `θ = Ω t + a t² / 2`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Phases {
    pub(super) speed: f64,
    pub(super) acceleration: f64,
}

impl Phases {
    /// Phase at a time, rad.
    fn phase(&self, t: f64) -> f64 {
        (self.speed + 0.5 * self.acceleration * t) * t
    }

    /// Time of a phase; `None` where the excitation stops before.
    pub(super) fn time(&self, phase: f64) -> Option<f64> {
        let root = (self.speed * self.speed + 2.0 * self.acceleration * phase).sqrt();
        let time = 2.0 * phase / (self.speed + root);
        time.is_finite().then_some(time)
    }

    fn speed_at_phase(&self, phase: f64) -> f64 {
        (self.speed * self.speed + 2.0 * self.acceleration * phase).max(0.0).sqrt()
    }
}

/// Samples of one channel at even phases, and the places of all twists at whole revolutions.
#[derive(Clone, Debug)]
pub(super) struct Track {
    phases: Phases,
    /// Channel that is sampled.
    pub(super) channel: usize,
    per_revolution: usize,
    /// Number of the first sample, and of the next.
    first: usize,
    next: usize,
    samples: Vec<f64>,
}

/// Samples at most: beyond, nothing is tracked.
const MOST_SAMPLES: f64 = 4e6;
/// Highest order that is told, as a multiple of the highest excited one, and at least.
const HIGHEST: f64 = 4.0;
const LEAST_HIGHEST: f64 = 8.0;
const MOST_ORDERS: f64 = 64.0;
/// Revolutions of a block, where there are enough.
const REVOLUTIONS: usize = 16;
/// Blocks that a run has at least; else they are shorter.
const LEAST_BLOCKS: usize = 8;
/// Revolutions of a block at least.
const LEAST_REVOLUTIONS: usize = 4;
/// Orders cut out at most.
const MOST_CUTS: usize = 6;

impl Track {
    /// A track of a channel over the recorded time; `orders` are the excited ones.
    pub(super) fn new(
        phases: Phases,
        channel: usize,
        orders: &[f64],
        record: (f64, f64),
    ) -> Option<Self> {
        let excited = orders.iter().copied().fold(0.0, f64::max);
        let highest = (HIGHEST * excited).clamp(LEAST_HIGHEST, MOST_ORDERS).max(excited).ceil();
        let per_revolution = 4.0 * highest;
        let turns = |t: f64| phases.phase(t) / std::f64::consts::TAU;
        let (from, to) = (turns(record.0) * per_revolution, turns(record.1) * per_revolution);
        if !(to - from < MOST_SAMPLES && from >= 0.0) || excited == 0.0 {
            return None;
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "bounded")]
        let (per_revolution, first) = (per_revolution as usize, from.ceil() as usize);
        Some(Self { phases, channel, per_revolution, first, next: first, samples: Vec::new() })
    }

    /// Time of the next sample.
    pub(super) fn next_time(&self) -> Option<f64> {
        let turn = self.next as f64 / self.per_revolution as f64;
        self.phases.time(std::f64::consts::TAU * turn)
    }

    /// Whether the next sample begins a revolution.
    pub(super) fn begins_revolution(&self) -> bool {
        self.next.is_multiple_of(self.per_revolution)
    }

    /// Takes the next sample.
    pub(super) fn take(&mut self, value: f64) {
        self.samples.push(value);
        self.next += 1;
    }

    /// The spectra; `None` for fewer revolutions than a few blocks.
    pub(super) fn spectra(&self, (name, unit): (&str, &str), excited: &[f64]) -> Option<OrderMap> {
        let whole = self.samples.len() / self.per_revolution;
        // An even number has half orders in its lines.
        let revolutions = REVOLUTIONS.min(2 * whole / LEAST_BLOCKS) / 2 * 2;
        if revolutions < LEAST_REVOLUTIONS {
            return None;
        }
        let block = revolutions * self.per_revolution;
        let highest = self.per_revolution / 4;
        let count = highest * revolutions + 1;
        let mut sampler = Sampler::new(block);
        let mut spectrum = Spectrum::default();
        let (mut speed, mut amplitude) = (Vec::new(), Vec::new());
        let mut from = 0;
        while from + block <= self.samples.len() {
            let mut windowed: Vec<f64> = self.samples[from..from + block].to_vec();
            let mean = windowed.iter().sum::<f64>() / block as f64;
            for (k, value) in windowed.iter_mut().enumerate() {
                let turn = std::f64::consts::TAU * k as f64 / block as f64;
                *value = (*value - mean) * (1.0 - turn.cos());
            }
            sampler.spectrum(&mut windowed, &mut spectrum);
            let moduli = spectrum.values().iter().take(count);
            amplitude.push(moduli.map(|value| 2.0 * value.modulus()).collect::<Vec<f64>>());
            let middle = (self.first + from + block / 2) as f64 / self.per_revolution as f64;
            speed.push(self.phases.speed_at_phase(std::f64::consts::TAU * middle));
            from += block / 4;
        }
        let order: Vec<f64> = (0..count).map(|k| k as f64 / revolutions as f64).collect();
        let cuts = cuts(&order, &amplitude, excited);
        Some(OrderMap {
            channel: name.to_owned(),
            unit: unit.to_owned(),
            revolutions,
            frequency: speed,
            order,
            amplitude,
            cuts,
        })
    }
}

/// The orders whose amplitudes are worth a curve: those excited, then the strongest whole and half ones.
fn cuts(order: &[f64], amplitude: &[Vec<f64>], excited: &[f64]) -> Vec<f64> {
    let largest = |at: usize| amplitude.iter().map(|row| row[at]).fold(0.0, f64::max);
    let mut chosen: Vec<f64> = excited.iter().copied().take(MOST_CUTS).collect();
    let half = |order: f64| (2.0 * order).fract() == 0.0 && order > 0.0;
    let mut others: Vec<(f64, f64)> = order
        .iter()
        .enumerate()
        .filter(|(_, order)| half(**order) && !chosen.contains(order))
        .map(|(at, order)| (*order, largest(at)))
        .collect();
    others.sort_by(|a, b| b.1.total_cmp(&a.1));
    let most = others.first().map_or(0.0, |first| first.1);
    let telling = others.into_iter().filter(|(_, size)| *size > 0.02 * most);
    chosen.extend(telling.map(|(order, _)| order).take(MOST_CUTS.saturating_sub(chosen.len())));
    chosen.sort_by(f64::total_cmp);
    chosen
}
