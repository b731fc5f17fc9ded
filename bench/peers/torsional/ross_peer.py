"""ross: the torsional part of its rotors of six degrees of freedom a node.

    ross_peer.py TASK.json ANSWER.json

Bending and axial motion are left out by its own `convert_6dof_to_torsional`; a shaft of given stiffness
is a massless one of fitting diameter. Gears are meshes of finite stiffness between rotors.
"""

import math

import numpy as np
import ross
from ross.utils import convert_6dof_to_torsional

import tasks
from tasks import Cannot

SHEAR = 80e9
# Meshes and the joint that makes two nodes of one, against the stiffest shaft: still softer ones are wrong
# in the sixth digit, still stiffer ones let rigid-body modes vibrate.
RIGID = 1e7


def by_stiffness(stiffness, damping=0.0):
    """A massless element of this stiffness, 1 m long; its damping is a share of its stiffness."""
    massless = ross.Material(name="Massless", rho=0.0, G_s=SHEAR, E=200e9)
    diameter = (32.0 * stiffness / (math.pi * SHEAR)) ** 0.25
    return [ross.ShaftElement(L=1.0, idl=0.0, odl=diameter, material=massless, beta=damping / stiffness)]


def by_size(size):
    """The elements of a shaft by its dimensions."""
    material = ross.Material(name="Shaft", rho=size["density"], G_s=size["shear_modulus"],
                             E=2.6 * size["shear_modulus"])
    length = size["length"] / size["elements"]
    return [ross.ShaftElement(L=length, idl=size["inner"], odl=size["outer"], material=material)
            for _ in range(size["elements"])]


def elements(shaft):
    """The elements of a shaft."""
    return by_size(shaft["size"]) if shaft["size"] else by_stiffness(shaft["stiffness"], shaft["damping"])


class Part:
    """A rotor of the line: nodes one after the other, from gear to gear."""

    def __init__(self, start):
        self.elements, self.place = [], {start: 0}

    def extend(self, shaft):
        """One more shaft at the end."""
        self.elements += elements(shaft)
        self.place[shaft["end"]] = len(self.elements)

    def rotor(self, inertia, radius, joint):
        """The rotor, with gears where radii are given; a single node is split in two halves."""
        discs, alone = [], not self.elements
        for node, at in self.place.items():
            value = inertia.get(node, 0.0) / (2.0 if alone else 1.0)
            if not value:
                raise Cannot("a node without inertia: its mass matrix must be regular")
            dimensions = {"n": at, "m": 1.0, "Id": 1.0, "Ip": value}
            discs.append(gear(radius[node], dimensions) if node in radius else ross.DiskElement(**dimensions))
        if alone:
            discs.append(ross.DiskElement(n=1, m=1.0, Id=1.0, Ip=value))
        return ross.Rotor(self.elements or by_stiffness(joint), discs)


def gear(radius, dimensions):
    """A gear; teeth by the radius, so that all mesh."""
    return ross.GearElement(n_teeth=round(1000 * radius), pitch_diameter=2.0 * radius,
                            pr_angle=math.radians(20.0), **dimensions)


def parts(line):
    """The rotors between gears, by the nodes in them."""
    found = {}
    for shaft in line["shafts"]:
        part = found.setdefault(shaft["start"], Part(shaft["start"]))
        part.extend(shaft)
        found[shaft["end"]] = part
    for node, _ in line["inertia"]:
        found.setdefault(node, Part(node))
    return found


def stiffest(line):
    """Stiffness of the stiffest shaft."""
    return max(element.K()[5, 5] for shaft in line["shafts"] for element in elements(shaft))


