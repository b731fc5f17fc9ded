"""The table of agreement: all programs on all cases."""

import judgement
from printed import plain


def rows(cases, said):
    """A row for each quantity of each case; `said` are the answers by program."""
    for case in cases:
        for quantity in judgement.JUDGES:
            asked = [name for name in said if quantity in said[name][case.key]
                     or quantity in said[name][case.key]["cannot"]]
            if asked:
                yield row(case, quantity, {name: said[name][case.key] for name in said})


def row(case, quantity, said):
    """One row."""
    cells, remarks = [], [case.remark] if quantity == "frequencies" and case.remark else []
    for name, answer in said.items():
        number, remark = judgement.cell(case, quantity, answer)
        cells.append(number)
        remarks += [f"{name}: {remark}"] if remark else []
    both = [said[name] for name in ("halfshaft", "opentorsion") if name in said]
    between = judgement.apart(case, quantity, *both) if len(both) == 2 else "-"
    printed = "-"
    if quantity == "frequencies" and case.published:
        missed = [name for name, answer in said.items() if judgement.published(case, answer) is False]
        printed = "NOT by " + ", ".join(missed) if missed else "all"
    what = f"{judgement.count(case, quantity)} {quantity}"
    return (case.title, what, f"{case.known:.0e}", *cells, between, printed, "; ".join(remarks))


def table(cases, said):
    """The table, and the worst of the frequencies that should be zero."""
    head = ("case", "compared", "reference to", *said, "halfshaft to opentorsion", "as published", "remark")
    zeros = ", ".join(f"{name} {max(judgement.rigid(case, said[name][case.key]) for case in cases):.1e}"
                      for name in said)
    return (f"## Agreement\n\nLargest relative differences from the references.\n\n"
            f"{plain(head, list(rows(cases, said)))}\n"
            f"Largest frequency in Hz that should be zero: {zeros} (ross leaves rigid-body modes out).\n")
