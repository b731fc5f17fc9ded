"""The cases: equations, ranges, reference numbers and each program's settings.

Every case is a chain of inertias: shaft 0 goes from ground to the first inertia, shaft i from
inertia i to inertia i + 1. One description serves all programs: halfshaft reads it from a model
file (models.py writes those of the chains), AUTO-07p as constants of its equations, pyHarm as
matrices and connectors.
"""

from dataclasses import dataclass


@dataclass(frozen=True)
class Line:
    """m(i) x(i)'' + ground(i) x(i)' = h(i-1) - h(i) + torque(i) amplitude cos(w t)."""

    inertia: tuple
    stiffness: tuple
    cubic: tuple
    damping: tuple
    ground: tuple
    torque: tuple
    amplitude: float


@dataclass(frozen=True)
class Reference:
    """A special point (or a plain sample) that all programs should give."""

    kind: str
    frequency: float
    harmonic1: float | None = None
    parameter: float | None = None


@dataclass(frozen=True)
class AutoSettings:
    """Mesh intervals, collocation points in each, largest step; tolerances are 1e-9 or better."""

    name: str
    ntst: int
    ncol: int
    longest: float
    points: int = 2000

    def label(self):
        """As it stands in the table."""
        return f"{self.name}, NTST {self.ntst}, NCOL {self.ncol}"


@dataclass(frozen=True)
class PyharmSettings:
    """Harmonics, samples in time, largest step."""

    harmonics: tuple
    times: int
    longest: float

    def label(self):
        """As it stands in the table."""
        return f"harmonics {', '.join(map(str, self.harmonics))}; {self.times} times"


@dataclass(frozen=True)
class Case:
    """One case; `base` is the frequency about which AUTO continues a detuning."""

    key: str
    title: str
    model: str
    line: Line
    low: float
    high: float
    base: float
    scale: float
    downwards: bool
    first_step: float
    channel: str
    weights: dict
    references: tuple
    auto: tuple = ()
    pyharm: tuple = ()
    jaxcont: bool = False
    averaged: bool = False
    fold_range: tuple | None = None
    fold_tolerance: float = 1e-8
    points: int | None = None


# The theory's driveline: natural frequency, cubic and damping of its one oscillator.
OMEGA_1 = 26.057723985895066
THEORY = Line((1.0,), (OMEGA_1**2,), (-0.679004979325091,), (0.0951876139240782,), (0.0,), (1.0,), 15.0)
HARDENING = Line((1.0,), (1.0,), (0.1,), (0.05,), (0.0,), (1.0,), 0.18)
ABSORBER = Line((1.0, 0.05), (1.0, 0.0453), (1.0, 0.0042), (0.002, 0.013), (0.0, 0.0), (1.0, 0.0), 0.11)


def chain(count):
    """Reference chain: every shaft between inertias softens, the one to ground is linear."""
    return Line(
        (1.0,) * count, (1000.0,) * count, (0.0,) + (-500.0,) * (count - 1),
        (0.0,) + (0.5,) * (count - 1), (0.05,) * count, (0.0,) * (count - 1) + (1.0,), 5.0)


def one_nonlinear(count):
    """A uniform linear line of `count` inertias on one soft, hardening shaft to ground.

    Total inertia, compliance and damping stay as `count` grows, and with them the response: only
    the linear rest gets finer, so that the time per sample tells what that rest costs.
    """
    finer = count / 10
    rest = count - 1
    return Line(
        (1.0 / finer,) * count, (100.0,) + (1000.0 * finer,) * rest, (5.0,) + (0.0,) * rest,
        (0.5,) + (0.5 * finer,) * rest, (0.05 / finer,) * count, (0.0,) * rest + (1.0,), 5.0)


DUFFING = Case(
    "duffing", "Forced Duffing of the theory, f = 15", "duffing-theory.toml", THEORY,
    25.0, 26.6, OMEGA_1, OMEGA_1, False, 0.02, "shaft.twist", {0: 1.0},
    (Reference("fold", OMEGA_1 - 0.16653615376, 2.5302800018),
     Reference("fold", OMEGA_1 - 0.3714820758753, 6.1221485266)),
    auto=(AutoSettings("accurate", 7, 7, 0.05), AutoSettings("accurate, long steps", 7, 7, 0.3),
          AutoSettings("fast", 7, 5, 0.05), AutoSettings("fast, long steps", 7, 5, 0.3)),
    pyharm=(PyharmSettings((1, 3, 5), 32, 0.1),), jaxcont=True, averaged=True,
    fold_tolerance=1e-10, points=140)

HARDENING_CASE = Case(
    "hardening", "Hardening Duffing D1", "duffing-hardening.toml", HARDENING,
    0.5, 1.8, 1.2, 1.0, False, 0.01, "shaft.twist", {0: 1.0},
    (Reference("fold", 1.2696019555, 2.82501671), Reference("fold", 1.1157002518, 1.08187032)),
    auto=(AutoSettings("accurate", 10, 6, 0.05), AutoSettings("accurate, long steps", 10, 6, 0.15),
          AutoSettings("fast", 10, 4, 0.05), AutoSettings("fast, long steps", 10, 4, 0.15)),
    pyharm=(PyharmSettings((1, 3, 5, 7, 9), 64, 0.1),), averaged=True, fold_tolerance=1e-10, points=85)

