//! How numbers, names and columns read.

pub(crate) use column::{Quantity, RPM, column_label, column_words};
pub(crate) use name::{capital, counted, list, plain, short};
pub(crate) use number::{MISSING, common_decimals, decimals, number, percent, places, times};
pub(crate) use special::{special_explanation, special_words};
pub(crate) use units::{angle, bound, frequency_words, quantity, unit};

mod column;
mod name;
mod number;
mod special;
mod units;
