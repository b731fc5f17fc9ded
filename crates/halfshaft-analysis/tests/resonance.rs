//! `resonance --method averaged`: every response, its stability, folds, peaks, and the full equations.

mod common;

use common::{
    assert_close, chain, driveline, line_of, of_kind, oscillator, resonance, some, try_ask,
};
use halfshaft_analysis::AnalysisError;
use halfshaft_model::question::{QuestionText, Verb};
use halfshaft_results::{Branch, ModeScaling, ResonanceResult, SpecialKind, Status, VerifiedPoint};

const OMEGA: f64 = 26.06;

fn all(line: &halfshaft_model::Driveline) -> ResonanceResult {
    resonance(line, &QuestionText::default())
}

fn special(result: &ResonanceResult, kind: SpecialKind) -> Vec<(f64, f64)> {
    let points = result.branches.iter().flat_map(|branch| of_kind(&branch.special_points, kind));
    points
        .map(|point| {
            assert_eq!(point.status, Status::Located);
            (point.value("sigma").expect("has sigma"), point.value("rho").expect("has rho"))
        })
        .collect()
}

// Source: (45) with the fold condition a2 = 0, solved with 40 digits (mpmath), at f = 10 and 15;
// theory 6, row 8 prints the first two to seven digits.
#[test]
fn folds_agree_with_extended_precision() {
    let cases = [
        (
            "10",
            "-0.679",
            [
                (-0.120_221_150_974_867_66, 2.283_638_626_840_623_2),
                (-0.162_718_942_073_812_76, 3.986_245_534_910_014),
            ],
        ),
        (
            "10",
            "0.679",
            [
                (0.120_221_150_974_867_66, 2.283_638_626_840_623_2),
                (0.162_718_942_073_812_76, 3.986_245_534_910_014),
            ],
        ),
        (
            "15",
            "-0.679",
            [
                (-0.165_880_386_591_232_43, 2.530_983_719_828_070_2),
                (-0.359_517_260_608_908_13, 6.038_973_383_028_038),
            ],
        ),
    ];
    for (f, alpha, expected) in cases {
        let settings = [&format!("excitation.amplitude={f}"), &format!("spring.cubic={alpha}")];
        let line = oscillator(&settings.map(String::as_str));
        let mut found = special(&all(&line), SpecialKind::Fold);
        found.sort_by(|a, b| a.1.total_cmp(&b.1));
        assert_eq!(found.len(), 2, "f = {f}, alpha = {alpha}");
        for ((sigma, rho), (expected_sigma, expected_rho)) in found.iter().zip(expected) {
            assert_close(*sigma, expected_sigma, 1e-11);
            assert_close(*rho, expected_rho, 1e-11);
        }
    }
    assert!(special(&all(&oscillator(&["excitation.amplitude=5"])), SpecialKind::Fold).is_empty());
    assert!(special(&all(&oscillator(&["spring.cubic=0"])), SpecialKind::Fold).is_empty());
}

// Source: (45) as a cubic in rho², all roots with 40 digits (mpmath), f = 15.
#[test]
fn all_responses_at_a_frequency_are_found() {
    let line = oscillator(&["excitation.amplitude=15"]);
    let cases: [(f64, &[f64]); 5] = [
        (0.5, &[0.569_433_540_954_823_3]),
        (0.0, &[2.951_635_770_461_418]),
        (-0.2, &[1.582_557_796_510_465_6, 3.799_218_095_815_882, 4.898_988_459_778_475_5]),
        (-0.3, &[0.977_125_347_464_563_8, 5.291_707_317_529_926, 5.696_579_025_416_297]),
        (-0.36, &[0.806_547_438_946_336_6]),
    ];
    for (sigma, expected) in cases {
        let window = format!("{:?}..{:?}", OMEGA + sigma, OMEGA + sigma + 1.0);
        let text =
            QuestionText { frequency: Some(window), points: some("2"), ..Default::default() };
        let result = resonance(&line, &text);
        let mut found: Vec<f64> = Vec::new();
        for branch in &result.branches {
            let rows = branch.values("sigma").iter().zip(branch.values("rho"));
            found.extend(rows.filter(|(s, _)| (*s - sigma).abs() < 1e-12).map(|(_, rho)| *rho));
        }
        found.sort_by(f64::total_cmp);
        assert_eq!(found.len(), expected.len(), "sigma {sigma}: {found:?}");
        for (rho, expected) in found.iter().zip(expected) {
            assert_close(*rho, *expected, 1e-10);
        }
    }
}

