//! `halfshaft`, the command line of the workbench: parse, dispatch, exit.

mod args;
mod commands;
mod console;
mod diagnostics;
mod failure;
mod watch;

use std::process::ExitCode;

use clap::Parser;

use args::{Arguments, Command};

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let watch = watch::Watch::start(arguments.common.quiet);
    let common = &arguments.common;
    let outcome = match &arguments.command {
        Command::Ask(ask) => commands::ask::run(ask, common, &watch),
        Command::Report(report) => commands::report::run(report, common, &watch),
        Command::Run(run) => commands::run::run(run, common, &watch),
        Command::Author(author) => commands::author::run(author, common),
    };
    watch.finish();
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            console::complain(&failure);
            failure.exit_code()
        }
    }
}
