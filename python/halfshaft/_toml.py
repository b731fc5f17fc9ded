"""Model texts as dicts and back, and single numbers in them by their address."""

from __future__ import annotations

import copy
import json
from collections.abc import Mapping
from typing import Any

from . import _halfshaft
from ._errors import ModelError
from ._words import plain

_LISTS = ("inertia", "gear", "shaft", "torque", "damper", "engine")
# Name of the table that belongs to no element.
_WHOLE = "line"


def loads(text: str) -> dict[str, Any]:
    """The tables of a TOML text, in the order of the text."""
    data: dict[str, Any] = json.loads(_halfshaft.json_of_toml(text))
    return data


def dumps(data: Mapping[str, Any]) -> str:
    """A dict as TOML; every number is read back to the last bit."""
    return _halfshaft.toml_of_json(json.dumps(plain(data), ensure_ascii=False))


def with_value(data: Mapping[str, Any], address: str, value: Any) -> dict[str, Any]:
    """A copy of the tables of a model with the value at an address that exists.

    Raises ``ModelError`` where the number stands in a file of its own.
    """
    changed: dict[str, Any] = copy.deepcopy(dict(data))
    place, path = _element(changed, address)
    for key, following in zip(path[:-1], path[1:], strict=True):
        place = _inner(place, key, following, address)
    last = _key(place, path[-1], address)
    place[last] = value
    return changed


def _element(data: dict[str, Any], address: str) -> tuple[Any, list[str]]:
    """The table of the element with the longest name that fits, and the keys behind the name."""
    elements = [item for key in _LISTS for item in data.get(key, [])]
    fitting = [item for item in elements if address.startswith(item.get("name", "") + ".")]
    if fitting:
        element = max(fitting, key=lambda item: len(item["name"]))
        return element, address[len(element["name"]) + 1 :].split(".")
    if address.startswith(_WHOLE + "."):
        return data.setdefault(_WHOLE, {}), address[len(_WHOLE) + 1 :].split(".")
    raise ModelError(f'no element fits the address "{address}"')


def _key(place: Any, key: str, address: str) -> Any:
    """A key of a table, or the index of a list, which addresses count from 1."""
    if isinstance(place, list):
        return int(key) - 1
    if isinstance(place, dict):
        return key
    raise ModelError(
        f"{address} stands in a file of its own: give its points in the model to change it"
    )


def _inner(place: Any, key: str, following: str, address: str) -> Any:
    at = _key(place, key, address)
    if isinstance(place, dict) and at not in place and not following.isdigit():
        place[at] = {}
    return place[at]
