//! `bifurcation`: what the line settles to on stepwise sweeps.

mod common;

use std::sync::atomic::{AtomicUsize, Ordering};

use common::{line_of, of_kind, question, resonance, some, try_ask};
use halfshaft_analysis::ask;
use halfshaft_model::question::{QuestionText, Verb};
use halfshaft_numerics::Complex;
use halfshaft_numerics::observer::Observer;
use halfshaft_results::{Answer, BifurcationResult, Reason, SpecialKind, Status};

/// `x'' + c x' + k x + q x² + g x³ = P cos W t`.
const OSCILLATOR: &str = r#"
format = 1
name = "Oscillator"
[[inertia]]
name = "mass"
inertia = 1
[[shaft]]
name = "spring"
from = "mass"
to = "ground"
stiffness = 1
damping = 0.1
quadratic = 0.0
cubic = 0.0
[[torque]]
name = "drive"
on = "mass"
amplitude = 1
"#;

fn swept(settings: &[&str], question: &QuestionText) -> BifurcationResult {
    match try_ask(&line_of(OSCILLATOR, settings), Verb::Bifurcation, question) {
        Ok(Answer::Bifurcation(result)) => result,
        other => panic!("{other:?}"),
    }
}

fn over(frequency: &str, steps: usize) -> QuestionText {
    let steps = Some(steps.to_string());
    QuestionText { frequency: some(frequency), steps, ..QuestionText::default() }
}

/// Points of `resonance` of a kind over the same range, on branches of so many periods.
fn located(settings: &[&str], frequency: &str, periods: u32, kind: SpecialKind) -> Vec<f64> {
    let question = QuestionText {
        method: some("harmonic-balance"),
        frequency: some(frequency),
        ..QuestionText::default()
    };
    let result = resonance(&line_of(OSCILLATOR, settings), &question);
    let branches = result.branches.iter().filter(|branch| branch.periods == periods);
    let points = branches.flat_map(|branch| of_kind(&branch.special_points, kind));
    points
        .map(|point| {
            assert_eq!(point.status, Status::Located);
            point.value("frequency").expect("has one")
        })
        .collect()
}

/// State and variation of `x'' + c x' + k x + g x³ = P cos W t`, by the classical method of Runge and
/// Kutta with fixed steps, over a period; gives the state and how much the variation grew.
fn runge_kutta([c, k, g, p, w]: [f64; 5], y: &mut [f64; 4]) -> f64 {
    const STEPS: usize = 500;
    let f = |t: f64, y: &[f64; 4]| {
        let [x, v, dx, dv] = *y;
        let a = p * (w * t).cos() - c * v - k * x - g * x * x * x;
        [v, a, dv, -c * dv - (k + 3.0 * g * x * x) * dx]
    };
    let h = std::f64::consts::TAU / w / STEPS as f64;
    let moved = |y: &[f64; 4], d: &[f64; 4], h: f64| std::array::from_fn(|i| y[i] + h * d[i]);
    for step in 0..STEPS {
        let t = h * step as f64;
        let k1 = f(t, y);
        let k2 = f(t + 0.5 * h, &moved(y, &k1, 0.5 * h));
        let k3 = f(t + 0.5 * h, &moved(y, &k2, 0.5 * h));
        let k4 = f(t + h, &moved(y, &k3, h));
        for i in 0..4 {
            y[i] += h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]);
        }
    }
    let size = y[2].hypot(y[3]);
    (y[2], y[3]) = (y[2] / size, y[3] / size);
    size.ln()
}