def whole(line):
    """The line as one rotor, or as rotors coupled by gears, torsion only."""
    if line["ground_stiffness"]:
        raise Cannot("no torsional spring to ground")
    inertia, radius = dict(map(tuple, line["inertia"])), {}
    for one in line["gears"]:
        radius |= {one["parent"]: one["parent_radius"], one["child"]: one["child_radius"]}
    of, first = parts(line), line["gears"][0]["parent"] if line["gears"] else line["shafts"][0]["start"]
    rigid = RIGID * stiffest(line) if line["gears"] else None
    rotor, place = of[first].rotor(inertia, radius, rigid), dict(of[first].place)
    for one in line["gears"]:
        part, offset = of[one["child"]], len(rotor.nodes)
        rotor = ross.MultiRotor(rotor, part.rotor(inertia, radius, rigid),
                                coupled_nodes=(place[one["parent"]], part.place[one["child"]]),
                                gear_mesh_stiffness=rigid / one["parent_radius"]**2)
        place |= {node: offset + at for node, at in part.place.items()}
    return convert_6dof_to_torsional(rotor)


def eigenvalues(rotor):
    """All eigenvalues above the real axis; rigid-body modes are left out by ross."""
    values = rotor.run_modal(speed=0.0, num_modes=2 * rotor.ndof, sparse=False).evalues
    return sorted((value for value in values if value.imag > 0.0), key=abs)


def torques(rotor, line, torque, few=None):
    """Elastic shaft torques by angles and stiffnesses, which ross does not give: one call for each speed."""
    both = list(zip(torque["speeds"], torque["amplitudes"]))
    chosen = both if few is None else [both[i] for i in np.linspace(0, len(both) - 1, few).astype(int)]
    stiffness = np.array([shaft["stiffness"] for shaft in line["shafts"]])[:, None]
    found = []
    for speed, amplitudes in chosen:
        force = np.zeros((rotor.ndof, len(amplitudes)), complex)
        force[torque["node"]] = amplitudes
        response = rotor.run_forced_response(force=force, speed_range=speed * np.array(torque["orders"]))
        found.append(-stiffness * np.diff(response.forced_resp, axis=0))
    return np.array(found)


def answer(case, quantity):
    """One quantity of one case."""
    line = case["line"]
    if quantity != "frequencies" and line["modal_damping"]:
        raise Cannot("no modal damping")
    if quantity != "frequencies" and line["ground_damping"]:
        raise Cannot("no torsional damper to ground")
    rotor = whole(line)
    if quantity == "torques":
        return np.abs(torques(rotor, line, case["torque"])).tolist()
    values = eigenvalues(rotor)
    if quantity == "eigenvalues":
        return [(value.real, value.imag) for value in values]
    return [abs(value) / (2.0 * math.pi) for value in values]


def modes(task):
    """Seconds of assembling and of the modes, warm."""
    rotor = whole(task["line"])
    return {"seconds": tasks.timed({
        "assembling": lambda: whole(task["line"]),
        "run_modal": lambda: rotor.run_modal(speed=0.0, num_modes=2 * rotor.ndof, sparse=False),
        "run_modal, six modes": lambda: rotor.run_modal(speed=0.0)}, task["repeats"])}


def forced(task):
    """Seconds for a few speeds, warm."""
    rotor = whole(task["line"])
    return {"seconds": tasks.timed({
        "run_forced_response": lambda: torques(rotor, task["line"], task["torque"], task["few"])},
        task["repeats"])}


def modes_once(task):
    """Frequencies and shapes, kept as NumPy writes them."""
    rotor = whole(task["line"])
    found = rotor.run_modal(speed=0.0, num_modes=2 * rotor.ndof, sparse=False)
    frequencies = np.sort(np.abs(found.evalues[found.evalues.imag > 0.0]))
    np.savez(task["out"], frequencies=frequencies, shapes=found.evectors)
    return {}


def forced_once(task):
    """Torques at all speeds, kept as NumPy writes them."""
    found = torques(whole(task["line"]), task["line"], task["torque"])
    np.savez(task["out"], torques=np.abs(found))
    return {}


tasks.run({"agreement": lambda task: tasks.agreement(task["cases"], answer), "modes": modes,
           "forced": forced, "modes once": modes_once, "forced once": forced_once})
