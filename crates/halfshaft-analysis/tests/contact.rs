//! Laws with kinks in harmonic balance: the one-sided contact of the reference cases, and how honest
//! the truncation estimate is there.

mod common;

use common::{assert_close, line_of, of_kind, resonance, some};
use halfshaft_model::question::QuestionText;
use halfshaft_results::{ResonanceResult, SpecialKind, SpecialPoint, Status};

/// `M = I`, `K = [[1, -1], [-1, 2]]`, `D = 0.03 K`, a stop at 1 rad with stiffness 100 on the first.
const ONE_SIDED: &str = r#"
format = 1
name = "One-sided contact"
[[inertia]]
name = "n1"
inertia = 1
[[inertia]]
name = "n2"
inertia = 1
[[shaft]]
name = "coupling"
from = "n1"
to = "n2"
stiffness = 1
damping = 0.03
[[shaft]]
name = "mount"
from = "n2"
to = "ground"
stiffness = 1
damping = 0.03
[[shaft]]
name = "stop"
from = "n1"
to = "ground"
contact = "1 rad"
stiffness = 100
[[torque]]
name = "drive"
on = "n2"
amplitude = 0.1
"#;

/// A stop on one side only, and a gap with a mean torque in it: both begin and cease to touch.
const BACKLASH: &str = r#"
format = 1
name = "Backlash"
[[inertia]]
name = "n1"
inertia = 1
damping = 0.1
[[shaft]]
name = "mesh"
from = "n1"
to = "ground"
stiffness = 1
clearance = "2 rad"
[[torque]]
name = "drive"
on = "n1"
mean = 0.3
amplitude = 0.2
"#;

fn asked(text: &str, settings: &[&str], frequency: &str) -> ResonanceResult {
    let question = QuestionText {
        method: some("harmonic-balance"),
        frequency: some(frequency),
        verify: true,
        ..QuestionText::default()
    };
    resonance(&line_of(text, settings), &question)
}

fn kinds(result: &ResonanceResult, periods: u32, kind: SpecialKind) -> Vec<&SpecialPoint> {
    let branches = result.branches.iter().filter(|branch| branch.periods == periods);
    branches.flat_map(|branch| of_kind(&branch.special_points, kind)).collect()
}

#[track_caller]
fn found<'r>(points: &[&'r SpecialPoint], frequency: f64, relative: f64) -> &'r SpecialPoint {
    let near = |point: &&&SpecialPoint| {
        (point.value("frequency").expect("has one") / frequency - 1.0).abs() < relative
    };
    let found: Vec<_> = points.iter().filter(near).collect();
    assert_eq!(found.len(), 1, "{frequency}: {points:?}");
    assert_eq!(found[0].status, Status::Located);
    found[0]
}

/// An inertia on a spring with a stop whose damper acts in contact only: torque jumps there.
const JUMPING: &str = r#"
format = 1
name = "Damped stop"
[[inertia]]
name = "n1"
inertia = 1
[[shaft]]
name = "spring"
from = "n1"
to = "ground"
stiffness = 1
damping = 0.1
[[shaft]]
name = "stop"
from = "n1"
to = "ground"
contact = "1 rad"
stiffness = 20
damping = 1.5
damping_acts = "in contact"
[[torque]]
name = "drive"
on = "n1"
amplitude = 0.3
"#;

/// Every verified sample agrees with the motion itself.
fn hold_against_the_motion(result: &ResonanceResult, tolerance: f64) {
    assert!(result.verification.len() > 8);
    for point in &result.verification {
        assert!(point.relative_difference.abs() < tolerance, "{point:?}");
        assert_eq!(point.predicted_stable, point.integrated_stable, "{point:?}");
        assert!(point.orbit_residual < 1e-10, "{point:?}");
    }
}

// Source: the reference case, from an exact piecewise-linear solution.
#[test]
fn one_sided_contact_has_its_reference_points() {
    let result = asked(ONE_SIDED, &[], "0.55..0.8");
    let first: Vec<_> = result.branches.iter().filter(|branch| branch.periods == 1).collect();
    assert_eq!(first.len(), 1, "one curve from border to border");
    let folds = kinds(&result, 1, SpecialKind::Fold);
    let fold = found(&folds, 0.755_627_352_6, 1e-10);
    let twist = |name: &str| fold.value(&format!("stop.twist.{name}")).expect("a channel");
    assert!(fold.value("precision").expect("has one") < 1e-11);
    // The angle of n1 is the twist of the stop; its greatest value at the fold is given.
    assert_close(twist("maximum"), 1.068_863, 5e-7);
    let doublings = kinds(&result, 1, SpecialKind::PeriodDoubling);
    assert_eq!(doublings.len(), 2);
    found(&doublings, 0.755_586_159_4, 1e-10);
    found(&doublings, 0.738_783_025_4, 1e-10);
    let tori = kinds(&result, 1, SpecialKind::NeimarkSacker);
    let torus = found(&tori, 0.618_606_874_3, 1e-10);
    let angle = 0.997_564_f64.atan2(-0.069_761);
    assert_close(torus.value("multiplier_angle").expect("has one"), angle, 1e-6);
    assert_close(torus.value("largest_multiplier").expect("has one"), 1.0, 1e-9);
    // Where the linear response touches.
    let grazing = kinds(&result, 1, SpecialKind::GrazingContact);
    assert_eq!(grazing.len(), 2);
    found(&grazing, 0.581_899_639_0, 1e-10);
    let point = found(&grazing, 0.653_440_140_4, 1e-10);
    let note = point.note.as_deref().expect("says what touches");
    assert_eq!(note, "the twist of `stop` touches 1 rad from below");
    hold_against_the_motion(&result, 1e-6);
    // The branch of twice the period goes from the one period doubling to the other.
    let doubled: Vec<_> = result.branches.iter().filter(|branch| branch.periods == 2).collect();
    assert_eq!(doubled.len(), 1);
    let speeds = doubled[0].values("frequency");
    let mut ends = [speeds[0], speeds[speeds.len() - 1]];
    ends.sort_by(f64::total_cmp);
    assert_close(ends[0], 0.738_783_025_4, 1e-10);
    assert_close(ends[1], 0.755_586_159_4, 1e-10);
}