/// Slow flow (43), (44) in the Cartesian amplitudes `u = ρ cos η`, `v = ρ sin η`.
fn slow_flow(sigma: f64, alpha: f64, beta: f64, f: f64, u: f64, v: f64) -> (f64, f64) {
    let kappa = 3.0 * alpha / (8.0 * OMEGA);
    let drift = sigma - kappa * (u * u + v * v);
    let drive = f / (2.0 * OMEGA);
    (-beta / 2.0 * u - drift * v, -beta / 2.0 * v + drift * u + drive)
}

/// Real parts of the eigenvalues of the slow flow's Jacobian by central differences.
fn largest_real_part(sigma: f64, alpha: f64, beta: f64, f: f64, u: f64, v: f64) -> f64 {
    let h = 1e-5;
    let flow = |u: f64, v: f64| slow_flow(sigma, alpha, beta, f, u, v);
    let (a, b) = (flow(u + h, v), flow(u - h, v));
    let (c, d) = (flow(u, v + h), flow(u, v - h));
    let [uu, vu] = [(a.0 - b.0) / (2.0 * h), (a.1 - b.1) / (2.0 * h)];
    let [uv, vv] = [(c.0 - d.0) / (2.0 * h), (c.1 - d.1) / (2.0 * h)];
    let (half_trace, determinant) = ((uu + vv) / 2.0, uu * vv - uv * vu);
    let square = half_trace * half_trace - determinant;
    half_trace + square.max(0.0).sqrt()
}

// Source: a second, independent path: every stored sample must be a rest point of the slow flow in
// other coordinates, and its stability that of the numerically differentiated Jacobian.
#[test]
fn every_stored_sample_is_a_rest_point_of_its_stability() {
    for (f, alpha) in [(5.0, -0.679), (10.0, 0.679), (15.0, -0.679), (40.0, 0.3)] {
        let settings = [format!("excitation.amplitude={f}"), format!("spring.cubic={alpha}")];
        let line = oscillator(&[&settings[0], &settings[1]]);
        let result = all(&line);
        let mut unstable = 0;
        for branch in &result.branches {
            let column = |name: &str| branch.values(name);
            for row in 0..column("rho").len() {
                let at = |name: &str| column(name)[row];
                let (rho, phase) = (at("rho"), at("phase"));
                let (u, v) = (rho * phase.cos(), rho * phase.sin());
                let (du, dv) = slow_flow(at("sigma"), alpha, 0.0951, f, u, v);
                let size = f / (2.0 * OMEGA);
                assert!(du.hypot(dv) < 1e-9 * size, "f {f} row {row}: {du:e} {dv:e}");
                let growth = largest_real_part(at("sigma"), alpha, 0.0951, f, u, v);
                if growth.abs() > 1e-6 {
                    assert_eq!(at("stable") == 1.0, growth < 0.0, "f {f} row {row}: {growth:e}");
                    assert_eq!(at("unstable_dimension") == 1.0, growth > 0.0);
                    unstable += usize::from(growth > 0.0);
                }
            }
        }
        assert_eq!(unstable > 0, f > 5.0, "f = {f}");
    }
}

// Source: theory 4: rho_max = f/(beta omega_1) on the backbone.
#[test]
fn the_peak_lies_on_the_backbone() {
    let result = all(&oscillator(&[]));
    let peak = &result.peaks[0];
    let rho = 10.0 / (0.0951 * OMEGA);
    assert_close(peak["rho"], rho, 1e-14);
    assert_close(peak["sigma"], 3.0 * -0.679 / (8.0 * OMEGA) * rho * rho, 1e-14);
    assert_close(peak["spring.twist.harmonic1"], rho, 1e-14);
    let backbone = &result.backbones[0];
    for (sigma, rho) in backbone.values("sigma").iter().zip(backbone.values("rho")) {
        assert!((sigma - 3.0 * -0.679 / (8.0 * OMEGA) * rho * rho).abs() < 1e-14);
    }
}

