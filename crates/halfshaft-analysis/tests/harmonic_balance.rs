//! `resonance` by harmonic balance, held against published programs.
//!
//! Source of the numbers, unless a test says otherwise: AUTO-07p and a harmonic balance computation
//! independent of this one, which agree to the digits written here.

mod common;
#[path = "common/lines.rs"]
mod lines;

use common::{assert_close, line_of, of_kind, resonance, some};
use halfshaft_model::question::QuestionText;
use halfshaft_results::{ResonanceResult, SpecialKind, SpecialPoint, Status};

/// Branches over a range of speeds, rad/s.
fn over(text: &str, range: (f64, f64), options: &QuestionText) -> ResonanceResult {
    let frequency = Some(format!("{:?}..{:?}", range.0, range.1));
    let method = some("harmonic-balance");
    resonance(&line_of(text, &[]), &QuestionText { frequency, method, ..options.clone() })
}

fn tolerance(text: &str) -> QuestionText {
    QuestionText { tolerance: some(text), ..QuestionText::default() }
}

fn harmonics(count: usize) -> QuestionText {
    QuestionText { harmonics: Some(count.to_string()), ..QuestionText::default() }
}

/// Located special points of a kind, by ascending speed.
fn specials(result: &ResonanceResult, kind: SpecialKind) -> Vec<&SpecialPoint> {
    let mut points: Vec<&SpecialPoint> =
        result.branches.iter().flat_map(|branch| of_kind(&branch.special_points, kind)).collect();
    for point in &points {
        assert_eq!(point.status, Status::Located);
    }
    points.sort_by(|a, b| value(a, "frequency").total_cmp(&value(b, "frequency")));
    points
}

fn value(point: &SpecialPoint, name: &str) -> f64 {
    point.value(name).unwrap_or_else(|| panic!("has {name}"))
}

#[track_caller]
fn assert_fold(
    point: &SpecialPoint,
    channel: &str,
    frequency: f64,
    first: f64,
    digits: (f64, f64),
) {
    assert_close(value(point, "frequency"), frequency, digits.0);
    assert_close(value(point, &format!("{channel}.harmonic1")), first, digits.1);
}

#[test]
fn folds_of_the_duffing_oscillators() {
    let d1 = over(&lines::d1(), (0.2, 1.8), &tolerance("1e-8"));
    let folds = specials(&d1, SpecialKind::Fold);
    assert_eq!(folds.len(), 2);
    assert_eq!(d1.branches.len(), 1);
    // Ten digits of the speed; a first harmonic at a fold moves with the root of its error.
    assert_fold(folds[0], "spring.twist", 1.115_700_251_8, 1.081_870_32, (5e-11, 5e-9));
    assert_fold(folds[1], "spring.twist", 1.269_601_955_5, 2.825_016_71, (5e-11, 5e-9));
    // Source: shooting by the classical Runge-Kutta method of order 4, 800 steps a period, 1e-9 beside
    // the folds, moved to them by the known first harmonic. (Programs that report maxima over mesh
    // points print 1.08501 and 2.87117, which are a little less.)
    assert_close(value(folds[0], "spring.twist.amplitude"), 1.085_035, 2e-6);
    assert_close(value(folds[1], "spring.twist.amplitude"), 2.871_574_6, 1e-6);
    let d2 = over(&lines::d2(), (0.8, 1.3), &tolerance("1e-8"));
    let folds = specials(&d2, SpecialKind::Fold);
    assert_eq!(folds.len(), 2);
    assert_fold(folds[0], "spring.twist", 1.043_913_708_8, 0.236_622_95, (5e-11, 2e-8));
    assert_fold(folds[1], "spring.twist", 1.049_262_399_2, 0.347_131_55, (5e-11, 2e-8));
}

