"""The known numbers of the main Rust tests, through Python."""

from __future__ import annotations

import json
import math
import os
import subprocess
import sysconfig
from pathlib import Path

import numpy as np
import pytest

import halfshaft
from halfshaft import Driveline, Result

K1, K3, DAMPING = 6420.0, -642.0, 90.0
JM, JL = 0.328 * 5.71**2, 81.6


def test_capacity_is_that_of_the_law(line: Driveline) -> None:
    # Source: the law by hand: T = k1 x + k3 x^3 is largest at x = sqrt(k1 / (3 |k3|)).
    limit = line.static().capacity["half-shaft"].positive
    twist = math.sqrt(K1 / (3 * -K3))
    assert limit.twist == pytest.approx(twist, rel=1e-14)
    assert limit.torque == pytest.approx(2 / 3 * K1 * twist, rel=1e-14)
    assert limit.torque == pytest.approx(7814.175, abs=1e-3)
    assert limit.twist == pytest.approx(1.825742, abs=1e-6)


def test_equilibrium_solves_the_law(line: Driveline) -> None:
    # Source: the law itself under 850 N·m times the final drive.
    state = line.static().equilibria[0]
    x = state.twist["half-shaft"]
    assert K1 * x + K3 * x**3 == pytest.approx(850 * 5.71, rel=1e-13)
    assert state.stable


def test_mode_of_two_masses(line: Driveline) -> None:
    # Source: two masses on one spring whose stiffness is the law's slope at the equilibrium.
    hardly = line.with_(**{"half-shaft.cubic": 0})
    mode = hardly.modes().modes[1]
    reduced = JM * JL / (JM + JL)
    assert mode.frequency == pytest.approx(math.sqrt(K1 / reduced), rel=1e-13)
    assert mode.damping_ratio == pytest.approx(DAMPING / (2 * math.sqrt(K1 * reduced)), rel=1e-12)


def test_folds_of_the_scaled_oscillator(resonance: Result) -> None:
    # Source: the README of the project, and the fold condition solved with 40 digits in the Rust tests.
    folds = [p.frequency for p in resonance.branches[0].special_points if p.kind == "fold"]
    assert sorted(folds) == pytest.approx([25.8973, 25.9398], abs=5e-5)
    assert resonance.scaling[0].fold_threshold_f == pytest.approx(6.7838, abs=5e-5)
    up, down = (next(j for j in resonance.jumps if j.sweep == s) for s in ("up", "down"))
    assert up.rpm == pytest.approx(247.71, abs=5e-3)
    assert down.rpm == pytest.approx(247.30, abs=5e-3)


def test_linear_resonance_is_the_exact_one() -> None:
    # Source: the exact response of a linear oscillator, by harmonic balance of the full equations.
    stiffness, damping, torque = 400.0, 2.0, 3.0
    made = (
        Driveline("Linear")
        .inertia("disc", 1)
        .shaft("rod", "disc", "ground", stiffness, damping=damping)
        .torque("drive", "disc", amplitude=torque)
    )
    table = made.resonance(frequency=(15.0, 25.0)).table
    w = table["frequency"]
    exact = torque / np.sqrt((stiffness - w**2) ** 2 + (damping * w) ** 2)
    np.testing.assert_allclose(table["rod.twist.amplitude"], exact, rtol=1e-6)


def test_history_of_a_free_oscillation() -> None:
    # Source: the exact solution of a damped oscillator.
    made = Driveline("Free").inertia("disc", 1).shaft("rod", "disc", "ground", 400, damping=2)
    answer = made.simulate(duration=2, initial={"rod.twist": "1 rad"})
    table = answer.table
    t, zeta, w0 = table["time"], 2 / (2 * 20.0), 20.0
    wd = w0 * math.sqrt(1 - zeta**2)
    shape = np.cos(wd * t) + zeta / math.sqrt(1 - zeta**2) * np.sin(wd * t)
    np.testing.assert_allclose(table["rod.twist"], np.exp(-zeta * w0 * t) * shape, atol=1e-8)


def test_verification_agrees(oscillator: Driveline) -> None:
    # Source: periodic orbits of the full equations, between the folds as in the Rust test.
    points = oscillator.resonance(method="averaged", verify=True).verification
    between = [point for point in points if 25.8973 < point.frequency < 25.9398]
    assert len(between) >= 3
    assert all(abs(point.relative_difference) < 0.01 for point in between)
    assert all(point.predicted_stable == point.integrated_stable for point in between)


def program() -> Path:
    """The command-line program that the package brings."""
    return Path(sysconfig.get_path("scripts")) / f"halfshaft{'.exe' if os.name == 'nt' else ''}"


@pytest.mark.parametrize(
    ("question", "keywords", "flags"),
    [
        ("static", {}, []),
        ("modes", {}, []),
        ("campbell", {"this_gear": True}, ["--this-gear"]),
        ("shock", {"duration": "0.5s"}, ["--duration", "0.5s"]),
        (
            "resonance",
            {"method": "averaged", "frequency": (24.0, 27.0)},
            ["--method", "averaged", "--frequency", "24..27"],
        ),
        (
            "folds",
            {"method": "averaged", "parameter": ("engine torque.amplitude", 100, 2000)},
            ["--method", "averaged", "--parameter", "engine torque.amplitude=100..2000"],
        ),
        (
            "simulate",
            {"duration": 1, "frequency": "4Hz", "initial": {"half-shaft.twist": 0.5}},
            ["--duration", "1", "--frequency", "4Hz", "--initial", "half-shaft.twist=0.5"],
        ),
    ],
)
def test_every_number_equals_that_of_the_program(
    line: Driveline, question: str, keywords: dict[str, object], flags: list[str]
) -> None:
    # Source: the program's JSON; texts are equal only where every bit is.
    command = [str(program()), question, "--json", "--quiet", *flags]
    told = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    answer = getattr(line, question)(**keywords)
    assert answer.to_json() == told
    assert answer.to_dict() == json.loads(told)
    for table in answer.tables.values():
        for name in table:
            assert table[name].dtype == np.float64


def test_the_program_is_whole() -> None:
    done = subprocess.run([str(program()), "--version"], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == f"halfshaft {halfshaft.__version__}"
    wrong = subprocess.run([str(program()), "static", "nowhere.toml"], capture_output=True)
    assert wrong.returncode == 2
