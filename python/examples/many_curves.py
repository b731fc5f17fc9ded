"""Resonance curves over a table of parameters, on all cores."""

from __future__ import annotations

import numpy as np

import halfshaft


def main(count: int = 200) -> None:
    """Prints the largest twist and whether the response folds, for random stiffness and damping."""
    random = np.random.default_rng(1)
    table = {
        "half-shaft.cubic": random.uniform(-642, 642, count),
        "half-shaft.damping": random.uniform(1, 90, count),
    }
    asked = halfshaft.ensemble(halfshaft.example(), table, "resonance", method="averaged")
    folding, largest = 0, 0.0
    for answer in asked:
        if isinstance(answer, halfshaft.Result):
            folding += bool(answer.jumps)
            largest = max(largest, *(peak["half-shaft.twist.amplitude"] for peak in answer.peaks))
    print(f"{folding} of {len(asked)} lines jump; the twist swings by up to {largest:.3f} rad")


if __name__ == "__main__":
    main()
