//! Many trajectories at once: exact ends, orders, conserved energy, the same bits whatever the lanes.

#[path = "reference/lanes.rs"]
mod lanes;
mod reference;

use std::f64::consts::PI;

use halfshaft_numerics::Error;
use halfshaft_numerics::ensemble::{
    Band, Expansion, Finished, Instructions, Lanes, Pair, Parameters, Passage, Plan, RECIPROCALS,
    SeriesSystem, Settings, Task, Trajectory, by_runge_kutta, by_series,
};
use halfshaft_numerics::observer::{Observer, Silent};
use halfshaft_numerics::ode::Stop;
use lanes::{DuffingLanes, ManyDuffing};
use reference::{Duffing, free_duffing};

/// The ways to integrate.
#[derive(Clone, Copy, Debug)]
enum Way {
    Series,
    Pair(Pair),
}

const WAYS: [Way; 3] = [Way::Series, Way::Pair(Pair::DormandPrince8), Way::Pair(Pair::Tsitouras5)];

fn run(way: Way, task: &ManyDuffing, settings: &Settings) -> Vec<Finished<()>> {
    let count = task.oscillators.len();
    let out = match way {
        Way::Series => by_series(&DuffingLanes, task, count, settings, &Silent),
        Way::Pair(pair) => by_runge_kutta(&DuffingLanes, pair, task, count, settings, &Silent),
    };
    let all: Option<Vec<_>> = out.expect("settings are sound").into_iter().collect();
    all.expect("nothing was cancelled")
}

// Source: Taylor series of 26 terms in arithmetic of 34 digits (see `Duffing`).
#[test]
fn two_hundred_periods_end_where_they_should() {
    let task = ManyDuffing::drivelines(3);
    for (way, tolerance, error) in
        [(WAYS[0], 1e-15, 2e-12), (WAYS[1], 1e-13, 2e-11), (WAYS[2], 1e-9, 1e-6)]
    {
        let found = run(way, &task, &Settings::with_tolerance(tolerance));
        let [x, v] = Duffing::DRIVELINE_AFTER_200;
        assert!((found[0].state[0] - x).abs() < error, "{way:?}: {:?}", found[0]);
        assert!((found[0].state[1] - v).abs() < 30.0 * error, "{way:?}: {:?}", found[0]);
        assert_eq!(found[0].stop, None);
    }
}

/// The order that the errors of free oscillations of several amplitudes at the end tell, with steps of
/// a length and of half of it.
fn order(way: Way, degree: usize, length: f64) -> f64 {
    let (stiffness, cubic, end) = (1.0, 0.7, 6.0);
    let oscillator = Duffing { damping: 0.0, stiffness, cubic, force: 0.0, frequency: 1.0 };
    let amplitudes: Vec<f64> = (0..12).map(|k| 0.8 + 0.07 * f64::from(k)).collect();
    let oscillators = amplitudes.iter().map(|amplitude| (oscillator, [*amplitude, 0.0])).collect();
    let task = ManyDuffing { oscillators, periods: end / (2.0 * PI) };
    let [coarse, fine] = [length, 0.5 * length].map(|length| {
        let settings = Settings { fixed_step: Some(length), degree, ..Settings::default() };
        let found = run(way, &task, &settings);
        let error = |(amplitude, found): (&f64, &Finished<()>)| {
            let exact = free_duffing(stiffness, cubic, *amplitude, end);
            (found.state[0] - exact[0]).hypot(found.state[1] - exact[1])
        };
        amplitudes.iter().zip(&found).map(error).sum::<f64>() / 12.0
    });
    assert!(fine > 1e-13, "{way:?}: the finer steps are at rounding: {fine:e}");
    (coarse / fine).log2()
}

// Source: the orders of the methods; the free oscillation is exact by elliptic functions.
#[test]
fn errors_fall_with_the_orders_of_the_methods() {
    let eighth = order(WAYS[1], 20, 0.2);
    assert!((eighth - 8.0).abs() < 0.4, "{eighth}");
    let fifth = order(WAYS[2], 20, 0.03);
    assert!((fifth - 5.0).abs() < 0.3, "{fifth}");
    // Rates of a series of degree 9 are right to the power 8.
    let series = order(WAYS[0], 9, 0.2);
    assert!((series - 8.0).abs() < 0.5, "{series}");
}

// Source: the energy of an undamped oscillator is constant.
#[test]
fn energy_drifts_by_less_than_a_hundred_roundings_a_step() {
    let hardening =
        Duffing { damping: 0.0, stiffness: 1.0, cubic: 0.7, force: 0.0, frequency: 1.0 };
    let driveline = Duffing { damping: 0.0, force: 0.0, ..Duffing::DRIVELINE };
    let starts = vec![(hardening, [1.3, 0.2]), (driveline, [0.9, 1.0])];
    let task = ManyDuffing { oscillators: starts, periods: 500.0 };
    for (way, tolerance) in [(WAYS[0], 1e-16), (WAYS[1], 1e-15)] {
        let found = run(way, &task, &Settings::with_tolerance(tolerance));
        for ((oscillator, start), found) in task.oscillators.iter().zip(&found) {
            let before = oscillator.energy(start);
            let drift = (oscillator.energy(&found.state) / before - 1.0).abs();
            let bound = 100.0 * f64::EPSILON * found.steps as f64;
            assert!(drift < bound, "{way:?}: {drift:e}, {} steps", found.steps);
        }
    }
}

