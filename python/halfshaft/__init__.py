"""halfshaft: nonlinear torsional dynamics of automotive drivelines.

First plot of a resonance curve::

    import halfshaft
    line = halfshaft.load("my-line.toml")
    line.resonance(frequency="3Hz..5Hz").plot()
"""

from __future__ import annotations

import os

from . import _halfshaft
from ._ask import OnInterrupt, ask
from ._auto import AutoBranch, AutoPoint, read_auto
from ._ensemble import Ensemble, ensemble
from ._errors import (
    AnalysisError,
    BeyondRange,
    ConvergenceError,
    Diagnostic,
    EarlyEnd,
    HalfshaftError,
    Interrupted,
    ModelError,
    OutputError,
    Problem,
    QuestionError,
)
from ._law import TorqueFunction
from ._model import Driveline, example, from_dict, load, loads
from ._quantity import Progress
from ._record import Record
from ._result import Result, load_result
from ._table import Table

__version__: str = _halfshaft.version()

__all__ = [
    "AnalysisError",
    "AutoBranch",
    "AutoPoint",
    "BeyondRange",
    "ConvergenceError",
    "Diagnostic",
    "Driveline",
    "EarlyEnd",
    "Ensemble",
    "HalfshaftError",
    "Interrupted",
    "ModelError",
    "OutputError",
    "Problem",
    "QuestionError",
    "Record",
    "Result",
    "Table",
    "TorqueFunction",
    "ensemble",
    "example",
    "from_dict",
    "load",
    "load_result",
    "loads",
    "read_auto",
    "run_study",
]


def run_study(
    path: str | os.PathLike[str],
    *,
    progress: Progress = None,
    on_interrupt: OnInterrupt = "return",
) -> Result:
    """Asks all questions of a study file; ``save("folder")`` writes its page, figures and comparison."""
    name = os.fspath(path)
    return ask(lambda tell: _halfshaft.run_study(name, tell), "study", progress, on_interrupt)
