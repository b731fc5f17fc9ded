//! Bad input through the binary: message, exit status, no partial output.

mod common;

use common::{Run, example, files, run};
use std::path::Path;

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("temporary folder")
}

/// Asks `static` about a model text with an output file, and checks that nothing was written.
fn refused(text: &[u8]) -> Run {
    let folder = folder();
    std::fs::write(folder.path().join("line.toml"), text).expect("writes");
    let result = run(folder.path(), &["static", "line.toml", "--out", "answer.json"]);
    assert_eq!(result.status, 2, "{}", result.err);
    assert_eq!(files(folder.path()), ["line.toml"], "nothing else may be there");
    assert!(result.out.is_empty(), "{}", result.out);
    assert!(!result.err.contains("panicked"), "{}", result.err);
    result
}

/// A model with one text replaced must be refused with all these words.
#[track_caller]
fn refused_with(from: &str, to: &str, words: &[&str]) {
    let text = example();
    assert!(text.contains(from), "the example has {from}");
    let result = refused(text.replacen(from, to, 1).as_bytes());
    for word in words {
        assert!(result.err.contains(word), "no {word:?} in:\n{}", result.err);
    }
}

#[test]
fn mistakes_in_the_model_are_shown_where_they_stand() {
    // (text, replacement, words of the complaint)
    let cases: &[(&str, &str, &[&str])] = &[
        (
            "\"6420 N·m/rad\"",
            "\"6420 N·m\"",
            &["line.toml:", "\"6420 N·m\"", "torsional stiffness", "N·m/rad, N·m/deg"],
        ),
        ("\"6420 N·m/rad\"", "\"6420\"", &["the unit is missing", "6420 N·m/rad"]),
        ("\"6420 N·m/rad\"", "\"6420 N·m/rda\"", &["unknown unit \"rda\"", "did you mean \"rad\""]),
        ("damping =", "dampening =", &["unknown key \"dampening\"", "did you mean \"damping\""]),
        ("to = \"vehicle\"", "to = \"vehikle\"", &["\"vehikle\"", "did you mean \"vehicle\""]),
        ("name = \"final drive\"", "name = \"gearbox\"", &["two elements", "first named here"]),
        ("\"81.6 kg·m²\"", "\"0 kg·m²\"", &["more than zero"]),
        ("\"81.6 kg·m²\"", "-1", &["more than zero"]),
        ("\"81.6 kg·m²\"", "nan", &["finite"]),
        ("\"81.6 kg·m²\"", "\"inf kg·m²\"", &["finite"]),
        ("ratio = 5.71", "ratio = 0", &["not be zero"]),
        ("format = 1", "format = 2", &["this version reads format = 1"]),
        ("name = \"half-shaft\"\n", "name = \"half-shaft\nfrom", &["line.toml:"]),
    ];
    for (from, to, words) in cases {
        refused_with(from, to, words);
    }
}

#[test]
fn a_contradictory_gear_loop_is_told_with_both_ratios() {
    let text = example()
        + "\n[[gear]]\nname = \"bypass\"\ninput = \"engine\"\noutput = \"half-shaft flange\"\nratio = 6\n";
    let result = refused(text.as_bytes());
    for words in ["contradicts", "asks 6", "give 5.71", "ratio of \"gearbox\""] {
        assert!(result.err.contains(words), "{}", result.err);
    }
}

#[test]
fn a_floating_part_is_told_by_name() {
    let text = example() + "\n[[inertia]]\nname = \"spare wheel\"\ninertia = 1\n";
    let result = refused(text.as_bytes());
    assert!(result.err.contains("\"spare wheel\" floats"), "{}", result.err);
}

#[test]
fn all_mistakes_are_told_at_once() {
    let text = example()
        .replace("\"6420 N·m/rad\"", "\"6420 N·m\"")
        .replace("\"0.328 kg·m²\"", "0")
        .replace("mean = \"850 N·m\"", "meen = \"850 N·m\"");
    let result = refused(text.as_bytes());
    assert!(result.err.contains("3 errors"), "{}", result.err);
    // Values, names and nodes together, and of a node whose inertia is unsound its name.
    let text = example()
        .replace("\"81.6 kg·m²\"", "0")
        .replace("to = \"vehicle\"", "to = \"vehcile\"")
        .replace("name = \"final drive\"", "name = \"gearbox\"");
    let result = refused(text.as_bytes());
    for words in ["more than zero", "did you mean \"vehicle\"", "two elements", "3 errors"] {
        assert!(result.err.contains(words), "no {words:?} in {}", result.err);
    }
}

