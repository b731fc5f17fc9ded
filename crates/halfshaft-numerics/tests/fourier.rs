//! Harmonics and extremes from samples.

use std::f64::consts::{PI, TAU};

use halfshaft_numerics::Error;
use halfshaft_numerics::bracket::{MinimumSettings, find_minimum};
use halfshaft_numerics::fourier::{half_peak_to_peak, harmonic, maximum, mean, minimum};
use proptest::prelude::{prop_assert, proptest};

/// `mean + Σ a_n cos(n θ + φ_n)` with the harmonics numbered from 1.
fn signal(mean: f64, harmonics: &[(f64, f64)], theta: f64) -> f64 {
    let term = |(k, (a, phase)): (usize, &(f64, f64))| a * ((k + 1) as f64 * theta + phase).cos();
    mean + harmonics.iter().enumerate().map(term).sum::<f64>()
}

fn samples(count: usize, x: impl Fn(f64) -> f64) -> Vec<f64> {
    (0..count).map(|k| x(TAU * k as f64 / count as f64)).collect()
}

proptest! {
    /// Source of truth: the trigonometric polynomial from which the samples were taken.
    #[test]
    fn harmonics_of_a_trigonometric_polynomial_are_exact(
        constant in -3.0..3.0_f64,
        harmonics in proptest::collection::vec((0.01..2.0_f64, -3.1..3.1_f64), 1..7),
        extra in 0..40_usize,
    ) {
        let count = 2 * harmonics.len() + 1 + extra;
        let samples = samples(count, |theta| signal(constant, &harmonics, theta));
        prop_assert!((mean(&samples).expect("samples") - constant).abs() < 1e-13);
        for (k, (modulus, phase)) in harmonics.iter().enumerate() {
            let found = harmonic(&samples, k + 1).expect("samples");
            prop_assert!((found.modulus - modulus).abs() < 1e-13);
            prop_assert!(((found.phase - phase) * modulus).abs() < 1e-13);
        }
    }

    /// Source of truth: a golden-section search over every sixtieth part of the known polynomial.
    #[test]
    fn extremes_lie_between_the_samples(
        harmonics in proptest::collection::vec((0.01..2.0_f64, -3.1..3.1_f64), 1..5),
        count in 24..70_usize,
    ) {
        let x = |theta: f64| signal(0.5, &harmonics, theta);
        let samples = samples(count, x);
        let least = |sign: f64| {
            (0..60).map(|k| {
                let (a, b) = (TAU * f64::from(k) / 60.0, TAU * f64::from(k + 1) / 60.0);
                let found = find_minimum(|t| sign * x(t), a, b, MinimumSettings::default());
                found.expect("finite").value
            }).fold(f64::INFINITY, f64::min)
        };
        let (bottom, top) = (least(1.0), -least(-1.0));
        let found = maximum(&samples).expect("samples");
        prop_assert!((found.value - top).abs() < 1e-12, "{} against {top}", found.value);
        prop_assert!((x(found.phase) - top).abs() < 1e-12);
        prop_assert!((minimum(&samples).expect("samples").value - bottom).abs() < 1e-12);
        let half = half_peak_to_peak(&samples).expect("samples");
        prop_assert!((half - 0.5 * (top - bottom)).abs() < 1e-12);
    }
}

/// Source of truth: `A cos(θ - φ)` has its top at φ; three samples determine it.
#[test]
fn three_samples_are_enough_for_one_harmonic() {
    for phase in [0.0, 0.3, PI, 4.0, 6.2] {
        let found = maximum(&samples(3, |theta| 2.0 * (theta - phase).cos())).expect("samples");
        assert!((found.value - 2.0).abs() < 1e-14);
        assert!((found.phase - phase).abs() < 1e-14 || (found.phase - phase).abs() > TAU - 1e-14);
    }
}

/// Source of truth: constants, the highest order of an even count, and the documented errors.
#[test]
fn degenerate_signals_and_misuse() {
    assert!(half_peak_to_peak(&[4.0; 9]).expect("samples") < 1e-14);
    assert_eq!(half_peak_to_peak(&[4.0]), Ok(0.0));
    assert_eq!(half_peak_to_peak(&[1.0, -1.0, 1.0, -1.0]), Ok(1.0));
    assert_eq!(harmonic(&[-2.0], 0).map(|h| (h.modulus, h.phase)), Ok((2.0, PI)));
    let few = harmonic(&[1.0, 2.0], 1);
    assert_eq!(few, Err(Error::TooFewSamples { harmonic: 1, needed: 3, samples: 2 }));
    assert!(mean(&[]).is_err() && maximum(&[]).is_err());
    assert!(matches!(mean(&[1.0, f64::NAN]), Err(Error::NonFinite { .. })));
}
