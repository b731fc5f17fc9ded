"""What the comparison needs, each in its place under target/peers: nothing outside is touched."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from preparation import Failure, built, environment, quietly, target_folder  # noqa: E402, F401

# Versions are fixed, so that two runs compare the same programs.
BASE = ("numpy==2.4.6",)
OPENTORSION = ("opentorsion==0.3.2", "numpy==2.4.6", "scipy==1.17.1", "matplotlib==3.11.2")
# ross 2.3 asks for any plotly, but names a kind of trace that plotly 7 no longer has.
ROSS = ("ross-rotordynamics==2.3.0", "plotly==6.9.0", "numpy==2.4.6", "scipy==1.17.1", "pandas==3.1.1",
        "numba==0.68.1", "CoolProp==8.0.0")
PEERS = {"opentorsion": OPENTORSION, "ross": ROSS}


def halfshaft(program=None, example=None):
    """The release build of the program, and of the example that times the analyses by themselves."""
    if program is None:
        print("building halfshaft ...", file=sys.stderr, flush=True)
        program = built("halfshaft-cli") / "halfshaft"
        built("halfshaft-parquet")
        example = example or built("halfshaft-analysis", "torsional_times") / "examples" / "torsional_times"
    program = Path(program)
    return program, Path(example or program.parent / "examples" / "torsional_times")
