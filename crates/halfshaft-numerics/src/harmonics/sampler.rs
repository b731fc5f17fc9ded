//! From coefficients to samples of one period and back, by fast Fourier transforms.

use std::sync::Arc;

use realfft::num_complex::Complex64;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};

use super::HarmonicSet;
use crate::complex::Complex;

/// Transforms between coefficients and uniform samples of one period.
#[derive(Clone)]
pub struct Sampler {
    count: usize,
    forward: Arc<dyn RealToComplex<f64>>,
    inverse: Arc<dyn ComplexToReal<f64>>,
    bins: Vec<Complex64>,
    scratch: Vec<Complex64>,
}

impl std::fmt::Debug for Sampler {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_struct("Sampler").field("count", &self.count).finish_non_exhaustive()
    }
}

/// Complex Fourier coefficients `κ_l = mean of x exp(-i l θ)`, `l = 0 ..`, of a real signal.
#[derive(Debug, Clone, Default)]
pub struct Spectrum {
    values: Vec<Complex>,
}

impl Spectrum {
    /// Mean of `x cos lθ`; negative orders are those of the positive.
    #[inline]
    pub fn cosine(&self, order: isize) -> f64 {
        self.values.get(order.unsigned_abs()).map_or(0.0, |value| value.re)
    }

    /// Mean of `x sin lθ`; odd in the order.
    #[inline]
    pub fn sine(&self, order: isize) -> f64 {
        let value = self.values.get(order.unsigned_abs()).map_or(0.0, |value| -value.im);
        if order < 0 { -value } else { value }
    }

    /// The coefficients from order 0.
    pub fn values(&self) -> &[Complex] {
        &self.values
    }

    /// Takes coefficients from order 0 that were found in another way; orders beyond are zero.
    pub fn replace(&mut self, values: impl IntoIterator<Item = Complex>) {
        self.values.clear();
        self.values.extend(values);
    }

    /// Writes the coefficients of the signal over `set`.
    pub fn coefficients(&self, set: &HarmonicSet, out: &mut [f64]) {
        for (order, place) in set.places() {
            let value = self.values.get(order).copied().unwrap_or_default();
            if order == 0 {
                out[place] = value.re;
            } else {
                out[place] = 2.0 * value.re;
                out[place + 1] = -2.0 * value.im;
            }
        }
    }
}

impl Sampler {
    /// A sampler of `count` samples a period (at least 2; rounded up to an even number).
    pub fn new(count: usize) -> Self {
        let count = count.max(2).next_multiple_of(2);
        let mut planner = RealFftPlanner::new();
        let (forward, inverse) = (planner.plan_fft_forward(count), planner.plan_fft_inverse(count));
        let length = forward.get_scratch_len().max(inverse.get_scratch_len());
        Self {
            count,
            forward,
            inverse,
            bins: vec![Complex64::default(); count / 2 + 1],
            scratch: vec![Complex64::default(); length],
        }
    }

    /// Number of samples.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Samples of the series `coefficients` over `set`, to `out` (one entry a sample). Orders of
    /// half the number of samples and above are left out.
    pub fn samples(&mut self, set: &HarmonicSet, coefficients: &[f64], out: &mut [f64]) {
        self.bins.fill(Complex64::default());
        for (order, place) in set.places() {
            if order == 0 {
                self.bins[0].re = coefficients[place];
            } else if 2 * order < self.count {
                let (a, b) = (coefficients[place], coefficients[place + 1]);
                self.bins[order] = Complex64::new(0.5 * a, -0.5 * b);
            }
        }
        // Lengths fit by construction; the first and last bin are real.
        let done = self.inverse.process_with_scratch(&mut self.bins, out, &mut self.scratch);
        debug_assert!(done.is_ok());
    }

    /// The spectrum of `samples`, whose contents are used up.
    pub fn spectrum(&mut self, samples: &mut [f64], out: &mut Spectrum) {
        let done = self.forward.process_with_scratch(samples, &mut self.bins, &mut self.scratch);
        debug_assert!(done.is_ok());
        let scale = 1.0 / self.count as f64;
        out.values.clear();
        out.values.extend(self.bins.iter().map(|z| Complex::new(scale * z.re, scale * z.im)));
    }
}
