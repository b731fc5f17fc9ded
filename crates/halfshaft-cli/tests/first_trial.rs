//! What a first-time user stumbled over. Source: the notes of a first trial of the program.

mod common;

use common::run;

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("temporary folder")
}

#[test]
fn the_wrong_kind_of_file_is_told_with_the_right_command() {
    let folder = folder();
    let study = "format = 1\nname = \"s\"\n[[question]]\nname = \"a\"\nask = \"static\"\n";
    std::fs::write(folder.path().join("study.toml"), study).expect("writes");
    std::fs::write(folder.path().join("model.toml"), common::example()).expect("writes");
    for (arguments, words) in [
        (["run", "model.toml"], ["this is a model file", "`halfshaft check model.toml`"]),
        (["check", "study.toml"], ["this is a study file", "`halfshaft run study.toml`"]),
    ] {
        let result = run(folder.path(), &arguments);
        assert_eq!(result.status, 2, "{}", result.err);
        assert!(words.iter().all(|word| result.err.contains(word)), "{}", result.err);
        assert_eq!(result.err.matches("error").count(), 1, "{}", result.err);
    }
    let result = run(folder.path(), &["static", "nofile.toml"]);
    assert!(result.err.contains("`halfshaft new nofile.toml`"), "{}", result.err);
}

#[test]
fn options_take_the_units_and_ranges_that_users_write() {
    let folder = folder();
    for speed in ["1000 U/min", "1000 1/min", "1000 rpm"] {
        let question = ["simulate", "--duration", "10ms", "--frequency", speed, "--quiet"];
        let result = run(folder.path(), &question);
        assert_eq!(result.status, 0, "{speed}: {}", result.err);
    }
    for setting in ["gearbox.ratio=3.5:1", "engine torque.mean=150 lb-ft"] {
        let result = run(folder.path(), &["check", "--quiet", "--set", setting]);
        assert_eq!(result.status, 0, "{setting}: {}", result.err);
    }
    let result = run(folder.path(), &["simulate", "--record", "2..1"]);
    assert!(result.err.contains("did you mean \"1..2\"?"), "{}", result.err);
}

#[test]
fn words_to_choose_from_stand_in_help_and_completions() {
    let folder = folder();
    for (command, words) in [
        ("simulate", &["rest, equilibrium"][..]),
        (
            "shock",
            &["full, clamped, published, multiple-scales", "1, 2", "published, clamped, twist"],
        ),
        ("resonance", &["harmonic-balance, first-harmonic, averaged", "monodromy, hill"]),
        ("folds", &["harmonic-balance, first-harmonic, averaged"]),
    ] {
        let help = run(folder.path(), &[command, "--help"]).out;
        for words in words {
            assert!(help.contains(&format!("[possible values: {words}]")), "no {words}:\n{help}");
        }
    }
    let completions = run(folder.path(), &["completions", "bash"]).out;
    for words in ["full clamped published multiple-scales", "rest equilibrium", "1 2"] {
        assert!(completions.contains(&format!("compgen -W \"{words}\"")), "no {words}");
    }
    // A wrong word is told by the reader of questions, as before.
    let result = run(folder.path(), &["simulate", "--start", "rset", "--duration", "5kg"]);
    assert!(result.err.contains("did you mean \"rest\"?"), "{}", result.err);
    assert!(result.err.contains("5kg"), "{}", result.err);
    let result = run(folder.path(), &["folds", "--method", "first-harmonik"]);
    assert!(result.err.contains("did you mean \"first-harmonic\"?"), "{}", result.err);
}

#[test]
fn manual_pages_name_values_and_exit_statuses() {
    let folder = folder();
    assert_eq!(run(folder.path(), &["man", "pages", "--quiet"]).status, 0);
    for page in ["halfshaft.1", "halfshaft-static.1", "halfshaft-run.1"] {
        let text =
            std::fs::read_to_string(folder.path().join("pages").join(page)).expect("is there");
        assert!(text.contains(".SH \"EXIT STATUS\""), "{page}: {text}");
        assert!(text.contains("\\-\\-out\\fR \\fIFILE_OR_FOLDER\\fR]"), "{page}: {text}");
    }
    let text = std::fs::read_to_string(folder.path().join("pages/halfshaft-static.1"));
    let text = text.expect("is there");
    assert!(text.contains("\\-\\-set\\fR \\fIADDRESS=VALUE\\fR]..."), "{text}");
    assert!(text.contains("[\\fIMODEL\\fR]"), "{text}");
}
