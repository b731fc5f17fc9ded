#!/usr/bin/env python3
"""Periodic responses: halfshaft against AUTO-07p, pyHarm and jaxcont, timed and judged in one run.

See README.md in this folder. Everything that is installed or written goes under target/peers.
"""

import argparse
import dataclasses
import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import environments  # noqa: E402
from processes import Failure, one_core  # noqa: E402

PEERS = ("auto", "pyharm", "jaxcont")


def arguments():
    """What is to be run."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--cases", default="", help="comma-separated: duffing, hardening, folds, absorber, "
                        "ten, fifty, scaling (default: all)")
    parser.add_argument("--peers", default=",".join(PEERS), help="comma-separated, or none")
    parser.add_argument("--repeats", type=int, default=7, help="measurements of each row (default 7)")
    parser.add_argument("--method", help="halfshaft's method (default: the best this build has)")
    parser.add_argument("--halfshaft", help="a built program (default: cargo build --release)")
    parser.add_argument("--out", help="where the tables go (default target/peers/periodic.md)")
    return parser.parse_args()


def in_own_environment(work):
    """Starts this script again in an environment that has what it needs itself (NumPy)."""
    if sys.version_info < (3, 11):
        raise Failure(f"Python 3.11 or newer is needed, this is {sys.version.split()[0]}")
    python = environments.environment(work / "base", (environments.NUMPY,))
    if Path(sys.prefix).resolve() != (work / "base").resolve():
        os.execv(python, [str(python), *sys.argv])


class Peers:
    """The peers that could be made ready; a peer that could not is named with the reason."""

    def __init__(self, names, work):
        self.ready = {}
        for name in names:
            try:
                self.ready[name] = getattr(self, f"make_{name}")(work)
            except Failure as failure:
                print(f"WITHOUT {name}: {failure}", file=sys.stderr)

    @staticmethod
    def make_auto(work):
        """AUTO-07p, compiled."""
        from auto import Auto

        return Auto(environments.auto_sources(work), work / "auto")

    @staticmethod
    def make_pyharm(work):
        """pyHarm's interpreter."""
        return environments.environment(work / "pyharm", environments.PYHARM)

    @staticmethod
    def make_jaxcont(work):
        """jaxcont's interpreter."""
        return environments.environment(work / "jaxcont", environments.JAXCONT)

    def sides(self, case):
        """All peers' ways of running a case."""
        import auto_cases
        import python_peers

        if "auto" in self.ready:
            yield from (auto_cases.Side(self.ready["auto"], case, s) for s in case.auto)
        if "pyharm" in self.ready:
            yield from (python_peers.pyharm(self.ready["pyharm"], case, s) for s in case.pyharm)
        if "jaxcont" in self.ready and case.jaxcont:
            yield python_peers.jaxcont(self.ready["jaxcont"], case)


def compare(half, peers, case, repeats):
    """One case: all sides in turn, as often as asked, so that a busy machine disturbs all alike."""
    import halfshaft
    from table import judge, markdown

    own = [halfshaft.Side(half, case, *way) for way in half.settings(case)] if half.can(case) else []
    sides = [*own, *peers.sides(case)]
    for turn in range(repeats):
        for side in sides:
            # What takes long needs no repetition to be known within a few per cent.
            if turn == 0 or sum(side.whole) < 20_000:
                side.once()
    rows = [judge(side.row(), case.references) for side in sides]
    return markdown(case.title, rows, rows[:len(own)], case.fold_tolerance)


def scaling(half, repeats, folder):
    """halfshaft by itself: one nonlinear shaft, a linear rest of growing length."""
    import cases
    import halfshaft
    import models
    from printed import plain
    from table import judge

    low, high = cases.SCALING_RANGE
    lines = []
    for count, references in cases.SCALING.items():
        case = dataclasses.replace(cases.TEN, line=cases.one_nonlinear(count), low=low, high=high,
                                   channel="inertia 1.angle", references=references)
        name, flags = half.settings(case)[0]
        side = halfshaft.Side(half, case, name, flags, models.one_nonlinear(count, folder))
        try:
            for turn in range(repeats):
                if turn == 0 or sum(side.whole) < 10_000:
                    side.once()
        except Failure as failure:
            lines.append((str(count), "-", "-", "-", "-", "-", "-", "-", str(failure).splitlines()[-1]))
            break
        row = judge(side.row(), references)
        lines.append((str(count), str(row.samples), f"{row.whole:.1f}", f"{row.inside:.2f}",
                      f"{1e3 * row.per_sample:.1f}", f"{1e3 * row.per_sample / count:.3f}",
                      f"{row.frequency_error or 0:.1e}", f"{row.amplitude_error or 0:.1e}", row.remark))
    head = ("inertias", "samples", "whole ms", "inside ms", "us/sample", "us/sample/inertia",
            "frequency error", "amplitude error", "remark")
    return f"## One nonlinear shaft in a line of n inertias (halfshaft only)\n\n{plain(head, lines)}"


def million_points():
    """halfshaft by itself: numbers of responses at a million points, seconds on one thread."""
    from printed import plain

    printed = environments.million_points()
    rows = [tuple(line.split()) for line in printed.splitlines()]
    slowest = max(float(row[1]) for row in rows)
    head = ("parameter", "seconds", "points with 1 response", "with 2", "with 3")
    return ("## Number of responses at a million points by first harmonic (halfshaft only)\n\n"
            f"{plain(head, rows)}\n\nSlowest: {slowest:.3f} s; promised: less than 2 s.\n")


def main():
    """All chosen cases, printed as they come and written to a file."""
    chosen = arguments()
    work = environments.target_folder() / "peers"
    work.mkdir(parents=True, exist_ok=True)
    in_own_environment(work)
    import cases
    import halfshaft

    half = halfshaft.Halfshaft(*environments.halfshaft(chosen.halfshaft), chosen.method)
    names = [name for name in chosen.peers.split(",") if name in PEERS]
    peers = Peers(names, work)
    one_core()
    wanted = chosen.cases.split(",") if chosen.cases else [c.key for c in cases.CURVES] + ["scaling", "map"]
    parts = [f"Processor time on one core; halfshaft's method: {half.method}. The columns x tell how often\n"
             "halfshaft's time fits, of its row that is accurate enough and has the nearest number of samples.\n"]
    for case in cases.CURVES:
        if case.key in wanted:
            parts.append(compare(half, peers, case, chosen.repeats))
            print(parts[-1], flush=True)
    if "scaling" in wanted and half.method != "averaged":
        parts.append(scaling(half, chosen.repeats, work))
        print(parts[-1], flush=True)
    if "map" in wanted:
        parts.append(million_points())
        print(parts[-1], flush=True)
    out = Path(chosen.out) if chosen.out else work / "periodic.md"
    out.write_text("\n".join(parts))
    print(f"written to {out}")


if __name__ == "__main__":
    try:
        main()
    except Failure as failure:
        sys.exit(f"error: {failure}")
