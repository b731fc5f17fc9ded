"""heyoka: Taylor integrator, compiled for the processor, one batch of trajectories after the other.

    heyoka_peer.py COUNT PERIODS TOLERANCE BATCH WIDE(0 or 1) OUT
"""

import json
import sys
import time

import heyoka as hy
import numpy as np

import cases


def integrator(batch, tolerance, wide):
    """An integrator of so many trajectories at once; the excitation's speed is a parameter."""
    x, v = hy.make_vars("x", "v")
    force = cases.FORCE * hy.cos(hy.par[0] * hy.time)
    torque = cases.STIFFNESS * x + cases.CUBIC * x**3 + cases.DAMPING * v
    system = [(x, v), (v, force - torque)]
    more = {"force_avx512": True} if wide else {}
    if batch == 1:
        return hy.taylor_adaptive(system, [0.0, 0.0], tol=tolerance, pars=[0.0], **more)
    return hy.taylor_adaptive_batch(system, np.zeros((2, batch)), tol=tolerance,
                                    pars=np.zeros((1, batch)), **more)


def main():
    """Integrates all, prints the rate and the time of compilation, writes the ends."""
    count, periods, tolerance = int(sys.argv[1]), float(sys.argv[2]), float(sys.argv[3])
    batch, wide, out = int(sys.argv[4]), sys.argv[5] == "1", sys.argv[6]
    speeds, starts = cases.oscillators(count)
    times = cases.ends(speeds, periods)
    before = time.process_time()
    ta = integrator(batch, tolerance, wide)
    compiled = time.process_time() - before
    found = np.zeros((count, 2))
    before = time.process_time()
    for low in range(0, count, batch):
        at = np.minimum(np.arange(low, low + batch), count - 1)
        if batch == 1:
            ta.time, ta.state[:], ta.pars[0] = 0.0, (starts[low], 0.0), speeds[low]
            ta.propagate_until(times[low])
            found[low] = ta.state
        else:
            ta.set_time(np.zeros(batch))
            ta.state[0], ta.state[1], ta.pars[0] = starts[at], 0.0, speeds[at]
            ta.propagate_until(times[at])
            found[at] = ta.state.T
    seconds = time.process_time() - before
    found.astype("<f8").tofile(out)
    print(json.dumps({"per_processor_second": count / seconds, "compilation": compiled}))


main()
