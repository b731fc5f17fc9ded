"""Questions about motions in time."""

from __future__ import annotations

from typing import Literal

from ._ask import OnInterrupt
from ._asker import Asker
from ._quantity import Grid, Initial, Progress, Quantity, Span, Sweep, Window
from ._result import Result


class Motions(Asker):
    """Methods that ask about motions in time."""

    __slots__ = ()

    def simulate(
        self,
        *,
        duration: Quantity | None = None,
        start: Literal["rest", "equilibrium"] | None = None,
        initial: Initial = None,
        frequency: Quantity | Span | None = None,
        rate: Quantity | None = None,
        friction: Literal["exact", "smoothed"] | None = None,
        integrator: str | None = None,
        orders: str | None = None,
        step: Quantity | None = None,
        tolerance: float | None = None,
        record: Span | None = None,
        progress: Progress = None,
        on_interrupt: OnInterrupt = "return",
    ) -> Result:
        """A time history of the full equations; torques act from time 0 on.

        ``duration``: end of the history (s); 5 s where it is left out.
        ``start``: state before the initial values.
        ``initial``: values at time 0, ``{"half-shaft.twist": "1 rad"}``.
        ``frequency``: excitation speed (rad/s), or two for a run-up or run-down.
        ``rate``: rate of a run-up in place of its duration (rad/s²).
        ``friction``: how dry friction is taken.
        ``integrator``: which integrator.
        ``orders``: channel whose order spectra are told.
        ``step``: time between two rows (s).
        ``tolerance``: relative tolerance of the integration.
        ``record``: times to keep (s).
        """
        given = {
            "duration": duration,
            "start": start,
            "initial": initial,
            "frequency": frequency,
            "rate": rate,
            "friction": friction,
            "integrator": integrator,
            "orders": orders,
            "step": step,
            "tolerance": tolerance,
            "record": record,
        }
        return self._ask("simulate", given, progress, on_interrupt)

    def shock(
        self,
        *,
        method: Literal["full", "clamped", "published", "multiple-scales"] | None = None,
        order: int | None = None,
        equation: str | None = None,
        printed_velocity: bool = False,
        initial: Initial = None,
        duration: Quantity | None = None,
        step: Quantity | None = None,
        tolerance: float | None = None,
        compare: bool = False,
        progress: Progress = None,
        on_interrupt: OnInterrupt = "return",
    ) -> Result:
        """The response to a torque pulse or an initial twist, with metrics.

        ``method``: which equations.
        ``order``: multiple scales: of which order.
        ``equation``: multiple scales: of which equation.
        ``printed_velocity``: leave the slow terms out of the velocity (multiple
            scales, order 1).
        ``initial``: what disturbs in place of the model's pulses.
        ``duration``: end of the history (s).
        ``step``: time between two rows (s).
        ``tolerance``: relative tolerance of the integration.
        ``compare``: answer by all methods side by side.
        """
        given = {
            "method": method,
            "order": order,
            "equation": equation,
            "printed_velocity": printed_velocity,
            "initial": initial,
            "duration": duration,
            "step": step,
            "tolerance": tolerance,
            "compare": compare,
        }
        return self._ask("shock", given, progress, on_interrupt)

    def basins(
        self,
        *,
        frequency: Quantity | None = None,
        grid: Grid = None,
        window: Window = None,
        shaft: str | None = None,
        tolerance: float | None = None,
        periods: int | None = None,
        shock: str | None = None,
        progress: Progress = None,
        on_interrupt: OnInterrupt = "return",
    ) -> Result:
        """Which initial state leads to which response, at one excitation speed.

        ``frequency``: excitation speed (rad/s).
        ``grid``: number of twists and of rates: 200 or (300, 200).
        ``window``: twists (rad) and rates of twist (rad/s) at time 0.
        ``shaft``: shaft whose twist and rate are varied.
        ``tolerance``: relative tolerance of the integration.
        ``periods``: periods after which a motion is given up.
        ``shock``: node on which the smallest shock acts.
        """
        given = {
            "frequency": frequency,
            "grid": grid,
            "window": window,
            "shaft": shaft,
            "tolerance": tolerance,
            "periods": periods,
            "shock": shock,
        }
        return self._ask("basins", given, progress, on_interrupt)

    def bifurcation(
        self,
        *,
        frequency: Quantity | Span | None = None,
        parameter: Sweep = None,
        steps: int | None = None,
        transient: int | None = None,
        points: int | None = None,
        shaft: str | None = None,
        tolerance: float | None = None,
        direction: Literal["up", "down", "both"] | None = None,
        no_branches: bool = False,
        progress: Progress = None,
        on_interrupt: OnInterrupt = "return",
    ) -> Result:
        """What the line settles to on a stepwise sweep, seen once a period.

        ``frequency``: range of the excitation speed (rad/s); one speed beside
            ``parameter``.
        ``parameter``: a number of the model to go through at one speed.
        ``steps``: number of values.
        ``transient``: periods for settling at each value, at most.
        ``points``: periods that are recorded of a motion that does not repeat.
        ``shaft``: shaft whose twist and rate are recorded.
        ``tolerance``: relative error of a step of the integration.
        ``direction``: which way to sweep.
        ``no_branches``: leave out the branches that :meth:`resonance` continues.
        """
        given = {
            "frequency": frequency,
            "parameter": parameter,
            "steps": steps,
            "transient": transient,
            "points": points,
            "shaft": shaft,
            "tolerance": tolerance,
            "direction": direction,
            "no_branches": no_branches,
        }
        return self._ask("bifurcation", given, progress, on_interrupt)