// Source: lanes do not see each other and go through the same operations, so not a bit may differ.
#[test]
fn lanes_instructions_threads_and_order_change_no_bit() {
    let mut task = ManyDuffing { periods: 7.0, ..ManyDuffing::drivelines(61) };
    for way in WAYS {
        let base = Settings::with_tolerance(1e-8);
        let plain = Settings {
            lanes: Some(1),
            threads: 1,
            instructions: Some(Instructions::Plain),
            ..base.clone()
        };
        let expected = run(way, &task, &plain);
        for instructions in Instructions::available() {
            for &lanes in instructions.widths() {
                for threads in [1, 3] {
                    let settings = Settings {
                        lanes: Some(lanes),
                        threads,
                        instructions: Some(instructions),
                        ..base.clone()
                    };
                    let found = run(way, &task, &settings);
                    assert_eq!(found, expected, "{way:?}, {instructions:?}, {lanes}, {threads}");
                }
            }
        }
        task.oscillators.reverse();
        let mut found = run(way, &task, &base);
        found.reverse();
        assert_eq!(found, expected, "{way:?}");
        task.oscillators.reverse();
    }
}

/// Looks at every oscillator once a period.
struct Strobe(ManyDuffing);

impl Task for Strobe {
    type Memory = (f64, Vec<[f64; 2]>);

    fn begin(&self, index: usize, trajectory: &mut Trajectory<'_>) -> (Self::Memory, Plan) {
        let ((), plan) = self.0.begin(index, trajectory);
        let period = self.0.oscillators[index].0.period();
        ((period, Vec::new()), Plan { watch: period, ..plan })
    }

    fn watched(&self, memory: &mut Self::Memory, time: f64, state: &[f64]) -> Option<f64> {
        let (period, points) = memory;
        points.push([state[0], state[1]]);
        // The last one is ended from outside.
        (points.len() < 9).then_some(time + *period)
    }
}

// Source: runs that end at the times looked at.
#[test]
fn looks_on_the_way_see_what_runs_to_there_find() {
    let oscillators = ManyDuffing::drivelines(21);
    let settings = Settings::with_tolerance(1e-13);
    let strobe = Strobe(oscillators.clone());
    let by_series = by_series(&DuffingLanes, &strobe, 21, &settings, &Silent).expect("sound");
    let eighth = Pair::DormandPrince8;
    let by_stages =
        by_runge_kutta(&DuffingLanes, eighth, &strobe, 21, &settings, &Silent).expect("sound");
    for periods in [1_usize, 4, 9] {
        let task = ManyDuffing { periods: periods as f64, ..oscillators.clone() };
        let expected = run(Way::Series, &task, &settings);
        for found in [&by_series, &by_stages] {
            for (found, expected) in found.iter().flatten().zip(&expected) {
                assert_eq!(found.memory.1.len(), 9);
                assert_eq!(found.state, found.memory.1[8]);
                let point = found.memory.1[periods - 1];
                assert!((point[0] - expected.state[0]).abs() < 1e-11);
                assert!((point[1] - expected.state[1]).abs() < 3e-10);
            }
        }
    }
}

/// `x'' = -k x` with one stiffness above zero and another below; parameters: stiffness now, levels of
/// the band, stiffness below, stiffness above.
struct TwoStiffnesses {
    bands: [Band; 1],
}

impl SeriesSystem for TwoStiffnesses {
    fn coordinates(&self) -> usize {
        1
    }

    fn parameters(&self) -> usize {
        5
    }

    fn helpers(&self) -> usize {
        0
    }

    #[inline(always)]
    fn expand<L: Lanes>(&self, expansion: &mut Expansion<'_, L>) {
        let stiffness = expansion.parameters[0];
        let x = &mut *expansion.coordinates;
        for k in 0..expansion.terms - 2 {
            let factor = L::splat(RECIPROCALS[k + 1] * RECIPROCALS[k + 2]);
            x[k + 2] = -(stiffness * x[k] * factor);
        }
    }

    fn bands(&self) -> &[Band] {
        &self.bands
    }

    fn pass(&self, _: usize, up: bool, parameters: &mut dyn Parameters) {
        let (now, levels) =
            if up { (4, [0.0, f64::INFINITY]) } else { (3, [f64::NEG_INFINITY, 0.0]) };
        parameters.set(0, parameters.get(now));
        parameters.set(1, levels[0]);
        parameters.set(2, levels[1]);
    }
}

