//! What belongs into the blanks?

use buslens::field::{Role, hex, in_order};

use super::decode::hints as of_field;
use super::make::{
    MEMOGRAPH, asked, confirmed, of_device, protocol, quarters, rejected, sentence, short, small, unit,
    values, word, working, write,
};
use super::{Slot, Slots};
use crate::random::Random;
use crate::task::{Blank, Expected, Given, Task, Telegram};

pub const SLOTS: Slots = [LEVEL_1, LEVEL_2, LEVEL_3];

const LEVEL_1: [Slot; 5] = [
    |random| {
        let (request, answer) = read(random, 3);
        blank("The response to this request. How many bytes follow?", Some(request), answer, &["byte_count"])
    },
    |random| {
        let (request, answer) = read(random, 2);
        blank("The response to this request. Who is it from?", Some(request), answer, &["unit"])
    },
    |random| {
        let (request, answer) = read(random, 2);
        blank("The response to this request. What does it repeat?", Some(request), answer, &["function"])
    },
    |random| {
        let from = address(random);
        let request = short(unit(random), 3, from, random.between(2, 9) as u16);
        let last = from + u16::from(request.bytes[5]) - 1;
        let question = format!("Read the registers at the addresses {from} to {last}. How many are these?");
        blank(&question, None, request, &["quantity"])
    },
    |random| {
        let request = three(random);
        blank("Three registers are written. How many bytes are that?", None, request, &["byte_count"])
    },
];

const LEVEL_2: [Slot; 5] = [
    |random| {
        let from = address(random);
        let request = short(unit(random), 3, from, random.between(10, 30) as u16);
        let last = from + u16::from(request.bytes[5]) - 1;
        let question = format!(
            "Read holding registers 4{:04} to 4{:04} (references, which count from 1).",
            from + 1,
            last + 1
        );
        blank(&question, None, request, &["start", "quantity"])
    },
    |random| {
        let request = three(random);
        blank(
            "The confirmation of this write.",
            Some(request.clone()),
            confirmed(&request),
            &["start", "quantity"],
        )
    },
    |random| {
        let request = three(random);
        blank("Three registers are written.", None, request, &["quantity", "byte_count"])
    },
    |random| {
        let (request, answer) = read(random, 4);
        blank("The response to this request.", Some(request), answer, &["function", "byte_count"])
    },
    |random| {
        let (from, value) = (address(random), word(random));
        let request = short(unit(random), 6, from, value);
        let question = format!("Write {value} into the register at address {from}.");
        blank(&question, None, request, &["start", "value"])
    },
];

const LEVEL_3: [Slot; 5] = [
    |random| {
        let request = channel(random);
        let question = format!("{}.", request.said());
        blank(&question, None, request, &["start", "status", "value"])
    },
    |random| {
        let (request, _) = read(random, 2);
        let answer = rejected(&request, 2);
        let question = "The unit has no such registers, and says so with exception 2, illegal data address.";
        blank(question, Some(request), answer, &["function", "exception"])
    },
    |random| {
        let head = word(random).to_be_bytes();
        let (start, quantity) = (address(random).to_be_bytes(), [0, random.between(2, 9) as u8]);
        let pdu = [&[unit(random), 3][..], &start, &quantity].concat();
        let bytes = [&head[..], &[0, 0, 0, pdu.len() as u8], &pdu].concat();
        let request = Telegram::new(bytes, buslens::field::Direction::Request, protocol("modbus-tcp"));
        let [start, quantity] =
            [&request.bytes[8..10], &request.bytes[10..12]].map(|it| u16::from_be_bytes([it[0], it[1]]));
        let question = format!("Modbus TCP: read {quantity} holding registers from address {start} on.");
        blank(&question, None, request, &["length", "start", "quantity"])
    },
    |random| {
        let speed = -(random.between(130, 2900) as i32);
        let request = asked(
            super::make::F5,
            unit(random),
            "modbus-rtu",
            "write Set speed (Sy.52)",
            &[("content.set_speed", speed.to_string())],
        );
        let question = format!("Write the set speed (Sy.52, register 2034h) of a KEB F5: −{}.", -speed);
        blank(&question, None, request, &["start", "byte_count", "set_speed"])
    },
    |random| {
        let request = of_device(short(unit(random), 3, 200 + 3 * random.below(40) as u16, 3), MEMOGRAPH);
        let value = quarters(random);
        let answer = values(&request, &[&[0, 0x80], &value.to_be_bytes()[..]].concat());
        let question = format!("The Memograph answers: {value}, good.");
        blank(&question, Some(request), answer, &["byte_count", "status", "value"])
    },
];

