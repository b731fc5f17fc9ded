"""Lines as all programs get them: nodes with inertias, shafts, gears, excitation."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Size:
    """A shaft by its dimensions (m, Pa, kg/m³); density 0 is a massless shaft."""

    length: float
    outer: float
    inner: float
    shear_modulus: float
    density: float
    elements: int


@dataclass(frozen=True)
class Shaft:
    """A shaft between two nodes, by stiffness and damping or by its dimensions."""

    start: int
    end: int
    stiffness: float = 0.0
    damping: float = 0.0
    size: Size | None = None


@dataclass(frozen=True)
class Gear:
    """Two meshing gears by their pitch radii: the child turns -parent/child times as fast."""

    parent: int
    child: int
    parent_radius: float
    child_radius: float


@dataclass(frozen=True)
class Line:
    """A line of nodes; inertias and what goes to ground as pairs of node and value."""

    nodes: int
    inertia: tuple
    shafts: tuple
    gears: tuple = ()
    ground_stiffness: tuple = ()
    ground_damping: tuple = ()
    modal_damping: float = 0.0


@dataclass(frozen=True)
class Torque:
    """An excitation: cosines of these orders of the speed at one node, amplitudes for each speed."""

    node: int
    orders: tuple
    speeds: tuple
    amplitudes: tuple


def chain(inertia, stiffness, **more):
    """A chain, shaft i from inertia i to inertia i + 1."""
    damping = more.pop("damping", 0.0)
    shafts = tuple(Shaft(i, i + 1, k, damping) for i, k in enumerate(stiffness))
    return Line(len(inertia), tuple(enumerate(inertia)), shafts, **more)
