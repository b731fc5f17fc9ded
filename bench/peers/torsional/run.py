#!/usr/bin/env python3
"""Torsional analyses of linear lines: halfshaft against openTorsion and ross, judged and timed in one run.

See README.md in this folder. Everything that is installed or written goes under target/peers.
"""

import argparse
import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import environments  # noqa: E402
from environments import Failure  # noqa: E402

PARTS = ("agreement", "modes", "damped", "forced", "modal")


def arguments():
    """What is to be run."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--parts", default=",".join(PARTS), help="comma-separated (default: all)")
    parser.add_argument("--peers", default=",".join(environments.PEERS), help="comma-separated, or none")
    parser.add_argument("--count", type=int, default=200, help="inertias of the timed chain (default 200)")
    parser.add_argument("--points", type=int, default=1000, help="speeds of the forced response (default 1000)")
    parser.add_argument("--repeats", type=int, default=5, help="measurements of each row (default 5)")
    parser.add_argument("--halfshaft", help="a built program (default: cargo build --release)")
    parser.add_argument("--example", help="a built example torsional_times (default: beside the program)")
    parser.add_argument("--out", help="where the tables go (default target/peers/torsional.md)")
    return parser.parse_args()


def in_own_environment(work):
    """Starts this script again in an environment that has what it needs itself (NumPy)."""
    if sys.version_info < (3, 11):
        raise Failure(f"Python 3.11 or newer is needed, this is {sys.version.split()[0]}")
    python = environments.environment(work / "base", environments.BASE)
    if Path(sys.prefix).resolve() != (work / "base").resolve():
        os.execv(python, [str(python), *sys.argv])


def agreement(half, peers, chosen):
    """All cases and the uniform chain, by all programs."""
    import agreement
    import cases
    import uniform

    everything = [*cases.CASES, *(uniform.case(chosen.count, damping) for damping in ("shafts", "modes"))]
    said = {"halfshaft": half.agreement(everything)}
    for name in ("opentorsion", "ross"):
        if name in peers:
            said[name] = peers[name].agreement(everything)
    return agreement.table(everything, said)


def measured(part, half, peers, chosen):
    """One table of times."""
    import timing
    import uniform

    count, points, repeats = chosen.count, chosen.points, chosen.repeats
    damping = {"modes": "none", "damped": "shafts", "forced": "shafts", "modal": "modes"}[part]
    with_damping = {"none": "no damping", "shafts": "damping in the shafts", "modes": "modal damping"}[damping]
    case = uniform.case(count, damping, points if part in ("forced", "modal") else 1)
    if part in ("modes", "damped"):
        rows, quantity = timing.modes(half, peers, count, repeats, damping), "frequencies"
        title = f"Modes of {count} inertias, {with_damping}"
    else:
        rows, quantity = timing.forced(half, peers, count, points, repeats, damping), "torques"
        title = f"Forced response of {count} inertias at {points} speeds with four orders, {with_damping}"
    return timing.table(title, rows, repeats, quantity, case)


def main():
    """All chosen parts, printed as they come and written to a file."""
    chosen = arguments()
    base = environments.target_folder() / "peers"
    work = base / "torsional"
    work.mkdir(parents=True, exist_ok=True)
    in_own_environment(base)
    import peers as programs
    from halfshaft import Halfshaft
    from processes import one_core

    names = [name for name in chosen.peers.split(",") if name in environments.PEERS]
    peers, missing = programs.ready(names, work)
    half = Halfshaft(*environments.halfshaft(chosen.halfshaft, chosen.example), work)
    one_core()
    parts = ["Processor time on one core, medians; ratios tell how often halfshaft's time fits.\n"]
    parts += [f"WITHOUT {name}: {reason}\n" for name, reason in missing.items()]
    print("\n".join(parts), flush=True)
    for part in chosen.parts.split(","):
        parts.append(agreement(half, peers, chosen) if part == "agreement" else measured(part, half, peers, chosen))
        print(parts[-1], flush=True)
    out = Path(chosen.out) if chosen.out else base / "torsional.md"
    out.write_text("\n".join(parts))
    print(f"written to {out}")


if __name__ == "__main__":
    try:
        main()
    except Failure as failure:
        sys.exit(f"error: {failure}")
