"""Drivelines: read, built, changed, compared."""

from __future__ import annotations

import html
import os
from collections.abc import Mapping
from typing import Any

from . import _halfshaft, _toml
from ._build import Builder, added
from ._errors import Diagnostic, ModelError
from ._law import Laws, TorqueFunction
from ._quantity import Quantity
from ._questions import Questions
from ._words import plain, quantity


class Driveline(Builder, Questions):
    """A driveline that never changes: methods that change something return another one.

    ``Driveline("name")`` is empty, to be built up element by element::

        line = (
            Driveline("Two masses")
            .inertia("engine", "0.3 kg·m²")
            .inertia("vehicle", "80 kg·m²")
            .shaft("half-shaft", "engine", "vehicle", "6 kN·m/rad", damping=2)
            .torque("engine torque", "engine", amplitude="40 N·m")
        )

    The text is read and checked by the reader of model files when the line is first used. Lines are
    equal where all their values in SI are (:attr:`digest`); they can be pickled and copied, and be
    keys of dicts.
    """

    __slots__ = ("_data", "_functions", "_line", "_source", "_text")

    def __init__(self, name: str = "Driveline", *, description: str | None = None) -> None:
        head = {"format": 1, "name": name, "description": description}
        self._set(_data=plain(head))

    def _set(
        self,
        *,
        _data: dict[str, Any] | None = None,
        _text: str | None = None,
        _source: str = "model",
        _line: _halfshaft.Line | None = None,
        _functions: Laws | None = None,
    ) -> Driveline:
        self._data, self._text, self._source, self._line = _data, _text, _source, _line
        self._functions: Laws = _functions or {}
        return self

    @classmethod
    def _make(cls, **parts: Any) -> Driveline:
        return cls.__new__(cls)._set(**parts)

    def _with_element(self, table: str, keys: dict[str, Any]) -> Driveline:
        data = added(self._tables(), table, keys)
        return self._make(_data=data, _source=self._source, _functions=self._functions)

    def _with_function(self, shaft: str, law: TorqueFunction) -> Driveline:
        functions = {**self._functions, shaft: law}
        parts = {"_data": self._data, "_text": self._text, "_source": self._source}
        return self._make(**parts, _functions=functions)

    def _tables(self) -> dict[str, Any]:
        if self._data is None:
            self._data = _toml.loads(self._text or "")
        return self._data

    def _core(self) -> _halfshaft.Line:
        if self._line is None:
            self._line = self._read({})
        return self._line

    def _laws(self) -> Laws:
        return self._functions

    def _read(self, changes: Mapping[str, Quantity]) -> _halfshaft.Line:
        settings = [f"{address}={quantity(value)}" for address, value in changes.items()]
        line = _halfshaft.Line.read(self._toml(), self._source, settings)
        if self._functions:
            laws = [(shaft, law._core) for shaft, law in self._functions.items()]
            line = line.with_functions(laws, list(changes))
        return line

    def _toml(self) -> str:
        if self._text is None:
            self._text = _toml.dumps(self._data or {})
        return self._text

    def _no_file(self, wanted: str) -> None:
        if self._functions:
            shafts = ", ".join(self._functions)
            raise ModelError(
                f"{wanted} cannot hold the torque of {shafts}, which is a function of Python: pickle the "
                "line, or give the law by keys of the model file, such as table"
            )

    def validate(self) -> Driveline:
        """The line itself; raises ``ModelError`` with all mistakes where it has any."""
        self._core()
        return self

    @property
    def name(self) -> str:
        """Name of the line."""
        return self._core().name

    @property
    def description(self) -> str:
        """Free text about the line."""
        return self._core().description

    @property
    def digest(self) -> str:
        """SHA-256 over all values in SI, in hexadecimal."""
        return self._core().digest

    @property
    def elements(self) -> list[str]:
        """Names of all elements: the first part of addresses."""
        return self._core().elements

    @property
    def warnings(self) -> list[Diagnostic]:
        """What is odd about the model."""
        return [Diagnostic(*item) for item in self._core().warnings]

    def with_(self, values: Mapping[str, Quantity] | None = None, /, **more: Quantity) -> Driveline:
        """The line with other numbers at some addresses.

        ``line.with_({"half-shaft.cubic": "-500 N·m/rad³"})`` or
        ``line.with_(**{"half-shaft.cubic": -500})``; bare numbers are in SI. Raises ``ModelError``
        where an address leads nowhere or a value is not allowed there.
        """
        data = self._tables()
        changes = {**(values or {}), **more}
        line = self._read(changes)
        for address, value in changes.items():
            data = _toml.with_value(data, address, plain(value))
        return self._make(
            _data=data, _source=self._source, _line=line, _functions=self._functions
        )

    def to_toml(self) -> str:
        """The line as a model file; that of a line that was read is the text as it was read.

        Raises ``ModelError`` where a law is a function of Python, which no model file can hold.
        """
        self._no_file("a model file")
        return self._toml()

    def to_dict(self) -> dict[str, Any]:
        """The tables of the model file, as lists and dicts of your own."""
        self._no_file("the tables of a model file")
        tables: dict[str, Any] = plain(self._tables())
        return tables

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the model file (TOML)."""
        text = self.to_toml()
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)

    def sketch(self) -> str:
        """A drawing of the line as SVG."""
        drawing = self.check().core.sketch()
        return drawing or ""

    def _repr_html_(self) -> str:
        answer = self.check()
        told = html.escape(answer.core.summary())
        return f"{answer.core.sketch() or ''}<pre>{told}</pre>"

    def __repr__(self) -> str:
        head = self._tables().get("name", "")
        counts = {
            key: len(value) for key, value in self._tables().items() if isinstance(value, list)
        }
        told = ", ".join(f"{count} {key}" for key, count in counts.items())
        return f"<Driveline {head!r}: {told or 'empty'}>"

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Driveline):
            return NotImplemented
        return self is other or self.digest == other.digest

    def __hash__(self) -> int:
        return hash(self.digest)

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (self._toml(), self._source, dict(self._functions))

    def __copy__(self) -> Driveline:
        return self

    def __deepcopy__(self, _memo: dict[int, Any]) -> Driveline:
        return self


def _restored(text: str, source: str, functions: Laws | None = None) -> Driveline:
    return Driveline._make(_text=text, _source=source, _functions=functions)


def load(path: str | os.PathLike[str]) -> Driveline:
    """Reads a model file (TOML).

    Raises ``ModelError`` with all mistakes at once, ``FileNotFoundError`` where there is no file.
    """
    name = os.fspath(path)
    line = _halfshaft.Line.load(name, [])
    with open(name, encoding="utf-8-sig") as file:
        text = file.read()
    return Driveline._make(_text=text, _source=name, _line=line)


def loads(text: str, *, name: str = "model") -> Driveline:
    """Reads a model text; files that it names are relative to the folder of ``name``."""
    return Driveline._make(_text=text, _source=name).validate()


def from_dict(data: Mapping[str, Any], *, name: str = "model") -> Driveline:
    """A line from the tables of a model file as dicts and lists; ``format`` may be left out."""
    tables = {"format": 1, **plain(data)}
    return Driveline._make(_data=tables, _source=name).validate()


def example() -> Driveline:
    """The built-in example: the two-mass driveline of Han and He (2018), its half-shaft softening."""
    line, source, text = _halfshaft.Line.example()
    return Driveline._make(_text=text, _source=source, _line=line)