// Source: the closed form of a linear oscillator: its response at phase 0, its rate of decay -c/2m, and
// Liouville's theorem for the sum of the exponents, -c/m.
#[test]
fn a_linear_oscillator_is_as_its_closed_form() {
    let question = QuestionText { transient: some("2000"), ..over("0.5..1.7", 13) };
    let result = swept(&[], &question);
    assert_eq!(result.values.rows(), 26);
    assert_eq!(result.columns[0].values.len(), 26, "one point each");
    let all = |name: &str, value: f64| {
        for x in result.values.values(name) {
            assert!((x - value).abs() < 1e-9, "{name} {x}");
        }
    };
    all("period", 1.0);
    all("lyapunov_exponent", -0.05);
    all("lyapunov_sum", -0.1);
    for row in 0..26 {
        let w = result.columns[0].values[row];
        let response = Complex::new(1.0, 0.0) / Complex::new(1.0 - w * w, 0.1 * w);
        let rate = response * Complex::new(0.0, w);
        assert!((result.columns[2].values[row] - response.re).abs() < 1e-6);
        assert!((result.columns[3].values[row] - rate.re).abs() < 1e-6);
        let amplitude = result.values.values("amplitude")[row];
        assert!((amplitude / response.modulus() - 1.0).abs() < 1e-6, "{amplitude}");
    }
    assert!(result.values.values("matches_branch").iter().all(|branch| *branch == 0.0));
    assert!(result.jumps.is_empty(), "{:?}", result.jumps);
}

// Source: the folds that `resonance` locates by continuation.
#[test]
fn hysteresis_lies_between_the_folds() {
    let settings = ["spring.cubic=0.1"];
    let range = "1.3..2.1";
    let mut folds = located(&settings, range, 1, SpecialKind::Fold);
    folds.sort_by(f64::total_cmp);
    let [low, high] = folds[..] else { panic!("{folds:?}") };
    let question = QuestionText { transient: some("1500"), ..over(range, 81) };
    let result = swept(&settings, &question);
    let step = 0.01 + 1e-9;
    let jumped = |direction: f64| {
        let own: Vec<_> = result.jumps.iter().filter(|j| j.direction == direction).collect();
        assert_eq!(own.len(), 1, "{:?}", result.jumps);
        *own[0]
    };
    let (up, down) = (jumped(1.0), jumped(-1.0));
    assert!(up.last <= high && high <= up.first + step, "{up:?} {high}");
    assert!(down.first - step <= low && low <= down.last, "{down:?} {low}");
    assert!(up.after < up.before && down.after > down.before);
    // Every motion that repeats is one of the continued responses.
    let (periods, on) = (result.values.values("period"), result.values.values("matches_branch"));
    assert!(periods.iter().zip(on).all(|(p, on)| *p != 1.0 || *on == 0.0), "{periods:?} {on:?}");
    assert!(periods.iter().filter(|period| **period != 1.0).count() <= 2, "{periods:?}");
}

// Source: the period doublings that `resonance` locates by continuation; Liouville's theorem.
#[test]
fn the_period_doubles_where_continuation_locates_it() {
    let settings = ["spring.quadratic=0.3", "spring.cubic=0.05", "drive.amplitude=2"];
    let range = "1.5..3";
    let mut doublings = located(&settings, range, 1, SpecialKind::PeriodDoubling);
    doublings.sort_by(f64::total_cmp);
    let question = QuestionText { transient: some("1000"), ..over(range, 151) };
    let result = swept(&settings, &question);
    let values = &result.values;
    let step = 0.01 + 1e-9;
    for direction in [1.0, -1.0] {
        let rows: Vec<usize> = (0..values.rows())
            .filter(|row| values.values("direction")[*row] == direction)
            .collect();
        let period = |row: usize| values.values("period")[row];
        let doubled: Vec<f64> = rows
            .iter()
            .filter(|row| period(**row) != 1.0)
            .map(|row| values.values("frequency")[*row])
            .collect();
        let low = doubled.iter().copied().fold(f64::INFINITY, f64::min);
        let high = doubled.iter().copied().fold(0.0, f64::max);
        assert!((low - doublings[0]).abs() <= step, "{low} {doublings:?}");
        // The doubled branch turns over and ends in a fold beyond: going down it is not met before.
        assert!(high >= doublings[0], "{high} {doublings:?}");
        assert!(rows.iter().filter(|row| period(**row) == 2.0).count() > 20);
    }
    for (sum, largest) in
        values.values("lyapunov_sum").iter().zip(values.values("lyapunov_exponent"))
    {
        assert!((sum + 0.1).abs() < 1e-8, "{sum}");
        assert!((-0.05 - 1e-9..1e-3).contains(largest), "{largest}");
    }
    let on = values.values("matches_branch");
    let lost = on.iter().zip(values.values("period")).filter(|(on, p)| **p > 0.0 && on.is_nan());
    // Next to a doubling a motion settles too slowly to be told from others.
    assert!(lost.count() <= 2);
}

