"""From a question to its result: progress, Ctrl-C, early ends."""

from __future__ import annotations

import contextlib
import sys
import warnings
from collections.abc import Callable, Iterator
from typing import Any, Literal, Union

from . import _halfshaft
from ._errors import ConvergenceError, EarlyEnd, Interrupted
from ._quantity import Progress
from ._result import Result

OnInterrupt = Literal["return", "raise"]
Tell = Union[Callable[[float], object], None]

# Ends behind which the numbers do not go on although the question does.
_FAILED = {"step-limit", "step-too-small", "non-finite", "chattering"}


def ask(
    work: Callable[[Tell], tuple[_halfshaft.Answer, bool]],
    title: str,
    progress: Progress,
    on_interrupt: OnInterrupt,
) -> Result:
    """Does the work and looks at how it ended."""
    with _meter(progress, title) as tell:
        core, interrupted = work(tell)
    return finished(core, interrupted, on_interrupt)


def finished(core: _halfshaft.Answer, interrupted: bool, on_interrupt: OnInterrupt) -> Result:
    """The result, or what is raised in its place.

    Raises ``Interrupted`` where Ctrl-C ended it and that is wanted, ``ConvergenceError`` where the
    mathematics could not go on; both hold what was reached.
    """
    result = Result(core)
    reason, detail = core.termination
    if interrupted and on_interrupt == "raise":
        raise Interrupted(result)
    if reason in _FAILED:
        raise ConvergenceError(f"{core.analysis} ended early: {detail}", None, result)
    if interrupted or reason != "completed":
        told = detail or ("interrupted" if interrupted else reason)
        warnings.warn(f"{core.analysis} ended early: {told}", EarlyEnd, stacklevel=4)
    return result


@contextlib.contextmanager
def _meter(progress: Progress, title: str) -> Iterator[Tell]:
    """A function that is told the finished share: the caller's, a bar of tqdm, or none."""
    if callable(progress):
        yield progress
        return
    bar = _bar(title) if progress else None
    if bar is None:
        yield None
        return
    with bar:
        yield lambda share: bar.update(share - bar.n)


def _bar(title: str) -> Any:
    try:
        from tqdm.auto import tqdm
    except ImportError:
        warnings.warn("progress is shown by tqdm: pip install tqdm", stacklevel=5)
        return None
    form = "{l_bar}{bar}| {elapsed}<{remaining}"
    return tqdm(total=1.0, desc=title, bar_format=form, leave=False, file=sys.stderr)
