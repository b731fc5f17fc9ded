//! Parquet files of halfshaft's results, a crate of its own because Parquet compiles for long.
//!
//! A file holds one row group for each table of the answer (a history, each branch, each fold
//! curve). Its columns are the tables' columns as doubles, after a column `table` that counts the
//! tables from 1. The rest of the answer stands in the file's metadata under `halfshaft` as JSON,
//! the units of the columns under `units`, so that nothing is lost and [`from_bytes`] returns
//! an equal answer.

mod read;
mod write;

pub use read::from_bytes;
pub use write::to_bytes;

/// Why a Parquet file could not be written or read.
#[derive(Debug, thiserror::Error)]
pub enum ParquetError {
    /// The Parquet library refused.
    #[error("Parquet: {0}")]
    Parquet(#[from] parquet::errors::ParquetError),
    /// The metadata is not the JSON of an answer.
    #[error("the file's metadata is no result of halfshaft: {0}")]
    Json(#[from] serde_json::Error),
    /// The metadata is missing.
    #[error("the file has no metadata named \"halfshaft\"")]
    NotOurs,
    /// The answer has no table, so there is nothing to put in columns.
    #[error("the answer of `{analysis}` has no table")]
    NoTable {
        /// Name of the analysis.
        analysis: String,
    },
    /// A column that the metadata promises is not in the file.
    #[error("the file lacks {what}")]
    Missing {
        /// What is missing.
        what: String,
    },
}

/// Key of the answer without its bulk columns.
const ANSWER_KEY: &str = "halfshaft";
/// Key of the units by column.
const UNITS_KEY: &str = "units";
/// Column that counts the tables.
const TABLE_COLUMN: &str = "table";
