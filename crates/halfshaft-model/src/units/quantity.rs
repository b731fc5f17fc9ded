//! From the text of one quantity to its SI value.

use super::dimension::Dimension;
use super::expression::{self, Reading, UnitError};
use super::kind::QuantityKind;
use super::number;
use crate::diagnostic::did_you_mean;

/// Why a text is not the quantity that was asked for.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum QuantityError {
    /// The text does not begin with a number.
    #[error("\"{text}\" does not begin with a number")]
    NoNumber {
        /// The text as written.
        text: String,
        /// What was asked for.
        kind: QuantityKind,
    },
    /// The number is infinite or not a number.
    #[error("\"{text}\" is not a finite number")]
    NotFinite {
        /// The text as written.
        text: String,
    },
    /// A text without a unit where the unit is not certain.
    #[error("the unit is missing: \"{text}\" could be {}", .kind.examples().join(" or "))]
    NoUnit {
        /// The text as written.
        text: String,
        /// What was asked for.
        kind: QuantityKind,
    },
    /// The unit cannot be read.
    #[error(transparent)]
    Unit(UnitError),
    /// The unit is of another dimension.
    #[error("\"{unit}\" is {actual}, but this must be {}", .kind.name())]
    WrongDimension {
        /// The unit as written.
        unit: String,
        /// Its dimension.
        actual: Dimension,
        /// What was asked for.
        kind: QuantityKind,
    },
}

impl QuantityError {
    /// What to write instead where one of some words may stand as well.
    pub(crate) fn hint_or_word(&self, words: &[&str]) -> Option<String> {
        match self {
            Self::NoNumber { text, .. } if !words.is_empty() => {
                let near = did_you_mean(text, words.iter().copied());
                let words = words.join("\", \"");
                near.or_else(|| Some(format!("write a number and a unit, or the word \"{words}\"")))
            }
            _ => self.hint(),
        }
    }

    /// What to write instead.
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::NoNumber { text, .. } if text.matches(',').count() == 1 => {
                let right = text.trim().replace(',', ".");
                Some(format!("decimals are written with a point: {right}"))
            }
            Self::NoNumber { text, .. } if text.contains(',') => {
                Some("decimals are written with a point: 0.5".to_owned())
            }
            Self::NoNumber { kind: QuantityKind::Number, .. } => {
                Some("write a number without a unit, e.g. 2".to_owned())
            }
            Self::NoNumber { kind, .. } => {
                Some(format!("write a number and a unit, e.g. \"5 {}\"", kind.si_unit()))
            }
            Self::NotFinite { .. } => None,
            Self::NoUnit { text, kind } => Some(format!(
                "write \"{} {}\", or the bare number {0} for {1}",
                text.trim(),
                kind.si_unit()
            )),
            Self::Unit(UnitError::Unknown { nearest: Some(nearest), .. }) => {
                Some(format!("did you mean \"{nearest}\"?"))
            }
            Self::Unit(_) => {
                Some("units look like N·m/rad, kg·m², N·m·s/rad, rpm, deg, ms".to_owned())
            }
            Self::WrongDimension { unit, kind: QuantityKind::Time, .. } if unit == "m" => {
                let units = QuantityKind::Time.examples().join(", ");
                Some(format!("minutes are written min; times are known in {units}"))
            }
            Self::WrongDimension { actual, kind, .. } => Some(dimension_hint(*actual, *kind)),
        }
    }
}

fn dimension_hint(actual: Dimension, kind: QuantityKind) -> String {
    let wanted = kind.dimension();
    let suggestions = kind.examples().join(", ");
    if kind == QuantityKind::Number {
        return "leave the unit out".to_owned();
    }
    if actual.without_angle() == wanted.without_angle() && actual != wanted {
        if wanted.angle < 0 && actual.angle == 0 {
            return format!("per which angle? write {suggestions}");
        }
        return format!("the angle does not fit: write {suggestions}");
    }
    format!("write it in {suggestions}")
}

/// How speeds of rotation in revolutions per minute are written without a revolution.
const PER_MINUTE: [&str; 5] = ["1/min", "/min", "min⁻¹", "min^-1", "min-1"];

/// The ratio that "3.5:1" means, read as 3.5 and what follows it.
fn proportion(first: f64, rest: &str) -> Option<f64> {
    let (second, rest) = number::split(rest.strip_prefix(':')?)?;
    rest.trim().is_empty().then_some(first / second)
}

