//! Curves over the drive: one seed for each response of one harmonic.

use halfshaft_numerics::harmonics::HarmonicSet;
use halfshaft_numerics::observer::Silent;
use halfshaft_numerics::polynomial::Polynomial;

use super::lines::duffing;
use super::setting_of;
use crate::harmonic_balance::seeds::{Seed, over_drive};
use crate::harmonic_balance::tracer::{Counted, length};

const DAMPING: f64 = 0.05;

fn seeds(cubic: f64, torque: f64, speed: f64) -> Vec<Seed> {
    let setting = setting_of(&duffing(DAMPING, 1.0, cubic, torque), (0.5 * speed, 2.0 * speed));
    let (line, rest) = (&setting.line, &setting.rest);
    over_drive(line, rest, 1.0, true, 1, speed, &Silent, &mut Counted::default())
}

/// Amplitudes `A` with `A² ((1 - Ω² + 3/4 g A²)² + c² Ω²) = P²`.
fn amplitudes(cubic: f64, torque: f64, speed: f64) -> Vec<f64> {
    let (a, b) = (1.0 - speed * speed, 0.75 * cubic);
    let drag = (DAMPING * speed).powi(2);
    let squares = Polynomial::new([-torque * torque, a * a + drag, 2.0 * a * b, b * b]);
    let roots = squares.real_roots().into_iter().map(|root| root.value);
    roots.filter(|root| *root > 0.0).map(f64::sqrt).collect()
}

/// The largest drive on the way to an amplitude.
fn largest_drive(cubic: f64, torque: f64, speed: f64, amplitude: f64) -> f64 {
    let (a, b) = (1.0 - speed * speed, 0.75 * cubic);
    let drag = (DAMPING * speed).powi(2);
    let drive = |x: f64| x * ((a + b * x * x).powi(2) + drag).sqrt() / torque;
    (0..=1000).map(|k| drive(1e-3 * f64::from(k) * amplitude)).fold(0.0, f64::max)
}

// Source: all roots of the cubic for the square of the amplitude. The drive is a function of the amplitude
// here, so that its curve passes drive 1 at each of them.
#[test]
fn every_response_of_one_inertia_is_passed() {
    let mut several = 0;
    for cubic in [0.1_f64, 3.0, -0.1] {
        for torque in [0.02_f64, 0.18, 1.0, 10.0, 100.0, 1000.0] {
            for part in 1..=9 {
                let size = (torque / cubic.abs()).cbrt();
                let own = 1.0 + (0.75 * cubic.abs()).sqrt() * size;
                let speed = 0.3 * f64::from(part) * own.min(1.0 + 0.5 * own);
                let wanted = amplitudes(cubic, torque, speed);
                // Curves are followed to twenty times the drive.
                let last = wanted.last().copied().unwrap_or(0.0);
                if largest_drive(cubic, torque, speed, last) > 19.0 {
                    continue;
                }
                let mut found: Vec<f64> =
                    seeds(cubic, torque, speed).iter().map(|seed| length(&seed.u)).collect();
                found.sort_by(f64::total_cmp);
                let place = format!("g {cubic} P {torque} at {speed}");
                assert_eq!(found.len(), wanted.len(), "{place}: {found:?} {wanted:?}");
                for (one, other) in found.iter().zip(&wanted) {
                    assert!((one / other - 1.0).abs() < 1e-6, "{place}: {one} {other}");
                }
                several += usize::from(wanted.len() == 3);
            }
        }
    }
    assert!(several > 20, "{several}");
    assert_eq!(seeds(0.1, 0.18, 1.2)[0].set, HarmonicSet::odd(1));
}
