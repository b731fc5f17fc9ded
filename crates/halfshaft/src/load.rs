//! From a model file to a line.

use std::path::Path;

use halfshaft_model::{
    Diagnostics, Driveline, FileError, SetFlag, Source, embedded, read_file, read_model,
};

/// A line with what is odd about its file.
#[derive(Clone, Debug, PartialEq)]
pub struct Loaded {
    /// The line.
    pub line: Driveline,
    /// Warnings, never errors.
    pub warnings: Diagnostics,
}

/// Why a model cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum LoadError {
    /// The file cannot be read as text.
    #[error(transparent)]
    File(#[from] FileError),
    /// The text has mistakes.
    #[error("the model has mistakes:\n{}", .0.plain())]
    Diagnostics(Diagnostics),
}

/// Reads and checks a model file, with settings such as `half-shaft.cubic=-500` applied.
///
/// # Errors
/// [`LoadError`] with all mistakes at once.
pub fn load(path: &Path, settings: &[SetFlag]) -> Result<Loaded, LoadError> {
    from_source(read_file(path)?, settings)
}

/// The embedded example: the two-mass driveline with a softening half-shaft.
///
/// # Errors
/// [`LoadError::Diagnostics`] where a setting is wrong.
pub fn load_embedded(settings: &[SetFlag]) -> Result<Loaded, LoadError> {
    from_source(embedded::example(), settings)
}

fn from_source(source: Source, settings: &[SetFlag]) -> Result<Loaded, LoadError> {
    let (line, warnings) = read_model(source, settings).map_err(LoadError::Diagnostics)?;
    Ok(Loaded { line, warnings })
}
