//! `modes`: natural frequencies, damping, shapes, energy shares.

mod common;

use common::{assert_close, chain, driveline, line_of, modes};
use halfshaft_numerics::Complex;
use halfshaft_results::ModesResult;
use proptest::prelude::{prop_assert, proptest};
use std::f64::consts::{PI, TAU};

fn hertz(result: &ModesResult) -> Vec<f64> {
    result.modes.iter().map(|mode| mode.frequency / TAU).collect()
}

// Source: the relative twist of two inertias: ω² = k (1/J_m + 1/J_L), ζ = c/(2 J_eff ω).
#[test]
fn the_two_mass_line_has_its_closed_form() {
    let result = modes(&driveline(&["half-shaft.cubic=0"]));
    let (jm, jl) = (0.328 * 5.71 * 5.71, 81.6);
    let j = jm * jl / (jm + jl);
    let omega = (6420.0_f64 / j).sqrt();
    let zeta = 90.0 / (2.0 * j * omega);
    assert_eq!(result.modes.len(), 2);
    assert_eq!(result.modes[0].frequency, 0.0);
    let mode = &result.modes[1];
    assert_close(mode.frequency, omega, 1e-14);
    assert_close(mode.damping_ratio, zeta, 1e-13);
    assert_close(mode.damped_frequency, omega * (1.0 - zeta * zeta).sqrt(), 1e-13);
    assert!((mode.frequency - 26.0577).abs() < 5e-5); // theory 6: omega_1 = 26.06 at i0 = 1
    // The node of the two-mass mode: inertias move against each other by their inverse ratio.
    assert_close(mode.shape["vehicle"] / mode.shape["half-shaft flange"], -jm / jl, 1e-13);
    assert_close(mode.shape["engine"], 1.0, 0.0);
}

// Source: linearisation: about the loaded equilibrium ω² = (k1 + 3 k3 φ0²)/J_eff.
#[test]
fn modes_are_about_the_loaded_equilibrium() {
    let result = modes(&driveline(&[]));
    let x = result.equilibrium.twist["half-shaft"];
    let (jm, jl) = (0.328 * 5.71 * 5.71, 81.6);
    let stiffness = 6420.0 - 3.0 * 642.0 * x * x;
    assert_close(result.modes[1].frequency.powi(2), stiffness * (1.0 / jm + 1.0 / jl), 1e-13);
}

// Source: natural frequencies in Hz from openTorsion 0.3.2 and an independent SciPy assembly
// (reference cases T01, T03, T06, D01), ten digits.
#[test]
fn chains_agree_with_two_independent_programs() {
    let case = |inertias: &[f64], stiffness: &[f64], expected: &[f64]| {
        let found = hertz(&modes(&line_of(&chain(inertias, stiffness, None, 0.0), &[])));
        assert_eq!(found.len(), expected.len());
        assert_eq!(found[0], 0.0);
        for (found, expected) in found.iter().zip(expected).skip(1) {
            assert_close(*found, *expected, 2e-9);
        }
    };
    case(&[211.4, 8.3], &[9_775_000.0], &[0.0, 176.076_746_8]);
    case(
        &[0.0035, 0.0035, 0.0035, 0.15, 0.05],
        &[12e3, 12e3, 14e3, 10e3],
        &[0.0, 81.207_629_02, 141.214_071_4, 378.952_953_9, 536.363_282_9],
    );
    case(
        &[100.0, 10.0, 50.0, 10.0, 80.0],
        &[25e6; 4],
        &[0.0, 58.712_328_28, 124.854_161_4, 360.977_249_3, 378.868_411],
    );
    let inertias = [90.0, 140.0, 140.0, 140.0, 140.0, 90.0, 350.0, 500.0, 22_000.0];
    let stiffness = [2.5e6, 2.5e6, 2.5e6, 2.5e6, 2.5e6, 40e6, 40e6, 3e6];
    let grounded = chain(&inertias, &stiffness, Some(10e6), 0.0)
        + "[[shaft]]\nname = \"ground 5\"\nfrom = \"n5\"\nto = \"ground\"\nstiffness = 1e7\n";
    let expected = [
        1.547_929_286,
        11.926_381_82,
        17.923_872_47,
        24.448_801_38,
        33.714_733_82,
        40.184_989_78,
        60.315_129_92,
        69.240_964_11,
        132.804_259_6,
    ];
    for (found, expected) in hertz(&modes(&line_of(&grounded, &[]))).iter().zip(expected) {
        assert_close(*found, expected, 2e-9);
    }
}