/// The dimension that was probably meant by a unit of which no reading is `wanted`: one where only
/// the angle is wrong, or else one that has a name.
fn probable(readings: &[Reading], wanted: Dimension) -> Dimension {
    let dimensions = || readings.iter().map(|reading| reading.dimension);
    dimensions()
        .find(|dimension| dimension.without_angle() == wanted.without_angle())
        .or_else(|| dimensions().find(|dimension| dimension.name().is_some()))
        .or_else(|| dimensions().next())
        .unwrap_or_default()
}

/// The unit part of a quantity text, if it has one; the second half of a proportion is none.
pub(crate) fn unit_of(text: &str) -> Option<&str> {
    let (_, unit) = number::split(text)?;
    Some(unit.trim()).filter(|unit| !unit.is_empty() && !unit.starts_with(':'))
}

/// Reads `text` as a number with a unit of the given kind and converts it to SI.
///
/// A text without a unit is refused unless `kind` is a pure number: whoever writes
/// quotation marks means a unit, and 6420 N·m/deg is not 6420 N·m/rad.
///
/// # Errors
/// [`QuantityError`] says what is wrong and, by [`QuantityError::hint`], what to write.
pub fn parse_quantity(text: &str, kind: QuantityKind) -> Result<f64, QuantityError> {
    let owned = || text.to_owned();
    let (value, unit) =
        number::split(text).ok_or_else(|| QuantityError::NoNumber { text: owned(), kind })?;
    if !value.is_finite() {
        return Err(QuantityError::NotFinite { text: owned() });
    }
    let unit = unit.trim();
    if unit.starts_with(',') {
        return Err(QuantityError::NoNumber { text: owned(), kind });
    }
    if unit.is_empty() {
        // Zero is zero in every unit; any other number without one could be per degree.
        return if kind == QuantityKind::Number || value == 0.0 {
            Ok(value)
        } else {
            Err(QuantityError::NoUnit { text: owned(), kind })
        };
    }
    if let Some(ratio) = proportion(value, unit).filter(|_| kind == QuantityKind::Number) {
        return if ratio.is_finite() {
            Ok(ratio)
        } else {
            Err(QuantityError::NotFinite { text: owned() })
        };
    }
    let per_minute = kind == QuantityKind::Speed && PER_MINUTE.contains(&unit);
    let readings = expression::read(if per_minute { "rpm" } else { unit });
    let readings = readings.map_err(QuantityError::Unit)?;
    let wanted = kind.dimension();
    let fitting = readings.iter().find(|reading| reading.dimension == wanted);
    let Some(reading) = fitting else {
        let actual = probable(&readings, wanted);
        return Err(QuantityError::WrongDimension { unit: unit.to_owned(), actual, kind });
    };
    let si = value * reading.factor;
    if si.is_finite() { Ok(si) } else { Err(QuantityError::NotFinite { text: owned() }) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn si(text: &str, kind: QuantityKind) -> f64 {
        parse_quantity(text, kind).unwrap_or_else(|error| panic!("{text}: {error}"))
    }

    // Source: unit definitions.
    #[test]
    fn quantities_are_converted_at_the_border() {
        assert_eq!(si("6420 N·m/rad", QuantityKind::Stiffness(1)), 6420.0);
        let per_degree = si("112 N·m/deg", QuantityKind::Stiffness(1));
        assert!((per_degree - 112.0 * 180.0 / PI).abs() < 1e-12 * per_degree);
        let cubic = si("-2 Nm/deg^3", QuantityKind::Stiffness(3));
        assert!((cubic + 2.0 * (180.0 / PI).powi(3)).abs() < 1e-12 * cubic.abs());
        assert_eq!(si("3.28 kg·cm²", QuantityKind::Inertia), 3.28e-4);
        assert!((si("3000 rpm", QuantityKind::Speed) - 100.0 * PI).abs() < 1e-12);
        assert!((si("4 Hz", QuantityKind::Speed) - 8.0 * PI).abs() < 1e-14);
        assert_eq!(si("90 Nms/rad", QuantityKind::Damping), 90.0);
        assert_eq!(si("20ms", QuantityKind::Time), 0.02);
        assert_eq!(si("5.71", QuantityKind::Number), 5.71);
        assert_eq!(si("2 %", QuantityKind::Number), 0.02);
    }

    #[test]
    fn wrong_dimensions_say_what_is_missing() {
        let error = parse_quantity("6420 N·m", QuantityKind::Stiffness(1)).unwrap_err();
        assert_eq!(
            error.to_string(),
            "\"N·m\" is a torque, but this must be a torsional stiffness"
        );
        assert_eq!(
            error.hint().as_deref(),
            Some("per which angle? write N·m/rad, N·m/deg, kN·m/rad")
        );
        let error = parse_quantity("25 1/s", QuantityKind::Speed).unwrap_err();
        assert!(error.hint().is_some_and(|hint| hint.contains("angle")));
    }

    // Source: a first-time user's trial: the same unit with and without points.
    #[test]
    fn a_damping_without_its_angle_is_told_so_however_it_is_written() {
        for text in ["2 N·m·s", "2 Nms", "2 N·ms", "2 J s"] {
            let error = parse_quantity(text, QuantityKind::Damping).unwrap_err();
            assert!(error.to_string().contains("is an angular impulse"), "{error}");
            let hint = error.hint().unwrap_or_default();
            assert!(hint.starts_with("per which angle? write N·m·s/rad"), "{text}: {hint}");
        }
        assert_eq!(si("5 Nms/rad", QuantityKind::Damping), 5.0);
        let error = parse_quantity("2 kg·s^3", QuantityKind::Torque).unwrap_err();
        assert!(error.to_string().contains("is no torsional quantity, but"), "{error}");
        let error = parse_quantity("2 N·m/rad³", QuantityKind::Torque).unwrap_err();
        assert!(error.to_string().contains("is a torque per power of the angle"), "{error}");
    }

    // Source: unit definitions: one revolution a minute is 2π rad in 60 s.
    #[test]
    fn revolutions_per_minute_may_be_left_unnamed() {
        for text in ["3000 U/min", "3000 1/min", "3000/min", "3000 min⁻¹", "3000 rpm"] {
            assert!((si(text, QuantityKind::Speed) - 100.0 * PI).abs() < 1e-12, "{text}");
        }
        assert!(parse_quantity("3000 1/s", QuantityKind::Speed).is_err());
    }

    // Source: by hand.
    #[test]
    fn a_ratio_may_be_a_proportion() {
        assert_eq!(si("3.5:1", QuantityKind::Number), 3.5);
        assert_eq!(si("-41 : 10", QuantityKind::Number), -4.1);
        for text in ["3.5:0", "3.5:", "3.5:1:1", "3.5:1 rad"] {
            assert!(parse_quantity(text, QuantityKind::Number).is_err(), "{text}");
        }
        assert!(parse_quantity("3.5:1", QuantityKind::Torque).is_err());
    }

    // Source: a first-time user's trial; 5 min are 300 s.
    #[test]
    fn hints_fit_the_quantity_that_is_asked_for() {
        let hint = |text, kind| parse_quantity(text, kind).unwrap_err().hint().unwrap_or_default();
        assert_eq!(hint("two", QuantityKind::Number), "write a number without a unit, e.g. 2");
        assert_eq!(hint("two", QuantityKind::Speed), "write a number and a unit, e.g. \"5 rad/s\"");
        assert_eq!(
            hint("5m", QuantityKind::Time),
            "minutes are written min; times are known in s, ms, min, h"
        );
        assert_eq!(si("5min", QuantityKind::Time), 300.0);
    }

    #[test]
    fn a_text_without_unit_is_ambiguous() {
        let error = parse_quantity("6420", QuantityKind::Stiffness(1)).unwrap_err();
        assert!(matches!(error, QuantityError::NoUnit { .. }));
        assert_eq!(
            error.hint().as_deref(),
            Some("write \"6420 N·m/rad\", or the bare number 6420 for N·m/rad")
        );
    }

    #[test]
    fn numbers_that_are_none_are_refused() {
        for text in ["nan N·m", "inf N·m", "-inf N·m", "1e400 N·m", "1e308 kN·m"] {
            let error = parse_quantity(text, QuantityKind::Torque).unwrap_err();
            assert!(matches!(error, QuantityError::NotFinite { .. }), "{text}: {error}");
        }
        assert!(parse_quantity("0,5 N·m", QuantityKind::Torque).is_err());
        assert!(parse_quantity("N·m", QuantityKind::Torque).is_err());
    }
}
