//! The smallest shocks that throw the line from one response to another.
//!
//! A shock is an impulse of torque on a node at some moment of the response. All moments of a period,
//! both signs and a range of sizes are tried, first roughly over the whole range, then closely below
//! the smallest shock found so far: borders between basins fold over and over, so that what lies below
//! cannot be left out. What is left to do at the best places is in `border`.

use std::cell::Cell;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_model::Driveline;
use halfshaft_numerics::observer::{Observer, Part};
use halfshaft_results::{ShockSearch, SmallestShock};

use super::search::{ESCAPED, Search, UNDECIDED};
use super::settling::Beginning;
use super::window::Window;
use crate::error::AnalysisError;

/// Moments of a period of the excitation that are tried over the whole range, and closely.
const ROUGH_MOMENTS: usize = 32;
const CLOSE_MOMENTS: usize = 64;
/// Moments of a response of several periods at most.
const MOST_MOMENTS: usize = 96;
/// Sizes over the whole range, in geometric steps, and the smallest over the largest of them.
const ROUGH_SIZES: usize = 40;
const SMALLEST: f64 = 1e-3;
/// Sizes, in equal steps, up to the smallest shock found so far.
const CLOSE_SIZES: usize = 64;
/// The close look is taken again as long as it finds a shock smaller than this part of the last.
const MUCH_SMALLER: f64 = 0.9;
const MOST_LOOKS: usize = 3;

/// A shock on a response.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shock {
    /// Periods of the excitation since the response's first state.
    pub(super) moment: f64,
    /// With its sign, N·m·s.
    pub(super) impulse: f64,
}

/// At a moment and in a direction: the smallest tried size that leads to a response, and the next
/// smaller one, which does not.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hit {
    pub(super) moment: f64,
    pub(super) sign: f64,
    pub(super) below: f64,
    pub(super) at: f64,
}

/// Shocks on one node.
pub(super) struct Shocks<'s> {
    search: &'s Search<'s>,
    node: String,
    /// Jump of each rate by an impulse of 1 N·m·s.
    jumps: Vec<f64>,
    /// Largest impulse that is tried, N·m·s.
    largest: f64,
    observer: &'s dyn Observer,
    motions: Cell<usize>,
    undecided: Cell<usize>,
}

/// Lets through that the user wants to end, without the progress of every small piece of work.
struct Quiet<'o>(&'o dyn Observer);

impl Observer for Quiet<'_> {
    fn cancelled(&self) -> bool {
        self.0.cancelled()
    }
}

/// The node of the first torque with an order, else the first of all.
pub(super) fn usual_node(line: &Driveline) -> &str {
    let sounds = |torque: &&halfshaft_model::elements::Torque| {
        torque.frequency_rad_s.is_none() && torque.harmonics.iter().any(|h| h.amplitude_nm != 0.0)
    };
    let driven = line.torques().iter().find(sounds).map(|torque| torque.on.as_str());
    driven.or(line.inertias().first().map(|inertia| inertia.name.as_str())).unwrap_or_default()
}

impl<'s> Shocks<'s> {
    /// `None` where an impulse on the node twists nothing.
    pub(super) fn new(
        search: &'s Search<'s>,
        node: &str,
        window: &Window,
        observer: &'s dyn Observer,
    ) -> Option<Self> {
        let equations = search.at.equations();
        let place = &equations.nodes[equations.node(node)?];
        let mut impulses = vec![0.0; equations.groups()];
        impulses[place.group] = place.ratio;
        let largest = largest(equations, &impulses, window)?;
        Some(Self {
            search,
            node: node.to_owned(),
            jumps: equations.rate_jumps(&impulses),
            largest,
            observer,
            motions: Cell::new(0),
            undecided: Cell::new(0),
        })
    }

