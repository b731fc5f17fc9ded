"""Drives AUTO-07p: builds it, writes its constants, runs it and reads its answers.

AUTO's sources come with the Python package `bifpy`. They are compiled here with full optimisation
and every case is linked to a program of its own, as AUTO's own command line does; the package's
Python layer, which would slow AUTO down, is left out.
"""

import shutil
import subprocess
from dataclasses import dataclass, field
from pathlib import Path

from processes import Failure, Run, measured

HERE = Path(__file__).resolve().parent
# Compilation order of AUTO's modules, as in its makefile.
MODULES = (
    "auto_constants nompi f2003 mesh support io ae interfaces toolboxae equilibrium solvebv bvp "
    "toolboxbv homcont maps floquet periodic optimization parabolic timeint user_c utility"
).split()
FLAGS = ["-O3", "-march=native"]
KINDS = {5: "fold", 6: "branch-point", 7: "period-doubling", 8: "neimark-sacker", -4: "user", 9: "end"}


@dataclass
class Orbit:
    """A labelled solution: kind, parameters by number (from 1), mesh and states."""

    kind: str
    parameters: list
    times: list
    states: list
    order: int

    def fundamental(self, weights):
        """Modulus of the first harmonic of the combination `weights` ({state: factor})."""
        values = [sum(f * row[i] for i, f in weights.items()) for row in self.states]
        return first_harmonic(self.times, values, self.order)


@dataclass
class Answer:
    """What one run of AUTO gave: rows of its curve, labelled orbits, processor time."""

    run: Run
    samples: int
    own_seconds: float
    rows: list = field(default_factory=list)
    orbits: list = field(default_factory=list)


class Auto:
    """AUTO's object files in `folder`, built from the unpacked package `sources` if need be."""

    def __init__(self, sources, folder):
        self.sources, self.folder = Path(sources) / "auto", Path(folder)
        if shutil.which("gfortran") is None:
            raise Failure("AUTO-07p needs the Fortran compiler gfortran (package gfortran)")
        if not (self.folder / "libauto.a").exists():
            self._build()

    def _compile(self, *arguments):
        done = subprocess.run(
            ["gfortran", *FLAGS, f"-I{self.sources}/include", *map(str, arguments)],
            cwd=self.folder, capture_output=True, text=True)
        if done.returncode != 0:
            raise Failure(f"gfortran failed on {arguments[-1]}:\n{done.stderr[-2000:]}")

    def _build(self):
        self.folder.mkdir(parents=True, exist_ok=True)
        for module in MODULES:
            self._compile("-c", self.sources / "src" / f"{module}.f90")
        for library in ("blas", "lapack"):
            self._compile("-std=legacy", "-w", "-c", self.sources / "depends" / f"{library}.f")
        self._compile("-c", self.sources / "native" / "main.f90")
        objects = [f"{name}.o" for name in (*MODULES, "blas", "lapack")]
        subprocess.run(["ar", "cr", "libauto.a", *objects], cwd=self.folder, check=True)

    def program(self, name, equations, constants):
        """A program for one case: its equations compiled with its numbers as constants."""
        place = self.folder / name
        shutil.rmtree(place, ignore_errors=True)
        place.mkdir(parents=True)
        (place / "case.inc").write_text(include_file(constants))
        program = place / "program"
        self._compile(f"-I{place}", HERE / "auto" / f"{equations}.f90", "main.o", "libauto.a",
                      "-o", program)
        return Program(program)


