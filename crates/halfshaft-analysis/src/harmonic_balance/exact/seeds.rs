//! Orbits to begin with.
//!
//! At a few speeds orbits are followed over the drive (the factor on all harmonic torques), with what
//! branches off, from almost nothing to well beyond 1: every passage of drive 1 is an orbit of the
//! line, stable or not, wherever the range of speeds begins. And the line is let run from several
//! states at speeds spread over the range until its motion repeats: that finds detached orbits, as
//! far as they are stable.

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_numerics::observer::Observer;

use super::super::tracer::Counted;
use super::curve::Limits;
use super::explorer::{Explorer, Guess};
use super::point::{Kind, Point};
use crate::shooting::{Shooter, length};

/// Drives at which curves over it begin.
const FIRST_DRIVES: [f64; 4] = [1e-3, 1e-5, 3e-2, 0.3];
/// Drive to which curves are followed.
const LAST_DRIVE: f64 = 20.0;
/// Drives between which branches of twice the period are followed.
const FORKS: (f64, f64) = (0.3, 3.0);
/// Points of a curve at most.
const MOST_POINTS: usize = 250;
/// Miss of the tangent on these rough curves.
const ROUGH: f64 = 0.03;

/// Orbits of drive 1 at one speed.
pub(super) fn over_drive(
    equations: &EquationsOfMotion,
    rest: &[f64],
    kind: Kind,
    frequency: f64,
    observer: &dyn Observer,
    counted: &mut Counted,
) -> Vec<Guess> {
    let limits = Limits {
        range: (0.0, LAST_DRIVE),
        miss: ROUGH,
        longest: 0.5,
        most_points: MOST_POINTS,
        most_size: f64::INFINITY,
        enough: 1e-5,
    };
    let shooter = Shooter::over_drive(equations, kind.base, frequency, kind.mirrored);
    let state = at_rest(equations, rest, &shooter);
    let mut explorer = Explorer::new(shooter, limits, kind.mirrored, false, observer);
    for drive in FIRST_DRIVES {
        let guess = Guess { kind, state: state.clone(), p: drive, origin: String::new() };
        if explorer.add(&guess) {
            break;
        }
    }
    explorer.forks = FORKS;
    explorer.branch_off();
    let mut found = Vec::new();
    for branch in &explorer.branches {
        let mut curve = explorer.curve(branch.kind);
        for pair in branch.points.windows(2) {
            let (a, b) = (&pair[0], &pair[1]);
            if (a.p() - 1.0) * (b.p() - 1.0) > 0.0 || a.p() == b.p() {
                continue;
            }
            let part = (1.0 - a.p()) / (b.p() - a.p());
            let Ok(guess) = curve.between(a, b, part) else { continue };
            let Ok(orbit) = curve.shooter.at(&guess.state, 1.0) else { continue };
            let origin = format!("response at {frequency:.6} rad/s");
            found.push(Guess { kind: branch.kind, state: orbit.state, p: frequency, origin });
        }
    }
    counted.add(explorer.counted);
    found
}

/// The line at rest: its twists, nothing else.
pub(in super::super) fn at_rest(
    equations: &EquationsOfMotion,
    rest: &[f64],
    shooter: &Shooter<'_>,
) -> Vec<f64> {
    let mut state = vec![0.0; shooter.coordinates().dimension()];
    for (x, edge) in state.iter_mut().zip(&equations.network.tree) {
        *x = rest[edge.shaft];
    }
    state
}

/// How the origin of branches begins that such motions are on.
pub(in super::super) const SETTLES: &str = "motion to which the line settles at";
/// Periods of the excitation after which a motion that does not repeat is given up.
const MOST_PERIODS: usize = 160;
/// Periods of an orbit at most.
pub(in super::super) const MOST_MULTIPLE: usize = 4;
/// Periods between looks whether the motion repeats.
const LOOK: usize = 10;
/// A motion repeats when its state comes back to this part of its size.
const REPEATS: f64 = 3e-4;

/// A guess at the orbit to which the line settles from a state.
pub(in super::super) fn settled(
    shooter: &mut Shooter<'_>,
    kind: Kind,
    start: &[f64],
    p: f64,
) -> Option<Guess> {
    let mut states = vec![start.to_vec()];
    for period in 1..=MOST_PERIODS {
        let next = shooter.after(states.last()?, p, 1.0, |_| {}).ok()?;
        if states.len() > MOST_MULTIPLE {
            states.remove(0);
        }
        states.push(next);
        if period % LOOK != 0 {
            continue;
        }
        let (last, earlier) = states.split_last()?;
        let away = |state: &Vec<f64>| -> f64 {
            length(&last.iter().zip(state).map(|(a, b)| a - b).collect::<Vec<f64>>())
        };
        let size = length(last);
        let back = (1..=MOST_MULTIPLE).find(|back| {
            earlier.len() >= *back && away(&earlier[earlier.len() - back]) < REPEATS * size
        });
        if let Some(back) = back {
            let periods = u32::try_from(back).ok()?;
            let kind = Kind { base: kind.base / f64::from(periods), periods, mirrored: false };
            let origin = format!("{SETTLES} {p:.6} rad/s");
            return Some(Guess { kind, state: last.clone(), p, origin });
        }
    }
    None
}

/// States about a point from which the line is let run: itself at other phases and sizes.
pub(in super::super) fn starts(rest: &[f64], size: f64) -> Vec<Vec<f64>> {
    let mut starts = vec![rest.to_vec()];
    for (turn, factor) in [1.0, 2.5, 4.0].into_iter().enumerate() {
        let moved = rest.iter().enumerate().map(|(k, x)| {
            let wave = (1.0 + 2.4 * turn as f64 + 1.9 * k as f64).sin();
            x + factor * size * wave
        });
        starts.push(moved.collect());
    }
    starts
}

/// Whether an orbit mirrors itself after half a period.
pub(in super::super) fn is_mirrored(shooter: &mut Shooter<'_>, state: &[f64], p: f64) -> bool {
    let after = shooter.after(state, p, 0.5, |_| {});
    after.is_ok_and(|after| {
        let sum: Vec<f64> = state.iter().zip(&after).map(|(a, b)| a + b).collect();
        length(&sum) < 1e-3 * length(state)
    })
}

/// Greatest swing of the orbits of branches.
pub(super) fn largest<'p>(points: impl Iterator<Item = &'p Point>) -> f64 {
    points.map(|point| point.size).fold(0.0, f64::max)
}