// The location of a special point does not hang on the tolerance of the branch.
#[test]
fn folds_stand_still_whatever_the_tolerance() {
    for text in ["1e-3", "1e-6", "1e-10"] {
        let result = over(&lines::d1(), (0.5, 1.6), &tolerance(text));
        let folds = specials(&result, SpecialKind::Fold);
        assert_eq!(folds.len(), 2, "at {text}");
        assert_close(value(folds[0], "frequency"), 1.115_700_251_8, 5e-11);
        assert_close(value(folds[1], "frequency"), 1.269_601_955_5, 5e-11);
    }
}

/// The largest first harmonic of a channel along a branch, by a parabola through three samples.
fn peak(result: &ResonanceResult, channel: &str) -> (f64, f64) {
    let branch = &result.branches[0];
    let (speeds, firsts) =
        (branch.values("frequency"), branch.values(&format!("{channel}.harmonic1")));
    let top =
        (1..firsts.len() - 1).max_by(|a, b| firsts[*a].total_cmp(&firsts[*b])).expect("samples");
    let [y0, y1, y2] = [firsts[top - 1], firsts[top], firsts[top + 1]];
    // Parametrised by the number of the sample, unevenly spaced: weights by chord lengths.
    let chord =
        |a: usize, b: usize| ((speeds[a] - speeds[b]) / 0.3).hypot((firsts[a] - firsts[b]) / 3.0);
    let (s0, s2) = (-chord(top, top - 1), chord(top, top + 1));
    let (d0, d2) = ((y0 - y1) / s0, (y2 - y1) / s2);
    let bend = (d2 - d0) / (s2 - s0);
    let slope = d0 - bend * s0;
    let s = -0.5 * slope / bend;
    let along = |x0: f64, x1: f64, x2: f64| {
        let (e0, e2) = ((x0 - x1) / s0, (x2 - x1) / s2);
        let bend = (e2 - e0) / (s2 - s0);
        x1 + (e0 - bend * s0) * s + bend * s * s
    };
    (along(speeds[top - 1], speeds[top], speeds[top + 2 - 1]), y1 + slope * s + bend * s * s)
}

#[test]
fn peaks_of_the_duffing_oscillators() {
    let fine = QuestionText { points: some("2000"), ..tolerance("1e-8") };
    let (speed, first) = peak(&over(&lines::d1(), (1.1, 1.4), &fine), "spring.twist");
    // Source: golden section on the first harmonic of orbits by shooting (classical Runge-Kutta of
    // order 4, 800 steps a period). The largest of AUTO-07p's computed points lies a little below:
    // 2.830192 and 0.358050.
    assert_close(first, 2.830_198_06, 1e-7);
    assert_close(speed, 1.268_716_7, 2e-5);
    let (speed, first) = peak(&over(&lines::d2(), (1.0, 1.1), &fine), "spring.twist");
    assert_close(first, 0.358_131_437, 1e-7);
    assert_close(speed, 1.046_782_0, 1e-5);
}

#[test]
fn folds_converge_with_the_harmonics_as_tabulated() {
    let upper =
        [(1, 1.267_536_959_5), (3, 1.269_600_032_1), (5, 1.269_601_954_4), (7, 1.269_601_955_5)];
    let lower = [(1, 1.115_585_927_2), (3, 1.115_700_246_9), (5, 1.115_700_251_8)];
    for (count, expected) in upper {
        let result = over(&lines::d1(), (0.9, 1.6), &harmonics(count));
        let folds = specials(&result, SpecialKind::Fold);
        assert_eq!(folds.len(), 2, "{count} harmonics");
        assert_close(value(folds[1], "frequency"), expected, 5e-11);
        if let Some((_, expected)) = lower.iter().find(|(n, _)| *n == count) {
            assert_close(value(folds[0], "frequency"), *expected, 5e-11);
        }
    }
    for (count, expected) in [(1, 1.049_131_685_9), (3, 1.049_262_391_8), (5, 1.049_262_399_2)] {
        let result = over(&lines::d2(), (0.9, 1.2), &harmonics(count));
        assert_close(value(specials(&result, SpecialKind::Fold)[1], "frequency"), expected, 5e-11);
    }
}

