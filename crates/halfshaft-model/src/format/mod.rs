//! The model file: its keys as data, its reader, its JSON schema and its reference page.
//!
//! [`MODEL`] lists every table and key once; [`read_model`] turns a text into the elements
//! of a line with all errors at once, [`json_schema`] and [`reference_page`] are made from
//! the same list.

mod checked;
mod limits;
mod measured_file;
mod model_file;
mod reader;
mod reference;
mod schema;
mod spec;
mod syntax;

pub(crate) use checked::{Checked, CheckedTable};
pub use limits::{FileError, LARGEST_FILE, read_file};
pub use model_file::{MODEL, SetFlag, read_model};
pub(crate) use reader::{OtherFile, read_document};
pub use reference::reference_page;
pub use schema::json_schema;
pub(crate) use spec::words;
pub use spec::{KeySpec, TableSpec, ValueSpec};
