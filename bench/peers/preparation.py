"""What all comparisons need: environments under target/peers, made once; nothing outside is touched."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


class Failure(Exception):
    """Something that cannot be done, said in a sentence."""


def target_folder():
    """Cargo's target folder of this workspace."""
    return Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")).resolve()


def quietly(command, what, cwd=None):
    """Runs a command; what it says is returned, or shown where it fails."""
    done = subprocess.run(command, cwd=cwd, capture_output=True, text=True)
    if done.returncode != 0:
        raise Failure(f"{what} failed:\n{(done.stderr or '')[-2000:]}")
    return done.stdout


def environment(folder, requirements):
    """A virtual environment with these packages, made once; returns its interpreter."""
    python = Path(folder) / "bin" / "python"
    stamp = Path(folder) / "requirements.txt"
    wanted = "\n".join(requirements) + "\n"
    if stamp.exists() and stamp.read_text() == wanted:
        return python
    print(f"installing {', '.join(requirements)} ...", file=sys.stderr, flush=True)
    shutil.rmtree(folder, ignore_errors=True)
    quietly([sys.executable, "-m", "venv", str(folder)], "making a virtual environment")
    quietly([str(python), "-m", "pip", "install", "--quiet", *requirements], "pip install")
    stamp.write_text(wanted)
    return python


def built(package, example=None):
    """Builds a package's program, or one of its examples, for release; returns the folder of both."""
    if shutil.which("cargo") is None:
        raise Failure("halfshaft is built with cargo, which is not on the path")
    what = ["--example", example] if example else []
    quietly(["cargo", "build", "--release", "--quiet", "-p", package, *what], "cargo build", ROOT)
    return target_folder() / "release"
