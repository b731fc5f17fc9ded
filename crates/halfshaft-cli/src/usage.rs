//! From the arguments to a command, or to a usage error that helps.

use std::ffi::OsString;

use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{CommandFactory, Parser};

use crate::args::{Arguments, Command};

/// The command that the arguments mean; prints help or a usage error and ends the program where
/// they mean none.
pub fn parse(arguments: &[OsString]) -> Command {
    let parsed = Arguments::try_parse_from(arguments).and_then(Arguments::complete);
    parsed.unwrap_or_else(|error| helpful(error, arguments).exit())
}

/// An unknown option is told with those that the command has. What clap proposes, to pass it as a
/// value behind `--`, is not what was meant: our values are files and words.
fn helpful(mut error: clap::Error, arguments: &[OsString]) -> clap::Error {
    if error.kind() != ErrorKind::UnknownArgument {
        return error;
    }
    error.remove(ContextKind::Suggested);
    let is_option = match error.get(ContextKind::InvalidArg) {
        Some(ContextValue::String(text)) => text.starts_with('-'),
        _ => false,
    };
    if !is_option || error.get(ContextKind::SuggestedArg).is_some() {
        return error;
    }
    let flags = flags_of(arguments.iter().skip(1).filter_map(|word| word.to_str()));
    if !flags.is_empty() {
        let tip = format!("the options here are {}", flags.join(", "));
        error.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![tip.into()]));
    }
    error
}

/// Long flags of the command that the arguments name, or of the program itself.
fn flags_of<'a>(arguments: impl Iterator<Item = &'a str>) -> Vec<String> {
    let program = Arguments::command();
    let mut words = arguments;
    let named = words.find_map(|word| program.find_subcommand(word));
    let command = named.unwrap_or(&program);
    let mut arguments: Vec<_> =
        command.get_arguments().filter(|argument| !argument.is_hide_set()).collect();
    // Its own options first, those of every question after them.
    arguments.sort_by_key(|argument| argument.get_help_heading().is_some());
    arguments.iter().filter_map(|argument| Some(format!("--{}", argument.get_long()?))).collect()
}