/// Amplitudes of all responses of some periods at a speed, by the samples on both sides.
fn amplitudes_at(result: &ResonanceResult, periods: u32, speed: f64) -> Vec<f64> {
    let mut found = Vec::new();
    for branch in result.branches.iter().filter(|branch| branch.periods == periods) {
        let speeds = branch.values("frequency");
        let values = branch.values("coupling.twist.amplitude");
        for k in 1..speeds.len() {
            let (a, b) = (speeds[k - 1], speeds[k]);
            if (a - speed) * (b - speed) <= 0.0 && a != b {
                let part = (speed - a) / (b - a);
                found.push(values[k - 1] + part * (values[k] - values[k - 1]));
            }
        }
    }
    found
}

// Source: the same line asked over the wide range, held against the reference above; no narrow one
// contains the start of the branch in contact.
#[test]
fn narrow_windows_have_all_that_wide_ones_have() {
    let ask = |range: &str| {
        let question = QuestionText {
            method: some("harmonic-balance"),
            frequency: some(range),
            ..QuestionText::default()
        };
        resonance(&line_of(ONE_SIDED, &[]), &question)
    };
    let wide = ask("0.55..0.8");
    for (low, high) in [(0.6, 0.62), (0.655, 0.66), (0.7, 0.71), (0.735, 0.742), (0.7553, 0.7558)] {
        let narrow = ask(&format!("{low}..{high}"));
        for part in [0.1, 0.45, 0.9] {
            let speed = low + part * (high - low);
            for periods in [1, 2] {
                let known = amplitudes_at(&narrow, periods, speed);
                for amplitude in amplitudes_at(&wide, periods, speed) {
                    let near = |value: &f64| (value / amplitude - 1.0).abs() < 5e-3;
                    assert!(
                        known.iter().any(near),
                        "{low}..{high}: {amplitude} every {periods} at {speed} is not in {known:?}"
                    );
                }
            }
        }
        for kind in [SpecialKind::Fold, SpecialKind::PeriodDoubling, SpecialKind::NeimarkSacker] {
            for periods in [1, 2] {
                for point in kinds(&wide, periods, kind) {
                    let speed = point.value("frequency").expect("has one");
                    if speed > low && speed < high {
                        found(&kinds(&narrow, periods, kind), speed, 1e-9);
                    }
                }
            }
        }
    }
}

// Source: before it touches the line is linear: |0.3 / (1 - Ω² + 0.1 i Ω)| = 1. Then the mean torque of
// the stop holds that of the spring, and orbits by Taylor series know nothing of harmonics.
#[test]
fn a_stop_whose_damper_acts_in_contact_only() {
    let result = asked(JUMPING, &[], "0.4..2.5");
    hold_against_the_motion(&result, 1e-6);
    let grazing = kinds(&result, 1, SpecialKind::GrazingContact);
    let root = (1.99_f64.powi(2) - 4.0 * 0.91).sqrt();
    for square in [0.5 * (1.99 - root), 0.5 * (1.99 + root)] {
        found(&grazing, square.sqrt(), 1e-10);
    }
    assert_eq!(grazing.len(), 2);
    for branch in result.branches.iter().filter(|branch| branch.periods == 1) {
        let spring = branch.values("spring.torque.mean");
        let stop = branch.values("stop.torque.mean");
        let size = branch.values("stop.torque.amplitude");
        let touching = (0..size.len()).filter(|k| size[*k] > 0.0);
        assert!(touching.clone().count() > 20);
        for k in touching {
            assert!((spring[k] + stop[k]).abs() < 2e-6 * size[k], "{k}: {} {}", spring[k], stop[k]);
        }
    }
}

// Source: orbits by Taylor series from contact to contact, which know nothing of harmonics.
#[test]
fn backlash_under_a_mean_torque_agrees_with_its_motion() {
    for mean in ["0.3", "0.05"] {
        let result = asked(BACKLASH, &[&format!("drive.mean={mean}")], "0.4..1.4");
        hold_against_the_motion(&result, 1e-6);
        assert!(!kinds(&result, 1, SpecialKind::GrazingContact).is_empty(), "{mean}");
    }
}
