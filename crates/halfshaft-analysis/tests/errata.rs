//! The errata of Han and He (2018, manuscript JAUTO-17-0221.R2), shown by computation.
//!
//! Each test holds the printed form and the right form against something that takes no side:
//! the law itself, integration of the full equations, a limit, numerical derivatives. The printed
//! form must fail there and the right form must pass.

mod common;

use common::{assert_close, driveline, folds, history, oscillator, resonance, some, statics};
use halfshaft_model::question::{QuestionText, Verb};
use halfshaft_results::{Reason, SpecialKind};

const JM: f64 = 0.328 * 5.71 * 5.71;
const JL: f64 = 81.6;
const OMEGA: f64 = 26.06;

/// Cardano's root of `φ³ + p φ = q`.
fn cardano(p: f64, q: f64) -> f64 {
    let root = (q * q / 4.0 + p * p * p / 27.0).sqrt();
    (q / 2.0 + root).cbrt() + (q / 2.0 - root).cbrt()
}

// Erratum 1, (6): the factors of k3 are missing from the root. Judge: the law k1 φ + k3 φ³ = T.
#[test]
fn erratum_1_the_static_root_needs_the_factors_of_k3() {
    let (k1, k3, torque) = (6420.0, 642.0, 4853.5);
    let misses = |x: f64| (k1 * x + k3 * x * x * x - torque).abs() / torque;
    let right = cardano(k1 / k3, torque / k3);
    let without_k3 = cardano(k1, torque);
    assert!(misses(right) < 1e-12);
    assert!(misses(without_k3) > 0.05, "{}", misses(without_k3));
    let program = statics(&driveline(&["half-shaft.cubic=642"])).equilibria[0].twist["half-shaft"];
    assert_close(program, right, 1e-13);
}

// Erratum 2, (9)-(13): adding the two perturbed equations doubles stiffness and damping. Judge: the
// full line by integration, in the limit in which the drive end is really held.
#[test]
fn erratum_2_the_published_equation_doubles_stiffness_and_damping() {
    let line = driveline(&["engine.inertia=1e12", "half-shaft.cubic=642"]);
    let run = |method: &str| {
        let text =
            QuestionText { method: some(method), duration: some("8s"), ..Default::default() };
        let result = history(&line, Verb::Shock, &text);
        let metrics = &result.metrics.shafts["half-shaft"];
        let frequency = metrics.oscillation_frequency.expect("oscillates");
        (frequency, metrics.decay_rate.expect("decays"))
    };
    let (full, full_decay) = run("full");
    let (clamped, clamped_decay) = run("clamped");
    let (published, published_decay) = run("published");
    assert_close(clamped, full, 1e-4);
    assert_close(clamped_decay, full_decay, 1e-3);
    assert_close(published / full, 2.0_f64.sqrt(), 0.01);
    assert_close(published_decay / full_decay, 2.0, 0.01);
}

/// First-order multiple scales of the theory (3), with the given powers of ω0 in the corrections:
/// two and one where they are right, none where they are missing.
fn first_order(omega: f64, alpha: f64, gamma: f64, mu: f64, powers: bool, t: f64, r0: f64) -> f64 {
    let square = if powers { omega * omega } else { 1.0 };
    let r = r0 * (-alpha * t / 2.0).exp();
    let drift = 3.0 * gamma * r0 * r0 / (8.0 * if powers { omega } else { 1.0 });
    let phase = omega * t + drift * (1.0 - (-alpha * t).exp()) / alpha;
    r * phase.cos() + gamma * r.powi(3) / (32.0 * square) * (3.0 * phase).cos()
        - mu * r * r / (6.0 * square) * ((2.0 * phase).cos() - 3.0)
}

