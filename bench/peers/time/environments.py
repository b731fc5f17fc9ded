"""What the comparison needs, each in its place under target/peers: nothing outside is touched."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import preparation  # noqa: E402
from preparation import Failure, built, quietly, target_folder  # noqa: E402, F401

# Versions are fixed, so that two runs compare the same programs.
PEERS = ("heyoka==7.13.2", "scipy==1.17.1", "numpy==2.4.6", "numba==0.68.1", "numbalsoda==0.3.4")


def environment(folder):
    """A virtual environment with the peers, made once; returns its interpreter."""
    return preparation.environment(folder, PEERS)


def example(name):
    """The release build of another example."""
    return built("halfshaft-dynamics", name) / "examples" / name


def halfshaft(given=None):
    """The release build of the example that times ensembles."""
    if given:
        return Path(given)
    print("building halfshaft ...", file=sys.stderr, flush=True)
    return built("halfshaft-dynamics", "ensemble_times") / "examples" / "ensemble_times"
