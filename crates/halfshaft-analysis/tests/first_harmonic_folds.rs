//! `folds --method first-harmonic`: fold curves, cusps, detached responses, numbers of responses.

mod common;

use common::{assert_close, line_of, of_kind, some, try_ask};
use halfshaft_analysis::response_count;
use halfshaft_model::Driveline;
use halfshaft_model::question::{FoldsQuestion, Question, QuestionText, Verb, read};
use halfshaft_numerics::Complex;
use halfshaft_results::{
    Answer, FoldsResult, ResonanceResult, ResponseCount, SpecialKind, SpecialPoint, Status,
};

fn text(frequency: Option<&str>, parameter: Option<&str>) -> QuestionText {
    QuestionText {
        frequency: frequency.map(str::to_owned),
        parameter: parameter.map(str::to_owned),
        method: some("first-harmonic"),
        ..QuestionText::default()
    }
}

fn folds(line: &Driveline, frequency: Option<&str>, parameter: &str) -> FoldsResult {
    match try_ask(line, Verb::Folds, &text(frequency, Some(parameter))) {
        Ok(Answer::Folds(result)) => result,
        other => panic!("{other:?}"),
    }
}

fn respond(line: &Driveline, frequency: &str, points: &str) -> ResonanceResult {
    let asked = QuestionText { points: some(points), ..text(Some(frequency), None) };
    match try_ask(line, Verb::Resonance, &asked) {
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

/// A hardening oscillator with a small linear absorber.
fn absorber(p: f64) -> Driveline {
    line_of(
        &format!(
            "format = 1\nname = \"Absorber\"\n\
             [[inertia]]\nname = \"primary\"\ninertia = 1.0\ndamping = 0.002\n\
             [[inertia]]\nname = \"small\"\ninertia = 0.05\n\
             [[shaft]]\nname = \"spring\"\nfrom = \"primary\"\nto = \"ground\"\n\
             stiffness = 1.0\ncubic = 1.0\n\
             [[shaft]]\nname = \"coupling\"\nfrom = \"primary\"\nto = \"small\"\n\
             stiffness = 0.06\ndamping = 0.013\n\
             [[torque]]\nname = \"drive\"\non = \"primary\"\namplitude = {p:?}\n"
        ),
        &[],
    )
}

fn value(point: &SpecialPoint, name: &str) -> f64 {
    point.value(name).unwrap_or_else(|| panic!("no {name} in {point:?}"))
}

// Source: reference table of periodic cases: cusp of D1 with one harmonic, and its folds with one
// harmonic at the model's own amplitude.
#[test]
fn the_cusp_of_the_forced_duffing_oscillator_is_that_of_the_reference() {
    for frequency in [Some("0.9..1.6"), None] {
        let line = duffing(0.05, 1.0, 0.1, 0.18);
        let result = folds(&line, frequency, "drive.amplitude=0.02..0.3");
        assert!(result.header.warnings.is_empty(), "{:?}", result.header.warnings);
        assert_eq!((result.curves.len(), result.special_points.len()), (1, 1));
        let cusp = &result.special_points[0];
        assert_eq!((cusp.kind, cusp.status), (SpecialKind::Cusp, Status::Located));
        assert_close(value(cusp, "frequency"), 1.044_238_331_1, 1e-10);
        assert_close(value(cusp, "drive.amplitude"), 0.054_054_004_5, 1e-9);
        // Between points the curve is taken straight, so that digits are few.
        let curve = &result.curves[0];
        let pairs: Vec<(f64, f64)> = curve
            .values("drive.amplitude")
            .iter()
            .copied()
            .zip(curve.values("frequency").iter().copied())
            .collect();
        let mut at = Vec::new();
        for pair in pairs.windows(2) {
            let share = (0.18 - pair[0].0) / (pair[1].0 - pair[0].0);
            if (0.0..1.0).contains(&share) {
                at.push(pair[0].1 + share * (pair[1].1 - pair[0].1));
            }
        }
        at.sort_by(f64::total_cmp);
        assert_eq!(at.len(), 2);
        assert_close(at[0], 1.115_585_927_2, 1e-4);
        assert_close(at[1], 1.267_536_959_5, 1e-4);
    }
}

// Source: the response equation `g = a² (D² + c² W²) - P²` with `D = k - W² + 3/4 γ a²` and its
// derivative by the amplitude, at every point of curves over four parameters; and which way two
// responses open.
#[test]
fn every_point_of_every_curve_is_a_fold() {
    let (c, k, g, p) = (0.05, 1.0, 0.1, 0.18);
    let line = duffing(c, k, g, p);
    for parameter in [
        "drive.amplitude=0.02..0.5",
        "spring.cubic=-0.2..0.4",
        "spring.damping=0.01..0.2",
        "mass.inertia=0.5..2",
    ] {
        let result = folds(&line, Some("0.4..2.5"), parameter);
        assert!(!result.curves.is_empty(), "{parameter}");
        for curve in &result.curves {
            for (row, &value) in curve.values(&result.parameter).iter().enumerate() {
                let (mut c, mut g, mut p, mut m) = (c, g, p, 1.0);
                match result.parameter.as_str() {
                    "drive.amplitude" => p = value,
                    "spring.cubic" => g = value,
                    "spring.damping" => c = value,
                    _ => m = value,
                }
                let w = curve.values("frequency")[row];
                let a = curve.values("spring.twist.harmonic1")[row];
                let d = |w: f64, a: f64| k - m * w * w + 0.75 * g * a * a;
                let left = |w: f64, a: f64| a * a * (d(w, a).powi(2) + (c * w).powi(2)) / (p * p);
                assert!((left(w, a) - 1.0).abs() < 1e-9, "{parameter} {row}: {}", left(w, a));
                let slope = 2.0 * (d(w, a).powi(2) + (c * w).powi(2)) + 3.0 * g * a * a * d(w, a);
                let size = 2.0 * (c * w).powi(2);
                assert!(slope.abs() < 1e-7 * size, "{parameter} {row}: {slope:e}");
                let opens = curve.values("opens")[row];
                let beside = |side: f64| {
                    let w = w * (1.0 + side * 1e-7);
                    // The extreme over the amplitude is above or below the drive.
                    let near = |a: f64| left(w, a) - 1.0;
                    let (mut low, mut high) = (a * 0.99, a * 1.01);
                    let bend = near(low) + near(high) - 2.0 * near(a);
                    for _ in 0..100 {
                        let (x, y) = (low + 0.382 * (high - low), low + 0.618 * (high - low));
                        if (near(x) - near(y)) * bend < 0.0 { high = y } else { low = x }
                    }
                    near(low) * bend < 0.0
                };
                // Too near to a cusp the sides cannot be told apart so simply.
                if beside(1.0) != beside(-1.0) {
                    assert_eq!(beside(1.0), opens > 0.0, "{parameter} row {row}");
                }
            }
        }
    }
}

/// How many closed branches the response has.
fn closed(result: &ResonanceResult) -> usize {
    result.branches.iter().filter(|branch| branch.closed).count()
}

/// Drive at which the two larger responses of the absorber case meet at frequency `w`: the local
/// minimum of `z |A + 3/4 z|²` over `z = a²`, with `A` the dynamic stiffness of the primary.
fn lower_drive(w: f64) -> f64 {
    let inertia = Complex::from(-0.05 * w * w);
    let spring = Complex::new(0.06, 0.013 * w);
    let a = Complex::new(1.0 - w * w, 0.002 * w) + spring * inertia / (spring + inertia);
    let (square, twice) = (a.re * a.re + a.im * a.im, 1.5 * a.re);
    let root = (4.0 * twice * twice - 12.0 * 0.5625 * square).sqrt();
    let z = (-2.0 * twice + root) / (6.0 * 0.5625);
    (z * (square + twice * z + 0.5625 * z * z)).sqrt()
}

/// Frequency and drive where [`lower_drive`] is least, or greatest for a negative sign.
fn extreme(mut low: f64, mut high: f64, sign: f64) -> (f64, f64) {
    for _ in 0..200 {
        let (a, b) = (low + 0.382 * (high - low), low + 0.618 * (high - low));
        if sign * lower_drive(a) < sign * lower_drive(b) { high = b } else { low = a }
    }
    (low, lower_drive(low))
}

// Source: extremes of the drive at which two responses meet, in closed form at each frequency; and
// the responses themselves a little before and after.
#[test]
fn detached_responses_are_born_and_merge_where_the_fold_curve_turns() {
    let result = folds(&absorber(0.1), Some("0.9..4"), "drive.amplitude=0.02..0.4");
    assert!(result.header.warnings.is_empty(), "{:?}", result.header.warnings);
    let births = of_kind(&result.special_points, SpecialKind::IsolaBirth);
    let mergers = of_kind(&result.special_points, SpecialKind::IsolaMerger);
    assert_eq!((births.len(), mergers.len()), (1, 1), "{:?}", result.special_points);
    let (birth, merger) = (births[0], mergers[0]);
    assert!([birth, merger].iter().all(|point| point.status == Status::Located));
    let (born, joined) = (value(birth, "drive.amplitude"), value(merger, "drive.amplitude"));
    let expected = [extreme(1.5, 1.8, 1.0), extreme(1.15, 1.3, -1.0)];
    for (point, (w, drive)) in [birth, merger].iter().zip(expected) {
        assert_close(value(point, "drive.amplitude"), drive, 1e-11);
        // An extreme is flat: half the digits of its place.
        assert_close(value(point, "frequency"), w, 1e-6);
    }
    let window = "0.9..4";
    assert_eq!(closed(&respond(&absorber(born * 0.9999), window, "400")), 0);
    let small = respond(&absorber(born * 1.0001), window, "400");
    assert_eq!(closed(&small), 1);
    // The newborn branch lies where the birth was told.
    let newborn = small.branches.iter().find(|branch| branch.closed).expect("closed");
    for (name, tolerance) in [("frequency", 0.02), ("spring.twist.harmonic1", 0.02)] {
        let told = value(birth, name);
        assert!(newborn.values(name).iter().all(|v| (v / told - 1.0).abs() < tolerance), "{name}");
    }
    assert_eq!(closed(&respond(&absorber(joined * 0.9999), window, "400")), 1);
    assert_eq!(closed(&respond(&absorber(joined * 1.0001), window, "400")), 0);
}

fn plane(line: &Driveline, parameter: &str) -> FoldsQuestion {
    match read(Verb::Folds, &text(None, Some(parameter)), line) {
        Ok(Question::Folds(question)) => question,
        other => panic!("{other:?}"),
    }
}

fn counts(line: &Driveline, parameter: &str, speeds: &[f64], values: &[f64]) -> ResponseCount {
    response_count(line, &plane(line, parameter), speeds, values).expect("a fitting line")
}

/// Pseudo-random numbers between 0 and 1.
fn random(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    #[expect(clippy::cast_precision_loss, reason = "53 bits")]
    {
        (*seed >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// How many amplitudes a branch list has at its only listed speed.
fn listed(line: &Driveline, speed: f64, shaft: &str) -> usize {
    let result = respond(line, &format!("{speed:?}..{:?}", speed * 1.0001), "2");
    let mut found = Vec::new();
    for branch in &result.branches {
        let amplitude = branch.values(&format!("{shaft}.twist.harmonic1"));
        let rows = branch.values("frequency").iter().zip(amplitude);
        found.extend(rows.filter(|(f, _)| **f == speed).map(|(_, a)| *a));
    }
    found.sort_by(f64::total_cmp);
    found.dedup_by(|b, a| (*b - *a).abs() < 1e-12 * *a);
    found.len()
}

// Source: the certified lists of roots at the same places, for laws of third, fifth and seventh
// degree.
#[test]
fn counts_are_the_numbers_of_certified_roots() {
    let mut seed = 7;
    for law in ["", "quintic = -0.02\n", "quintic = -0.05\nseptic = 0.01\n"] {
        let line = line_of(
            &format!(
                "format = 1\nname = \"oscillator\"\n\
                 [[inertia]]\nname = \"mass\"\ninertia = 1.0\n\
                 [[shaft]]\nname = \"spring\"\nfrom = \"mass\"\nto = \"ground\"\n\
                 stiffness = 1.0\ndamping = 0.05\ncubic = 0.1\n{law}\
                 [[torque]]\nname = \"drive\"\non = \"mass\"\namplitude = 0.18\n"
            ),
            &[],
        );
        let mut seen = [0; 8];
        for _ in 0..150 {
            let (speed, p) = (0.9 + 0.6 * random(&mut seed), 0.02 + 0.4 * random(&mut seed));
            let count = counts(&line, "drive.amplitude=0.01..1", &[speed], &[p]).count[0][0];
            let parameter = line.parameter("drive.amplitude").expect("an address");
            let changed = line.with(&parameter, p).expect("allowed");
            assert_eq!(count as usize, listed(&changed, speed, "spring"), "{law} {speed} {p}");
            seen[count as usize] += 1;
        }
        assert!(seen[1] > 10 && seen[3] > 10, "{law}: {seen:?}");
    }
}

// Source: the same map counted line by line: what is shared between lines must not change it.
#[test]
fn maps_shared_over_the_parameter_are_those_of_single_lines() {
    let line = absorber(0.1);
    let speeds: Vec<f64> = (0..60).map(|k| 0.9 + 0.02 * f64::from(k)).collect();
    for (parameter, from, to) in [
        ("drive.amplitude", 0.02, 0.4),
        ("spring.cubic", 0.1, 3.0),
        ("spring.damping", 0.0, 0.05),
        ("coupling.damping", 0.005, 0.05),
        ("small.inertia", 0.02, 0.1),
    ] {
        let values: Vec<f64> = (0..12).map(|k| from + (to - from) * f64::from(k) / 11.0).collect();
        let range = format!("{parameter}={from:?}..{to:?}");
        let map = counts(&line, &range, &speeds, &values);
        for (row, value) in map.count.iter().zip(&values) {
            let one = counts(&line, &range, &speeds, &[*value]);
            assert_eq!(row, &one.count[0], "{parameter} = {value}");
        }
        let several = map.count.iter().flatten().filter(|count| **count >= 3).count();
        assert!(several > 0, "{parameter}");
    }
}

// Source: the fold curve bounds the region: the count at its two sides differs by two.
#[test]
fn the_map_changes_across_the_fold_curve() {
    let line = duffing(0.05, 1.0, 0.1, 0.18);
    let result = folds(&line, Some("0.9..1.6"), "drive.amplitude=0.02..0.3");
    let curve = &result.curves[0];
    let rows = curve.values("frequency").iter().zip(curve.values("drive.amplitude"));
    let mut checked = 0;
    for ((speed, p), opens) in rows.zip(curve.values("opens")).step_by(7) {
        if !(0.92..1.58).contains(speed) || *p < 0.06 {
            continue;
        }
        let speeds = [speed * (1.0 - 1e-6), speed * (1.0 + 1e-6)];
        let count = &counts(&line, "drive.amplitude=0.02..0.3", &speeds, &[*p]).count[0];
        let (below, above) = (i64::from(count[0]), i64::from(count[1]));
        assert_eq!(above - below, if *opens > 0.0 { 2 } else { -2 }, "{speed} {p}");
        checked += 1;
    }
    assert!(checked > 10);
    let map = result.responses.expect("counted");
    assert!(map.count.iter().flatten().all(|count| *count == 1 || *count == 3));
}
