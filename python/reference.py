"""Writes docs/python-reference.md from the docstrings: ``python python/reference.py``."""

from __future__ import annotations

import inspect
import sys
import textwrap
from collections.abc import Iterator
from pathlib import Path
from typing import Any

# The sources beside this file lack the extension module: the installed package is meant.
sys.path = [path for path in sys.path if Path(path or ".").resolve() != Path(__file__).resolve().parent]

import halfshaft  # noqa: E402

PAGE = Path(__file__).resolve().parents[1] / "docs" / "python-reference.md"
HEAD = """# Reference of the Python package

Made from the docstrings by `python python/reference.py`. [The Python package](python.md) tells how it all
belongs together.
"""


def page() -> str:
    """The whole page: functions, classes with their members, exceptions."""
    things = [(name, getattr(halfshaft, name)) for name in halfshaft.__all__]
    classes = [(n, t) for n, t in things if inspect.isclass(t)]
    raised = [(n, t) for n, t in classes if issubclass(t, BaseException)]
    parts = [HEAD, "## Functions\n"]
    parts += [_entry("###", name, thing) for name, thing in things if inspect.isfunction(thing)]
    parts.append("## Classes\n")
    parts += [part for name, t in classes if (name, t) not in raised for part in _class(name, t)]
    parts.append("## Exceptions and warnings\n")
    parts += [_entry("###", f"{n}({t.__mro__[1].__name__})", t, signed=False) for n, t in raised]
    return "\n".join(parts).rstrip() + "\n"


def _class(name: str, thing: Any) -> Iterator[str]:
    yield _entry("###", name, thing, signed=False)
    for member, value in inspect.getmembers(thing):
        private = member.startswith("_") or not inspect.getdoc(value)
        own = "halfshaft" in (getattr(inspect.unwrap(_function(value)), "__module__", "") or "")
        if not private and own:
            yield _entry("####", f"{name}.{member}", value, signed=inspect.isroutine(value))


def _function(value: Any) -> Any:
    return value.fget if isinstance(value, property) else value


def _entry(level: str, name: str, thing: Any, *, signed: bool = True) -> str:
    lines = [f"{level} `{name}`\n"]
    if signed:
        lines.append(f"```python\n{_signature(name.split('.')[-1], thing)}\n```\n")
    lines.append(_markdown(inspect.getdoc(thing) or "") + "\n")
    return "\n".join(lines)


class _Bare:
    """An annotation that shows as it was written."""

    def __init__(self, annotation: object) -> None:
        self.annotation = annotation

    def __repr__(self) -> str:
        return str(self.annotation)


def _signature(name: str, thing: Any) -> str:
    """The signature, one parameter a line where it is long."""
    signature = inspect.signature(thing)
    kept = [p for p in signature.parameters.values() if p.name != "self"]
    bare = [p.replace(annotation=_Bare(p.annotation)) for p in kept]
    returned = _Bare(signature.return_annotation)
    text = f"{name}{signature.replace(parameters=bare, return_annotation=returned)}"
    if len(text) <= 100:
        return text
    head, tail = text.split("(", 1)
    inner, result = tail.rsplit(") -> ", 1)
    return f"{head}(\n{textwrap.indent(_broken(inner), '    ')}\n) -> {result}"


def _broken(inner: str) -> str:
    """Parameters, one a line; commas within brackets stay."""
    lines, depth = [""], 0
    for letter in inner:
        depth += (letter in "[(") - (letter in "])")
        lines[-1] += letter
        if letter == "," and depth == 0:
            lines.append("")
    return "\n".join(line.strip() for line in lines)


def _markdown(text: str) -> str:
    """A docstring as Markdown: marks of code, and lines that begin with one as a list."""
    lines = []
    for line in text.splitlines():
        for role in (":class:", ":meth:", ":attr:"):
            line = line.replace(role, "")
        line = line.replace("``", "`")
        if line.startswith("`") and "`: " in line:
            line = f"- {line}"
        lines.append(line)
    return "\n".join(lines).replace("::\n", ":\n")


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
