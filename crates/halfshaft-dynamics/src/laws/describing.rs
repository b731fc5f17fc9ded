//! Describing functions: what a law does on average over a harmonic swing of the twist.
//!
//! For `x = m + A cos φ` a law gives the mean torque `⟨T⟩` and the first harmonic
//! `2 ⟨T cos φ⟩ cos φ`, with `⟨·⟩` the average over `φ`; nothing appears with `sin φ`, because a law
//! is one torque for each twist. The gain is the first harmonic over the amplitude. Integration by
//! parts gives it without a division, `2 ⟨T' sin² φ⟩`, so that it has its limit `T'(m)` at
//! amplitude zero. Derivatives, with `T'` the tangent stiffness:
//!
//! ```text
//! ∂⟨T⟩/∂m = ⟨T'⟩               ∂⟨T⟩/∂A = ⟨T' cos φ⟩
//! ∂gain/∂m = 2 ⟨T' cos φ⟩ / A   ∂gain/∂A = 2 ⟨T' cos 2φ⟩ / A
//! ```

use std::f64::consts::PI;

use super::quadrature::for_points;

/// Average effect of a law over the swing `x = mean + amplitude cos φ`, with derivatives.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DescribingFunction {
    /// Mean torque, N·m.
    pub mean_torque: f64,
    /// First-harmonic torque, in phase with the twist, over the amplitude, N·m/rad.
    pub gain: f64,
    /// Derivative of the mean torque by the mean twist, N·m/rad.
    pub mean_by_mean: f64,
    /// Derivative of the mean torque by the amplitude, N·m/rad.
    pub mean_by_amplitude: f64,
    /// Derivative of the gain by the mean twist, N·m/rad².
    pub gain_by_mean: f64,
    /// Derivative of the gain by the amplitude, N·m/rad².
    pub gain_by_amplitude: f64,
}

impl DescribingFunction {
    /// That of a torque which is the same at all twists.
    pub(super) fn constant(torque: f64) -> Self {
        Self { mean_torque: torque, ..Self::default() }
    }

    /// Of a law that is smooth between `breaks` (ascending), by quadrature from break to break.
    ///
    /// The amplitude must be more than zero; between the breaks the law may have terms up to the
    /// seventh power of the twist.
    pub(super) fn by_parts(
        mean: f64,
        amplitude: f64,
        breaks: &[f64],
        law: impl Fn(f64) -> (f64, f64),
    ) -> Self {
        let mut sums = Sums::default();
        // The twist falls while φ runs from 0 to π.
        let mut from = 0.0;
        for twist in breaks.iter().rev() {
            let cosine = (twist - mean) / amplitude;
            if cosine.abs() < 1.0 {
                let to = cosine.acos();
                sums.add(mean, amplitude, (from, to), &law);
                from = to;
            }
        }
        sums.add(mean, amplitude, (from, PI), &law);
        let [torque, stiffness, cosine, sine_squared, second] = sums.values.map(|sum| sum / PI);
        Self {
            mean_torque: torque,
            gain: 2.0 * sine_squared,
            mean_by_mean: stiffness,
            mean_by_amplitude: cosine,
            gain_by_mean: 2.0 * cosine / amplitude,
            gain_by_amplitude: 2.0 * second / amplitude,
        }
    }

    /// Adds a ramp `change · max(x - kink, 0)`, exactly.
    ///
    /// With `cos φ0 = (kink - mean) / amplitude` the ramp acts for `φ < φ0`, and the integrals are
    /// elementary. The amplitude must not be zero.
    pub(super) fn add_ramp_above(&mut self, kink: f64, change: f64, mean: f64, amplitude: f64) {
        let cosine = (kink - mean) / amplitude;
        if cosine >= 1.0 {
            return;
        }
        if cosine <= -1.0 {
            self.mean_torque += change * (mean - kink);
            self.gain += change;
            self.mean_by_mean += change;
            return;
        }
        let angle = cosine.acos();
        let sine = ((1.0 - cosine) * (1.0 + cosine)).sqrt();
        let part = change / PI;
        self.mean_torque += part * amplitude * (sine - cosine * angle);
        self.gain += part * (angle - cosine * sine);
        self.mean_by_mean += part * angle;
        self.mean_by_amplitude += part * sine;
        self.gain_by_mean += 2.0 * part * sine / amplitude;
        self.gain_by_amplitude += 2.0 * part * sine * cosine / amplitude;
    }

    /// Adds a ramp `change · min(x - kink, 0)`: the mirror image of the other one.
    pub(super) fn add_ramp_below(&mut self, kink: f64, change: f64, mean: f64, amplitude: f64) {
        let mut mirrored = Self::default();
        mirrored.add_ramp_above(-kink, change, -mean, amplitude);
        self.mean_torque -= mirrored.mean_torque;
        self.gain += mirrored.gain;
        self.mean_by_mean += mirrored.mean_by_mean;
        self.mean_by_amplitude -= mirrored.mean_by_amplitude;
        self.gain_by_mean -= mirrored.gain_by_mean;
        self.gain_by_amplitude += mirrored.gain_by_amplitude;
    }
}

/// Integrals over φ of `T`, `T'`, `T' cos φ`, `T' sin² φ`, `T' cos 2φ`.
#[derive(Default)]
struct Sums {
    values: [f64; 5],
}

impl Sums {
    fn add(
        &mut self,
        mean: f64,
        amplitude: f64,
        (from, to): (f64, f64),
        law: &impl Fn(f64) -> (f64, f64),
    ) {
        for_points(from, to, |angle, weight| {
            let (sine, cosine) = angle.sin_cos();
            let (torque, stiffness) = law(mean + amplitude * cosine);
            let (torque, stiffness) = (weight * torque, weight * stiffness);
            self.values[0] += torque;
            self.values[1] += stiffness;
            self.values[2] += stiffness * cosine;
            self.values[3] += stiffness * sine * sine;
            self.values[4] += stiffness * (cosine - sine) * (cosine + sine);
        });
    }
}
