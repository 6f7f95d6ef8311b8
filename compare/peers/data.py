"""What the scripts read, and how they compare."""

import pathlib
import sys
import time

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
    """How many things a second: `work` tells how many it does. The best of some tries."""
    best = 0.0
    for _ in range(tries):
        start = time.perf_counter()
        count = work()
        best = max(best, count / (time.perf_counter() - start))
    return best
