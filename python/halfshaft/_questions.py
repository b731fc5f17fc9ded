"""All questions that a line can be asked."""

from __future__ import annotations

from ._ask import OnInterrupt, ask
from ._motions import Motions
from ._periodic import Periodic
from ._quantity import Progress
from ._result import Result
from ._states import States


class Questions(States, Motions, Periodic):
    """One method a question, its keywords named as the flags of the command."""

    __slots__ = ()

    def report(self, *, progress: Progress = None, on_interrupt: OnInterrupt = "return") -> Result:
        """Everything about the line in one result; ``save("report.html")`` writes its page."""
        return ask(self._core().report, "report", progress, on_interrupt)
