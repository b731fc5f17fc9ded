//! Every stored sample recomputed: residual in the equations of motion, orbit and multipliers by
//! shooting.

use super::independent::{apart, shoot, waveform};
use super::{Traced, lines, traced};

/// How far a sample may be from the independent path.
#[derive(Clone, Copy)]
struct Bounds {
    /// Missing torque among the harmonics kept, relative.
    kept: f64,
    /// Missing torque at any phase, relative: what the harmonics left out would carry.
    pointwise: f64,
    /// Orbit by shooting, relative.
    orbit: f64,
    /// Multipliers, relative to the larger of 1 and their modulus.
    multipliers: f64,
    /// Every how manieth sample is shot.
    every: usize,
}

const SMOOTH: Bounds =
    Bounds { kept: 1e-10, pointwise: 1e-6, orbit: 1e-8, multipliers: 1e-7, every: 1 };

/// Tolerance of the waveforms.
const TOLERANCE: f64 = 1e-10;

/// A sample whose speed is this near to a fold's, relative, is at the fold.
const AT_A_FOLD: f64 = 1e-7;

/// Worst of what was seen, for messages.
#[derive(Debug, Default)]
struct Worst {
    samples: usize,
    kept: f64,
    pointwise: f64,
    orbit: f64,
    multipliers: f64,
}

#[track_caller]
fn check(found: &Traced, bounds: Bounds) -> Worst {
    let mut worst = Worst::default();
    assert!(!found.collected.branches.is_empty(), "nothing found");
    for branch in &found.collected.branches {
        for (at, (sample, stability)) in branch.samples.iter().zip(&branch.stability).enumerate() {
            let wave = waveform(found, branch, sample);
            let (pointwise, kept) = wave.residual();
            worst.samples += 1;
            worst.kept = worst.kept.max(kept);
            worst.pointwise = worst.pointwise.max(pointwise);
            if at % bounds.every != 0 {
                continue;
            }
            // At a fold the map of shooting has no isolated orbit to find: there the residual counts.
            let fold = branch.specials.iter().any(|special| {
                special.kind == halfshaft_results::SpecialKind::Fold
                    && (special.sample.p / sample.p - 1.0).abs() < AT_A_FOLD
            });
            if fold {
                continue;
            }
            let here = format!("at {} on the branch from the {}", sample.p, branch.origin);
            let shot = shoot(&wave).unwrap_or_else(|| panic!("no orbit {here}"));
            worst.orbit = worst.orbit.max(shot.difference);
            let off = apart(&stability.multipliers, &shot.orbit.multipliers);
            worst.multipliers = worst.multipliers.max(off);
            let clear = shot.orbit.multipliers.iter().all(|m| (m.modulus() - 1.0).abs() > 1e-6);
            let outside = shot.orbit.multipliers.iter().filter(|m| m.modulus() > 1.0).count();
            if clear {
                assert_eq!(outside, stability.unstable, "unstable dimension {here}");
            }
        }
    }
    let good = worst.kept < bounds.kept
        && worst.pointwise < bounds.pointwise
        && worst.orbit < bounds.orbit
        && worst.multipliers < bounds.multipliers;
    assert!(good, "{worst:?}");
    worst
}

#[test]
fn duffing_oscillators() {
    check(&traced(&lines::d1(), (0.2, 1.8), TOLERANCE), SMOOTH);
    check(&traced(&lines::d2(), (0.8, 1.3), TOLERANCE), SMOOTH);
}

#[test]
fn the_theory_driveline() {
    let resonance = 26.057_723_985_895_066;
    check(&traced(&lines::theory(15.0), (resonance - 1.5, resonance + 1.5), TOLERANCE), SMOOTH);
    check(&traced(&lines::theory(5.0), (resonance - 1.5, resonance + 1.5), TOLERANCE), SMOOTH);
}

#[test]
fn an_absorber_with_its_neimark_sacker_points() {
    check(&traced(&lines::absorber(0.11), (0.8, 1.5), TOLERANCE), SMOOTH);
}

#[test]
fn a_chain_of_ten() {
    let bounds = Bounds { every: 7, ..SMOOTH };
    check(&traced(&lines::chain(10, |_| true), (4.2, 5.2), TOLERANCE), bounds);
}

#[test]
fn mean_torques_and_quadratic_laws_in_free_lines() {
    check(&traced(&lines::free_with_mean(), (8.0, 35.0), TOLERANCE), SMOOTH);
    check(&traced(&lines::free_unbalanced(), (8.0, 35.0), TOLERANCE), SMOOTH);
    check(&traced(&lines::free_damped(), (8.0, 35.0), TOLERANCE), SMOOTH);
}

#[test]
fn several_orders_and_sources() {
    check(&traced(&lines::many_orders(), (4.0, 25.0), TOLERANCE), Bounds { every: 3, ..SMOOTH });
}

#[test]
fn gears_branches_and_elastic_meshes() {
    check(&traced(&lines::geared(), (2.0, 60.0), TOLERANCE), Bounds { every: 5, ..SMOOTH });
}

#[test]
fn loops_of_shafts() {
    check(&traced(&lines::mesh(), (2.0, 20.0), TOLERANCE), Bounds { every: 5, ..SMOOTH });
    check(&traced(&lines::full_mesh(), (2.0, 30.0), TOLERANCE), Bounds { every: 9, ..SMOOTH });
}

#[test]
fn lines_of_one_law_only() {
    // No nonlinear shaft at all: the answer is that of a linear line.
    let linear = lines::chain(4, |_| false);
    check(&traced(&linear, (5.0, 70.0), TOLERANCE), SMOOTH);
}
