"""The uniform chain that is timed, and its closed solution."""

import math

import numpy as np

from cases import Case
from lines import Torque, chain

# The uniform chain that is timed: inertia, stiffness, and the two kinds of damping it is given.
INERTIA, STIFFNESS, DAMPING, MODAL = 0.5, 2e5, 10.0, 0.02
ORDERS, AMPLITUDES = (1, 2, 3, 4), (200.0, 50.0, 5.0, 2.0)
SLOWEST, FASTEST = 20.0, 300.0


def line(count, damping="none"):
    """`count` inertias; damping none, of the shafts, or of the modes."""
    damped = {"none": {}, "shafts": {"damping": DAMPING}, "modes": {"modal_damping": MODAL}}[damping]
    return chain((INERTIA,) * count, (STIFFNESS,) * (count - 1), **damped)


def excitation(speeds):
    """The excitation of the uniform chain at its first inertia, the same at all speeds."""
    return Torque(0, ORDERS, tuple(map(float, speeds)), (AMPLITUDES,) * len(speeds))


def speeds(points):
    """Speeds from the slowest to the fastest, in equal steps."""
    return np.linspace(SLOWEST, FASTEST, points)


def frequencies(count):
    """Natural frequencies of the free uniform chain in rad/s, exact."""
    return 2.0 * np.sqrt(STIFFNESS / INERTIA) * np.sin(np.arange(count) * np.pi / (2 * count))


def torques(count, at, damping):
    """Shaft torques of the uniform chain by its modes, which are cosines: whole and elastic part.

    Arrays of complex numbers over speed, shaft and order.
    """
    mode, shaft = np.arange(1, count), np.arange(1, count)
    omega = frequencies(count)[1:]
    norm = np.sqrt(2.0 / (count * INERTIA))
    first = norm * np.cos(mode * np.pi / (2 * count))
    # cos((2 i - 1) a) - cos((2 i + 1) a) = 2 sin(2 i a) sin(a)
    half = mode * np.pi / (2 * count)
    twist = 2.0 * norm * np.sin(2.0 * np.outer(half, shaft)) * np.sin(half)[:, None]
    rate = omega**2 * DAMPING / STIFFNESS if damping == "shafts" else 2.0 * MODAL * omega
    w = np.outer(at, ORDERS)[..., None]
    gain = first / (omega**2 - w**2 + 1j * w * rate)
    twists = (gain @ twist) * np.array(AMPLITUDES)[:, None]
    elastic = STIFFNESS * twists
    whole = elastic + 1j * w * DAMPING * twists if damping == "shafts" else elastic
    return np.swapaxes(whole, 1, 2), np.swapaxes(elastic, 1, 2)


def case(count, damping, points=5):
    """The uniform chain, judged by its closed solution; torques by the largest of the line."""
    at = speeds(points)
    whole, elastic = (tuple(map(tuple, abs(part).tolist())) for part in torques(count, at, damping))
    return Case(f"chain-{damping}", f"Uniform chain of {count}, damping of the {damping}",
                line(count, damping), tuple(frequencies(count) / (2.0 * math.pi)),
                torque=excitation(at), torques=whole, elastic=elastic, scaled=True, known=1e-11)
