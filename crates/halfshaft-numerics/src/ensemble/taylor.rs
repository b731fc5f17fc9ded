//! One step of a batch by Taylor series, from band to band.
//!
//! The length of a step follows from the last two terms of the series, so no step is tried in vain,
//! and the series is the solution inside the step (À. Jorba, M. Zou, Experimental Mathematics 14
//! (2005) 99).

use super::bands::{Entered, Exit, Passage, exit, may_leave};
use super::functions::{rough_exp2, rough_log2};
use super::series::value_and_slope;
use super::stepper::{Pass, Stepper, put, take};
use super::{Expansion, LARGEST_DEGREE, Lanes, Parameters, RECIPROCALS, SeriesSystem, Settings};
use crate::polynomial;

/// A step that would leave less than this share of itself to the goal is stretched to reach it.
const STRETCH: f64 = 1.001;
/// A step must move the time by at least this share of it.
const LEAST_SHARE: f64 = 4.0 * f64::EPSILON;

/// The trajectories of a batch.
pub(super) struct Taylor<'s, Y, L> {
    system: &'s Y,
    terms: usize,
    /// Binary logarithms of the two highest powers.
    logarithms: [f64; 2],
    relative: f64,
    /// Tolerances of coordinates, then of their rates.
    absolute: Vec<f64>,
    largest_step: f64,
    fixed: bool,
    time: L,
    state: Vec<L>,
    parameters: Vec<L>,
    /// The last step: its start and its series.
    from: L,
    coordinates: Vec<L>,
    helpers: Vec<L>,
    entered: Vec<Entered>,
    passes: Vec<Pass>,
}

impl<'s, Y: SeriesSystem, L: Lanes> Taylor<'s, Y, L> {
    pub(super) fn new(system: &'s Y, settings: &Settings) -> Self {
        let terms = settings.degree + 1;
        let count = system.coordinates();
        let zero = L::splat(0.0);
        Self {
            terms,
            logarithms: [terms - 1, terms - 2].map(|power| (power as f64).log2()),
            relative: settings.relative_tolerance,
            absolute: (0..2 * count).map(|k| settings.absolute_tolerance.of(k)).collect(),
            largest_step: settings.fixed_step.unwrap_or(settings.largest_step),
            fixed: settings.fixed_step.is_some(),
            time: zero,
            state: vec![zero; 2 * count],
            parameters: vec![zero; system.parameters()],
            from: zero,
            coordinates: vec![zero; count * terms],
            helpers: vec![zero; system.helpers() * terms],
            entered: vec![None; L::COUNT],
            passes: Vec::new(),
            system,
        }
    }

    /// The binary logarithm of the tolerance of a component. (No closure: those are not always inlined,
    /// and then compiled without the vector instructions.)
    #[inline(always)]
    fn scale(&self, value: L, absolute: f64) -> L {
        rough_log2(value.abs().mul_add(L::splat(self.relative), L::splat(absolute)))
    }

    /// The binary logarithm of the inverse of the longest step that the tolerances allow, and a number
    /// that is not finite where the series is not.
    #[inline(always)]
    fn reach(&self) -> (L, L) {
        let count = self.absolute.len() / 2;
        let degree = self.terms - 1;
        let mut inverse = L::splat(-1e3);
        let mut sum = L::splat(0.0);
        for (index, series) in self.coordinates.chunks_exact(self.terms).enumerate() {
            let of_angle = self.scale(series[0], self.absolute[index]);
            let of_rate = self.scale(series[1], self.absolute[count + index]);
            for (power, logarithm) in [degree, degree - 1].into_iter().zip(self.logarithms) {
                let size = series[power].abs();
                sum = sum + size;
                let term = rough_log2(size);
                let by_rate = term - of_rate + L::splat(logarithm);
                inverse = (by_rate * L::splat(RECIPROCALS[power - 1])).larger(inverse);
                inverse = ((term - of_angle) * L::splat(RECIPROCALS[power])).larger(inverse);
            }
        }
        (inverse, sum)
    }

    /// The series about the present time.
    #[inline(always)]
    fn expand(&mut self) {
        let count = self.absolute.len() / 2;
        for (index, series) in self.coordinates.chunks_exact_mut(self.terms).enumerate() {
            series[0] = self.state[index];
            series[1] = self.state[count + index];
        }
        self.system.expand(&mut Expansion {
            terms: self.terms,
            time: self.time,
            parameters: &self.parameters,
            coordinates: &mut self.coordinates,
            helpers: &mut self.helpers,
        });
    }

    /// One for lanes whose step is lost in the rounding of the time, two for those whose series are not
    /// finite, zero for the others.
    #[inline(always)]
    fn lost(&self, reach: L, check: L) -> L {
        let least = self.time.abs() * L::splat(LEAST_SHARE);
        let longer = |reach: f64, least: f64| reach > least;
        let small = reach.select(least, longer, L::splat(0.0), L::splat(1.0));
        let infinite = L::splat(f64::INFINITY);
        check.select(infinite, |check, limit| check < limit, small, L::splat(2.0))
    }

