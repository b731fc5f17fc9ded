#!/usr/bin/env python3
"""Ensembles of forced Duffing oscillators: halfshaft against heyoka, SciPy and numbalsoda.

See README.md in this folder. Everything that is installed or written goes under target/peers.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import environments  # noqa: E402
from environments import Failure, quietly  # noqa: E402
from processes import one_core  # noqa: E402

FOLDER = Path(__file__).resolve().parent
PERIODS = 200


def arguments():
    """What is to be run."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--count", type=int, default=10_000, help="oscillators (default 10 000)")
    parser.add_argument("--repeats", type=int, default=5, help="measurements of each row (default 5)")
    parser.add_argument("--peers", default="heyoka,scipy,numbalsoda", help="comma-separated, or none")
    parser.add_argument("--halfshaft", help="a built example ensemble_times (default: cargo build --release)")
    parser.add_argument("--out", help="where the table goes (default target/peers/time.md)")
    return parser.parse_args()


class Side:
    """One way to integrate the oscillators."""

    def __init__(self, name, tolerance, count, command, out, option=""):
        self.name, self.tolerance, self.count, self.out = name, tolerance, count, out
        self.command = [*map(str, command), f"{option}{out}"]
        self.rates, self.states, self.remark, self.steps = [], None, "", None

    def once(self):
        """Runs once, unless it has failed before."""
        import numpy as np

        if self.remark:
            return
        try:
            said = json.loads(quietly(self.command, self.name).splitlines()[-1])
        except Failure as failure:
            self.remark = str(failure).strip().splitlines()[-1]
            return
        self.rates.append(said["per_processor_second"])
        self.steps = said.get("steps")
        self.states = np.fromfile(self.out, "<f8").reshape(-1, 2)


