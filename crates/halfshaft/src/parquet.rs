//! Parquet files by the program `halfshaft-parquet`.
//!
//! Parquet compiles for long, so it is a program of its own that takes an answer as JSON; without
//! it halfshaft is whole but for this one form.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use halfshaft_results::{Answer, io::write_json};

/// Name of the program.
const NAME: &str = "halfshaft-parquet";

/// The Parquet writer, beside this program or in the PATH.
pub(crate) fn writer() -> Option<PathBuf> {
    let name = format!("{NAME}{}", std::env::consts::EXE_SUFFIX);
    let beside = std::env::current_exe().ok()?.with_file_name(&name);
    if beside.is_file() {
        return Some(beside);
    }
    let path = std::env::var_os("PATH")?;
    std::env::split_paths(&path).map(|folder| folder.join(&name)).find(|file| file.is_file())
}

/// Has the answer written to `path`, all or nothing. The error is a whole sentence, mostly the
/// writer's own.
pub(crate) fn write(writer: &Path, answer: &Answer, path: &Path) -> Result<(), String> {
    send(writer, answer, path)
        .map_err(|error| format!("cannot use {}: {error}", writer.display()))?
        .map_err(|complaint| complaint.trim().trim_start_matches("error: ").to_owned())
}

/// Runs the writer; its complaint where it has one.
fn send(writer: &Path, answer: &Answer, path: &Path) -> std::io::Result<Result<(), String>> {
    let mut child = Command::new(writer)
        .arg(path)
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()?;
    let mut sent = Ok(());
    if let Some(input) = child.stdin.take() {
        let mut input = std::io::BufWriter::new(input);
        sent = write_json(answer, &mut input).and_then(|()| input.flush());
    }
    // The child's own complaint says more than a pipe that it closed.
    let output = child.wait_with_output()?;
    if output.status.success() {
        return sent.map(Ok);
    }
    Ok(Err(String::from_utf8_lossy(&output.stderr).into_owned()))
}
