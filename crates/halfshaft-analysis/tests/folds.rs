//! `folds --method averaged`: fold curves through their cusps.

mod common;

use common::{assert_close, driveline, folds, oscillator, resonance};
use halfshaft_model::question::{QuestionText, Verb};
use halfshaft_results::{Answer, FoldsResult, SpecialKind, Status};

const OMEGA: f64 = 26.06;

fn cusps(result: &FoldsResult) -> Vec<(f64, f64, f64)> {
    let value = |name: &str, point: &halfshaft_results::SpecialPoint| {
        point.value(name).unwrap_or_else(|| panic!("no {name}"))
    };
    result
        .special_points
        .iter()
        .map(|point| {
            assert_eq!((point.kind, point.status), (SpecialKind::Cusp, Status::Located));
            (value(&result.parameter, point), value("sigma", point), value("rho", point))
        })
        .collect()
}

// Source: theory 5 and 6, the printed thresholds with 40 digits (mpmath): f_c, alpha_c, beta_c with
// their sigma and rho. The cusps here are located on the curves, not taken from the formula.
#[test]
fn located_cusps_are_the_thresholds_of_the_theory() {
    let near = |found: &[(f64, f64, f64)], expected: (f64, f64, f64)| {
        let (p, sigma, rho) = found
            .iter()
            .find(|cusp| (cusp.0 - expected.0).abs() < 0.1 * expected.0.abs())
            .unwrap_or_else(|| panic!("no cusp near {expected:?}: {found:?}"));
        assert_close(*p, expected.0, 1e-12);
        assert_close(*sigma, expected.1, 1e-7);
        assert_close(*rho, expected.2, 1e-7);
    };
    let line = oscillator(&[]);
    let amplitude = cusps(&folds(&line, "excitation.amplitude=1..20"));
    assert_eq!(amplitude.len(), 1);
    near(&amplitude, (6.783_767_049_483_465, -0.082_359_015_899_900_12, 2.370_536_406_000_101_7));
    let cubic = cusps(&folds(&line, "spring.cubic=-1..1"));
    assert_eq!(cubic.len(), 2);
    let alpha = (0.312_472_373_641_455_1, 0.082_359_015_899_900_12, 3.494_424_836_095_456_5);
    near(&cubic, alpha);
    near(&cubic, (-alpha.0, -alpha.1, alpha.2));
    let damping = cusps(&folds(&line, "spring.damping=0.01..0.2"));
    assert_eq!(damping.len(), 1);
    near(&damping, (0.123_178_023_983_428_03, -0.106_675_297_957_617_53, 2.697_882_229_036_14));
}

// Source: the same planes reached by the mode's own coefficients.
#[test]
fn scaled_and_physical_parameters_give_the_same_curves() {
    let line = oscillator(&[]);
    for (physical, scaled) in [
        ("excitation.amplitude=1..20", "mode.f=1..20"),
        ("spring.cubic=-1..-0.1", "mode.alpha=-1..-0.1"),
        ("spring.damping=0.01..0.2", "mode.beta=0.01..0.2"),
    ] {
        let (a, b) = (folds(&line, physical), folds(&line, scaled));
        let (cusp_a, cusp_b) = (cusps(&a), cusps(&b));
        assert_eq!(cusp_a.len(), cusp_b.len());
        for (one, other) in cusp_a.iter().zip(&cusp_b) {
            assert_close(one.0, other.0, 1e-12);
        }
        assert_eq!(a.curves.len(), b.curves.len());
        for (one, other) in a.curves.iter().zip(&b.curves) {
            for (x, y) in one.values("sigma").iter().zip(other.values("sigma")) {
                assert!((x - y).abs() < 1e-10);
            }
        }
    }
}

/// Residuals of (45) and of the fold condition a2 = 0, relative to their terms.
fn residuals(sigma: f64, rho: f64, alpha: f64, beta: f64, f: f64, omega: f64) -> (f64, f64) {
    let kappa = 3.0 * alpha / (8.0 * omega);
    let z = rho * rho;
    let (inner, outer) = (sigma - kappa * z, sigma - 3.0 * kappa * z);
    let drive = (f / (2.0 * omega)).powi(2);
    let response = z * (beta * beta / 4.0 + inner * inner) - drive;
    let fold = beta * beta / 4.0 + inner * outer;
    (response / drive, fold / (beta * beta / 4.0))
}

