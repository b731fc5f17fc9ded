"""Torque laws given by functions of Python."""

from __future__ import annotations

import math
import pickle
import traceback
import warnings

import numpy as np
import pytest

import halfshaft
from halfshaft import BeyondRange, Driveline, ModelError, TorqueFunction

K1, K3 = 679.1236, -0.679


def cubic(twist: float) -> float:
    """The law of the scaled oscillator."""
    return K1 * twist + K3 * twist**3


@pytest.fixture(scope="module")
def by_function(oscillator: Driveline) -> Driveline:
    """The scaled oscillator with its law as a function."""
    return oscillator.with_law("spring", cubic, range=(-8, 8))


def test_resonance_is_that_of_the_built_in_law(
    oscillator: Driveline, by_function: Driveline
) -> None:
    # Source: two ways to one law. The responses are found one by one, so their places may differ.
    span = (25.6, 26.4)
    known, found = oscillator.resonance(frequency=span), by_function.resonance(frequency=span)
    folds = [
        [p for p in answer.branches[0].special_points if p.kind == "fold"]
        for answer in (known, found)
    ]
    assert len(folds[0]) == len(folds[1]) == 2
    for a, b in zip(*folds, strict=True):
        assert b.frequency == pytest.approx(a.frequency, rel=1e-13)
        # At a fold the amplitude moves with the root of what the frequency does.
        assert b["spring.twist.amplitude"] == pytest.approx(a["spring.twist.amplitude"], rel=3e-7)


def test_history_is_that_of_the_built_in_law(oscillator: Driveline, by_function: Driveline) -> None:
    keywords = {"duration": 3, "frequency": "25.9 rad/s", "initial": {"spring.twist": "2 rad"}}
    known = oscillator.simulate(**keywords).table  # type: ignore[arg-type]
    found = by_function.simulate(**keywords).table  # type: ignore[arg-type]
    np.testing.assert_allclose(found["spring.twist"], known["spring.twist"], atol=1e-9)
    np.testing.assert_allclose(found["spring.torque"], known["spring.torque"], atol=1e-6)


def test_folds_basins_and_rest_take_a_function(
    oscillator: Driveline, by_function: Driveline
) -> None:
    plane = ("excitation.amplitude", 5, 12)
    cusps = [
        [p for p in line.folds(parameter=plane).special_points if p.kind == "cusp"]
        for line in (oscillator, by_function)
    ]
    assert [p.frequency for p in cusps[1]] == pytest.approx([p.frequency for p in cusps[0]])
    # One response only, so that no shock from one to another is looked for.
    calm = [line.with_({"spring.damping": 5}) for line in (oscillator, by_function)]
    maps = [line.basins(frequency=25.9, grid=8, window=((-4, 4), (-100, 100))) for line in calm]
    assert [len(found.attractors) for found in maps] == [1, 1]
    amplitudes = [found.attractors[0]["values"]["spring.twist.amplitude"] for found in maps]
    assert amplitudes[1] == pytest.approx(amplitudes[0], rel=1e-8)
    assert by_function.modes().modes[0].frequency == pytest.approx(math.sqrt(K1), rel=1e-13)


A, B = 300.0, 1.5


def hardening(damping: float) -> Driveline:
    """A disc on a spring whose torque grows like a hyperbolic sine."""
    return (
        Driveline("Hardening")
        .inertia("disc", 1.0)
        .shaft("rod", "disc", "ground", torque=lambda twist: A * np.sinh(B * twist), damping=damping)
        .torque("drive", "disc", amplitude=60)
    )


def test_energy_is_kept_under_a_law_of_ones_own() -> None:
    # Source: the first integral of x'' + A sinh(B x) = 0.
    line = hardening(0).with_({"drive.amplitude": 0})
    table = line.simulate(duration=10, initial={"rod.twist": 1}, tolerance=1e-12).table
    x, v = table["rod.twist"], table["rod.twist_rate"]
    energy = v**2 / 2 + A / B * (np.cosh(B * x) - 1)
    assert np.abs(energy / energy[0] - 1).max() < 1e-9


def test_harmonic_balance_is_where_integration_settles() -> None:
    # Source: the full equations, integrated until they repeat.
    speed = 24.0
    line = hardening(5.0)
    rows = line.resonance(frequency=(speed, speed + 0.01), tolerance=1e-9).table
    found = np.interp(speed, rows["frequency"], rows["rod.twist.amplitude"])
    period = 2 * math.pi / speed
    keywords = {"duration": 60 * period, "frequency": speed, "step": period / 400}
    twist = line.simulate(**keywords, tolerance=1e-11).table["rod.twist"][-401:]  # type: ignore[arg-type]
    # The crest lies between two rows, a parabola's height apart.
    assert (twist.max() - twist.min()) / 2 == pytest.approx(found, rel=2e-4)
    assert found > 1.05 * 60 / abs(A * B - speed**2 + 5j * speed)


