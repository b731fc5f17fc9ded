//! Ranges `A..B` and bare numbers as they stand in flags and study files.

use crate::units::{QuantityError, QuantityKind, parse_quantity};

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
        Ok(quantity) => Ok(quantity.si),
        Err(QuantityError::NoUnit { .. }) => Ok(parse_quantity(text, QuantityKind::Number)?.si),
        Err(error) => Err(error),
    }
}

/// Reads `A..B`; returns the smaller end first.
///
/// Bare numbers are in SI; where only the second end has a unit it holds for both
/// (`20..28 Hz`).
///
/// # Errors
/// [`RangeError`] where there are no two dots, an end cannot be read, or both are equal.
pub fn parse_range(text: &str, kind: QuantityKind) -> Result<(f64, f64), RangeError> {
    let no_dots = || RangeError::NoDots { text: text.to_owned(), kind };
    let (from, to) = text.split_once("..").ok_or_else(no_dots)?;
    let (from, to) = (from.trim(), to.trim_start_matches('.').trim());
    if from.is_empty() || to.is_empty() {
        return Err(no_dots());
    }
    let end = parse_flag_quantity(to, kind)?;
    let bare = matches!(parse_quantity(from, kind), Err(QuantityError::NoUnit { .. }));
    let start = match unit_of(to) {
        Some(unit) if bare => parse_flag_quantity(&format!("{from} {unit}"), kind)?,
        _ => parse_flag_quantity(from, kind)?,
    };
    if start == end {
        return Err(RangeError::Empty { text: text.to_owned() });
    }
    Ok((start.min(end), start.max(end)))
}

/// The unit part of a quantity text, if it has one.
fn unit_of(text: &str) -> Option<&str> {
    let at = text.find(|c: char| {
        !(c.is_ascii_digit() || matches!(c, '.' | '+' | '-' | '−' | ' ' | 'e' | 'E'))
    })?;
    Some(&text[at..])
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
    }

    #[test]
    fn what_is_no_range_is_refused() {
        for text in ["", "5", "..", "1..", "..2", "a..b", "1..1", "1 kg..2 kg", "1..2..3"] {
            assert!(parse_range(text, QuantityKind::Speed).is_err(), "{text}");
        }
    }
}
