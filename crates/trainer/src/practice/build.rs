//! Which telegram does this?

use buslens::field::hex_value;

use super::make::{
    F5, F5_PROFIBUS, MEMOGRAPH, all_fields, asked, field, quarters, request, short, small, unit, word, write,
};
use super::{Slot, Slots};
use crate::random::Random;
use crate::task::{Expected, Task, Telegram};

pub const SLOTS: Slots = [LEVEL_1, LEVEL_2, LEVEL_3];

const LEVEL_1: [Slot; 5] = [
    |random| from_on(random, 3),
    |random| from_on(random, 4),
    |random| {
        let (unit, from, value) = (unit(random), address(random), word(random));
        task(
            format!(
                "Write {value} into the holding register at address {from} of unit {unit}, with the function for a single register."
            ),
            short(unit, 6, from, value),
        )
    },
    |random| {
        let (unit, from, count) = (unit(random), address(random), random.between(2, 9) as u16);
        let last = from + count - 1;
        task(
            format!("Ask unit {unit} for the holding registers at the addresses {from} to {last}."),
            short(unit, 3, from, count),
        )
    },
    |random| {
        let (unit, coil) = (unit(random), address(random));
        let on = random.below(2) == 1;
        let state = if on { "on" } else { "off" };
        task(
            format!("Switch the coil at address {coil} of unit {unit} {state}."),
            short(unit, 5, coil, if on { 0xFF00 } else { 0 }),
        )
    },
];

const LEVEL_2: [Slot; 5] = [
    |random| references(random, 3),
    |random| references(random, 4),
    |random| {
        let (unit, from) = (unit(random), address(random));
        let (one, other) = (word(random), word(random));
        task(
            format!(
                "Write {one} and {other} into the registers at the addresses {from} and {} of unit {unit}, in one telegram.",
                from + 1
            ),
            write(unit, from, &[one.to_be_bytes(), other.to_be_bytes()].concat()),
        )
    },
    |random| {
        let unit = unit(random);
        let (id, label) = random.one_of(&[
            ("Sy.51", "read Status word (Sy.51)"),
            ("Sy.53", "read Actual speed (Sy.53)"),
            ("Sy.52", "read Set speed (Sy.52)"),
            ("Sy.50", "read Control word (Sy.50)"),
        ]);
        let request = asked(F5, unit, "modbus-rtu", label, &[]);
        let register = u16::from_be_bytes([request.bytes[2], request.bytes[3]]);
        let name = label.trim_start_matches("read ").trim_end_matches(&format!(" ({id})")).to_owned();
        task(
            format!(
                "Ask the KEB F5 with address {unit} for its {} ({id}). Its parameter address is {}; the manual adds 2000h to that.",
                small(&name),
                hex_value(u64::from(register - 0x2000), 2)
            ),
            request,
        )
    },
    |random| {
        let unit = unit(random);
        let channel = random.between(20, 40);
        let entries = [("number", channel.to_string())];
        let request = asked(MEMOGRAPH, unit, "modbus-rtu", "read Universal channel at 200 to 319", &entries);
        task(
            format!(
                "Ask the Memograph with address {unit} for universal channel {channel}, status and float. Channel 1 begins at register 200; each has 3 registers, counted from 0."
            ),
            request,
        )
    },
];

