//! Special points of lines with kinks, relocated by shooting.
//!
//! Where a law has kinks harmonics converge algebraically only, so that what they locate is known to
//! the tolerance of the waveform. From there the orbit is followed as it moves: along the branch of
//! exact orbits a test passes through zero, and the secant method finds it.

use halfshaft_numerics::Complex;
use halfshaft_results::SpecialKind;

use super::grazing::Touch;
use super::line::Line;
use super::orbits::{coefficients_of, state_of};
use super::special::Special;
use super::stability::Stability;
use super::tracer::{MOST_HARMONICS, Sample, refit};
use crate::shooting::{Lost, Orbit, Plane, Shooter, Turn, length};

/// First step of the secant method along the branch, relative.
const FIRST_STEP: f64 = 1e-6;
/// Steps at most.
const MOST_STEPS: usize = 25;
/// A step below this, relative, moves nothing.
const SETTLED: f64 = 1e-13;
/// Found points are moved by this part of the distance of their samples at most; further is another.
const FARTHEST: f64 = 1.0;

/// Branch of exact orbits near a special point: tangent from one of them.
struct Path {
    start: Orbit,
    along: Vec<f64>,
    along_frequency: f64,
    size: f64,
}

/// Relocates a special point between two samples; leaves it as it is where no orbit is found.
pub(super) fn refine(line: &Line, base: f64, pair: (&Sample, &Sample), special: &mut Special) {
    let mirrored = special.sample.set.is_odd();
    let mut shooter = Shooter::new(&line.equations, base, special.sample.p, mirrored);
    let Ok(Some(found)) = locate(line, base, pair, special, &mut shooter) else { return };
    let (orbit, moved) = found;
    let Ok(multipliers) = orbit.multipliers() else { return };
    let highest = (2 * special.sample.set.highest()).clamp(64, MOST_HARMONICS);
    let set = special.sample.set.up_to(highest);
    let Ok(u) = coefficients_of(line, base, &mut shooter, &orbit, &set) else { return };
    let sample = &mut special.sample;
    sample.tangent = refit(&sample.set, &set, 1, &sample.tangent);
    sample.set = set;
    sample.u = u;
    sample.p = orbit.frequency;
    special.stability = Some(Stability::of(multipliers, mirrored));
    special.precision = moved.max(f64::EPSILON);
    special.located = true;
}

/// The orbit at the special point, and how far the speed moved last, relative.
fn locate(
    line: &Line,
    base: f64,
    (from, to): (&Sample, &Sample),
    special: &Special,
    shooter: &mut Shooter<'_>,
) -> Result<Option<(Orbit, f64)>, Lost> {
    let coordinates = shooter.coordinates();
    let reference = shooter.reference();
    let state = |sample: &Sample| state_of(line, base, sample, &coordinates);
    let (a, b) = (state(from), state(to));
    let chord: Vec<f64> = b.iter().zip(&a).map(|(b, a)| b - a).collect();
    let chord_frequency = (to.p - from.p) / reference;
    let farthest = FARTHEST * length(&chord).hypot(chord_frequency);
    if farthest == 0.0 {
        return Ok(None);
    }
    let row: Vec<f64> = chord.iter().map(|x| x / farthest).collect();
    let corner = chord_frequency / farthest;
    let guess = state(&special.sample);
    let held: f64 = row.iter().zip(&guess).map(|(r, x)| r * x).sum();
    let target = held + corner * special.sample.p / reference;
    let plane = Plane { row: &row, corner, target };
    let start = shooter.correct(&guess, special.sample.p, &plane)?;
    let (along, along_frequency) = shooter.tangent(&start, &row, corner)?;
    let size = length(&start.state).max(1e-3 * along_frequency.abs());
    let path = Path { start, along, along_frequency, size };
    let test = |shooter: &mut Shooter<'_>, orbit: &Orbit| test(shooter, orbit, &path, special);
    secant(shooter, &path, farthest, test)
}

