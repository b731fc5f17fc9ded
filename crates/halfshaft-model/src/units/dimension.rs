//! Exponents of length, mass, time and angle.

use std::fmt;
use std::ops::{Add, Mul, Sub};

/// The dimension of a quantity as exponents of the base units m, kg, s and rad.
///
/// Adding dimensions multiplies the quantities. The angle counts as a dimension so that
/// "N·m" and "N·m/rad" are told apart.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Dimension {
    /// Exponent of the metre.
    pub length: i8,
    /// Exponent of the kilogram.
    pub mass: i8,
    /// Exponent of the second.
    pub time: i8,
    /// Exponent of the radian.
    pub angle: i8,
}

impl Dimension {
    /// A pure number.
    pub const NONE: Self = Self::new(0, 0, 0, 0);
    /// Length, m.
    pub const LENGTH: Self = Self::new(1, 0, 0, 0);
    /// Mass, kg.
    pub const MASS: Self = Self::new(0, 1, 0, 0);
    /// Time, s.
    pub const TIME: Self = Self::new(0, 0, 1, 0);
    /// Angle, rad.
    pub const ANGLE: Self = Self::new(0, 0, 0, 1);
    /// Force, N.
    pub const FORCE: Self = Self::new(1, 1, -2, 0);
    /// Torque, N·m.
    pub const TORQUE: Self = Self::new(2, 1, -2, 0);
    /// Pressure, Pa.
    pub const PRESSURE: Self = Self::new(-1, 1, -2, 0);
    /// Power, W.
    pub const POWER: Self = Self::new(2, 1, -3, 0);
    /// Angular speed, rad/s.
    pub const SPEED: Self = Self::new(0, 0, -1, 1);

    /// The dimension m^length kg^mass s^time rad^angle.
    pub const fn new(length: i8, mass: i8, time: i8, angle: i8) -> Self {
        Self { length, mass, time, angle }
    }

    /// The same dimension without its angle.
    pub const fn without_angle(self) -> Self {
        Self { angle: 0, ..self }
    }

    /// Words for the dimension where a driveline engineer has a name for it.
    pub fn name(self) -> Option<&'static str> {
        let named = [
            (Self::NONE, "a pure number"),
            (Self::LENGTH, "a length"),
            (Self::MASS, "a mass"),
            (Self::TIME, "a time"),
            (Self::ANGLE, "an angle"),
            (Self::FORCE, "a force"),
            (Self::TORQUE, "a torque"),
            (Self::PRESSURE, "a pressure"),
            (Self::POWER, "a power"),
            (Self::SPEED, "an angular speed"),
            (Self::new(2, 1, 0, 0), "a moment of inertia"),
            (Self::new(2, 1, -2, -1), "a torsional stiffness"),
            (Self::new(2, 1, -1, -1), "a torsional damping"),
            (Self::new(2, 1, -1, 0), "an angular impulse"),
            (Self::new(0, 0, -1, 0), "a rate without an angle"),
            (Self::new(0, 0, -2, 1), "an angular acceleration"),
            (Self::new(1, 0, -1, 0), "a speed along a line"),
            (Self::new(0, 1, -2, 0), "a stiffness along a line"),
            (Self::new(-3, 1, 0, 0), "a density"),
        ];
        let name = named.iter().find(|(dimension, _)| *dimension == self).map(|(_, name)| *name);
        // The higher stiffnesses, down from N·m/rad².
        let torque = Self { angle: self.angle, ..Self::TORQUE };
        name.or((self == torque && self.angle < 0).then_some("a torque per power of the angle"))
    }
}

impl Add for Dimension {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            length: self.length.saturating_add(other.length),
            mass: self.mass.saturating_add(other.mass),
            time: self.time.saturating_add(other.time),
            angle: self.angle.saturating_add(other.angle),
        }
    }
}

impl Sub for Dimension {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + other * -1
    }
}

impl Mul<i8> for Dimension {
    type Output = Self;

    fn mul(self, power: i8) -> Self {
        Self {
            length: self.length.saturating_mul(power),
            mass: self.mass.saturating_mul(power),
            time: self.time.saturating_mul(power),
            angle: self.angle.saturating_mul(power),
        }
    }
}

impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Exponents of base units would tell an engineer nothing.
        f.write_str(self.name().unwrap_or("no torsional quantity"))
    }
}