FOLDS = Case(
    "folds", "Fold curve of the theory's Duffing through its cusp", "duffing-theory.toml", THEORY,
    25.0, 26.6, OMEGA_1, OMEGA_1, False, 0.02, "shaft.twist", {0: 1.0},
    (Reference("cusp", OMEGA_1 - 0.082314212998, None, 6.761266972852),),
    auto=(AutoSettings("accurate", 7, 7, 0.1), AutoSettings("accurate, long steps", 7, 7, 0.25),
          AutoSettings("fast", 7, 5, 0.1), AutoSettings("fast, long steps", 7, 5, 0.25)),
    averaged=True, fold_range=(4.0, 20.0), fold_tolerance=1e-7, points=600)

ABSORBER_CASE = Case(
    "absorber", "Two inertias with an absorber", "absorber.toml", ABSORBER,
    1.0, 1.45, 1.2, 1.0, True, 0.01, "support.twist", {0: 1.0},
    (Reference("neimark-sacker", 1.1127112391), Reference("neimark-sacker", 1.1957366691),
     Reference("fold", 1.2146262252), Reference("fold", 1.2062194574)),
    auto=(AutoSettings("accurate", 10, 5, 0.02), AutoSettings("accurate, long steps", 10, 5, 0.3),
          AutoSettings("fast", 10, 4, 0.02), AutoSettings("fast, long steps", 10, 4, 0.3)),
    pyharm=(PyharmSettings((1, 3, 5, 7), 32, 0.1),), points=165)

TEN = Case(
    "ten", "Chain of ten, nine nonlinear shafts", "chain-of-ten.toml", chain(10),
    4.3, 4.9, 4.6, 4.6, False, 0.02, "inertia 10.angle", {9: 1.0},
    (Reference("fold", 4.6414820021, 1.7122196749), Reference("fold", 4.590778663, 3.29302118)),
    auto=(AutoSettings("accurate", 15, 6, 0.1), AutoSettings("fast", 20, 4, 0.1),
          AutoSettings("fast, long steps", 20, 4, 0.5)),
    pyharm=(PyharmSettings((1, 3, 5, 7), 64, 0.2), PyharmSettings((1, 3, 5, 7, 9, 11), 96, 0.2)),
    points=85)

FIFTY = Case(
    "fifty", "Chain of fifty, 49 nonlinear shafts", "chain-of-fifty.toml", chain(50),
    0.88, 1.1, 0.98, 0.98, False, 0.05, "inertia 50.angle", {49: 1.0},
    (Reference("sample", 0.96, 3.0701139596), Reference("sample", 1.0, 3.1888430948)),
    auto=(AutoSettings("accurate", 15, 4, 3.0, 100), AutoSettings("fast", 10, 4, 3.0, 100)),
    pyharm=(PyharmSettings((1, 3, 5), 32, 1.0),), points=80)

CURVES = (DUFFING, HARDENING_CASE, FOLDS, ABSORBER_CASE, TEN, FIFTY)
# Folds of the line with one nonlinear shaft, and the fundamental of the first inertia's angle.
SCALING = {
    10: (Reference("fold", 2.89911665590, 1.822900095), Reference("fold", 2.87209839536, 1.083293452)),
    30: (Reference("fold", 2.86216408336, 1.825494561), Reference("fold", 2.83683437962, 1.093162998)),
    100: (Reference("fold", 2.84913391247, 1.825694499), Reference("fold", 2.82443784809, 1.096669120)),
    300: (Reference("fold", 2.84540317188, 1.825685598), Reference("fold", 2.82089162514, 1.097676002)),
    1000: (Reference("fold", 2.84409663649, 1.825675595), Reference("fold", 2.81965001676, 1.098028959)),
}
SCALING_RANGE = (2.5, 3.5)


def first_harmonic(line, frequency):
    """Linear response at one frequency as cosine and sine parts: where AUTO starts."""
    import numpy as np

    count = len(line.inertia)
    dynamic = np.zeros((count, count), complex)
    for i, (inertia, ground) in enumerate(zip(line.inertia, line.ground)):
        dynamic[i, i] = 1j * frequency * ground - frequency**2 * inertia
    for i, (stiffness, damping) in enumerate(zip(line.stiffness, line.damping)):
        shaft = stiffness + 1j * frequency * damping
        dynamic[i, i] += shaft
        if i > 0:
            dynamic[i - 1, i - 1] += shaft
            dynamic[i, i - 1] -= shaft
            dynamic[i - 1, i] -= shaft
    response = np.linalg.solve(dynamic, line.amplitude * np.array(line.torque))
    return response.real.tolist(), (-response.imag).tolist()

