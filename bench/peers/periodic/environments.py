"""What the comparison needs, each in its place under target/peers: nothing outside is touched."""

import os
import shutil
import subprocess
import sys
import tarfile
from pathlib import Path

from processes import Failure

# Versions are fixed, so that two runs compare the same programs.
BIFPY = "bifpy==0.3.0"
NUMPY = "numpy==2.4.6"
PYHARM = ("pyharm-os==1.2.2", "numba==0.68.1", "numpy==2.4.6", "scipy==1.17.1", "jax==0.5.3", "jaxlib==0.5.3")
JAXCONT = ("jaxcont==0.4.0", "jax==0.10.2", "jaxlib==0.10.2", "numpy==2.4.6")
ROOT = Path(__file__).resolve().parents[3]


def target_folder():
    """Cargo's target folder of this workspace."""
    return Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")).resolve()


def quietly(command, what, cwd=None, quiet_output=True):
    """Runs a command of the preparation; what it says is shown only where it fails."""
    done = subprocess.run(command, cwd=cwd, capture_output=quiet_output, text=True)
    if done.returncode != 0:
        raise Failure(f"{what} failed:\n{(done.stderr or '')[-2000:]}")


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


def auto_sources(work):
    """AUTO-07p's Fortran sources, unpacked from the source package of bifpy."""
    folder = Path(work) / "bifpy"
    unpacked = folder / BIFPY.replace("==", "-")
    if not (unpacked / "auto" / "src").exists():
        folder.mkdir(parents=True, exist_ok=True)
        quietly([sys.executable, "-m", "pip", "download", "--quiet", "--no-deps", "--no-binary", "bifpy",
                 "--dest", str(folder), BIFPY], "pip download of bifpy")
        archive = next(folder.glob("bifpy-*.tar.gz"), None)
        if archive is None:
            raise Failure("bifpy came without its sources, in which AUTO-07p is")
        with tarfile.open(archive) as packed:
            packed.extractall(folder, filter="data")
    return unpacked


def halfshaft(given=None):
    """The release build of the program and of the example that repeats a question."""
    if given:
        program = Path(given)
        return program, program.parent / "examples" / "ask_repeatedly"
    if shutil.which("cargo") is None:
        raise Failure("halfshaft is built with cargo, which is not on the path")
    print("building halfshaft ...", file=sys.stderr, flush=True)
    quietly(["cargo", "build", "--release", "--quiet", "-p", "halfshaft-cli"], "cargo build", ROOT)
    quietly(["cargo", "build", "--release", "--quiet", "-p", "halfshaft", "--example", "ask_repeatedly"],
            "cargo build", ROOT)
    folder = target_folder() / "release"
    return folder / "halfshaft", folder / "examples" / "ask_repeatedly"


def million_points():
    """What the example of that name prints."""
    quietly(["cargo", "build", "--release", "--quiet", "-p", "halfshaft-analysis", "--example",
             "million_points"], "cargo build", ROOT)
    program = target_folder() / "release" / "examples" / "million_points"
    return subprocess.run([program], check=True, capture_output=True, text=True).stdout
