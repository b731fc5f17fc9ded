//! Multipliers of orbits side by side against those of each orbit by itself.

use halfshaft_numerics::Complex;
use halfshaft_numerics::harmonics::HarmonicSet;

use super::lines::{Model, keys};
use super::{equations_of, setting_of};
use crate::harmonic_balance::monodromy::{Orbit, Variational};
use crate::harmonic_balance::side_by_side::ORBITS;

/// Motions with the given coefficients of the first twist, others a part of it, at growing speeds.
fn both(text: &str, set: &HarmonicSet, count: usize) -> Vec<(Vec<Complex>, Vec<Complex>)> {
    let setting = setting_of(text, (1.0, 2.0));
    let line = &setting.line;
    let nonlinear = &line.skeleton.nonlinear;
    let mut variational = Variational::new(&line.equations, nonlinear);
    let m = set.coefficients();
    let motion = |k: usize| -> Vec<(usize, Vec<f64>)> {
        let wave = |at: usize, shaft: usize| {
            (1.3 * at as f64 + 0.4 * k as f64 + shaft as f64).sin() / (1.0 + at as f64)
        };
        let twist = |shaft: usize| (0..m).map(|at| wave(at, shaft)).collect();
        nonlinear.iter().enumerate().map(|(place, shaft)| (*shaft, twist(place))).collect()
    };
    let motions: Vec<_> = (0..count).map(motion).collect();
    let speed = |k: usize| 0.8 + 0.13 * k as f64;
    let orbit = |(k, twists)| Orbit { set, speed: speed(k), twists };
    let orbits: Vec<Orbit<'_>> = motions.iter().map(Vec::as_slice).enumerate().map(orbit).collect();
    let all = variational.multipliers_of_all(&line.equations, &orbits).expect("a small line");
    let one = |orbit| variational.multipliers(&line.equations, orbit).expect("found");
    let alone = orbits.iter().map(one).collect::<Vec<_>>();
    let all = all.into_iter().zip(&alone).map(|(together, alone)| {
        // One orbit is left to itself.
        assert!(together.is_some() || orbits.len() % ORBITS == 1);
        together.unwrap_or_else(|| alone.clone())
    });
    all.collect::<Vec<_>>().into_iter().zip(alone).collect()
}

// Source: the same equation by steps of each orbit's own, one column in a lane.
#[track_caller]
fn assert_the_same(text: &str, set: &HarmonicSet) {
    for count in [2, 7, 9, 19] {
        let list = both(text, set, count);
        assert_eq!(list.len(), count);
        for (together, alone) in list {
            assert_eq!(together.len(), alone.len());
            let size = alone[0].modulus().max(1.0);
            for value in &together {
                let away =
                    alone.iter().map(|m| (*m - *value).modulus()).fold(f64::INFINITY, f64::min);
                assert!(away < 2e-10 * size, "{value:?}: {away:e} in {alone:?}");
            }
            let product = |list: &[Complex]| list.iter().map(|m| m.modulus()).product::<f64>();
            let (one, other) = (product(&together), product(&alone));
            assert!((one / other - 1.0).abs() < 1e-8, "{one:e} {other:e}");
        }
    }
}

#[test]
fn of_one_inertia() {
    let text = super::lines::duffing(0.05, 1.0, 0.7, 0.2);
    assert_the_same(&text, &HarmonicSet::odd(5));
    assert_the_same(&text, &HarmonicSet::all(4));
}

#[test]
fn of_laws_of_other_degrees_between_gears_and_ground() {
    let law = "quadratic = 0.3\ncubic = -0.2\nquintic = 0.05";
    let text = Model::new()
        .inertia("a", 1.0, "damping = 0.02")
        .inertia("b", 0.6, "")
        .inertia("c", 0.4, "damping = 0.01")
        .shaft("left", "a", "ground", &keys(1.2, 0.03, law))
        .shaft("right", "b", "c", &keys(0.8, 0.02, "cubic = 0.4"))
        .shaft("third", "c", "ground", &keys(0.5, 0.0, ""))
        .gear("pair", "a", "b", 1.7, "")
        .torque("drive", "a", "amplitude = 0.1")
        .0;
    assert_the_same(&text, &HarmonicSet::all(3));
}

#[test]
fn of_free_lines_with_and_without_a_speed_of_their_own() {
    for ground in ["", "damping = 0.04"] {
        let text = Model::new()
            .inertia("a", 1.0, ground)
            .inertia("b", 0.5, "")
            .inertia("c", 0.7, "")
            .shaft("left", "a", "b", &keys(1.0, 0.02, "cubic = 0.5"))
            .shaft("right", "b", "c", &keys(1.5, 0.01, ""))
            .torque("drive", "a", "amplitude = 0.1")
            .0;
        assert_the_same(&text, &HarmonicSet::odd(5));
    }
}

// Source: what a lane cannot hold, by hand: pieces that orbits leave at phases of their own, friction,
// many groups.
#[test]
fn other_lines_are_taken_orbit_by_orbit() {
    let refused = |text: &str| {
        let equations = equations_of(text);
        let nonlinear: Vec<usize> = (0..equations.connections.len()).collect();
        let variational = Variational::new(&equations, &nonlinear);
        variational.multipliers_of_all(&equations, &[]).is_none()
    };
    assert!(refused(&super::lines::chain(10, |_| true)));
    assert!(!refused(&super::lines::chain(2, |_| true)));
    let gap = super::lines::held(&keys(1.0, 0.05, "clearance = 0.2"), "amplitude = 0.1");
    assert!(refused(&gap));
}
