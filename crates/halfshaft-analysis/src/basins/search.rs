//! What the line settles to, and from where.

use halfshaft_dynamics::Active;
use halfshaft_dynamics::lanes::LaneLine;
use halfshaft_numerics::ensemble::{Settings, by_series};
use halfshaft_numerics::observer::{Observer, Part, Silent};
use halfshaft_numerics::ode::Tolerance;

use super::frame::Frame;
use super::settling::{Beginning, Memory, Outcome, Settle, Trap};
use crate::error::AnalysisError;
use crate::harmonic_balance::{AtSpeed, Response};

/// Distance, over the size of the responses, within which a state belongs to a response for sure.
const NEAREST: f64 = 2e-3;
/// Largest distance that is tried for a neighbourhood; it is halved until everything comes back.
const WIDEST: f64 = 0.2;
/// States from which the way back is tried.
const TRIALS: usize = 64;
/// Size, over that of the responses, at which a motion has grown beyond all measure.
const BEYOND: f64 = 1e3;
/// Motions that run side by side at a time.
const CHUNK: usize = 16_384;

/// Attractors, and the means to follow motions to them.
pub(super) struct Search<'s> {
    pub(super) at: &'s AtSpeed,
    line: LaneLine,
    parameters: Vec<f64>,
    pub(super) frame: Frame,
    pub(super) attractors: Vec<Response>,
    traps: Vec<Trap>,
    settings: Settings,
    most_periods: usize,
}

/// Where a motion leads to, as the result has it.
pub(super) const ESCAPED: i32 = -1;
pub(super) const UNDECIDED: i32 = -2;

/// Where motions lead to, with the state in which those ended that were not caught.
pub(super) struct Led {
    pub(super) outcomes: Vec<i32>,
    loose: Vec<(Option<u32>, Vec<f64>)>,
    pub(super) cancelled: bool,
}

impl<'s> Search<'s> {
    pub(super) fn new(
        at: &'s AtSpeed,
        frequency: f64,
        responses: Vec<Response>,
        (tolerance, most_periods): (f64, usize),
    ) -> Result<Self, AnalysisError> {
        let equations = at.equations();
        let line = LaneLine::new(equations);
        let values = line.values(equations, &Active::periodic(frequency), 0.0);
        let parameters = values.map_err(|error| AnalysisError::MethodDoesNotFit {
            method: "basins",
            reason: error.to_string(),
        })?;
        let frame = Frame::new(equations, at.coordinates(), &responses);
        let sizes = frame.sizes.iter().map(|size| if size.is_finite() { *size } else { 1.0 });
        let absolute = sizes.map(|size| tolerance * size).collect();
        let settings = Settings {
            relative_tolerance: tolerance,
            absolute_tolerance: Tolerance::PerComponent(absolute),
            ..Settings::default()
        };
        let attractors: Vec<Response> =
            responses.into_iter().filter(|response| response.stability.is_stable()).collect();
        let mut search = Self {
            at,
            line,
            parameters,
            frame,
            attractors,
            traps: Vec::new(),
            settings,
            most_periods,
        };
        search.set_traps()?;
        Ok(search)
    }

    /// Follows motions from `count` states; those that end loose tell where they are.
    pub(super) fn lead(
        &self,
        count: usize,
        start: impl Fn(usize) -> Vec<f64> + Sync,
        repeating: bool,
        observer: &dyn Observer,
    ) -> Result<Led, AnalysisError> {
        let begin = |index: usize| Beginning { state: start(index), shock: None };
        self.follow(count, begin, &[], repeating, observer)
    }

    /// Follows motions that begin as told; `jumps` is what an impulse of 1 N·m·s does to the rates.
    pub(super) fn follow(
        &self,
        count: usize,
        begin: impl Fn(usize) -> Beginning + Sync,
        jumps: &[f64],
        repeating: bool,
        observer: &dyn Observer,
    ) -> Result<Led, AnalysisError> {
        let mut led =
            Led { outcomes: Vec::with_capacity(count), loose: Vec::new(), cancelled: false };
        for from in (0..count).step_by(CHUNK) {
            let task = Settle {
                line: &self.line,
                frame: &self.frame,
                parameters: &self.parameters,
                begin: |index: usize| begin(from + index),
                jumps,
                traps: &self.traps,
                period: self.at.period(),
                most_periods: self.most_periods,
                most_size: BEYOND,
                repeating,
            };
            let size = CHUNK.min(count - from);
            let part = Part::of(observer, from / CHUNK, count.div_ceil(CHUNK));
            let finished =
                by_series(&self.line, &task, size, &self.settings, &part).map_err(|source| {
                    AnalysisError::Numerics { doing: "motions are followed", source }
                })?;
            for motion in finished {
                let Some(motion) = motion else {
                    led.cancelled = true;
                    led.outcomes.push(UNDECIDED);
                    continue;
                };
                led.take(&motion.memory, motion.state, motion.stop.is_some());
            }
        }
        Ok(led)
    }