class Program:
    """A linked case, run in its own folder."""

    def __init__(self, path):
        self.path, self.folder = path, path.parent

    def run(self, constants, restart=None):
        """One run under AUTO's `constants`, from the labels of an earlier run if given."""
        for old in self.folder.glob("fort.*"):
            if old.name != "fort.3":
                old.unlink()
        if restart is not None:
            (self.folder / "fort.3").write_text(restart)
        text = "\n".join(f"{key}={value}" for key, value in constants.items())
        # AUTO reads a constants file of this style only if it begins with a comment line.
        (self.folder / "fort.2").write_text(f"# constants\n{text}\n")
        run = measured([str(self.path)], cwd=self.folder)
        return self._read(run)

    def labels(self):
        """The labelled solutions of the last run, as text to restart from."""
        return (self.folder / "fort.8").read_text()

    def _read(self, run):
        table = self.folder / "fort.7"
        rows = [line.split() for line in table.read_text().splitlines()] if table.exists() else []
        rows = [row for row in rows if row and row[0] != "0"]
        own = [line for line in run.output.splitlines() if "Total Time" in line]
        if run.status != 0 or not own or not rows:
            raise Failure(f"AUTO failed in {self.folder}:\n{run.output[-800:]}{run.errors[-800:]}")
        if any(remainder(int(row[2])) == -9 for row in rows):
            raise Failure(f"AUTO did not converge (MX) in {self.folder}:\n{run.output[-800:]}")
        return Answer(run, len(rows), float(own[-1].split()[-1]),
                      [[number(cell) for cell in row[4:]] for row in rows],
                      read_orbits(self.folder / "fort.8"))


def include_file(constants):
    """Fortran declarations of numbers, and of arrays given as (lower bound, values)."""
    lines = []
    for name, value in constants.items():
        if isinstance(value, int):
            lines.append(f"  INTEGER, PARAMETER :: {name} = {value}")
        elif isinstance(value, float):
            lines.append(f"  DOUBLE PRECISION, PARAMETER :: {name} = {fortran(value)}")
        else:
            low, values = value
            body = ", &\n    ".join(fortran(v) for v in values)
            lines.append(f"  DOUBLE PRECISION, PARAMETER :: {name}({low}:{low + len(values) - 1}) = "
                         f"(/ &\n    {body} /)")
    return "\n".join(lines) + "\n"


def fortran(value):
    """A double precision literal."""
    text = repr(float(value))
    return text.replace("e", "D") if "e" in text else text + "D0"


def read_orbits(path):
    """All labelled solutions of a file of AUTO's."""
    tokens = iter(path.read_text().split())
    orbits = []
    for first in tokens:
        head = [int(first)] + [int(next(tokens)) for _ in range(15)]
        kind, active, points, width, nodes, order, parameters = (
            head[2], head[4], head[6], head[7], head[9], head[10], head[11])
        table = [[number(next(tokens)) for _ in range(width)] for _ in range(points)]
        skip = 2 * active + points * (width - 1) if nodes > 0 else 0
        for _ in range(skip):
            next(tokens)
        values = [number(next(tokens)) for _ in range(parameters)]
        orbits.append(Orbit(KINDS.get(remainder(kind), str(kind)), values, [row[0] for row in table],
                            [row[1:] for row in table], order))
    return orbits


def remainder(kind):
    """AUTO's kind of point without the tens, which tell the kind of curve."""
    return kind % 10 if kind >= 0 else -(-kind % 10)


def number(text):
    """A Fortran number; an exponent of three digits may lack its letter."""
    try:
        return float(text)
    except ValueError:
        return 0.0


def first_harmonic(times, values, order):
    """Modulus of the first harmonic of a piecewise polynomial of degree `order`.

    The polynomials are the collocation solution itself; they are integrated against the exponential
    by Gauss' rule, so that nothing is lost beyond AUTO's own discretisation.
    """
    import numpy as np

    points, weights = np.polynomial.legendre.leggauss(order + 4)
    local = (points + 1) / 2
    nodes = np.linspace(0, 1, order + 1)
    basis = np.array([[np.prod([(z - nodes[k]) / (nodes[j] - nodes[k])
                                for k in range(order + 1) if k != j])
                       for j in range(order + 1)] for z in local])
    total = 0j
    times, values = np.array(times), np.array(values)
    for begin in range(0, len(times) - 1, order):
        low, high = times[begin], times[begin + order]
        at = basis @ values[begin:begin + order + 1]
        wave = np.exp(-2j * np.pi * (low + (high - low) * local))
        total += (high - low) / 2 * np.sum(weights * at * wave)
    return 2 * abs(total)
