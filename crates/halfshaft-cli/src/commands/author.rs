//! `new`, `schema`, `completions`, `man`: helpers that ask no question.

use std::path::Path;

use clap::CommandFactory;
use halfshaft::model::format::{MODEL, json_schema, reference_page};
use halfshaft::model::{embedded, study};
use halfshaft::results::io::write_atomically;

use super::manual;
use crate::args::{Arguments, Author, Folder, New, Printed};
use crate::console;
use crate::failure::Failure;

/// Runs a helper.
pub fn run(author: &Author) -> Result<(), Failure> {
    match author {
        Author::New(new) => new_file(new),
        Author::Schema(schema) => {
            let text = match schema.of.as_str() {
                "study" => json_schema(&study::STUDY, "halfshaft study"),
                _ => json_schema(&MODEL, "halfshaft model"),
            };
            print(&format!("{text:#}\n"), &schema.printed)
        }
        Author::Completions(completions) => {
            let mut text = Vec::new();
            let mut command = Arguments::command();
            clap_complete::generate(completions.shell, &mut command, "halfshaft", &mut text);
            print(&String::from_utf8_lossy(&text), &completions.printed)
        }
        Author::Man(folder) => manual(folder),
        Author::Reference(folder) => reference(&folder.folder),
    }
}

/// Prints a text, or writes it where that was asked for.
fn print(text: &str, printed: &Printed) -> Result<(), Failure> {
    let Some(path) = &printed.out else { return console::say(text) };
    save(path, text.as_bytes())?;
    if !printed.quiet.quiet {
        console::note(&format!("wrote {}", path.display()));
    }
    Ok(())
}

fn new_file(new: &New) -> Result<(), Failure> {
    if new.file.exists() && !new.force {
        return Err(Failure::Input {
            message: format!("{} is there already", new.file.display()),
            advice: Some("name another file, or overwrite it with --force".to_owned()),
        });
    }
    save(&new.file, embedded::starter().as_bytes())?;
    if !new.quiet.quiet {
        let name = new.file.display();
        console::note(&format!("wrote {name}; next: halfshaft check {name}"));
    }
    Ok(())
}

/// One page for the program and one for each command.
fn manual(Folder { folder, quiet }: &Folder) -> Result<(), Failure> {
    let io = |error: std::io::Error| Failure::Output {
        message: format!("cannot write in {}: {error}", folder.display()),
        advice: None,
    };
    std::fs::create_dir_all(folder).map_err(io)?;
    let mut program = Arguments::command();
    program.build();
    let mut pages = vec![("halfshaft".to_owned(), program.clone())];
    for command in program
        .get_subcommands()
        .filter(|command| command.get_name() != "help" && !command.is_hide_set())
    {
        let name = format!("halfshaft-{}", command.get_name());
        pages.push((name.clone(), command.clone().name(name.leak() as &'static str)));
    }
    for (name, command) in pages {
        let text = manual::page(&command).map_err(io)?;
        save(&folder.join(format!("{name}.1")), &text)?;
    }
    if !quiet.quiet {
        console::note(&format!("wrote the manual pages into {}", folder.display()));
    }
    Ok(())
}

/// Reference pages of the files and of the commands.
fn reference(folder: &Path) -> Result<(), Failure> {
    let pages = [
        ("model-file.md", reference_page(&MODEL, "The model file")),
        ("study-file.md", reference_page(&study::STUDY, "The study file")),
        ("commands.md", commands_page()),
    ];
    for (name, text) in pages {
        save(&folder.join(name), text.as_bytes())?;
    }
    Ok(())
}

/// The help of every command on one page.
fn commands_page() -> String {
    let mut program = Arguments::command().term_width(96).disable_help_subcommand(true);
    program.build();
    let mut page = format!("# Commands\n\n```text\n{}```\n", program.render_long_help());
    for command in program.get_subcommands_mut().filter(|command| !command.is_hide_set()) {
        let name = command.get_name().to_owned();
        let help = command.render_long_help().to_string();
        let help: Vec<&str> = help.lines().map(str::trim_end).collect();
        page += &format!("\n## `halfshaft {name}`\n\n```text\n{}\n```\n", help.join("\n"));
    }
    page
}

fn save(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    write_atomically(path, |file| file.write_all(bytes))
        .map_err(|error| Failure::Output { message: error.to_string(), advice: None })
}
