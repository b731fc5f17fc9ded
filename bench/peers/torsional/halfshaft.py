"""halfshaft: the cases by its command line, and the analyses by themselves by an example."""

import json
import math
from pathlib import Path

import models
from environments import Failure, quietly
from processes import measured


def every_shaft(line):
    """The flag that asks for all orders of all shafts, which long lines do not tell unasked."""
    return ["--shaft", ",".join(f"shaft {i}" for i in range(1, len(line.shafts) + 1))]


def by_order(answer, case, acting=None):
    """Moduli of the shaft torques over speed, shaft and order; 0 for an order that does not act."""
    # A line without gears that change is one table.
    columns = {c["name"]: c["values"] for c in answer["gears"][0]["table"]["columns"]}
    orders = list(zip(case.torque.orders, acting or [True] * len(case.torque.orders)))
    try:
        shafts = [[columns[f"shaft {shaft}.torque.order{order}"] if acts else [0.0] * len(columns["frequency"])
                   for order, acts in orders] for shaft in range(1, len(case.line.shafts) + 1)]
    except KeyError as name:
        raise Failure(f"no column {name}") from None
    return [[[values[at] for values in shaft] for shaft in shafts] for at in range(len(columns["frequency"]))]


class Halfshaft:
    """The program, its example, and a folder for model files and results."""

    name = "halfshaft"

    def __init__(self, program, example, work):
        self.program, self.example, self.work = str(program), Path(example), work
        if not Path(self.program).exists():
            raise Failure(f"{self.program} is missing: build it as README.md says")

    def asked(self, words):
        """Runs the program once."""
        run = measured([self.program, *map(str, words), "--quiet"])
        if run.status != 0:
            said = [line for line in run.errors.splitlines() if line.startswith("error")]
            raise Failure(said[0] if said else f"ended with status {run.status}")
        return run

    def answer(self, words):
        """One answer as JSON."""
        return json.loads(self.asked([*words, "--json"]).output)

    def agreement(self, cases):
        """Answers to all cases, or for each quantity why not."""
        return {case.key: self.case(case) for case in cases}

    def case(self, case):
        """Answers to one case."""
        found = {"cannot": {}}
        wanted = {"frequencies": self.frequencies}
        wanted |= {"eigenvalues": self.eigenvalues} if case.eigenvalues else {}
        wanted |= {"torques": self.torques} if case.torque else {}
        for quantity, way in wanted.items():
            try:
                found[quantity] = way(case)
            except Failure as failure:
                found["cannot"][quantity] = str(failure)
        return found

    def modes(self, case):
        """The list of modes."""
        model = models.written(self.work, case.key, case.title, case.line)
        return self.answer(["modes", model])["modes"]

    def frequencies(self, case):
        """Undamped natural frequencies in Hz."""
        return [mode["frequency"] / (2.0 * math.pi) for mode in self.modes(case)]

    def eigenvalues(self, case):
        """Eigenvalues of the damped line that are on or above the real axis."""
        pairs = [pair for mode in self.modes(case) for pair in mode["eigenvalues"]]
        return [pair for pair in pairs if pair[1] >= 0.0]

    def torques(self, case):
        """Moduli of the shaft torques over speed, shaft and order: one model for each speed."""
        found = []
        for at, speed in enumerate(case.torque.speeds):
            name = f"{case.key}-{at + 1}"
            model = models.written(self.work, name, case.title, case.line, case.torque, at)
            words = ["forced", model, "--frequency", f"{speed!r}..{speed * 1.001!r}", "--points", 2]
            answer = self.answer([*words, *every_shaft(case.line)])
            acting = [amplitude > 0.0 for amplitude in case.torque.amplitudes[at]]
            found.append(by_order(answer, case, acting)[0])
        return found

    def seconds(self, words):
        """Seconds of an analysis by itself, repeated in one process."""
        if not self.example.exists():
            raise Failure("the example torsional_times is not built")
        said = quietly([str(self.example), *map(str, words)], "torsional_times")
        return json.loads(said.splitlines()[-1])["seconds"]
