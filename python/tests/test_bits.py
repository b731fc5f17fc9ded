"""Every answer holds what the command-line program of the same wheel prints, to the last bit."""

from __future__ import annotations

import json
import os
import re
import struct
import subprocess
import sysconfig
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import halfshaft
from halfshaft import Driveline, Table

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "examples"
SCALED = EXAMPLES / "two-mass-driveline" / "scaled.toml"
ENGINE = EXAMPLES / "engine-and-driveline" / "line.toml"


def program(*arguments: object) -> str:
    """What the program that the package brings prints."""
    name = f"halfshaft{'.exe' if os.name == 'nt' else ''}"
    command = [str(Path(sysconfig.get_path("scripts")) / name), *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True, encoding="utf-8", check=True)
    return done.stdout


def bits(value: float) -> bytes:
    return struct.pack("<d", value)


def differences(ours: Any, theirs: Any, place: str = "") -> Iterator[str]:
    """Where two trees of JSON differ in a name, a text or a bit."""
    if isinstance(ours, Table):
        listed = [{"name": n, "unit": ours.units[n], "values": list(ours[n])} for n in ours]
        yield from differences(listed, theirs, place)
    elif isinstance(ours, dict) and isinstance(theirs, dict):
        if list(ours) != list(theirs):
            yield f"{place}: {list(ours)} and {list(theirs)}"
        for name in ours:
            yield from differences(ours[name], theirs.get(name), f"{place}.{name}")
    elif isinstance(ours, list) and isinstance(theirs, list):
        if len(ours) != len(theirs):
            yield f"{place}: {len(ours)} and {len(theirs)} entries"
        for number, (a, b) in enumerate(zip(ours, theirs)):
            yield from differences(a, b, f"{place}[{number}]")
    elif isinstance(ours, float) and (theirs is None or isinstance(theirs, (int, float))):
        missing = theirs is None and not np.isfinite(ours)
        if not missing and (theirs is None or bits(float(ours)) != bits(float(theirs))):
            yield f"{place}: {ours!r} and {theirs!r}"
    elif ours != theirs or isinstance(ours, bool) != isinstance(theirs, bool):
        yield f"{place}: {ours!r} and {theirs!r}"


def test_a_difference_of_one_bit_is_seen() -> None:
    one = {"a": [1.0, {"b": 2.0}], "c": "text"}
    other = json.loads(json.dumps(one))
    assert not list(differences(one, other))
    other["a"][1]["b"] = float(np.nextafter(2.0, 3.0))
    assert list(differences(one, other)) == [".a[1].b: 2.0 and 2.0000000000000004"]
    assert list(differences({"a": 0.0}, {"a": -0.0})) and list(differences({"a": 1}, {"b": 1}))


