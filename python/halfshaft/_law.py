"""Torque laws given by functions of Python."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Union

from . import _halfshaft
from ._errors import BeyondRange
from ._quantity import Quantity, Span
from ._words import quantity, span

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    from ._result import Result

    _Array = npt.NDArray[np.float64]


class TorqueFunction:
    """A torque law (N·m) given by a function of the twist (rad).

    ``TorqueFunction(lambda twist: 6420 * np.sin(twist))``, for
    :meth:`Driveline.with_law` and :meth:`Driveline.shaft`. The function is called here and not again:
    with arrays of twists where it takes them, else with one twist after the other, more closely where it
    bends, until polynomials meet it to about 1e-13. All analyses take the law then and never wait for
    Python; its slope and its energy are those of the polynomials. What the function raises comes through.

    ``range``: least and greatest twist that it is asked for; half a turn to both sides where it is left
    out. Beyond, the law goes on straight with the slope that it has there, and results that go there
    come with a :class:`BeyondRange` warning.
    ``kinks``: twists at which the slope jumps; the torque itself must not.

    Raises ``ModelError`` where the function is not finite, or bends where no kink is told. The law can
    be pickled even where the function cannot.
    """

    __slots__ = ("_core", "name")

    #: What the function is called.
    name: str

    def __init__(
        self,
        function: Callable[[Any], Any],
        *,
        range: Span | None = None,
        kinks: Sequence[Quantity] = (),
    ) -> None:
        self.name = str(getattr(function, "__name__", type(function).__name__))
        ends = None if range is None else span(range)
        places = [quantity(kink) for kink in kinks]
        self._core = _halfshaft.Sampled.sample(_listing(function), self.name, ends, places)

    @property
    def range(self) -> tuple[float, float]:
        """Least and greatest twist that the function was asked for, rad."""
        breaks = self._core.parts()[0]
        return breaks[0], breaks[-1]

    def __call__(self, twist: npt.ArrayLike) -> _Array:
        """Torque at some twists, N·m: what analyses see."""
        return self._evaluated(twist, 0)

    def slope(self, twist: npt.ArrayLike) -> _Array:
        """Tangent stiffness at some twists, N·m/rad; at a kink that below it."""
        return self._evaluated(twist, 1)

    def _evaluated(self, twist: npt.ArrayLike, order: int) -> _Array:
        import numpy as np

        breaks, origins, pieces, _ = self._core.parts()
        x = np.asarray(twist, dtype=np.float64)
        values = np.empty_like(x)
        places = np.searchsorted(breaks, x)
        for place in np.unique(places):
            polynomial = np.polynomial.Polynomial(pieces[place] or [0.0]).deriv(order)
            here = places == place
            values[here] = polynomial(x[here] - origins[place])
        return values

    def __repr__(self) -> str:
        low, high = self.range
        return f"<TorqueFunction {self.name} from {low:.5g} to {high:.5g} rad>"

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (self.name, self._core.parts())


#: Functions as laws, by names of shafts.
Laws = Mapping[str, TorqueFunction]
#: A function of the twist (rad) that gives the torque (N·m).
TorqueLaw = Union[TorqueFunction, Callable[[Any], Any]]


def _restored(name: str, parts: Any) -> TorqueFunction:
    law = TorqueFunction.__new__(TorqueFunction)
    law.name, law._core = name, _halfshaft.Sampled.of_parts(parts)
    return law


def _listing(function: Callable[[Any], Any]) -> Callable[[_Array], list[float]]:
    """The function over many twists: at once where it gives as many torques, else one by one."""
    import numpy as np

    together = True

    def values(twists: _Array) -> list[float]:
        nonlocal together
        if together:
            try:
                # What is not finite is told with its place, which NumPy's warning lacks.
                with np.errstate(all="ignore"):
                    torques = np.asarray(function(twists.copy()), dtype=np.float64)
            except Exception:
                # One that branches, or is of the module math, takes numbers only; whether it fails
                # for other reasons its calls with numbers show.
                torques = np.empty(0)
            together = torques.shape == twists.shape
            if together:
                return [float(torque) for torque in torques]
        return [float(function(float(twist))) for twist in twists]

    return values


def warn_beyond(result: Result, laws: Laws) -> None:
    """Warns where a twist of the result goes beyond the range of its shaft's function."""
    for shaft, law in laws.items():
        low, high = law.range
        reached = [_swept(table, f"{shaft}.twist") for table in result.tables.values()]
        ends = [ends for ends in reached if ends is not None]
        least, greatest = min((e[0] for e in ends), default=low), max((e[1] for e in ends), default=high)
        if least < low or greatest > high:
            told = (
                f"{shaft} twists from {least:.4g} to {greatest:.4g} rad; {law.name} was asked for "
                f"{low:.4g} to {high:.4g} rad and goes on straight beyond (see range=)"
            )
            warnings.warn(told, BeyondRange, stacklevel=4)


def _swept(table: Mapping[str, _Array], channel: str) -> tuple[float, float] | None:
    """Least and greatest twist in a table: of a history, of states, or of responses."""
    if channel in table and len(table[channel]) > 0:
        return float(table[channel].min()), float(table[channel].max())
    if f"{channel}.amplitude" in table and len(table[f"{channel}.amplitude"]) > 0:
        swing = table[f"{channel}.amplitude"]
        mean = table[f"{channel}.mean"] if f"{channel}.mean" in table else 0 * swing
        return float((mean - swing).min()), float((mean + swing).max())
    return None
