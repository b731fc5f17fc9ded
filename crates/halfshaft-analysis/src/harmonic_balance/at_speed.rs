//! The responses of a line at one excitation speed as states of the motion.

use std::rc::Rc;

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_model::question::ResonanceQuestion;
use halfshaft_numerics::harmonics::HarmonicSet;
use halfshaft_numerics::observer::Observer;
use halfshaft_results::Named;

use super::answer::{Setting, by_harmonics, reference};
use super::branches::Collected;
use super::channels::named;
use super::measured::Measured;
use super::orbits::{coefficients_of, state_of};
use super::stability::Stability;
use super::tracer::Sample;
use crate::error::AnalysisError;
use crate::shooting::{Coordinates, Shooter};

/// A periodic response at one speed.
#[derive(Clone, Debug)]
pub(crate) struct Response {
    /// Periods of the excitation after which it repeats.
    pub(crate) periods: u32,
    /// The state at the beginning of each of these periods, as shooting sees it.
    pub(crate) states: Vec<Vec<f64>>,
    pub(crate) stability: Stability,
    /// Amplitude, mean and first harmonic of every channel, by its name.
    pub(crate) values: Named<f64>,
    /// Where its branch comes from; empty where it is on none.
    pub(crate) origin: String,
}

/// A line at one excitation speed.
pub(crate) struct AtSpeed {
    setting: Setting,
    frequency: f64,
}

/// Width of the range about the speed in which branches are followed, relative.
const WIDTH: f64 = 1e-6;
/// Highest order, over the excitation, of the harmonics that measure an orbit, and of all.
const ORDERS: usize = 48;
const MOST_ORDERS: usize = 240;
/// Orbits further than this from their guess, relative, are others.
const WANDERED: f64 = 0.05;

impl AtSpeed {
    pub(crate) fn new(
        equations: Rc<EquationsOfMotion>,
        frequency: f64,
    ) -> Result<Self, AnalysisError> {
        let range = (frequency, frequency * (1.0 + WIDTH));
        Ok(Self { setting: Setting::of_any(equations, Some(range), 1)?, frequency })
    }

    pub(crate) fn equations(&self) -> &EquationsOfMotion {
        &self.setting.line.equations
    }

    /// Twists of all connections at rest.
    pub(crate) fn rest(&self) -> &[f64] {
        &self.setting.rest
    }

    /// The shaft whose twist stands for the response.
    pub(crate) fn reference(&self) -> &str {
        reference(&self.setting)
    }

    /// Common period of the torques, s.
    pub(crate) fn period(&self) -> f64 {
        self.shooter(1).period(self.frequency)
    }

    pub(crate) fn coordinates(&self) -> Coordinates {
        self.shooter(1).coordinates()
    }

    fn shooter(&self, periods: u32) -> Shooter<'_> {
        let shooter = Shooter::new(self.equations(), self.setting.base, self.frequency, false);
        shooter.of_kind(self.setting.base / f64::from(periods), false)
    }

    /// All responses that `resonance` knows here.
    pub(crate) fn responses(&self, observer: &dyn Observer) -> Vec<Response> {
        let question =
            ResonanceQuestion { frequency: Some(self.setting.range), ..Default::default() };
        let collected = match super::exact::collect(&self.setting, &question, observer) {
            Some(collected) => collected,
            None => by_harmonics(&self.setting, &question, observer),
        };
        self.known(&collected)
    }

    /// The responses of branches, as exact orbits.
    fn known(&self, collected: &Collected) -> Vec<Response> {
        let coordinates = self.coordinates();
        let mut found: Vec<Response> = Vec::new();
        for branch in &collected.branches {
            let nearest = |sample: &&Sample| (sample.p - self.frequency).abs();
            let ends = [branch.samples.first(), branch.samples.last()];
            let mut ends: Vec<&Sample> = ends.into_iter().flatten().collect();
            ends.retain(|sample| nearest(sample) <= 0.5 * WIDTH * self.frequency);
            for sample in ends {
                let state = state_of(&self.setting.line, branch.base, sample, &coordinates);
                let Some(mut response) = self.orbit(&state, branch.periods) else { continue };
                let same = |other: &Response| {
                    other.periods == response.periods && other.passes(&response.states[0])
                };
                if !found.iter().any(same) {
                    response.origin.clone_from(&branch.origin);
                    found.push(response);
                }
            }
        }
        found
    }

    /// The periodic orbit next to a state, measured; `None` where there is none so near.
    pub(crate) fn orbit(&self, state: &[f64], periods: u32) -> Option<Response> {
        let mut shooter = self.shooter(periods);
        let orbit = shooter.at(state, self.frequency).ok()?;
        let away: Vec<f64> = orbit.state.iter().zip(state).map(|(a, b)| a - b).collect();
        let size = crate::shooting::length(state);
        if crate::shooting::length(&away) > WANDERED * size {
            return None;
        }
        let stability = Stability::of(orbit.multipliers().ok()?, false);
        let mut states = vec![orbit.state.clone()];
        for _ in 1..periods {
            let part = 1.0 / f64::from(periods);
            states.push(shooter.after(states.last()?, self.frequency, part, |_| {}).ok()?);
        }
        let highest = (ORDERS.max(self.setting.excited()) * periods as usize).min(MOST_ORDERS);
        let set = HarmonicSet::all(highest);
        let base = self.setting.base / f64::from(periods);
        let line = &self.setting.line;
        let u = coefficients_of(line, base, &mut shooter, &orbit, &set).ok()?;
        let sample = Sample {
            tangent: vec![0.0; u.len()],
            tangent_p: 1.0,
            metric: (1.0, 1.0),
            orientation: 1.0,
            truncation: 0.0,
            p: self.frequency,
            set,
            u,
        };
        let measured = Measured::new(&self.setting, None).values(&sample, base, periods);
        let values = named(self.equations(), &measured);
        Some(Response { periods, states, stability, values, origin: String::new() })
    }
}

impl Response {
    /// Whether a state is one of its own.
    pub(crate) fn passes(&self, state: &[f64]) -> bool {
        let size = self.states.iter().map(|own| crate::shooting::length(own)).fold(0.0, f64::max);
        let apart = |own: &Vec<f64>| {
            let d: Vec<f64> = own.iter().zip(state).map(|(a, b)| a - b).collect();
            crate::shooting::length(&d)
        };
        self.states.iter().any(|own| apart(own) < 1e-6 * size)
    }
}
