"""heyoka: one shock response after the other, each for itself; compilation not counted.

    heyoka_shock.py COUNT TOLERANCE
"""

import json
import sys
import time

import heyoka as hy


def main():
    """The published shock equation from 1 rad at rest over 5 s."""
    count, tolerance = int(sys.argv[1]), float(sys.argv[2])
    x, v = hy.make_vars("x", "v")
    torque = (6420.0 * x - 642.0 * x**3 + 90.0 * v) / 81.6
    ta = hy.taylor_adaptive([(x, v), (v, -torque)], [1.0, 0.0], tol=tolerance)
    times, steps = [], 0
    for _ in range(count):
        ta.time, ta.state[:] = 0.0, (1.0, 0.0)
        before = time.perf_counter()
        steps = ta.propagate_until(5.0)[3]
        times.append(1e6 * (time.perf_counter() - before))
    times.sort()
    print(json.dumps({"microseconds": times[count // 2], "steps": steps, "twist": float(ta.state[0]),
                      "rate": float(ta.state[1])}))


main()
