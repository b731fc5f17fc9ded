"""How far answers are from the references and from each other."""

import numpy as np

# Below this part of the lowest frequency that is not zero a frequency counts as zero.
ZERO = 1e-3


def vibrating(found, wanted):
    """The found frequencies without those that should be zero, and the largest of these."""
    found, wanted = np.sort(found), np.array([f for f in wanted if f > 0.0])
    low = found < ZERO * wanted[0]
    return found[~low], float(np.max(found[low], initial=0.0)), wanted


def frequencies(case, found):
    """Largest relative difference of the frequencies that are not zero, and a remark."""
    found, _, wanted = vibrating(found, case.frequencies)
    if len(found) < len(wanted):
        return None, f"{len(found)} of {len(wanted)} frequencies"
    return float(np.max(np.abs(found[:len(wanted)] / wanted - 1.0))), ""


def eigenvalues(case, found):
    """Largest relative difference, each to the nearest."""
    found = np.array([complex(*value) for value in found])
    wanted = [complex(*value) for value in case.eigenvalues]
    return max(float(np.min(np.abs(found - value))) / abs(value) for value in wanted), ""


def torques(case, found):
    """Largest relative difference of the moduli; for long chains relative to the largest of the line."""
    found = np.array(found)
    if case.summed:
        found = found.sum(axis=-1)
    errors = []
    for wanted in (case.torques, case.elastic):
        if wanted:
            wanted = np.array(wanted)
            scale = wanted.max(axis=1, keepdims=True) if case.scaled else wanted
            errors.append(float(np.max(np.abs(found - wanted) / scale)))
    if len(errors) == 2 and errors[1] < errors[0]:
        return errors[1], "without the part of the dampers"
    return errors[0], ""


JUDGES = {"frequencies": frequencies, "eigenvalues": eigenvalues, "torques": torques}


def count(case, quantity):
    """How many numbers are compared."""
    if quantity == "frequencies":
        return sum(f > 0.0 for f in case.frequencies)
    return len(case.eigenvalues) if quantity == "eigenvalues" else np.array(case.torques).size


def cell(case, quantity, said):
    """What stands in the table for one program, and remarks."""
    if quantity in said["cannot"]:
        return "-", said["cannot"][quantity]
    error, remark = JUDGES[quantity](case, said[quantity])
    return (f"{error:.1e}" if error is not None else "-"), remark


def apart(case, quantity, one, other):
    """Largest relative difference of two programs."""
    if quantity not in one or quantity not in other:
        return "-"
    a, b = one[quantity], other[quantity]
    if quantity == "frequencies":
        a, b = (vibrating(f, case.frequencies)[0] for f in (a, b))
        return f"{np.max(np.abs(a / b - 1.0)):.1e}" if len(a) == len(b) else "-"
    if quantity == "eigenvalues":
        a, b = (np.array([complex(*v) for v in values if abs(complex(*v)) > 1e-3]) for values in (a, b))
        return f"{max(np.min(np.abs(b - value)) / abs(value) for value in a):.1e}"
    a, b = np.array(a), np.array(b)
    scale = b.max(axis=1, keepdims=True) if case.scaled else b
    return f"{np.max(np.abs(a - b)[b > 0.0] / np.broadcast_to(scale, b.shape)[b > 0.0]):.1e}"


def published(case, said):
    """Whether a program's frequencies, rounded, are those in print."""
    if not case.published or "frequencies" not in said:
        return None
    found, _, _ = vibrating(said["frequencies"], case.frequencies)
    printed = [value for value in case.published if float(value) > 0.0]
    near = (abs(f - float(value)) <= 0.5001 * 10.0 ** -len(value.partition(".")[2])
            for f, value in zip(found, printed))
    return len(found) >= len(printed) and all(near)


def rigid(case, said):
    """Largest frequency in Hz that should be zero."""
    return vibrating(said["frequencies"], case.frequencies)[1] if "frequencies" in said else 0.0
