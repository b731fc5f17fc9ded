//! Multipliers of long lines in a few modes against those of the whole line.

use super::lines::{Model, keys};
use super::{Traced, setting_of, traced_with};
use crate::harmonic_balance::monodromy::{Orbit, Variational};
use crate::harmonic_balance::system::{HarmonicSystem, Place};
use halfshaft_numerics::Complex;

/// A line of 30 inertias whose first shaft is nonlinear.
fn line(first: &str, ground: &str) -> String {
    let mut model = Model::new();
    for k in 0..30 {
        model = model.inertia(&format!("n{k}"), 0.3, if k % 7 == 3 { ground } else { "" });
    }
    model = model.shaft("first", "n0", "n1", first);
    for k in 1..29 {
        let (from, to) = (format!("n{k}"), format!("n{}", k + 1));
        model = model.shaft(&format!("s{k}"), &from, &to, &keys(2e5, 10.0, ""));
    }
    model.torque("drive", "n29", "amplitude = 6").0
}

/// Multipliers of every fifth sample, in modes and of the whole line.
fn both(found: &Traced) -> Vec<(Vec<Complex>, Vec<Complex>)> {
    let line = &found.setting.line;
    let nonlinear = &line.skeleton.nonlinear;
    let mut few = Variational::new(&line.equations, nonlinear);
    let mut whole = Variational::new(&line.equations, nonlinear).of_whole_lines();
    let samples = found.collected.branches.iter().flat_map(|b| &b.samples).step_by(5);
    samples
        .map(|sample| {
            let mut system = HarmonicSystem::new(line.clone(), sample.set.clone(), 1.0);
            let place = Place { frequency: sample.p, drive: 1.0 };
            system.evaluate(&sample.u, place, false);
            let mut twist = vec![0.0; sample.set.coefficients()];
            system.twist(0, &sample.u, &mut twist);
            let twists = [(line.twists[0].connection, twist)];
            let orbit = Orbit { set: &sample.set, speed: sample.p, twists: &twists };
            let of = |v: &mut Variational| v.multipliers(&line.equations, &orbit).expect("found");
            (of(&mut few), of(&mut whole))
        })
        .collect()
}

// Source: the variational equation of the whole line, whose multipliers those in modes must be among.
#[track_caller]
fn assert_the_same(text: &str, range: (f64, f64)) {
    let found = traced_with(setting_of(text, range), 1e-6, None);
    let list = both(&found);
    assert!(list.len() > 10);
    let mut least = f64::INFINITY;
    for (few, whole) in list {
        assert!(few.len() < whole.len(), "{} of {}", few.len(), whole.len());
        // Damping grows with the frequency here, and modes far above the harmonics are rough.
        for value in few.iter().filter(|m| m.modulus() > 0.8) {
            let away = whole.iter().map(|m| (*m - *value).modulus()).fold(f64::INFINITY, f64::min);
            assert!(away < 1e-7, "{value:?}: {away:e} in {whole:?}");
        }
        assert!((few[0].modulus() - whole[0].modulus()).abs() < 1e-7);
        let outside = |list: &[Complex]| list.iter().filter(|m| m.modulus() > 1.0).count();
        assert_eq!(outside(&few), outside(&whole));
        least = least.min(1.0 - few[0].modulus());
    }
    assert!(least < 0.0, "the line is meant to have an unstable response");
}

#[test]
fn of_a_free_line() {
    assert_the_same(&line(&keys(15.0, 0.05, "cubic = 30"), ""), (7.0, 11.0));
}

#[test]
fn of_a_line_that_ground_dampers_brake() {
    let text = line(&keys(15.0, 0.02, "cubic = 30"), "damping = 0.05");
    assert_the_same(&text, (7.0, 11.0));
}
