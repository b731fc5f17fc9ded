"""Nested answers whose parts are attributes and keys alike."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from ._table import Table

Columns = list[tuple[str, str, Any]]


class Record(dict[str, Any]):
    """A dict whose keys are attributes too, where they are names.

    One with a table under ``columns`` answers for it: ``branch.to_pandas()``.
    """

    def __getattr__(self, name: str) -> Any:
        if name in self:
            return self[name]
        table = None if name.startswith("_") else self.get("columns")
        if isinstance(table, Table) and hasattr(table, name):
            return getattr(table, name)
        raise AttributeError(f"no {name!r} here; there are {', '.join(self)}")

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *(name for name in self if name.isidentifier())]


def filled(tree: Record, bulk: list[Columns]) -> Record:
    """The tree with its lists of columns as tables; ``bulk`` gives those whose values were left out."""
    waiting = iter(bulk)
    for place in _bulky(tree):
        place["columns"] = Table(next(waiting))
    _fill(tree)
    return tree


def _bulky(tree: Record) -> Iterator[Record]:
    """The records whose columns were left out, in their order."""
    analysis = tree["analysis"]
    if analysis in ("simulate", "shock", "bifurcation"):
        yield tree
    elif analysis == "resonance":
        yield from tree["branches"]
    elif analysis == "forced":
        for gear in tree["gears"]:
            yield gear["table"]
    elif analysis == "folds":
        yield from tree["curves"]


def _fill(value: Any) -> None:
    """Makes tables of all other lists of columns."""
    if isinstance(value, list):
        for item in value:
            _fill(item)
    elif isinstance(value, dict):
        for key, item in value.items():
            if key == "columns" and isinstance(item, list):
                value[key] = Table(_arrays(item))
            else:
                _fill(item)


def _arrays(columns: list[Any]) -> Columns:
    import numpy as np

    made: Columns = []
    for column in columns:
        values = np.array(column["values"], dtype=np.float64)
        values.flags.writeable = False
        made.append((column["name"], column["unit"], values))
    return made
