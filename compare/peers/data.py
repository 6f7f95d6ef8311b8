"""What the scripts read, and how they compare."""

import os
import pathlib
import sys

FOLDER = pathlib.Path(sys.argv[1])


def read(name):
    return (FOLDER / (name + ".bin")).read_bytes()


def spans(name):
    lines = (FOLDER / (name + ".txt")).read_text().splitlines()
    return [tuple(int(word) for word in line.split()) for line in lines]


def compare(reported, truth):
    found = len(set(reported) & set(truth))
    return found, len(set(reported)) - found


def speed(work, tries=3):
    """How many things a second of the processor, that of other programs it starts included: `work` tells how many it
    does. The best of some tries."""

    def now():
        times = os.times()
        return times.user + times.system + times.children_user + times.children_system

    best = 0.0
    for _ in range(tries):
        start = now()
        count = work()
        best = max(best, count / max(now() - start, 1e-6))
    return best
