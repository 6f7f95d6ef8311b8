"""tshark: a capture of the telegrams, written as JSON."""

import shutil
import struct
import subprocess

import data

if not shutil.which("tshark"):
    raise SystemExit("tshark is not installed")

stream, spans = data.read("odd"), data.spans("odd")
packets = []
sequence = 1
for at, length in spans:
    payload = stream[at : at + length]
    tcp = struct.pack(">HHIIBBHHH", 49152, 502, sequence, 1, 0x50, 0x18, 512, 0, 0)
    sequence += length
    ip = struct.pack(">BBHHHBBH4s4s", 0x45, 0, 40 + length, 0, 0, 64, 6, 0, bytes([192, 0, 2, 1]), bytes([192, 0, 2, 2]))
    packet = ip + tcp + payload
    packets.append(struct.pack("<IIII", 0, 0, len(packet), len(packet)) + packet)
path = data.FOLDER / "odd.pcap"
path.write_bytes(struct.pack("<IHHiIII", 0xA1B2C3D4, 2, 4, 0, 0, 65535, 101) + b"".join(packets))


def run(*arguments):
    return subprocess.run(["tshark", "-r", str(path), *arguments], capture_output=True, check=True).stdout


def decode():
    run("-T", "json")
    return len(spans)


print("version", subprocess.run(["tshark", "--version"], capture_output=True, text=True).stdout.split()[2])
print("decoded", data.speed(decode))
told = run("-T", "fields", "-e", "modbus.func_code").decode().splitlines()
print("odd", sum(bool(line.strip()) for line in told))
