//! Turns results into things people read: figures, summaries and the report.
//!
//! | in | out | module |
//! |---|---|---|
//! | an answer | plain text for a terminal | [`summary`] |
//! | an answer | its figures as data | [`figures`] |
//! | an answer | one self-contained HTML page | [`html`] |
//! | the line as `check` sees it | a drawing of it, as SVG | [`sketch`](mod@sketch) |
//! | numbers with names and units | a figure as SVG, PNG or an interactive plotly graph | [`figure`] |
//!
//! This crate knows no analysis: it is handed values and shows them. It reads no file, writes
//! none, and its output depends on its input only, so equal results give equal bytes. No result
//! makes it fail: what is missing is said or left out.
//!
//! Within, an *account* is what is told of an answer (sentences, tables, places of figures);
//! summary and page show the same account. *Findings* are what a report finds: what is safe, what
//! is not, by how much.

pub mod figure;
pub mod figures;
pub mod html;
pub mod sketch;
pub mod summary;

mod account;
mod findings;
#[cfg(test)]
mod made;
mod reading;
mod topology;
mod words;