impl Path {
    /// The orbit at a distance along the tangent.
    fn at(&self, shooter: &mut Shooter<'_>, s: f64, near: &Orbit) -> Result<Orbit, Lost> {
        let reference = shooter.reference();
        let along = |orbit: &Orbit| {
            let held: f64 = self.along.iter().zip(&orbit.state).map(|(r, x)| r * x).sum();
            held + self.along_frequency * orbit.frequency / reference
        };
        let target = along(&self.start) + s;
        let ahead = target - along(near);
        let guess: Vec<f64> =
            near.state.iter().zip(&self.along).map(|(x, t)| x + ahead * t).collect();
        let frequency = near.frequency + ahead * self.along_frequency * reference;
        let plane = Plane { row: &self.along, corner: self.along_frequency, target };
        shooter.correct(&guess, frequency, &plane)
    }
}

/// The secant method along the path.
fn secant(
    shooter: &mut Shooter<'_>,
    path: &Path,
    farthest: f64,
    test: impl Fn(&mut Shooter<'_>, &Orbit) -> Result<f64, Lost>,
) -> Result<Option<(Orbit, f64)>, Lost> {
    let (mut s_before, mut s) = (0.0, FIRST_STEP * path.size);
    let mut value_before = test(shooter, &path.start)?;
    let mut near = path.start.clone();
    if value_before == 0.0 {
        return Ok(Some((near, 0.0)));
    }
    for _ in 0..MOST_STEPS {
        let orbit = path.at(shooter, s, &near)?;
        let value = test(shooter, &orbit)?;
        let moved = (orbit.frequency - near.frequency).abs() / orbit.frequency;
        let step = -value * (s - s_before) / (value - value_before);
        let settled = step.abs() <= SETTLED * path.size;
        let stalled =
            value == value_before || (value.abs() >= value_before.abs() && value.abs() < 1e-11);
        if settled || stalled || value == 0.0 {
            return Ok(Some((orbit, moved)));
        }
        if !step.is_finite() || (s + step).abs() > farthest {
            return Ok(None);
        }
        (s_before, value_before) = (s, value);
        s += step;
        near = orbit;
    }
    Ok(None)
}

/// A number that passes through zero at the special point.
fn test(
    shooter: &mut Shooter<'_>,
    orbit: &Orbit,
    path: &Path,
    special: &Special,
) -> Result<f64, Lost> {
    let sign = shooter.sign();
    Ok(match special.kind {
        SpecialKind::Fold => shooter.tangent(orbit, &path.along, path.along_frequency)?.1,
        // For a mirrored orbit: the multiplier of half a period that breaks the symmetry.
        SpecialKind::BranchPoint => distance_from(&orbit.multipliers()?, -sign),
        SpecialKind::PeriodDoubling => distance_from(&orbit.multipliers()?, -1.0),
        SpecialKind::NeimarkSacker => {
            let multipliers = orbit.multipliers()?;
            let pairs = multipliers.iter().filter(|m| m.im > 0.0).map(|m| m.modulus() - 1.0);
            pairs.reduce(|a, b| if b.abs() < a.abs() { b } else { a }).unwrap_or(f64::NAN)
        }
        SpecialKind::GrazingContact => {
            let Some(touch) = special.touch else { return Ok(f64::NAN) };
            let turns = turns_of(shooter, orbit, &touch)?;
            let away = turns.iter().map(|turn| turn.twist - touch.level);
            away.reduce(|a, b| if b.abs() < a.abs() { b } else { a }).unwrap_or(f64::NAN)
        }
        _ => f64::NAN,
    })
}

fn turns_of(shooter: &mut Shooter<'_>, orbit: &Orbit, touch: &Touch) -> Result<Vec<Turn>, Lost> {
    let mut turns = Vec::new();
    shooter.watch(orbit, |step| step.turns(touch.connection, &mut turns))?;
    Ok(turns)
}

/// `Π (μ - z)` for a real `z`, each factor over its own size.
fn distance_from(multipliers: &[Complex], z: f64) -> f64 {
    let product = multipliers.iter().fold(Complex::from(1.0), |product, m| {
        product * (*m - Complex::from(z)).scaled(1.0 / (1.0 + m.modulus()))
    });
    product.re
}
