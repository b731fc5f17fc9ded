//! The one error enum of the crate, with the numbers of each failure in named fields.

use crate::ode::Stop;

/// Why a computation produced nothing usable.
///
/// An iteration that ended without converging is not an error: its result carries the reason
/// (see [`crate::newton::Convergence`] and [`crate::bracket::Ending`]).
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A list has the wrong number of entries.
    #[error("{quantity} needs {expected} numbers, but {found} were given")]
    Length {
        /// What the list holds.
        quantity: &'static str,
        /// The number of entries that fits.
        expected: usize,
        /// The number of entries that came.
        found: usize,
    },
    /// An operation on square matrices met a rectangular one.
    #[error("{operation} needs a square matrix, but this one is {rows} by {columns}")]
    NotSquare {
        /// The operation that was asked for.
        operation: &'static str,
        /// Rows of the matrix.
        rows: usize,
        /// Columns of the matrix.
        columns: usize,
    },
    /// A number that has to be finite is not.
    #[error("{quantity} is not finite: {value}")]
    NonFinite {
        /// What the number means.
        quantity: &'static str,
        /// The offending number: an infinity or NaN.
        value: f64,
    },
    /// A function has the same sign at both ends of the interval in which its root was sought.
    #[error(
        "no sign change between {lower} (value {value_at_lower}) and {upper} (value {value_at_upper})"
    )]
    NotBracketed {
        /// First end of the interval.
        lower: f64,
        /// Second end of the interval.
        upper: f64,
        /// Function value at the first end.
        value_at_lower: f64,
        /// Function value at the second end.
        value_at_upper: f64,
    },
    /// A linear system has no unique solution.
    #[error("the {dimension} by {dimension} matrix is singular: no pivot in column {column}")]
    Singular {
        /// Rows of the matrix.
        dimension: usize,
        /// First column, counted from zero, that depends on the ones before it.
        column: usize,
    },
    /// The eigenvalue iteration gave up.
    #[error("the eigenvalues of a {dimension} by {dimension} matrix did not converge")]
    EigenvaluesNotConverged {
        /// Rows of the matrix.
        dimension: usize,
    },
    /// A number in a settings struct is out of its range.
    #[error("setting {name} = {value}, but it {requirement}")]
    Setting {
        /// Name of the field.
        name: &'static str,
        /// The number that was given.
        value: f64,
        /// The range, as the end of a sentence: "must be positive".
        requirement: &'static str,
    },
    /// Break times do not follow each other in the direction of integration.
    #[error("break time {time} (entry {index}) comes before the one it follows")]
    BreaksNotOrdered {
        /// Position in the list, counted from zero.
        index: usize,
        /// The time found there.
        time: f64,
    },
    /// A harmonic cannot be told from a lower one with so few samples.
    #[error("harmonic {harmonic} needs at least {needed} samples of the period, got {samples}")]
    TooFewSamples {
        /// The harmonic that was asked for.
        harmonic: usize,
        /// Least number of samples that shows it.
        needed: usize,
        /// The number of samples given.
        samples: usize,
    },
    /// A time integration ended before its goal.
    #[error(transparent)]
    Stopped(#[from] Stop),
}

/// `Ok` if all numbers are finite, otherwise the first that is not.
pub(crate) fn all_finite(quantity: &'static str, values: &[f64]) -> Result<(), Error> {
    match values.iter().find(|value| !value.is_finite()) {
        None => Ok(()),
        Some(&value) => Err(Error::NonFinite { quantity, value }),
    }
}

/// `Ok` if a list has the expected length.
pub(crate) fn has_length(
    quantity: &'static str,
    expected: usize,
    found: usize,
) -> Result<(), Error> {
    if expected == found { Ok(()) } else { Err(Error::Length { quantity, expected, found }) }
}

/// `Ok` if `holds`, otherwise the setting with its requirement.
pub(crate) fn setting(
    name: &'static str,
    value: f64,
    holds: bool,
    requirement: &'static str,
) -> Result<(), Error> {
    if holds { Ok(()) } else { Err(Error::Setting { name, value, requirement }) }
}