// Source: exact frequencies of a uniform chain held at one end,
// ω_j = 2 sqrt(k/J) sin((2 j - 1) π / (2 (2 n + 1))).
#[test]
fn a_uniform_chain_has_its_exact_frequencies() {
    let n = 40;
    let text = chain(&vec![2.0; n], &vec![500.0; n - 1], Some(500.0), 0.0);
    let result = modes(&line_of(&text, &[]));
    for (index, mode) in result.modes.iter().enumerate() {
        let angle = (2 * index + 1) as f64 * PI / (2 * (2 * n + 1)) as f64;
        assert_close(mode.frequency, 2.0 * (500.0_f64 / 2.0).sqrt() * angle.sin(), 1e-11);
    }
}

// Source: a geared line equals the line reduced by hand; the rigid-body mode is exactly zero.
#[test]
fn gears_are_the_same_as_reduction_by_hand() {
    let geared = "format = 1\nname = \"x\"\n[[inertia]]\nname = \"motor\"\ninertia = 0.1\n\
        [[gear]]\nname = \"g\"\ninput = \"motor\"\noutput = \"out\"\nratio = -10\n\
        [[inertia]]\nname = \"out\"\ninertia = 2\n[[inertia]]\nname = \"load\"\ninertia = 2\n\
        [[shaft]]\nname = \"s\"\nfrom = \"out\"\nto = \"load\"\nstiffness = 1e4\ndamping = 10\n";
    let result = modes(&line_of(geared, &[]));
    assert_eq!(result.modes[0].frequency, 0.0);
    assert_close(result.modes[0].shape["out"] / result.modes[0].shape["motor"], -0.1, 1e-14);
    let by_hand = modes(&line_of(&chain(&[12.0, 2.0], &[1e4], None, 10.0), &[]));
    assert_close(result.modes[1].frequency, by_hand.modes[1].frequency, 1e-14);
    assert_close(result.modes[1].damping_ratio, by_hand.modes[1].damping_ratio, 1e-13);
    // Reference case P06: 12.155 659 57 Hz with the motor's 0.1 at ratio 10.
    assert_close(result.modes[1].frequency / TAU, 12.155_659_57, 1e-9);
}

/// How far `λ² M + λ C + K` of a chain is from singular: the smallest term of its twisted
/// factorisation over the diagonal. Eliminating from both ends towards node `k` leaves there
/// `det/(the other pivots)`, which is accurate at the node that moves most.
fn distance_from_singular(
    inertias: &[f64],
    stiffness: &[f64],
    dampers: &[f64],
    to_ground: &[f64],
    (re, im): (f64, f64),
) -> f64 {
    let lambda = Complex::new(re, im);
    let link = |i: usize| Complex::from(stiffness[i]) + lambda * Complex::from(dampers[i]);
    let n = inertias.len();
    let diagonal: Vec<Complex> = (0..n)
        .map(|i| {
            let own = lambda * (lambda * Complex::from(inertias[i]) + Complex::from(to_ground[i]));
            let before = if i > 0 { link(i - 1) } else { Complex::default() };
            let after = if i + 1 < n { link(i) } else { Complex::default() };
            own + before + after
        })
        .collect();
    let (mut forward, mut backward) = (diagonal.clone(), diagonal.clone());
    for i in 1..n {
        forward[i] = diagonal[i] - link(i - 1) * link(i - 1) / forward[i - 1];
        let j = n - 1 - i;
        backward[j] = diagonal[j] - link(j) * link(j) / backward[j + 1];
    }
    (0..n)
        .map(|k| (forward[k] + backward[k] - diagonal[k]).modulus() / diagonal[k].modulus())
        .fold(f64::INFINITY, f64::min)
}

