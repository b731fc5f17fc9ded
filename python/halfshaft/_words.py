"""Values of Python as the texts that the model format and the questions know.

Bare numbers are in SI. Quantities of pint, and of anything else that has ``magnitude`` and ``units``
like them, are written with their units, so that a wrong dimension is found where it is used.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

# Units that pint abbreviates in its own way.
_UNITS = {"Δ°C": "K", "delta_degC": "K", "turn": "rev", "revolutions": "rev"}


def is_quantity(value: object) -> bool:
    """Whether a value is a number with a unit, as pint has them."""
    return hasattr(value, "magnitude") and hasattr(value, "units")


def number(value: Any) -> str:
    """A number as text that is read back to the last bit; a bool is no number."""
    if isinstance(value, bool):
        raise TypeError("a number is wanted, not a bool")
    if hasattr(value, "item"):
        value = value.item()
    if not isinstance(value, (int, float)):
        raise TypeError(f"a number or a text with a unit is wanted, not {type(value).__name__}")
    return repr(value)


def quantity(value: Any) -> str:
    """A single value as text: ``2.5``, ``"2.5 Hz"`` or a quantity of pint."""
    if isinstance(value, str):
        return value
    if is_quantity(value):
        unit = f"{value.units:~P}"
        return f"{number(value.magnitude)} {_UNITS.get(unit, unit)}".strip()
    return number(value)


def span(value: Any) -> str:
    """A range as text: ``"3Hz..5Hz"``, ``(18.8, 31.4)`` or ``("3 Hz", "5 Hz")``."""
    if isinstance(value, (tuple, list)) and len(value) == 2:
        return f"{quantity(value[0])}..{quantity(value[1])}"
    return quantity(value)


def plain(value: Any) -> Any:
    """A value of a model table as text, number, bool, list or dict; what is ``None`` is left out."""
    if value is None or isinstance(value, (str, bool)):
        return value
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items() if item is not None}
    if is_quantity(value):
        if hasattr(value.magnitude, "__len__"):
            return [plain(item) for item in value]
        return quantity(value)
    if hasattr(value, "tolist"):
        return plain(value.tolist())
    if isinstance(value, (int, float)):
        return value
    if isinstance(value, Iterable):
        return [plain(item) for item in value]
    raise TypeError(f"a model cannot hold a {type(value).__name__}")


def _listed(value: Any) -> str:
    """``[0.5, 1, 2]`` as ``0.5,1,2``; a text stands as it is."""
    if isinstance(value, str) or not isinstance(value, Iterable):
        return quantity(value)
    return ",".join(quantity(item) for item in value)


def _initial(value: Any) -> list[str]:
    """``{"half-shaft.twist": "1 rad"}`` or texts ``CHANNEL=VALUE``."""
    if isinstance(value, Mapping):
        return [f"{channel}={quantity(item)}" for channel, item in value.items()]
    return [value] if isinstance(value, str) else [str(item) for item in value]


def _parameter(value: Any) -> str:
    """``"half-shaft.cubic=-700..0"``, ``("half-shaft.cubic", -700, 0)`` or a dict of one range."""
    if isinstance(value, Mapping):
        ((address, ends),) = value.items()
        return f"{address}={span(ends)}"
    if isinstance(value, (tuple, list)) and len(value) == 3:
        return f"{value[0]}={span(value[1:])}"
    return str(value)


def _grid(value: Any) -> str:
    """``200`` or ``(300, 200)``."""
    return "x".join(map(number, value)) if isinstance(value, (tuple, list)) else quantity(value)


def _window(value: Any) -> str:
    """Two ranges: of twists and of rates of twist."""
    return value if isinstance(value, str) else ",".join(span(ends) for ends in value)


_SPECIAL = {
    "orders": _listed,
    "shaft": _listed,
    "node": _listed,
    "initial": _initial,
    "parameter": _parameter,
    "grid": _grid,
    "window": _window,
}


def options(given: Mapping[str, Any]) -> dict[str, Any]:
    """The options of a question as the extension takes them; what is ``None`` is left out."""
    words: dict[str, Any] = {}
    for name, value in given.items():
        if value is None:
            continue
        if isinstance(value, bool):
            words[name] = value
        else:
            words[name] = _SPECIAL.get(name, span)(value)
    return words