    /// Between all responses, numbered by their places in `order`; nothing if the user ends it.
    pub(super) fn all(
        &self,
        order: &[usize],
    ) -> Result<(Vec<SmallestShock>, Option<ShockSearch>), AnalysisError> {
        let mut shocks = Vec::new();
        for (place, from) in order.iter().enumerate() {
            Part::of(self.observer, place, order.len()).progress(0.0);
            let found = self.from(*from)?;
            if self.observer.cancelled() {
                return Ok((Vec::new(), None));
            }
            let others = order.iter().enumerate().filter(|(_, to)| *to != from);
            for (to, number) in others.map(|(to, number)| (Some(to), outcome_of(*number))) {
                shocks.push(self.told(place, to, found.get(&number)));
            }
            if let Some(shock) = found.get(&ESCAPED) {
                shocks.push(self.told(place, None, Some(shock)));
            }
        }
        let search = ShockSearch {
            node: self.node.clone(),
            largest_impulse: self.largest,
            phases: CLOSE_MOMENTS,
            motions: self.motions.get(),
            undecided: self.undecided.get(),
        };
        Ok((shocks, Some(search)))
    }

    fn told(&self, from: usize, to: Option<usize>, shock: Option<&Shock>) -> SmallestShock {
        SmallestShock {
            from,
            to,
            impulse: shock.map(|shock| shock.impulse),
            phase: shock.map(|shock| TAU * shock.moment.fract()),
            time: shock.map(|shock| shock.moment * self.search.at.period()),
            node: self.node.clone(),
        }
    }

    /// The smallest shock from a response to everything that any leads to.
    fn from(&self, from: usize) -> Result<BTreeMap<i32, Shock>, AnalysisError> {
        let growth = |k: usize| k as f64 / (ROUGH_SIZES - 1) as f64 - 1.0;
        let size = |k: usize| self.largest * SMALLEST.powf(-growth(k));
        let sizes: Vec<f64> = (0..ROUGH_SIZES).map(size).collect();
        let mut hits = BTreeMap::new();
        self.scan(from, (ROUGH_MOMENTS, 0.0), &sizes, &mut hits)?;
        for look in 0..MOST_LOOKS {
            let before = smallest(&hits);
            // Other moments each time.
            let offset = (0.5 + 0.618 * look as f64).fract();
            let sizes = close_sizes(&before);
            self.scan(from, (CLOSE_MOMENTS, offset), &sizes, &mut hits)?;
            let fell = |(to, size): (&i32, &f64)| {
                before.get(to).is_none_or(|before| *size < MUCH_SMALLER * before)
            };
            if !smallest(&hits).iter().any(fell) {
                break;
            }
        }
        let mut found = BTreeMap::new();
        let step = self.periods(from) / self.count(from, CLOSE_MOMENTS) as f64;
        for (to, hits) in &hits {
            if let Some(shock) = self.smallest_of(from, *to, hits, step)? {
                found.insert(*to, shock);
            }
        }
        Ok(found)
    }

    /// Tries ascending sizes at moments of the whole response and in both directions; adds the first
    /// hits of every other response.
    fn scan(
        &self,
        from: usize,
        (moments, offset): (usize, f64),
        sizes: &[f64],
        hits: &mut BTreeMap<i32, Vec<Hit>>,
    ) -> Result<(), AnalysisError> {
        let (periods, count) = (self.periods(from), self.count(from, moments));
        let rows: Vec<(f64, f64)> = (0..2 * count)
            .map(|row| {
                let moment = periods * ((row / 2) as f64 + offset) / count as f64;
                (moment, if row % 2 == 0 { 1.0 } else { -1.0 })
            })
            .collect();
        let shock = |(moment, sign): &(f64, f64), size: &f64| Shock {
            moment: *moment,
            impulse: sign * size,
        };
        let shocks: Vec<Shock> =
            rows.iter().flat_map(|row| sizes.iter().map(move |size| shock(row, size))).collect();
        let outcomes = self.outcomes(from, &shocks)?;
        let own = outcome_of(from);
        for ((moment, sign), ends) in rows.into_iter().zip(outcomes.chunks(sizes.len().max(1))) {
            let mut met = Vec::new();
            for (k, to) in ends.iter().enumerate() {
                if *to == own || *to == UNDECIDED || met.contains(to) {
                    continue;
                }
                met.push(*to);
                let below = k.checked_sub(1).map_or(0.0, |before| sizes[before]);
                hits.entry(*to).or_default().push(Hit { moment, sign, below, at: sizes[k] });
            }
        }
        Ok(())
    }

