//! Harmonics and extremes of a periodic signal from uniform samples of one period.
//!
//! The samples are `x_k = x(2π k / N)`, `k = 0 .. N-1`; times are given as the phase `θ` of the
//! period in radians. Between the samples stands the trigonometric polynomial of lowest degree
//! through them, which is the signal itself if that has no harmonic of order `N/2` or above.
//! Sums are plain ones, `O(N)` for one harmonic and `O(N²)` for all.

use std::f64::consts::TAU;

use crate::complex::Complex;
use crate::error::{Error, all_finite};

/// One harmonic, `modulus cos(n θ + phase)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Harmonic {
    /// The order `n`.
    pub order: usize,
    /// The amplitude, not negative. For order 0 the absolute mean.
    pub modulus: f64,
    /// The phase in (-π, π] radians.
    pub phase: f64,
}

/// The mean of the samples: the harmonic of order zero with its sign.
///
/// # Errors
///
/// [`Error::TooFewSamples`] without samples, [`Error::NonFinite`] for samples that are not finite.
pub fn mean(samples: &[f64]) -> Result<f64, Error> {
    check(samples, 0)?;
    Ok(samples.iter().sum::<f64>() / samples.len() as f64)
}

/// The harmonic of the given order.
///
/// # Errors
///
/// [`Error::TooFewSamples`] unless there are at least `2 order + 1` samples, [`Error::NonFinite`]
/// for samples that are not finite.
pub fn harmonic(samples: &[f64], order: usize) -> Result<Harmonic, Error> {
    check(samples, order)?;
    let coefficient = coefficient(samples, order, &unit_circle(samples.len()));
    Ok(Harmonic { order, modulus: coefficient.modulus(), phase: coefficient.argument() })
}

/// A local extreme of a periodic signal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extreme {
    /// Where in the period, in [0, 2π).
    pub phase: f64,
    /// The signal there.
    pub value: f64,
}

/// The greatest value of the trigonometric polynomial through the samples.
///
/// Every sample that is not below its neighbours and not clearly below the best is polished by
/// Newton's method on the slope.
///
/// # Errors
///
/// Those of [`mean`].
pub fn maximum(samples: &[f64]) -> Result<Extreme, Error> {
    check(samples, 0)?;
    Ok(Interpolant::new(samples).maximum(samples, 1.0))
}

/// The least value of the trigonometric polynomial through the samples; see [`maximum`].
///
/// # Errors
///
/// Those of [`mean`].
pub fn minimum(samples: &[f64]) -> Result<Extreme, Error> {
    check(samples, 0)?;
    Ok(Interpolant::new(samples).maximum(samples, -1.0))
}

/// Half of the difference between [`maximum`] and [`minimum`]: the amplitude as one reads it off a
/// time history.
///
/// # Errors
///
/// Those of [`mean`].
pub fn half_peak_to_peak(samples: &[f64]) -> Result<f64, Error> {
    check(samples, 0)?;
    let interpolant = Interpolant::new(samples);
    let (top, bottom) = (interpolant.maximum(samples, 1.0), interpolant.maximum(samples, -1.0));
    Ok(0.5 * (top.value - bottom.value))
}

fn check(samples: &[f64], order: usize) -> Result<(), Error> {
    let needed = 2 * order + 1;
    if samples.len() < needed {
        return Err(Error::TooFewSamples { harmonic: order, needed, samples: samples.len() });
    }
    all_finite("sample", samples)
}

/// `exp(2π i k / N)` for all `k`.
fn unit_circle(count: usize) -> Vec<Complex> {
    (0..count).map(|k| Complex::from_polar(1.0, TAU * k as f64 / count as f64)).collect()
}

