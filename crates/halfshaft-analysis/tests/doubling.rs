//! Period doublings of smooth lines and the branches of twice the period.

mod common;

use common::{line_of, of_kind, resonance, some};
use halfshaft_model::question::QuestionText;
use halfshaft_numerics::Complex;
use halfshaft_numerics::ode::periodic::{PeriodicSettings, find_orbit};
use halfshaft_numerics::ode::{Linearised, System};
use halfshaft_results::{Branch, ResonanceResult, SpecialKind, Status};

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

fn asked(settings: &[&str], frequency: &str) -> ResonanceResult {
    let question = QuestionText {
        method: some("harmonic-balance"),
        frequency: some(frequency),
        verify: true,
        ..QuestionText::default()
    };
    resonance(&line_of(OSCILLATOR, settings), &question)
}

fn frequencies(branch: &Branch, kind: SpecialKind) -> Vec<f64> {
    let points = of_kind(&branch.special_points, kind);
    points
        .iter()
        .map(|point| {
            assert_eq!(point.status, Status::Located);
            point.value("frequency").expect("has one")
        })
        .collect()
}

/// Every verified sample agrees with the motion itself, in its multipliers too.
fn hold_against_the_motion(result: &ResonanceResult) {
    assert!(result.verification.len() > 8);
    for point in &result.verification {
        assert!(point.relative_difference.abs() < 1e-8, "{point:?}");
        assert_eq!(point.predicted_stable, point.integrated_stable, "{point:?}");
        let predicted = point.predicted_multiplier.expect("has one");
        assert!((predicted / point.largest_multiplier - 1.0).abs() < 1e-6, "{point:?}");
    }
}

/// Multipliers of `x'' + 0.1 x' + x + 0.3 x² + 0.05 x³ = 2 cos W t` by the integrator of order 8.
fn multipliers_of_the_quadratic_case(speed: f64) -> Vec<Complex> {
    struct Equation(f64);
    impl System for Equation {
        fn dimension(&self) -> usize {
            2
        }
        fn derivative(&mut self, t: f64, y: &[f64], rate: &mut [f64]) {
            let x = y[0];
            rate[0] = y[1];
            rate[1] = 2.0 * (self.0 * t).cos() - 0.1 * y[1] - x * (1.0 + x * (0.3 + 0.05 * x));
        }
    }
    impl Linearised for Equation {
        fn linearised(&mut self, _: f64, y: &[f64], d: &[f64], out: &mut [f64]) {
            out[0] = d[1];
            out[1] = -0.1 * d[1] - (1.0 + y[0] * (0.6 + 0.15 * y[0])) * d[0];
        }
    }
    let guess = [2.0 / (1.0 - speed * speed), 0.0];
    let period = std::f64::consts::TAU / speed;
    let settings = PeriodicSettings::default();
    let orbit = find_orbit(&mut Equation(speed), 0.0, period, &guess, &settings).expect("an orbit");
    assert!(orbit.report.converged.is_converged());
    orbit.multipliers
}

// Source: the integrator of order 8 has a multiplier of -1 at each doubling; the branch of twice the
// period joins the two of them, and what lies on it is as the motion has it.
#[test]
fn a_branch_of_twice_the_period_joins_two_doublings() {
    let settings = ["spring.quadratic=0.3", "spring.cubic=0.05", "drive.amplitude=2"];
    let result = asked(&settings, "1.5..3");
    let of = |periods: u32| result.branches.iter().filter(move |b| b.periods == periods);
    let doublings: Vec<f64> =
        of(1).flat_map(|branch| frequencies(branch, SpecialKind::PeriodDoubling)).collect();
    assert_eq!(doublings.len(), 2);
    for speed in &doublings {
        let multipliers = multipliers_of_the_quadratic_case(*speed);
        let nearest = multipliers.iter().map(|m| (m.re + 1.0).hypot(m.im)).fold(1.0, f64::min);
        assert!(nearest < 1e-8, "{speed}: {multipliers:?}");
    }
    let longer: Vec<&Branch> = of(2).collect();
    assert_eq!(longer.len(), 1, "one branch, not one from each end");
    let speeds = longer[0].values("frequency");
    let mut ends = [speeds[0], speeds[speeds.len() - 1]];
    ends.sort_by(f64::total_cmp);
    assert!(ends.iter().zip(&doublings).all(|(a, b)| (a - b).abs() < 1e-12), "{ends:?}");
    assert!(!longer[0].closed);
    // It is born stable and dies stable, with an unstable stretch between two folds.
    assert_eq!(frequencies(longer[0], SpecialKind::Fold).len(), 2);
    assert!(longer[0].special_points.iter().all(|point| point.kind != SpecialKind::End));
    hold_against_the_motion(&result);
}

// Source: Y. Ueda's route of the forced oscillator with a cubic spring alone: the symmetric response
// loses its symmetry, the unsymmetric one doubles its period, and again; each response as the motion
// has it.
#[test]
fn symmetry_breaks_before_the_period_doubles() {
    let settings = ["spring.stiffness=0.001", "spring.cubic=1", "drive.amplitude=4"];
    let result = asked(&settings, "0.7..1.6");
    // Windows in the chaos beyond may follow.
    let [symmetric, unsymmetric, longer, ..] = &result.branches[..] else {
        panic!("{} branches", result.branches.len())
    };
    let broken = frequencies(symmetric, SpecialKind::BranchPoint);
    assert_eq!(broken.len(), 1);
    assert!(symmetric.values("spring.twist.mean").iter().all(|mean| *mean == 0.0));
    assert!((unsymmetric.values("frequency")[0] - broken[0]).abs() < 1e-12);
    let means = unsymmetric.values("spring.twist.mean");
    assert!(means[1..].iter().all(|mean| mean.abs() > 1e-4));
    let doubled = frequencies(unsymmetric, SpecialKind::PeriodDoubling);
    assert_eq!(doubled.len(), 1);
    assert_eq!((unsymmetric.periods, longer.periods), (1, 2));
    assert!((longer.values("frequency")[0] - doubled[0]).abs() < 1e-12);
    assert_eq!(frequencies(longer, SpecialKind::PeriodDoubling).len(), 1);
    // Just below its birth the longer response is stable.
    assert_eq!(longer.values("stable")[2], 1.0);
    hold_against_the_motion(&result);
}
