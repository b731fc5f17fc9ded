"""Questions about periodic responses."""

from __future__ import annotations

from typing import Literal

from ._ask import OnInterrupt
from ._asker import Asker
from ._quantity import Method, Progress, Quantity, Span, Sweep
from ._result import Result


class Periodic(Asker):
    """Methods that ask about periodic responses."""

    __slots__ = ()

    def resonance(
        self,
        *,
        frequency: Quantity | Span | None = None,
        parameter: Sweep = None,
        method: Method = None,
        harmonics: int | None = None,
        tolerance: float | None = None,
        stability: Literal["monodromy", "hill"] | None = None,
        backbone: bool = False,
        mode: int | None = None,
        order: float | None = None,
        points: int | None = None,
        verify: bool = False,
        progress: Progress = None,
        on_interrupt: OnInterrupt = "return",
    ) -> Result:
        """Periodic responses over excitation speed: branches, stability, special points.

        ``frequency``: range of the excitation speed (rad/s); one speed beside
            ``parameter``.
        ``parameter``: a number of the model to go through at one speed.
        ``method``: how: harmonic balance where it is left out.
        ``harmonics``: harmonics of the response.
        ``tolerance``: error of the waveform by the harmonics left out.
        ``stability``: where stability comes from.
        ``backbone``: add backbone curves.
        ``mode``: which elastic mode the default range is about.
        ``order``: which order of the torques excites.
        ``points``: about how many samples.
        ``verify``: check chosen responses against the full equations.
        """
        given = {
            "frequency": frequency,
            "parameter": parameter,
            "method": method,
            "harmonics": harmonics,
            "tolerance": tolerance,
            "stability": stability,
            "backbone": backbone,
            "mode": mode,
            "order": order,
            "points": points,
            "verify": verify,
        }
        return self._ask("resonance", given, progress, on_interrupt)

    def folds(
        self,
        *,
        parameter: Sweep = None,
        frequency: Span | None = None,
        method: Method = None,
        harmonics: int | None = None,
        tolerance: float | None = None,
        mode: int | None = None,
        order: float | None = None,
        points: int | None = None,
        progress: Progress = None,
        on_interrupt: OnInterrupt = "return",
    ) -> Result:
        """Fold curves in a plane of excitation speed and one parameter, with cusps.

        ``parameter``: the other axis (needed): ``("half-shaft.cubic", -700, 0)``.
        ``frequency``: range of the excitation speed (rad/s).
        ``method``: how: harmonic balance where it is left out.
        ``harmonics``: harmonics of the response.
        ``tolerance``: error of the waveform by the harmonics left out.
        ``mode``: which elastic mode the default range is about.
        ``order``: which order of the torques excites.
        ``points``: about how many points describe a curve.
        """
        given = {
            "parameter": parameter,
            "frequency": frequency,
            "method": method,
            "harmonics": harmonics,
            "tolerance": tolerance,
            "mode": mode,
            "order": order,
            "points": points,
        }
        return self._ask("folds", given, progress, on_interrupt)
