"""Building a line in code, element by element."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, TypeVar

from ._law import TorqueFunction
from ._words import plain, span

if TYPE_CHECKING:
    from ._law import TorqueLaw
    from ._quantity import Quantity, Span

Self = TypeVar("Self", bound="Builder")


class Builder:
    """Methods that add an element and return another line; the line that they are called on stays.

    Quantities are texts with units (``"0.328 kg·m²"``), numbers in SI, or quantities of pint. Further
    keywords are the keys of the model file (docs/model-file.md). Nothing is checked until the line is
    used: then every mistake is told at once, in a ``ModelError``.
    """

    __slots__ = ()

    def _with_element(self: Self, table: str, keys: dict[str, Any]) -> Self:
        raise NotImplementedError

    def _with_function(self: Self, shaft: str, law: TorqueFunction) -> Self:
        raise NotImplementedError

    def inertia(
        self: Self, name: str, inertia: Quantity, *, damping: Quantity | None = None, **keys: Any
    ) -> Self:
        """Adds a rigid body of ``inertia`` (kg·m²) with ``damping`` to ground (N·m·s/rad)."""
        return self._with_element(
            "inertia", {"name": name, "inertia": inertia, "damping": damping, **keys}
        )

    def gear(self: Self, name: str, input: str, output: str, ratio: Quantity, **keys: Any) -> Self:
        """Adds a gear from node ``input`` to node ``output``; ``ratio`` is input over output speed."""
        return self._with_element(
            "gear", {"name": name, "input": input, "output": output, "ratio": ratio, **keys}
        )

    def shaft(
        self: Self,
        name: str,
        from_: str,
        to: str,
        stiffness: Quantity | None = None,
        *,
        torque: TorqueLaw | None = None,
        **keys: Any,
    ) -> Self:
        """Adds a shaft between two nodes; ``to="ground"`` holds it.

        ``stiffness`` (N·m/rad) and further keys such as ``damping`` (N·m·s/rad), ``cubic``
        (N·m/rad³), ``clearance`` (rad), ``friction`` (N·m) make up its law. ``torque`` is a function of
        the twist in place of stiffness and powers, as for :meth:`with_law`.
        """
        ends = {"name": name, "from": from_, "to": to, "stiffness": stiffness}
        if torque is None:
            return self._with_element("shaft", {**ends, **keys})
        # The reader wants some law and a torque from it; the function takes its place.
        stand_in = {**ends, "stiffness": 1 if stiffness is None else stiffness}
        return self._with_element("shaft", {**stand_in, **keys}).with_law(name, torque)

    def with_law(
        self: Self,
        shaft: str,
        torque: TorqueLaw,
        *,
        range: Span | None = None,
        kinks: Sequence[Quantity] = (),
    ) -> Self:
        """The line with the torque (N·m) of a shaft given by a function of its twist (rad).

        ``line.with_law("half-shaft", lambda twist: 6420 * np.sin(twist))``; the function is sampled
        once, as :class:`TorqueFunction` tells, with its ``range`` and ``kinks``. Damping, friction and
        preload of the shaft stay. Model files cannot hold such a line; pickles can.
        """
        if not isinstance(torque, TorqueFunction):
            torque = TorqueFunction(torque, range=range, kinks=kinks)
        elif range is not None or kinks:
            raise TypeError("range and kinks are those of the TorqueFunction; give it them")
        return self._with_function(shaft, torque)

    def torque(self: Self, name: str, on: str, **keys: Any) -> Self:
        """Adds a torque on a node: ``mean``, ``amplitude`` (N·m), ``order``, ``phase``, ``pulse``, ..."""
        return self._with_element("torque", {"name": name, "on": on, **keys})

    def damper(self: Self, name: str, on: str, **keys: Any) -> Self:
        """Adds a torsional vibration damper on a node."""
        return self._with_element("damper", {"name": name, "on": on, **keys})

    def engine(self: Self, name: str, **keys: Any) -> Self:
        """Adds a piston engine as a source of orders."""
        return self._with_element("engine", {"name": name, **keys})

    def whole(self: Self, **keys: Any) -> Self:
        """Sets what holds for the line as a whole: ``operating``, ``modal_damping``, ``loss_factor``."""
        if isinstance(keys.get("operating"), (tuple, list)):
            keys["operating"] = span(keys["operating"])
        return self._with_element("line", keys)


def added(data: dict[str, Any], table: str, keys: dict[str, Any]) -> dict[str, Any]:
    """The tables of a model with one element more; ``line`` is one table, the others are lists."""
    element = plain(keys)
    if table == "line":
        return {**data, table: {**data.get(table, {}), **element}}
    return {**data, table: [*data.get(table, []), element]}
