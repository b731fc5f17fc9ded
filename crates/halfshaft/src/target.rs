//! Where answers go, tried before any work is done.

use std::path::{Path, PathBuf};

use crate::parquet;
use halfshaft_results::io::WriteError;

/// A form that an answer can be written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Everything, as JSON.
    Json,
    /// The tables, as comma-separated values.
    Csv,
    /// Everything, as a Parquet file whose columns are the tables.
    Parquet,
    /// Figures, as vector graphics.
    Svg,
    /// Figures, as pixels.
    Png,
    /// A page with figures.
    Html,
}

/// Why an answer could not be written.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// The ending is none that this version writes.
    #[error("\"{}\" ends in no form that halfshaft writes", path.display())]
    UnknownEnding {
        /// The path as given.
        path: PathBuf,
    },
    /// The Parquet writer, a program of its own, is not there.
    #[error("the Parquet writer halfshaft-parquet was not found beside halfshaft nor in the PATH")]
    NoParquet,
    /// The folder cannot be made or written in.
    #[error("cannot write in {}: {source}", folder.display())]
    Folder {
        /// The folder.
        folder: PathBuf,
        /// What the operating system said.
        source: std::io::Error,
    },
    /// The answer has nothing of that form.
    #[error("the answer of `{analysis}` has no {what} to write")]
    Nothing {
        /// Name of the analysis.
        analysis: String,
        /// What it lacks.
        what: &'static str,
    },
    /// The answer has nothing to draw.
    #[error("the answer of `{analysis}` has no figure to write: {reason}")]
    NoFigure {
        /// Name of the analysis.
        analysis: String,
        /// Why.
        reason: &'static str,
    },
    /// Writing failed; no half-written file stands under the name.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// The Parquet writer failed; no half-written file stands under the name.
    #[error("{complaint}")]
    ParquetWriter {
        /// What it said.
        complaint: String,
    },
    /// A picture could not be drawn.
    #[error("cannot draw {}: {reason}", path.display())]
    Picture {
        /// The file.
        path: PathBuf,
        /// Why.
        reason: String,
    },
}

impl OutputError {
    /// What to do about it.
    pub fn advice(&self) -> Option<&'static str> {
        match self {
            Self::UnknownEnding { .. } => Some(
                "end in .json, .csv, .parquet, .svg, .png or .html, or name a folder for all of them",
            ),
            Self::NoParquet => Some(
                "build it with `cargo build --release` (or `cargo install --path \
                 crates/halfshaft-parquet`), or write .json or .csv",
            ),
            Self::Nothing { .. } | Self::NoFigure { .. } => {
                Some("--out answer.json holds everything")
            }
            Self::Folder { .. } => Some("name a folder that you may write in"),
            Self::Write(_) | Self::ParquetWriter { .. } | Self::Picture { .. } => None,
        }
    }
}

/// Where answers go.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Target {
    /// One form into one file; where there are several figures, those after the first beside it,
    /// under its name and their own.
    File(PathBuf, Format),
    /// All forms into a folder.
    Folder(PathBuf),
}

impl Target {
    /// The target that a path means for the answer of an analysis: a file by its ending, a folder
    /// without one.
    ///
    /// Tries to write there, so that a long computation does not end at a closed door; nothing
    /// stays of that.
    ///
    /// # Errors
    /// [`OutputError`] where the ending is unknown, answers of that analysis never have that form,
    /// or the folder cannot be written in.
    pub fn prepare(path: &Path, analysis: &str) -> Result<Self, OutputError> {
        let unwritable = |folder: &Path| {
            let folder = folder.to_path_buf();
            move |source| OutputError::Folder { folder, source }
        };
        let ending = path.extension().and_then(|ending| ending.to_str()).map(str::to_lowercase);
        if path.is_dir() || ending.is_none() {
            // It is made when there is something to put into it.
            let there = path.ancestors().find(|folder| folder.exists() || is_here(folder));
            try_writing(there.unwrap_or(path)).map_err(unwritable(path))?;
            return Ok(Self::Folder(path.to_path_buf()));
        }
        let format = match ending.as_deref() {
            Some("json") => Format::Json,
            Some("csv") => Format::Csv,
            Some("parquet") => match parquet::writer() {
                Some(_) => Format::Parquet,
                None => return Err(OutputError::NoParquet),
            },
            Some("svg") => Format::Svg,
            Some("png") => Format::Png,
            Some("html" | "htm") => Format::Html,
            _ => return Err(OutputError::UnknownEnding { path: path.to_path_buf() }),
        };
        if let Some(what) = lacking(analysis, format) {
            return Err(OutputError::Nothing { analysis: analysis.to_owned(), what });
        }
        let folder = folder_of(path);
        try_writing(&folder).map_err(unwritable(&folder))?;
        Ok(Self::File(path.to_path_buf(), format))
    }
}

/// What the answers of an analysis would need to be written in a form, where they never have it.
fn lacking(analysis: &str, format: Format) -> Option<&'static str> {
    match (analysis, format) {
        ("check" | "report", Format::Csv | Format::Parquet) | ("run", Format::Parquet) => {
            Some("table")
        }
        _ => None,
    }
}

/// Whether a path is the empty one, which means where we are.
pub(crate) fn is_here(path: &Path) -> bool {
    path.as_os_str().is_empty()
}

fn folder_of(path: &Path) -> PathBuf {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent.to_path_buf(),
        _ => PathBuf::from("."),
    }
}

/// Makes and removes a file in the folder.
fn try_writing(folder: &Path) -> std::io::Result<()> {
    let probe = folder.join(format!(".halfshaft-probe-{}.tmp", std::process::id()));
    std::fs::File::create(&probe)?;
    std::fs::remove_file(&probe)
}