// Source: geometry: a branch is connected, its special points lie on it in order, and its ends lie
// on the borders that were asked for.
#[test]
fn branches_are_connected_and_end_on_the_borders() {
    let line = oscillator(&["excitation.amplitude=15"]);
    for (window, pieces) in [("25.4..26.6", 1), ("25.75..25.85", 3), ("25.0..25.3", 1)] {
        let text = QuestionText { frequency: some(window), ..Default::default() };
        let result = resonance(&line, &text);
        assert_eq!(result.branches.len(), pieces, "{window}");
        let (from, to) = window.split_once("..").expect("a range");
        let ends: [f64; 2] = [from.parse().expect("number"), to.parse().expect("number")];
        for branch in &result.branches {
            check_branch(branch, ends);
        }
    }
}

fn check_branch(branch: &Branch, ends: [f64; 2]) {
    let (frequency, rho) = (branch.values("frequency"), branch.values("rho"));
    let width = ends[1] - ends[0];
    let height = rho.iter().copied().fold(0.0, f64::max);
    for row in 1..rho.len() {
        let across = (frequency[row] - frequency[row - 1]).abs() / width;
        let up = (rho[row] - rho[row - 1]).abs() / height;
        assert!(across.max(up) < 0.02, "gap at row {row}: {across} {up}");
    }
    let last = rho.len() - 1;
    for row in [0, last] {
        assert!(ends.iter().any(|end| (frequency[row] - end).abs() < 1e-12 * end));
    }
    assert_eq!(of_kind(&branch.special_points, SpecialKind::End).len(), 2);
    // Stability changes at folds and nowhere else.
    let stable = branch.values("stable");
    let changes = (1..=last).filter(|row| stable[*row] != stable[*row - 1]).count();
    let folds = of_kind(&branch.special_points, SpecialKind::Fold);
    assert_eq!(changes, folds.len());
    for fold in folds {
        let value = fold.value("frequency").expect("has one");
        assert!(frequency.iter().any(|f| (f - value).abs() < 1e-13 * value));
    }
}

// Source: jumps of a softening response: sweeping up it jumps at the lower-amplitude fold, sweeping
// down at the higher one; what it jumps to is the other stable response there.
#[test]
fn jumps_land_on_the_other_stable_response() {
    let result = all(&oscillator(&[]));
    assert_eq!(result.jumps.len(), 2);
    for jump in &result.jumps {
        assert_close(jump.rpm, jump.frequency * 60.0 / std::f64::consts::TAU, 1e-14);
        let after = jump.after.expect("there is one");
        assert!(after > 0.0 && (after - jump.before).abs() > 0.5);
    }
    let up = result.jumps.iter().find(|jump| jump.sweep == "up").expect("jumps up");
    assert_close(up.before, 2.283_638_626_840_623, 1e-10);
    let down = result.jumps.iter().find(|jump| jump.sweep == "down").expect("jumps down");
    assert_close(down.before, 3.986_245_534_910_014, 1e-10);
}

// Source: theory 4, erratum 4: f = T_m/J_m + T_L/J_L with the torques reduced to the wheel.
#[test]
fn the_excitation_of_the_mode_is_reduced_torque_over_inertia() {
    let line = driveline(&["engine torque.mean=0"]);
    let scaling = &all(&line).scaling[0];
    assert_close(scaling.f, 5.71 * 40.0 / (0.328 * 5.71 * 5.71), 1e-13);
    let load =
        driveline(&["engine torque.mean=0", "engine torque.amplitude=0", "road load.amplitude=40"]);
    assert_close(all(&load).scaling[0].f, 40.0 / 81.6, 1e-12);
    let (jm, jl) = (0.328 * 5.71 * 5.71, 81.6);
    assert_close(scaling.modal_inertia, jm * jl / (jm + jl), 1e-13);
    assert_close(scaling.beta, 90.0 * (1.0 / jm + 1.0 / jl), 1e-13);
    assert_close(scaling.alpha, -642.0 * (1.0 / jm + 1.0 / jl), 1e-12);
}

