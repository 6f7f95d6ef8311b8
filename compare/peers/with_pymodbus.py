"""pymodbus: its framers for serial lines and TCP, told that requests and responses take turns."""

import logging

import data
import pymodbus
from pymodbus.framer import FramerRTU, FramerSocket
from pymodbus.pdu import DecodePDU

logging.disable(logging.CRITICAL)


def split(stream, most=None):
    """Where telegrams are: of the side whose turn it is, or of the other, or else a byte further on."""
    framers = [FramerRTU(DecodePDU(True)), FramerRTU(DecodePDU(False))]
    found, at, turn = [], 0, 0
    while at < len(stream) and (most is None or len(found) < most):
        rest = stream[at : at + 260]
        for side in (turn, 1 - turn):
            try:
                used, _, _, pdu = framers[side].decode(rest)
                pdu = framers[side].decoder.decode(pdu) if used and pdu else None
            except Exception:  # What it cannot read it may say in any way.
                pdu = None
            if pdu:
                length = len(pdu.encode()) + 4 if used > 260 else used
                found.append((at, length))
                at, turn = at + length, 1 - side
                break
        else:
            at += 1
    return found


def odd():
    stream, told = data.read("odd"), 0
    framers = [FramerSocket(DecodePDU(True)), FramerSocket(DecodePDU(False))]
    for at, length in data.spans("odd"):
        for framer in framers:
            try:
                used, pdu = framer.handleFrame(stream[at : at + length], 0, 0)
            except Exception:
                continue
            if pdu and used == length:
                told += 1
                break
    return told


MOST = 20_000
print("version", pymodbus.__version__)
stream = data.read("stream")
speed = data.speed(lambda: len(split(stream, MOST)))
print("split", speed)
# It makes an object with all fields of what it splits.
print("decoded", speed)
print("noise", *data.compare(split(data.read("noise")), data.spans("noise")))
print("odd", odd())
