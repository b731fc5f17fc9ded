"""Results of questions."""

from __future__ import annotations

import html
import json
import os
from pathlib import Path
from typing import Any, ClassVar

from . import _halfshaft
from ._errors import OutputError
from ._optional import needed
from ._record import Record, filled
from ._table import Table, joined


class Result:
    """The answer to a question.

    Everything that its JSON file holds is there by name, ``result.peaks`` or ``result["peaks"]``; lists
    of columns are :class:`Table`. ``tables`` has all tables by title, ``table`` the first one. Results
    are equal where every number is, to the last bit, and can be pickled and copied.
    """

    __slots__ = ("_tables", "_tree", "core")

    core: _halfshaft.Answer

    def __init__(self, core: _halfshaft.Answer) -> None:
        self.core = core
        self._tree: Record | None = None
        self._tables: dict[str, Table] | None = None

    @property
    def tree(self) -> Record:
        """Everything, as nested records; lists of columns are tables."""
        if self._tree is None:
            tree = json.loads(self.core.outline(), object_pairs_hook=Record)
            self._tree = filled(tree, self.core.bulk())
        return self._tree

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return self.tree[name]
        except KeyError:
            known = ", ".join(self.tree)
            raise AttributeError(f"no {name!r} in this result; it has {known}") from None

    def __getitem__(self, name: str) -> Any:
        return self.tree[name]

    def __contains__(self, name: object) -> bool:
        return name in self.tree

    def keys(self) -> list[str]:
        """Names of what the result holds."""
        return list(self.tree)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *(name for name in self.tree if name.isidentifier())]

    @property
    def analysis(self) -> str:
        """Name of the question."""
        return self.core.analysis

    @property
    def finished(self) -> bool:
        """Whether all that was asked has been answered; see ``termination`` where not."""
        return self.core.termination[0] == "completed"

    @property
    def tables(self) -> dict[str, Table]:
        """The tables by title, such as ``"history"`` or ``"branch 1"``; empty where there are none."""
        if self._tables is None:
            bulk = self.core.bulk()
            if bulk:
                titled = zip(_titles(self.analysis, len(bulk)), bulk, strict=True)
            else:
                titled = iter(self.core.tables())  # type: ignore[assignment]
            self._tables = {title: Table(columns, title) for title, columns in titled}
        return self._tables

    @property
    def table(self) -> Table:
        """The first table; raises ``LookupError`` where the result has none."""
        for table in self.tables.values():
            return table
        raise LookupError(f"a result of {self.analysis} has no table")

    def to_dict(self) -> dict[str, Any]:
        """What the JSON file holds, as plain dicts and lists; missing numbers are ``None``."""
        plain: dict[str, Any] = json.loads(self.core.to_json(False))
        return plain

    def to_json(self) -> str:
        """The text of the JSON file."""
        return self.core.to_json(True) + "\n"

    def to_pandas(self) -> Any:
        """A ``pandas.DataFrame``; of several tables one below the other, ``table`` naming each row's."""
        if len(self.tables) == 1:
            return self.table.to_pandas()
        titles, table = joined(self.tables)
        frame = table.to_pandas()
        frame.insert(0, "table", needed("pandas", "pandas", "to_pandas()").Categorical(titles))
        return frame

    def to_arrow(self) -> Any:
        """A ``pyarrow.Table``; of several tables one below the other, ``table`` naming each row's."""
        if len(self.tables) == 1:
            return self.table.to_arrow()
        titles, table = joined(self.tables)
        arrow = needed("pyarrow", "pyarrow", "to_arrow()")
        named = arrow.array(titles, arrow.string()).dictionary_encode()
        return table.to_arrow().add_column(0, "table", named)

    def to_xarray(self) -> Any:
        """An ``xarray.Dataset`` over the first column, or over ``row`` where there are several tables."""
        if len(self.tables) == 1:
            return self.table.to_xarray()
        xarray = needed("xarray", "xarray", "to_xarray()")
        titles, table = joined(self.tables)
        variables = {
            name: xarray.Variable(("row",), values, {"units": table.units[name]})
            for name, values in table.items()
        }
        return xarray.Dataset(variables, coords={"table": ("row", titles)})

    def save(self, path: str | os.PathLike[str]) -> list[Path]:
        """Writes the result in the form of the ending, or in all forms into a folder (no ending).

        Endings are .json .csv .parquet .svg .png .html; .parquet needs the program halfshaft-parquet.
        Returns the files written; raises ``OutputError``.
        """
        return [Path(written) for written in self.core.save(os.fspath(path))]

    @property
    def figures(self) -> list[tuple[str, str]]:
        """Id and title of each figure, in the order of reading."""
        return [(name, title) for name, title, _ in self.core.figures()]

    def svg(self, figure: int | str = 0) -> str:
        """A figure as SVG, by its place or id; the drawing of the line for a result of ``check``."""
        return self.core.sketch() or self.core.figure_svg(self._index(figure), False)

    def png(self, figure: int | str = 0, *, scale: float = 2.0) -> bytes:
        """A figure as PNG, by its place or id; a scale of 1 gives 96 pixels per inch."""
        return self.core.figure_png(self._index(figure), scale)

    def plot(self, figure: int | str = 0) -> Any:
        """A figure to zoom and read off, as ``plotly.graph_objects.Figure``."""
        from ._plot import interactive

        return interactive(self.core.figure_plotly(self._index(figure)))

    def plot_static(self, figure: int | str = 0) -> Any:
        """A figure as ``matplotlib.figure.Figure``."""
        from ._plot import static

        return static(self.core.figure_plotly(self._index(figure)))

    def _index(self, figure: int | str) -> int:
        figures = self.figures
        if isinstance(figure, int) and -len(figures) <= figure < len(figures):
            return figure % len(figures)
        for index, (name, _) in enumerate(figures):
            if name == figure:
                return index
        known = ", ".join(name for name, _ in figures) or "none"
        raise LookupError(f"there is no figure {figure!r} of {self.analysis}; there is {known}")

    def summary(self) -> str:
        """What is told of the result, as text."""
        return self.core.summary()

    def page(self) -> str:
        """One self-contained HTML page with all figures."""
        return self.core.page()

    def _repr_html_(self) -> str:
        drawing = self.core.sketch()
        if drawing is None and self.core.figures():
            drawing = self.core.figure_svg(0, True)
        return f"{drawing or ''}<pre>{html.escape(self.summary())}</pre>"

    def __str__(self) -> str:
        return self.summary()

    def __repr__(self) -> str:
        told = "" if self.finished else f", ended early: {self.core.termination[0]}"
        return f"<Result of {self.analysis}: {self.tree['model']['name']}{told}>"

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Result):
            return NotImplemented
        return self.core == other.core

    __hash__: ClassVar[None]  # type: ignore[assignment]

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (self.core.to_json(False),)

    def __copy__(self) -> Result:
        return self

    def __deepcopy__(self, _memo: dict[int, Any]) -> Result:
        return self


def _titles(analysis: str, count: int) -> list[str]:
    """Titles of the bulk tables, as in flat files."""
    single = {"simulate": "history", "shock": "history", "bifurcation": "points"}
    if analysis in single:
        return [single[analysis]]
    name = {"resonance": "branch", "forced": "gear", "folds": "curve"}[analysis]
    return [f"{name} {number}" for number in range(1, count + 1)]


def _restored(text: str) -> Result:
    return Result(_halfshaft.Answer.from_json(text))


def load_result(path: str | os.PathLike[str]) -> Result:
    """Reads a result from the .json file that ``save`` or the program's ``--out`` wrote.

    Raises ``OutputError`` where the file holds no result.
    """
    text = Path(path).read_text(encoding="utf-8")
    try:
        return _restored(text)
    except ValueError as error:
        raise OutputError(f"{path}: {error}", "results are read from .json files") from error