// Source: the equations themselves: every point of every curve satisfies (45) and a2 = 0.
#[test]
fn every_point_of_every_curve_is_a_fold() {
    let line = oscillator(&[]);
    let (alpha, beta, f) = (-0.679, 0.0951, 10.0);
    for parameter in [
        "excitation.amplitude=1..40",
        "spring.cubic=-2..2",
        "spring.damping=0.005..0.2",
        "spring.stiffness=300..1500",
    ] {
        let result = folds(&line, parameter);
        assert!(!result.curves.is_empty(), "{parameter}");
        for curve in &result.curves {
            for (row, &value) in curve.values(&result.parameter).iter().enumerate() {
                let (mut a, mut b, mut amplitude, mut omega) = (alpha, beta, f, OMEGA);
                match result.parameter.as_str() {
                    "excitation.amplitude" => amplitude = value,
                    "spring.cubic" => a = value,
                    "spring.damping" => b = value,
                    _ => omega = value.sqrt(),
                }
                let (sigma, rho) = (curve.values("sigma")[row], curve.values("rho")[row]);
                let (response, fold) = residuals(sigma, rho, a, b, amplitude, omega);
                assert!(response.abs() < 1e-9, "{parameter} row {row}: {response:e}");
                assert!(fold.abs() < 1e-7, "{parameter} row {row}: {fold:e}");
                let frequency = curve.values("frequency")[row];
                assert_close(frequency, omega + sigma, 1e-13);
            }
        }
    }
}

// Source: geometry of a cusp: the curve is one piece through it, with the parameter at its least
// (or greatest) there.
#[test]
fn curves_run_through_their_cusp_in_one_piece() {
    let line = oscillator(&[]);
    let result = folds(&line, "excitation.amplitude=1..20");
    assert_eq!(result.curves.len(), 1);
    let curve = &result.curves[0];
    let p = curve.values("excitation.amplitude");
    let least = p.iter().copied().fold(f64::INFINITY, f64::min);
    assert_close(least, 6.783_767_049_483_465, 1e-12);
    assert_eq!((p[0], p[p.len() - 1]), (20.0, 20.0));
    let cusp = p.iter().position(|value| *value == least).expect("is there");
    assert!(p[..=cusp].windows(2).all(|pair| pair[0] > pair[1]));
    assert!(p[cusp..].windows(2).all(|pair| pair[0] < pair[1]));
    let rho = curve.values("rho");
    let steps = rho.windows(2).map(|pair| (pair[0] - pair[1]).abs());
    assert!(steps.fold(0.0, f64::max) < 0.12 * rho.iter().copied().fold(0.0, f64::max));
}

// Source: two paths to one thing: at the model's own value the fold curve passes through the folds
// of the response curve.
#[test]
fn fold_curves_pass_through_the_folds_of_the_response() {
    let line = oscillator(&[]);
    let response = resonance(&line, &QuestionText::default());
    let result = folds(&line, "excitation.amplitude=5..15");
    let curve = &result.curves[0];
    // 10 lies on the grid of 5..15 only by chance of the number of points, so interpolate.
    for fold in response.branches[0].special_points.iter().filter(|p| p.kind == SpecialKind::Fold) {
        let (sigma, rho) = (fold.value("sigma").expect("sigma"), fold.value("rho").expect("rho"));
        let rows = curve.values("excitation.amplitude");
        let near = (1..rows.len()).find_map(|row| {
            let (a, b) = (rows[row - 1], rows[row]);
            let share = (10.0 - a) / (b - a);
            if !(0.0..=1.0).contains(&share) {
                return None;
            }
            let at = |name: &str| {
                let values = curve.values(name);
                values[row - 1] + share * (values[row] - values[row - 1])
            };
            ((at("rho") - rho).abs() < 0.05).then(|| at("sigma"))
        });
        assert!((near.expect("on the curve") - sigma).abs() < 1e-3);
    }
}