#[test]
fn empty_binary_and_huge_files_are_refused() {
    assert!(refused(b"").err.contains("empty"));
    assert!(refused(b"\n \n").err.contains("empty"));
    let mut latin = example().into_bytes();
    latin.insert(40, 0xB2);
    let result = refused(&latin);
    assert!(result.err.contains("not UTF-8") && result.err.contains("0xB2"), "{}", result.err);
    assert!(refused(b"\0\0\0\0").err.contains("line.toml"));
    assert!(refused("[".repeat(100_000).as_bytes()).err.contains("line.toml"));

    let folder = folder();
    let file = std::fs::File::create(folder.path().join("huge.toml")).expect("creates");
    file.set_len(100 << 20).expect("sparse");
    let result = run(folder.path(), &["static", "huge.toml"]);
    assert_eq!(result.status, 2);
    assert!(result.err.contains("100 MB"), "{}", result.err);
    let result = run(folder.path(), &["static", "missing.toml"]);
    assert_eq!(result.status, 2);
    assert!(result.err.contains("cannot read missing.toml"), "{}", result.err);
    let result = run(folder.path(), &["static", "."]);
    assert_eq!(result.status, 2);
    assert!(result.err.contains("is a folder"), "{}", result.err);
}

#[test]
fn wrong_options_are_told_all_at_once() {
    let folder = folder();
    let result = run(
        folder.path(),
        &["simulate", "--duration", "5kg", "--initial", "halfshaft.twist=1", "--frequency", "-3"],
    );
    assert_eq!(result.status, 2);
    for words in ["--duration \"5kg\"", "did you mean \"half-shaft\"", "more than zero"] {
        assert!(result.err.contains(words), "no {words:?} in {}", result.err);
    }
    let cases: &[(&[&str], &str)] = &[
        (&["resonance", "--order", "1"], "all orders of the torques together"),
        (
            &["resonance", "--method", "averaged", "--harmonics", "3"],
            "only the method harmonic-balance",
        ),
        (&["resonance", "--parameter", "engine torque.amplitude=1..9"], "--frequency 4Hz"),
        (&["folds", "--parameter", "mode.f=1..9"], "only the closed form of one mode"),
        (&["resonance", "--frequency", "25"], "not a range"),
        (&["resonance", "--frequency", "25Hz..25Hz"], "empty"),
        (&["resonance", "--frequency", "3.9Hz..4.4"], "which unit the second number has"),
        (&["resonance", "--frequency", "28..4.4Hz"], "runs backwards"),
        (&["resonance", "--method", "averaged", "--mode", "2"], "no elastic mode number 2"),
        (&["modes", "--equilibrium", "9"], "no equilibrium number 9"),
        (
            &["simulate", "--initial", "engine.speed=1", "--initial", "gearbox output.speed=7"],
            "two of them fix the same motion",
        ),
        (&["folds", "--parameter", "vehicle.inertia=-5..100"], "must be more than zero"),
        (
            &["folds", "--method", "averaged", "--parameter", "mode.g=1..2"],
            "mode.alpha, mode.beta, mode.f, mode.omega_1",
        ),
        (&["folds", "--parameter", "engine torque.order=1..3"], "has no effect on fold curves"),
        (&["folds", "--parameter", "gearbox.ratios.1=1..3"], "take \"gearbox.ratio\""),
        (&["static", "--set", "vehicle.inertia=-5"], "must be more than zero"),
        (&["static", "--set", "road load.peak=-5"], "did you mean \"road load.pulse.peak\""),
        (&["shock", "--method", "full", "--order", "1"], "only the method multiple-scales"),
        (&["shock", "--equation", "twist"], "only the method multiple-scales"),
        (&["shock", "--step", "9s"], "longer than the 5 s"),
        (&["simulate", "--duration", "1s", "--step", "2s"], "longer than the 1 s"),
        (&["check", "--out", "a.csv"], "has no table"),
        (&["report", "--out", "a.csv"], "has no table"),
        (&["folds"], "which parameter"),
        (&["folds", "--parameter", "half-shaft.cubik=1..2"], "no number \"cubik\""),
        (&["shock", "--method", "fool"], "choose from full"),
        (&["shock", "--order", "3"], "from 1 to 2"),
        (&["simulate", "--step", "1e-12s"], "too many samples"),
        (&["simulate", "--tolerance", "0"], "more than zero"),
        (&["static", "--set", "half-shaft.stiffness=1 N·m"], "torsional stiffness"),
        (&["static", "--set", "half-shaft.stifness=1"], "did you mean \"stiffness\""),
        (&["static", "--out", "answer.xls"], "ends in no form"),
        (&["run", "missing.toml"], "cannot read"),
        (&["frobnicate"], "unrecognized subcommand"),
    ];
    for (arguments, words) in cases {
        let result = run(folder.path(), arguments);
        assert_eq!(result.status, 2, "{arguments:?}: {}", result.err);
        assert!(result.err.contains(words), "{arguments:?}: {}", result.err);
        assert!(result.out.is_empty(), "{arguments:?}: {}", result.out);
    }
    assert!(files(folder.path()).is_empty());
}

