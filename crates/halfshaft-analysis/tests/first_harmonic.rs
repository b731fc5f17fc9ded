//! `--method first-harmonic`: all responses of a line with one nonlinear shaft.

mod common;

use common::{assert_close, driveline, line_of, of_kind, oscillator, some, try_ask};
use halfshaft_analysis::AnalysisError;
use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_model::Driveline;
use halfshaft_model::question::{QuestionText, Verb};
use halfshaft_numerics::Complex;
use halfshaft_results::{Answer, Branch, ResonanceResult, SpecialKind, Status};

fn text(frequency: &str, points: &str) -> QuestionText {
    let (frequency, points) = (some(frequency), some(points));
    QuestionText { frequency, points, method: some("first-harmonic"), ..QuestionText::default() }
}

fn respond(line: &Driveline, text: &QuestionText) -> ResonanceResult {
    match try_ask(line, Verb::Resonance, text) {
        Ok(Answer::Resonance(result)) => result,
        other => panic!("{other:?}"),
    }
}

/// `x'' + c x' + k x + g x³ = P cos(W t)`.
fn duffing(c: f64, k: f64, g: f64, p: f64) -> Driveline {
    line_of(
        &format!(
            "format = 1\nname = \"Duffing\"\n\
             [[inertia]]\nname = \"mass\"\ninertia = 1.0\n\
             [[shaft]]\nname = \"spring\"\nfrom = \"mass\"\nto = \"ground\"\n\
             stiffness = {k:?}\ndamping = {c:?}\ncubic = {g:?}\n\
             [[torque]]\nname = \"drive\"\non = \"mass\"\namplitude = {p:?}\n"
        ),
        &[],
    )
}

/// Frequency and amplitude of the twist of a shaft at all folds, by ascending frequency.
fn folds(result: &ResonanceResult, shaft: &str) -> Vec<(f64, f64)> {
    let all = result.branches.iter().flat_map(|b| of_kind(&b.special_points, SpecialKind::Fold));
    let mut folds: Vec<(f64, f64)> = all
        .map(|point| {
            assert_eq!(point.status, Status::Located);
            let amplitude = point.value(&format!("{shaft}.twist.harmonic1"));
            (point.value("frequency").expect("frequency"), amplitude.expect("amplitude"))
        })
        .collect();
    folds.sort_by(|a, b| a.0.total_cmp(&b.0));
    folds
}

/// All amplitudes of a shaft's twist that the branches hold at exactly one frequency.
fn amplitudes_at(result: &ResonanceResult, shaft: &str, frequency: f64) -> Vec<f64> {
    let mut found = Vec::new();
    for branch in &result.branches {
        let rows = branch.values("frequency").iter().enumerate();
        let amplitude = branch.values(&format!("{shaft}.twist.harmonic1"));
        let there = rows.filter(|(_, f)| (*f - frequency).abs() <= 1e-14 * frequency);
        found.extend(there.map(|(row, _)| amplitude[row]));
    }
    found.sort_by(f64::total_cmp);
    found.dedup_by(|b, a| (*b - *a).abs() < 1e-12 * *a);
    found
}

// Source: reference table of periodic cases, forced Duffing with one harmonic (D1 both folds, D2 the
// upper one).
#[test]
fn folds_of_the_forced_duffing_oscillator_are_those_of_the_reference() {
    let d1 = respond(&duffing(0.05, 1.0, 0.1, 0.18), &text("0.7..1.6", "300"));
    let found = folds(&d1, "spring");
    assert_eq!(found.len(), 2);
    assert_close(found[0].0, 1.115_585_927_2, 1e-10);
    assert_close(found[1].0, 1.267_536_959_5, 1e-10);
    let d2 = respond(&duffing(0.04, 1.0, 1.0, 0.015), &text("0.9..1.2", "300"));
    let found = folds(&d2, "spring");
    assert_eq!(found.len(), 2);
    assert_close(found[1].0, 1.049_131_685_9, 1e-10);
}

// Source: the amplitude equation itself, `a² [(k - W² + 3/4 g a²)² + c² W²] = P²`, scanned over a
// million amplitudes.
#[test]
fn all_responses_are_those_of_a_fine_scan() {
    let (c, k, g, p) = (0.05, 1.0, 0.1, 0.18);
    let result = respond(&duffing(c, k, g, p), &text("1.0..1.4", "41"));
    for step in 0..=40 {
        let w = 1.0 + 0.4 * (f64::from(step) / 40.0);
        let left = |a: f64| {
            let stiffness = k - w * w + 0.75 * g * a * a;
            a * a * (stiffness * stiffness + c * c * w * w) - p * p
        };
        let count = 1_000_000;
        let at = |i: i32| 5.0 * f64::from(i) / f64::from(count);
        let scanned: Vec<f64> = (0..count)
            .filter(|i| (left(at(*i)) < 0.0) != (left(at(*i + 1)) < 0.0))
            .map(at)
            .collect();
        let found = amplitudes_at(&result, "spring", w);
        assert_eq!(found.len(), scanned.len(), "W = {w}");
        for (found, scanned) in found.iter().zip(&scanned) {
            assert!((found - scanned).abs() < 1e-5, "W = {w}: {found} {scanned}");
            assert!(left(*found).abs() < 1e-11, "W = {w}");
        }
    }
}

// Source: the fold condition: between the folds the middle response alone is unstable, and the
// dimension changes by one at each.
#[test]
fn the_middle_response_is_unstable() {
    let result = respond(&duffing(0.05, 1.0, 0.1, 0.18), &text("0.7..1.6", "200"));
    assert_eq!(result.branches.len(), 1);
    let branch = &result.branches[0];
    let folds = of_kind(&branch.special_points, SpecialKind::Fold);
    let changes: Vec<Option<i32>> = folds.iter().map(|f| f.unstable_dimension_change).collect();
    assert_eq!(changes, [Some(1), Some(-1)]);
    let (first, second) = (folds[0].value("frequency"), folds[1].value("frequency"));
    assert!(first > second);
    let jumps: Vec<&str> = result.jumps.iter().map(|jump| jump.sweep.as_str()).collect();
    assert_eq!(jumps, ["up", "down"]);
    let (up, down) = (&result.jumps[0], &result.jumps[1]);
    assert!(up.after.expect("lands") < up.before && down.after.expect("lands") > down.before);
}
