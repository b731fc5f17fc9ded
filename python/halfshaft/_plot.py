"""Figures for Plotly and Matplotlib, from the figure data that the pages of the program use."""

from __future__ import annotations

import json
import re
from typing import Any

from ._optional import needed

Layout = dict[str, Any]
_SIDES = {-1: "right", 0: "center", 1: "left"}
_HEIGHTS = {-1: "top", 0: "center", 1: "bottom"}
_DASHES = {"solid": "-", "dash": "--", "dot": ":", "dashdot": "-."}
_MARKERS = {
    "circle": "o", "square": "s", "diamond": "D", "cross": "P", "x": "X", "triangle-up": "^",
    "triangle-down": "v", "star": "*",
}  # fmt: skip
_PIXELS_PER_INCH = 96.0


def interactive(text: str) -> Any:
    """A Plotly figure from the JSON of one."""
    objects = needed("plotly.graph_objects", "plotly", "plot()")
    figure = json.loads(text)
    secondary = _secondary(figure["layout"])
    traces = [trace for trace in figure["data"] if not _stands_on(trace, secondary)]
    layout = {
        key: value
        for key, value in figure["layout"].items()
        if key not in secondary and key != "meta"
    }
    return objects.Figure(data=traces, layout=layout, skip_invalid=True)


def static(text: str) -> Any:
    """A Matplotlib figure from the JSON of a Plotly figure."""
    needed("matplotlib", "matplotlib", "plot_static()")
    from matplotlib.figure import Figure

    given = json.loads(text)
    layout = given["layout"]
    secondary = _secondary(layout)
    places = sorted(
        (key for key in layout if key.startswith("yaxis") and key not in secondary),
        key=lambda key: -layout[key].get("domain", [0, 1])[0],
    )
    height = float(layout.get("height", 400.0)) / _PIXELS_PER_INCH
    drawn = Figure(figsize=(7.6, height), layout="constrained")
    grid = drawn.subplots(max(len(places), 1), 1, squeeze=False)
    panels = {_short(key): grid[row][0] for row, key in enumerate(places)}
    for trace in given["data"]:
        panel = panels.get(trace.get("yaxis", "y"))
        if panel is not None and not _stands_on(trace, secondary):
            _draw(panel, trace)
    for key in places:
        _finish(panels[_short(key)], layout, layout[key])
    _lines(panels, layout)
    _remarks(panels, layout)
    for link in layout.get("meta", {}).get("linked", []):
        _second(panels, layout, link)
    drawn.suptitle(_unmarked(layout.get("title", {}).get("text", "")))
    return drawn


def _secondary(layout: Layout) -> set[str]:
    """Axes in another unit: tied to the first ones by the page's script alone, which is not here."""
    return {link["axis"] for link in layout.get("meta", {}).get("linked", [])}


def _short(axis: str) -> str:
    """``yaxis2`` as traces call it: ``y2``."""
    return axis.replace("axis", "")


def _stands_on(trace: Layout, axes: set[str]) -> bool:
    own = {trace.get("xaxis", "x"), trace.get("yaxis", "y")}
    return bool(own & {_short(axis) for axis in axes})


def _draw(panel: Any, trace: Layout) -> None:
    """One trace: a heat map, a curve or points."""
    if trace.get("type") == "heatmap":
        panel.pcolormesh(trace["x"], trace["y"], trace["z"], shading="nearest")
        return
    if trace.get("type") != "scatter":
        return
    nan = float("nan")
    x, y = ([nan if v is None else v for v in trace.get(side) or []] for side in "xy")
    if not x:
        return
    name = _unmarked(trace.get("name", ""))
    label = name if trace.get("showlegend") and name else None
    mode = trace.get("mode", "lines")
    line = trace.get("line", {})
    if trace.get("fill") in ("toself", "tozeroy"):
        panel.fill(x, y, **_fill(trace), label=label)
    elif "lines" in mode:
        width = 0.75 * float(line.get("width", 2.0))
        dash = _dash(line.get("dash", "solid"), width)
        panel.plot(x, y, color=_colour(line.get("color")), lw=width, ls=dash, label=label)
    if "markers" in mode:
        marker = trace.get("marker", {})
        colour = _colour(marker.get("color"))
        shape = _MARKERS.get(str(marker.get("symbol", "circle")).removesuffix("-open"), "o")
        hollow = str(marker.get("symbol", "")).endswith("-open")
        panel.plot(
            x, y, ls="", marker=shape, ms=0.75 * _first(marker.get("size"), 6.0), label=label,
            mfc="none" if hollow else colour, zorder=3, clip_on=trace.get("cliponaxis", True),
            **_edge(marker, colour),
        )  # fmt: skip
    if "text" in mode:
        _write(panel, x, y, trace)


