"""Traces one case with pyHarm; runs inside pyHarm's own environment, started by run.py.

Reads a JSON description on standard input, writes one on standard output. pyHarm has neither
stability nor special points: folds are taken from a polynomial through the samples about the turn,
which costs it nothing here.
"""

import json
import logging
import sys
import time
import warnings


def matrices(line):
    """Mass, damping and linear stiffness of the chain."""
    import numpy as np

    count = len(line["inertia"])
    stiffness, damping = np.zeros((count, count)), np.diag(np.array(line["ground"], float))
    for matrix, values in ((stiffness, line["stiffness"]), (damping, line["damping"])):
        matrix[0, 0] += values[0]
        for i in range(1, count):
            matrix[i - 1, i - 1] += values[i]
            matrix[i, i] += values[i]
            matrix[i, i - 1] -= values[i]
            matrix[i - 1, i] -= values[i]
    return {"M": np.diag(np.array(line["inertia"], float)), "C": damping, "K": stiffness}


def description(case):
    """The case as pyHarm's input."""
    line = case["line"]
    connectors = {}
    for i, cubic in enumerate(line["cubic"]):
        if cubic:
            ends = {"line": [0]} if i == 0 else {"line": [i - 1], "INTERNAL": [i]}
            connectors[f"cubic {i}"] = {"type": "CubicSpring", "connect": ends, "dirs": [0], "k": cubic}
    for i, torque in enumerate(line["torque"]):
        if torque:
            connectors[f"torque {i}"] = {"type": "CosinusForcing", "connect": {"line": [i]}, "dirs": [0],
                                         "amp": torque * line["amplitude"]}
    tolerance = {"tol_residual": 1e-8, "tol_delta_x": 1e-8, "max_iter": 20}
    return {
        "system": {"type": "Base", "nh": case["harmonics"], "nti": case["times"]},
        "substructures": {"line": {"type": "substructure", "matrix": matrices(line), "ndofs": 1,
                                   "nmodes": 0, "matching": [0]}},
        "connectors": connectors,
        "analysis": {"response": {
            "study": "frf", "solver": "NewtonRaphson", "solver_options": tolerance,
            "predictor": "tangent", "corrector": "arc_length", "stepsizer": "acceptance",
            "ds_max": case["longest"], "ds_min": 1e-8, "ds0": case["longest"] / 10,
            "sign_ds": -1 if case["downwards"] else 1, "puls_inf": case["low"],
            "puls_sup": case["high"], "verbose": False}}}


def responses(maestro, weights):
    """Frequencies and complex first harmonics of a combination of the degrees of freedom."""
    import numpy as np

    places = maestro.system.expl_dofs
    first = places[places.harm == 1]
    solutions = [s.x for s in maestro.nls["response"].SolList if s.flag_accepted]
    wave = 0
    for node, factor in weights.items():
        own = first[first.node_num == int(node)]
        cosine, sine = own[own.cs == "c"].index[0], own[own.cs == "s"].index[0]
        wave = wave + factor * np.array([x[cosine] - 1j * x[sine] for x in solutions])
    return np.array([x[-1] for x in solutions]), wave


def folds(frequency, wave):
    """Where the frequency turns: of a polynomial in the phase through nine samples.

    The phase passes a resonance and its folds without turning, so that frequency and amplitude are
    smooth functions of it there.
    """
    import numpy as np

    phase, amplitude = np.unwrap(np.angle(wave)), np.abs(wave)
    found = []
    for i in range(4, len(frequency) - 4):
        if (frequency[i] - frequency[i - 1]) * (frequency[i + 1] - frequency[i]) >= 0:
            continue
        near = slice(i - 4, i + 5)
        local = (phase[near] - phase[i]) / np.ptp(phase[near])
        fits = [np.polynomial.Polynomial.fit(local, values[near], 8) for values in (frequency, amplitude)]
        turns = [root.real for root in fits[0].deriv().roots() if abs(root.imag) < 1e-9]
        at = min(turns, key=abs, default=0.0)
        found.append(("fold", float(fits[0](at)), float(fits[1](at))))
    return found


def samples(frequency, amplitude, wanted):
    """The response at given frequencies, by a polynomial through seven samples."""
    import numpy as np

    found = []
    for at in wanted:
        nearest = int(np.argmin(abs(frequency - at)))
        near = slice(max(nearest - 3, 0), nearest + 4)
        fit = np.polynomial.Polynomial.fit(frequency[near] - at, amplitude[near], len(frequency[near]) - 1)
        found.append(("sample", at, float(fit(0.0))))
    return found


def main():
    """The first curve compiles pyHarm's kernels or loads them; those after it are counted."""
    case = json.load(sys.stdin)
    warnings.simplefilter("ignore")
    logging.disable(logging.CRITICAL)
    import pyHarm

    inside = []
    for _ in range(case["repeats"] + 1):
        maestro = pyHarm.Maestro(description(case))
        begun = time.process_time()
        maestro.operate()
        inside.append(time.process_time() - begun)
    frequency, wave = responses(maestro, case["weights"])
    json.dump({"inside": inside[1:], "samples": len(frequency),
               "found": folds(frequency, wave) + samples(frequency, abs(wave), case["wanted"])},
              sys.stdout)


if __name__ == "__main__":
    main()
