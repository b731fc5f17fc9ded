//! All of a file or nothing.

use std::io::Write;
use std::path::{Path, PathBuf};

/// Why a file could not be written.
#[derive(Debug, thiserror::Error)]
pub enum WriteError {
    /// The folder does not take a new file.
    #[error("cannot write in {}: {source}", folder.display())]
    Folder {
        /// The folder.
        folder: PathBuf,
        /// What the operating system said.
        source: std::io::Error,
    },
    /// Writing failed on the way, as on a full disk; nothing stands under the name.
    #[error("cannot write {}: {source}; nothing was left under that name", path.display())]
    Content {
        /// The file.
        path: PathBuf,
        /// What the operating system said.
        source: std::io::Error,
    },
    /// The finished file could not be given its name.
    #[error("cannot name the finished file {}: {source}", path.display())]
    Rename {
        /// The file.
        path: PathBuf,
        /// What the operating system said.
        source: std::io::Error,
    },
}

/// Writes a file by `fill`, all or nothing: under a temporary name in the same folder, then
/// flushed to the disk and renamed. An earlier file of that name stays until then.
///
/// # Errors
/// [`WriteError`]; the temporary file is removed and an earlier file of that name is whole.
pub fn write_atomically(
    path: &Path,
    fill: impl FnOnce(&mut dyn Write) -> std::io::Result<()>,
) -> Result<(), WriteError> {
    let folder = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent.to_path_buf(),
        _ => PathBuf::from("."),
    };
    if path.is_dir() {
        let source = std::io::Error::new(std::io::ErrorKind::IsADirectory, "is a folder");
        return Err(WriteError::Rename { path: path.to_path_buf(), source });
    }
    let file = tempfile::Builder::new()
        .prefix(".halfshaft-")
        .suffix(".tmp")
        .tempfile_in(&folder)
        .map_err(|source| WriteError::Folder { folder: folder.clone(), source })?;
    let content = |source| WriteError::Content { path: path.to_path_buf(), source };
    let mut writer = std::io::BufWriter::with_capacity(1 << 16, file);
    fill(&mut writer).map_err(content)?;
    let file = writer.into_inner().map_err(|error| content(error.into_error()))?;
    file.as_file().sync_all().map_err(content)?;
    allow_reading(file.as_file()).map_err(content)?;
    file.persist(path)
        .map(drop)
        .map_err(|error| WriteError::Rename { path: path.to_path_buf(), source: error.error })
}

/// Temporary files are private; a result is as readable as any other file of the user.
#[cfg(unix)]
fn allow_reading(file: &std::fs::File) -> std::io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    file.set_permissions(std::fs::Permissions::from_mode(0o644))
}

#[cfg(not(unix))]
fn allow_reading(_: &std::fs::File) -> std::io::Result<()> {
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failed_write_leaves_the_old_file_and_no_other() {
        let folder = tempfile::tempdir().expect("temporary folder");
        let path = folder.path().join("a.json");
        write_atomically(&path, |file| file.write_all(b"old")).expect("writes");
        let failed = write_atomically(&path, |file| {
            file.write_all(b"half of the ne")?;
            Err(std::io::Error::other("disk full"))
        });
        assert!(failed.is_err());
        assert_eq!(std::fs::read(&path).expect("still there"), b"old");
        assert_eq!(std::fs::read_dir(folder.path()).expect("readable").count(), 1);
    }
}
