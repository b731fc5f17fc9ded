"""A first line in code and its resonance curve: ``python first_curve.py curve.svg``."""

from __future__ import annotations

import sys

import halfshaft


def main(path: str) -> None:
    """Writes the curve and says where the response jumps."""
    line = (
        halfshaft.Driveline("Two masses")
        .inertia("engine", "0.328 kg·m²")
        .gear("gearbox and final drive", "engine", "flange", 5.71)
        .inertia("vehicle", "81.6 kg·m²")
        .shaft("half-shaft", "flange", "vehicle", "6420 N·m/rad", cubic=-642, damping=2)
        .torque("engine torque", "engine", amplitude="40 N·m")
    )
    answer = line.resonance(method="averaged", frequency="3Hz..5Hz")
    answer.save(path)
    for jump in answer.jumps:
        print(f"sweeping {jump.sweep}: jumps at {jump.rpm:.1f} rpm")
    peak = max(answer.tables.values(), key=lambda table: table.rows)[
        "half-shaft.twist.amplitude"
    ].max()
    print(f"the twist swings by at most {peak:.3f} rad")


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "curve.svg")
