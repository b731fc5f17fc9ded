"""Bifurcation diagrams that AUTO-07p wrote, to hold against."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from ._errors import OutputError
from ._table import Table

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

# Kinds of points by AUTO's numbers, in this package's words.
_KINDS = {
    1: "branch-point",
    2: "fold",
    3: "hopf",
    4: "regular",
    5: "fold",
    6: "branch-point",
    7: "period-doubling",
    8: "neimark-sacker",
    9: "end",
    -4: "user",
    -9: "not-converged",
}
# Columns of whole numbers before the values: branch, point, type, label.
_HEAD = 4


class AutoPoint(NamedTuple):
    """A labelled point of AUTO's: its kind, its label, its row in the branch, its values by column."""

    kind: str
    label: int
    row: int
    values: dict[str, float]


class AutoBranch(NamedTuple):
    """A branch of AUTO's: its number, its columns as AUTO names them, where it is stable, labelled points."""

    number: int
    table: Table
    stable: npt.NDArray[np.bool_]
    points: list[AutoPoint]


def read_auto(path: str | os.PathLike[str]) -> list[AutoBranch]:
    """Branches of a bifurcation diagram of AUTO-07p, from its ``b.`` file or ``fort.7``.

    Values stand under AUTO's own names (``"PAR(1)"``, ``"MAX U(1)"``), without units, to the digits that
    it printed. A maximum is that over AUTO's mesh points, a little below the crest. Special points have
    the kinds of this package: ``"fold"`` for LP, ``"neimark-sacker"`` for TR.

    Raises ``OutputError`` where the file is no such diagram.
    """
    branches: list[tuple[list[str], list[list[str]]]] = []
    for number, line in enumerate(Path(path).read_text(encoding="utf-8").splitlines(), 1):
        cells = line.split()
        if cells[:4] == ["0", "PT", "TY", "LAB"]:
            branches.append((re.split(r"\s{2,}", line.strip())[_HEAD:], []))
        elif cells and cells[0] != "0":
            if not branches or len(cells) != _HEAD + len(branches[-1][0]):
                raise OutputError(f"{path}:{number}: this is no row of a diagram of AUTO", _ADVICE)
            branches[-1][1].append(cells)
    found = [_branch(names, rows) for names, rows in branches if rows]
    if not found:
        raise OutputError(f"{path}: there is no diagram of AUTO here", _ADVICE)
    return found


_ADVICE = "diagrams are in b. files and fort.7"


def _branch(names: list[str], rows: list[list[str]]) -> AutoBranch:
    import numpy as np

    values = np.array([[_number(cell) for cell in row[_HEAD:]] for row in rows])
    table = Table((name, "1", values[:, at].copy()) for at, name in enumerate(names))
    # AUTO tells stability by the sign of a point's number.
    stable = np.array([int(row[1]) < 0 for row in rows])
    return AutoBranch(abs(int(rows[0][0])), table, stable, list(_points(rows, table)))


def _points(rows: list[list[str]], table: Table) -> Iterator[AutoPoint]:
    for at, row in enumerate(rows):
        kind, label = int(row[2]), int(row[3])
        if label != 0:
            # The tens tell what curve it is on.
            last = kind % 10 if kind >= 0 else -(-kind % 10)
            values = {name: float(table[name][at]) for name in table}
            yield AutoPoint(_KINDS.get(last, f"type {kind}"), label, at, values)


def _number(text: str) -> float:
    """A Fortran number; an exponent of three digits lacks its letter."""
    return float(re.sub(r"(?<=\d)([+-]\d{3})$", r"e\1", text))
