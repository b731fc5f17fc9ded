//! Numbers that JSON does not have.
//!
//! JSON knows neither NaN nor infinity: both are written as `null`. A field that holds a number
//! reads `null` back as NaN, so that a result which ran out of the numbers can still be read; an
//! infinity is not told from NaN any more then. Fields that may have no number (`Option`) read
//! `null` as that.

use serde::{Deserialize, Deserializer};

use crate::Named;

/// A value with numbers in it, each of which may stand as `null`.
pub(crate) trait Numbers: Sized {
    /// The same with every number as it may stand in a file.
    type Stored;

    /// The value with NaN for what is missing.
    fn of(stored: Self::Stored) -> Self;
}

/// Reads numbers of which some may be `null`; for `#[serde(deserialize_with)]` of every field that
/// holds numbers.
pub(crate) fn read<'de, T, D>(deserializer: D) -> Result<T, D::Error>
where
    T: Numbers<Stored: Deserialize<'de>>,
    D: Deserializer<'de>,
{
    T::Stored::deserialize(deserializer).map(T::of)
}

impl Numbers for f64 {
    type Stored = Option<f64>;

    fn of(stored: Self::Stored) -> Self {
        stored.unwrap_or(f64::NAN)
    }
}

impl<T: Numbers> Numbers for Vec<T> {
    type Stored = Vec<T::Stored>;

    fn of(stored: Self::Stored) -> Self {
        stored.into_iter().map(T::of).collect()
    }
}

impl<T: Numbers> Numbers for Named<T> {
    type Stored = Named<T::Stored>;

    fn of(stored: Self::Stored) -> Self {
        stored.into_iter().map(|(name, value)| (name, T::of(value))).collect()
    }
}

impl<T: Numbers> Numbers for (T, T) {
    type Stored = (T::Stored, T::Stored);

    fn of((first, second): Self::Stored) -> Self {
        (T::of(first), T::of(second))
    }
}

impl<T: Numbers> Numbers for [T; 2] {
    type Stored = [T::Stored; 2];

    fn of(stored: Self::Stored) -> Self {
        stored.map(T::of)
    }
}

impl<T: Numbers> Numbers for Option<(T, T)> {
    type Stored = Option<(T::Stored, T::Stored)>;

    fn of(stored: Self::Stored) -> Self {
        stored.map(Numbers::of)
    }
}
