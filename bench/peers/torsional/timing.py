"""The tables of times: analyses by themselves and whole processes, all programs by turns."""

from dataclasses import dataclass, field

import kept
import models
import uniform
from environments import Failure
from halfshaft import every_shaft
from printed import plain
from processes import median

# Seconds after which what takes long is not repeated: it is known within a few per cent.
ENOUGH = 20.0


@dataclass
class Row:
    """One way of one program; `once` gives the processor seconds of a whole process and what it left."""

    program: str
    way: str
    once: object = None
    whole: list = field(default_factory=list)
    inside: list = field(default_factory=list)
    assembling: float | None = None
    left: object = None
    remark: str = ""

    def turn(self, first):
        """One more whole process, if that is still wanted."""
        if self.once is None or (not first and (not self.whole or sum(self.whole) > ENOUGH)):
            return
        try:
            seconds, self.left = self.once()
            self.whole.append(seconds)
        except Failure as failure:
            self.say(str(failure))

    def say(self, remark):
        """One more remark."""
        self.remark = "; ".join(filter(None, [self.remark, remark]))


def by_itself(row, ask):
    """Fills in the seconds of an analysis by itself, or why there are none."""
    try:
        row.inside = ask()
    except Failure as failure:
        row.say(str(failure))
    return row


def peer_rows(peer, name, what, line, repeats, whole, torque=None, few=None):
    """Rows of a peer: all ways by themselves, whole processes for those named in `whole`."""
    share = len(torque.speeds) / few if few else 1.0
    try:
        seconds = peer.seconds(what, line, repeats, torque, few)
    except Failure as failure:
        return [Row(name, what, remark=str(failure))]
    assembling = median(seconds.pop("assembling")) if "assembling" in seconds else None
    found = []
    for way, each in seconds.items():
        inside = [share * value for value in each]
        once = (lambda way=way: peer.once(what, line, torque, whole[way])) if way in whole else None
        remark = f"by itself: {few} speeds, scaled to all" if few else ""
        found.append(Row(name, way, once, inside=inside, assembling=assembling, remark=remark))
    return found


def own_row(half, way, words, example=None, form="json"):
    """halfshaft's row: the command line as users run it, the analysis by itself by the example."""
    out = half.work / f"{way.replace(', ', '-').replace(' ', '-')}.{form}"
    row = Row("halfshaft", way, lambda: (half.asked([*words, "--out", out]).seconds, out))
    return by_itself(row, lambda: half.seconds(example)) if example else row


def modes(half, peers, count, repeats, damping="none"):
    """Natural frequencies and mode shapes of the uniform chain."""
    line = uniform.line(count, damping)
    model = models.written(half.work, f"uniform-{count}-{damping}", f"Uniform chain of {count}", line)
    example = ["modes", count, 4 * repeats] if damping == "none" else None
    rows = [own_row(half, "modes", ["modes", model], example)]
    if example:
        alone = Row("halfshaft", "frequencies alone, as of modal_analysis")
        rows.append(by_itself(alone, lambda: half.seconds(["frequencies", *example[1:]])))
    # Of the ways those that give frequencies and shapes are run as whole processes.
    shapes = {"none": {"opentorsion": {"undamped_modal_analysis": "undamped"}, "ross": {"run_modal": ""},
                       "SciPy": {"eigh": "dense", "eigh_tridiagonal": "tridiagonal"}},
              "shafts": {"opentorsion": {"eigenmodes": "damped"}, "ross": {"run_modal": ""}}}[damping]
    for name, whole in shapes.items():
        if name in peers:
            found = peer_rows(peers[name], name, "modes", line, repeats, whole)
            rows += [row for row in found if damping == "none" or row.way != "undamped_modal_analysis"]
    return rows


def forced(half, peers, count, points, repeats, damping):
    """Shaft torques of the uniform chain over the speeds."""
    line, torque = uniform.line(count, damping), uniform.excitation(uniform.speeds(points))
    model = models.written(half.work, f"forced-{count}-{damping}", f"Uniform chain of {count}", line, torque)
    words = ["forced", model, "--frequency", f"{uniform.SLOWEST!r}..{uniform.FASTEST!r}", "--points", points]
    every = [*words, *every_shaft(line)]
    # The first is what the peers write: moduli of all orders of all shafts.
    rows = [own_row(half, "forced, all orders", every, ["forced", count, repeats] if damping == "shafts" else None),
            own_row(half, "forced, all orders, Parquet", every, form="parquet"),
            own_row(half, "forced, sums of the orders", words)]
    ways = {"opentorsion": ({"vibratory_torque": ""}, 50), "ross": ({"run_forced_response": ""}, 10),
            "SciPy": ({"elimination": ""}, None)}
    for name, (whole, few) in ways.items():
        if name in peers and (damping == "shafts" or name == "opentorsion"):
            few = min(few, points) if few else None
            rows += peer_rows(peers[name], name, "forced", line, repeats, whole, torque, few)
    return rows


def number(value):
    """Three digits, or a dash where there is none."""
    return f"{value:#.3g}" if value else "-"


def cells(row, own, quantity, case):
    """One line of the table; ratios are to halfshaft's row."""
    error, remark = kept.judged(quantity, row.left, case)
    row.say(remark)
    whole, inside = (median(values) if values else None for values in (row.whole, row.inside))
    base = [median(values) if values else None for values in (own.whole, own.inside)]
    ratios = [number(mine / half) if mine and half and row is not own else "-"
              for mine, half in zip((whole, inside), base)]
    both = inside + row.assembling if inside and row.assembling else None
    return (row.program, row.way, number(whole), number(min(row.inside, default=None)), number(inside),
            number(both), *ratios, error, row.remark)


def table(title, rows, repeats, quantity, case):
    """Runs the whole processes by turns and prints all."""
    for turn in range(repeats):
        for row in rows:
            row.turn(turn == 0)
    head = ("program", "way", "whole s", "by itself s, best", "median", "with assembling", "x whole", "x by itself",
            f"error of {quantity}", "remark")
    return f"## {title}\n\n{plain(head, [cells(row, rows[0], quantity, case) for row in rows])}"
