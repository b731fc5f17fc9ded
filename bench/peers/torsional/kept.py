"""What the timed processes left behind, judged by the closed solution of the uniform chain."""

import json

import numpy as np

import judgement
from environments import Failure
from halfshaft import by_order


def frequencies(path, _):
    """Natural frequencies in Hz."""
    if path.suffix == ".json":
        return [mode["frequency"] / (2.0 * np.pi) for mode in json.loads(path.read_text())["modes"]]
    return np.load(path)["frequencies"] / (2.0 * np.pi)


def torques(path, case):
    """Moduli of the torques over speed, shaft and order."""
    if path.suffix == ".json":
        return by_order(json.loads(path.read_text()), case)
    return np.load(path)["torques"]


def judged(quantity, path, case):
    """The error as it stands in the table, and a remark; nothing where the file is not read here."""
    if path is None or path.suffix not in (".json", ".npz"):
        return "-", ""
    try:
        found = {"frequencies": frequencies, "torques": torques}[quantity](path, case)
    except Failure:
        # Sums of the orders have no reference.
        return "-", ""
    error, remark = judgement.JUDGES[quantity](case, found)
    return (f"{error:.1e}" if error is not None else "-"), remark
