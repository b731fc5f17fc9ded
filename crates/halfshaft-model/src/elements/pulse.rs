//! A torque that acts once.

use std::f64::consts::PI;

use serde::Serialize;

use crate::format::{CheckedTable, KeySpec, TableSpec, ValueSpec, words};
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

impl PulseShape {
    /// All shapes with their names.
    pub const ALL: [(&'static str, Self); 4] = [
        ("half-sine", Self::HalfSine),
        ("rectangle", Self::Rectangle),
        ("ramp", Self::Ramp),
        ("impulse", Self::Impulse),
    ];

    /// Name of the shape.
    pub fn name(self) -> &'static str {
        Self::ALL.iter().find(|(_, shape)| *shape == self).map_or("", |(name, _)| name)
    }

    /// The shape of that name.
    pub(crate) fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|(known, _)| *known == name).map(|(_, shape)| shape)
    }

    /// Keys that the shape needs and that it cannot use.
    pub(crate) fn needs(self) -> (&'static [&'static str], &'static [&'static str]) {
        if self == Self::Impulse {
            (&["impulse"], &["peak", "duration"])
        } else {
            (&["peak", "duration"], &["impulse"])
        }
    }
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

const SHAPES: [&str; PulseShape::ALL.len()] = words(&PulseShape::ALL);

/// Keys of `pulse = { ... }`.
pub static PULSE: TableSpec = TableSpec {
    name: "pulse",
    doc: "A torque that acts once. half-sine: peak · sin(π u); rectangle: peak; ramp: peak · u, \
          then the peak ever after; with u = (time - start) / duration. impulse: all at once. Its \
          numbers have the addresses `<name of the torque>.pulse.peak` and so on.",
    keys: &[
        KeySpec::new("shape", ValueSpec::Choice(&SHAPES), "How it runs over time.").required(),
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
    pub(crate) fn read(table: &CheckedTable) -> Self {
        // An unknown shape is an error of its own; meanwhile any shape stands in.
        let shape = table.word("shape").and_then(PulseShape::named).unwrap_or(PulseShape::HalfSine);
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

    // Source: the shapes as the file format describes them, summed up by the midpoint rule.
    #[test]
    fn the_angular_impulse_is_the_integral_of_the_torque() {
        for (_, shape) in PulseShape::ALL {
            let law = |u: f64| match shape {
                PulseShape::HalfSine => (PI * u).sin(),
                PulseShape::Rectangle => 1.0,
                PulseShape::Ramp => u,
                PulseShape::Impulse => 0.0,
            };
            let pulse =
                Pulse { shape, peak_nm: -500.0, impulse_nm_s: 0.0, start_s: 0.1, duration_s: 0.02 };
            let n = 2000;
            let mean: f64 =
                (0..n).map(|i| law((f64::from(i) + 0.5) / f64::from(n)) / f64::from(n)).sum();
            let sum = pulse.peak_nm * mean * pulse.duration_s;
            assert!((sum - pulse.angular_impulse()).abs() <= 1e-6 * sum.abs(), "{shape:?}");
        }
    }

    // Source: the names that serde gives the shapes, from which the digest is made.
    #[test]
    fn the_names_of_the_shapes_are_those_in_files() {
        for (name, shape) in PulseShape::ALL {
            assert_eq!(serde_json::to_value(shape).expect("plain data"), name);
            assert_eq!((PulseShape::named(name), shape.name()), (Some(shape), name));
        }
    }
}
