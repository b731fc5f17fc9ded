//! `basins`: where initial states lead to.

mod common;
#[path = "common/lines.rs"]
mod lines;

use common::{line_of, some, try_ask};
use halfshaft_model::question::{QuestionText, Verb};
use halfshaft_results::{Answer, BasinsResult};

fn basins(text: &str, question: &QuestionText) -> BasinsResult {
    match try_ask(&line_of(text, &[]), Verb::Basins, question) {
        Ok(Answer::Basins(result)) => result,
        other => panic!("{other:?}"),
    }
}

fn at(frequency: &str, grid: &str) -> QuestionText {
    QuestionText { frequency: some(frequency), grid: some(grid), ..QuestionText::default() }
}

/// Accelerations of an oscillator at a time.
type Acceleration = fn(f64, f64, f64) -> f64;

/// State after a number of periods by the classical method of Runge and Kutta.
fn run(f: Acceleration, state: (f64, f64), frequency: f64, periods: usize) -> (f64, f64) {
    const STEPS: usize = 400;
    let end = std::f64::consts::TAU / frequency * periods as f64;
    between(f, state, (0.0, end), periods * STEPS)
}

/// State at the end of a stretch of time by the same method.
fn between(
    f: Acceleration,
    (mut x, mut v): (f64, f64),
    (from, to): (f64, f64),
    steps: usize,
) -> (f64, f64) {
    let h = (to - from) / steps as f64;
    for step in 0..steps {
        let t = from + h * step as f64;
        let (a1, v1) = (f(x, v, t), v);
        let (a2, v2) = (f(x + 0.5 * h * v1, v + 0.5 * h * a1, t + 0.5 * h), v + 0.5 * h * a1);
        let (a3, v3) = (f(x + 0.5 * h * v2, v + 0.5 * h * a2, t + 0.5 * h), v + 0.5 * h * a2);
        let (a4, v4) = (f(x + h * v3, v + h * a3, t + h), v + h * a3);
        x += h / 6.0 * (v1 + 2.0 * (v2 + v3) + v4);
        v += h / 6.0 * (a1 + 2.0 * (a2 + a3) + a4);
    }
    (x, v)
}

/// The theory's oscillator at 25.75 rad/s, where two responses are stable.
const THEORY: &str = r#"
format = 1
name = "theory"
[[inertia]]
name = "disc"
inertia = 1
[[shaft]]
name = "shaft"
from = "disc"
to = "ground"
stiffness = 679
cubic = -0.679
damping = 0.0952
[[torque]]
name = "drive"
on = "disc"
amplitude = 15
"#;

fn theory(x: f64, v: f64, t: f64) -> f64 {
    15.0 * (25.75 * t).cos() - 679.0 * x + 0.679 * x * x * x - 0.0952 * v
}

// Source: the same motions by the classical method of Runge and Kutta with fixed steps, state by state.
#[test]
fn states_lead_where_another_method_leads_them() {
    let found = basins(THEORY, &at("25.75rad/s", "61"));
    assert_eq!((found.attractors.len(), found.escaped, found.undecided), (2, 0.0, 0.0));
    let grid = &found.grid;
    let mut border = 0;
    for number in 0..60 {
        let (row, column) = ((7 * number) % 61, (23 * number + 5) % 61);
        let own = grid.attractor[row][column];
        // Fixed steps may fall to the other side next to a border.
        let beside = [
            (row, column + 1),
            (row, column.wrapping_sub(1)),
            (row + 1, column),
            (row.wrapping_sub(1), column),
        ];
        let same = |(r, c): &(usize, usize)| {
            grid.attractor.get(*r).and_then(|list| list.get(*c)).is_none_or(|other| *other == own)
        };
        if !beside.iter().all(same) {
            border += 1;
            continue;
        }
        let (x, v) = run(theory, (grid.twist[column], grid.rate[row]), 25.75, 600);
        let away = |index: i32| {
            let attractor = &found.attractors[index as usize];
            (x - attractor.twist[0]).hypot((v - attractor.rate[0]) / 25.75)
        };
        assert!(away(own) < 0.05 * away(1 - own), "{number}: {x}, {v} for response {own}");
    }
    assert!(border < 20, "{border}");
    let led = |index: i32| grid.attractor.iter().flatten().filter(|own| **own == index).count();
    for (index, attractor) in (0..).zip(&found.attractors) {
        assert!((attractor.share - led(index) as f64 / 3721.0).abs() < 1e-12);
    }
}