// Erratum 3, (22)-(25): powers of ω0 are missing. Judges: integration of the same equation, and the
// unit of time, which must not matter.
#[test]
fn erratum_3_the_expansion_needs_its_powers_of_the_frequency() {
    let line = driveline(&["half-shaft.cubic=642"]);
    let text = |method: &str| QuestionText {
        method: some(method),
        order: (method == "multiple-scales").then(|| "1".to_owned()),
        initial: vec!["half-shaft.twist=0.3".to_owned()],
        ..Default::default()
    };
    let integrated = history(&line, Verb::Shock, &text("published"));
    let details = integrated.shock.as_ref().expect("a shock");
    let value = |name: &str| details.coefficients[name];
    let (omega, alpha) = (value("omega_0"), value("alpha_0"));
    let (gamma, mu) = (value("gamma"), value("mu"));
    let largest_error = |powers: bool| {
        // The amplitude that meets θ(0) = 0.3 with the respective form, by bisection.
        let start = |r0: f64| first_order(omega, alpha, gamma, mu, powers, 0.0, r0) - 0.3;
        let (mut low, mut high) = (0.0, 0.6);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if start(middle) > 0.0 { high = middle } else { low = middle }
        }
        let rows = integrated.values("time").iter().zip(integrated.values("half-shaft.twist"));
        rows.take_while(|(t, _)| **t < 1.0)
            .map(|(t, x)| (first_order(omega, alpha, gamma, mu, powers, *t, low) - x).abs())
            .fold(0.0, f64::max)
    };
    assert!(largest_error(true) < 0.06, "{}", largest_error(true));
    assert!(largest_error(false) > 4.0 * largest_error(true), "{}", largest_error(false));
    // In minutes instead of seconds the coefficients change, the motion must not.
    let minute = |powers: bool| {
        first_order(
            60.0 * omega,
            60.0 * alpha,
            3600.0 * gamma,
            3600.0 * mu,
            powers,
            0.2 / 60.0,
            0.3,
        )
    };
    let second = |powers: bool| first_order(omega, alpha, gamma, mu, powers, 0.2, 0.3);
    assert_close(minute(true), second(true), 1e-12);
    assert!((minute(false) - second(false)).abs() > 1.0);
    let program = history(&line, Verb::Shock, &text("multiple-scales"));
    let rows = program.values("half-shaft.twist").iter().zip(integrated.values("half-shaft.twist"));
    assert!(rows.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) < 0.06);
}

// Erratum 4, F in (29): with unequal inertias it is T_m/J_m + T_L/J_L. Judge: the periodic orbit of
// the full line, whose amplitude at resonance is f/(β ω1) when damping is light.
#[test]
fn erratum_4_each_torque_is_divided_by_its_own_inertia() {
    let settings = ["engine torque.mean=0", "half-shaft.cubic=0", "half-shaft.damping=1"];
    let line = driveline(&settings);
    let omega = (6420.0 * (1.0 / JM + 1.0 / JL)).sqrt();
    let window = format!("{omega:?}..{:?}", omega * 1.001);
    let text = QuestionText { verify: true, frequency: Some(window), ..Default::default() };
    let point = resonance(&line, &text).verification[0].clone();
    let beta = 1.0 / JM + 1.0 / JL;
    let torque = 5.71 * 40.0;
    let right = torque / JM / (beta * omega);
    let printed = (JM + JL) * torque / (JM * JL) / (beta * omega);
    assert_close(point.integrated, right, 1e-4);
    assert!((point.integrated / printed - 1.0).abs() > 0.1);
}

// Erratum 5, below (30): with alpha = eps a the small parameter is applied once. Judge: the folds at
// f = 10 that figure 8 shows.
#[test]
fn erratum_5_the_small_parameter_is_applied_once() {
    let folds_of = |alpha: f64, beta: f64| {
        let line =
            oscillator(&[&format!("spring.cubic={alpha}"), &format!("spring.damping={beta}")]);
        let result = resonance(&line, &QuestionText::default());
        let points = result.branches.iter().flat_map(|branch| branch.special_points.clone());
        points.filter(|point| point.kind == SpecialKind::Fold).count()
    };
    // Figure 8 shows two folds on each bent curve.
    assert_eq!(folds_of(-0.679, 0.0951), 2);
    assert_eq!(folds_of(-0.679 * 0.01, 0.0951 * 0.01), 2);
    let peak = |alpha: f64, beta: f64| {
        let line =
            oscillator(&[&format!("spring.cubic={alpha}"), &format!("spring.damping={beta}")]);
        resonance(&line, &QuestionText::default()).peaks[0]["rho"]
    };
    // Its peak is at 4.03; applied twice it would be a hundred times higher.
    assert_close(peak(-0.679, 0.0951), 4.035, 1e-3);
    assert!(peak(-0.679 * 0.01, 0.0951 * 0.01) > 400.0);
}

