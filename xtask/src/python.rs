//! The Python package: its wheel, built and installed in an environment of its own, and its tests.
//!
//! Everything stands under `target/python`; what the tests need besides is installed there once.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::run::{Outcome, finish, has, root, target};

/// What builds the wheel.
const BUILDER: &[&str] = &["maturin>=1.16,<2"];
/// What the tests use besides the package and numpy, its only hard dependency.
const FOR_TESTS: &[&str] = &[
    "numpy>=1.24",
    "hypothesis>=6.100",
    "matplotlib>=3.8",
    "mypy>=1.13",
    "pandas>=2",
    "pint>=0.23",
    "plotly>=6",
    "pyarrow>=14",
    "pytest>=8",
    "tqdm>=4.60",
    "xarray>=2023.12",
];

/// Builds the wheel, installs it beside its test tools, checks types and runs the tests.
pub fn run() -> Outcome {
    let folder = target().join("python");
    fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let builder = environment(&folder.join("builder"), BUILDER)?;
    let wheel = wheel(&builder, &folder.join("wheels"))?;
    imports_alone(&folder, &wheel)?;
    let tests = environment(&folder.join("tests"), FOR_TESTS)?;
    install(&tests, &wheel)?;
    let settings = root().join("pyproject.toml");
    let mut types = python(&tests, &folder, &["-m", "mypy", "--config-file"]);
    types.arg(&settings).arg(root().join("python/examples"));
    finish(&mut types, "mypy of the examples")?;
    let mut types = python(&tests, &folder, &["-m", "mypy", "--config-file"]);
    finish(types.arg(&settings).args(["--package", "halfshaft"]), "mypy of the package")?;
    // Not from the root, where Python would find the sources before the wheel.
    let mut suite = python(&tests, &folder, &["-m", "pytest", "-c"]);
    suite.arg(&settings).arg("--rootdir").arg(root()).arg(root().join("python/tests"));
    finish(&mut suite, "pytest")
}

/// The wheel with numpy and nothing else: it imports, answers, and its program runs.
fn imports_alone(folder: &Path, wheel: &Path) -> Outcome {
    let clean = environment(&folder.join("clean"), &["numpy>=1.24"])?;
    install(&clean, wheel)?;
    let told = "import halfshaft; print(halfshaft.example().static().table)";
    finish(&mut python(&clean, folder, &["-c", told]), "import halfshaft")?;
    let program = ["-m", "halfshaft", "static", "--quiet"];
    finish(&mut python(&clean, folder, &program), "python -m halfshaft")
}

/// A virtual environment with some packages, made anew where they are others than last time.
fn environment(folder: &Path, packages: &[&str]) -> Result<PathBuf, String> {
    let (inside, stamp) = (interpreter(folder), folder.join("packages.txt"));
    let wanted = packages.join("\n");
    if fs::read_to_string(&stamp).is_ok_and(|known| known == wanted) {
        return Ok(inside);
    }
    let outside = ["python3", "python"].into_iter().find(|name| has(name, &["--version"]));
    let outside = outside.ok_or("Python 3.10 or newer is needed, as python3 in the PATH")?;
    finish(Command::new(outside).args(["-m", "venv", "--clear"]).arg(folder), "python -m venv")?;
    finish(pip(&inside).arg("install").args(packages), "pip install")?;
    fs::write(&stamp, wanted).map_err(|error| format!("{}: {error}", stamp.display()))?;
    Ok(inside)
}

fn interpreter(folder: &Path) -> PathBuf {
    folder.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" })
}

fn pip(interpreter: &Path) -> Command {
    let mut command = Command::new(interpreter);
    command.args(["-m", "pip", "--quiet", "--disable-pip-version-check"]);
    command
}

/// The wheel of the package, in release as users get it.
fn wheel(builder: &Path, folder: &Path) -> Result<PathBuf, String> {
    // An older wheel would be found in its place.
    let _ = fs::remove_dir_all(folder);
    let mut command = Command::new(builder);
    command.current_dir(root()).args([
        "-m",
        "maturin",
        "build",
        "--release",
        "--locked",
        "--quiet",
    ]);
    command.arg("--target-dir").arg(target()).arg("--out").arg(folder);
    finish(&mut command, "maturin build")?;
    let files = fs::read_dir(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let wheel = files
        .flatten()
        .map(|entry| entry.path())
        .find(|path| path.extension().is_some_and(|ending| ending == "whl"));
    wheel.ok_or_else(|| format!("maturin left no wheel in {}", folder.display()))
}

fn install(interpreter: &Path, wheel: &Path) -> Outcome {
    let mut command = pip(interpreter);
    command.args(["install", "--force-reinstall", "--no-deps"]).arg(wheel);
    finish(&mut command, "pip install of the wheel")
}

/// Python in a folder that has no package of ours in it.
fn python(interpreter: &Path, folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(interpreter);
    command.current_dir(folder).args(arguments);
    command
}
