//! Which byte is wrong?

use buslens::field::{Direction, Role, Span, hex};

use super::make::{
    F5_PROFIBUS, MEMOGRAPH, asked, bytes_said, confirmed, of_device, protocol, quarters, rtu, short, small,
    unit, values, word, write,
};
use super::{Slot, Slots};
use crate::random::Random;
use crate::task::{Expected, Given, Task, Telegram};

pub const SLOTS: Slots = [LEVEL_1, LEVEL_2, LEVEL_3];

const LEVEL_1: [Slot; 5] = [
    |random| {
        let right = read(random);
        let other = other(random, right.bytes[0]);
        spoiled(right, 0, other, &[])
    },
    |random| {
        let right = read(random);
        let other = if right.bytes[1] == 3 { 4 } else { 3 };
        spoiled(right, 1, other, &[])
    },
    |random| {
        let right = read(random);
        let other = near(random, right.bytes[3]);
        spoiled(right, 3, other, &[])
    },
    |random| {
        let right = read(random);
        let other = near(random, right.bytes[5]);
        spoiled(right, 5, other, &[])
    },
    |random| {
        let right = read(random);
        let other = near(random, right.bytes[2]);
        spoiled(right, 2, other, &[])
    },
];

const LEVEL_2: [Slot; 5] = [
    |random| {
        let (request, right) = answered(random);
        let other = right.bytes[2] / 2;
        spoiled(right, 2, other, &[request])
    },
    |random| {
        let (request, right) = answered(random);
        let other = other(random, right.bytes[0]);
        spoiled(right, 0, other, &[request])
    },
    |random| {
        let (request, right) = answered(random);
        let other = if right.bytes[1] == 3 { 4 } else { 3 };
        spoiled(right, 1, other, &[request])
    },
    |random| {
        let request = two_registers(random);
        let right = confirmed(&request);
        let other = near(random, right.bytes[3]);
        spoiled(right, 3, other, &[request])
    },
    |random| {
        let request = two_registers(random);
        let right = confirmed(&request);
        spoiled(right, 5, 4, &[request])
    },
];

const LEVEL_3: [Slot; 5] = [
    |random| {
        let right = channel(random);
        spoiled(right, 8, 0x40, &[])
    },
    |random| {
        let right = channel(random);
        // Twice or half as much.
        let other = right.bytes[10] ^ 0x80;
        spoiled(right, 10, other, &[])
    },
    |random| {
        let request = of_device(short(unit(random), 3, 200 + 3 * random.below(40) as u16, 3), MEMOGRAPH);
        let value = quarters(random).to_be_bytes();
        let right = values(&request, &[&[0, 0x80], &value[..]].concat());
        let other = right.bytes[2] / 2;
        spoiled(right, 2, other, &[request])
    },
    |random| {
        let entries =
            [("subindex", "1".to_owned()), ("content.set_speed", random.between(300, 2900).to_string())];
        let right = asked(F5_PROFIBUS, 1, "profibus-parameter-channel", "write Set speed (Sy.52)", &entries);
        let other = near(random, right.bytes[3]);
        spoiled(right, 3, other, &[])
    },
    |random| {
        let (from, to) = (random.between(1, 9) as u8, random.between(10, 60) as u8);
        let data = word(random).to_be_bytes();
        let body = [&[to, from, 0x7D][..], &data, &word(random).to_be_bytes()].concat();
        let sum = body.iter().fold(0_u8, |sum, byte| sum.wrapping_add(*byte));
        let length = body.len() as u8;
        let bytes = [&[0x68, length, length, 0x68][..], &body, &[sum, 0x16]].concat();
        let right = Telegram::new(bytes, Direction::Request, protocol("profibus-fdl"));
        let at = random.one_of(&[1, 2]);
        frame(right, at, length + 1)
    },
];

fn read(random: &mut Random) -> Telegram {
    let address = u16::from_be_bytes([random.between(1, 4) as u8, random.between(16, 240) as u8]);
    short(unit(random), random.one_of(&[3, 4]), address, random.between(2, 9) as u16)
}

fn answered(random: &mut Random) -> (Telegram, Telegram) {
    let address = u16::from_be_bytes([random.between(1, 4) as u8, random.between(16, 240) as u8]);
    let request = short(unit(random), random.one_of(&[3, 4]), address, 2);
    let data = [word(random).to_be_bytes(), word(random).to_be_bytes()].concat();
    let answer = values(&request, &data);
    (request, answer)
}

fn two_registers(random: &mut Random) -> Telegram {
    let address = u16::from_be_bytes([random.between(1, 4) as u8, random.between(16, 240) as u8]);
    write(unit(random), address, &[word(random).to_be_bytes(), word(random).to_be_bytes()].concat())
}

