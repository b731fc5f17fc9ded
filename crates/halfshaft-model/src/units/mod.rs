//! Units at the border: text such as `"6420 N·m/rad"` becomes one SI number, once.
//!
//! In goes a number with a unit, out comes the value in the SI unit of the
//! [`QuantityKind`] that the place asks for, or a [`QuantityError`] that says which
//! units would fit. The angle is carried as a dimension of its own, because N·m/rad and
//! N·m/deg differ by a factor of 57.3 and a forgotten angle is the commonest mistake in
//! torsional work.

mod catalog;
mod dimension;
mod expression;
mod kind;
mod number;
mod quantity;

pub use dimension::Dimension;
pub use expression::UnitError;
pub use kind::{QuantityKind, Sign};
pub(crate) use quantity::unit_of;
pub use quantity::{QuantityError, parse_quantity};
