"""Results: what they hold, where they can go, how they look."""

from __future__ import annotations

import builtins
import copy
import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import halfshaft
from halfshaft import Driveline, Result


def test_everything_is_there_by_name(resonance: Result) -> None:
    assert resonance.analysis == "resonance" and resonance.finished
    assert resonance.model.name == resonance["model"]["name"] == "Scaled oscillator"
    assert resonance.branches[0].columns == resonance.table
    branch = copy.deepcopy(resonance.branches[0])
    assert list(branch.to_dict()) == branch.names == list(branch.columns)
    assert "peaks" in resonance and "peaks" in dir(resonance)
    with pytest.raises(AttributeError, match="it has"):
        _ = resonance.nothing
    with pytest.raises(KeyError, match="there are frequency"):
        _ = resonance.table["nothing"]


def test_columns_are_views_that_cannot_be_written_to(oscillator: Driveline) -> None:
    column = oscillator.resonance(method="averaged").table["frequency"]
    # The result is gone, its numbers stay.
    assert column.base is not None and not column.flags.owndata
    assert np.all(np.diff(column[:10]) > 0)
    with pytest.raises(ValueError):
        column[0] = 0
    with pytest.raises(ValueError):
        column.flags.writeable = True


def test_results_equal_their_copies(resonance: Result, tmp_path: Path) -> None:
    (path,) = resonance.save(tmp_path / "answer.json")
    copies = [pickle.loads(pickle.dumps(resonance)), copy.deepcopy(resonance)]
    for other in [*copies, halfshaft.load_result(path)]:
        assert other == resonance and other.table == resonance.table
    table = pickle.loads(pickle.dumps(resonance.table))
    assert table == resonance.table
    (tmp_path / "other.json").write_text("{}")
    with pytest.raises(halfshaft.OutputError):
        halfshaft.load_result(tmp_path / "other.json")


def test_results_are_written_in_all_forms(resonance: Result, tmp_path: Path) -> None:
    for ending in ("csv", "svg", "png", "html"):
        written = resonance.save(tmp_path / f"answer.{ending}")
        assert written[0].stat().st_size > 1000
    assert len(resonance.save(tmp_path / "all")) > 4
    with pytest.raises(halfshaft.OutputError, match="in no form"):
        resonance.save(tmp_path / "answer.xyz")


def test_tables_go_to_other_packages(line: Driveline, oscillator: Driveline) -> None:
    pandas, xarray = pytest.importorskip("pandas"), pytest.importorskip("xarray")
    arrow = pytest.importorskip("pyarrow")
    history = line.shock(duration="0.2s")
    frame, dataset, table = history.to_pandas(), history.to_xarray(), history.to_arrow()
    assert isinstance(frame, pandas.DataFrame) and isinstance(table, arrow.Table)
    assert isinstance(dataset, xarray.Dataset)
    twist = history.table["half-shaft.twist"]
    assert np.array_equal(frame["half-shaft.twist"].to_numpy(), twist)
    assert np.array_equal(dataset["half-shaft.twist"].to_numpy(), twist)
    assert np.array_equal(table["half-shaft.twist"].to_numpy(), twist)
    assert frame.attrs["units"]["half-shaft.twist"] == "rad"
    assert dataset["half-shaft.twist"].attrs["units"] == "rad"
    curves = line.folds(method="averaged", parameter="half-shaft.cubic=-700..-100")
    if len(curves.tables) > 1:
        assert set(curves.to_pandas()["table"]) == set(curves.tables)
        assert curves.to_arrow().num_rows == sum(t.rows for t in curves.tables.values())


def test_a_package_that_is_absent_is_asked_for(
    resonance: Result, monkeypatch: pytest.MonkeyPatch
) -> None:
    original = builtins.__import__
    import importlib

    def absent(name: str, *rest: Any) -> Any:
        if name.split(".")[0] in ("pandas", "plotly"):
            raise ImportError(name)
        return original(name, *rest)

    monkeypatch.setattr(importlib, "import_module", absent)
    with pytest.raises(ImportError, match="pip install pandas"):
        resonance.to_pandas()
    with pytest.raises(ImportError, match="pip install plotly"):
        resonance.plot()


def test_figures_can_be_seen(line: Driveline, resonance: Result) -> None:
    pytest.importorskip("plotly")
    pytest.importorskip("matplotlib")
    figure = resonance.plot()
    named = {trace.name for trace in figure.data}
    assert {"response", "fold"} <= named
    for answer in (resonance, line.static(), line.shock(duration="0.2s"), line.campbell()):
        for index, _ in enumerate(answer.figures):
            assert len(answer.plot(index).data) > 0
            assert len(answer.plot_static(index).axes) > 0
    drawn = line.static().plot_static()
    # What stands beside the curves in the program's own figures: limits, points with their names.
    assert any("carries at most" in text.get_text() for text in drawn.axes[0].texts)
    points = [one for one in drawn.axes[0].lines if one.get_marker() == "o"]
    assert points and all(one.get_markeredgecolor() not in ("white", "#ffffff") or
                          one.get_markerfacecolor() not in ("white", "#ffffff") for one in points)
    assert resonance.svg().startswith("<?xml") or "<svg" in resonance.svg()
    assert resonance.png()[:4] == b"\x89PNG"
    html = resonance._repr_html_()
    assert "<svg" in html and "jumps at" in html
    assert "<svg" in line._repr_html_() and "<svg" in line.sketch()
    assert "<table>" in resonance.table._repr_html_()
    with pytest.raises(LookupError, match="there is no figure"):
        resonance.plot("nothing")


def test_the_first_plot_takes_three_lines(oscillator: Driveline, tmp_path: Path) -> None:
    pytest.importorskip("plotly")
    oscillator.save(tmp_path / "my-line.toml")
    lines = """import halfshaft
line = halfshaft.load("my-line.toml")
line.resonance(frequency="3Hz..5Hz").plot()""".splitlines()
    names: dict[str, Any] = {}
    script = "\n".join([*lines[:-1], f"figure = {lines[-1]}"])
    exec(script.replace("my-line.toml", str(tmp_path / "my-line.toml")), names)
    assert len(lines) == 3 and len(names["figure"].data[0].x) > 50


def test_a_study_is_a_result(tmp_path: Path) -> None:
    study = tmp_path / "study.toml"
    study.write_text(
        'format = 1\nname = "One"\n[[question]]\nname = "rest"\nask = "static"\n', encoding="utf-8"
    )
    answer = halfshaft.run_study(study)
    assert answer.analysis == "run" and answer.finished
    study.write_text('format = 1\nname = "One"\n[[question]]\nask = "statc"\n', encoding="utf-8")
    with pytest.raises(halfshaft.ModelError):
        halfshaft.run_study(study)
