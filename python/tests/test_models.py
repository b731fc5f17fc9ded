"""Models: read, built, changed, sent away and back."""

from __future__ import annotations

import copy
import pickle
from pathlib import Path

import pytest

import halfshaft
from halfshaft import Driveline, ModelError


ROOT = Path(__file__).resolve().parents[2]
SCALED = ROOT / "examples" / "two-mass-driveline" / "scaled.toml"


def built() -> Driveline:
    """The built-in example in code."""
    return (
        Driveline(
            "Two-mass driveline",
            description="Engine and vehicle on one softening half-shaft (Han and He 2018, Table 1)",
        )
        .inertia("engine", "0.328 kg·m²")
        .gear("gearbox", "engine", "gearbox output", 1, ratios=[5.82, 3.23, 1.79, 1, 0.64])
        .gear("final drive", "gearbox output", "half-shaft flange", 5.71)
        .inertia("vehicle", 81.6)
        .shaft(
            "half-shaft", "half-shaft flange", "vehicle", "6.42 kN·m/rad", cubic=-642.0, damping=90
        )
        .torque("engine torque", "engine", mean="850 N·m", amplitude=40)
        .torque(
            "road load",
            "vehicle",
            mean="balance",
            pulse={"shape": "half-sine", "peak": "-12 kN·m", "start": 0, "duration": "50 ms"},
        )
    )


def test_a_line_built_in_code_is_the_file(line: Driveline) -> None:
    # Source: the built-in file: the digest is over every value in SI.
    assert built().digest == line.digest
    assert built() == line and hash(built()) == hash(line)


def test_lines_go_through_dicts_texts_and_pickles(line: Driveline) -> None:
    assert halfshaft.from_dict(line.to_dict()) == line
    assert halfshaft.loads(line.to_toml()) == line
    assert pickle.loads(pickle.dumps(line)) == line
    assert copy.deepcopy(line) == line


def test_a_number_is_changed_in_another_line(line: Driveline) -> None:
    other = line.with_(**{"half-shaft.cubic": -500})
    assert other != line and line == halfshaft.example()
    assert other.to_dict()["shaft"][0]["cubic"] == -500
    assert halfshaft.loads(other.to_toml()) == other
    # A text with a unit means the same, and so does the number of a table inside an element.
    assert line.with_({"half-shaft.cubic": "-0.5 kN·m/rad³"}) == other
    assert line.with_({"road load.pulse.peak": "-9 kN·m"}).to_dict()["torque"][1]["pulse"]["peak"]
    ratios = line.with_({"gearbox.ratios.2": 3}).to_dict()["gear"][0]["ratios"]
    assert ratios == [5.82, 3, 1.79, 1, 0.64]


@pytest.mark.parametrize(
    "address",
    ["engine.inertia", "engine.damping", "gearbox.ratio", "half-shaft.quintic", "line.modal_damping",
     "engine torque.phase", "road load.pulse.start", "gearbox.ratios.5"],
)  # fmt: skip
def test_a_changed_number_stands_in_the_text_too(line: Driveline, address: str) -> None:
    # Source: two ways to one line: the reader's own settings, and the text written anew.
    other = line.with_({address: 0.0625})
    assert halfshaft.loads(other.to_toml()).digest == other.digest != line.digest


def test_mistakes_are_told_all_at_once_with_their_places(tmp_path: Path) -> None:
    path = tmp_path / "wrong.toml"
    text = SCALED.read_text(encoding="utf-8")
    wrong = text.replace('"679.1236 N·m/rad"', '"679 N·m"').replace('"1 kg·m²"', '"1 kg"')
    path.write_text(wrong, encoding="utf-8")
    with pytest.raises(ModelError) as caught:
        halfshaft.load(path)
    found = caught.value.diagnostics
    assert [item.line for item in found] == [14, 20]
    assert found[1].column == 13 and found[1].file == str(path)
    assert "torsional stiffness" in found[1].message
    assert found[1].hint is not None and "N·m/rad" in found[1].hint
    assert pickle.loads(pickle.dumps(caught.value)).diagnostics == found
    with pytest.raises(FileNotFoundError):
        halfshaft.load(tmp_path / "nowhere.toml")
    with pytest.raises(ModelError, match="did you mean"):
        halfshaft.example().with_({"halfshaft.cubic": 1})


def test_quantities_of_pint_are_taken(line: Driveline) -> None:
    pint = pytest.importorskip("pint")
    unit = pint.UnitRegistry()
    stiffness = 6.42 * unit.kilonewton * unit.meter / unit.radian
    assert line.with_({"half-shaft.stiffness": stiffness}) == line
    inertia = 0.328 * unit.kilogram * unit.meter**2
    assert line.with_({"engine.inertia": inertia}) == line
    with pytest.raises(ModelError, match="must be"):
        line.with_({"half-shaft.stiffness": 3 * unit.kilogram})
    span = (200 * unit.rpm, 260 * unit.rpm)
    asked = line.resonance(method="averaged", frequency=span)
    assert asked == line.resonance(method="averaged", frequency="200rpm..260rpm")
