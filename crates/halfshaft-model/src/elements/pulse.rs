//! A torque that acts once.

use std::f64::consts::PI;

use serde::Serialize;

use crate::format::{CheckedTable, KeySpec, TableSpec, ValueSpec};
use crate::units::{QuantityKind, Sign};

/// How a pulse runs over time, with `u = (t - start) / duration` and `p` the peak.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum PulseShape {
    /// `p sin(π u)` for 0 < u < 1, zero outside.
    HalfSine,
    /// `p` for 0 < u < 1, zero outside.
    Rectangle,
    /// `p u` for 0 < u < 1 and `p` ever after: a tip-in that stays.
    Ramp,
    /// All at once: an angular impulse at the start.
    Impulse,
}

/// A torque pulse.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Pulse {
    /// How it runs over time.
    pub shape: PulseShape,
    /// Peak torque, N·m; zero for an impulse.
    pub peak_nm: f64,
    /// Angular impulse, N·m·s; zero for the other shapes, whose peak says it.
    pub impulse_nm_s: f64,
    /// When it begins, s.
    pub start_s: f64,
    /// How long it takes, s; zero for an impulse.
    pub duration_s: f64,
}

const SHAPES: &[&str] = &["half-sine", "rectangle", "ramp", "impulse"];

/// Keys of `pulse = { ... }`.
pub static PULSE: TableSpec = TableSpec {
    name: "pulse",
    doc: "A torque that acts once. half-sine: peak · sin(π u); rectangle: peak; ramp: peak · u, \
          then the peak ever after; with u = (time - start) / duration. impulse: all at once. Its \
          numbers have the addresses `<name of the torque>.pulse.peak` and so on.",
    keys: &[
        KeySpec::new("shape", ValueSpec::Choice(SHAPES), "How it runs over time.").required(),
        KeySpec::new(
            "peak",
            ValueSpec::Quantity(QuantityKind::Torque, Sign::Any),
            "Peak torque, for all shapes but impulse.",
        ),
        KeySpec::new(
            "impulse",
            ValueSpec::Quantity(QuantityKind::Impulse, Sign::Any),
            "Angular impulse, for the shape impulse.",
        ),
        KeySpec::new(
            "start",
            ValueSpec::Quantity(QuantityKind::Time, Sign::NonNegative),
            "When it begins. Default 0.",
        ),
        KeySpec::new(
            "duration",
            ValueSpec::Quantity(QuantityKind::Time, Sign::Positive),
            "How long it takes, for all shapes but impulse.",
        ),
    ],
};

impl Pulse {
    /// Keys that the shape needs and that it cannot use.
    pub(crate) fn needs(shape: &str) -> (&'static [&'static str], &'static [&'static str]) {
        if shape == "impulse" {
            (&["impulse"], &["peak", "duration"])
        } else {
            (&["peak", "duration"], &["impulse"])
        }
    }

    pub(crate) fn read(table: &CheckedTable) -> Self {
        let shape = match table.word("shape") {
            Some("rectangle") => PulseShape::Rectangle,
            Some("ramp") => PulseShape::Ramp,
            Some("impulse") => PulseShape::Impulse,
            _ => PulseShape::HalfSine,
        };
        let impulse = shape == PulseShape::Impulse;
        let of = |key, has: bool| if has { table.number_or_stand_in(key) } else { 0.0 };
        Self {
            shape,
            peak_nm: of("peak", !impulse),
            impulse_nm_s: of("impulse", impulse),
            start_s: table.number_or("start", 0.0),
            duration_s: of("duration", !impulse),
        }
    }

    /// Torque at time `t`, N·m. An impulse has none: it changes the speed at its start.
    pub fn torque(&self, t: f64) -> f64 {
        let u = (t - self.start_s) / self.duration_s;
        match self.shape {
            PulseShape::Impulse => 0.0,
            PulseShape::HalfSine if u > 0.0 && u < 1.0 => self.peak_nm * (PI * u).sin(),
            PulseShape::Rectangle if u > 0.0 && u < 1.0 => self.peak_nm,
            PulseShape::Ramp if u > 0.0 => self.peak_nm * u.min(1.0),
            _ => 0.0,
        }
    }

    /// Time integral of the torque over the pulse proper, N·m·s (for a ramp, its rise).
    pub fn angular_impulse(&self) -> f64 {
        match self.shape {
            PulseShape::Impulse => self.impulse_nm_s,
            PulseShape::HalfSine => self.peak_nm * self.duration_s * 2.0 / PI,
            PulseShape::Rectangle => self.peak_nm * self.duration_s,
            PulseShape::Ramp => self.peak_nm * self.duration_s / 2.0,
        }
    }

    /// When the pulse has run its course, s.
    pub fn end_s(&self) -> f64 {
        self.start_s + self.duration_s
    }

    /// Torque that stays after the end, N·m.
    pub fn final_torque(&self) -> f64 {
        if self.shape == PulseShape::Ramp { self.peak_nm } else { 0.0 }
    }

    /// The numeric value behind a key of the pulse.
    pub fn parameter_mut(&mut self, key: &str) -> Option<&mut f64> {
        match (key, self.shape) {
            ("start", _) => Some(&mut self.start_s),
            ("impulse", PulseShape::Impulse) => Some(&mut self.impulse_nm_s),
            (_, PulseShape::Impulse) => None,
            ("peak", _) => Some(&mut self.peak_nm),
            ("duration", _) => Some(&mut self.duration_s),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    // Source: the integral by Simpson's rule on a fine grid against the closed form.
    #[test]
    fn the_angular_impulse_is_the_integral_of_the_torque() {
        for shape in [PulseShape::HalfSine, PulseShape::Rectangle, PulseShape::Ramp] {
            let pulse =
                Pulse { shape, peak_nm: -500.0, impulse_nm_s: 0.0, start_s: 0.1, duration_s: 0.02 };
            let n = 2000;
            let h = pulse.duration_s / f64::from(n);
            let sum: f64 =
                (0..n).map(|i| pulse.torque(pulse.start_s + (f64::from(i) + 0.5) * h) * h).sum();
            assert!((sum - pulse.angular_impulse()).abs() < 1e-6 * sum.abs(), "{shape:?}");
            assert_eq!(pulse.torque(0.0), 0.0);
            assert_eq!(pulse.torque(1.0), pulse.final_torque());
        }
    }
}