#[test]
fn what_cannot_be_answered_ends_with_status_1_and_a_reason() {
    let folder = folder();
    let cases: &[(&[&str], &str)] = &[
        (&["modes", "--set", "gearbox.ratio=1.79"], "gear 1.79 at 850 N·m needs 8688 N·m"),
        (
            &["resonance", "--method", "averaged", "--set", "engine torque.amplitude=0"],
            "nothing excites the line",
        ),
        (&["simulate", "--set", "gearbox.ratio=5.82", "--duration", "10s"], "runs away"),
    ];
    for (arguments, words) in cases {
        let result = run(folder.path(), arguments);
        assert_eq!(result.status, 1, "{arguments:?}: {}", result.err);
        assert!(result.err.contains(words), "{arguments:?}: {}", result.err);
    }
    // `static` has an answer where no state exists: that, and the capacity.
    let result = run(folder.path(), &["static", "--set", "gearbox.ratio=1.79", "--json"]);
    assert_eq!(result.status, 0);
    assert!(result.err.contains("needs 8688 N·m"), "{}", result.err);
}

#[test]
fn study_files_have_their_mistakes_told_too() {
    let folder = folder();
    let study = "format = 1\nname = \"s\"\n[[question]]\nname = \"a\"\nask = \"statik\"\n\
                 [[question]]\nname = \"b\"\nask = \"folds\"\nparameter = \"half-shaft.cubic=1\"\n\
                 [[question]]\nname = \"d\"\nask = \"folds\"\nparameter = \"engine.inertia=-1..1\"\n\
                 [[figure]]\nname = \"f\"\ntitle = \"t\"\nx = \"time\"\ny = \"q\"\n\
                 [[figure.question]]\nname = \"c\"\nask = \"static\"\nmodel = \"none.toml\"\n\
                 [[figure.compare]]\nwhat = \"w\"\npointer = \"/p\"\nof = \"e\"\nprinted = 1\n\
                 [[figure.compare]]\nwhat = \"w\"\npointer = \"/p\"\nprinted = 1\n";
    std::fs::write(folder.path().join("study.toml"), study).expect("writes");
    let result = run(folder.path(), &["run", "study.toml", "--out", "out"]);
    assert_eq!(result.status, 2);
    for words in [
        "did you mean \"static\"",
        "not a range",
        "more than zero",
        "cannot read none.toml",
        "did you mean \"c\"",
        "5 errors",
    ] {
        assert!(result.err.contains(words), "no {words:?} in {}", result.err);
    }
    assert!(!Path::new(&folder.path().join("out")).exists());
    // A mistake in the model is told once, however many questions are asked of it.
    let model = example().replace("\"81.6 kg·m²\"", "0");
    std::fs::write(folder.path().join("line.toml"), model).expect("writes");
    let study = "format = 1\nname = \"s\"\nmodel = \"line.toml\"\n\
                 [[question]]\nname = \"a\"\nask = \"static\"\n\
                 [[question]]\nname = \"b\"\nask = \"modes\"\n";
    std::fs::write(folder.path().join("study.toml"), study).expect("writes");
    let result = run(folder.path(), &["run", "study.toml"]);
    assert_eq!(result.err.matches("more than zero").count(), 1, "{}", result.err);
}
