//! Running other programs from the workspace's root.

use std::path::{Path, PathBuf};
use std::process::Command;

/// What a task ends with; an error is a sentence for the terminal.
pub type Outcome = Result<(), String>;

/// The workspace's root.
pub fn root() -> PathBuf {
    let own = Path::new(env!("CARGO_MANIFEST_DIR"));
    own.parent().unwrap_or(own).to_path_buf()
}

/// Folder that cargo builds into.
pub fn target() -> PathBuf {
    match std::env::var_os("CARGO_TARGET_DIR") {
        Some(folder) => PathBuf::from(folder),
        None => root().join("target"),
    }
}

/// A line that says which check comes.
pub fn heading(text: &str) {
    println!("\n== {text}");
}

/// Runs cargo in the root.
pub fn cargo(arguments: &[&str]) -> Outcome {
    cargo_with(arguments, &[])
}

/// Runs cargo in the root with environment variables.
pub fn cargo_with(arguments: &[&str], variables: &[(&str, &str)]) -> Outcome {
    let program = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(program);
    command.current_dir(root()).args(arguments).envs(variables.iter().copied());
    finish(&mut command, &format!("cargo {}", arguments.join(" ")))
}

/// Runs a command to its end; any status but 0 is an error.
pub fn finish(command: &mut Command, name: &str) -> Outcome {
    let status = command.status().map_err(|error| format!("{name}: {error}"))?;
    if status.success() { Ok(()) } else { Err(format!("{name} ended with {status}")) }
}

/// Whether a program answers to `--version`.
pub fn has(program: &str, arguments: &[&str]) -> bool {
    Command::new(program).args(arguments).output().is_ok_and(|output| output.status.success())
}

/// Installs a package of Debian; whether that could be done.
pub fn apt_install(package: &str) -> bool {
    let install = "apt-get update -qq && apt-get install -y -qq --no-install-recommends";
    Command::new("bash")
        .args(["-c", &format!("({install} {package}) >/dev/null 2>&1")])
        .status()
        .is_ok_and(|status| status.success())
}

/// The program itself, in release: built if need be.
pub fn halfshaft() -> Result<PathBuf, String> {
    cargo(&["build", "--release", "--quiet"])?;
    Ok(target().join("release").join(format!("halfshaft{}", std::env::consts::EXE_SUFFIX)))
}
