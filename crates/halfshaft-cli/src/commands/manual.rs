//! Manual pages.

use std::io::Error;

use clap::{Arg, ArgAction, Command};
use clap_mangen::Man;
use clap_mangen::roff::{Roff, bold, italic, roman};

/// The statuses that every command ends with.
const STATUSES: [(&str, &str); 3] = [
    ("0", "The question is answered."),
    ("1", "The analysis could not be carried out or ended early, or the answer not be written."),
    ("2", "Bad input or usage; nothing was computed."),
];

/// The manual page of a command: what clap_mangen writes, with a synopsis that names the values and
/// a section of exit statuses, which it does not have.
pub fn page(command: &Command) -> Result<Vec<u8>, Error> {
    let man = Man::new(command.clone());
    let mut text = Vec::new();
    man.render_title(&mut text)?;
    man.render_name_section(&mut text)?;
    synopsis(command).to_writer(&mut text)?;
    man.render_description_section(&mut text)?;
    man.render_options_section(&mut text)?;
    if command.has_subcommands() {
        man.render_subcommands_section(&mut text)?;
    }
    exit_statuses().to_writer(&mut text)?;
    if command.get_after_help().is_some() {
        man.render_extra_section(&mut text)?;
    }
    if command.get_version().is_some() {
        man.render_version_section(&mut text)?;
    }
    Ok(text)
}

fn synopsis(command: &Command) -> Roff {
    let name = command.get_bin_name().unwrap_or_else(|| command.get_name());
    let mut line = vec![bold(name)];
    let shown = || command.get_arguments().filter(|argument| !argument.is_hide_set());
    for option in shown().filter(|argument| !argument.is_positional()) {
        let short = option.get_short().map(|short| format!("-{short}"));
        let long = option.get_long().map(|long| format!("--{long}"));
        let names: Vec<String> = short.into_iter().chain(long).collect();
        line.extend([roman(" ["), bold(names.join("|"))]);
        if option.get_action().takes_values() {
            line.extend([roman(" "), italic(value_name(option))]);
        }
        let repeatable = matches!(option.get_action(), ArgAction::Append);
        line.push(roman(if repeatable { "]..." } else { "]" }));
    }
    for value in shown().filter(|argument| argument.is_positional()) {
        let (before, behind) = if value.is_required_set() { (" ", "") } else { (" [", "]") };
        line.extend([roman(before), italic(value_name(value)), roman(behind)]);
    }
    if command.has_subcommands() {
        line.extend([roman(" "), italic("COMMAND")]);
    }
    let mut roff = Roff::new();
    roff.control("SH", ["SYNOPSIS"]).text(line);
    roff
}

fn value_name(argument: &Arg) -> String {
    let names = argument.get_value_names().unwrap_or_default();
    let names: Vec<&str> = names.iter().map(clap::builder::Str::as_str).collect();
    if names.is_empty() { argument.get_id().as_str().to_uppercase() } else { names.join(" ") }
}

fn exit_statuses() -> Roff {
    let mut roff = Roff::new();
    roff.control("SH", ["EXIT STATUS"]);
    for (status, meaning) in STATUSES {
        roff.control("TP", []).text([bold(status)]).text([roman(meaning)]);
    }
    roff
}
