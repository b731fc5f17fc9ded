"""What the tests share."""

from __future__ import annotations

from pathlib import Path

import pytest

import halfshaft

ROOT = Path(__file__).resolve().parents[2]
SCALED = ROOT / "examples" / "two-mass-driveline" / "scaled.toml"


@pytest.fixture(scope="session")
def line() -> halfshaft.Driveline:
    """The built-in example."""
    return halfshaft.example()


@pytest.fixture(scope="session")
def oscillator() -> halfshaft.Driveline:
    """The scaled oscillator of the paper's resonance figures."""
    return halfshaft.load(SCALED)


@pytest.fixture(scope="session")
def resonance(oscillator: halfshaft.Driveline) -> halfshaft.Result:
    """Its resonance in closed form."""
    return oscillator.resonance(method="averaged")
