"""What all groups of questions share."""

from __future__ import annotations

from typing import Any

from . import _halfshaft
from ._ask import OnInterrupt, ask
from ._law import Laws, warn_beyond
from ._quantity import Progress
from ._result import Result
from ._words import options


class Asker:
    """Something that has a line to ask.

    Every question takes, beside its own keywords, ``progress`` (``True`` for a bar of tqdm, or a
    function that is told the finished share) and ``on_interrupt``: what Ctrl-C does, ``"return"``
    what was reached, with a warning, or ``"raise"`` an ``Interrupted`` that holds it.

    Quantities are numbers in SI, texts with units, or quantities of pint; ranges are two of them, or a
    text ``"3Hz..5Hz"``. Raises ``QuestionError`` for wrong keywords, ``AnalysisError`` where the line
    has no answer, ``ConvergenceError`` where the mathematics could not go on.
    """

    __slots__ = ()

    def _core(self) -> _halfshaft.Line:
        raise NotImplementedError

    def _laws(self) -> Laws:
        raise NotImplementedError

    def _ask(
        self, verb: str, given: dict[str, Any], progress: Progress, on_interrupt: OnInterrupt
    ) -> Result:
        words, core = options(given), self._core()
        result = ask(lambda tell: core.ask(verb, words, tell), verb, progress, on_interrupt)
        warn_beyond(result, self._laws())
        return result
