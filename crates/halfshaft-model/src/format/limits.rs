//! Opening a file without trusting it: size and encoding are looked at first.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use crate::diagnostic::Source;

/// Largest model or study file that is read, bytes: a line of ten thousand elements takes
/// two megabytes.
pub const LARGEST_FILE: u64 = 16 * 1024 * 1024;

/// Why a file cannot be read as text.
#[derive(Debug, thiserror::Error)]
pub enum FileError {
    /// The file cannot be opened or read.
    #[error("cannot read {path}: {source}")]
    Unreadable {
        /// Path as given.
        path: String,
        /// What the operating system said.
        source: std::io::Error,
    },
    /// The path is a folder.
    #[error("{path} is a folder; a model is one TOML file")]
    Folder {
        /// Path as given.
        path: String,
    },
    /// The file is larger than any model.
    #[error("{path} is {megabytes} MB; model files are read up to {} MB", LARGEST_FILE >> 20)]
    TooLarge {
        /// Path as given.
        path: String,
        /// Its size in MB, or the limit where it has no size.
        megabytes: u64,
    },
    /// The file is no UTF-8 text.
    #[error(
        "{path} is not UTF-8 text: byte {offset} (line {line}) is 0x{byte:02X}; save it as UTF-8"
    )]
    NotUtf8 {
        /// Path as given.
        path: String,
        /// Offset of the first byte that is not UTF-8.
        offset: usize,
        /// Its line, from 1.
        line: usize,
        /// The byte.
        byte: u8,
    },
}

/// Reads a text file with the guards that bad input calls for.
///
/// # Errors
/// [`FileError`] where the file cannot be read, is larger than [`LARGEST_FILE`] or is not
/// UTF-8.
pub fn read_file(path: &Path) -> Result<Source, FileError> {
    let name = path.display().to_string();
    let unreadable = |source| FileError::Unreadable { path: name.clone(), source };
    let file = File::open(path).map_err(unreadable)?;
    let metadata = file.metadata().map_err(unreadable)?;
    if metadata.is_dir() {
        return Err(FileError::Folder { path: name });
    }
    if metadata.len() > LARGEST_FILE {
        return Err(FileError::TooLarge { path: name, megabytes: metadata.len() >> 20 });
    }
    let mut bytes = Vec::new();
    // Pipes have no length beforehand, so the limit is kept while reading as well.
    file.take(LARGEST_FILE + 1).read_to_end(&mut bytes).map_err(unreadable)?;
    if bytes.len() as u64 > LARGEST_FILE {
        return Err(FileError::TooLarge { path: name, megabytes: LARGEST_FILE >> 20 });
    }
    match String::from_utf8(bytes) {
        Ok(text) => Ok(Source::new(name, text)),
        Err(error) => {
            let offset = error.utf8_error().valid_up_to();
            let bytes = error.as_bytes();
            let line = bytes[..offset].iter().filter(|byte| **byte == b'\n').count() + 1;
            let byte = bytes.get(offset).copied().unwrap_or_default();
            Err(FileError::NotUtf8 { path: name, offset, line, byte })
        }
    }
}