def test_the_law_is_the_function_with_its_slope() -> None:
    law = TorqueFunction(lambda twist: A * np.sinh(B * twist))
    x = np.linspace(-3, 3, 1001)
    np.testing.assert_allclose(law(x), A * np.sinh(B * x), atol=1e-13 * A * np.sinh(B * 3))
    np.testing.assert_allclose(law.slope(x), A * B * np.cosh(B * x), rtol=1e-10)
    assert law.range == (-math.pi, math.pi)


def test_functions_of_numbers_with_kinks_are_laws_too(line: Driveline) -> None:
    # Source: the built-in clearance.
    half, stiffness = 0.02, 5000.0

    def gap(twist: float) -> float:
        if abs(twist) <= half:
            return 0.0
        return stiffness * (twist - math.copysign(half, twist))

    with pytest.raises(ModelError, match=r"kinks=\[-0.02\d*, 0.02\d*\]"):
        line.with_law("half-shaft", gap)
    clearance = {"half-shaft.cubic": 0, "half-shaft.stiffness": stiffness}
    known = line.with_({**clearance, "half-shaft.clearance": 2 * half})
    found = line.with_law("half-shaft", gap, kinks=["-0.02 rad", half])
    keywords = {"duration": 0.5, "initial": {"half-shaft.twist": 0.1}, "tolerance": 1e-11}
    twists = [one.simulate(**keywords).table["half-shaft.twist"] for one in (known, found)]  # type: ignore[arg-type]
    np.testing.assert_allclose(twists[1], twists[0], atol=1e-8)


def test_what_the_function_raises_comes_through(line: Driveline) -> None:
    def broken(twist: float) -> float:
        raise ZeroDivisionError("of the user")

    with pytest.raises(ZeroDivisionError, match="of the user") as caught:
        line.with_law("half-shaft", broken)
    assert "broken" in [frame.name for frame in traceback.extract_tb(caught.value.__traceback__)]


def test_what_is_no_law_is_told(line: Driveline) -> None:
    with pytest.raises(ModelError, match=r"NaN .*range=\("):
        line.with_law("half-shaft", lambda twist: np.sqrt(1 - twist**2))
    with pytest.raises(ModelError, match="bends or jumps near 0.3"):
        line.with_law("half-shaft", lambda twist: 10.0 * (twist > 0.3))
    with pytest.raises(ModelError, match="did you mean"):
        line.with_law("halfshaft", cubic).validate()
    with pytest.raises(ModelError) as told:
        TorqueFunction(cubic, range="1 kg..2 kg", kinks=["1 Hz"])
    assert "range:" in str(told.value) and "kinks:" in str(told.value)


def test_a_function_cannot_go_where_only_text_goes(by_function: Driveline) -> None:
    for refused in (by_function.to_toml, by_function.to_dict):
        with pytest.raises(ModelError, match="pickle"):
            refused()
    with pytest.raises(ModelError, match="no number"):
        by_function.with_({"spring.cubic": 1})
    with pytest.raises(halfshaft.QuestionError):
        by_function.resonance(parameter=("spring.cubic", 0, 1), frequency=25)
    with pytest.raises(halfshaft.AnalysisError, match="function law"):
        by_function.resonance(method="averaged")


def test_a_line_with_a_function_travels(by_function: Driveline) -> None:
    # A lambda cannot be pickled; the law that it gave can.
    line = hardening(2.0)
    back = pickle.loads(pickle.dumps(line))
    assert back == line and back.digest == line.digest and "lambda" in repr(back._functions)
    assert line != hardening(2.0).with_law("rod", lambda twist: 1.01 * A * np.sinh(B * twist))
    other = by_function.with_({"excitation.amplitude": 12}).inertia("more", 1)
    with pytest.raises(ModelError):
        other.shaft("link", "more", "nowhere", 1).validate()
    found = halfshaft.ensemble(
        by_function, {"excitation.amplitude": [8.0, 9.0]}, frequency=(25.7, 26.1)
    )
    for amplitude, answer in zip((8.0, 9.0), found, strict=True):
        one = by_function.with_({"excitation.amplitude": amplitude})
        assert answer == one.resonance(frequency=(25.7, 26.1))


def test_going_beyond_the_range_is_warned_of(oscillator: Driveline) -> None:
    short = oscillator.with_law("spring", cubic, range=(-1, 1))
    with pytest.warns(BeyondRange, match="spring twists from"):
        short.simulate(duration=1, initial={"spring.twist": 2})
    with pytest.warns(BeyondRange):
        short.resonance(frequency=(25.7, 26.2))
    with pytest.warns(BeyondRange):
        list(halfshaft.ensemble(short, {"excitation.amplitude": [9]}, frequency=(25.7, 26.2)))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        short.simulate(duration=1, initial={"spring.twist": 0.5}, frequency=10)
