//! `halfshaft`, the command line of the workbench: parse, dispatch, exit.

mod args;
mod commands;
mod console;
mod diagnostics;
mod failure;
mod usage;
mod watch;

use std::process::ExitCode;

use args::Command;

fn main() -> ExitCode {
    let command = usage::parse();
    let watch = watch::Watch::start(command.is_quiet());
    let outcome = match &command {
        Command::Ask(ask) => commands::ask::run(ask, &watch),
        Command::Report(report) => commands::report::run(report, &watch),
        Command::Run(run) => commands::run::run(run, &watch),
        Command::Author(author) => commands::author::run(author),
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
