"""Types of what keyword arguments take."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Literal, Protocol, Union


class HasUnits(Protocol):
    """A number with a unit, such as a quantity of pint."""

    @property
    def magnitude(self) -> Any: ...

    @property
    def units(self) -> Any: ...


#: A number in SI, a text with a unit, or a quantity of pint.
Quantity = Union[float, str, HasUnits]
#: Two ends, or a text ``"A..B"``.
Span = Union[str, tuple[Quantity, Quantity]]
#: ``True`` shows a bar of tqdm where that is installed; a function is told the finished share.
Progress = Union[bool, Callable[[float], object], None]
#: Orders as numbers or as a text ``"0.5,1,2"``.
Orders = Union[str, Sequence[float], None]
#: One name or several.
Names = Union[str, Sequence[str], None]
#: Values of channels at time 0.
Initial = Union[str, Sequence[str], Mapping[str, Quantity], None]
#: An address with a range of its values: ``"half-shaft.cubic=-700..0"``, a tuple, or a dict of one.
Sweep = Union[str, tuple[str, Quantity, Quantity], Mapping[str, Span], None]
#: How periodic responses are found.
Method = Union[Literal["harmonic-balance", "first-harmonic", "averaged"], None]
#: Number of twists and of rates of twist.
Grid = Union[int, tuple[int, int], str, None]
#: Twists and rates of twist.
Window = Union[str, tuple[Span, Span], None]
