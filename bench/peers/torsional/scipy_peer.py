"""NumPy and SciPy as one would write it by hand for a chain, without any program around it.

    scipy_peer.py TASK.json ANSWER.json
"""

import numpy as np
from scipy.linalg import eigh, eigh_tridiagonal

import tasks


def chain(line):
    """Inertias, stiffnesses and dampings of a chain."""
    inertia = np.array([value for _, value in line["inertia"]])
    return inertia, *(np.array([shaft[key] for shaft in line["shafts"]]) for key in ("stiffness", "damping"))


def diagonals(shafts):
    """Diagonal and first side diagonal of a chain's matrix."""
    zero = np.zeros(1)
    return np.concatenate([shafts, zero]) + np.concatenate([zero, shafts]), -shafts


def dense(line):
    """Frequencies and shapes by dense matrices."""
    inertia, stiffness, _ = chain(line)
    main, side = diagonals(stiffness)
    return eigh(np.diag(main) + np.diag(side, 1) + np.diag(side, -1), np.diag(inertia))


def tridiagonal(line):
    """Frequencies and shapes by the three diagonals of a symmetric standard problem."""
    inertia, stiffness, _ = chain(line)
    main, side = diagonals(stiffness)
    root = np.sqrt(inertia)
    values, vectors = eigh_tridiagonal(main / inertia, side / (root[:-1] * root[1:]))
    return values, vectors / root[:, None]


def torques(line, torque):
    """Shaft torques over speed, shaft and order: one elimination along the chain for all speeds at once."""
    inertia, stiffness, damping = chain(line)
    w = np.outer(torque["speeds"], torque["orders"]).ravel()
    shaft = stiffness[:, None] + 1j * damping[:, None] * w
    main = -inertia[:, None] * w**2 + 0j
    main[:-1] += shaft
    main[1:] += shaft
    angle = np.zeros_like(main)
    angle[torque["node"]] = np.ravel(torque["amplitudes"])
    for i in range(1, len(main)):
        factor = shaft[i - 1] / main[i - 1]
        main[i] -= factor * shaft[i - 1]
        angle[i] += factor * angle[i - 1]
    angle[-1] /= main[-1]
    for i in range(len(main) - 2, -1, -1):
        angle[i] = (angle[i] + shaft[i] * angle[i + 1]) / main[i]
    found = shaft * (angle[:-1] - angle[1:])
    return np.swapaxes(found.reshape(len(found), len(torque["speeds"]), -1), 0, 1)


def modes(task):
    """Seconds of both ways, warm."""
    return {"seconds": tasks.timed({"eigh": lambda: dense(task["line"]),
                                    "eigh_tridiagonal": lambda: tridiagonal(task["line"])}, task["repeats"])}


def forced(task):
    """Seconds for all speeds, warm."""
    return {"seconds": tasks.timed({"elimination": lambda: torques(task["line"], task["torque"])},
                                   task["repeats"])}


def modes_once(task):
    """Frequencies and shapes, kept as NumPy writes them."""
    values, shapes = (tridiagonal if task["way"] == "tridiagonal" else dense)(task["line"])
    np.savez(task["out"], frequencies=np.sqrt(np.abs(values)), shapes=shapes)
    return {}


def forced_once(task):
    """Torques at all speeds, kept as NumPy writes them."""
    np.savez(task["out"], torques=np.abs(torques(task["line"], task["torque"])))
    return {}


tasks.run({"modes": modes, "forced": forced, "modes once": modes_once, "forced once": forced_once})
