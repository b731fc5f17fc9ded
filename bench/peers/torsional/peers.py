"""The peers as processes: each task is a file that the peer's script reads, each answer one it writes."""

import dataclasses
import json
from pathlib import Path

from environments import PEERS, Failure, environment
from processes import measured

HERE = Path(__file__).resolve().parent
SCRIPTS = {"opentorsion": "opentorsion_peer.py", "ross": "ross_peer.py", "SciPy": "scipy_peer.py"}


class Peer:
    """A script in the environment of its program."""

    def __init__(self, name, python, work):
        self.name, self.python, self.work = name, str(python), work

    def measured(self, task):
        """Runs the script once; the run and its answer."""
        asked, answered = (self.work / f"{self.name}-{kind}.json" for kind in ("task", "answer"))
        asked.write_text(json.dumps(task))
        # Where the peer runs it may leave files.
        run = measured([self.python, str(HERE / SCRIPTS[self.name]), str(asked), str(answered)], self.work)
        if run.status != 0:
            raise Failure(f"{self.name} failed: {(run.errors.strip().splitlines() or ['?'])[-1]}")
        return run, json.loads(answered.read_text())

    def agreement(self, cases):
        """Answers to all cases."""
        task = {"do": "agreement", "cases": [dataclasses.asdict(case) for case in cases]}
        return self.measured(task)[1]

    def seconds(self, what, line, repeats, torque=None, few=None):
        """Seconds of the analyses by themselves, by their names."""
        task = {"do": what, "line": dataclasses.asdict(line), "repeats": repeats, "few": few,
                "torque": dataclasses.asdict(torque) if torque else None}
        return self.measured(task)[1]["seconds"]

    def once(self, what, line, torque=None, way=""):
        """Processor seconds of a whole process that makes the analysis once, and where its result is kept."""
        out = self.work / f"{self.name}-{what}{way and '-'}{way}.npz"
        task = {"do": f"{what} once", "line": dataclasses.asdict(line), "out": str(out), "way": way,
                "torque": dataclasses.asdict(torque) if torque else None}
        return self.measured(task)[0].seconds, out


def ready(names, work):
    """The peers that could be made ready, and for the others why not."""
    found, missing = {}, {}
    for name in names:
        try:
            python = environment(work / name, PEERS[name])
        except Failure as failure:
            missing[name] = str(failure).strip().splitlines()[-1]
            continue
        found[name] = Peer(name, python, work)
        # NumPy and SciPy by themselves come with openTorsion.
        if name == "opentorsion":
            found["SciPy"] = Peer("SciPy", python, work)
    return found, missing
