"""Resonance curves over a table of parameters: the Python package against the same work in Rust.

    python bench/ensemble.py                # 10 000 rows by each method
    python bench/ensemble.py --rows 1000 --methods averaged

Needs the package (``pip install .``) and cargo, which builds the example ``many_lines``. Both take the same
rows on the same number of threads in turns; the best of the repeats of each side counts, since whatever else
the machine does only makes them slower. Beside the rate stands the processor time of a curve, start of the
process included, which hangs less on who else is at work. Memory is the peak of the process, taken over that of one with a
hundredth of the rows.
"""

from __future__ import annotations

import argparse
import os
import resource
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
MODEL = ROOT / "examples" / "two-mass-driveline" / "scaled.toml"

# What a process of Python does: rows, threads, method; prints seconds, samples, peak memory in MB.
WORK = """
import resource, sys, time
import numpy
import halfshaft
rows, threads, method = int(sys.argv[2]), int(sys.argv[3]), sys.argv[4]
line = halfshaft.load(sys.argv[1])
place = numpy.arange(rows) / rows
table = {"spring.cubic": -1 + 0.9 * place, "excitation.amplitude": 5 + 10 * place}
began = time.perf_counter()
asked = halfshaft.ensemble(line, table, "resonance", threads=threads, method=method)
samples = sum(sum(curve.rows for curve in answer.tables.values()) for answer in asked)
seconds = time.perf_counter() - began
unit = 2**20 if sys.platform == "darwin" else 2**10
print(seconds, samples, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / unit)
"""


def measured(command: list[str]) -> list[float]:
    """Processor seconds of a process, and the numbers that it prints."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, capture_output=True, text=True, check=True, cwd=ROOT / "bench")
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    used = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return [used, *(float(word) for word in done.stdout.split())]


def example() -> str:
    """The example, built together with the extension so that both have their libraries in common."""
    packages = ["-p", "halfshaft", "-p", "halfshaft-py"]
    build = ["cargo", "build", "--release", "--quiet", *packages, "--example", "many_lines"]
    subprocess.run(build, check=True, cwd=ROOT)
    target = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    return str(target / "release" / "examples" / "many_lines")


def main() -> None:
    """Prints a table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rows", type=int, default=10_000)
    parser.add_argument("--threads", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--methods", default="averaged,first-harmonic,harmonic-balance")
    given = parser.parse_args()
    rust = example()
    print("| method | curves a second: Rust, Python | share | processor time of a curve: Rust, Python "
          "| share | peak memory, MB | with 1/100 of the rows |")
    print("|---|---|---|---|---|---|---|")
    for method in given.methods.split(","):
        rows, few = ([str(count), str(given.threads), method] for count in (given.rows, given.rows // 100))
        ours, theirs = [], []
        for _ in range(given.repeats):
            theirs.append(measured([rust, str(MODEL), *rows]))
            ours.append(measured([sys.executable, "-c", WORK, str(MODEL), *rows]))
        if {run[2] for run in ours} != {run[2] for run in theirs}:
            raise SystemExit(f"{method}: the two sides have different samples: {ours} {theirs}")
        small = measured([sys.executable, "-c", WORK, str(MODEL), *few])
        used, took = ([min(run[at] for run in runs) for runs in (theirs, ours)] for at in (0, 1))
        cost = [1e3 * seconds / given.rows for seconds in used]
        rates = [given.rows / seconds for seconds in took]
        peak = max(run[3] for run in ours)
        print(f"| {method} | {rates[0]:.0f}, {rates[1]:.0f} | {100 * rates[1] / rates[0]:.0f} % "
              f"| {cost[0]:.2f}, {cost[1]:.2f} ms | {100 * cost[0] / cost[1]:.0f} % "
              f"| {peak:.0f} | {small[3]:.0f} |", flush=True)


if __name__ == "__main__":
    main()
