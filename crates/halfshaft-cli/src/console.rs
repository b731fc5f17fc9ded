//! All that the program prints: answers to standard output, complaints to standard error.

use std::io::{ErrorKind, Write};

use crate::diagnostics;
use crate::failure::Failure;

/// Prints text to standard output.
///
/// # Errors
/// [`Failure::ReaderGone`] where the reader has closed the pipe, [`Failure::Output`] where
/// writing fails otherwise (a full disk).
pub fn say(text: &str) -> Result<(), Failure> {
    let mut out = std::io::stdout().lock();
    let written = out.write_all(text.as_bytes()).and_then(|()| out.flush());
    written.map_err(|error| match error.kind() {
        ErrorKind::BrokenPipe => Failure::ReaderGone,
        _ => Failure::Output {
            message: format!("cannot write to standard output: {error}"),
            advice: None,
        },
    })
}

/// Prints a line to standard error; if even that fails there is nobody to tell.
pub fn note(text: &str) {
    let _ = writeln!(std::io::stderr().lock(), "{text}");
}

/// Prints a warning to standard error.
pub fn warn(text: &str) {
    note(&format!("warning: {text}"));
}

/// Explains a failure on standard error.
pub fn complain(failure: &Failure) {
    match failure {
        Failure::ReaderGone => {}
        Failure::Diagnostics(found) => note(&diagnostics::render(found)),
        Failure::Options(errors) => {
            for error in errors {
                let written = Some(&error.text).filter(|text| !text.is_empty());
                let written = written.map_or_else(String::new, |text| format!(" \"{text}\""));
                note(&format!("error: --{}{written}: {}", error.option, error.message));
                hint(Some(&error.hint).filter(|hint| !hint.is_empty()));
            }
        }
        Failure::Input { message, advice }
        | Failure::Analysis { message, advice }
        | Failure::Output { message, advice } => {
            note(&format!("error: {message}"));
            hint(advice.as_ref());
        }
    }
}

fn hint(text: Option<&String>) {
    if let Some(text) = text {
        note(&format!("  hint: {text}"));
    }
}
