//! House rules as code: what the compiler and clippy do not see.

use std::fs;
use std::path::{Path, PathBuf};

use crate::run::{Outcome, root};

/// Longest source file, tests and coefficient tables left out.
const LONGEST_FILE: usize = 450;
/// Longest function, signature and braces included.
const LONGEST_FUNCTION: usize = 80;

/// Layers from the bottom; a crate may use those before it, and no other.
const LAYERS: &[(&str, &[&str])] = &[
    ("halfshaft-numerics", &[]),
    ("halfshaft-model", &[]),
    ("halfshaft-results", &[]),
    ("halfshaft-dynamics", &["halfshaft-numerics", "halfshaft-model"]),
    (
        "halfshaft-analysis",
        &["halfshaft-numerics", "halfshaft-model", "halfshaft-dynamics", "halfshaft-results"],
    ),
    ("halfshaft-present", &["halfshaft-results"]),
    ("halfshaft-parquet", &["halfshaft-results"]),
    (
        "halfshaft",
        &[
            "halfshaft-numerics",
            "halfshaft-model",
            "halfshaft-analysis",
            "halfshaft-results",
            "halfshaft-present",
        ],
    ),
    ("halfshaft-cli", &["halfshaft"]),
    ("halfshaft-py", &["halfshaft", "halfshaft-cli"]),
];

/// Checks all rules and lists every breach.
pub fn run() -> Outcome {
    let mut breaches = Vec::new();
    check_layers(&mut breaches);
    for file in sources(&root()) {
        check_source(&file, &mut breaches);
    }
    check_architecture(&mut breaches);
    check_examples(&mut breaches);
    if breaches.is_empty() {
        println!("house rules: kept");
        return Ok(());
    }
    breaches.sort();
    Err(format!("house rules are broken:\n  {}", breaches.join("\n  ")))
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_default()
}

fn name_of(path: &Path) -> String {
    path.strip_prefix(root()).unwrap_or(path).display().to_string()
}

/// Crates depend on each other in one direction only.
fn check_layers(breaches: &mut Vec<String>) {
    for (name, allowed) in LAYERS {
        let manifest = read(&root().join("crates").join(name).join("Cargo.toml"));
        let normal = manifest.split("[dev-dependencies]").next().unwrap_or_default();
        let dependencies = normal.split("[dependencies]").nth(1).unwrap_or_default();
        for line in dependencies.lines() {
            let used = line.split(['=', '.']).next().unwrap_or_default().trim();
            if used.starts_with("halfshaft") && !allowed.contains(&used) {
                breaches.push(format!("crates/{name} must not depend on {used}"));
            }
        }
    }
    let folders = fs::read_dir(root().join("crates")).into_iter().flatten().flatten();
    for folder in folders.map(|entry| entry.file_name().to_string_lossy().into_owned()) {
        if !LAYERS.iter().any(|(name, _)| *name == folder) {
            breaches
                .push(format!("crates/{folder} has no place in the layers of xtask/src/tidy.rs"));
        }
    }
}

/// All Rust files of the project.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        let name = entry.file_name().to_string_lossy().into_owned();
        if path.is_dir() && !name.starts_with('.') && name != "target" {
            files.extend(sources(&path));
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            files.push(path);
        }
    }
    files
}

fn check_source(path: &Path, breaches: &mut Vec<String>) {
    let text = read(path);
    let name = name_of(path);
    if !text.starts_with("//!") && !text.starts_with("#!") {
        breaches.push(format!("{name}: does not begin with what it is (//!)"));
    }
    let in_tests = ["/tests/", "/benches/", "/examples/"].iter().any(|part| name.contains(part));
    if in_tests || name.ends_with("tests.rs") {
        return;
    }
    let code = text.split("#[cfg(test)]\nmod tests").next().unwrap_or_default();
    let lines = code.lines().count();
    if lines > LONGEST_FILE && !name.ends_with("tableau.rs") {
        breaches.push(format!("{name}: {lines} lines, {LONGEST_FILE} are allowed"));
    }
    check_functions(&name, code, breaches);
    if code.contains(concat!(".unwrap", "()")) {
        breaches.push(format!("{name}: unwrap outside tests"));
    }
}

/// Lines of each function, which rustfmt closes at the indentation at which it opens.
fn check_functions(name: &str, code: &str, breaches: &mut Vec<String>) {
    let lines: Vec<&str> = code.lines().collect();
    for (start, line) in lines.iter().enumerate() {
        let body = line.trim_start();
        let words =
            ["fn ", "pub fn ", "pub(crate) fn ", "pub(super) fn ", "const fn ", "pub const fn "];
        let Some(signature) = words.iter().find_map(|word| body.strip_prefix(word)) else {
            continue;
        };
        let close = format!("{}}}", &line[..line.len() - body.len()]);
        let length = lines[start..].iter().position(|line| *line == close);
        if let Some(length) = length.filter(|length| *length + 1 > LONGEST_FUNCTION) {
            let function = signature.split(['(', '<']).next().unwrap_or_default();
            breaches.push(format!(
                "{name}:{}: {function} has {} lines, {LONGEST_FUNCTION} are allowed",
                start + 1,
                length + 1
            ));
        }
    }
}

/// The architecture page names every crate and every question's folder.
fn check_architecture(breaches: &mut Vec<String>) {
    let page = read(&root().join("ARCHITECTURE.md"));
    let mut must_stand: Vec<String> = LAYERS.iter().map(|(name, _)| (*name).to_owned()).collect();
    for folder in ["crates/halfshaft-analysis/src", "crates/halfshaft-present/src"] {
        let entries = fs::read_dir(root().join(folder)).into_iter().flatten().flatten();
        let folders = entries.filter(|entry| entry.path().is_dir());
        must_stand.extend(folders.map(|entry| entry.file_name().to_string_lossy().into_owned()));
    }
    for name in must_stand {
        if !page.contains(&format!("`{name}`")) {
            breaches.push(format!("ARCHITECTURE.md does not mention `{name}`"));
        }
    }
}

/// The example's models are the embedded ones.
fn check_examples(breaches: &mut Vec<String>) {
    let pairs =
        [("two-mass-driveline.toml", "driveline.toml"), ("scaled-oscillator.toml", "scaled.toml")];
    for (embedded, example) in pairs {
        let embedded = root().join("crates/halfshaft-model/models").join(embedded);
        let example = root().join("examples/two-mass-driveline").join(example);
        if read(&embedded) != read(&example) {
            breaches.push(format!("{} and {} differ", name_of(&embedded), name_of(&example)));
        }
    }
}
