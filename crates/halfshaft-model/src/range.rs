//! Ranges `A..B` and bare numbers as they stand in flags and study files.

use crate::units::{QuantityError, QuantityKind, parse_quantity, unit_of};

/// Why a text is no range.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RangeError {
    /// There are no two dots.
    #[error("\"{text}\" is not a range A..B")]
    NoDots {
        /// The text as written.
        text: String,
        /// What the range is of.
        kind: QuantityKind,
    },
    /// One end cannot be read.
    #[error(transparent)]
    End(#[from] QuantityError),
    /// Only the first number has a unit.
    #[error("say which unit the second number has")]
    UnitOnFirst {
        /// The text as written.
        text: String,
        /// The first number's unit, with the space before it if there is one.
        unit: String,
    },
    /// The unit of the second number, which holds for both, makes the first one the larger.
    #[error("the range runs backwards, since the unit holds for both numbers")]
    Backwards {
        /// The unit.
        unit: String,
    },
    /// A range of times or speeds whose first end is the larger one.
    #[error("the range \"{text}\" runs backwards")]
    Reversed {
        /// The text as written.
        text: String,
        /// The same with its ends exchanged.
        meant: String,
    },
    /// Both ends are the same.
    #[error("the range \"{text}\" is empty")]
    Empty {
        /// The text as written.
        text: String,
    },
}

impl RangeError {
    /// What to write instead.
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::NoDots { kind, .. } => {
                let unit = kind.examples().first().copied().unwrap_or_default();
                let unit = if *kind == QuantityKind::Number { "" } else { unit };
                Some(format!("write two values with two dots between, e.g. 20{unit}..30{unit}"))
            }
            Self::End(error) => error.hint(),
            Self::UnitOnFirst { text, unit } => {
                Some(format!("write \"{text}{unit}\", or each number with its own unit"))
            }
            Self::Backwards { unit } => Some(format!(
                "write the smaller number first, or, if the first is not in {unit}, each number \
                 with its own unit"
            )),
            Self::Reversed { meant, .. } => Some(format!("did you mean \"{meant}\"?")),
            Self::Empty { .. } => Some("give two different ends".to_owned()),
        }
    }
}

/// A quantity as a flag gives it: with a unit, or a bare number in SI.
///
/// # Errors
/// As [`parse_quantity`], except that a number without a unit is read as SI.
pub fn parse_flag_quantity(text: &str, kind: QuantityKind) -> Result<f64, QuantityError> {
    match parse_quantity(text, kind) {
        Err(QuantityError::NoUnit { .. }) => parse_quantity(text, QuantityKind::Number),
        read => read,
    }
}

