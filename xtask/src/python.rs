//! The Python package: its wheel, built and installed in an environment of its own, and its tests.
//!
//! Everything stands under `target/python`; what the tests need besides is installed there once.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use std::time::Instant;

use crate::run::{Outcome, apt_install, finish, has, root, target};

/// Programs that may be Python; the first that is new enough and can make environments is taken.
const PYTHONS: &[&str] =
    &["python3", "python", "python3.14", "python3.13", "python3.12", "python3.11", "python3.10"];
/// Succeeds in a Python that can do what is needed here.
const FITS: &str = "import sys, ensurepip, venv; sys.exit(sys.version_info < (3, 10))";
/// Largest wheel, bytes.
const LARGEST_WHEEL: u64 = 15_000_000;
/// What builds the wheel.
const BUILDER: &[&str] = &["maturin>=1.16,<2"];
/// What the tests use besides the package and numpy, its only hard dependency.
const FOR_TESTS: &[&str] = &[
    "numpy>=1.24",
    "hypothesis>=6.100",
    "matplotlib>=3.8",
    // What type checkers complain of changes with them: these two are as they were tried.
    "mypy==2.4.1",
    "pandas>=2",
    "pint>=0.23",
    "plotly>=6",
    "pyarrow>=14",
    // With the JavaScript engine that it needs, as a wheel too.
    "pyright[nodejs]==1.1.414",
    "pytest>=8",
    "ruff==0.17.6",
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
    names(&folder, &tests)?;
    types(&folder, &tests)?;
    let settings = root().join("pyproject.toml");
    // Not from the root, where Python would find the sources before the wheel.
    let mut suite = python(&tests, &folder, &["-m", "pytest", "-c"]);
    suite.arg(&settings).arg("--rootdir").arg(root()).arg(root().join("python/tests"));
    finish(&mut suite, "pytest")
}

/// Names that scripts use and do not have, those of the comparisons too, which no test runs.
fn names(folder: &Path, tests: &Path) -> Outcome {
    let rules = ["-m", "ruff", "check", "--isolated", "--no-cache", "--select", "F,E9"];
    let mut ruff = python(tests, folder, &rules);
    finish(ruff.arg(root().join("bench")).arg(root().join("python")), "ruff")
}

/// Types of the package as it is installed and of the examples, by both checkers.
fn types(folder: &Path, tests: &Path) -> Outcome {
    let settings = root().join("pyproject.toml");
    let mut mypy = python(tests, folder, &["-m", "mypy", "--config-file"]);
    finish(mypy.arg(&settings).arg(root().join("python/examples")), "mypy of the examples")?;
    let mut mypy = python(tests, folder, &["-m", "mypy", "--config-file"]);
    finish(mypy.arg(&settings).args(["--package", "halfshaft"]), "mypy of the package")?;
    let mut pyright = python(tests, folder, &["-m", "pyright", "--pythonpath"]);
    finish(pyright.arg(tests).arg("--project").arg(&settings), "pyright")?;
    // Every type that a user may meet is written down.
    let complete = ["-m", "pyright", "--verifytypes", "halfshaft", "--ignoreexternal"];
    let mut whole = python(tests, folder, &complete);
    let told = whole.output().map_err(|error| format!("pyright --verifytypes: {error}"))?;
    if told.status.success() {
        return Ok(());
    }
    let told = String::from_utf8_lossy(&told.stdout).into_owned();
    Err(format!("types of the package are not complete:\n{told}"))
}

/// The wheel with numpy and nothing else: it is small, answers, and its program runs; how long the import
/// takes is told.
fn imports_alone(folder: &Path, wheel: &Path) -> Outcome {
    let size = fs::metadata(wheel).map_err(|error| format!("{}: {error}", wheel.display()))?.len();
    if size > LARGEST_WHEEL {
        return Err(format!("the wheel has {size} bytes, more than {LARGEST_WHEEL}"));
    }
    let clean = environment(&folder.join("clean"), &["numpy>=1.24"])?;
    install(&clean, wheel)?;
    let told = "import halfshaft; print(halfshaft.example().static().table)";
    finish(&mut python(&clean, folder, &["-c", told]), "import halfshaft")?;
    let program = ["-m", "halfshaft", "static", "--quiet"];
    finish(&mut python(&clean, folder, &program), "python -m halfshaft")?;
    let import = best(&clean, folder, "import halfshaft")? - best(&clean, folder, "pass")?;
    println!("wheel: {:.1} MB, imported in {:.0} ms", size as f64 / 1e6, 1e3 * import);
    Ok(())
}

/// The shortest of several times that Python takes for a line, s: others have waited for the machine.
fn best(interpreter: &Path, folder: &Path, line: &str) -> Result<f64, String> {
    let mut best = f64::INFINITY;
    for _ in 0..7 {
        let start = Instant::now();
        finish(&mut python(interpreter, folder, &["-c", line]), line)?;
        best = best.min(start.elapsed().as_secs_f64());
    }
    Ok(best)
}

/// A virtual environment with some packages, made anew where they are others than last time.
fn environment(folder: &Path, packages: &[&str]) -> Result<PathBuf, String> {
    let (inside, stamp) = (interpreter(folder), folder.join("packages.txt"));
    let wanted = packages.join("\n");
    if fs::read_to_string(&stamp).is_ok_and(|known| known == wanted) {
        return Ok(inside);
    }
    let outside = outside()?;
    finish(Command::new(outside).args(["-m", "venv", "--clear"]).arg(folder), "python -m venv")?;
    finish(pip(&inside).arg("install").args(packages), "pip install")?;
    fs::write(&stamp, wanted).map_err(|error| format!("{}: {error}", stamp.display()))?;
    Ok(inside)
}

/// A Python that fits; installs Debian's where that is possible.
fn outside() -> Result<&'static str, String> {
    let fits = |name: &&&str| has(name, &["-c", FITS]);
    let present = || PYTHONS.iter().find(fits).copied();
    if let Some(found) = present() {
        return Ok(found);
    }
    println!("installing Python");
    // Where this fails, the sentence below says what is wanted.
    let _ = apt_install("python3-venv");
    present().ok_or_else(|| {
        format!(
            "Python 3.10 or newer with the modules venv and ensurepip is needed, as one of {} in the PATH \
             (on Debian: apt-get install python3-venv)",
            PYTHONS.join(", ")
        )
    })
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

/// Python in a folder that has no package of ours in it, with the environment as where programs are.
fn python(interpreter: &Path, folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(interpreter);
    let own = interpreter.parent().map(Path::to_path_buf);
    let known = std::env::var_os("PATH").unwrap_or_default();
    let all = own.into_iter().chain(std::env::split_paths(&known));
    // Without it pyright would look at another Python's packages.
    if let Ok(path) = std::env::join_paths(all) {
        command.env("PATH", path);
    }
    command.current_dir(folder).args(arguments);
    command
}