// Source: Y. Ueda's oscillator x'' + 0.05 x' + x³ = 7.5 cos t, whose largest exponent is about 0.10; here
// by the classical method of Runge and Kutta with fixed steps and Benettin's renormalisation.
#[test]
fn a_chaotic_motion_has_the_exponent_of_another_method() {
    const PERIODS: usize = 4000;
    let mut state = [2.5, 0.0, 1.0, 0.0];
    let coefficients = [0.05, 0.001, 1.0, 7.5, 1.0];
    (0..100).for_each(|_| {
        runge_kutta(coefficients, &mut state);
    });
    let sum: f64 = (0..PERIODS).map(|_| runge_kutta(coefficients, &mut state)).sum();
    let reference = sum / (PERIODS as f64 * std::f64::consts::TAU);
    let settings =
        ["spring.stiffness=0.001", "spring.cubic=1", "spring.damping=0.05", "drive.amplitude=7.5"];
    let question = QuestionText {
        points: Some(PERIODS.to_string()),
        direction: some("up"),
        no_branches: true,
        ..over("1..1.0001", 2)
    };
    let result = swept(&settings, &question);
    let own = result.values.values("lyapunov_exponent")[0];
    assert!((0.08..0.13).contains(&reference), "{reference}");
    assert!((own - reference).abs() < 0.01, "{own} {reference}");
    assert!((result.values.values("lyapunov_sum")[0] + 0.05).abs() < 1e-7);
    assert_eq!(result.values.values("period")[0], 0.0);
    let table = result.table();
    assert_eq!(table.rows(), 2 * PERIODS);
    // The strange attractor lies in the window in which the literature draws it.
    assert!(table.values("spring.twist").iter().all(|x| (1.0..4.2).contains(x)));
}

// Source: a state on the mirror symmetry stays there in computing only; where the symmetric response is
// unstable the motion must be another. The branch point is that of `resonance`.
#[test]
fn a_motion_does_not_stay_on_an_unstable_symmetric_response() {
    let settings = ["spring.stiffness=0.001", "spring.cubic=1", "drive.amplitude=4"];
    let question = QuestionText { transient: some("1000"), ..over("0.7..1.6", 46) };
    let result = swept(&settings, &question);
    let exponents = result.values.values("lyapunov_exponent");
    let period = result.values.values("period");
    for (exponent, period) in exponents.iter().zip(period) {
        assert!(*period == 0.0 || *exponent < 0.0, "{period} {exponent}");
    }
    let branches = result.values.values("matches_branch");
    let kinds: std::collections::BTreeSet<i64> =
        branches.iter().filter(|b| b.is_finite()).map(|b| *b as i64).collect();
    assert!(kinds.len() > 1, "{branches:?}");
}

/// A gap of 2 rad around the unloaded shaft.
const GAP: &str = r#"
format = 1
name = "Gap"
[[inertia]]
name = "disc"
inertia = 1
damping = 0.1
[[shaft]]
name = "mesh"
from = "disc"
to = "ground"
stiffness = 1
clearance = "2 rad"
[[torque]]
name = "drive"
on = "disc"
amplitude = 0.5
"#;

// Source: the same motion by the classical method of Runge and Kutta with steps so small that the error
// at the kinks does not count.
#[test]
fn kinks_are_met_exactly() {
    let question = QuestionText { transient: some("600"), ..over("0.6..0.7", 3) };
    let result = match try_ask(&line_of(GAP, &[]), Verb::Bifurcation, &question) {
        Ok(Answer::Bifurcation(result)) => result,
        other => panic!("{other:?}"),
    };
    for row in 0..result.values.rows() {
        assert_eq!(result.values.values("period")[row], 1.0);
        assert!(result.values.values("matches_branch")[row].is_finite());
        let w = result.columns[0].values[row];
        let own = (result.columns[2].values[row], result.columns[3].values[row]);
        let end = around_gap(own, w);
        let apart = (end.0 - own.0).hypot(end.1 - own.1);
        assert!(apart < 1e-5, "{w}: {own:?} {end:?}");
    }
}