#[test]
fn the_theory_driveline_in_full() {
    let resonance = 26.057_723_985_895_066;
    let range = (resonance - 1.2, resonance + 0.8);
    let result = over(&lines::theory(15.0), range, &tolerance("1e-8"));
    let folds = specials(&result, SpecialKind::Fold);
    assert_eq!(folds.len(), 2);
    let sigma = |point: &SpecialPoint| value(point, "frequency") - resonance;
    // Twelve digits of the speed.
    assert!((sigma(folds[0]) + 0.371_482_075_875_3).abs() < 2e-10, "{}", sigma(folds[0]));
    assert!((sigma(folds[1]) + 0.166_536_153_76).abs() < 2e-10, "{}", sigma(folds[1]));
    assert_close(value(folds[0], "spring.twist.harmonic1"), 6.122_148_526_6, 1e-9);
    assert_close(value(folds[1], "spring.twist.harmonic1"), 2.530_280_001_8, 1e-9);
    let quiet = over(&lines::theory(5.0), range, &tolerance("1e-8"));
    assert!(specials(&quiet, SpecialKind::Fold).is_empty());
}

#[test]
fn a_chain_of_ten_nonlinear_shafts() {
    let result = over(&lines::chain(10, |_| true), (4.2, 5.2), &tolerance("1e-8"));
    let folds = specials(&result, SpecialKind::Fold);
    assert_eq!(folds.len(), 2);
    assert_fold(folds[0], "n9.angle", 4.590_778_663, 3.293_021_18, (3e-10, 5e-9));
    assert_fold(folds[1], "n9.angle", 4.641_482_002_1, 1.712_219_674_9, (3e-11, 1e-9));
}

#[test]
fn an_absorber_with_neimark_sacker_points() {
    for (options, pairs, folds, angles) in [
        (
            tolerance("1e-8"),
            [1.112_711_239_1, 1.195_736_669_1],
            [1.206_219_457_4, 1.214_626_225_2],
            Some([0.560_218, 0.476_273]),
        ),
        (
            harmonics(3),
            [1.112_713_054_9, 1.195_736_008_7],
            [1.206_219_437_2, 1.214_625_987_2],
            None,
        ),
    ] {
        let result = over(&lines::absorber(0.11), (0.9, 1.4), &options);
        let found = specials(&result, SpecialKind::NeimarkSacker);
        assert_eq!(found.len(), 2);
        for (point, expected) in found.iter().zip(pairs) {
            assert_close(value(point, "frequency"), expected, 5e-10);
        }
        for (point, expected) in found.iter().zip(angles.into_iter().flatten()) {
            assert!((value(point, "multiplier_angle") - expected).abs() < 1e-6);
        }
        let found = specials(&result, SpecialKind::Fold);
        assert_eq!(found.len(), 2);
        for (point, expected) in found.iter().zip(folds) {
            assert_close(value(point, "frequency"), expected, 1e-10);
        }
    }
}

// Source: the table of D1 and the count of its responses: one outside the folds, three between.
#[test]
fn stability_changes_at_folds_and_nowhere_else() {
    let result = over(&lines::d1(), (0.5, 1.8), &tolerance("1e-8"));
    let branch = &result.branches[0];
    let changes: Vec<f64> = branch
        .values("unstable_dimension")
        .windows(2)
        .enumerate()
        .filter(|(_, pair)| pair[0] != pair[1])
        .map(|(at, _)| branch.values("frequency")[at])
        .collect();
    assert_eq!(changes.len(), 2, "{changes:?}");
    assert!(branch.values("largest_multiplier").iter().all(|m| m.is_finite()));
    let jumps: Vec<(&str, f64)> =
        result.jumps.iter().map(|jump| (jump.sweep.as_str(), jump.frequency)).collect();
    assert_eq!(jumps.len(), 2);
    assert_eq!((jumps[0].0, jumps[1].0), ("down", "up"));
}
