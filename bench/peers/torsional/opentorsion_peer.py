"""openTorsion: agreement with the cases, analyses by themselves, analyses once in a whole process.

    opentorsion_peer.py TASK.json ANSWER.json
"""

import math

import numpy as np
import opentorsion as ot

import tasks


def numbers(line):
    """New numbers of the nodes, with room for those inside shafts: shaft torques are found only where
    each element starts at a lower number than it ends and none at the last."""
    found, free = {}, 0
    for node in range(line["nodes"]):
        found[node] = free
        inside = (shaft["size"]["elements"] - 1 for shaft in line["shafts"]
                  if shaft["start"] == node and shaft["size"])
        free += 1 + sum(inside)
    return found


def elements(line, number):
    """Shaft elements, of shafts by dimensions as many as asked for."""
    for shaft in line["shafts"]:
        start, end, size = number[shaft["start"]], number[shaft["end"]], shaft["size"]
        if not size:
            yield ot.Shaft(start, end, k=shaft["stiffness"], c=shaft["damping"])
            continue
        count = size["elements"]
        stops = [*range(start, start + count), end]
        for left, right in zip(stops, stops[1:]):
            # Lengths in millimetres.
            yield ot.Shaft(left, right, L=1e3 * size["length"] / count, odl=1e3 * size["outer"],
                           idl=1e3 * size["inner"], G=size["shear_modulus"], rho=size["density"])


def assembly(line):
    """The line; what goes to ground is part of the discs, gears are without inertia of their own."""
    stiffness, damping = (dict(map(tuple, line[key])) for key in ("ground_stiffness", "ground_damping"))
    number = numbers(line)
    discs = [ot.Disk(number[node], value, c=damping.get(node, 0.0), k=stiffness.get(node, 0.0))
             for node, value in line["inertia"]]
    gears = {}
    for gear in line["gears"]:
        parent, child = number[gear["parent"]], number[gear["child"]]
        above = gears.setdefault(parent, ot.Gear(parent, 0.0, gear["parent_radius"]))
        gears[child] = ot.Gear(child, 0.0, gear["child_radius"], parent=above)
    return ot.Assembly(list(elements(line, number)), disk_elements=discs,
                       gear_elements=list(gears.values()) or None)


def damping(system, line):
    """The damping matrix: of the elements, or of the modes."""
    ratio = line["modal_damping"]
    return system.C_modal(system.M, system.K, xi=ratio) if ratio else None


def torques(system, torque, speeds, matrix):
    """Complex shaft torques over speed, shaft and order: one call for each speed, as its example does."""
    found = []
    for speed, amplitudes in speeds:
        omegas = speed * np.array(torque["orders"])
        excitation = ot.PeriodicExcitation(system.M.shape[0], omegas)
        excitation.add_sines(torque["node"], omegas, amplitudes, np.zeros(len(omegas)))
        found.append(system.vibratory_torque(excitation, C=matrix)[0])
    return np.array(found)


def at_once(system, torque, speeds, matrix):
    """The same by one call for all speeds and orders, torques by the matrix of the assembly."""
    omegas = np.ravel([speed * np.array(torque["orders"]) for speed, _ in speeds])
    loads = np.zeros((system.M.shape[0], len(omegas)), complex)
    loads[torque["node"]] = np.ravel([amplitudes for _, amplitudes in speeds])
    return system.S @ system.ss_response(loads, omegas, C=matrix)[0]


def with_amplitudes(torque, few=None):
    """Speeds with their amplitudes, a number of them evenly chosen."""
    both = list(zip(torque["speeds"], torque["amplitudes"]))
    return both if few is None else [both[i] for i in np.linspace(0, len(both) - 1, few).astype(int)]


def answer(case, quantity):
    """One quantity of one case."""
    line, torque = case["line"], case["torque"]
    system = assembly(line)
    if quantity == "frequencies":
        values, _ = system.undamped_modal_analysis()
        return sorted(np.sqrt(np.abs(values)) / (2.0 * math.pi))
    matrix = damping(system, line)
    if quantity == "eigenvalues":
        natural, damped, ratio = system.modal_analysis(C=matrix)
        return list(zip(-ratio * natural, damped))
    return np.abs(torques(system, torque, with_amplitudes(torque), matrix)).tolist()


def modes(task):
    """Seconds of assembling and of each function that gives frequencies, warm."""
    system = assembly(task["line"])
    return {"seconds": tasks.timed({
        "assembling": lambda: assembly(task["line"]),
        "undamped_modal_analysis": system.undamped_modal_analysis,
        "modal_analysis": system.modal_analysis,
        "eigenmodes": system.eigenmodes}, task["repeats"])}


def forced(task):
    """Seconds for a few speeds, warm."""
    system, torque = assembly(task["line"]), task["torque"]
    matrix, few = damping(system, task["line"]), with_amplitudes(torque, task["few"])
    return {"seconds": tasks.timed({
        "vibratory_torque": lambda: torques(system, torque, few, matrix),
        "ss_response": lambda: at_once(system, torque, few, matrix)}, task["repeats"])}


def modes_once(task):
    """Frequencies and shapes, kept as NumPy writes them."""
    system = assembly(task["line"])
    names = {"undamped": system.undamped_modal_analysis, "damped": system.eigenmodes}
    values, shapes = names[task["way"]]()
    frequencies = np.sqrt(np.abs(values)) if task["way"] == "undamped" else np.abs(values)
    np.savez(task["out"], frequencies=np.sort(frequencies), shapes=shapes)
    return {}


def forced_once(task):
    """Torques at all speeds, kept as NumPy writes them."""
    system = assembly(task["line"])
    matrix = damping(system, task["line"])
    found = torques(system, task["torque"], with_amplitudes(task["torque"]), matrix)
    np.savez(task["out"], torques=np.abs(found))
    return {}


tasks.run({"agreement": lambda task: tasks.agreement(task["cases"], answer), "modes": modes,
           "forced": forced, "modes once": modes_once, "forced once": forced_once})
