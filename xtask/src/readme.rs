//! The README's commands, run word for word, with the output that it shows.
//!
//! In a block marked `console`, a line `$ command` is run and the lines under it must be its
//! output; a line `[...]` stands for lines left out. `cargo xtask generate` writes the output anew.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::run::{Outcome, halfshaft, root, target};

const PAGES: &[&str] = &["README.md"];
const LEFT_OUT: &str = "[...]";

/// A command of a page with the output under it.
struct Session {
    page: &'static str,
    line: usize,
    command: String,
    shown: Vec<String>,
}

/// Runs every command of every page and compares.
pub fn check() -> Outcome {
    let mut wrong = Vec::new();
    let mut count = 0;
    let folder = fresh_folder()?;
    for page in PAGES {
        for session in sessions(page)? {
            count += 1;
            let output = play(&session.command, &folder)?;
            if !fits(&session.shown, &output) {
                let place = format!("{}:{}", session.page, session.line);
                wrong.push(format!("{place}: {}\n{}", session.command, output.join("\n")));
            }
        }
    }
    if wrong.is_empty() {
        println!("README: {count} commands did what it shows");
        return Ok(());
    }
    Err(format!(
        "run `cargo xtask generate`, the README shows other output than:\n{}",
        wrong.join("\n\n")
    ))
}

/// Writes the output of every command into the pages; where lines are left out, as many lines
/// before and after as are shown now.
pub fn update() -> Outcome {
    let folder = fresh_folder()?;
    for page in PAGES {
        let path = root().join(page);
        let text = fs::read_to_string(&path).map_err(|error| format!("{page}: {error}"))?;
        let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
        // Played in order, since later commands use what earlier ones made; written from the end,
        // so that line numbers stay right.
        let mut played = Vec::new();
        for session in sessions(page)? {
            let output = play(&session.command, &folder)?;
            played.push((session, output));
        }
        for (session, output) in played.into_iter().rev() {
            let from = session.line;
            let new = abridged(&session.shown, output);
            lines.splice(from..from + session.shown.len(), new);
        }
        fs::write(&path, lines.join("\n") + "\n").map_err(|error| format!("{page}: {error}"))?;
    }
    Ok(())
}

/// Output with lines left out where they were left out before.
fn abridged(shown: &[String], output: Vec<String>) -> Vec<String> {
    let Some(cut) = shown.iter().position(|line| line == LEFT_OUT) else { return output };
    let tail = shown.len() - cut - 1;
    if output.len() <= cut + tail {
        return output;
    }
    let mut short = output[..cut].to_vec();
    short.push(LEFT_OUT.to_owned());
    short.extend_from_slice(&output[output.len() - tail..]);
    short
}

fn fresh_folder() -> Result<PathBuf, String> {
    let folder = target().join("readme");
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    Ok(folder)
}

fn sessions(page: &'static str) -> Result<Vec<Session>, String> {
    let text = fs::read_to_string(root().join(page)).map_err(|error| format!("{page}: {error}"))?;
    let mut sessions: Vec<Session> = Vec::new();
    let mut inside = false;
    for (number, line) in text.lines().enumerate() {
        if line.starts_with("```") {
            inside = line == "```console";
        } else if let Some(command) = line.strip_prefix("$ ").filter(|_| inside) {
            let command = command.to_owned();
            sessions.push(Session { page, line: number + 1, command, shown: Vec::new() });
        } else if let Some(session) = sessions.last_mut().filter(|_| inside) {
            session.shown.push(line.to_owned());
        }
    }
    Ok(sessions)
}

/// Runs a command and returns the lines that a terminal would show.
fn play(command: &str, folder: &Path) -> Result<Vec<String>, String> {
    let program = halfshaft()?;
    let path = format!(
        "{}:{}",
        program.parent().unwrap_or(&program).display(),
        std::env::var("PATH").unwrap_or_default()
    );
    // What begins with cargo is meant for the root of a clone.
    let place = if command.starts_with("cargo") { root() } else { folder.to_path_buf() };
    let examples = folder.join("examples");
    if !examples.exists() {
        copy(&root().join("examples"), &examples)?;
    }
    let output = Command::new("bash")
        .args(["-c", &format!("{command} 2>&1")])
        .current_dir(place)
        .env("PATH", path)
        .env("NO_COLOR", "1")
        .env("CARGO_TERM_QUIET", "true")
        .output()
        .map_err(|error| format!("{command}: {error}"))?;
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    Ok(text.lines().map(|line| line.trim_end().to_owned()).collect())
}

/// The examples as a user of the README has them in the folder of the clone.
fn copy(from: &Path, to: &Path) -> Outcome {
    let failed = |error: std::io::Error| format!("{}: {error}", from.display());
    fs::create_dir_all(to).map_err(failed)?;
    for entry in fs::read_dir(from).map_err(failed)?.flatten() {
        let target = to.join(entry.file_name());
        if entry.path().is_dir() {
            copy(&entry.path(), &target)?;
        } else {
            fs::copy(entry.path(), target).map_err(failed)?;
        }
    }
    Ok(())
}

fn fits(shown: &[String], output: &[String]) -> bool {
    match shown.iter().position(|line| line == LEFT_OUT) {
        None => shown == output,
        Some(cut) => {
            let (head, tail) = (&shown[..cut], &shown[cut + 1..]);
            output.len() >= head.len() + tail.len()
                && output.starts_with(head)
                && output.ends_with(tail)
        }
    }
}