// Source: theory 4: with Table 1's own values the threshold of the jump is f = 679.22 rad/s²
// (computed there with unrounded coefficients), a 1272 N·m oscillation at the engine.
#[test]
fn the_threshold_of_the_jump_is_told() {
    let line = driveline(&["engine torque.mean=0"]);
    let scaling = &all(&line).scaling[0];
    let threshold = scaling.fold_threshold_f.expect("softens");
    assert!((threshold - 679.22).abs() < 0.01, "{threshold}");
    assert_close(threshold * 0.328 * 5.71, 1272.06, 1e-4);
    assert_close(scaling.fold_threshold_factor.expect("excited") * scaling.f, threshold, 1e-14);
}

// Source: averaging becomes exact as the response becomes small: the difference to the periodic orbit
// of the full equations falls with the square of the detuning range and of the amplitude. At f = 15
// theory 6 has 2.951 64 by (45) and 2.951 08 by integration.
#[test]
fn verification_holds_the_full_equations_against_the_closed_form() {
    let text =
        |window: &str| QuestionText { verify: true, frequency: some(window), ..Default::default() };
    let result = resonance(&oscillator(&["excitation.amplitude=15"]), &text("26.06..26.07"));
    let first = &result.verification[0];
    assert_close(first.predicted, 2.951_636, 1e-6);
    assert_close(first.integrated_amplitude, 2.951_076, 1e-6);
    let wide = resonance(&oscillator(&["excitation.amplitude=15"]), &text("25.5..26.6"));
    assert!(wide.verification.len() >= 8);
    for point in &wide.verification {
        assert!(point.relative_difference.abs() < 0.015, "{point:?}");
        assert!(point.orbit_residual < 1e-9, "{point:?}");
        assert_eq!(point.predicted_stable, point.integrated_stable, "{point:?}");
    }
    assert!(wide.verification.iter().any(|point| !point.predicted_stable));
    // Liouville: the product of the multipliers is exp(-beta T); for stable pairs of complex
    // multipliers their modulus is its root.
    let point = &wide.verification[0];
    let period = std::f64::consts::TAU / point.frequency;
    assert_close(point.largest_multiplier, (-0.0951 * period / 2.0).exp(), 1e-6);
}

// Source: two paths to one line: a shaft of stiffness k is two of k/2 side by side, whichever of them
// closes the loop.
#[test]
fn a_shaft_that_closes_a_loop_is_verified_too() {
    let text = chain(&[1.0, 2.0], &[300.0], None, 0.4)
        + "[[torque]]\nname = \"t\"\non = \"n0\"\namplitude = 3\norder = 1\n";
    let one = line_of(&text, &["s0.stiffness=600", "s0.cubic=-5", "s0.damping=0.8"]);
    let text = text
        + "[[shaft]]\nname = \"other\"\nfrom = \"n0\"\nto = \"n1\"\nstiffness = 300\n\
           damping = 0.4\ncubic = -5\n";
    let two = line_of(&text, &[]);
    let ask = QuestionText { verify: true, ..Default::default() };
    let (one, two) = (resonance(&one, &ask), resonance(&two, &ask));
    assert!(two.header.warnings.is_empty(), "{:?}", two.header.warnings);
    assert_eq!(one.verification.len(), two.verification.len());
    assert!(!one.verification.is_empty());
    for (a, b) in one.verification.iter().zip(&two.verification) {
        assert_close(b.integrated, a.integrated, 1e-8);
    }
}

// Source: theory 5: the threshold f_c vanishes with the damping.
#[test]
fn without_damping_any_excitation_folds() {
    let result = all(&oscillator(&["spring.damping=0"]));
    assert_eq!(result.scaling[0].fold_threshold_f, Some(0.0));
    assert_eq!(special(&result, SpecialKind::Fold).len(), 1);
    assert!(!result.header.warnings.iter().any(|text| text.contains("inf")));
}