    /// Moments of the whole response for so many of a period.
    fn count(&self, from: usize, moments: usize) -> usize {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small")]
        let all = moments * self.periods(from) as usize;
        all.min(MOST_MOMENTS.max(moments))
    }

    /// Periods of the excitation after which a response repeats.
    pub(super) fn periods(&self, response: usize) -> f64 {
        f64::from(self.search.attractors[response].periods.max(1))
    }

    /// Where shocks on a response lead to.
    pub(super) fn outcomes(
        &self,
        from: usize,
        shocks: &[Shock],
    ) -> Result<Vec<i32>, AnalysisError> {
        let Search { at, frame, attractors, .. } = self.search;
        let states: Vec<Vec<f64>> =
            attractors[from].states.iter().map(|state| frame.lanes(state)).collect();
        let period = at.period();
        let begin = |index: usize| {
            let Shock { moment, impulse } = shocks[index];
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small")]
            let passed = moment as usize % states.len();
            Beginning {
                state: states[passed].clone(),
                shock: Some((moment.fract() * period, impulse)),
            }
        };
        let quiet = Quiet(self.observer);
        let led = self.search.follow(shocks.len(), begin, &self.jumps, false, &quiet)?;
        let lost = led.outcomes.iter().filter(|outcome| **outcome == UNDECIDED).count();
        self.motions.set(self.motions.get() + shocks.len());
        self.undecided.set(self.undecided.get() + lost);
        Ok(led.outcomes)
    }
}

/// What a motion that ends at a response is marked with.
fn outcome_of(response: usize) -> i32 {
    i32::try_from(response).unwrap_or(i32::MAX)
}

/// The smallest size that leads to each response.
fn smallest(hits: &BTreeMap<i32, Vec<Hit>>) -> BTreeMap<i32, f64> {
    let least = |hits: &Vec<Hit>| hits.iter().map(|hit| hit.at).fold(f64::INFINITY, f64::min);
    hits.iter().map(|(to, hits)| (*to, least(hits))).collect()
}

/// Ascending sizes up to the largest bound, in steps that are small for each of the bounds.
fn close_sizes(bounds: &BTreeMap<i32, f64>) -> Vec<f64> {
    let mut bounds: Vec<f64> = bounds.values().copied().collect();
    bounds.sort_by(f64::total_cmp);
    let mut sizes = Vec::new();
    let mut from = 0.0;
    for bound in bounds {
        let steps = (CLOSE_SIZES as f64 * (bound - from) / bound).ceil();
        let mut step = 1.0;
        while step <= steps {
            sizes.push(from + (bound - from) * step / steps);
            step += 1.0;
        }
        from = bound;
    }
    sizes
}

/// The impulse with the energy of a twist whose rate is the whole height of the window, N·m·s:
///
/// ```text
/// J² (v M v - v̄² M_r) = (height)² / (wᵀ M⁻¹ w),     v = M⁻¹ e
/// ```
///
/// On an inertia at the end of the varied shaft it changes the rate of twist by just that height.
fn largest(equations: &EquationsOfMotion, impulses: &[f64], window: &Window) -> Option<f64> {
    let speeds: Vec<f64> = impulses.iter().zip(&equations.inertia).map(|(p, m)| p / m).collect();
    let whole = equations.rigid.as_ref().map_or(0.0, |rigid| {
        let mean = rigid.mean(&speeds);
        rigid.inertia * mean * mean
    });
    let twisting = 2.0 * equations.kinetic_energy(&speeds) - whole;
    let shaft = equations.network.tree.get(window.place)?.shaft;
    let height = window.rates.last()? - window.rates.first()?;
    let largest = height / (equations.compliance_of(shaft) * twisting).sqrt();
    (largest.is_finite() && largest > 0.0).then_some(largest)
}