/// The state of the disc in its gap a period on.
fn around_gap((mut x, mut v): (f64, f64), w: f64) -> (f64, f64) {
    const STEPS: usize = 100_000;
    let f = |t: f64, x: f64, v: f64| 0.5 * (w * t).cos() - 0.1 * v - (x - x.clamp(-1.0, 1.0));
    let h = std::f64::consts::TAU / w / STEPS as f64;
    for step in 0..STEPS {
        let t = h * step as f64;
        let (v1, a1) = (v, f(t, x, v));
        let (v2, a2) = (v + 0.5 * h * a1, f(t + 0.5 * h, x + 0.5 * h * v1, v + 0.5 * h * a1));
        let (v3, a3) = (v + 0.5 * h * a2, f(t + 0.5 * h, x + 0.5 * h * v2, v + 0.5 * h * a2));
        let (v4, a4) = (v + h * a3, f(t + h, x + h * v3, v + h * a3));
        x += h / 6.0 * (v1 + 2.0 * (v2 + v3) + v4);
        v += h / 6.0 * (a1 + 2.0 * (a2 + a3) + a4);
    }
    (x, v)
}

// Source: a linear oscillator's twist is in proportion to the amplitude of the torque.
#[test]
fn a_number_of_the_line_may_run_at_one_speed() {
    let question = QuestionText {
        parameter: some("drive.amplitude=0..2"),
        transient: some("2000"),
        ..over("1.3", 5)
    };
    let result = swept(&[], &question);
    assert_eq!((result.swept.as_str(), result.frequency), ("drive.amplitude", Some(1.3)));
    let response = Complex::new(1.0, 0.0) / Complex::new(1.0 - 1.69, 0.13);
    for (p, x) in result.columns[0].values.iter().zip(&result.columns[2].values) {
        assert!((x - p * response.re).abs() < 1e-6, "{p} {x}");
    }
    let on = result.values.values("matches_branch");
    assert!(on[1..9].iter().all(|branch| *branch == 0.0), "{on:?}");
}

// Source: a softening cubic spring carries 2/3 sqrt(k³/3|g|) at most.
#[test]
fn a_motion_that_runs_away_is_told() {
    let settings = ["spring.cubic=-1", "drive.amplitude=2"];
    let result = swept(&settings, &QuestionText { no_branches: true, ..over("0.1..3", 5) });
    let escaped = result.values.values("escaped");
    assert_eq!(escaped[0], 1.0, "2 N·m are far more than 0.385 N·m");
    assert!(result.header.warnings.iter().any(|warning| warning.contains("ran away")));
    assert!(result.values.values("period")[0].is_nan());
}

struct StopsAfter(AtomicUsize);

impl Observer for StopsAfter {
    fn cancelled(&self) -> bool {
        self.0.fetch_sub(1, Ordering::Relaxed) <= 1
    }
}

// Source: the contract of observers: what was reached is kept, with a reason.
#[test]
fn what_was_reached_is_kept() {
    let line = line_of(OSCILLATOR, &[]);
    let asked = question(&line, Verb::Bifurcation, &over("0.5..1.7", 13));
    let stopped = ask(&line, &asked, &StopsAfter(AtomicUsize::new(900))).expect("something");
    let Answer::Bifurcation(stopped) = stopped else { panic!("another answer") };
    assert_eq!(stopped.header.termination.reason, Reason::Cancelled);
    let rows = stopped.values.rows();
    assert!(rows > 0 && rows < 26, "{rows}");
    let text = serde_json::to_string(&Answer::Bifurcation(stopped.clone())).expect("plain data");
    let back: Answer = serde_json::from_str(&text).expect("own text");
    assert_eq!(back, Answer::Bifurcation(stopped));
}