// Source: sampling theory: a harmonic of high order needs samples of its own.
#[test]
fn a_high_order_beside_a_low_one_is_verified() {
    let text = halfshaft_model::embedded::scaled().text
        + "[[torque]]\nname = \"buzz\"\non = \"oscillator\"\namplitude = 10\norder = 130\n";
    let line = line_of(&text, &[]);
    let window = format!("{}..{}", 25.8 / 130.0, 26.4 / 130.0);
    let ask = QuestionText {
        verify: true,
        order: some("130"),
        frequency: some(&window),
        ..Default::default()
    };
    let result = resonance(&line, &ask);
    assert!(!result.verification.is_empty());
    for point in &result.verification {
        assert!(point.relative_difference.abs() < 0.02, "{point:?}");
    }
}

// Source: geometry: every bent curve has as many jumps as folds, however high it rises above the
// response that it falls to.
#[test]
fn every_fold_has_its_jump() {
    for f in [10, 15, 30, 40, 60, 80] {
        let line = oscillator(&[&format!("excitation.amplitude={f}")]);
        let result = all(&line);
        let folds = special(&result, SpecialKind::Fold);
        let sweeps: Vec<&str> = result.jumps.iter().map(|jump| jump.sweep.as_str()).collect();
        assert_eq!((folds.len(), sweeps.len()), (2, 2), "f = {f}: {sweeps:?}");
        assert!(sweeps.contains(&"up") && sweeps.contains(&"down"), "f = {f}: {sweeps:?}");
    }
}

/// Stops after some looks.
struct Impatient(std::sync::atomic::AtomicUsize);

impl halfshaft_numerics::observer::Observer for Impatient {
    fn cancelled(&self) -> bool {
        self.0.fetch_add(1, std::sync::atomic::Ordering::Relaxed) >= 3
    }
}

// Source: the contract of every analysis: what was reached, and why it ended.
#[test]
fn a_stopped_verification_says_how_far_it_came() {
    let line = oscillator(&[]);
    let text = QuestionText { verify: true, method: some("averaged"), ..Default::default() };
    let question = common::question(&line, Verb::Resonance, &text);
    let answer = halfshaft_analysis::ask(&line, &question, &Impatient(0.into())).expect("answers");
    let termination = &answer.header().termination;
    assert_eq!(termination.reason, halfshaft_results::Reason::Cancelled);
    assert!(termination.detail.as_deref().is_some_and(|text| text.starts_with("3 of ")));
}

// Source: the full equations; where folds lie too close for an even spread to fall between them,
// the three coexisting responses are still held against their own three orbits.
#[test]
fn verification_reaches_every_coexisting_response() {
    let text = QuestionText { verify: true, ..Default::default() };
    let result = resonance(&oscillator(&[]), &text);
    let (low, high) = (25.8973, 25.9398);
    let between: Vec<&VerifiedPoint> = result
        .verification
        .iter()
        .filter(|point| low < point.frequency && point.frequency < high)
        .collect();
    let stable = between.iter().filter(|point| point.integrated_stable).count();
    assert!(between.len() >= 3 && stable == 2 * (between.len() - stable), "{between:?}");
    for point in &between {
        assert_eq!(point.predicted_stable, point.integrated_stable, "{point:?}");
        assert!(point.relative_difference.abs() < 0.01, "{point:?}");
    }
    let peak = result.peaks[0]["frequency"];
    assert!(result.verification.iter().any(|point| (point.frequency - peak).abs() < 1e-9));
    assert!(result.header.warnings.is_empty(), "{:?}", result.header.warnings);
}

// Source: linear theory: without nonlinearity near resonance the averaged amplitude tends to the
// exact one, |F|/sqrt((ω1² - ω²)² + β² ω²), with an error of the relative detuning.
#[test]
fn a_linear_line_has_its_resonance_curve() {
    let line = oscillator(&["spring.cubic=0"]);
    let result = all(&line);
    let branch = &result.branches[0];
    assert!(branch.values("stable").iter().all(|stable| *stable == 1.0));
    for (frequency, rho) in branch.values("frequency").iter().zip(branch.values("rho")) {
        let exact = 10.0
            / ((OMEGA * OMEGA - frequency * frequency).powi(2) + (0.0951 * frequency).powi(2))
                .sqrt();
        let detuning = (frequency / OMEGA - 1.0).abs();
        assert!((rho / exact - 1.0).abs() < detuning + 1e-4, "{frequency}");
    }
}

