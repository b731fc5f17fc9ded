"""What the comparison needs, each in its place under target/peers: nothing outside is touched."""

import sys
import tarfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from preparation import Failure, built, environment, quietly, target_folder  # noqa: E402, F401

# Versions are fixed, so that two runs compare the same programs.
BIFPY = "bifpy==0.3.0"
NUMPY = "numpy==2.4.6"
PYHARM = ("pyharm-os==1.2.2", "numba==0.68.1", "numpy==2.4.6", "scipy==1.17.1", "jax==0.5.3", "jaxlib==0.5.3")
JAXCONT = ("jaxcont==0.4.0", "jax==0.10.2", "jaxlib==0.10.2", "numpy==2.4.6")


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
    print("building halfshaft ...", file=sys.stderr, flush=True)
    folder = built("halfshaft-cli")
    built("halfshaft", "ask_repeatedly")
    return folder / "halfshaft", folder / "examples" / "ask_repeatedly"


def million_points():
    """What the example of that name prints."""
    program = built("halfshaft-analysis", "million_points") / "examples" / "million_points"
    return quietly([program], "million_points")
