"""Notebooks and examples run from top to bottom; the reference page is that of the docstrings."""

from __future__ import annotations

import json
import re
import runpy
from pathlib import Path
from typing import Any

import numpy
import pytest

import halfshaft

PYTHON = Path(__file__).resolve().parents[1]


@pytest.mark.parametrize(
    "path", sorted((PYTHON / "notebooks").glob("*.ipynb")), ids=lambda p: p.stem
)
def test_a_notebook_runs(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("agg")
    monkeypatch.chdir(path.parent)
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    names: dict[str, Any] = {"__name__": "__main__"}
    for cell in cells:
        if cell["cell_type"] == "code":
            exec(compile("".join(cell["source"]), f"{path.name} {cell['id']}", "exec"), names)


def test_the_examples_run(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    first = runpy.run_path(str(PYTHON / "examples" / "first_curve.py"))
    first["main"](str(tmp_path / "curve.svg"))
    assert (tmp_path / "curve.svg").stat().st_size > 1000
    many = runpy.run_path(str(PYTHON / "examples" / "many_curves.py"))
    many["main"](40)
    assert "lines jump" in capsys.readouterr().out


def test_what_the_docs_show_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    halfshaft.example().save("my-line.toml")
    page = (PYTHON.parent / "docs" / "python.md").read_text(encoding="utf-8")
    blocks = re.findall(r"```python\n(.*?)```", page, flags=re.DOTALL)
    assert len(blocks) >= 5
    names: dict[str, Any] = {"numpy": numpy}
    for block in blocks:
        exec(block.replace("10_000", "8"), names)


def test_the_reference_page_is_up_to_date() -> None:
    made = runpy.run_path(str(PYTHON / "reference.py"))
    told = "run `python python/reference.py`"
    assert made["PAGE"].read_text(encoding="utf-8") == made["page"](), told
