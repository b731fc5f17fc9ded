//! Alternating frequency-time: a law's torque along a motion given by its harmonics.
//!
//! T. M. Cameron, J. H. Griffin, "An alternating frequency/time domain method for calculating the
//! steady-state response of nonlinear dynamic systems", *J. Appl. Mech.* 56 (1989).

use halfshaft_dynamics::Connection;
use halfshaft_numerics::Complex;
use halfshaft_numerics::harmonics::{HarmonicSet, Sampler, Spectrum};

use super::kinks::Spectra;
use super::line::Line;

/// What one connection needs on the way.
#[derive(Clone, Debug, Default)]
pub(super) struct Work {
    pub(super) twist: Vec<f64>,
    pub(super) rate: Vec<f64>,
    pub(super) force: Vec<f64>,
    pub(super) samples: Vec<f64>,
    pub(super) torque: Vec<f64>,
    pub(super) slope: Vec<f64>,
    pub(super) rate_slope: Vec<f64>,
    pub(super) spectra: Spectra,
    pub(super) rate_product: Vec<f64>,
}

impl Work {
    /// Spectra by uniform samples, for laws that are smooth along the motion; `samples` hold the
    /// twist.
    pub(super) fn sample(
        &mut self,
        connection: &Connection,
        sampler: &mut Sampler,
        set: &HarmonicSet,
        jacobian: bool,
    ) {
        connection.law.evaluate(&self.samples, &mut self.torque, &mut self.slope);
        if let Some(friction) = &connection.friction {
            sampler.samples(set, &self.rate, &mut self.samples);
            for ((v, torque), slope) in
                self.samples.iter().zip(&mut self.torque).zip(&mut self.rate_slope)
            {
                *torque += friction.torque(*v);
                *slope = friction.slope(*v);
            }
        }
        sampler.spectrum(&mut self.torque, &mut self.spectra.torque);
        if jacobian {
            sampler.spectrum(&mut self.slope, &mut self.spectra.slope);
            if connection.friction.is_some() {
                sampler.spectrum(&mut self.rate_slope, &mut self.spectra.rate_slope);
            }
        }
    }
}

/// Samples a period at least, for laws with kinks.
const KINK_SAMPLES: usize = 128;

/// Samples that resolve a line's laws on a set of harmonics: exact for polynomials up to the degree
/// given by their highest power, several times the highest order for others.
pub(super) fn samples_for(line: &Line, set: &HarmonicSet) -> usize {
    let highest = set.highest().max(1);
    let least = |index: usize| {
        let connection = &line.equations.connections[index];
        let degree = connection.law.polynomial().filter(|_| connection.friction.is_none());
        match degree.map(|law| law.coefficients().iter().rposition(|k| *k != 0.0).unwrap_or(1)) {
            Some(degree) => (degree.max(3) + 1) * highest + 2,
            None => KINK_SAMPLES.max(12 * highest),
        }
    };
    let most = line.twists.iter().map(|twist| least(twist.connection)).max();
    let needed = most.unwrap_or(2 * highest + 2);
    // Lengths that transforms are fast at.
    (1..)
        .map(|power| 1_usize << power)
        .flat_map(|n| [n, n + n / 2])
        .find(|n| *n >= needed && n % 2 == 0)
        .unwrap_or(needed)
}

/// Coefficients of a connection's twist from those of all nodes.
pub(super) fn combine(twist: &super::line::NonlinearTwist, u: &[f64], m: usize, out: &mut [f64]) {
    out.fill(0.0);
    for (node, factor) in &twist.parts {
        let source = &u[node * m..(node + 1) * m];
        out.iter_mut().zip(source).for_each(|(x, q)| *x += factor * q);
    }
}

/// Coefficients of the time derivative of a series whose fundamental turns at `speed`.
pub(super) fn differentiate(set: &HarmonicSet, x: &[f64], speed: f64, out: &mut [f64]) {
    out.fill(0.0);
    for (order, place) in set.places().filter(|(order, _)| *order > 0) {
        let nu = order as f64 * speed;
        out[place] = nu * x[place + 1];
        out[place + 1] = -nu * x[place];
    }
}

/// `out += P D`, where `D` differentiates coefficients.
pub(super) fn add_rate(set: &HarmonicSet, product: &[f64], speed: f64, out: &mut [f64]) {
    let m = set.coefficients();
    for row in 0..m {
        for (order, place) in set.places().filter(|(order, _)| *order > 0) {
            let nu = order as f64 * speed;
            out[row * m + place] -= nu * product[row * m + place + 1];
            out[row * m + place + 1] += nu * product[row * m + place];
        }
    }
}

/// How much twist the orders of the torque beyond the set would make, over the vibration's size, both
/// by root mean square: there the line yields like its inertias alone.
pub(super) fn neglected(
    spectrum: &Spectrum,
    set: &HarmonicSet,
    speed: f64,
    mobility: f64,
    twist: &[f64],
) -> f64 {
    let mean = usize::from(!set.is_odd());
    let size: f64 = twist[mean..].iter().map(|x| x * x).sum::<f64>().sqrt();
    if size == 0.0 {
        return 0.0;
    }
    let beyond = spectrum.values().iter().enumerate().skip(set.highest() + 1);
    let square = |f: &Complex| f.re * f.re + f.im * f.im;
    let sum: f64 = beyond.map(|(order, f)| square(f) / (order as f64).powi(4)).sum();
    2.0 * sum.sqrt() * mobility / (speed * speed) / size
}