// Source: the responses that harmonic balance follows to this speed, and Liouville's formula for the
// product of the multipliers.
#[test]
fn attractors_are_the_stable_responses() {
    let found = basins(THEORY, &at("25.75rad/s", "21"));
    let line = line_of(THEORY, &[]);
    let text = QuestionText { frequency: some("25.75..26.5"), ..QuestionText::default() };
    let Ok(Answer::Resonance(known)) = try_ask(&line, Verb::Resonance, &text) else {
        panic!("is answered");
    };
    let mut first: Vec<f64> = Vec::new();
    for branch in &known.branches {
        let (speeds, stable) = (branch.values("frequency"), branch.values("stable"));
        let amplitude = branch.values("shaft.twist.amplitude");
        let here = (0..speeds.len()).filter(|k| speeds[*k] == 25.75 && stable[*k] == 1.0);
        first.extend(here.map(|k| amplitude[k]));
    }
    first.sort_by(f64::total_cmp);
    let mut own: Vec<f64> =
        found.attractors.iter().map(|a| a.values["shaft.twist.amplitude"]).collect();
    own.sort_by(f64::total_cmp);
    assert_eq!(own.len(), first.len());
    for (own, known) in own.iter().zip(&first) {
        assert!((own / known - 1.0).abs() < 1e-6, "{own} for {known}");
    }
    let decay = (-0.0952 * std::f64::consts::TAU / 25.75).exp();
    for attractor in &found.attractors {
        let [a, b] = [attractor.multipliers[0], attractor.multipliers[1]];
        let product = a[0] * b[0] - a[1] * b[1];
        assert!(attractor.continued && (product - decay).abs() < 1e-9, "{product}");
    }
}

const BACKLASH: &str = r#"
format = 1
name = "backlash"
[[inertia]]
name = "rotor"
inertia = 1
[[shaft]]
name = "mesh"
from = "rotor"
to = "ground"
stiffness = 100
damping = 0.6
clearance = 0.2
[[torque]]
name = "drive"
on = "rotor"
mean = 3
amplitude = 2.5
"#;

fn backlash(x: f64, v: f64, t: f64) -> f64 {
    let beyond = (x.abs() - 0.1).max(0.0) * x.signum();
    3.0 + 2.5 * (12.0 * t).cos() - 100.0 * beyond - 0.6 * v
}

// Source: the motion itself by fixed steps: it stays on each of the responses that are told, those of
// two and three periods too, and comes back after so many periods and no fewer.
#[test]
fn responses_of_several_periods_are_found() {
    let found = basins(BACKLASH, &at("12rad/s", "40"));
    let periods: Vec<u32> = found.attractors.iter().map(|a| a.periods).collect();
    assert!(periods.contains(&1) && periods.contains(&2) && periods.contains(&3), "{periods:?}");
    for attractor in &found.attractors {
        let start = (attractor.twist[0], attractor.rate[0]);
        for period in 1..=attractor.periods as usize {
            let (x, v) = run(backlash, start, 12.0, period);
            let back = (x - start.0).hypot((v - start.1) / 12.0) < 1e-3;
            assert_eq!(back, period == attractor.periods as usize, "{period} {attractor:?}");
        }
    }
    let sum: f64 = found.attractors.iter().map(|a| a.share).sum();
    assert!((sum + found.undecided + found.escaped - 1.0).abs() < 1e-12);
}