def sides(program, python, chosen, work):
    """All ways of all programs. Slow ones get fewer of the same oscillators: a rate needs no more."""
    count = chosen.count
    out = work / "ends.bin"
    for degree, tolerance in ((20, 1e-8), (20, 1e-9), (20, 1e-10), (20, 1e-11), (20, 1e-13), (24, 1e-10)):
        command = [program, count, PERIODS, tolerance, f"degree={degree}"]
        yield Side(f"halfshaft, degree {degree}", tolerance, count, command, out, "out=")
    command, few = [program, count, PERIODS, 1e-10, "instructions=avx2"], max(count // 10, 1)
    yield Side("halfshaft, AVX2", 1e-10, count, command, out, "out=")
    yield Side("halfshaft, one lane", 1e-10, few, [program, few, PERIODS, 1e-10, "lanes=1"], out, "out=")
    peers = chosen.peers.split(",")
    if "heyoka" in peers:
        for batch, wide, tolerance in ((8, 0, 1e-9), (8, 1, 1e-9), (16, 1, 1e-9), (8, 1, 1e-10), (16, 1, 1e-10),
                                       (8, 1, 1e-11), (1, 0, 1e-9)):
            name = f"heyoka, batch of {batch}{', AVX-512' if wide else ''}"
            few = max(count // (1 if batch > 1 else 10), 1)
            command = [python, FOLDER / "heyoka_peer.py", few, PERIODS, tolerance, batch, wide]
            yield Side(name, tolerance, few, command, out)
    if "numbalsoda" in peers:
        few = max(count // 50, 1)
        for tolerance in (1e-9, 1e-11):
            command = [python, FOLDER / "numbalsoda_peer.py", few, PERIODS, tolerance]
            yield Side("numbalsoda DOP853", tolerance, few, command, out)
    if "scipy" in peers:
        for way, few in (("one", max(count // 1000, 1)), ("all", max(count // 10, 1))):
            command = [python, FOLDER / "scipy_peer.py", few, PERIODS, 1e-11, way]
            name = "SciPy DOP853" if way == "one" else "SciPy DOP853, one system"
            yield Side(name, 1e-11, few, command, out)


def reference(program, python, count, work):
    """Ends by tight runs of two programs, and how far they are apart."""
    import numpy as np

    out = work / "reference.bin"
    quietly([str(program), str(count), str(PERIODS), "1e-15", "degree=24", f"out={out}"], "halfshaft")
    own = np.fromfile(out, "<f8").reshape(-1, 2)
    script = FOLDER / "heyoka_peer.py"
    quietly([str(python), str(script), str(count), str(PERIODS), "1e-16", "8", "0", str(out)], "heyoka")
    other = np.fromfile(out, "<f8").reshape(-1, 2)
    return other, float(np.abs(own - other)[:, 0].max())


def table(all_sides, ends_of):
    """The rows; ratios are to halfshaft's fastest row whose error is not larger."""
    import numpy as np

    rows = []
    for side in all_sides:
        error = float(np.abs(side.states - ends_of(side.count))[:, 0].max()) if side.rates else float("nan")
        rate = statistics.median(side.rates) if side.rates else float("nan")
        rows.append((side, rate, error))
    own = [(rate, error) for side, rate, error in rows if side.name.startswith("halfshaft, degree")]
    lines = ["| program | tolerance | oscillators | per second and core | largest error of x | halfshaft at no larger "
             "error | ratio |", "|---|---|---|---|---|---|---|"]
    for side, rate, error in rows:
        fair = [r for r, e in own if e <= error]
        best, ratio = (f"{max(fair):.0f}", f"{max(fair) / rate:.1f}") if fair and rate == rate else ("-", "-")
        lines.append(f"| {side.name} | {side.tolerance:.0e} | {side.count} | {rate:.0f} | {error:.1e} | {best} "
                     f"| {ratio} | {side.remark}")
    return "\n".join(lines)


# Multiplications and additions of one step of degree n: two products of series (x² and x² x), each half of
# n² pairs, the linear terms and the excitation by recurrence, the sums at the end of the step.
def operations(degree):
    """Floating-point operations of one step of one oscillator, counted from the recurrence."""
    pairs = degree * (degree + 1) / 2
    return 2 * (2 * pairs + 3 * degree + 2 * degree + 2 * degree)


def peak():
    """Double-precision operations a second of one core at the clock the system tells: two fused
    multiply-adds of the widest registers a cycle."""
    text = Path("/proc/cpuinfo").read_text() if Path("/proc/cpuinfo").exists() else ""
    clocks = [float(line.split(":")[1]) for line in text.splitlines() if line.startswith("cpu MHz")]
    if not clocks:
        return None
    wide = 8 if "avx512f" in text else 4 if "avx2" in text else 2
    return max(clocks) * 1e6 * wide * 2 * 2


def share(all_sides):
    """How much of the peak the fastest row of halfshaft reaches, in words."""
    own = [side for side in all_sides if side.name.startswith("halfshaft, degree") and side.rates and side.steps]
    most = peak()
    if not own or not most:
        return "The share of the processor's peak is not known here."
    best = max(own, key=lambda side: statistics.median(side.rates) * side.steps * operations(degree_of(side)))
    done = statistics.median(best.rates) * best.steps * operations(degree_of(best))
    return (f"Arithmetic of {best.name}: {best.steps:.0f} steps a trajectory, {operations(degree_of(best)):.0f} operations "
            f"a step, {done / 1e9:.1f} GFlop/s, {100 * done / most:.0f} % of {most / 1e9:.0f} GFlop/s (two fused "
            "multiply-adds of the widest registers a cycle).")


def degree_of(side):
    """Degree of the series of a row of halfshaft."""
    return int(side.name.split("degree")[1].split()[0])


def shocks(python, peers):
    """Single shock responses of both programs, in words."""
    said = {}
    program = environments.example("shock_times")
    said["halfshaft"] = json.loads(quietly([str(program), "2000", "1e-10"], "halfshaft").splitlines()[-1])
    if "heyoka" in peers:
        command = [str(python), str(FOLDER / "heyoka_shock.py"), "2000", "1e-10"]
        said["heyoka"] = json.loads(quietly(command, "heyoka").splitlines()[-1])
    lines = [f"{name}: {one['microseconds']:.1f} µs, {one['steps']} steps, twist at the end {one['twist']:.13f} rad"
             for name, one in said.items()]
    if "heyoka" in said:
        ratio = said["heyoka"]["microseconds"] / said["halfshaft"]["microseconds"]
        apart = abs(said["heyoka"]["twist"] - said["halfshaft"]["twist"])
        lines.append(f"ratio {ratio:.2f}, ends {apart:.1e} rad apart")
    return "Single shock response, 5 s at 1e-10, one motion on one lane, median of 2000:\n\n- " + "\n- ".join(lines)


def threads(program, count):
    """Rates by the clock with one and two threads."""
    lines = []
    for number in (1, 2):
        said = quietly([str(program), str(count), str(PERIODS), "1e-10", f"threads={number}"], "halfshaft")
        lines.append((number, json.loads(said)["per_second"]))
    return lines


def main():
    """All programs in turn, as often as asked, so that a busy machine disturbs all alike."""
    chosen = arguments()
    if sys.version_info < (3, 11):
        raise Failure(f"Python 3.11 or newer is needed, this is {sys.version.split()[0]}")
    work = environments.target_folder() / "peers"
    work.mkdir(parents=True, exist_ok=True)
    python = environments.environment(work / "time")
    if Path(sys.prefix).resolve() != (work / "time").resolve():
        os.execv(python, [str(python), *sys.argv])
    program = environments.halfshaft(chosen.halfshaft)
    scaling = threads(program, chosen.count)
    one_core()
    ends, apart = reference(program, python, chosen.count, work)
    known = {}

    def ends_of(count):
        # Other counts are other oscillators.
        if count == chosen.count:
            return ends
        if count not in known:
            known[count] = reference(program, python, count, work)[0]
        return known[count]

    all_sides = list(sides(program, python, chosen, work))
    for _ in range(chosen.repeats):
        for side in all_sides:
            side.once()
    text = (f"# {chosen.count} forced Duffing oscillators over {PERIODS} periods\n\nProcessor time on one core, medians "
            f"of {chosen.repeats}; tight runs of halfshaft and heyoka are {apart:.1e} apart.\n\n"
            + table(all_sides, ends_of) + "\n\n" + share(all_sides) + "\n\n"
            + shocks(python, chosen.peers.split(",")) + "\n\nBy the clock: " + ", ".join(
                f"{rate:.0f} per second with {number} thread{'s' if number > 1 else ''}"
                for number, rate in scaling) + ".\n")
    print(text)
    out = Path(chosen.out) if chosen.out else work / "time.md"
    out.write_text(text)
    print(f"written to {out}")


if __name__ == "__main__":
    try:
        main()
    except (Failure, subprocess.SubprocessError) as failure:
        sys.exit(f"error: {failure}")
