"""The cases as AUTO-07p runs them, and what its answers say of the special points."""

from cases import Case, first_harmonic
from processes import Failure, median
from table import Found, Row

TOLERANCES = {"EPSL": 1e-9, "EPSU": 1e-9, "EPSS": 1e-10}
COMMON = {
    "IPS": 2, "IRS": 0, "ILP": 1, "ICP": "[1,11]", "IAD": 3, "ISP": 2, "ISW": 1, "IPLT": 0,
    "NPR": 0, "MXBF": 0, "IID": 0, "ITMX": 9, "ITNW": 7, "NWTN": 3, "JAC": 1, "DSMIN": 1e-7,
    "IADS": 1, "THL": "{11: 0.0}", **TOLERANCES}


def constants_of(case: Case):
    """The case's numbers as AUTO's equations take them."""
    line, count = case.line, len(case.line.inertia)
    start = case.high if case.downwards else case.low
    numbers = {"base": case.base, "start": start - case.base, "amplitude": line.amplitude,
               "scale": case.scale}
    if count == 1:
        return "duffing", {**numbers, "stiffness": line.stiffness[0], "cubic": line.cubic[0],
                           "damping": line.damping[0]}
    cosine, sine = first_harmonic(line, start)
    return "chain", {
        **numbers, "n": count, "inertia": (1, line.inertia), "stiffness": (0, line.stiffness),
        "cubic": (0, line.cubic), "damping": (0, line.damping), "ground": (1, line.ground),
        "torque": (1, line.torque), "first_cosine": (1, cosine), "first_sine": (1, sine)}


class Side:
    """AUTO-07p on one case with one mesh, measured once per call of `once`."""

    def __init__(self, auto, case: Case, settings):
        self.case, self.settings = case, settings
        equations, numbers = constants_of(case)
        if case.fold_range:
            numbers["amplitude"] = case.fold_range[1]
        self.program = auto.program(f"{case.key} {settings.label()}".replace(" ", "-"), equations, numbers)
        self.trace = fold_curve if case.fold_range else response_curve
        self.whole, self.inside, self.samples, self.orbits = [], [], 0, []

    def once(self):
        """One more measurement."""
        whole, inside, self.samples, self.orbits = self.trace(self.program, self.case, self.settings)
        self.whole.append(1e3 * whole)
        self.inside.append(1e3 * inside)

    def row(self):
        """Medians and what the last run found."""
        found = [special(orbit, self.case) for orbit in self.orbits if orbit.kind != "end"]
        remark = "stopped at its number of samples" if self.samples >= self.settings.points else ""
        return Row("AUTO-07p", self.settings.label(), self.samples, median(self.whole),
                   median(self.inside), found, remark)


def special(orbit, case):
    """A labelled orbit as a special point."""
    kind = {"user": "sample"}.get(orbit.kind, orbit.kind)
    if case.fold_range and kind == "fold":
        kind = "cusp"  # where the frequency turns along a curve of folds
    return Found(kind, case.base + orbit.parameters[0], orbit.fundamental(case.weights),
                 orbit.parameters[1])


def response_curve(program, case, settings):
    """The response over the whole range, with multipliers and all special points."""
    samples = [r.frequency - case.base for r in case.references if r.kind == "sample"]
    sign = -1 if case.downwards else 1
    # The bounds lie a little outside, since the first orbit must not stand on one.
    constants = {
        **COMMON, "NDIM": 2 * len(case.line.inertia) + 2, "NTST": settings.ntst,
        "NCOL": settings.ncol, "DS": sign * case.first_step, "DSMAX": settings.longest,
        "NMX": settings.points, "RL0": 0.999 * case.low - case.base,
        "RL1": 1.001 * case.high - case.base}
    if samples:
        constants["UZR"] = f"{{1: {samples}}}"
    answer = program.run(constants)
    return answer.run.seconds, answer.own_seconds, answer.samples, answer.orbits


def fold_curve(program, case, settings):
    """From a fold at the largest parameter through the cusp back to the largest parameter.

    Three processes, as AUTO is used: the response to its first fold, starting data for the larger
    system of folds, and the curve of folds. The times of all count, the samples are the curve's.
    """
    lowest, largest = case.fold_range
    mesh = {**COMMON, "NDIM": 4, "NTST": settings.ntst, "NCOL": settings.ncol}
    response = program.run({**mesh, "DS": case.first_step, "DSMAX": 0.3, "NMX": 300,
                            "STOP": "['LP1']"})
    fold = next((i for i, orbit in enumerate(response.orbits, 1) if orbit.kind == "fold"), None)
    if fold is None:
        raise Failure("AUTO found no fold to start the fold curve from")
    # Rounding in the test function of the larger system does not let AUTO locate closer than this.
    folds = {**mesh, "EPSS": 1e-8, "ISW": 2, "ICP": "[1,2,11]", "DSMAX": settings.longest}
    ready = program.run({**folds, "IRS": fold, "DS": -1e-3, "NMX": 5}, program.labels())
    stops = f"{{2: [{lowest}, {largest * 1.0001}]}}"
    curve = program.run({**folds, "IRS": len(response.orbits) + len(ready.orbits), "NMX": settings.points,
                         "DS": settings.longest / 5, "UZSTOP": stops}, program.labels())
    runs = (response, ready, curve)
    return (sum(one.run.seconds for one in runs), sum(one.own_seconds for one in runs),
            curve.samples, curve.orbits)