# Model, question, keywords, flags.
ASKED: list[tuple[Path | None, str, dict[str, Any], list[str]]] = [
    (None, "check", {}, []),
    (ENGINE, "check", {}, []),
    (None, "static", {}, []),
    (None, "modes", {}, []),
    (ENGINE, "modes", {"count": 4}, ["--count", "4"]),
    (None, "campbell", {"this_gear": True}, ["--this-gear"]),
    (
        ENGINE,
        "campbell",
        {"orders": [2, 4], "frequency": ("1000 rpm", "6000 rpm")},
        ["--orders", "2,4", "--frequency", "1000rpm..6000rpm"],
    ),
    (
        ENGINE,
        "forced",
        {"points": 40, "this_gear": True, "orders": [2, 4]},
        ["--points", "40", "--this-gear", "--orders", "2,4"],
    ),
    (
        None,
        "simulate",
        {"duration": 1, "frequency": "4Hz", "initial": {"half-shaft.twist": 0.5}},
        ["--duration", "1", "--frequency", "4Hz", "--initial", "half-shaft.twist=0.5"],
    ),
    (None, "shock", {"duration": "0.5s"}, ["--duration", "0.5s"]),
    (None, "shock", {"compare": True, "duration": 0.3}, ["--compare", "--duration", "0.3"]),
    (
        None,
        "shock",
        {"method": "multiple-scales", "order": 2, "initial": "half-shaft.twist=0.2"},
        ["--method", "multiple-scales", "--order", "2", "--initial", "half-shaft.twist=0.2"],
    ),
    (SCALED, "resonance", {"method": "averaged"}, ["--method", "averaged"]),
    (SCALED, "resonance", {"method": "first-harmonic"}, ["--method", "first-harmonic"]),
    (
        SCALED,
        "resonance",
        {"frequency": (25.0, 27.0), "tolerance": 1e-8, "backbone": True},
        ["--frequency", "25..27", "--tolerance", "1e-8", "--backbone"],
    ),
    (
        SCALED,
        "resonance",
        {"method": "averaged", "verify": True},
        ["--method", "averaged", "--verify"],
    ),
    (
        SCALED,
        "resonance",
        {"frequency": 25.9, "parameter": {"excitation.amplitude": (1, 20)}},
        ["--frequency", "25.9", "--parameter", "excitation.amplitude=1..20"],
    ),
    (
        SCALED,
        "folds",
        {"method": "averaged", "parameter": ("excitation.amplitude", 1, 20)},
        ["--method", "averaged", "--parameter", "excitation.amplitude=1..20"],
    ),
    (
        SCALED,
        "folds",
        {"method": "first-harmonic", "parameter": ("spring.cubic", -1, 0)},
        ["--method", "first-harmonic", "--parameter", "spring.cubic=-1..0"],
    ),
    (
        SCALED,
        "folds",
        {"parameter": "excitation.amplitude=5..12"},
        ["--parameter", "excitation.amplitude=5..12"],
    ),
    (
        SCALED,
        "basins",
        {"frequency": 25.92, "grid": (7, 5), "window": ((-5, 5), (-120, 120))},
        ["--frequency", "25.92", "--grid", "7x5", "--window=-5..5,-120..120"],
    ),
    (
        SCALED,
        "bifurcation",
        {"frequency": (25.8, 26.0), "steps": 6, "direction": "both"},
        ["--frequency", "25.8..26", "--steps", "6", "--direction", "both"],
    ),
]


def named(value: object) -> str | None:
    return value if isinstance(value, str) else None


@pytest.mark.parametrize(("model", "question", "keywords", "flags"), ASKED, ids=named)
def test_every_number_equals_that_of_the_program(
    model: Path | None, question: str, keywords: dict[str, Any], flags: list[str]
) -> None:
    told = program(question, *([model] if model else []), "--json", "--quiet", *flags)
    line = halfshaft.load(model) if model else halfshaft.example()
    answer = getattr(line, question)(**keywords)
    theirs = json.loads(told)
    # What users hold: records and tables over the memory of the result, not its text.
    assert not list(differences(dict(answer.tree), theirs))
    assert answer.to_json() == told
    for table in answer.tables.values():
        for name in table:
            assert table[name].dtype == np.float64


def test_every_question_is_compared() -> None:
    # Source: the program's own list of commands.
    asked = {question for _, question, _, _ in ASKED}
    listed = re.findall(r"^  ([a-z]+) ", program("--help"), flags=re.MULTILINE)
    questions = {verb for verb in listed if hasattr(Driveline, verb)}
    assert len(questions) > 10 and asked >= questions - {"report"}


def test_a_report_and_a_study_are_those_of_the_program(tmp_path: Path) -> None:
    small = tmp_path / "study.toml"
    small.write_text(
        f"""format = 1
name = "Two questions"
model = '{SCALED}'
[[question]]
name = "rest"
ask = "static"
[[question]]
name = "curve"
ask = "resonance"
method = "averaged"
""",
        encoding="utf-8",
    )
    told = program("run", small, "--json", "--quiet")
    assert not list(differences(halfshaft.run_study(small).to_dict(), json.loads(told)))
    path = tmp_path / "report.json"
    program("report", "--quiet", "--out", path)
    ours = halfshaft.example().report().to_dict()
    assert not list(differences(ours, json.loads(path.read_text(encoding="utf-8"))))


def test_the_program_is_whole() -> None:
    assert program("--version").strip() == f"halfshaft {halfshaft.__version__}"
    with pytest.raises(subprocess.CalledProcessError) as wrong:
        program("static", "nowhere.toml")
    assert wrong.value.returncode == 2
