"""Rows of the comparison, their errors against the references, and how they are printed."""

import math
from dataclasses import dataclass, field

from printed import plain


@dataclass
class Found:
    """A special point, or the response at a given frequency, that a program gave."""

    kind: str
    frequency: float
    harmonic1: float | None = None
    parameter: float | None = None


@dataclass
class Row:
    """One program with one setting on one case. Times are processor milliseconds."""

    program: str
    settings: str
    samples: int = 0
    whole: float | None = None
    inside: float | None = None
    found: list = field(default_factory=list)
    remark: str = ""
    frequency_error: float | None = None
    amplitude_error: float | None = None

    @property
    def per_sample(self):
        """Milliseconds a sample, start-up left out."""
        return self.inside / self.samples if self.inside is not None and self.samples else None


def judge(row, references, whole_curve=True):
    """Fills in the errors: the worst over all references, and a remark on those not found."""
    missing = []
    for reference in references:
        same = [found for found in row.found if found.kind == reference.kind
                and abs(found.frequency - reference.frequency) < 0.02 * reference.frequency]
        if not same:
            missing.append(f"{reference.kind} at {reference.frequency:.4f}")
            continue
        best = min(same, key=lambda found: abs(found.frequency - reference.frequency))
        errors = [abs(best.frequency - reference.frequency)]
        if reference.parameter is not None and best.parameter is not None:
            errors.append(abs(best.parameter - reference.parameter))
        row.frequency_error = max([row.frequency_error or 0.0, *errors])
        if reference.harmonic1 is not None and best.harmonic1 is not None:
            error = abs(best.harmonic1 - reference.harmonic1)
            row.amplitude_error = max(row.amplitude_error or 0.0, error)
    if missing and whole_curve:
        row.remark = "; ".join(filter(None, [row.remark, "NOT FOUND: " + ", ".join(missing)]))
    return row


HEAD = ("program", "settings", "samples", "whole ms", "inside ms", "ms/sample",
        "frequency error", "amplitude error", "x whole", "x curve", "x sample", "remark")


def counterpart(row, own, tolerance):
    """halfshaft's row that a peer's row is measured against.

    Of those that meet the tolerance of the case (of all where none does) the one with the most
    similar number of samples, so that neither side gains by drawing its curve with fewer.
    """
    good = [one for one in own if (one.frequency_error or 0.0) <= tolerance and "NOT" not in one.remark]
    rows = good or own
    return min(rows, key=lambda one: abs(math.log(max(one.samples, 1) / max(row.samples, 1))),
               default=None)


def cells(row, mine):
    """One line; the ratios tell how often halfshaft's row `mine` fits into this one."""

    def ratio(theirs, ours):
        return f"{theirs / ours:.1f}" if theirs and ours else "-"

    def number(value, form):
        return form.format(value) if value is not None else "-"

    ratios = ("-", "-", "-") if mine is None else (
        ratio(row.whole, mine.whole), ratio(row.inside, mine.inside), ratio(row.per_sample, mine.per_sample))
    return (row.program, row.settings, str(row.samples or "-"), number(row.whole, "{:.1f}"),
            number(row.inside, "{:.2f}"), number(row.per_sample, "{:.4f}"),
            number(row.frequency_error, "{:.1e}"), number(row.amplitude_error, "{:.1e}"),
            *ratios, row.remark)


def markdown(title, rows, own, tolerance, head=HEAD):
    """A table of all rows, as Markdown that also reads well in a terminal."""
    lines = [cells(row, None if row in own else counterpart(row, own, tolerance)) for row in rows]
    return f"## {title}\n\n{plain(head, lines)}"