// Source: energy: a softening spring lets go of what is thrown beyond its saddles.
#[test]
fn what_is_thrown_over_the_saddle_escapes() {
    let text = lines::duffing(0.05, 1.0, -0.1, 0.18);
    let mut question = at("0.6rad/s", "31");
    question.window = some("-6rad..6rad,-3rad/s..3rad/s");
    let found = basins(&text, &question);
    assert!(found.escaped > 0.1 && found.escaped < 0.9, "{}", found.escaped);
    // The saddles stand at sqrt(1 / 0.1) = 3.16 rad.
    let (row, last) = (15, found.grid.twist.len() - 1);
    assert_eq!((found.grid.attractor[row][0], found.grid.attractor[row][last]), (-1, -1));
}

// Source: the promise: numbers do not depend on what else is in the grid.
#[test]
fn a_state_leads_to_the_same_response_in_any_grid() {
    let mut question = at("25.75rad/s", "33");
    question.window = some("-8rad..8rad,-200rad/s..200rad/s");
    let fine = basins(THEORY, &question);
    question.grid = some("17x9");
    let coarse = basins(THEORY, &question);
    for (row, list) in coarse.grid.attractor.iter().enumerate() {
        for (column, own) in list.iter().enumerate() {
            assert_eq!(*own, fine.grid.attractor[4 * row][2 * column], "{row} {column}");
        }
    }
}

/// Which of two responses of the theory's oscillator it settles to after a jump of the rate at a time
/// of response `from`, by fixed steps: so many a period until it is near one.
fn settles(found: &BasinsResult, from: usize, (time, jump): (f64, f64), steps: usize) -> usize {
    let period = std::f64::consts::TAU / 25.75;
    let start = |index: usize| {
        let attractor = &found.attractors[index];
        (attractor.twist[0], attractor.rate[0])
    };
    let apart = |a: (f64, f64), b: (f64, f64)| (a.0 - b.0).hypot((a.1 - b.1) / 25.75);
    let near = 0.05 * apart(start(0), start(1));
    let part = |from: f64, to: f64| ((to - from) / period * steps as f64).ceil().max(1.0) as usize;
    let (x, v) = between(theory, start(from), (0.0, time), part(0.0, time));
    let mut state = between(theory, (x, v + jump), (time, period), part(time, period));
    for _ in 0..3000 {
        if let Some(index) = (0..2).find(|index| apart(state, start(*index)) < near) {
            return index;
        }
        state = between(theory, state, (0.0, period), steps);
    }
    panic!("settles to nothing");
}

// Source: the same motions by the classical method of Runge and Kutta with fixed steps: a thousandth
// more throws the line over, a thousandth less does not, and nothing smaller does at any of 64 moments.
#[test]
fn the_smallest_shock_is_just_enough_and_no_smaller_one_is() {
    const SIZES: usize = 16;
    let found = basins(THEORY, &at("25.75rad/s", "21"));
    let search = found.shock_search.as_ref().expect("two responses are stable");
    // Larger shocks throw it over the saddles.
    let between: Vec<_> = found.shocks.iter().filter(|shock| shock.to.is_some()).collect();
    let pairs: Vec<_> = between.iter().map(|shock| (shock.from, shock.to)).collect();
    assert_eq!(pairs, [(0, Some(1)), (1, Some(0))]);
    let period = std::f64::consts::TAU / 25.75;
    for shock in between {
        let (impulse, time) = (shock.impulse.expect("is found"), shock.time.expect("is found"));
        let phase = shock.phase.expect("is found");
        assert_eq!((shock.node.as_str(), search.node.as_str()), ("disc", "disc"));
        assert!((phase - 25.75 * time).abs() < 1e-9 && (0.0..period).contains(&time));
        assert!(impulse.abs() < search.largest_impulse);
        let ends = |factor: f64| settles(&found, shock.from, (time, factor * impulse), 400);
        assert_eq!((ends(1.001), ends(0.999)), (1 - shock.from, shock.from), "{shock:?}");
        for number in 0..64 * SIZES {
            let moment = period * ((number % 64) as f64 + 0.25) / 64.0;
            let size = 0.995 * impulse.abs() * ((number / 64) as f64 + 1.0) / SIZES as f64;
            for jump in [size, -size] {
                let end = settles(&found, shock.from, (moment, jump), 64);
                assert_eq!(end, shock.from, "{jump} at {moment} is less than {shock:?}");
            }
        }
    }
}