// Source: the defining equation det(λ² M + λ C + K) = 0, by an elimination of its own; light,
// heavy (overdamped pairs) and coupled damping.
#[test]
fn damped_eigenvalues_satisfy_their_equation() {
    let (inertias, stiffness) = ([1.0, 2.0, 0.7, 1.5], [400.0, 900.0, 300.0]);
    for (dampers, to_ground) in
        [([1.0, 0.2, 3.0], [0.0, 0.4, 0.0, 0.1]), ([90.0, 0.0, 2.0], [0.5, 0.0, 0.0, 30.0])]
    {
        let text = chain(&inertias, &stiffness, None, 0.0);
        let mut settings: Vec<String> = Vec::new();
        for (i, c) in dampers.iter().enumerate() {
            settings.push(format!("s{i}.damping={c}"));
        }
        for (i, d) in to_ground.iter().enumerate() {
            settings.push(format!("n{i}.damping={d}"));
        }
        let settings: Vec<&str> = settings.iter().map(String::as_str).collect();
        let result = modes(&line_of(&text, &settings));
        let mut seen: Vec<(f64, f64)> = Vec::new();
        for mode in &result.modes {
            seen.extend(mode.eigenvalues);
        }
        assert_eq!(seen.len(), 8);
        for lambda in seen.iter().filter(|lambda| **lambda != (0.0, 0.0)) {
            let rest = distance_from_singular(&inertias, &stiffness, &dampers, &to_ground, *lambda);
            assert!(rest < 1e-10, "{lambda:?}: {rest:e}");
        }
        // The eigenvalues sum to minus the trace of M⁻¹ C (Vieta).
        let trace: f64 = (0..4)
            .map(|i| {
                let before = if i > 0 { dampers[i - 1] } else { 0.0 };
                let after = if i < 3 { dampers[i] } else { 0.0 };
                (before + after + to_ground[i]) / inertias[i]
            })
            .sum();
        assert_close(seen.iter().map(|lambda| lambda.0).sum::<f64>(), -trace, 1e-11);
    }
}

proptest! {
    // Source: invariants: shares of energy sum to one; modes are orthogonal in the inertia and to
    // the rigid-body motion; Rayleigh's quotient of a shape is its frequency squared.
    #[test]
    fn shapes_are_orthogonal_and_energies_sum_to_one(
        inertias in proptest::collection::vec(0.01..10.0_f64, 3..7),
        k in 10.0..1e5_f64,
    ) {
        let stiffness: Vec<f64> = (1..inertias.len()).map(|i| k * i as f64).collect();
        let result = modes(&line_of(&chain(&inertias, &stiffness, None, 0.0), &[]));
        let shapes: Vec<Vec<f64>> = result.modes.iter().map(|mode| {
            (0..inertias.len()).map(|i| mode.shape[format!("n{i}").as_str()]).collect()
        }).collect();
        let inner = |a: &[f64], b: &[f64]| -> f64 {
            a.iter().zip(b).zip(&inertias).map(|((a, b), m)| a * b * m).sum()
        };
        for (i, mode) in result.modes.iter().enumerate() {
            prop_assert!((mode.kinetic_energy.values().sum::<f64>() - 1.0).abs() < 1e-12);
            if i > 0 {
                prop_assert!((mode.strain_energy.values().sum::<f64>() - 1.0).abs() < 1e-12);
                let strain: f64 = stiffness.iter().enumerate()
                    .map(|(s, k)| k * mode.twist[format!("s{s}").as_str()].powi(2)).sum();
                let quotient = strain / inner(&shapes[i], &shapes[i]);
                prop_assert!((quotient / mode.frequency.powi(2) - 1.0).abs() < 1e-9);
            }
            for other in &shapes[..i] {
                let size = (inner(other, other) * inner(&shapes[i], &shapes[i])).sqrt();
                prop_assert!(inner(other, &shapes[i]).abs() < 1e-9 * size);
            }
        }
    }
}
