//! What the program writes: every form, all or nothing.

mod common;

use common::{command, files, run, told};
use halfshaft::Answer;
use halfshaft::results::io::from_json;
use std::path::Path;
use std::process::Command;

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("temporary folder")
}

/// A command that asks a question in its quickest way.
fn quick(verb: &str) -> Vec<&str> {
    let method: &[&str] = if verb == "resonance" { &["--method", "averaged"] } else { &[] };
    [&[verb], method].concat()
}

fn read(path: &Path) -> Answer {
    let text = std::fs::read_to_string(path).expect("is there");
    from_json(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

// Source: the same answer by two ways: standard output and file, both read back.
#[test]
fn json_on_standard_output_is_the_answer_and_nothing_else() {
    let folder = folder();
    for verb in ["check", "static", "modes", "simulate", "shock", "resonance"] {
        let asked = [&quick(verb)[..], &["--json", "--out", "answer.json"]].concat();
        let result = run(folder.path(), &asked);
        assert_eq!(result.status, 0, "{}", result.err);
        let answer = from_json(&result.out).expect("standard output is JSON");
        assert_eq!(answer, read(&folder.path().join("answer.json")), "{verb}");
        assert_eq!(answer.header().analysis, verb);
    }
}

#[test]
fn every_form_is_written_by_its_ending() {
    let folder = folder();
    let starts: &[(&str, &[u8])] = &[
        ("a.json", b"{"),
        ("a.csv", b"frequency"),
        ("a.svg", b"<"),
        ("a.png", b"\x89PNG"),
        ("a.html", b"<!DOCTYPE html>"),
    ];
    for (name, start) in starts {
        let result = run(folder.path(), &[&quick("resonance")[..], &["--out", name]].concat());
        assert_eq!(result.status, 0, "{}", result.err);
        assert!(result.err.contains(&format!("wrote {name}")), "{}", result.err);
        let bytes = std::fs::read(folder.path().join(name)).expect("written");
        assert!(bytes.starts_with(start), "{name}: {:?}", &bytes[..20]);
    }
    // What has no curve has a sketch.
    for (name, start) in &starts[2..] {
        let result = run(folder.path(), &["check", "--out", name]);
        assert_eq!(result.status, 0, "{}", result.err);
        assert!(std::fs::read(folder.path().join(name)).expect("written").starts_with(start));
    }
    let result = run(folder.path(), &["shock", "--compare", "--out", "all"]);
    assert_eq!(result.status, 0, "{}", result.err);
    let written = files(&folder.path().join("all"));
    for name in ["shock.json", "shock.csv", "shock.html"] {
        assert!(written.iter().any(|file| file == name), "{written:?}");
    }
    assert!(written.iter().any(|file| file.ends_with(".svg")));
    assert!(written.iter().any(|file| file.ends_with(".png")));
}

#[test]
fn the_report_says_where_it_is() {
    let folder = folder();
    let result = run(folder.path(), &["report"]);
    assert_eq!(result.status, 0, "{}", result.err);
    assert!(result.err.contains("wrote report.html"), "{}", result.err);
    let page = std::fs::read_to_string(folder.path().join("report.html")).expect("written");
    assert!(page.contains("7814"), "the capacity is in the report");
    let quiet = run(folder.path(), &["report", "--quiet", "--out", "q.html"]);
    assert_eq!((quiet.status, quiet.out.as_str(), quiet.err.as_str()), (0, "", ""));
}

// Source: the files of the new verb are sound models.
#[test]
fn a_new_model_is_sound_and_is_not_overwritten() {
    let folder = folder();
    assert_eq!(run(folder.path(), &["new", "mine.toml"]).status, 0);
    let result = run(folder.path(), &["check", "mine.toml"]);
    assert_eq!(result.status, 0, "{}", result.err);
    assert_eq!(run(folder.path(), &["report", "mine.toml"]).status, 0);
    let again = run(folder.path(), &["new", "mine.toml"]);
    assert_eq!(again.status, 2);
    assert!(again.err.contains("is there already") && again.err.contains("--force"));
    assert_eq!(run(folder.path(), &["new", "mine.toml", "--force"]).status, 0);
}

#[test]
fn schema_completions_and_manual_are_generated() {
    let folder = folder();
    for of in ["model", "study"] {
        let result = run(folder.path(), &["schema", of]);
        let schema: serde_json::Value = serde_json::from_str(&result.out).expect("JSON");
        assert!(schema["properties"]["format"].is_object());
    }
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let result = run(folder.path(), &["completions", shell]);
        assert!(result.status == 0 && result.out.contains("resonance"), "{shell}");
    }
    assert_eq!(run(folder.path(), &["man", "pages"]).status, 0);
    let pages = files(&folder.path().join("pages"));
    assert!(pages.contains(&"halfshaft.1".to_owned()));
    assert!(pages.contains(&"halfshaft-resonance.1".to_owned()));
}

#[test]
fn an_output_folder_that_takes_no_file_is_told_before_any_work() {
    let folder = folder();
    std::fs::write(folder.path().join("file"), "x").expect("writes");
    for target in ["file/answer.json", "missing/answer.json", "/proc/answer.json"] {
        let result = run(folder.path(), &["static", "--out", target]);
        assert_eq!(result.status, 2, "{target}: {}", result.err);
        assert!(result.err.contains("cannot write in"), "{target}: {}", result.err);
    }
    assert_eq!(files(folder.path()), ["file"]);
    // Where there is no answer there is no folder for it either.
    let result = run(folder.path(), &["modes", "--set", "gearbox.ratio=1.79", "--out", "new"]);
    assert_eq!(result.status, 1, "{}", result.err);
    assert_eq!(files(folder.path()), ["file"]);
}

#[test]
fn a_reader_that_goes_away_is_no_error() {
    let program = env!("CARGO_BIN_EXE_halfshaft");
    let script = format!(
        "{program} simulate --json 2>/dev/null | head -c 100 >/dev/null; \
                          echo ${{PIPESTATUS[0]}}"
    );
    let output = Command::new("bash").args(["-c", &script]).output().expect("bash starts");
    assert_eq!(String::from_utf8_lossy(&output.stdout).trim(), "0");
    // A full device is an error, though.
    if Path::new("/dev/full").exists() {
        let script = format!("{program} static --json > /dev/full");
        let output = Command::new("bash").args(["-c", &script]).output().expect("bash starts");
        assert_eq!(output.status.code(), Some(1));
        assert!(String::from_utf8_lossy(&output.stderr).contains("cannot write"));
    }
}

/// A tmpfs of the given size on a folder, unmounted when dropped.
struct SmallDisk(tempfile::TempDir);

impl SmallDisk {
    /// `None` where this user may not mount.
    fn new(size: &str) -> Option<Self> {
        let folder = folder();
        let mounted = Command::new("mount")
            .args(["-t", "tmpfs", "-o", &format!("size={size}"), "tmpfs"])
            .arg(folder.path())
            .output()
            .is_ok_and(|output| output.status.success());
        mounted.then_some(Self(folder))
    }
}

impl Drop for SmallDisk {
    fn drop(&mut self) {
        let _ = Command::new("umount").arg(self.0.path()).output();
    }
}

#[test]
fn a_full_disk_leaves_the_old_file_and_no_half_one() {
    let Some(disk) = SmallDisk::new("64k") else {
        println!("not allowed to mount a small disk here: not tested");
        return;
    };
    let folder = disk.0.path();
    let small = run(folder, &["static", "--json", "--out", "answer.csv"]);
    assert_eq!(small.status, 0, "{}", small.err);
    let before = std::fs::read(folder.join("answer.csv")).expect("written");
    for (verb, name) in [
        ("simulate", "answer.csv"),
        ("resonance", "big.json"),
        ("report", "report.html"),
        ("simulate", "big.parquet"),
    ] {
        if name.ends_with("parquet") && !parquet_writer_is_there() {
            continue;
        }
        let arguments = [&quick(verb)[..], &["--out", name]].concat();
        let result = run(folder, &arguments);
        assert_eq!(result.status, 1, "{arguments:?}: {}", result.err);
        assert!(result.err.contains("No space left"), "{arguments:?}: {}", result.err);
        assert!(result.err.contains(name), "{arguments:?}: {}", result.err);
        assert_eq!(result.err.matches("cannot write").count(), 1, "{}", result.err);
        assert_eq!(result.err.matches("nothing was left").count(), 1, "{}", result.err);
    }
    let result = run(folder, &["simulate", "--out", "new/and/deeper"]);
    assert_eq!(result.status, 1, "{}", result.err);
    assert_eq!(files(folder), ["answer.csv"], "no half-written file nor folder");
    assert_eq!(std::fs::read(folder.join("answer.csv")).expect("whole"), before);
}

fn parquet_writer() -> std::path::PathBuf {
    Path::new(env!("CARGO_BIN_EXE_halfshaft")).with_file_name("halfshaft-parquet")
}

fn parquet_writer_is_there() -> bool {
    parquet_writer().exists()
}

/// Sends SIGINT after a delay.
fn interrupt(child: &std::process::Child, delay_ms: u64) {
    std::thread::sleep(std::time::Duration::from_millis(delay_ms));
    let _ = Command::new("kill").args(["-INT", &child.id().to_string()]).status();
}

#[cfg(unix)]
#[test]
fn ctrl_c_ends_the_computation_and_writes_what_was_reached() {
    let folder = folder();
    let arguments = [
        "simulate",
        "--frequency",
        "22",
        "--duration",
        "100000s",
        "--step",
        "1s",
        "--out",
        "a.json",
    ];
    let mut command = command(folder.path(), &arguments);
    let child = command
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .expect("starts");
    interrupt(&child, 600);
    let result = told(child.wait_with_output().expect("ends"));
    assert_eq!(result.status, 1, "{}", result.err);
    assert!(result.err.contains("stopped by the user"), "{}", result.err);
    let Answer::History(history) = read(&folder.path().join("a.json")) else { panic!("a history") };
    assert!(!history.header.termination.is_complete());
    let times = history.values("time");
    assert!(!times.is_empty() && *times.last().expect("samples") < 99_000.0);
}

// Source: the contract: the second Ctrl-C ends the program with status 130. A model that comes from
// a pipe which nobody fills never looks for interrupts.
#[cfg(unix)]
#[test]
fn a_second_ctrl_c_ends_what_does_not_look_for_it() {
    let folder = folder();
    let mut command = command(folder.path(), &["static", "/dev/stdin", "--out", "a.json"]);
    let mut child = command
        .stdin(std::process::Stdio::piped())
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .expect("starts");
    interrupt(&child, 300);
    std::thread::sleep(std::time::Duration::from_millis(200));
    assert!(child.try_wait().expect("asks").is_none(), "the first one only asks");
    interrupt(&child, 0);
    let stdin = child.stdin.take();
    let result = told(child.wait_with_output().expect("ends"));
    drop(stdin);
    assert_eq!(result.status, 130, "{}", result.err);
    assert!(files(folder.path()).is_empty());
}

#[cfg(unix)]
#[test]
fn an_interrupt_in_mid_write_leaves_nothing_under_the_name() {
    // The answer takes seconds to write; the interrupts come at many moments of that. Whenever it
    // hits, the file is whole or absent, and no temporary file stays behind.
    let arguments = ["simulate", "--duration", "5s", "--step", "5e-6s", "--out", "a.csv"];
    for delay in [150, 400, 800, 1500, 2500] {
        let folder = folder();
        let mut command = command(folder.path(), &arguments);
        let child = command
            .stdout(std::process::Stdio::piped())
            .stderr(std::process::Stdio::piped())
            .spawn()
            .expect("starts");
        interrupt(&child, delay);
        interrupt(&child, 50);
        let result = told(child.wait_with_output().expect("ends"));
        let left = files(folder.path());
        assert!(!result.err.contains("panicked"), "{}", result.err);
        if left.is_empty() {
            assert_ne!(result.status, 0, "after {delay} ms: {}", result.err);
        } else {
            assert_eq!(left, ["a.csv"], "after {delay} ms");
            let text = std::fs::read_to_string(folder.path().join("a.csv")).expect("readable");
            let columns = text.lines().next().expect("head").split(',').count();
            assert_eq!(text.lines().last().expect("rows").split(',').count(), columns);
            assert!(text.ends_with('\n'));
        }
    }
}

// Source: two paths to one thing: the Parquet file read back equals the JSON of the same question.
#[test]
fn parquet_files_hold_the_same_answer() {
    if !parquet_writer_is_there() {
        println!("halfshaft-parquet is not built: not tested");
        return;
    }
    let folder = folder();
    for verb in ["static", "modes", "simulate", "shock", "resonance"] {
        let asked = [&quick(verb)[..], &["--json", "--out", "a.parquet"]].concat();
        let result = run(folder.path(), &asked);
        assert_eq!(result.status, 0, "{}", result.err);
        let back = Command::new(parquet_writer())
            .current_dir(folder.path())
            .args(["--json", "a.parquet"])
            .output()
            .expect("starts");
        let text = String::from_utf8(back.stdout).expect("UTF-8");
        assert_eq!(
            from_json(&text).expect("JSON"),
            from_json(&result.out).expect("JSON"),
            "{verb}"
        );
    }
    let result = run(folder.path(), &["check", "--out", "check.parquet"]);
    assert_eq!(result.status, 2);
    assert!(result.err.contains("has no table"), "{}", result.err);
}

// A range without folds: its table has a head and no rows, in each form.
#[test]
fn an_answer_without_curves_is_a_table_without_rows() {
    let folder = folder();
    let folds = ["folds", "--method", "averaged", "--frequency", "1..2"];
    let plane = ["--parameter", "half-shaft.damping=1..2"];
    let ask = |out: &[&str]| run(folder.path(), &[&folds[..], &plane, out].concat());
    assert_eq!(ask(&["--out", "a.csv"]).status, 0);
    let text = std::fs::read_to_string(folder.path().join("a.csv")).expect("written");
    assert_eq!(text, "frequency (rad/s),half-shaft.damping (N·m·s/rad),sigma (rad/s),rho (rad)\n");
    if parquet_writer_is_there() {
        let result = ask(&["--out", "a.parquet", "--json"]);
        assert_eq!(result.status, 0, "{}", result.err);
        let back = Command::new(parquet_writer())
            .args(["--json", "a.parquet"])
            .current_dir(folder.path())
            .output()
            .expect("starts");
        let back = String::from_utf8(back.stdout).expect("UTF-8");
        assert_eq!(from_json(&back).expect("JSON"), from_json(&result.out).expect("JSON"));
    }
}
