//! A minute of fuzzing of everything that reads text.

use std::process::Command;

use crate::run::{Outcome, finish, has, root, target};

const TARGETS: &[&str] = &["model_file", "study_file", "options", "result"];
/// Seconds for all targets together.
const SECONDS: usize = 60;

/// Fuzzes where a nightly toolchain is present; says so where it is not.
pub fn run() -> Outcome {
    if !has("cargo", &["+nightly", "--version"]) {
        println!("no nightly toolchain: not fuzzed");
        return Ok(());
    }
    let tools = target().join("tools");
    let program = tools.join("bin").join("cargo-fuzz");
    if !program.exists() {
        println!("installing cargo-fuzz");
        finish(
            Command::new("cargo")
                .args(["install", "cargo-fuzz", "--locked", "--quiet", "--root"])
                .arg(&tools),
            "cargo install cargo-fuzz",
        )?;
    }
    for target in TARGETS {
        // What the fuzzer finds goes into the first folder, the seeds are only read.
        let corpus = crate::run::target().join("fuzz-corpus").join(target);
        std::fs::create_dir_all(&corpus)
            .map_err(|error| format!("{}: {error}", corpus.display()))?;
        let seconds = format!("-max_total_time={}", SECONDS / TARGETS.len());
        // The fuzzer talks much; that matters only where it has found something.
        let output = Command::new("cargo")
            .current_dir(root())
            .env("PATH", path_with(&tools))
            // The nightly build must not disturb the flags of the workspace.
            .env_remove("RUSTFLAGS")
            .args(["+nightly", "fuzz", "run", "--fuzz-dir", "fuzz", target])
            .arg(&corpus)
            .args([&format!("fuzz/seeds/{target}"), "--", &seconds, "-max_len=4096"])
            .args(["-verbosity=0", "-print_final_stats=0"])
            .output()
            .map_err(|error| format!("cargo fuzz: {error}"))?;
        if !output.status.success() {
            eprintln!("{}", String::from_utf8_lossy(&output.stderr));
            return Err(format!("fuzzing {target} ended with {}", output.status));
        }
        println!("fuzzed {target} for {} s: no crash", SECONDS / TARGETS.len());
    }
    Ok(())
}

fn path_with(tools: &std::path::Path) -> String {
    format!("{}:{}", tools.join("bin").display(), std::env::var("PATH").unwrap_or_default())
}
