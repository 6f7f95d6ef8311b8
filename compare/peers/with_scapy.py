"""scapy: its layers for Modbus TCP, shown one telegram at a time."""

import json
import logging

import data
import scapy
from scapy.contrib.modbus import ModbusADURequest, ModbusADUResponse
from scapy.packet import Raw

logging.disable(logging.CRITICAL)


def decode(telegram):
    """All fields of a telegram as JSON, of the layer that leaves nothing over."""
    for layer in (ModbusADURequest, ModbusADUResponse):
        try:
            packet = layer(telegram)
        except Exception:  # What it cannot read it may say in any way.
            continue
        if packet.payload and not packet.haslayer(Raw) and bytes(packet) == telegram:
            return json.dumps([(part.name, part.fields) for part in packet.iterpayloads()], default=str)
    return None


stream, spans = data.read("odd"), data.spans("odd")
telegrams = [stream[at : at + length] for at, length in spans]
print("version", scapy.__version__)
print("decoded", data.speed(lambda: len([decode(telegram) for telegram in telegrams])))
print("odd", sum(decode(telegram) is not None for telegram in telegrams))
