"""What the comparison needs, each in its place under target/peers: nothing outside is touched."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

# Versions are fixed, so that two runs compare the same programs.
PEERS = ("heyoka==7.13.2", "scipy==1.17.1", "numpy==2.4.6", "numba==0.68.1", "numbalsoda==0.3.4")
ROOT = Path(__file__).resolve().parents[3]


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


def environment(folder):
    """A virtual environment with the peers, made once; returns its interpreter."""
    python, stamp = Path(folder) / "bin" / "python", Path(folder) / "requirements.txt"
    wanted = "\n".join(PEERS) + "\n"
    if stamp.exists() and stamp.read_text() == wanted:
        return python
    print(f"installing {', '.join(PEERS)} ...", file=sys.stderr, flush=True)
    shutil.rmtree(folder, ignore_errors=True)
    quietly([sys.executable, "-m", "venv", str(folder)], "making a virtual environment")
    quietly([str(python), "-m", "pip", "install", "--quiet", *PEERS], "pip install")
    stamp.write_text(wanted)
    return python


def halfshaft(given=None):
    """The release build of the example that times ensembles."""
    if given:
        return Path(given)
    if shutil.which("cargo") is None:
        raise Failure("halfshaft is built with cargo, which is not on the path")
    print("building halfshaft ...", file=sys.stderr, flush=True)
    command = ["cargo", "build", "--release", "--quiet", "-p", "halfshaft-dynamics", "--example", "ensemble_times"]
    quietly(command, "cargo build", ROOT)
    return target_folder() / "release" / "examples" / "ensemble_times"
