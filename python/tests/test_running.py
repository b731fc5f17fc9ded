"""While it runs: the lock, Ctrl-C, progress, early ends, ensembles."""

from __future__ import annotations

import os
import pickle
import signal
import subprocess
import sys
import threading
import warnings
from collections.abc import Iterator

import numpy as np
import pytest

import halfshaft
from halfshaft import Driveline, EarlyEnd, Interrupted, QuestionError, Result


def long_run(line: Driveline, **keywords: object) -> Result:
    return line.simulate(duration=50_000, frequency="4Hz", step=100, tolerance=1e-13, **keywords)  # type: ignore[arg-type]


@pytest.fixture
def alarm() -> Iterator[None]:
    """Ctrl-C after a moment, also where it is ignored as in a job in the background."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    yield
    timer.cancel()
    signal.signal(signal.SIGINT, before)


@pytest.mark.skipif(sys.platform == "win32", reason="signals are sent otherwise there")
def test_ctrl_c_returns_what_was_reached(line: Driveline, alarm: None) -> None:
    with pytest.warns(EarlyEnd):
        answer = long_run(line)
    assert not answer.finished and answer.termination.reason == "cancelled"
    assert answer.table.rows > 0


@pytest.mark.skipif(sys.platform == "win32", reason="signals are sent otherwise there")
def test_ctrl_c_raises_where_that_is_wanted(line: Driveline, alarm: None) -> None:
    with pytest.raises(Interrupted) as caught:
        long_run(line, on_interrupt="raise")
    assert caught.value.reached.termination.reason == "cancelled"
    assert isinstance(caught.value, KeyboardInterrupt)


def test_other_threads_run_meanwhile(line: Driveline) -> None:
    counted, done = 0, threading.Event()

    def count() -> None:
        nonlocal counted
        while not done.is_set():
            counted += 1

    other = threading.Thread(target=count)
    other.start()
    line.simulate(duration=100, frequency="4Hz", step=1)
    done.set()
    other.join()
    assert counted > 1000


def test_progress_is_told_and_may_stop(line: Driveline) -> None:
    told: list[float] = []
    line.simulate(duration=300, frequency="4Hz", step=10, tolerance=1e-12, progress=told.append)
    assert told == sorted(told) and all(0 <= share <= 1 for share in told)

    def enough(share: float) -> None:
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        long_run(line, progress=enough)


def test_wrong_keywords_are_told_all_at_once(line: Driveline) -> None:
    with pytest.raises(QuestionError) as caught:
        line.resonance(method="averged", frequency="5Hz..3kg")  # type: ignore[arg-type]
    assert {problem.option for problem in caught.value.problems} == {"method", "frequency"}
    assert "averaged" in str(caught.value)
    assert pickle.loads(pickle.dumps(caught.value)).problems == caught.value.problems
    with pytest.raises(QuestionError):
        line.modes(equilibrium=99)
    with pytest.raises(halfshaft.AnalysisError):
        Driveline("Still").inertia("disc", 1).shaft("rod", "disc", "ground", 1).resonance()


def test_an_ensemble_has_the_results_of_single_questions(oscillator: Driveline) -> None:
    # Source: two paths to one thing, to the last bit.
    table = {
        "spring.cubic": np.linspace(-0.9, -0.3, 7),
        "excitation.amplitude": [float(n) for n in range(5, 12)],
    }
    asked = halfshaft.ensemble(oscillator, table, "resonance", method="averaged", window=2)
    assert len(asked) == 7
    for row, answer in enumerate(asked):
        values = {address: column[row] for address, column in table.items()}
        assert answer == oscillator.with_(values).resonance(method="averaged")


def test_an_ensemble_goes_on_behind_a_row_without_answer(oscillator: Driveline) -> None:
    rows = [{"spring.stiffness": value} for value in ("600 N·m/rad", -1, "700 N·m/rad")]
    with pytest.raises(halfshaft.ModelError):
        list(halfshaft.ensemble(oscillator, rows, method="averaged"))
    kept = list(halfshaft.ensemble(oscillator, rows, method="averaged", errors="return"))
    assert [isinstance(answer, Result) for answer in kept] == [True, False, True]
    with pytest.raises(halfshaft.ModelError, match="did you mean"):
        halfshaft.ensemble(oscillator, {"spring.stifness": [1]})


def test_an_ensemble_that_is_left_ends(oscillator: Driveline) -> None:
    with halfshaft.ensemble(oscillator, {"spring.cubic": -np.ones(10_000)}) as asked:
        next(asked)
    assert list(asked) == []


def test_nothing_is_warned_of_where_all_is_well(oscillator: Driveline) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        oscillator.check(), oscillator.static(), oscillator.modes()


def test_importing_it_waits_for_no_other_package() -> None:
    others = ["matplotlib", "numpy", "pandas", "pint", "plotly", "pyarrow", "tqdm", "xarray"]
    told = f"import sys, halfshaft; print(*sorted(set({others}) & set(sys.modules)))"
    ran = subprocess.run([sys.executable, "-c", told], capture_output=True, text=True, check=True)
    assert ran.stdout.split() == []
