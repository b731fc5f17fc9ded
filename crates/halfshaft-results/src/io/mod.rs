//! Files of results: JSON (everything) and CSV (the tables).
//!
//! Nothing is ever half written: [`write_atomically`] writes beside the target under a
//! temporary name and renames when all is on the disk.

mod atomic;
mod comma;
mod comparison;
mod json;

pub use atomic::{WriteError, write_atomically};
pub use comma::{csv, tables_of};
pub use comparison::{comparison_csv, comparison_markdown};
pub use json::{JsonError, ReadError, from_json, to_json, write_json};
