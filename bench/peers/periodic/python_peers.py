"""Peers in Python: each case is one process in the peer's own environment."""

import dataclasses
import json
import resource
import subprocess
from pathlib import Path

from processes import Failure, median
from table import Found, Row

HERE = Path(__file__).resolve().parent
# Set for the table only: what jaxcont is run with.
JAXCONT_MESH = {"ntst": 7, "ncol": 5, "longest": 0.5, "points": 260}


def described(case):
    """The case as both scripts read it."""
    wanted = [r.frequency for r in case.references if r.kind == "sample"]
    return {"line": dataclasses.asdict(case.line), "low": case.low, "high": case.high,
            "base": case.base, "scale": case.scale, "downwards": case.downwards, "wanted": wanted,
            "weights": case.weights}


class Side:
    """A Python peer: the process traces the curve once to compile, then as often as it is asked."""

    def __init__(self, name, python, script, label, description, remark):
        self.name, self.label, self.remark = name, label, remark
        self.command = [str(python), str(HERE / script)]
        self.folder = Path(python).parents[1]  # peers may leave files where they run
        self.description = description
        self.whole, self.inside, self.last = [], [], None

    def once(self):
        """One process; its processor time comes from the system's account of ended children."""
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run(self.command, input=json.dumps(self.description), capture_output=True,
                              text=True, timeout=900, cwd=self.folder)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if done.returncode != 0:
            raise Failure(f"{self.name} failed:\n{done.stderr[-1500:]}")
        self.last = json.loads(done.stdout)
        traced = sum(self.last["inside"])
        spent = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        # The first curve compiles and the further ones repeat it: a whole process traces one.
        self.whole.append(1e3 * (spent - traced))
        self.inside += [1e3 * seconds for seconds in self.last["inside"]]

    def row(self):
        """Medians and what the last process found."""
        found = [Found(kind, frequency, amplitude) for kind, frequency, amplitude in self.last["found"]]
        return Row(self.name, self.label, self.last["samples"], median(self.whole), median(self.inside),
                   found, self.remark)


def pyharm(python, case, settings):
    """pyHarm on one case."""
    description = {**described(case), "harmonics": list(settings.harmonics), "times": settings.times,
                   "longest": settings.longest, "repeats": 2}
    return Side("pyHarm", python, "pyharm_peer.py", settings.label(), description,
                "no stability; folds by polynomial")


def jaxcont(python, case):
    """jaxcont on the forced Duffing oscillator."""
    label = f"NTST {JAXCONT_MESH['ntst']}, NCOL {JAXCONT_MESH['ncol']}"
    return Side("jaxcont", python, "jaxcont_peer.py", label,
                {**described(case), **JAXCONT_MESH, "repeats": 1}, "")
