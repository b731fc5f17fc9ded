"""numbalsoda: DOP853 with the right-hand side compiled by numba, one trajectory after the other.

    numbalsoda_peer.py COUNT PERIODS TOLERANCE OUT
"""

import json
import sys
import time

import numpy as np
from numba import carray, cfunc
from numbalsoda import dop853, lsoda_sig

import cases


@cfunc(lsoda_sig)
def rate(t, u, du, p):
    """The oscillator; the parameter is the speed of its excitation."""
    speed = carray(p, (1,))[0]
    x, v = u[0], u[1]
    du[0] = v
    du[1] = 15.0 * np.cos(speed * t) - x * (679.0 - 0.679 * x * x) - 0.0952 * v


def main():
    """Integrates all, prints the rate, writes the ends."""
    count, periods, tolerance, out = int(sys.argv[1]), float(sys.argv[2]), float(sys.argv[3]), sys.argv[4]
    speeds, starts = cases.oscillators(count)
    times = cases.ends(speeds, periods)
    found = np.zeros((count, 2))

    def fly(index):
        start, parameters = np.array([starts[index], 0.0]), np.array([speeds[index]])
        grid = np.array([0.0, times[index]])
        states, _ = dop853(rate.address, start, grid, parameters, rtol=tolerance, atol=tolerance, mxstep=10**7)
        return states[-1]

    fly(0)
    before = time.process_time()
    for index in range(count):
        found[index] = fly(index)
    seconds = time.process_time() - before
    found.astype("<f8").tofile(out)
    print(json.dumps({"per_processor_second": count / seconds}))


main()
