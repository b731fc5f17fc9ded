//! Between harmonics and the motion itself: the state of a response at time 0, the harmonics of an
//! orbit.

use halfshaft_numerics::Complex;
use halfshaft_numerics::harmonics::{HarmonicSet, Sampler, Spectrum};

use super::channels::group_series;
use super::line::Line;
use super::system::{HarmonicSystem, Place};
use super::tracer::Sample;
use crate::shooting::{Coordinates, Lost, Orbit, Sampled, Shooter};

/// State at time 0 of a response over the excitation speed.
pub(super) fn state_of(
    line: &Line,
    base: f64,
    sample: &Sample,
    coordinates: &Coordinates,
) -> Vec<f64> {
    state_of_series(line, base, &sample.set, &sample.u, sample.p, coordinates)
}

/// The same of coefficients over a set at an excitation speed.
pub(super) fn state_of_series(
    line: &Line,
    base: f64,
    set: &HarmonicSet,
    u: &[f64],
    frequency: f64,
    coordinates: &Coordinates,
) -> Vec<f64> {
    let mut system = HarmonicSystem::new(line.clone(), set.clone(), base);
    let series = group_series(&mut system, u, Place { frequency, drive: 1.0 });
    state_at(line, set, &series, base * frequency, 0.0, coordinates)
}

/// The state at a phase of the fundamental (rad), which runs at `speed` (rad/s), of series of all groups.
pub(super) fn state_at(
    line: &Line,
    set: &HarmonicSet,
    series: &[f64],
    speed: f64,
    phase: f64,
    coordinates: &Coordinates,
) -> Vec<f64> {
    let (mut angles, mut speeds) = (Vec::new(), Vec::new());
    for coefficients in series.chunks_exact(set.coefficients()) {
        let (value, slope) = set.evaluate(coefficients, phase);
        angles.push(value);
        speeds.push(speed * slope);
    }
    let mut state = vec![0.0; coordinates.dimension()];
    coordinates.gather(&line.equations, &angles, &speeds, &mut state);
    state
}

/// Samples a period at least.
const LEAST_SAMPLES: usize = 512;
/// Samples a wave of the highest order: what is beyond folds back onto orders that are not asked.
const SAMPLES_PER_WAVE: usize = 8;

/// Coefficients of the kept groups along an orbit whose fundamental has order `base`.
pub(super) fn coefficients_of(
    line: &Line,
    base: f64,
    shooter: &mut Shooter<'_>,
    orbit: &Orbit,
    set: &HarmonicSet,
) -> Result<Vec<f64>, Lost> {
    let equations = &line.equations;
    let count = (SAMPLES_PER_WAVE * set.highest()).max(LEAST_SAMPLES).next_power_of_two();
    let mut sampled = Sampled::new(equations.groups(), count, shooter.period(orbit.frequency));
    shooter.watch(orbit, |step| sampled.see(step))?;
    let whole = take_whole(line, &mut sampled.angles, count);
    let mut sampler = Sampler::new(count);
    let mut spectrum = Spectrum::default();
    let m = set.coefficients();
    let mut coefficients = |samples: &mut [f64]| {
        let mut out = vec![0.0; m];
        sampler.spectrum(samples, &mut spectrum);
        spectrum.coefficients(set, &mut out);
        out
    };
    let whole = match whole {
        Some(mut samples) => Some(coefficients(&mut samples)),
        None => rigid_series(line, base, orbit.frequency, set),
    };
    let kept = &line.skeleton.kept;
    let mut u = Vec::with_capacity(kept.len() * m);
    for group in kept {
        let mut own = coefficients(&mut sampled.angles[*group]);
        if let (Some(rigid), Some(whole)) = (&equations.rigid, &whole) {
            own.iter_mut().zip(whole).for_each(|(q, s)| *q += rigid.speeds[*group] * s);
        }
        u.append(&mut own);
    }
    pin(line, set, &mut u);
    Ok(u)
}

/// Takes the angle of the whole out of the samples; gives it where its speed belongs to the state.
fn take_whole(line: &Line, angles: &mut [Vec<f64>], count: usize) -> Option<Vec<f64>> {
    let rigid = line.equations.rigid.as_ref()?;
    let mut whole = Vec::with_capacity(count);
    let mut now = vec![0.0; angles.len()];
    for at in 0..count {
        now.iter_mut().zip(angles.iter()).for_each(|(q, list)| *q = list[at]);
        let mean = rigid.mean(&now);
        for (list, r) in angles.iter_mut().zip(&rigid.speeds) {
            list[at] -= r * mean;
        }
        whole.push(mean);
    }
    (rigid.ground_damping > 0.0).then_some(whole)
}

/// Angle of a free line as a whole that only its inertia holds back.
fn rigid_series(line: &Line, base: f64, frequency: f64, set: &HarmonicSet) -> Option<Vec<f64>> {
    let equations = &line.equations;
    let rigid = equations.rigid.as_ref()?;
    let mut out = vec![0.0; set.coefficients()];
    for (order, place) in set.places().filter(|(order, _)| *order > 0) {
        let mut torque = Complex::default();
        for source in equations.excitation.sources.iter().filter(|s| s.own_frequency.is_none()) {
            let factor = rigid.speeds[source.group] * source.ratio * source.growth(frequency);
            for harmonic in &source.harmonics {
                if (harmonic.order / base - order as f64).abs() < 1e-9 * order as f64 {
                    let size = factor * harmonic.amplitude_nm;
                    torque = torque + Complex::from_polar(size, harmonic.phase_rad);
                }
            }
        }
        let nu = order as f64 * base * frequency;
        let angle = torque.scaled(-1.0 / (rigid.inertia * nu * nu));
        (out[place], out[place + 1]) = (angle.re, -angle.im);
    }
    Some(out)
}

/// Gives a free line the mean angle that harmonic balance gives it: none at the last node.
fn pin(line: &Line, set: &HarmonicSet, u: &mut [f64]) {
    let Some(rigid) = line.equations.rigid.as_ref().filter(|_| !set.is_odd()) else { return };
    let m = set.coefficients();
    let last = line.skeleton.pattern.last();
    let shift = u[last * m] / rigid.speeds[line.skeleton.kept[last]];
    for (node, group) in line.skeleton.kept.iter().enumerate() {
        u[node * m] -= shift * rigid.speeds[*group];
    }
}
