//! Flags where they mean something, and usage errors that help. Source: the command contract.

mod common;

use common::{files, run};

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("temporary folder")
}

#[test]
fn a_flag_without_meaning_for_a_command_is_refused() {
    let folder = folder();
    for arguments in [
        &["new", "x.toml", "--set", "a.b=1"][..],
        &["new", "x.toml", "--json"],
        &["new", "x.toml", "--out", "y"],
        &["schema", "--json"],
        &["schema", "--set", "a.b=1"],
        &["completions", "bash", "--json"],
        &["man", "pages", "--out", "y"],
        &["--json", "new", "x.toml"],
        &["--out", "y", "man", "pages"],
        &["--set", "a.b=1", "schema"],
        &["run", "study.toml", "--set", "a.b=1"],
    ] {
        let result = run(folder.path(), arguments);
        assert_eq!(result.status, 2, "{arguments:?}: {}", result.err);
        assert!(result.out.is_empty(), "{arguments:?}: {}", result.out);
    }
    assert!(files(folder.path()).is_empty());
    for command in ["new", "schema", "completions", "man"] {
        let help = run(folder.path(), &[command, "--help"]).out;
        assert!(!help.contains("--set") && !help.contains("--json"), "{help}");
    }
}

#[test]
fn flags_mean_the_same_before_and_behind_the_command() {
    let folder = folder();
    let before = run(folder.path(), &["--json", "--set", "half-shaft.cubic=1", "static"]);
    let behind = run(folder.path(), &["static", "--json", "--set", "half-shaft.cubic=1"]);
    assert_eq!((before.status, &before.out), (0, &behind.out));
    assert_eq!(run(folder.path(), &["--quiet", "new"]).err, "");
    assert_eq!(run(folder.path(), &["--out", "a.json", "--quiet", "schema"]).out, "");
    assert_eq!(files(folder.path()), ["a.json", "line.toml"]);
}

// Source: the same text by two ways, printed and written.
#[test]
fn what_helpers_print_they_write_as_well() {
    let folder = folder();
    for command in [&["schema"][..], &["schema", "study"], &["completions", "fish"]] {
        let printed = run(folder.path(), command).out;
        let result = run(folder.path(), &[command, &["--out", "text"]].concat());
        assert_eq!(result.status, 0, "{}", result.err);
        assert!(result.err.contains("wrote text"), "{}", result.err);
        let written = std::fs::read_to_string(folder.path().join("text")).expect("written");
        assert_eq!(written, printed);
    }
}

#[test]
fn manual_pages_need_a_folder() {
    let folder = folder();
    let result = run(folder.path(), &["man"]);
    assert_eq!(result.status, 2);
    assert!(result.err.contains("<FOLDER>"), "{}", result.err);
    assert!(files(folder.path()).is_empty());
}

#[test]
fn an_unknown_option_is_told_with_those_that_there_are() {
    let folder = folder();
    let result = run(folder.path(), &["resonance", "--colour", "5"]);
    assert_eq!(result.status, 2);
    assert!(result.err.contains("--frequency, --parameter, --method"), "{}", result.err);
    assert!(!result.err.contains("-- --colour"), "{}", result.err);
    let near = run(folder.path(), &["resonance", "--frequenzy", "5"]);
    assert!(near.err.contains("'--frequency'"), "{}", near.err);
    let second = run(folder.path(), &["static", "a.toml", "b.toml"]);
    assert!(second.err.contains("'b.toml'") && !second.err.contains("options"), "{}", second.err);
}

// Source: the contract: "Every numeric key has one" address.
#[test]
fn harmonics_are_set_by_their_number() {
    let folder = folder();
    let text = common::example().replace(
        "amplitude = \"40 N·m\"\n",
        "amplitude = \"40 N·m\"\nharmonics = [ { order = 2, amplitude = 60 } ]\n",
    );
    std::fs::write(folder.path().join("line.toml"), text).expect("writes");
    let set = ["--set", "engine torque.harmonics.1.amplitude=7 N·m"];
    let result = run(folder.path(), &[&["check", "line.toml", "--json"][..], &set].concat());
    assert_eq!(result.status, 0, "{}", result.err);
    assert!(result.out.contains("7.0"), "{}", result.out);
    let swept = "engine torque.harmonics.1.amplitude=100..2000";
    let averaged = ["folds", "line.toml", "--method", "averaged"];
    let result =
        run(folder.path(), &[&averaged[..], &["--order", "2", "--parameter", swept]].concat());
    assert_eq!(result.status, 0, "{}", result.err);
}