fn address(random: &mut Random) -> u16 {
    u16::from_be_bytes([random.between(1, 4) as u8, random.between(16, 200) as u8])
}

fn read(random: &mut Random, registers: u16) -> (Telegram, Telegram) {
    let request = short(unit(random), random.one_of(&[3, 4]), address(random), registers);
    let data: Vec<u8> = (0..registers).flat_map(|_| word(random).to_be_bytes()).collect();
    let answer = values(&request, &data);
    (request, answer)
}

fn three(random: &mut Random) -> Telegram {
    let data: Vec<u8> = (0..3).flat_map(|_| word(random).to_be_bytes()).collect();
    write(unit(random), address(random), &data)
}

fn channel(random: &mut Random) -> Telegram {
    let entries = [
        ("number", random.between(20, 40).to_string()),
        ("content.status", "good".to_owned()),
        ("content.value", quarters(random).to_string()),
    ];
    asked(MEMOGRAPH, unit(random), "modbus-rtu", "write Universal channel at 200 to 319", &entries)
}

/// A telegram with the fields of these keys blank.
fn blank(question: &str, request: Option<Telegram>, telegram: Telegram, keys: &[&str]) -> Task {
    let all = telegram.fields(true);
    let named = keys.iter().filter_map(|key| all.iter().find(|it| it.spec.key == *key));
    let fields = in_order(named, |field| field.span);
    let blanks: Vec<Blank> =
        fields.iter().map(|field| Blank { label: field.label().to_string(), span: field.span }).collect();
    let first = fields.first().copied();
    let working = fields.iter().flat_map(|field| {
        let whole = working(&telegram, field);
        // The place, and what it comes to.
        whole.into_iter().take(2)
    });
    let mut hints = first.map_or(Vec::new(), |field| of_field(&telegram, field));
    if let [where_, rule, last] = &mut hints[..] {
        *where_ = match (first.map(|field| field.spec.role), request.is_some()) {
            (Some(Role::Count), true) => {
                "The response follows from the request: how many registers, so how many bytes?".to_owned()
            }
            (_, true) => "A response repeats who was asked, what, and often where.".to_owned(),
            (_, false) => "The sentence says who, where and how many: write each in hex.".to_owned(),
        };
        let keyed = |wanted: &str| fields.iter().any(|field| field.spec.key == wanted);
        *rule = if keyed("exception") {
            "Who rejects adds 80h to the function code, and says why in one byte.".to_owned()
        } else if keyed("value") && keyed("status") {
            "Status 0080h is good. A float: sign, exponent + 127, and the fraction without its leading 1."
                .to_owned()
        } else if keyed("length") {
            "The length of Modbus TCP counts what follows it: unit, function and the rest.".to_owned()
        } else if keyed("byte_count") {
            "A byte count counts the bytes that follow it: two for each register.".to_owned()
        } else if keyed("function") {
            "A healthy response has the function code of its request.".to_owned()
        } else {
            "An address counts from 0, a quantity is last − first + 1; both have two bytes, the high one first.".to_owned()
        };
        let text = fields.first().map_or(String::new(), |field| {
            format!(
                "{}: {}.",
                sentence(&small(&field.label().to_string())),
                hex(field.span.of(&telegram.bytes))
            )
        });
        *last = text;
    }
    Task {
        question: question.to_owned(),
        hints,
        working: working.collect(),
        given: request.into_iter().map(Given::Telegram).collect(),
        expected: Expected::Blanks { telegram, blanks },
    }
}