const LEVEL_3: [Slot; 5] = [
    |random| {
        let (unit, channel, value) = (unit(random), random.between(20, 40), quarters(random));
        let entries = [
            ("number", channel.to_string()),
            ("content.status", "good".to_owned()),
            ("content.value", value.to_string()),
        ];
        let request = asked(MEMOGRAPH, unit, "modbus-rtu", "write Universal channel at 200 to 319", &entries);
        task(
            format!(
                "Write {value}, good, to universal channel {channel} of the Memograph with address {unit}. Channel 1 begins at register 200; each has 3 registers: status (0080h is good), then the float."
            ),
            request,
        )
    },
    |random| {
        let (unit, from, value) = (unit(random), address(random), quarters(random));
        task(
            format!(
                "Write the float {value} into the registers at {from} and {} of unit {unit}, the high word first.",
                from + 1
            ),
            write(unit, from, &value.to_be_bytes()),
        )
    },
    |random| {
        let speed = -(random.between(130, 2900) as i32);
        let entries = [("subindex", "1".to_owned()), ("content.set_speed", speed.to_string())];
        task(
            format!(
                "Write the set speed −{} with the parameter channel of a KEB F5 on PROFIBUS: index 2034h, set 0 (subindex 01h), 2 bytes of value. It is the first job: the handshake is 1. Eight bytes, no frame.",
                -speed
            ),
            asked(F5_PROFIBUS, 1, "profibus-parameter-channel", "write Set speed (Sy.52)", &entries),
        )
    },
    |random| {
        let (unit, n) = (unit(random), random.between(1, 60));
        let (address, name) = random.one_of(&[
            (0x0033_u16, "status word"),
            (0x0035, "actual speed"),
            (0x0034, "set speed"),
            (0x0032, "control word"),
        ]);
        let place = 0x5F32 + n as u16;
        let [high, low] = address.to_be_bytes();
        let body = [&[unit, 0x65], &place.to_be_bytes()[..], &[0, 1, 4, high, low, 1, 1]].concat();
        let request = super::make::of_device(request(&body), F5);
        task(
            format!(
                "Put the {name} ({address:04X}h), set 0, one word, into entry {n} of the mapping list for reading of the KEB F5 with address {unit}. Entry 0 is register 5F32h; an entry has 32 bits: function 101."
            ),
            request,
        )
    },
    |random| {
        let (unit, speed) = (unit(random), -(random.between(130, 2900) as i32));
        let entries = [("content.set_speed", speed.to_string())];
        task(
            format!(
                "Write the set speed (Sy.52) of the KEB F5 with address {unit}: −{}. It is register 2034h; use the function for several registers.",
                -speed
            ),
            asked(F5, unit, "modbus-rtu", "write Set speed (Sy.52)", &entries),
        )
    },
];

/// The registers that a function reads, and the digit of their references.
const fn registers(function: u8) -> (&'static str, u8) {
    if function == 4 { ("input", 3) } else { ("holding", 4) }
}

/// So many registers from an address on.
fn from_on(random: &mut Random, function: u8) -> Task {
    let (unit, from, count) = (unit(random), address(random), random.between(2, 9) as u16);
    let (kind, _) = registers(function);
    task(
        format!("Ask unit {unit} for {count} {kind} registers, from address {from} on."),
        short(unit, function, from, count),
    )
}

/// Registers by their references.
fn references(random: &mut Random, function: u8) -> Task {
    let (unit, from, count) = (unit(random), address(random), random.between(10, 40) as u16);
    let (first, last) = (from + 1, from + count);
    let (kind, digit) = registers(function);
    task(
        format!(
            "Ask unit {unit} for the {kind} registers {digit}{first:04} to {digit}{last:04}. These are references: they count from 1."
        ),
        short(unit, function, from, count),
    )
}

fn address(random: &mut Random) -> u16 {
    u16::from_be_bytes([random.between(1, 4) as u8, random.between(16, 190) as u8])
}

/// A telegram that is to be built, with what there is to say of every field.
fn task(question: String, telegram: Telegram) -> Task {
    let function = telegram.bytes.get(1).copied().unwrap_or_default();
    let channel = telegram.protocol.key == "profibus-parameter-channel";
    let rule = match function {
        _ if channel => "One byte says the job, one the subindex, two the index, and four the value, which begins at the first of them.".to_owned(),
        3 => "Holding registers are read by function 3: unit, function, address, quantity.".to_owned(),
        4 => "Input registers are read by function 4: unit, function, address, quantity.".to_owned(),
        5 => "A single coil is written by function 5: FF 00 is on, 00 00 is off.".to_owned(),
        6 => "A single register is written by function 6: unit, function, address, value.".to_owned(),
        16 => "Several registers are written by function 16 (10h): unit, function, address, quantity, byte count, values.".to_owned(),
        101 => "32-bit registers are written by function 101 (65h): unit, function, address, quantity, byte count, values.".to_owned(),
        _ => String::new(),
    };
    let place = if channel {
        "Eight bytes: job, subindex, index, value."
    } else {
        "Begin with who is asked, then what is to be done; then where, and how many. The CRC may be left out."
    };
    let key = if channel { "index" } else { "start" };
    let start = field(&telegram, key, false).or_else(|| {
        telegram.fields(false).into_iter().find(|field| field.spec.role == buslens::field::Role::Address)
    });
    let last = start.map_or(String::new(), |field| {
        let bytes = buslens::field::hex(field.span.of(&telegram.bytes));
        format!(
            "It begins {}; the {} is {bytes}.",
            buslens::field::hex(&telegram.bytes[..2]),
            small(&field.label().to_string())
        )
    });
    Task {
        question,
        hints: vec![place.to_owned(), rule, last],
        working: all_fields(&telegram),
        given: Vec::new(),
        expected: Expected::Telegram(telegram),
    }
}
