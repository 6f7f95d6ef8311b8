"""pymodbus: its framers take one telegram at a time, so that they are shown where each begins and who sends it."""

import json
import logging

import data
import pymodbus
from pymodbus.framer import FramerRTU, FramerSocket
from pymodbus.pdu import DecodePDU

logging.disable(logging.CRITICAL)


def told(framers, telegrams):
    """How many of the telegrams become JSON with all fields, as those of one side or of the other."""
    count = 0
    for telegram in telegrams:
        for framer in framers:
            try:
                used, pdu = framer.handleFrame(telegram, 0, 0)
            except Exception:  # What it cannot read it may say in any way.
                continue
            if pdu and used == len(telegram):
                json.dumps(vars(pdu), default=str)
                count += 1
                break
    return count


def sides(framer):
    return [framer(DecodePDU(True)), framer(DecodePDU(False))]


def telegrams(name):
    stream = data.read(name)
    return [stream[at : at + length] for at, length in data.spans(name)]


intact = telegrams("noise")
print("version", pymodbus.__version__)
print("decoded", data.speed(lambda: told(sides(FramerRTU), intact)))
print("odd", told(sides(FramerSocket), telegrams("odd")))