// Source: the promise: neither what is in the grid nor which thread follows a motion has an effect.
#[test]
fn the_smallest_shocks_are_the_same_with_any_grid() {
    let mut question = at("25.75rad/s", "33");
    question.window = some("-8rad..8rad,-200rad/s..200rad/s");
    let fine = basins(THEORY, &question);
    question.grid = some("17x9");
    let coarse = basins(THEORY, &question);
    assert_eq!((&fine.shocks, &fine.shock_search), (&coarse.shocks, &coarse.shock_search));
    assert_eq!(fine.shock_search.map(|search| search.largest_impulse), Some(400.0));
}

// Source: an ideal gear: an impulse on the fast side is one of `ratio` times the size on the slow one.
#[test]
fn a_shock_before_a_gear_is_smaller_by_the_ratio() {
    let geared = format!(
        "{THEORY}[[gear]]\nname = \"gear\"\ninput = \"pinion\"\noutput = \"disc\"\nratio = -4\n"
    );
    let mut question = at("25.75rad/s", "11");
    let slow = basins(&geared, &question);
    question.shock = some("pinion");
    let fast = basins(&geared, &question);
    assert!(slow.shocks.len() >= 2 && slow.shocks.len() == fast.shocks.len());
    for (slow, fast) in slow.shocks.iter().zip(&fast.shocks) {
        let ratio = slow.impulse.expect("is found") / fast.impulse.expect("is found");
        assert!((ratio + 4.0).abs() < 1e-5, "{ratio}");
        assert!((slow.phase.expect("is found") - fast.phase.expect("is found")).abs() < 1e-2);
        assert_eq!((slow.node.as_str(), fast.node.as_str()), ("disc", "pinion"));
    }
}

// Source: a linear line has one response, from which nothing leads away.
#[test]
fn a_single_response_cannot_be_left() {
    let found = basins(&lines::duffing(0.05, 1.0, 0.0, 0.18), &at("0.9rad/s", "11"));
    assert_eq!(found.attractors.len(), 1);
    assert!(found.shocks.is_empty() && found.shock_search.is_none());
}

// Source: energy: it takes k²/(4 |k3|) to reach the saddle at sqrt(k/|k3|), and damping takes
// c sqrt(|k3|/2) 2/3 (k/|k3|)^(3/2) on the way; the weak excitation helps by its torque times the way
// and its own speed at most.
#[test]
fn the_smallest_shock_over_the_saddle_has_its_energy() {
    let mut question = at("0.6rad/s", "21");
    question.window = some("-6rad..6rad,-3rad/s..3rad/s");
    let found = basins(&lines::duffing(0.01, 1.0, -0.1, 0.01), &question);
    assert_eq!((found.attractors.len(), found.shocks.len()), (1, 1));
    let shock = &found.shocks[0];
    assert_eq!((shock.from, shock.to), (0, None));
    let saddle = 10.0_f64.sqrt();
    let energy = 2.5 + 0.01 * 0.05_f64.sqrt() * 2.0 / 3.0 * saddle.powi(3);
    let (most, least) = ((2.0 * energy).sqrt(), (2.0 * (energy - 0.01 * saddle)).sqrt() - 0.02);
    let impulse = shock.impulse.expect("is found").abs();
    assert!(impulse < most && impulse > least, "{least} < {impulse} < {most}");
}
