"""Random models of all elements go through TOML, Python and back."""

from __future__ import annotations

import pickle
from typing import Any

from hypothesis import HealthCheck, event, given, settings
from hypothesis import strategies as st

import halfshaft
from halfshaft import Driveline, ModelError

Keys = dict[str, Any]


def numbers(low: float, high: float) -> st.SearchStrategy[float]:
    """Numbers with all their bits."""
    return st.floats(low, high, allow_nan=False, allow_infinity=False)


NAMES = st.text(
    st.characters(blacklist_categories=("Cs", "Cc", "Zl", "Zp", "Zs")), min_size=1, max_size=8
).filter(lambda name: name not in ("ground", "line"))


def optional(**keys: st.SearchStrategy[Any]) -> st.SearchStrategy[Keys]:
    """Any of the keys, or none of them."""
    return st.fixed_dictionaries({}, optional=keys)


LOSS = numbers(0, 0.5)
POLYNOMIALS = optional(
    quadratic=numbers(-1e5, 1e5), cubic=numbers(-1e6, 1e6), quintic=numbers(-1e6, 1e6),
    septic=numbers(-1e6, 1e6), loss_factor=LOSS, preload=numbers(-1e3, 1e3),
    friction=numbers(0.1, 50),
)  # fmt: skip
BARS = st.fixed_dictionaries(
    {
        "length": numbers(0.05, 3),
        "outer_diameter": numbers(0.02, 0.2),
        "inner_diameter": numbers(0, 0.019),
        "shear_modulus": numbers(2e10, 1e11),
        "density": numbers(1e3, 9e3),
        "elements": st.integers(1, 12),
    },
    optional={"loss_factor": LOSS},
)


@st.composite
def ascending(draw: st.DrawFn, low: float, high: float, count: int) -> list[float]:
    """Different numbers, the least first."""
    parts = draw(st.lists(numbers(0.1, 1), min_size=count, max_size=count))
    return [low + (high - low) * sum(parts[: at + 1]) / count for at in range(count)]


@st.composite
def tables(draw: st.DrawFn) -> Keys:
    """A measured law."""
    count = draw(st.integers(2, 6))
    twist = draw(ascending(-2, 2, count))
    torque = draw(st.lists(numbers(1, 1e4), min_size=count, max_size=count))
    return {"table": {"twist": twist, "torque": torque}}


@st.composite
def stages(draw: st.DrawFn) -> Keys:
    """Stages of constant stiffness, the last without an end."""
    ends = draw(ascending(0.01, 1, draw(st.integers(1, 3))))
    listed: list[Keys] = [{"until": end, "stiffness": draw(numbers(1, 1e5))} for end in ends]
    return {"stages": [*listed, {"stiffness": draw(numbers(1, 1e5))}]}


@st.composite
def shafts(draw: st.DrawFn) -> Keys:
    """Keys of a shaft under any kind of law."""
    kind = draw(st.sampled_from(["polynomial", "clearance", "bar", "table", "stages"]))
    damping = {"damping": draw(numbers(0, 1e3))}
    if kind == "bar":
        return {**draw(BARS), **damping}
    if kind in ("table", "stages"):
        return {**draw(tables() if kind == "table" else stages()), **damping}
    keys = {"stiffness": draw(numbers(1e-3, 1e9)), **damping, **draw(POLYNOMIALS)}
    return {**keys, "clearance": draw(numbers(0, 0.5))} if kind == "clearance" else keys


@st.composite
def order_tables(draw: st.DrawFn) -> Keys:
    """Harmonics as lists."""
    orders = draw(ascending(0.5, 24, draw(st.integers(1, 5))))
    column = st.lists(numbers(0.01, 1e3), min_size=len(orders), max_size=len(orders))
    return {"order": orders, "amplitude": draw(column), "phase": draw(column)}


