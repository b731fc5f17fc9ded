"""What the peers' scripts share: a task read from a file, analyses by themselves or once, the answer written.

    SCRIPT TASK.json ANSWER.json
"""

import json
import sys
import time


class Cannot(Exception):
    """What a program does not offer, in a few words."""


def agreement(cases, answer):
    """Answers to all cases, or for each quantity why not."""
    found = {}
    for case in cases:
        found[case["key"]] = said = {"cannot": {}}
        for quantity in ("frequencies", "eigenvalues", "torques"):
            if quantity == "eigenvalues" and not case["eigenvalues"]:
                continue
            if quantity == "torques" and not case["torque"]:
                continue
            try:
                said[quantity] = answer(case, quantity)
            except Cannot as reason:
                said["cannot"][quantity] = str(reason)
    return found


def timed(ways, repeats):
    """Processor seconds of each way, by turns, after one turn that is not counted.

    Of the one thread: where the processor time of a process is limited, its clock goes by ticks of 4 ms.
    """
    seconds = {name: [] for name in ways}
    for turn in range(repeats + 1):
        for name, way in ways.items():
            before = time.thread_time()
            way()
            if turn:
                seconds[name].append(time.thread_time() - before)
    return seconds


def run(answers):
    """Reads the task, does what it names, writes the answer."""
    with open(sys.argv[1]) as file:
        task = json.load(file)
    said = answers[task["do"]](task)
    with open(sys.argv[2], "w") as file:
        json.dump(said, file)