/// The complex amplitude `a` of `Re(a exp(i n θ))` in the signal.
fn coefficient(samples: &[f64], order: usize, circle: &[Complex]) -> Complex {
    let count = samples.len();
    let mut sum = Complex::default();
    let mut place = 0;
    for &sample in samples {
        // exp(-i n θ_k), the index kept below N.
        sum = sum + circle[place].conjugate().scaled(sample);
        place = (place + order) % count;
    }
    // The mean, and the highest order of an even number of samples, appear only once.
    let once = order == 0 || 2 * order == count;
    sum.scaled(if once { 1.0 } else { 2.0 } / count as f64)
}

/// How far below the best estimate a local maximum may be, as a share of the whole range, and still
/// be polished.
const CANDIDATE_MARGIN: f64 = 0.1;
/// Newton steps for one extreme; convergence is quadratic from a start within half a sample.
const POLISHING_STEPS: usize = 12;

/// The trigonometric polynomial through the samples.
struct Interpolant {
    /// Complex amplitudes by order.
    amplitudes: Vec<Complex>,
}

impl Interpolant {
    fn new(samples: &[f64]) -> Self {
        let circle = unit_circle(samples.len());
        let amplitudes =
            (0..=samples.len() / 2).map(|order| coefficient(samples, order, &circle)).collect();
        Self { amplitudes }
    }

    /// Value, first and second derivative at `phase`.
    fn evaluate(&self, phase: f64) -> [f64; 3] {
        let turn = Complex::from_polar(1.0, phase);
        let mut rotation = Complex::from(1.0);
        let mut sums = [0.0; 3];
        for (order, &amplitude) in self.amplitudes.iter().enumerate() {
            let (n, term) = (order as f64, amplitude * rotation);
            sums[0] += term.re;
            sums[1] -= n * term.im;
            sums[2] -= n * n * term.re;
            rotation = rotation * turn;
        }
        sums
    }

    /// The greatest value of `sign x(θ)`, returned with the sign of the signal.
    fn maximum(&self, samples: &[f64], sign: f64) -> Extreme {
        let count = samples.len();
        let spacing = TAU / count as f64;
        let around = |k: usize| {
            [(k + count - 1) % count, k, (k + 1) % count].map(|place| sign * samples[place])
        };
        let estimate = |k: usize| parabola_top(around(k));
        let (mut best, mut lowest) = (0, f64::INFINITY);
        for k in 0..count {
            lowest = lowest.min(sign * samples[k]);
            if sign * samples[k] > sign * samples[best] {
                best = k;
            }
        }
        let top = estimate(best).1;
        let margin = CANDIDATE_MARGIN * (top - lowest);
        let mut result = Extreme { phase: spacing * best as f64, value: samples[best] };
        for k in 0..count {
            let [before, here, after] = around(k);
            let (offset, height) = estimate(k);
            if here >= before && here >= after && height >= top - margin {
                let found = self.polished(spacing * (k as f64 + offset), spacing);
                if sign * found.value > sign * result.value {
                    result = found;
                }
            }
        }
        result
    }

    /// The stationary point nearest to `start`, no further away than `reach`.
    fn polished(&self, start: f64, reach: f64) -> Extreme {
        let mut phase = start;
        for _ in 0..POLISHING_STEPS {
            let [_, slope, curvature] = self.evaluate(phase);
            let next = phase - slope / curvature;
            let within = (next - start).abs() <= reach;
            if !within {
                break;
            }
            let step = (next - phase).abs();
            phase = next;
            if step <= f64::EPSILON * TAU {
                break;
            }
        }
        let value = self.evaluate(phase)[0];
        Extreme { phase: phase.rem_euclid(TAU), value }
    }
}

/// Offset in samples and height of the parabola through three neighbours with the middle on top.
fn parabola_top([before, here, after]: [f64; 3]) -> (f64, f64) {
    let (difference, bend) = (after - before, before - 2.0 * here + after);
    if bend < 0.0 {
        (-0.5 * difference / bend, here - 0.125 * difference * difference / bend)
    } else {
        (0.0, here)
    }
}
