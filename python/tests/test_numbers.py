"""The known numbers of the main Rust tests, through Python."""

from __future__ import annotations

import math

import numpy as np
import pytest

from halfshaft import Driveline, Record, Result

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


def held(stiffness: float, damping: float, amplitude: float, **powers: float) -> Driveline:
    """One inertia of 1 kg·m² on a shaft to ground."""
    return (
        Driveline("line under test")
        .inertia("disc", 1)
        .shaft("spring", "disc", "ground", stiffness, damping=damping, **powers)
        .torque("drive", "disc", amplitude=amplitude)
    )


def located(answer: Result, kind: str) -> list[Record]:
    """Special points of a kind by ascending speed."""
    points = [p for branch in answer.branches for p in branch.special_points if p.kind == kind]
    assert all(point.status == "located" for point in points)
    return sorted(points, key=lambda point: float(point.frequency))


def test_folds_of_the_duffing_oscillators() -> None:
    # Source: AUTO-07p and an independent harmonic balance, as in the Rust test.
    d1 = held(1, 0.05, 0.18, cubic=0.1).resonance(frequency=(0.2, 1.8), tolerance=1e-8)
    folds = located(d1, "fold")
    assert [p.frequency for p in folds] == pytest.approx([1.1157002518, 1.2696019555], rel=5e-11)
    swings = [p["spring.twist.harmonic1"] for p in folds]
    assert swings == pytest.approx([1.08187032, 2.82501671], rel=5e-9)
    d2 = held(1, 0.04, 0.015, cubic=1).resonance(frequency=(0.8, 1.3), tolerance=1e-8)
    found = [p.frequency for p in located(d2, "fold")]
    assert found == pytest.approx([1.0439137088, 1.0492623992], rel=5e-11)


def test_folds_converge_with_the_harmonics_as_tabulated() -> None:
    # Source: the same programs with few harmonics.
    line = held(1, 0.05, 0.18, cubic=0.1)
    for count, speed in ((1, 1.2675369595), (3, 1.2696000321), (5, 1.2696019544)):
        answer = line.resonance(frequency=(0.9, 1.6), harmonics=count)
        assert located(answer, "fold")[1].frequency == pytest.approx(speed, rel=5e-11)


def test_an_absorber_has_neimark_sacker_points() -> None:
    # Source: the same programs.
    line = (
        Driveline("Absorber")
        .inertia("main", 1)
        .inertia("absorber", 0.05)
        .shaft("ground spring", "main", "ground", 1, damping=0.002, cubic=1)
        .shaft("link", "main", "absorber", 0.0453, damping=0.013, cubic=0.0042)
        .torque("drive", "main", amplitude=0.11)
    )
    answer = line.resonance(frequency=(0.9, 1.4), tolerance=1e-8)
    pairs = [p.frequency for p in located(answer, "neimark-sacker")]
    assert pairs == pytest.approx([1.1127112391, 1.1957366691], rel=5e-10)
    folds = [p.frequency for p in located(answer, "fold")]
    assert folds == pytest.approx([1.2062194574, 1.2146262252], rel=5e-10)


def test_cusps_are_the_thresholds_of_the_theory(oscillator: Driveline) -> None:
    # Source: the printed thresholds with 40 digits (mpmath): f_c, α_c, β_c.
    for parameter, expected in (
        (("excitation.amplitude", 1, 20), [6.783767049483465]),
        (("spring.cubic", -1, 1), [-0.3124723736414551, 0.3124723736414551]),
        (("spring.damping", 0.01, 0.2), [0.12317802398342803]),
    ):
        points = oscillator.folds(method="averaged", parameter=parameter).special_points
        assert sorted(p[parameter[0]] for p in points) == pytest.approx(expected, rel=1e-12)


def test_the_published_shock_has_its_reference_velocity(line: Driveline) -> None:
    # Source: the reference transients of the published equation.
    other = line.with_(**{"half-shaft.cubic": 642})
    answer = other.shock(
        method="published", initial={"half-shaft.twist": "1 rad"}, tolerance=1e-12
    )
    metrics = answer.metrics.shafts["half-shaft"]
    assert metrics.first_rate_peak == pytest.approx(-11.375838, abs=1e-6)
    assert metrics.first_rate_peak_time == pytest.approx(0.117, abs=1e-3)


@pytest.mark.parametrize(
    ("inertias", "stiffnesses", "hertz"),
    [
        ([211.4, 8.3], [9_775_000], [0, 176.0767468]),
        (
            [0.0035, 0.0035, 0.0035, 0.15, 0.05],
            [12_000, 12_000, 14_000, 10_000],
            [0, 81.20762902, 141.2140714, 378.9529539, 536.3632829],
        ),
    ],
)
def test_chains_have_the_published_frequencies(
    inertias: list[float], stiffnesses: list[float], hertz: list[float]
) -> None:
    # Source: openTorsion 0.3.2 and SciPy; Friswell and others (2010), example 9.7.1.
    line = Driveline("chain")
    for number, inertia in enumerate(inertias):
        line = line.inertia(f"J{number}", inertia)
    for number, stiffness in enumerate(stiffnesses):
        line = line.shaft(f"k{number}", f"J{number}", f"J{number + 1}", stiffness)
    found = [mode.frequency / math.tau for mode in line.modes().modes]
    assert found[0] == 0 and found[1:] == pytest.approx(hertz[1:], rel=1e-9)


def test_states_lead_where_their_motions_go() -> None:
    # Source: each motion by itself, integrated until it repeats.
    line = held(679, 0.0952, 15, cubic=-0.679)
    keywords = {"grid": 3, "window": ((-3, 3), (-80, 80))}
    answer = line.basins(frequency=25.75, **keywords)  # type: ignore[arg-type]
    swings = [a["values"]["spring.twist.amplitude"] for a in answer.attractors]
    grid = answer.grid
    for rate, row in zip(grid.rate, grid.attractor, strict=True):
        for twist, number in zip(grid.twist, row, strict=True):
            start = {"spring.twist": twist, "spring.twist_rate": rate}
            run = line.simulate(duration=150, frequency=25.75, initial=start, step=0.01).table
            reached = np.abs(run["spring.twist"][-1000:]).max()
            assert reached == pytest.approx(swings[number], rel=0.03)
