"""SciPy: DOP853, one trajectory after the other, or all as one vectorised system.

    scipy_peer.py COUNT PERIODS TOLERANCE one|all OUT
"""

import json
import sys
import time

import numpy as np
from scipy.integrate import solve_ivp

import cases


def one(speed, start, end, tolerance):
    """One trajectory."""

    def rate(t, y):
        x, v = y
        torque = x * (cases.STIFFNESS + cases.CUBIC * x * x) + cases.DAMPING * v
        return (v, cases.FORCE * np.cos(speed * t) - torque)

    return solve_ivp(rate, (0.0, end), (start, 0.0), "DOP853", (end,), rtol=tolerance, atol=tolerance).y[:, -1]


def together(speeds, starts, periods, tolerance):
    """All trajectories in the phase of their excitations, which end together."""
    count = len(speeds)

    def rate(phase, y):
        x, v = y[:count], y[count:]
        torque = x * (cases.STIFFNESS + cases.CUBIC * x * x) + cases.DAMPING * v
        return np.concatenate((v / speeds, (cases.FORCE * np.cos(phase) - torque) / speeds))

    # The error is a mean over all components: a tighter tolerance for the worst of them.
    start, end = np.concatenate((starts, np.zeros(count))), periods * 2.0 * np.pi
    y = solve_ivp(rate, (0.0, end), start, "DOP853", (end,), rtol=tolerance, atol=tolerance).y[:, -1]
    return np.stack((y[:count], y[count:]), axis=1)


def main():
    """Integrates all, prints the rate, writes the ends."""
    count, periods, tolerance = int(sys.argv[1]), float(sys.argv[2]), float(sys.argv[3])
    way, out = sys.argv[4], sys.argv[5]
    speeds, starts = cases.oscillators(count)
    times = cases.ends(speeds, periods)
    before = time.process_time()
    if way == "one":
        found = np.array([one(*each, tolerance) for each in zip(speeds, starts, times)])
    else:
        found = together(speeds, starts, periods, tolerance)
    seconds = time.process_time() - before
    found.astype("<f8").tofile(out)
    print(json.dumps({"per_processor_second": count / seconds}))


main()
