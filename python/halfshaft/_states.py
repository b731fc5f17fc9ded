"""Questions about states of rest and small vibrations."""

from __future__ import annotations

from ._ask import OnInterrupt
from ._asker import Asker
from ._quantity import Names, Orders, Progress, Span
from ._result import Result


class States(Asker):
    """Methods that ask about rest and small vibrations."""

    __slots__ = ()

    def check(
        self,
        *,
        progress: Progress = None,
        on_interrupt: OnInterrupt = "return",
    ) -> Result:
        """What the model says: reduced inertias, ratios, active nonlinearities."""
        return self._ask("check", {}, progress, on_interrupt)

    def static(
        self,
        *,
        progress: Progress = None,
        on_interrupt: OnInterrupt = "return",
    ) -> Result:
        """All equilibria under the mean torques, and how much torque each shaft can carry."""
        return self._ask("static", {}, progress, on_interrupt)

    def modes(
        self,
        *,
        equilibrium: int | None = None,
        count: int | None = None,
        progress: Progress = None,
        on_interrupt: OnInterrupt = "return",
    ) -> Result:
        """Natural frequencies, damping and mode shapes about an equilibrium.

        ``equilibrium``: which equilibrium, as :meth:`static` numbers them, from 1.
        ``count``: how many of the lowest elastic modes.
        """
        given = {
            "equilibrium": equilibrium,
            "count": count,
        }
        return self._ask("modes", given, progress, on_interrupt)

    def campbell(
        self,
        *,
        frequency: Span | None = None,
        orders: Orders = None,
        operating: Span | None = None,
        count: int | None = None,
        this_gear: bool = False,
        progress: Progress = None,
        on_interrupt: OnInterrupt = "return",
    ) -> Result:
        """Critical speeds: where orders of the excitation meet natural frequencies.

        ``frequency``: range of the excitation speed (rad/s).
        ``orders``: orders, e.g. ``[0.5, 1, 2]``.
        ``operating``: range of speeds that critical speeds should keep away from
            (rad/s).
        ``count``: how many of the lowest elastic modes.
        ``this_gear``: only in the gear that the model is in.
        """
        given = {
            "frequency": frequency,
            "orders": orders,
            "operating": operating,
            "count": count,
            "this_gear": this_gear,
        }
        return self._ask("campbell", given, progress, on_interrupt)

    def forced(
        self,
        *,
        frequency: Span | None = None,
        points: int | None = None,
        orders: Orders = None,
        shaft: Names = None,
        node: Names = None,
        this_gear: bool = False,
        progress: Progress = None,
        on_interrupt: OnInterrupt = "return",
    ) -> Result:
        """Linear vibration over the excitation speed, order by order and all together.

        ``frequency``: range of the excitation speed (rad/s).
        ``points``: number of speeds.
        ``orders``: orders that act.
        ``shaft``: shafts to tell of.
        ``node``: nodes to tell of.
        ``this_gear``: only in the gear that the model is in.
        """
        given = {
            "frequency": frequency,
            "points": points,
            "orders": orders,
            "shaft": shaft,
            "node": node,
            "this_gear": this_gear,
        }
        return self._ask("forced", given, progress, on_interrupt)
