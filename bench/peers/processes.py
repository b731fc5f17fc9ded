"""Child processes on one core, measured in processor seconds (user and system)."""

import os
import resource
import statistics
import subprocess
import tempfile
from dataclasses import dataclass

from preparation import Failure  # noqa: F401


@dataclass
class Run:
    """One finished process."""

    status: int
    seconds: float
    output: str
    errors: str


def one_core():
    """Keeps this process and all its children on the core it now has, with one thread each."""
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})
    for name in ("OMP", "OPENBLAS", "MKL", "NUMEXPR", "RAYON", "NUMBA"):
        os.environ[f"{name}_NUM_THREADS"] = "1"


def measured(command, cwd=None, limit=900):
    """Runs a command to its end and takes its processor time, start-up and all, from the system."""
    with tempfile.TemporaryFile("w+") as output, tempfile.TemporaryFile("w+") as errors:
        # No work of ours between fork and exec, which would count as the program's.
        child = subprocess.Popen(command, cwd=cwd, stdout=output, stderr=errors)
        # A program that never ends must not hold the machine: the system stops it.
        resource.prlimit(child.pid, resource.RLIMIT_CPU, (limit, limit + 5))
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        output.seek(0)
        errors.seek(0)
        return Run(child.returncode, usage.ru_utime + usage.ru_stime, output.read(), errors.read())


def median(values):
    """The middle one, which a busy machine disturbs least."""
    return statistics.median(values)