/// Error that averaging may have: half of the relative detuning, and a little for what bends.
fn far(point: &VerifiedPoint, scaling: &ModeScaling) -> f64 {
    0.6 * (scaling.order * point.frequency / scaling.omega_1 - 1.0).abs() + 0.01
}

// Source: about a loaded equilibrium the quadratic term softens: the effective cubic coefficient is
// that of the second-order frequency of the free vibration (theory 3), checked against shooting.
#[test]
fn the_loaded_line_agrees_with_the_full_equations() {
    let line = driveline(&["half-shaft.damping=4", "engine torque.amplitude=4"]);
    let text = QuestionText { verify: true, ..Default::default() };
    let result = resonance(&line, &text);
    let scaling = &result.scaling[0];
    assert!(scaling.coefficients["x2"] != 0.0 && scaling.alpha < scaling.coefficients["x3"]);
    assert!(result.verification.len() >= 6);
    for point in &result.verification {
        assert!(point.relative_difference.abs() < far(point, scaling), "{point:?}");
        assert_eq!(point.predicted_stable, point.integrated_stable);
    }
}

// Source: gears and other shafts change nothing but the mode: a chain of three with one cubic shaft
// agrees with shooting of its six states.
#[test]
fn a_mode_of_a_longer_line_agrees_with_the_full_equations() {
    let text = chain(&[0.3, 1.0, 4.0], &[900.0, 400.0], None, 0.4)
        + "[[torque]]\nname = \"t\"\non = \"n0\"\namplitude = 3\norder = 2\n";
    let line = line_of(&text, &["s0.cubic=900", "s1.cubic=-50"]);
    for mode in ["1", "2"] {
        let text = QuestionText { verify: true, mode: some(mode), ..Default::default() };
        let result = resonance(&line, &text);
        assert_eq!(result.scaling[0].order, 2.0);
        assert!(!result.verification.is_empty());
        for point in &result.verification {
            let bound = far(point, &result.scaling[0]);
            assert!(point.relative_difference.abs() < bound, "mode {mode}: {point:?}");
        }
    }
}

// Source: orders: the same torque at order 2 has the same response at half the speed.
#[test]
fn an_order_of_two_halves_the_speed() {
    let one = all(&oscillator(&[]));
    let two = all(&oscillator(&["excitation.order=2"]));
    let folds = |result: &ResonanceResult| -> Vec<f64> {
        let points =
            result.branches.iter().flat_map(|b| of_kind(&b.special_points, SpecialKind::Fold));
        points.map(|point| point.value("frequency").expect("has one")).collect()
    };
    for (a, b) in folds(&one).iter().zip(folds(&two)) {
        assert_close(*a, 2.0 * b, 1e-14);
    }
}

#[test]
fn what_cannot_be_averaged_is_said_by_name() {
    let ask = |line: &halfshaft_model::Driveline, text: &QuestionText| {
        let text = QuestionText { method: some("averaged"), ..text.clone() };
        try_ask(line, Verb::Resonance, &text).expect_err("cannot be answered")
    };
    let silent = oscillator(&["excitation.amplitude=0"]);
    let error = ask(&silent, &QuestionText::default());
    assert!(matches!(error, AnalysisError::NoExcitation { .. }));
    assert!(error.advice().is_some());
    let third = QuestionText { mode: some("3"), ..Default::default() };
    let error = ask(&oscillator(&[]), &third);
    assert_eq!(error, AnalysisError::NoSuchMode { asked: 3, found: 1 });
    let overloaded = ask(&driveline(&["gearbox.ratio=1.79"]), &QuestionText::default());
    assert!(overloaded.to_string().contains("needs 8688 N·m"), "{overloaded}");
}