/// Slow flow (43), (44) in amplitude and phase, as `(ρ', η')`.
fn slow_flow(sigma: f64, alpha: f64, beta: f64, f: f64, rho: f64, eta: f64) -> (f64, f64) {
    let drive = f / (2.0 * OMEGA);
    let bend = 3.0 * alpha / (8.0 * OMEGA) * rho * rho;
    (-beta / 2.0 * rho + drive * eta.sin(), sigma - bend + drive / rho * eta.cos())
}

// Erratum 6, (46), (49)-(53): a1 = beta and a2 without factors rho_0 and eta_0. Judge: the Jacobian
// of the slow flow by differences, and the product of the multipliers by shooting.
#[test]
fn erratum_6_the_characteristic_polynomial_has_no_factors_of_the_amplitude() {
    let (alpha, beta, f) = (-0.679, 0.0951, 10.0);
    let result = resonance(&oscillator(&[]), &QuestionText::default());
    let branch = &result.branches[0];
    for row in (0..branch.values("rho").len()).step_by(97) {
        let at = |name: &str| branch.values(name)[row];
        let (sigma, rho, eta) = (at("sigma"), at("rho"), at("phase"));
        let h = 1e-5;
        let flow = |rho: f64, eta: f64| slow_flow(sigma, alpha, beta, f, rho, eta);
        let (a, b) = (flow(rho + h, eta), flow(rho - h, eta));
        let (c, d) = (flow(rho, eta + h), flow(rho, eta - h));
        let [rr, er] = [(a.0 - b.0) / (2.0 * h), (a.1 - b.1) / (2.0 * h)];
        let [re, ee] = [(c.0 - d.0) / (2.0 * h), (c.1 - d.1) / (2.0 * h)];
        let (a1, a2) = (-(rr + ee), rr * ee - re * er);
        let kappa = 3.0 * alpha / (8.0 * OMEGA);
        let right_a2 =
            beta * beta / 4.0 + (sigma - kappa * rho * rho) * (sigma - 3.0 * kappa * rho * rho);
        assert_close(a1, beta, 1e-6);
        assert!((a2 - right_a2).abs() < 1e-7 * right_a2.abs().max(1e-3));
        let printed_a1 = (beta + beta * rho) / 2.0;
        if (rho - 1.0).abs() > 0.1 {
            assert!((a1 / printed_a1 - 1.0).abs() > 0.04, "rho {rho}");
        }
    }
}

// Erratum 7, text to figure 9: the threshold is alpha = -0.3125, not -0.135. Judge: folds counted
// on either side.
#[test]
fn erratum_7_the_threshold_of_figure_9_is_minus_0_3125() {
    let cusps = folds(&oscillator(&[]), "spring.cubic=-1..0").special_points;
    assert_eq!(cusps.len(), 1);
    assert_close(cusps[0].value("spring.cubic").expect("named"), -0.312_472_373_6, 1e-9);
    let folds_at = |alpha: f64| {
        let line = oscillator(&[&format!("spring.cubic={alpha}")]);
        let result = resonance(&line, &QuestionText::default());
        let points = result.branches.iter().flat_map(|branch| branch.special_points.clone());
        points.filter(|point| point.kind == SpecialKind::Fold).count()
    };
    assert_eq!([folds_at(-0.314), folds_at(-0.311)], [2, 0]);
    assert_eq!([folds_at(-0.137), folds_at(-0.133)], [0, 0]);
}

// Erratum 8: a softening shaft limits the static torque, so the advice to take negative k3 holds only
// below it. Judge: the full line by integration, loaded slowly by its own mean torque.
#[test]
fn erratum_8_a_softening_shaft_cannot_carry_the_low_gears() {
    let settle = |cubic: &str| {
        let line = driveline(&["gearbox.ratio=1.79", cubic, "half-shaft.damping=2000"]);
        let text = QuestionText { duration: some("20s"), ..Default::default() };
        history(&line, Verb::Simulate, &text)
    };
    let hardening = settle("half-shaft.cubic=642");
    assert_eq!(hardening.header.termination.reason, Reason::Completed);
    let twist = *hardening.values("half-shaft.twist").last().expect("samples");
    assert_close(6420.0 * twist + 642.0 * twist.powi(3), 850.0 * 5.71 * 1.79, 1e-9);
    let softening = settle("half-shaft.cubic=-642");
    assert_ne!(softening.header.termination.reason, Reason::Completed);
}
