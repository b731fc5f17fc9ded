"""The cases as halfshaft runs them: the released command line, and the question by itself."""

import json
import signal
from pathlib import Path

from processes import Failure, measured, median
from table import Found, Row

MODELS = Path(__file__).resolve().parent / "models"
# How often the question is repeated in one process to find what it costs without the start-up.
SHORT, LONG = 1, 11
# Processor seconds after which an answer is given up.
LIMIT = 60


class Halfshaft:
    """The program, the example that repeats a question, and the methods that this build knows."""

    def __init__(self, program, repeater, method=None):
        self.program, self.repeater = str(program), str(repeater)
        if not Path(self.program).exists():
            raise Failure(f"{self.program} is missing: build it as README.md says")
        # Without the example the start-up is taken from the shortest question of the program.
        self.repeats = Path(self.repeater).exists()
        options = measured([self.program, "resonance", "--help"]).output
        known = "harmonic-balance" in options
        self.method = method or ("harmonic-balance" if known else "averaged")
        self.tolerance = "--tolerance" in options

    def settings(self, case):
        """Name and flags of each way in which the program is run on a case."""
        flags = ["--method", self.method]
        if self.method != "harmonic-balance" or not self.tolerance:
            return [(self.method, flags)]
        strict = [*flags, "--tolerance", "1e-9"]
        ways = [("default", flags), ("tolerance 1e-9", strict)]
        if case.points:
            ways.append((f"tolerance 1e-9, points {case.points}", [*strict, "--points", str(case.points)]))
        return ways

    def can(self, case):
        """The averaged method speaks of one oscillator only."""
        return self.method != "averaged" or case.averaged

    def answer(self, words):
        """One answer as JSON with its processor seconds, start-up and writing included."""
        run = measured([self.program, *words, "--json", "--quiet"], limit=LIMIT)
        if run.status == -signal.SIGXCPU:
            raise Failure(f"more than {LIMIT} s")
        if run.status != 0:
            raise Failure(f"halfshaft {' '.join(words)} failed:\n{run.errors[-1500:]}")
        return run.seconds, json.loads(run.output)

    def inside(self, words, whole):
        """Processor seconds of the question by itself: the slope over the number of repeats."""
        verb, model, *flags = words
        # A start-up of milliseconds does not matter beside seconds, and eleven of these would.
        if not self.repeats or whole > 3.0:
            return max(whole - self.answer(["check", model])[0], 0.0)
        seconds = []
        for count in (SHORT, LONG):
            run = measured([self.repeater, str(count), model, verb, *flags])
            if run.status != 0:
                raise Failure(f"ask_repeatedly failed:\n{run.errors[-1500:]}")
            seconds.append(run.seconds)
        return max(seconds[1] - seconds[0], 0.0) / (LONG - SHORT)


def question(case, flags, model=None):
    """Verb, model file and flags."""
    model = str(model or MODELS / case.model)
    frequency = f"{case.low!r}..{case.high!r}"
    if case.fold_range:
        lowest, largest = case.fold_range
        return ["folds", model, "--frequency", frequency, "--parameter",
                f"excitation.amplitude={lowest!r}..{largest!r}", *flags]
    return ["resonance", model, "--frequency", frequency, *flags]


def tables(answer):
    """Branches or curves."""
    return answer.get("branches") or answer.get("curves") or []


def column(table, name):
    """Values of a column, or none."""
    return next((c["values"] for c in table["columns"] if c["name"] == name), None)


def samples(answer):
    """Number of responses listed over all branches, or of folds over all curves."""
    return sum(len(column(table, "frequency")) for table in tables(answer))


def found(answer, channel):
    """Special points of all branches, and those of the answer itself."""
    points = list(answer.get("special_points") or [])
    for table in tables(answer):
        points += table.get("special_points") or []
    address = answer.get("parameter")
    return [Found(point["kind"], point["frequency"], point.get(f"{channel}.harmonic1"),
                  point.get(address) if isinstance(address, str) else None)
            for point in points if point["kind"] != "end"]


def at_frequencies(half, case, flags):
    """Responses at the reference frequencies: where a branch starts at its range's lower end."""
    wanted = [r.frequency for r in case.references if r.kind == "sample"]
    points = []
    for frequency in wanted:
        words = ["resonance", str(MODELS / case.model), "--frequency",
                 f"{frequency!r}..{frequency * 1.001!r}", *flags]
        _, answer = half.answer(words)
        for table in tables(answer):
            frequencies = column(table, "frequency")
            amplitudes = column(table, f"{case.channel}.harmonic1")
            nearest = min(range(len(frequencies)), key=lambda i: abs(frequencies[i] - frequency))
            if abs(frequencies[nearest] - frequency) < 1e-9 * frequency and amplitudes:
                points.append(Found("sample", frequency, amplitudes[nearest]))
    return points


def has_stability(answer):
    """Whether every sample carries its stability."""
    return all(column(table, "stable") is not None for table in tables(answer))


class Side:
    """halfshaft on one case with one set of flags, measured once per call of `once`."""

    def __init__(self, half, case, name, flags, model=None):
        self.half, self.case, self.name, self.flags = half, case, name, flags
        self.words = question(case, flags, model)
        self.whole, self.inside, self.last = [], [], None

    def once(self):
        """One more measurement."""
        seconds, self.last = self.half.answer(self.words)
        self.whole.append(1e3 * seconds)
        self.inside.append(1e3 * self.half.inside(self.words, seconds))

    def row(self):
        """Medians and what the last answer says."""
        points = found(self.last, self.case.channel) + at_frequencies(self.half, self.case, self.flags)
        remarks = []
        if self.last["termination"]["reason"] != "completed":
            remarks.append(f"ended: {self.last['termination']['reason']}")
        if not self.case.fold_range and not has_stability(self.last):
            remarks.append("no stability")
        return Row("halfshaft", self.name, samples(self.last), median(self.whole), median(self.inside),
                   points, "; ".join(remarks))