/// Oscillators of two stiffnesses over 50 of their periods; their passages are kept.
struct ManyTwoStiffnesses;

impl ManyTwoStiffnesses {
    fn stiffnesses(index: usize) -> [f64; 2] {
        [4.0 + index as f64, 100.0 + 30.0 * index as f64]
    }

    fn half_periods(index: usize) -> [f64; 2] {
        Self::stiffnesses(index).map(|stiffness| PI / stiffness.sqrt())
    }
}

impl Task for ManyTwoStiffnesses {
    type Memory = Vec<Passage>;

    fn begin(&self, index: usize, trajectory: &mut Trajectory<'_>) -> (Self::Memory, Plan) {
        let [below, above] = Self::stiffnesses(index);
        trajectory.state.copy_from_slice(&[1.0, 0.0]);
        trajectory.parameters.copy_from_slice(&[above, 0.0, f64::INFINITY, below, above]);
        let [low, high] = Self::half_periods(index);
        (Vec::new(), Plan::to(50.0 * (low + high)))
    }

    fn passed(&self, memory: &mut Self::Memory, passage: &Passage) {
        memory.push(*passage);
    }
}

// Source: half a period of each stiffness in turn, the speed at zero from the energy.
#[test]
fn changes_of_stiffness_are_located_to_rounding() {
    let system = TwoStiffnesses { bands: [Band { series: 0, lower: 1, upper: 2 }] };
    for lanes in [1, 8] {
        let settings = Settings { lanes: Some(lanes), ..Settings::with_tolerance(1e-15) };
        let found = by_series(&system, &ManyTwoStiffnesses, 12, &settings, &Silent).expect("sound");
        for (index, found) in found.iter().flatten().enumerate() {
            let [low, high] = ManyTwoStiffnesses::half_periods(index);
            assert!((found.state[0] - 1.0).abs() < 1e-10, "{found:?}");
            assert_eq!(found.memory.len(), 100);
            for (passages, passage) in found.memory.iter().enumerate() {
                let before = (passages / 2) as f64 * (low + high) + 0.5 * high;
                let exact = if passages % 2 == 0 { before } else { before + low };
                assert!((passage.time - exact).abs() < 1e-12 * exact.max(1.0), "{passage:?}");
                let speed = ManyTwoStiffnesses::stiffnesses(index)[1].sqrt();
                assert!((passage.rate.abs() - speed).abs() < 1e-11 * speed);
                assert_eq!(passage.up, passages % 2 == 1);
            }
        }
    }
}

// Source: x'' = 200 x³ from x = 1 at rest grows beyond all bounds at t = 0.13 (by the energy,
// ∫ dx / √(100 (x⁴ - 1)) from 1 to infinity).
#[test]
fn trajectories_that_cannot_go_on_say_why_and_let_the_others_go_on() {
    let mut task = ManyDuffing { periods: 3.0, ..ManyDuffing::drivelines(30) };
    let bursting =
        Duffing { damping: 0.0, stiffness: 0.0, cubic: -200.0, force: 0.0, frequency: 1.0 };
    task.oscillators[13] = (bursting, [1.0, 0.0]);
    for way in WAYS {
        let found = run(way, &task, &Settings::with_tolerance(1e-8));
        for (index, found) in found.iter().enumerate() {
            match found.stop {
                None => assert_ne!(index, 13, "{way:?}"),
                Some(_) => {
                    assert_eq!(index, 13, "{way:?}");
                    assert!((found.time - 0.131).abs() < 1e-3, "{way:?}: {}", found.time);
                }
            }
        }
        let few = Settings { step_limit: 5, ..Settings::default() };
        let stopped = |found: &Finished<()>| matches!(found.stop, Some(Stop::StepLimit { .. }));
        assert!(run(way, &ManyDuffing::drivelines(20), &few).iter().all(stopped), "{way:?}");
    }
}

struct Cancelled;

impl Observer for Cancelled {
    fn cancelled(&self) -> bool {
        true
    }
}

// Source: the contract in the documentation.
#[test]
fn nothing_is_begun_after_a_cancellation_and_wrong_numbers_are_refused() {
    let task = ManyDuffing::drivelines(10);
    let settings = Settings::default();
    let found = by_series(&DuffingLanes, &task, 10, &settings, &Cancelled).expect("sound");
    assert!(found.iter().all(Option::is_none) && found.len() == 10);
    let none = by_series(&DuffingLanes, &task, 0, &settings, &Silent).expect("sound");
    assert!(none.is_empty());
    for wrong in [
        Settings { degree: 31, ..Settings::default() },
        Settings { relative_tolerance: f64::NAN, ..Settings::default() },
        Settings { fixed_step: Some(0.0), ..Settings::default() },
    ] {
        let refused = by_series(&DuffingLanes, &task, 10, &wrong, &Silent);
        assert!(matches!(refused, Err(Error::Setting { .. })), "{wrong:?}");
    }
}
