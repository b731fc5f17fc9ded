//! `halfshaft`, the command line of the workbench: parse, dispatch, exit.
//!
//! The program and the Python package's console script are both one call of [`run`].

mod args;
mod commands;
mod console;
mod diagnostics;
mod failure;
mod usage;
mod watch;

use std::ffi::OsString;

use args::Command;

/// Does what the arguments say, the program's name first, and returns the exit status: 0 done, 1 the
/// analysis could not be carried out, 2 bad input. Help and usage errors end the process themselves.
#[must_use]
pub fn run(arguments: &[OsString]) -> u8 {
    let command = usage::parse(arguments);
    let watch = watch::Watch::start(command.is_quiet());
    let outcome = match &command {
        Command::Ask(ask) => commands::ask::run(ask, &watch),
        Command::Report(report) => commands::report::run(report, &watch),
        Command::Run(run) => commands::run::run(run, &watch),
        Command::Author(author) => commands::author::run(author),
    };
    watch.finish();
    match outcome {
        Ok(()) => 0,
        Err(failure) => {
            console::complain(&failure);
            failure.exit_status()
        }
    }
}