/// A universal channel of a Memograph is written.
fn channel(random: &mut Random) -> Telegram {
    let entries = [
        ("number", random.between(1, 40).to_string()),
        ("content.status", "good".to_owned()),
        ("content.value", quarters(random).to_string()),
    ];
    asked(MEMOGRAPH, unit(random), "modbus-rtu", "write Universal channel at 200 to 319", &entries)
}

/// Another unit.
fn other(random: &mut Random, unit: u8) -> u8 {
    1 + (unit - 1 + random.between(1, 29) as u8) % 31
}

/// Another number near it.
fn near(random: &mut Random, byte: u8) -> u8 {
    let by = random.between(1, 5) as u8;
    byte.checked_add(by).unwrap_or_else(|| byte - by)
}

/// A telegram with another byte at `at`; its checksum is that of the bytes as they are, as whoever sends wrong
/// bytes computes it.
fn spoiled(right: Telegram, at: usize, byte: u8, before: &[Telegram]) -> Task {
    let mut bytes = right.bytes.clone();
    bytes[at] = byte;
    if right.protocol.key == "modbus-rtu" {
        bytes.truncate(bytes.len() - 2);
        bytes = rtu(&bytes);
    }
    let wrong = right.with(bytes);
    let wanted = said(&right);
    let question = match before {
        [] => format!("This was to be: {wanted}. One byte is not as it should be. Which one?"),
        _ => "The first telegram asks, the second answers. One byte of the response cannot be right. Which one?".to_owned(),
    };
    let field = right.field_at(at);
    let label = field.as_ref().map_or(String::new(), |field| small(&field.label().to_string()));
    let role = field.as_ref().map_or(Role::Data, |field| field.spec.role);
    let span = field.as_ref().map_or(Span::new(at, at + 1), |field| field.span);
    let mut working = vec![match before {
        [] => format!("It should be: {}.", right.hex()),
        [request, ..] => format!("The request: {}", request.said()) + ".",
    }];
    working.push(format!("Here it is: {}.", wrong.hex()));
    working.push(format!(
        "Byte {at} is {byte:02X}; it should be {:02X}. It belongs to the {label}.",
        right.bytes[at]
    ));
    let place = match (role, before.is_empty()) {
        (_, false) => "A response repeats some of the request. Compare the two byte by byte, then count.",
        (Role::Unit | Role::Function, _) => "Read the first bytes and compare them with the sentence.",
        (Role::Address | Role::Count, _) => "Read where and how many, and compare that with the sentence.",
        _ => "Read the values one after the other, and compare them with the sentence.",
    };
    let rule = match role {
        Role::Unit => "Who is asked must be who answers: the first byte is the unit, in hex.",
        Role::Function => {
            "3 reads holding registers, 4 input registers; a healthy response repeats the function."
        }
        Role::Address => "An address has two bytes: the first one × 256 + the second one.",
        Role::Count if !before.is_empty() => {
            "Registers have two bytes each: the byte count must be twice their number."
        }
        Role::Count => "The quantity has two bytes, and counts registers.",
        Role::Status => "The low byte of the status is the quality: 80h is good.",
        _ => {
            "A float: sign, 8 bits of exponent, then the fraction. One step of the exponent doubles the value."
        }
    };
    Task {
        question,
        hints: vec![
            place.to_owned(),
            rule.to_owned(),
            format!("It is in the {label}: {}.", bytes_said(span)),
        ],
        working,
        given: before.iter().cloned().chain([wrong.clone()]).map(Given::Telegram).collect(),
        expected: Expected::Byte { telegram: wrong, right, at: Span::new(at, at + 1) },
    }
}

/// What a telegram is to say, without who says it first.
fn said(telegram: &Telegram) -> String {
    small(telegram.said().trim_end_matches('.'))
}

/// A PROFIBUS frame whose two lengths differ.
fn frame(right: Telegram, at: usize, byte: u8) -> Task {
    let mut bytes = right.bytes.clone();
    bytes[at] = byte;
    let wrong = right.with(bytes);
    let length = right.bytes[1];
    Task {
        question: "A frame of PROFIBUS (SD2). One byte contradicts the others. Which one?".to_owned(),
        hints: vec![
            "Look at the four bytes that the frame begins with: 68, a length, the same length again, 68.".to_owned(),
            "The length counts the bytes from the destination to the last one before the checksum; it stands there twice.".to_owned(),
            format!("Counted, there are {length} bytes: {}.", hex(&right.bytes[4..right.bytes.len() - 2])),
        ],
        working: vec![
            format!("The frame: {}.", wrong.hex()),
            format!("From the destination to before the checksum there are {length} bytes."),
            format!("Byte {at} says {byte}; it should be {length}."),
        ],
        given: vec![Given::Telegram(wrong.clone())],
        expected: Expected::Byte { telegram: wrong, right, at: Span::new(at, at + 1) },
    }
}