def _edge(marker: Layout, colour: Any) -> Layout:
    """The edge of a marker, of its own colour where it has no other."""
    line = marker.get("line", {})
    edge = _colour(line.get("color"))
    return {"mec": colour if edge is None else edge, "mew": 0.75 * _first(line.get("width"), 1.0)}


def _write(panel: Any, x: list[float], y: list[float], trace: Layout) -> None:
    """Texts beside points."""
    texts, places = trace.get("text") or [], trace.get("textposition", "top center")
    listed = places if isinstance(places, list) else [places] * len(texts)
    for at, text, place in zip(zip(x, y), texts, listed):
        if text:
            across = -1 if "left" in place else 1 if "right" in place else 0
            up = -1 if "bottom" in place else 1 if "top" in place else 0
            panel.annotate(
                _unmarked(text), at, xytext=(6 * across, 6 * up), textcoords="offset points",
                ha=_SIDES[across], va=_HEIGHTS[up], fontsize="small",
            )  # fmt: skip


def _fill(trace: Layout) -> Layout:
    colour = _colour(trace.get("fillcolor"))
    return {"facecolor": colour or (0.5, 0.5, 0.5, 0.3), "edgecolor": "none"}


def _first(value: Any, other: float) -> float:
    value = value[0] if isinstance(value, list) and value else value
    return float(value) if isinstance(value, (int, float)) else other


def _colour(value: Any) -> Any:
    """A colour of CSS as Matplotlib takes it; one that stands for values is left to Matplotlib."""
    if not isinstance(value, str):
        return None
    numbers = re.fullmatch(r"rgba?\(([^)]*)\)", value)
    if not numbers:
        return value
    parts = [float(part) for part in numbers.group(1).split(",")]
    return (*(part / 255.0 for part in parts[:3]), *parts[3:])


def _dash(text: str, width: float) -> Any:
    """``"6.7px,3.4px"`` as a line style, whose lengths Matplotlib counts in line widths."""
    if "px" not in text:
        return _DASHES.get(text, "-")
    lengths = [
        0.75 * float(part.strip().removesuffix("px")) / max(width, 0.1) for part in text.split(",")
    ]
    return (0, tuple(lengths))


def _finish(panel: Any, layout: Layout, vertical: Layout) -> None:
    """Names, scales, ranges and the legend of a panel."""
    horizontal = layout.get("xaxis" + str(vertical.get("anchor", "x")).removeprefix("x"), {})
    for axis, side in ((horizontal, "x"), (vertical, "y")):
        getattr(panel, f"set_{side}label")(_unmarked(axis.get("title", {}).get("text", "")))
        logarithmic = axis.get("type") == "log"
        if logarithmic:
            getattr(panel, f"set_{side}scale")("log")
        if "range" in axis:
            ends = [10.0**end if logarithmic else end for end in axis["range"]]
            getattr(panel, f"set_{side}lim")(ends)
    panel.grid(True, color="#e4e4e4")
    panel.set_axisbelow(True)
    if panel.get_legend_handles_labels()[1]:
        panel.legend(fontsize="small")


def _lines(panels: Layout, layout: Layout) -> None:
    """Straight lines from side to side, such as limits."""
    for shape in layout.get("shapes", []):
        panel = panels.get(shape.get("yref", ""))
        if shape.get("type") != "line" or panel is None or shape["y0"] != shape["y1"]:
            continue
        width = 0.75 * _first(shape["line"].get("width"), 1.0)
        colour = _colour(shape["line"].get("color"))
        dash = _dash(shape["line"].get("dash", "solid"), width)
        panel.axhline(shape["y0"], color=colour, lw=width, ls=dash)


def _remarks(panels: Layout, layout: Layout) -> None:
    """Texts at a height of a panel."""
    for remark in layout.get("annotations", []):
        panel = panels.get(remark.get("yref", ""))
        if panel is None or not str(remark.get("xref", "")).endswith("domain"):
            continue
        panel.text(
            remark["x"], remark["y"], _unmarked(remark["text"]), fontsize="small",
            transform=panel.get_yaxis_transform(), color=_colour(remark["font"].get("color")),
            ha=remark.get("xanchor", "center"), va=remark.get("yanchor", "center"),
        )  # fmt: skip


def _second(panels: Layout, layout: Layout, link: Layout) -> None:
    """The same axis in another unit, on the other side."""
    axis = layout.get(link["axis"], {})
    panel = panels.get(axis.get("anchor", ""))
    if panel is None or not link["axis"].startswith("x") or link.get("log"):
        return
    factor, offset = float(link["factor"]), float(link.get("offset", 0.0))
    other = panel.secondary_xaxis(
        "top", functions=(lambda x: factor * x + offset, lambda x: (x - offset) / factor)
    )
    other.set_xlabel(_unmarked(axis.get("title", {}).get("text", "")))


def _unmarked(text: str) -> str:
    """A text of Plotly without its marks; lower and upper letters stay in line."""
    return re.sub(r"<[^>]*>", "", text.replace("<br>", "\n"))
