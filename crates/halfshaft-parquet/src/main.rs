//! `halfshaft-parquet`: Parquet files of halfshaft's answers.
//!
//! `halfshaft-parquet FILE.parquet < answer.json` writes, `halfshaft-parquet --json FILE.parquet`
//! prints the answer back. `halfshaft ... --out FILE.parquet` calls the first form.

use std::io::{Read, Write};
use std::path::Path;
use std::process::ExitCode;

use halfshaft_parquet::{from_bytes, to_bytes};
use halfshaft_results::io::{from_json, write_atomically, write_json};

const USAGE: &str = "usage: halfshaft-parquet FILE.parquet < answer.json
       halfshaft-parquet --json FILE.parquet > answer.json
";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let outcome = match words.as_slice() {
        ["--help" | "-h"] => return say(USAGE),
        ["--version" | "-V"] => {
            return say(concat!("halfshaft-parquet ", env!("CARGO_PKG_VERSION"), "\n"));
        }
        ["--json", path] => print(Path::new(path)),
        [path] if !path.starts_with('-') => write(Path::new(path)),
        _ => {
            complain(USAGE);
            return ExitCode::from(2);
        }
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            complain(&format!("error: {message}\n"));
            ExitCode::from(1)
        }
    }
}

fn write(path: &Path) -> Result<(), String> {
    let mut text = String::new();
    std::io::stdin().read_to_string(&mut text).map_err(|error| error.to_string())?;
    let answer = from_json(&text).map_err(|error| error.to_string())?;
    let bytes = to_bytes(&answer).map_err(|error| error.to_string())?;
    write_atomically(path, |file| file.write_all(&bytes)).map_err(|error| error.to_string())
}

fn print(path: &Path) -> Result<(), String> {
    let bytes = std::fs::read(path).map_err(|error| format!("{}: {error}", path.display()))?;
    let answer = from_bytes(bytes).map_err(|error| error.to_string())?;
    write_json(&answer, std::io::stdout().lock()).map_err(|error| error.to_string())
}

fn say(text: &str) -> ExitCode {
    // Who closes our output early has read enough.
    let _ = std::io::stdout().write_all(text.as_bytes());
    ExitCode::SUCCESS
}

fn complain(text: &str) {
    let _ = std::io::stderr().write_all(text.as_bytes());
}
