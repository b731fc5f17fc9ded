"""Traces the forced Duffing oscillator with jaxcont; runs inside its own environment.

As for AUTO-07p the excitation's phase is an oscillator of two states. jaxcont solves its collocation
equations with dense matrices, which leaves it to small cases; double precision is switched on.
"""

import json
import sys
import time

import jax

jax.config.update("jax_enable_x64", True)

import jax.numpy as jnp  # noqa: E402
import jaxcont  # noqa: E402
import numpy as np  # noqa: E402
from jaxcont.core.collocation import Collocation  # noqa: E402
from jaxcont.problems.periodic import periodic_orbit_problem  # noqa: E402


def equations(case):
    """Right-hand side of x'' + c x' + k x + g x^3 = P cos((base + p) t)."""
    line, base, scale = case["line"], case["base"], case["scale"]
    stiffness, cubic, damping = line["stiffness"][0], line["cubic"][0], line["damping"][0]

    def right_hand_side(state, detuning, _):
        x, y, s, c = state
        w, r = base + detuning, s * s + c * c
        force = (line["amplitude"] * c - stiffness * x - cubic * x**3) / scale
        return jnp.array([scale * y, force - damping * y, s + w * c - s * r, c - w * s - c * r])

    return right_hand_side


def first_orbit(case):
    """The linear response at the lower end of the range, as times and states."""
    line, w = case["line"], case["low"]
    times = np.linspace(0, 2 * np.pi / w, 801)
    phasor = line["amplitude"] / (line["stiffness"][0] - w * w + 1j * w * line["damping"][0])
    x = phasor * np.exp(1j * w * times)
    states = np.stack([x.real, (1j * w * x).real / case["scale"], np.sin(w * times), np.cos(w * times)], 1)
    return jnp.array(times), jnp.array(states)


def trace(case):
    """One curve with multipliers and folds."""
    times, states = first_orbit(case)
    low, high = case["low"] - case["base"], case["high"] - case["base"]
    begun = time.process_time()
    problem = periodic_orbit_problem(equations(case), states, times, float(times[-1]), low,
                                     Collocation(case["ntst"], case["ncol"]))
    settings = jaxcont.ContinuationPar(ds=0.1, ds_min=1e-6, ds_max=case["longest"],
                                       max_steps=case["points"], newton_tol=1e-8)
    answer = jaxcont.continuation(problem, p_span=(low, high), settings=settings, events=[jaxcont.Fold()])
    samples = len(np.asarray(answer.branch.params))
    return time.process_time() - begun, samples, [
        ("fold", float(event.p) + case["base"], None) for event in answer.events if event.kind == "fold"]


def main():
    """The first curve compiles; those after it are counted."""
    case = json.load(sys.stdin)
    curves = [trace(case) for _ in range(case["repeats"] + 1)]
    json.dump({"inside": [seconds for seconds, _, _ in curves[1:]], "samples": curves[-1][1],
               "found": curves[-1][2]}, sys.stdout)


if __name__ == "__main__":
    main()