TORQUES = st.one_of(
    st.fixed_dictionaries(
        {"amplitude": numbers(0.1, 1e4), "order": numbers(0.5, 9)},
        optional={"phase": numbers(-7, 7), "mean": numbers(-1e3, 1e3)},
    ),
    st.fixed_dictionaries({"orders": order_tables()}),
    st.fixed_dictionaries(
        {
            "pulse": st.fixed_dictionaries(
                {"shape": st.sampled_from(["half-sine", "rectangle"]), "peak": numbers(1, 1e4),
                 "start": numbers(0, 1), "duration": numbers(0.01, 1)}
            )
        }
    ),
)  # fmt: skip


@st.composite
def engines(draw: st.DrawFn) -> Keys:
    """A four-stroke engine by its crank gear and gas pressure."""
    count = draw(st.integers(4, 8))
    degrees = [f"{720 * k / count} deg" for k in range(count)]
    pressures = draw(st.lists(numbers(0, 6e6), min_size=count, max_size=count))
    stroke = draw(numbers(0.05, 0.12))
    return {
        "firing_order": draw(st.permutations([1, 2, 3, 4])),
        "bore": draw(numbers(0.05, 0.12)),
        "stroke": stroke,
        "rod_length": stroke * draw(numbers(1, 3)),
        "oscillating_mass": draw(numbers(0, 2)),
        "pressure": {"angle": degrees, "pressure": pressures},
        "highest_order": draw(st.sampled_from([2, 4.5, 12])),
    }


@st.composite
def lines(draw: st.DrawFn) -> Driveline:
    """Chains of inertias with all kinds of elements, under any names."""
    count = draw(st.integers(2, 5))
    names = draw(st.lists(NAMES, min_size=2 * count + 3, max_size=2 * count + 3, unique=True))
    nodes, links, (torque, damper, engine) = names[:count], names[count:-3], names[-3:]
    made = Driveline(draw(NAMES))
    for name in nodes:
        made = made.inertia(name, draw(numbers(1e-6, 1e6)), **draw(optional(damping=numbers(0, 9))))
    for place in range(count - 1):
        made = made.shaft(links[place], nodes[place], nodes[place + 1], **draw(shafts()))
    made = made.torque(torque, nodes[0], **draw(TORQUES))
    if draw(st.booleans()):
        keys = draw(optional(stiffness=numbers(0, 1e6), loss_factor=LOSS))
        ring = {"inertia": draw(numbers(1e-5, 10)), "damping": draw(numbers(0.1, 1e3)), **keys}
        made = made.damper(damper, nodes[-1], **ring)
    if draw(st.booleans()):
        made = made.engine(engine, on=[nodes[0]], **draw(engines()))
    if draw(st.booleans()):
        made = made.whole(loss_factor=draw(LOSS), operating=tuple(draw(ascending(1, 600, 2))))
    return made


def key(made: Driveline) -> tuple[str, float]:
    """The address of a number of the line with its value."""
    inertia = made.to_dict()["inertia"][0]
    return f"{inertia['name']}.inertia", inertia["inertia"]


@given(lines())
@settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.too_slow])
def test_random_models_go_through_toml_python_and_back(made: Driveline) -> None:
    # Source: an invariant: no number and no name changes on the way.
    try:
        digest = made.digest
    except ModelError as error:
        # Names that no file may hold are refused by a sentence about the name.
        told = [item.message for item in error.diagnostics if item.severity == "error"]
        assert told and all("name" in message for message in told), error
        event("a name is refused")
        return
    event(" ".join(sorted(made.to_dict())))
    assert halfshaft.loads(made.to_toml()).digest == digest
    assert halfshaft.from_dict(made.to_dict()).digest == digest
    assert pickle.loads(pickle.dumps(made)).digest == digest
    # The numbers of the text are those of Python, to the last bit.
    assert halfshaft.loads(made.to_toml()).to_dict() == made.to_dict()
    address, value = key(made)
    assert made.with_({address: value}).digest == digest
    other = made.with_({address: 2 * value})
    assert other.digest != digest
    assert halfshaft.loads(other.to_toml()) == other
    assert other.with_({address: value}) == made
    made.check()