    /// Adds what loose motions settle to; tells whether there was anything new.
    pub(super) fn learn(&mut self, led: &Led) -> Result<bool, AnalysisError> {
        let before = self.attractors.len();
        for (periods, state) in &led.loose {
            let known = |attractor: &Response| {
                let states = attractor.states.iter().map(|own| self.frame.lanes(own));
                states.map(|own| self.frame.distance(&own, state)).fold(f64::INFINITY, f64::min)
            };
            let Some(periods) = *periods else { continue };
            if self.attractors.iter().any(|attractor| known(attractor) < NEAREST) {
                continue;
            }
            let Some(orbit) = self.at.orbit(&self.frame.shooting(state), periods) else { continue };
            let listed = |own: &Response| own.periods == periods && own.passes(&orbit.states[0]);
            if orbit.stability.is_stable() && !self.attractors.iter().any(listed) {
                self.attractors.push(orbit);
            }
        }
        if self.attractors.len() > before {
            self.set_traps()?;
        }
        Ok(self.attractors.len() > before)
    }

    /// Gives each attractor the widest neighbourhood from which all trials come back to it.
    fn set_traps(&mut self) -> Result<(), AnalysisError> {
        let of = |attractor: &Response| Trap {
            states: attractor.states.iter().map(|own| self.frame.lanes(own)).collect(),
            radius: NEAREST,
        };
        self.traps = self.attractors.iter().map(of).collect();
        let mut radii = Vec::with_capacity(self.traps.len());
        for (number, trap) in self.traps.iter().enumerate() {
            let mut radius = WIDEST;
            while radius > NEAREST && !self.comes_back(number, &trap.states[0], radius)? {
                radius *= 0.5;
            }
            radii.push(radius.max(NEAREST));
        }
        self.traps.iter_mut().zip(radii).for_each(|(trap, radius)| trap.radius = radius);
        Ok(())
    }

    /// Whether all states tried at a distance from a response lead back to it.
    fn comes_back(&self, number: usize, state: &[f64], radius: f64) -> Result<bool, AnalysisError> {
        let frame = &self.frame;
        let start = |trial: usize| {
            let direction = direction(trial, state.len());
            let size = frame.size(&frame.moved(&vec![0.0; state.len()], &direction, 1.0));
            frame.moved(state, &direction, radius / size)
        };
        let led = self.lead(TRIALS, start, false, &Silent)?;
        let number = i32::try_from(number).unwrap_or(i32::MAX);
        Ok(led.outcomes.iter().all(|outcome| *outcome == number))
    }
}

impl Led {
    fn take(&mut self, memory: &Memory, state: Vec<f64>, stopped: bool) {
        let outcome = match memory.outcome {
            Outcome::Caught(number) => i32::try_from(number).unwrap_or(i32::MAX),
            Outcome::Escaped => ESCAPED,
            // What cannot be integrated any further runs away.
            Outcome::Undecided if stopped => ESCAPED,
            Outcome::Repeats(periods) => {
                self.loose.push((Some(periods), state));
                UNDECIDED
            }
            Outcome::Undecided => {
                self.loose.push((None, state));
                UNDECIDED
            }
        };
        self.outcomes.push(outcome);
    }

    /// States in which motions ended loose.
    pub(super) fn ends(&self) -> Vec<Vec<f64>> {
        self.loose.iter().map(|(_, state)| state.clone()).collect()
    }
}

/// A direction in a space of many components: well spread for numbers 0, 1, 2, ...
fn direction(number: usize, components: usize) -> Vec<f64> {
    // The fractional parts of multiples of square roots of different primes are independent.
    let mut primes = (2_u32..).filter(|n| (2..*n).take_while(|d| d * d <= *n).all(|d| n % d > 0));
    let mut next = || {
        let root = f64::from(primes.next().unwrap_or(2)).sqrt();
        2.0 * ((number + 1) as f64 * root).fract() - 1.0
    };
    (0..components).map(|_| next()).collect()
}
