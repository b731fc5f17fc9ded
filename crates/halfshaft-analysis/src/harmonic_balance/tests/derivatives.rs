//! Jacobian and derivatives of the harmonic balance equations against difference quotients.

use halfshaft_numerics::harmonics::HarmonicSet;

use super::{lines, setting_of};
use crate::harmonic_balance::system::{HarmonicSystem, Place};

/// A reproducible list of numbers in (-1, 1).
fn numbers(count: usize, seed: f64) -> Vec<f64> {
    (0..count).map(|k| (seed + 12.9898 * k as f64).sin()).collect()
}

/// A friction shaft and a preload beside polynomial laws.
fn rubbing() -> String {
    lines::Model::new()
        .inertia("disc", 1.0, "")
        .inertia("other", 0.7, "damping = 0.1")
        .shaft("spring", "disc", "other", &lines::keys(3.0, 0.1, "cubic = 1\nfriction = 0.4"))
        .shaft("held", "other", "ground", &lines::keys(5.0, 0.1, "quadratic = 2\npreload = 0.3"))
        .torque("drive", "disc", "amplitude = 1\nmean = 0.2")
        .0
}

// Source: central difference quotients of the residual with Richardson's extrapolation.
#[test]
fn derivatives_are_those_of_the_residual() {
    let texts = [
        (lines::d1(), 0.3),
        (lines::absorber(0.11), 0.3),
        (lines::many_orders(), 0.2),
        (lines::geared(), 0.1),
        (lines::mesh(), 0.3),
        (lines::full_mesh(), 0.3),
        (lines::free_with_mean(), 0.1),
        (lines::free_damped(), 0.1),
        (lines::long_row(9, 4, false), 0.1),
        (rubbing(), 0.4),
    ];
    for (text, size) in texts {
        let setting = setting_of(&text, (1.0, 9.0));
        for set in [HarmonicSet::all(4), HarmonicSet::odd(5)] {
            if set.is_odd() && !setting.odd {
                continue;
            }
            let mut system = HarmonicSystem::new(setting.line.clone(), set.clone(), setting.base);
            let n = system.unknowns();
            let u: Vec<f64> = numbers(n, 0.3).iter().map(|x| size * x).collect();
            let place = Place { frequency: 4.3, drive: 0.7 };
            let direction = numbers(n, 1.7);
            let mut matrix = system.blocks(0);
            system.evaluate(&u, place, true);
            system.fill(&mut matrix);
            let (by_frequency, by_drive) = (system.by_frequency.clone(), system.by_drive.clone());
            let mut product = vec![0.0; n];
            matrix.add_product(&direction, &mut product);
            let mut along = |what: &dyn Fn(f64) -> (Vec<f64>, Place)| {
                let mut quotient = |h: f64| {
                    let mut at = |h: f64| {
                        let (u, place) = what(h);
                        system.evaluate(&u, place, false);
                        system.residual.clone()
                    };
                    let (above, below) = (at(h), at(-h));
                    above.iter().zip(&below).map(|(a, b)| (a - b) / (2.0 * h)).collect::<Vec<_>>()
                };
                let (wide, narrow) = (quotient(2e-4), quotient(1e-4));
                wide.iter().zip(&narrow).map(|(w, n)| (4.0 * n - w) / 3.0).collect::<Vec<f64>>()
            };
            let moved = |h: f64| u.iter().zip(&direction).map(|(u, d)| u + h * d).collect();
            let found = along(&|h| (moved(h), place));
            let faster = |h: f64| Place { frequency: place.frequency + h, ..place };
            let with_frequency = along(&|h| (u.clone(), faster(h)));
            let stronger = |h: f64| Place { drive: place.drive + h, ..place };
            let with_drive = along(&|h| (u.clone(), stronger(h)));
            for (exact, quotient, what) in [
                (&product, &found, "response"),
                (&by_frequency, &with_frequency, "frequency"),
                (&by_drive, &with_drive, "drive"),
            ] {
                let scale = exact.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
                for (a, b) in exact.iter().zip(quotient) {
                    assert!((a - b).abs() < 2e-8 * scale, "by {what}: {a} and {b}\n{text}");
                }
            }
        }
    }
}