// Source: the model's own parameters in any element, also where the equilibrium moves with them.
#[test]
fn any_parameter_of_the_line_can_be_the_axis() {
    let line = driveline(&["half-shaft.damping=3", "engine torque.amplitude=30"]);
    for parameter in [
        "engine torque.mean=0..1300",
        "vehicle.inertia=20..200",
        "half-shaft.stiffness=5500..12000",
        "gearbox.ratio=0.7..1.4",
        "half-shaft.damping=1..60",
    ] {
        let result = folds(&line, parameter);
        assert!(!result.curves.is_empty(), "{parameter}: {:?}", result.header.warnings);
        let scaling = result.scaling.expect("has one");
        assert!(scaling.statement.contains("half-shaft"));
    }
    // Beyond the capacity there is no state, and the answer says that the curve ends there.
    let result = folds(&line, "engine torque.mean=0..2000");
    assert!(result.header.warnings.iter().any(|w| w.contains("no stable state")));
}

#[test]
fn a_plane_without_folds_says_where_they_would_begin() {
    let result = folds(&oscillator(&[]), "excitation.amplitude=1..5");
    assert!(result.curves.is_empty());
    let warning = &result.header.warnings[0];
    assert!(warning.contains("no fold") && warning.contains("f = 6.783767"), "{warning}");
}

fn folds_between(line: &halfshaft_model::Driveline, parameter: &str, speeds: &str) -> FoldsResult {
    let text = QuestionText {
        parameter: Some(parameter.to_owned()),
        frequency: Some(speeds.to_owned()),
        method: common::some("averaged"),
        ..QuestionText::default()
    };
    match common::try_ask(line, Verb::Folds, &text) {
        Ok(Answer::Folds(result)) => result,
        other => panic!("{other:?}"),
    }
}

// Source: the cusp of the damping plane (22.24 rad/s) lies outside the speeds asked for: that is
// said, and not that nothing folds.
#[test]
fn folds_outside_the_speeds_asked_for_are_told() {
    let result = folds_between(&driveline(&[]), "half-shaft.damping=1..40", "100..200");
    assert!(result.curves.is_empty() && result.special_points.is_empty());
    let warnings = result.header.warnings.join("; ");
    assert!(warnings.contains("but folds at excitation speeds from"), "{warnings}");
}

// Source: theory 5: the threshold of the amplitude does not depend on the model's own amplitude.
#[test]
fn a_silent_torque_can_be_the_axis() {
    let range = "engine torque.amplitude=1..2000";
    let loud = folds(&driveline(&[]), range);
    let silent = folds(&driveline(&["engine torque.amplitude=0"]), range);
    let cusp = |result: &FoldsResult| cusps(result)[0];
    assert_close(cusp(&silent).0, cusp(&loud).0, 1e-12);
}

// Source: a frequency is positive; and the scaled equation alone has no shaft whose torque changes
// with its coefficients.
#[test]
fn planes_of_the_scaled_equation_stay_within_its_meaning() {
    let line = oscillator(&[]);
    for (parameter, torque) in
        [("mode.beta=0.001..0.3", true), ("mode.alpha=-2..2", false), ("mode.omega_1=5..40", false)]
    {
        let result = folds(&line, parameter);
        for curve in &result.curves {
            assert!(curve.values("frequency").iter().all(|speed| *speed > 0.0), "{parameter}");
            let told = curve.columns.iter().any(|column| column.name.contains("torque"));
            assert_eq!(told, torque, "{parameter}");
        }
    }
}

// Source: the slow flow of one order does not know the amplitude of another: the axis over the weaker
// of two torques is that of its own order, with the threshold that it has alone.
#[test]
fn an_amplitude_bends_the_response_of_its_own_order() {
    let second = "[[torque]]\nname = \"second\"\non = \"oscillator\"\namplitude = 1\norder = 2\n";
    let text = halfshaft_model::embedded::scaled().text + second;
    let both = folds(&common::line_of(&text, &[]), "second.amplitude=1..20");
    let alone = common::line_of(&text, &["excitation.amplitude=0"]);
    let alone = folds(&alone, "second.amplitude=1..20");
    assert_close(cusps(&both)[0].0, cusps(&alone)[0].0, 1e-12);
    assert_close(cusps(&both)[0].0, 6.783_767_049_483_465, 1e-9);
}