/// Reads `A..B`; returns the smaller end first.
///
/// Bare numbers are in SI; where only the second one has a unit it holds for both (`20..28 Hz`).
/// Where both numbers say for themselves what they are, the larger one may come first (a coefficient
/// runs from nothing to `0..-642`), but not of times and speeds, which have one direction.
///
/// # Errors
/// [`RangeError`] where there are no two dots, an end cannot be read, only the first number has a
/// unit, a range of times or speeds runs backwards, or both ends are equal.
pub fn parse_range(text: &str, kind: QuantityKind) -> Result<(f64, f64), RangeError> {
    let owned = || text.trim().to_owned();
    let no_dots = || RangeError::NoDots { text: text.to_owned(), kind };
    let (from, to) = text.split_once("..").ok_or_else(no_dots)?;
    let (from, to) = (from.trim(), to.trim());
    // "0...5" could end at 5 or at 0.5.
    if from.is_empty() || to.is_empty() || to.starts_with('.') {
        return Err(no_dots());
    }
    let (start, end) = (parse_flag_quantity(from, kind), parse_flag_quantity(to, kind)?);
    let (start, end) = match (unit_of(from), unit_of(to)) {
        // Zero is zero in every unit.
        (Some(unit), None) if end != 0.0 => {
            start?;
            let spaced = format!(" {unit}");
            let unit = if from.ends_with(&spaced) { &spaced } else { unit };
            return Err(RangeError::UnitOnFirst { text: owned(), unit: unit.to_owned() });
        }
        (None, Some(unit)) => {
            let start = parse_flag_quantity(&format!("{from} {unit}"), kind)?;
            if start > end && start != 0.0 {
                return Err(RangeError::Backwards { unit: unit.to_owned() });
            }
            (start, end)
        }
        _ => (start?, end),
    };
    if start == end {
        return Err(RangeError::Empty { text: owned() });
    }
    if start > end && matches!(kind, QuantityKind::Time | QuantityKind::Speed) {
        return Err(RangeError::Reversed { text: owned(), meant: format!("{to}..{from}") });
    }
    Ok((start.min(end), start.max(end)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn ranges_take_units_at_both_ends_or_at_the_second() {
        let both = parse_range("3.9Hz..4.4Hz", QuantityKind::Speed).expect("is a range");
        assert!((both.0 - 7.8 * PI).abs() < 1e-12 && (both.1 - 8.8 * PI).abs() < 1e-12);
        assert_eq!(parse_range("3.9..4.4 Hz", QuantityKind::Speed), Ok(both));
        assert_eq!(parse_range("20..28", QuantityKind::Speed), Ok((20.0, 28.0)));
        assert_eq!(parse_range("0..-642", QuantityKind::Stiffness(3)), Ok((-642.0, 0.0)));
        assert_eq!(parse_range("1e1..2.5e1", QuantityKind::Number), Ok((10.0, 25.0)));
        assert_eq!(parse_range("1..2 %", QuantityKind::Number), Ok((0.01, 0.02)));
    }

    #[test]
    fn a_unit_that_could_be_meant_for_one_number_only_is_asked_for() {
        let speed = |text| parse_range(text, QuantityKind::Speed);
        for text in ["3.9Hz..4.4", "3.9 Hz .. 4.4", "-1Hz..2"] {
            assert!(matches!(speed(text), Err(RangeError::UnitOnFirst { .. })), "{text}");
        }
        let hint = speed("3.9Hz..4.4").expect_err("is ambiguous").hint();
        assert!(hint.is_some_and(|hint| hint.contains("\"3.9Hz..4.4Hz\"")));
        assert!(matches!(speed("28..4.4Hz"), Err(RangeError::Backwards { .. })));
        // With a unit at both, at none, or at a zero, nothing is in doubt.
        let torque = |text| parse_range(text, QuantityKind::Torque);
        assert_eq!(torque("4kN·m..3kN·m"), torque("3kN·m..4kN·m"));
        assert_eq!(torque("28..20"), Ok((20.0, 28.0)));
        assert_eq!(torque("3kN·m..0"), torque("0..3kN·m"));
        assert_eq!(torque("0..-3kN·m"), torque("-3kN·m..0N·m"));
    }

    // Source: a first-time user's trial: `--record 2..1`.
    #[test]
    fn times_and_speeds_that_run_backwards_are_refused() {
        for (text, kind, meant) in [
            ("2..1", QuantityKind::Time, "1..2"),
            ("4Hz..3Hz", QuantityKind::Speed, "3Hz..4Hz"),
            ("3Hz..0", QuantityKind::Speed, "0..3Hz"),
            ("0..-3Hz", QuantityKind::Speed, "-3Hz..0"),
        ] {
            let hint = parse_range(text, kind).expect_err("runs backwards").hint();
            assert_eq!(hint, Some(format!("did you mean \"{meant}\"?")));
            assert!(parse_range(meant, kind).is_ok(), "{meant}");
        }
    }

    #[test]
    fn what_is_no_range_is_refused() {
        for text in ["", "5", "..", "1..", "..2", "a..b", "1..1", "1 kg..2 kg", "1..2..3", "0...5"]
        {
            assert!(parse_range(text, QuantityKind::Speed).is_err(), "{text}");
        }
    }
}
