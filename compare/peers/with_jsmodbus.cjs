// jsmodbus: its telegrams of serial lines and TCP, told that requests and responses take turns.

const fs = require("fs");
const path = require("path");
const packages = require.resolve("jsmodbus/package.json");
const modbus = require(path.join(path.dirname(packages), "dist", "modbus.js"));

const folder = process.argv[2];
const read = (name) => fs.readFileSync(path.join(folder, `${name}.bin`));
const spans = (name) =>
  fs.readFileSync(path.join(folder, `${name}.txt`), "utf8").trim().split("\n").map((line) => line.split(" ").map(Number));

const SIDES = [modbus.ModbusRTURequest, modbus.ModbusRTUResponse];

// Where telegrams are: of the side whose turn it is, or of the other, or else a byte further on.
function split(stream, most = Infinity) {
  const found = [];
  let [at, turn] = [0, 0];
  while (at < stream.length && found.length < most) {
    const rest = stream.subarray(at, at + 260);
    const side = [turn, 1 - turn].find((side) => {
      try {
        const telegram = SIDES[side].fromBuffer(rest);
        if (!telegram || !telegram.body) return false;
        const length = telegram.byteCount;
        if (telegram.crc === undefined || !right(rest.subarray(0, length))) return false;
        found.push([at, length]);
        at += length;
        return true;
      } catch {
        return false;
      }
    });
    if (side === undefined) at += 1;
    else turn = 1 - side;
  }
  return found;
}

// Its own check of what it read is left to whoever uses it.
const crc = require(require.resolve("crc", { paths: [path.dirname(packages)] }));
const right = (bytes) => bytes.length > 3 && crc.crc16modbus(bytes.subarray(0, -2)) === bytes.readUInt16LE(bytes.length - 2);

function odd() {
  const stream = read("odd");
  return spans("odd").filter(([at, length]) =>
    [modbus.ModbusTCPRequest, modbus.ModbusTCPResponse].some((side) => {
      try {
        const telegram = side.fromBuffer(stream.subarray(at, at + length));
        return telegram && telegram.body && telegram.byteCount === length;
      } catch {
        return false;
      }
    })).length;
}

// How many things a second of the processor: `work` tells how many it does. The best of some tries.
function speed(work) {
  const tries = [1, 2, 3].map(() => {
    const start = process.cpuUsage();
    const count = work();
    const { user, system } = process.cpuUsage(start);
    return count / ((user + system) / 1e6);
  });
  return Math.max(...tries);
}

function decoded() {
  const stream = read("noise");
  return spans("noise").filter(([at, length]) =>
    SIDES.some((side) => {
      try {
        const telegram = side.fromBuffer(stream.subarray(at, at + length));
        return telegram && telegram.body && JSON.stringify({ ...telegram, body: { ...telegram.body } });
      } catch {
        return false;
      }
    })).length;
}

const MOST = 20000;
const stream = read("stream");
const truth = new Set(spans("noise").map(String));
const reported = split(read("noise"));
const found = reported.filter((span) => truth.has(String(span))).length;
console.log("version", require(packages).version);
console.log("split", speed(() => split(stream, MOST).length));
console.log("decoded", speed(decoded));
console.log("noise", found, reported.length - found);
console.log("odd", odd());