    /// The states at the ends of the steps.
    #[inline(always)]
    fn advance(&mut self, length: L) {
        let count = self.absolute.len() / 2;
        for (index, series) in self.coordinates.chunks_exact(self.terms).enumerate() {
            let (value, slope) = value_and_slope(series, length);
            self.state[index] = value;
            self.state[count + index] = slope;
        }
    }

    /// Shortens the steps of lanes that leave a band, one lane after the other: here no instruction
    /// is wide.
    #[cold]
    #[inline(never)]
    fn exits(&mut self, length: &mut L, end: &mut L) {
        let mut x = [0.0; LARGEST_DEGREE + 1];
        for lane in 0..L::COUNT {
            let mut first: Option<Exit> = None;
            for (index, band) in self.system.bands().iter().enumerate() {
                take(lane, self.watched(band.series), &mut x);
                let level = |at: usize| self.parameters[at].get(lane);
                let levels = [level(band.lower), level(band.upper)];
                let (x, step) = (&x[..self.terms], length.get(lane));
                first = exit(x, levels, step, index, self.entered[lane], first);
            }
            self.entered[lane] = None;
            let Some(first) = first else { continue };
            length.set(lane, first.after);
            end.set(lane, self.time.get(lane) + first.after);
            take(lane, self.watched(self.system.bands()[first.band].series), &mut x);
            let rate = polynomial::value_and_slope(&x[..self.terms], first.after).1;
            let passage = Passage { band: first.band, up: first.up, time: end.get(lane), rate };
            self.passes.push(Pass { lane, passage });
        }
    }

    /// The coefficients of a series by number: coordinates first, then helpers.
    #[inline(always)]
    fn watched(&self, series: usize) -> &[L] {
        let from = series * self.terms;
        match from.checked_sub(self.coordinates.len()) {
            None => &self.coordinates[from..from + self.terms],
            Some(from) => &self.helpers[from..from + self.terms],
        }
    }

    #[inline(always)]
    fn any_may_leave(&self, length: L) -> bool {
        self.system.bands().iter().any(|band| {
            let level = |at: usize| self.parameters[at];
            may_leave(self.watched(band.series), level(band.lower), level(band.upper), length)
        })
    }

    /// Sends the lanes that have left a band on their way in the next.
    fn pass(&mut self) {
        for Pass { lane, passage } in &self.passes {
            let mut parameters = OfLane { lane: *lane, all: &mut self.parameters };
            self.system.pass(passage.band, passage.up, &mut parameters);
            self.entered[*lane] = Some((passage.band, !passage.up));
        }
    }
}

/// The parameters of a lane.
struct OfLane<'p, L> {
    lane: usize,
    all: &'p mut [L],
}

impl<L: Lanes> Parameters for OfLane<'_, L> {
    fn get(&self, number: usize) -> f64 {
        self.all[number].get(self.lane)
    }

    fn set(&mut self, number: usize, value: f64) {
        self.all[number].set(self.lane, value);
    }
}

impl<Y: SeriesSystem, L: Lanes> Stepper<L> for Taylor<'_, Y, L> {
    const LOOKS_INSIDE: bool = true;

    fn dimension(&self) -> usize {
        self.state.len()
    }

    fn parameters(&self) -> usize {
        self.parameters.len()
    }

    #[inline(always)]
    fn time(&self) -> L {
        self.time
    }

    fn set(&mut self, lane: usize, time: f64, state: &[f64], parameters: &[f64]) {
        self.time.set(lane, time);
        put(lane, state, &mut self.state);
        put(lane, parameters, &mut self.parameters);
        self.entered[lane] = None;
    }

    fn get(&self, lane: usize, state: &mut [f64], parameters: &mut [f64]) {
        take(lane, &self.state, state);
        take(lane, &self.parameters, parameters);
    }

    #[inline(always)]
    fn step(&mut self, goal: L) -> L {
        self.expand();
        let (inverse, check) = self.reach();
        let largest = L::splat(self.largest_step);
        let reach = if self.fixed { largest } else { rough_exp2(-inverse).smaller(largest) };
        let remaining = goal - self.time;
        let lands = |remaining: f64, reach: f64| remaining <= STRETCH * reach;
        let mut end = remaining.select(reach, lands, goal, self.time + reach);
        let mut length = end - self.time;
        let lost = self.lost(reach, check);
        self.passes.clear();
        if !self.system.bands().is_empty() {
            if self.any_may_leave(length) {
                self.exits(&mut length, &mut end);
            } else {
                self.entered.fill(None);
            }
        }
        self.advance(length);
        self.from = self.time;
        self.time = end;
        if !self.passes.is_empty() {
            self.pass();
        }
        lost
    }

    #[inline(always)]
    fn inside(&mut self, time: L, state: &mut [L]) {
        let (angles, rates) = state.split_at_mut(self.absolute.len() / 2);
        let series = self.coordinates.chunks_exact(self.terms);
        for ((series, angle), rate) in series.zip(angles).zip(rates) {
            (*angle, *rate) = value_and_slope(series, time - self.from);
        }
    }

    #[inline(always)]
    fn passes(&self) -> &[Pass] {
        &self.passes
    }
}
