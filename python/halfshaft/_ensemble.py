"""One question of many lines that differ in some numbers."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Literal, Union

from . import _halfshaft
from ._errors import HalfshaftError
from ._law import Laws, warn_beyond
from ._model import Driveline
from ._result import Result
from ._words import options as words
from ._words import plain

#: Values by address: columns of a dict or of a frame of pandas, or one dict a row.
Parameters = Union[Mapping[str, Any], Sequence[Mapping[str, Any]], Any]


class Ensemble:
    """Results in the order of the rows, one at a time; an iterator with a length.

    Not more than ``window`` results wait at one time, so that memory stays bounded whatever the number
    of rows. Leaving it early (``close()``, or the end of a ``with``) ends the work.
    """

    def __init__(
        self, core: _halfshaft.Ensemble, errors: Literal["raise", "return"], laws: Laws
    ) -> None:
        self._core = core
        self._errors = errors
        self._laws = laws

    def __len__(self) -> int:
        return len(self._core)

    def __iter__(self) -> Iterator[Result | HalfshaftError]:
        return self

    def __next__(self) -> Result | HalfshaftError:
        try:
            result = Result(next(self._core))
        except HalfshaftError as error:
            if self._errors == "raise":
                raise
            return error
        warn_beyond(result, self._laws)
        return result

    def close(self) -> None:
        """Ends the work that is under way."""
        self._core.close()

    def __enter__(self) -> Ensemble:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def ensemble(
    line: Driveline,
    parameters: Parameters,
    question: str = "resonance",
    *,
    threads: int | None = None,
    window: int | None = None,
    errors: Literal["raise", "return"] = "raise",
    **options: Any,
) -> Ensemble:
    """Asks ``question`` of ``line`` with each row of a table of parameters, on all cores.

    ``parameters``: ``{"half-shaft.cubic": array, "engine torque.amplitude": array}``, a frame of pandas
    with addresses as columns, or a list of dicts; numbers in SI or texts with units.
    ``threads``: all cores where it is left out. ``window``: results under way or waiting at one time.
    ``errors``: whether a row without an answer raises, or gives its exception in the place of a result.
    Further keywords are those of the question.

    Results come in the order of the rows while later rows are being computed::

        swings = [r.peaks[0]["half-shaft.twist.amplitude"] for r in ensemble(line, table)]

    Raises ``ModelError`` for an address or value that leads nowhere, ``QuestionError`` for keywords.
    """
    threads = threads or os.cpu_count() or 1
    columns = [(str(address), list(plain(values))) for address, values in _columns(parameters)]
    core = _halfshaft.Ensemble(
        line._core(), question, words(options), columns, threads, window or 4 * threads
    )
    return Ensemble(core, errors, line._laws())


def _columns(parameters: Any) -> list[tuple[str, Any]]:
    if hasattr(parameters, "items"):
        return list(parameters.items())
    rows = list(parameters)
    names = list(rows[0]) if rows else []
    return [(name, [row[name] for row in rows]) for name in names]
