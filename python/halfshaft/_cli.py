"""The command line: the program itself, in this process."""

from __future__ import annotations

import sys

from . import _halfshaft


def main() -> int:
    """Does what the arguments of the process say; returns the exit status."""
    sys.stdout.flush()
    return _halfshaft.main(["halfshaft", *sys.argv[1:]])
