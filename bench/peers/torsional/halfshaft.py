"""halfshaft: the cases by its command line, and the analyses by themselves by an example."""

import json
import math
from pathlib import Path

import models
from environments import Failure, quietly
from processes import measured


def column(table, name):
    """Values of a column; a missing one is a torque that is not there."""
    return next((c["values"] for c in table["columns"] if c["name"] == name), None)


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
            # A line without gears that change is one table.
            table = self.answer(words)["gears"][0]["table"]
            found.append([self.orders(table, shaft, case.torque.orders)
                          for shaft in range(1, len(case.line.shafts) + 1)])
        return found

    @staticmethod
    def orders(table, shaft, orders):
        """Torque of a shaft at the first speed of a table, by orders; 0 where nothing excites one."""
        columns = (column(table, f"shaft {shaft}.torque.order{order}") for order in orders)
        return [values[0] if values else 0.0 for values in columns]

    def seconds(self, words):
        """Seconds of an analysis by itself, repeated in one process."""
        if not self.example.exists():
            raise Failure("the example torsional_times is not built")
        said = quietly([str(self.example), *map(str, words)], "torsional_times")
        return json.loads(said.splitlines()[-1])["seconds"]
