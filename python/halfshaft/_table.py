"""Tables: named columns of numbers with units."""

from __future__ import annotations

import html
from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any, ClassVar

from ._optional import needed

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    Column = npt.NDArray[np.float64]

# Rows that a notebook shows at either end of a long table.
_SHOWN = 5


class Table(Mapping[str, "Column"]):
    """Columns of equal length by their names, the independent one first.

    ``table["half-shaft.twist"]`` is a float64 array that cannot be written to; missing values are NaN.
    The arrays of a result share its memory. ``units`` has the unit of each column, ``"1"`` for pure
    numbers.
    """

    __slots__ = ("_columns", "title", "units")

    _columns: dict[str, Column]
    #: Unit of each column.
    units: dict[str, str]
    #: Name of the table in its result.
    title: str

    def __init__(self, columns: Iterable[tuple[str, str, Column]], title: str = "") -> None:
        listed = list(columns)
        self._columns = {name: values for name, _, values in listed}
        self.units = {name: unit for name, unit, _ in listed}
        self.title = title

    def __getitem__(self, name: str) -> Column:
        try:
            return self._columns[name]
        except KeyError:
            known = ", ".join(self._columns)
            raise KeyError(f"there is no column {name!r}; there are {known}") from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    @property
    def names(self) -> list[str]:
        """Names of the columns."""
        return list(self._columns)

    @property
    def rows(self) -> int:
        """Number of rows."""
        return max((len(values) for values in self._columns.values()), default=0)

    def __eq__(self, other: object) -> bool:
        """Equal to the last bit; a missing value equals a missing value."""
        if not isinstance(other, Table):
            return NotImplemented
        if self.units != other.units or self.names != other.names:
            return False
        import numpy as np

        pairs = [(self[name], other[name]) for name in self]
        return all(np.array_equal(a, b, equal_nan=True) for a, b in pairs)

    __hash__: ClassVar[None]  # type: ignore[assignment]

    def __repr__(self) -> str:
        title = f" {self.title!r}" if self.title else ""
        return f"<Table{title}: {self.rows} rows of {_few(self.names)}>"

    def __getstate__(self) -> tuple[Any, ...]:
        return self._columns, self.units, self.title

    def __setstate__(self, state: tuple[Any, ...]) -> None:
        self._columns, self.units, self.title = state

    def to_dict(self) -> dict[str, Column]:
        """The columns as a dict of arrays, which are shared and not copied."""
        return dict(self._columns)

    def to_pandas(self) -> Any:
        """A ``pandas.DataFrame``; its ``attrs["units"]`` has the units."""
        pandas = needed("pandas", "pandas", "to_pandas()")
        frame = pandas.DataFrame(self._columns)
        frame.attrs["units"] = dict(self.units)
        return frame

    def to_arrow(self) -> Any:
        """A ``pyarrow.Table``; the metadata of each field has its unit."""
        arrow = needed("pyarrow", "pyarrow", "to_arrow()")
        fields = [
            arrow.field(name, arrow.float64(), metadata={"unit": self.units[name]}) for name in self
        ]
        arrays = [arrow.array(values) for values in self._columns.values()]
        return arrow.table(arrays, schema=arrow.schema(fields))

    def to_xarray(self) -> Any:
        """An ``xarray.Dataset`` over the first column; each variable has ``attrs["units"]``."""
        xarray = needed("xarray", "xarray", "to_xarray()")
        over = next(iter(self), "row")
        made = {
            name: xarray.Variable((over,), values, {"units": self.units[name]})
            for name, values in self._columns.items()
        }
        coordinates = {over: made.pop(over)} if over in made else {}
        return xarray.Dataset(made, coords=coordinates)

    def _repr_html_(self) -> str:
        count = self.rows
        few = count <= 2 * _SHOWN
        rows: list[int] = (
            list(range(count)) if few else [*range(_SHOWN), *range(count - _SHOWN, count)]
        )
        head = "".join(f"<th>{html.escape(_headed(n, u))}</th>" for n, u in self.units.items())
        lines = []
        for place, row in enumerate(rows):
            if not few and place == _SHOWN:
                lines.append(f'<tr><td colspan="{len(self) or 1}">…</td></tr>')
            cells = (f"{values[row]:.6g}" for values in self._columns.values())
            lines.append("<tr>" + "".join(f"<td>{cell}</td>" for cell in cells) + "</tr>")
        return f"<table><tr>{head}</tr>{''.join(lines)}</table><p>{count} rows</p>"


def _headed(name: str, unit: str) -> str:
    return name if unit in ("", "1") else f"{name} ({unit})"


def joined(tables: Mapping[str, Table]) -> tuple[list[str], Table]:
    """All tables one below the other: the title of each row, and the columns.

    Where a table lacks a column its rows have NaN there.
    """
    import numpy as np

    units: dict[str, str] = {}
    for table in tables.values():
        for name, unit in table.units.items():
            units.setdefault(name, unit)
    titles = [title for title, table in tables.items() for _ in range(table.rows)]
    columns = []
    for name, unit in units.items():
        parts = [
            table[name] if name in table else np.full(table.rows, np.nan)
            for table in tables.values()
        ]
        columns.append((name, unit, np.concatenate(parts) if parts else np.empty(0)))
    return titles, Table(columns)


def _few(names: list[str]) -> str:
    """The first names, and how many more there are."""
    more = f" and {len(names) - 4} more columns" if len(names) > 5 else ""
    return ", ".join(names[:4] if more else names) + more
