//! The kinds of quantity that the model file and the flags ask for.

use super::dimension::Dimension;

/// What a number means: decides its dimension, its SI unit and the units to suggest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum QuantityKind {
    /// Mass moment of inertia, kg·m².
    Inertia,
    /// Torsional stiffness of the given degree: torque per angle to that power, N·m/rad^n.
    Stiffness(u8),
    /// Torsional damping, N·m·s/rad.
    Damping,
    /// Torque, N·m.
    Torque,
    /// Angle, rad.
    Angle,
    /// Angular speed, rad/s; Hz and rpm count revolutions.
    Speed,
    /// Rate at which an angular speed moves, rad/s².
    Acceleration,
    /// Time, s.
    Time,
    /// Angular impulse, N·m·s.
    Impulse,
    /// Length, m.
    Length,
    /// Mass, kg.
    Mass,
    /// Pressure or elastic modulus, Pa.
    Pressure,
    /// Mass per volume, kg/m³.
    Density,
    /// A pure number such as a ratio or an order.
    Number,
}

/// Which signs a quantity may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sign {
    /// Any finite value.
    Any,
    /// Any finite value but zero.
    NonZero,
    /// Zero or more.
    NonNegative,
    /// More than zero.
    Positive,
}

impl Sign {
    /// Whether the finite `value` has an allowed sign.
    pub fn allows(self, value: f64) -> bool {
        match self {
            Self::Any => true,
            Self::NonZero => value != 0.0,
            Self::NonNegative => value >= 0.0,
            Self::Positive => value > 0.0,
        }
    }

    /// Whether every finite value between two is allowed.
    pub fn allows_range(self, from: f64, to: f64) -> bool {
        let crosses_zero = from.min(to) <= 0.0 && from.max(to) >= 0.0;
        self.allows(from) && self.allows(to) && !(self == Self::NonZero && crosses_zero)
    }

    /// What to write in place of a `value` whose sign is not allowed.
    pub fn advice(self, value: f64) -> Option<&'static str> {
        let negative = value < 0.0 && !self.allows(value);
        negative.then_some("leave the minus sign out")
    }

    /// The rule in words, to follow "must".
    pub fn rule(self) -> &'static str {
        match self {
            Self::Any => "be finite",
            Self::NonZero => "not be zero",
            Self::NonNegative => "not be negative",
            Self::Positive => "be more than zero",
        }
    }
}

impl QuantityKind {
    /// The dimension that a unit must have.
    pub fn dimension(self) -> Dimension {
        match self {
            Self::Inertia => Dimension::new(2, 1, 0, 0),
            Self::Stiffness(degree) => {
                Dimension::TORQUE - Dimension::ANGLE * i8::try_from(degree).unwrap_or(i8::MAX)
            }
            Self::Damping => Dimension::new(2, 1, -1, -1),
            Self::Torque => Dimension::TORQUE,
            Self::Angle => Dimension::ANGLE,
            Self::Speed => Dimension::SPEED,
            Self::Acceleration => Dimension::SPEED - Dimension::TIME,
            Self::Time => Dimension::TIME,
            Self::Impulse => Dimension::new(2, 1, -1, 0),
            Self::Length => Dimension::LENGTH,
            Self::Mass => Dimension::MASS,
            Self::Pressure => Dimension::PRESSURE,
            Self::Density => Dimension::new(-3, 1, 0, 0),
            Self::Number => Dimension::NONE,
        }
    }

    /// Symbol of the SI unit in which values are held.
    pub fn si_unit(self) -> &'static str {
        match self {
            Self::Inertia => "kg·m²",
            Self::Stiffness(1) => "N·m/rad",
            Self::Stiffness(2) => "N·m/rad²",
            Self::Stiffness(3) => "N·m/rad³",
            Self::Stiffness(5) => "N·m/rad⁵",
            Self::Stiffness(7) => "N·m/rad⁷",
            Self::Stiffness(_) => "N·m/radⁿ",
            Self::Damping => "N·m·s/rad",
            Self::Torque => "N·m",
            Self::Angle => "rad",
            Self::Speed => "rad/s",
            Self::Acceleration => "rad/s²",
            Self::Time => "s",
            Self::Impulse => "N·m·s",
            Self::Length => "m",
            Self::Mass => "kg",
            Self::Pressure => "Pa",
            Self::Density => "kg/m³",
            Self::Number => "1",
        }
    }

    /// Name of the quantity with its article.
    pub fn name(self) -> &'static str {
        match self {
            Self::Inertia => "a moment of inertia",
            Self::Stiffness(1) => "a torsional stiffness",
            Self::Stiffness(_) => "a torque per power of the angle",
            Self::Damping => "a torsional damping",
            Self::Torque => "a torque",
            Self::Angle => "an angle",
            Self::Speed => "an angular speed",
            Self::Acceleration => "a rate of speed",
            Self::Time => "a time",
            Self::Impulse => "an angular impulse",
            Self::Length => "a length",
            Self::Mass => "a mass",
            Self::Pressure => "a pressure",
            Self::Density => "a density",
            Self::Number => "a pure number",
        }
    }

    /// Units to suggest, the SI unit first.
    pub fn examples(self) -> &'static [&'static str] {
        match self {
            Self::Inertia => &["kg·m²", "kg·cm²", "g·cm²"],
            Self::Stiffness(1) => &["N·m/rad", "N·m/deg", "kN·m/rad"],
            Self::Stiffness(2) => &["N·m/rad²", "N·m/deg²"],
            Self::Stiffness(3) => &["N·m/rad³", "N·m/deg³"],
            Self::Stiffness(5) => &["N·m/rad⁵", "N·m/deg⁵"],
            Self::Stiffness(_) => &["N·m/rad⁷", "N·m/deg⁷"],
            Self::Damping => &["N·m·s/rad", "N·m·s/deg"],
            Self::Torque => &["N·m", "kN·m", "lbf·ft"],
            Self::Angle => &["rad", "deg", "rev"],
            Self::Speed => &["rad/s", "rpm", "Hz"],
            Self::Acceleration => &["rad/s²", "rpm/s", "Hz/s"],
            Self::Time => &["s", "ms", "min", "h"],
            Self::Impulse => &["N·m·s"],
            Self::Length => &["m", "mm", "in"],
            Self::Mass => &["kg", "g", "lb"],
            Self::Pressure => &["Pa", "bar", "MPa", "GPa"],
            Self::Density => &["kg/m³", "g/cm³"],
            Self::Number => &["no unit"],
        }
    }
}
