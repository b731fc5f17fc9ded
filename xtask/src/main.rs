//! House tasks: `cargo xtask test`, `tidy`, `generate`, `fuzz`, `page`, `python`, `bench`.
//!
//! `test` is what CI calls: everything that must hold, each step doing its own set-up.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a face: it talks to the terminal")]

mod fuzz;
mod generate;
mod page;
mod python;
mod readme;
mod run;
mod tidy;

use std::process::ExitCode;

use run::{Outcome, cargo, heading};

const USAGE: &str = "usage: cargo xtask TASK

  test        everything that CI checks: format, house rules, generated files, lints, docs, tests,
              the README's commands, the report in a browser, the Python package, a minute of fuzzing
  tidy        the house rules alone
  generate    write what is generated: schema, reference pages, example figures, README output
  readme      the README's commands alone
  page        the report in a headless browser alone
  python      the Python package alone: wheel, import, types, tests (needs Python 3.10 or newer)
  fuzz        a minute of fuzzing all that reads text (needs a nightly toolchain)
  bench       all criterion benches
";

fn main() -> ExitCode {
    let task = std::env::args().nth(1).unwrap_or_default();
    let outcome = match task.as_str() {
        "test" => test(),
        "tidy" => tidy::run(),
        "generate" => generate::write(),
        "readme" => readme::check(),
        "page" => page::run(),
        "python" => python::run(),
        "fuzz" => fuzz::run(),
        "bench" => cargo(&["bench", "--workspace"]),
        _ => {
            print!("{USAGE}");
            return ExitCode::from(if task.is_empty() { 0 } else { 2 });
        }
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("\nxtask: {message}");
            ExitCode::FAILURE
        }
    }
}

/// Every check, the quick ones first.
fn test() -> Outcome {
    heading("format");
    cargo(&["fmt", "--all", "--check"])?;
    heading("house rules");
    tidy::run()?;
    heading("lints");
    cargo(&["clippy", "--workspace", "--all-targets", "--quiet", "--", "-D", "warnings"])?;
    heading("tests");
    // The Parquet writer stands beside the program when the program's tests look for it.
    cargo(&["build", "--workspace", "--quiet"])?;
    cargo(&["test", "--workspace", "--quiet"])?;
    heading("docs");
    // The program and the library have one name, so that their pages share a folder: one after the
    // other, the library's last.
    for packages in
        [&["--package", "halfshaft-cli"][..], &["--workspace", "--exclude", "halfshaft-cli"]]
    {
        let shared = ["doc", "--no-deps", "--quiet", "--document-private-items"];
        run::cargo_with(&[&shared, packages].concat(), &[("RUSTDOCFLAGS", "-D warnings")])?;
    }
    heading("generated files");
    generate::check()?;
    heading("README");
    readme::check()?;
    heading("report in a browser");
    page::run()?;
    heading("Python package");
    python::run()?;
    heading("fuzzing");
    fuzz::run()
}
