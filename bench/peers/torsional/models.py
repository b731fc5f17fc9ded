"""Model files for halfshaft: `python3 models.py` rewrites those of the cases, kept in models/."""

from pathlib import Path

FOLDER = Path(__file__).resolve().parent / "models"


def node(number):
    """Name of a node."""
    return f"inertia {number + 1}"


def item(kind, name, **keys):
    """One table of an array of tables."""
    return "\n".join([f'[[{kind}]]\nname = "{name}"', *(f"{key} = {value}" for key, value in keys.items())]) + "\n"


def quoted(number):
    """A node's name as a TOML string."""
    return f'"{node(number)}"'


def inertias(line):
    """All inertias, with their dampers to ground."""
    damping = dict(line.ground_damping)
    for number, value in line.inertia:
        more = {"damping": repr(damping[number])} if number in damping else {}
        yield item("inertia", node(number), inertia=repr(value), **more)


def shafts(line):
    """All shafts, then the springs to ground."""
    for i, shaft in enumerate(line.shafts, 1):
        keys = {"from": quoted(shaft.start), "to": quoted(shaft.end)}
        if shaft.size:
            size = shaft.size
            keys |= {"length": repr(size.length), "outer_diameter": repr(size.outer)}
            keys |= {"inner_diameter": repr(size.inner)} if size.inner else {}
            keys |= {"shear_modulus": repr(size.shear_modulus)}
            keys |= {"density": repr(size.density), "elements": size.elements} if size.density else {}
        else:
            keys |= {"stiffness": repr(shaft.stiffness)}
        keys |= {"damping": repr(shaft.damping)} if shaft.damping else {}
        yield item("shaft", f"shaft {i}", **keys)
    for number, value in line.ground_stiffness:
        yield item("shaft", f"spring of {node(number)}", **{
            "from": quoted(number), "to": '"ground"', "stiffness": repr(value)})


def gears(line):
    """All gears: speed of the parent over speed of the child."""
    for i, gear in enumerate(line.gears, 1):
        ratio = -gear.child_radius / gear.parent_radius
        yield item("gear", f"gear {i}", input=quoted(gear.parent), output=quoted(gear.child), ratio=repr(ratio))


def excitation(torque, at=0):
    """The torque with the amplitudes of one of its speeds, orders without any left out."""
    parts = [(order, amplitude) for order, amplitude in zip(torque.orders, torque.amplitudes[at]) if amplitude]
    (order, amplitude), *rest = parts
    keys = {"on": quoted(torque.node), "amplitude": repr(amplitude), "order": order}
    if rest:
        keys["harmonics"] = "[ " + ", ".join(f"{{ order = {o}, amplitude = {a!r} }}" for o, a in rest) + " ]"
    return item("torque", "excitation", **keys)


def text(title, line, torque=None, at=0):
    """A line as a model file."""
    head = f'# Written by bench/peers/torsional/models.py.\nformat = 1\nname = "{title}"\n'
    parts = [head, *inertias(line), *gears(line), *shafts(line)]
    if torque:
        parts.append(excitation(torque, at))
    if line.modal_damping:
        parts.append(f"[line]\nmodal_damping = {line.modal_damping!r}\n")
    return "\n".join(parts)


def written(folder, name, *what):
    """Writes a model file and returns it."""
    path = Path(folder) / f"{name}.toml"
    path.write_text(text(*what))
    return path


def main():
    """Rewrites the models of all cases; an excitation that depends on the speed is that at 15 rpm."""
    import cases

    for case in cases.CASES:
        at = cases.RPM.index(15.0) if case is cases.WIND else 0
        title = f"{case.title}, at 15 rpm" if at else case.title
        written(FOLDER, case.key, title, case.line, case.torque, at)


if __name__ == "__main__":
    main()
