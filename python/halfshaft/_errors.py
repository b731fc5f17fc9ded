"""Exceptions of the package.

``HalfshaftError`` is the root; ``Interrupted`` alone stands outside it, beside Python's own
``KeyboardInterrupt``, so that a loop which catches errors does not swallow Ctrl-C.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from ._result import Result


class Diagnostic(NamedTuple):
    """One finding in a model or study text.

    ``line`` and ``column`` count from 1, the column in characters; ``severity`` is ``"error"`` or
    ``"warning"``; ``excerpt`` is the offending text and ``hint`` what to write instead.
    """

    severity: str
    file: str
    line: int
    column: int
    message: str
    excerpt: str
    hint: str | None


class Problem(NamedTuple):
    """What is wrong with one keyword argument of a question; ``hint`` may be empty."""

    option: str
    text: str
    message: str
    hint: str

    def __str__(self) -> str:
        written = f' "{self.text}"' if self.text else ""
        hint = f" ({self.hint})" if self.hint else ""
        about = f"{self.option}{written}: " if self.option else ""
        return f"{about}{self.message}{hint}"


class HalfshaftError(Exception):
    """Root of what the package raises."""


class ModelError(HalfshaftError, ValueError):
    """A model or study cannot be used; ``diagnostics`` lists every finding with its place."""

    diagnostics: list[Diagnostic]

    def __init__(self, message: str, diagnostics: Iterable[Any] = ()) -> None:
        super().__init__(message, [tuple(item) for item in diagnostics])
        self.diagnostics = [Diagnostic(*item) for item in self.args[1]]

    def __str__(self) -> str:
        return str(self.args[0])


class QuestionError(HalfshaftError, ValueError):
    """Keyword arguments of a question are wrong; ``problems`` lists all of them."""

    problems: list[Problem]

    def __init__(self, problems: Iterable[Any]) -> None:
        super().__init__([tuple(problem) for problem in problems])
        self.problems = [Problem(*problem) for problem in self.args[0]]

    def __str__(self) -> str:
        return "\n".join(str(problem) for problem in self.problems)


class AnalysisError(HalfshaftError):
    """A question that this line has no answer to; ``advice`` says what to try, where something can."""

    advice: str | None

    def __init__(self, message: str, advice: str | None = None, *further: Any) -> None:
        super().__init__(message, advice, *further)
        self.advice = advice

    def __str__(self) -> str:
        return f"{self.args[0]} ({self.advice})" if self.advice else str(self.args[0])


class ConvergenceError(AnalysisError):
    """The mathematics could not go on; ``reached`` is the result up to there, or ``None``."""

    reached: Result | None

    def __init__(
        self, message: str, advice: str | None = None, reached: Result | None = None
    ) -> None:
        super().__init__(message, advice, reached)
        self.reached = reached


class OutputError(HalfshaftError):
    """A result could not be written or read; ``advice`` says what to do, where something can."""

    advice: str | None

    def __init__(self, message: str, advice: str | None = None) -> None:
        super().__init__(message, advice)
        self.advice = advice

    def __str__(self) -> str:
        return f"{self.args[0]} ({self.advice})" if self.advice else str(self.args[0])


class Interrupted(KeyboardInterrupt):
    """Ctrl-C ended an analysis that was asked with ``on_interrupt="raise"``.

    ``reached`` is the result up to there.
    """

    reached: Result

    def __init__(self, reached: Result) -> None:
        super().__init__(reached)
        self.reached = reached

    def __str__(self) -> str:
        return f"{self.reached.analysis} was interrupted; .reached holds what there is"


class EarlyEnd(UserWarning):
    """An analysis ended before all was answered; the result holds what was reached."""


class BeyondRange(UserWarning):
    """A twist goes beyond the range that a :class:`TorqueFunction` was asked for."""
