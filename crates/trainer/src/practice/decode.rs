//! What does it say?

use buslens::field::{Field, Format, Order, Role, hex};

use super::make::{
    F5, F5_PROFIBUS, MEMOGRAPH, asked, bytes_said, field, float_said, of_device, protocol, quarters, short,
    small, unit, values, word, working, write,
};
use super::{Slot, Slots};
use crate::random::Random;
use crate::task::{Choice, Expected, Given, Number, Task, Telegram};

pub const SLOTS: Slots = [LEVEL_1, LEVEL_2, LEVEL_3];

const LEVEL_1: [Slot; 5] = [
    |random| {
        let request = short(random.between(16, 99) as u8, reading(random), address(random), quantity(random));
        value(
            vec![request],
            "unit",
            false,
            "This request goes out on a line with many units. Which unit is meant, in decimal?",
        )
    },
    |random| {
        let request = short(unit(random), reading(random), address(random), quantity(random));
        value(vec![request], "start", false, "From which address on does this request read, in decimal?")
    },
    |random| {
        let request = short(unit(random), reading(random), address(random), quantity(random));
        value(vec![request], "quantity", false, "How many registers does this request ask for?")
    },
    |random| {
        let request = short(unit(random), 3, address(random), 3);
        let data: Vec<u8> = (0..3)
            .flat_map(|_| {
                (u16::from_be_bytes([random.between(1, 3) as u8, random.between(16, 255) as u8]))
                    .to_be_bytes()
            })
            .collect();
        let response = values(&request, &data);
        let nth = random.below(3);
        let start = u16::from_be_bytes([request.bytes[2], request.bytes[3]]);
        let question = format!(
            "The first telegram asks, the second answers. What is in register {}, in decimal?",
            start + nth as u16
        );
        let field = response.fields(false).into_iter().filter(|field| field.spec.role == Role::Data).nth(nth);
        of_field(vec![request, response], field, &question)
    },
    |random| {
        let request = short(unit(random), 6, address(random), word(random));
        value(
            vec![request],
            "value",
            false,
            "This request writes one register. Which value is written, in decimal?",
        )
    },
];

const LEVEL_2: [Slot; 5] = [
    |random| {
        let request = of_device(short(unit(random), 3, 0x2035, 1), F5);
        let speed = -(random.between(130, 2900) as i16);
        let response = values(&request, &speed.to_be_bytes());
        value(
            vec![request, response],
            "actual_speed",
            true,
            "A KEB F5 is asked for its actual speed. How fast does the motor turn? Below 0 is backwards.",
        )
    },
    |random| {
        let function = random.one_of(&[3, 4, 6, 16]);
        let request = match function {
            16 => write(unit(random), address(random), &word(random).to_be_bytes()),
            _ => short(unit(random), function, address(random), quantity(random)),
        };
        exception(random, request)
    },
    |random| {
        let request = of_device(short(unit(random), 3, 200 + 3 * random.below(40) as u16, 1), MEMOGRAPH);
        let code = random.one_of(&[0x80, 0x41, 0x01, 0x03]);
        let limit = 1_u8 << random.below(8);
        let response = values(&request, &[if code == 0x80 { limit } else { 0 }, code]);
        quality(random, request, response, code)
    },
    |random| {
        let first = address(random);
        let data: Vec<u8> = (0..2).flat_map(|_| word(random).to_be_bytes()).collect();
        let request = write(unit(random), first, &data);
        let nth = random.below(2);
        let question = format!(
            "This request writes two registers. Which value does register {} get, in decimal?",
            first + nth as u16
        );
        let field = request.fields(false).into_iter().filter(|field| field.spec.role == Role::Data).nth(nth);
        of_field(vec![request], field, &question)
    },
    |random| {
        let first = 8 * random.between(2, 11) as u16;
        let request = short(unit(random), 1, first, 8);
        let bits =
            random.some_of(&[0, 1, 2, 3, 4, 5, 6, 7], 3).into_iter().fold(0, |bits, bit| bits | 1_u8 << bit);
        let response = values(&request, &[bits]);
        coil(random, request, response, first, bits)
    },
];

const LEVEL_3: [Slot; 5] = [
    |random| {
        let channel = random.below(40) as u16;
        let request = of_device(short(unit(random), 3, 200 + 3 * channel, 3), MEMOGRAPH);
        let value_bytes = quarters(random).to_be_bytes();
        let response = values(&request, &[&[0, 0x80], &value_bytes[..]].concat());
        let question = format!(
            "A Memograph is asked for its universal channel {}. Which value does it answer?",
            channel + 1
        );
        value(vec![request, response], "value", true, &question)
    },
    |random| {
        let request = short(unit(random), 3, address(random), 2);
        let raw = quarters(random).to_bits();
        let response = values(&request, &Order::LowWordFirst.bytes(raw.into(), 4));
        let mut number = Number::new("Value", raw.into(), 4, Format::Float);
        number.role = Role::Data;
        let bytes = &response.bytes[3..7];
        Task {
            question: "This device keeps a float in two registers, the low word first (CDAB). Which value does it answer?".to_owned(),
            working: vec![
                format!("Bytes 3 to 6 of the response: {}. The first register is the low word.", hex(bytes)),
                format!("The high word first: {}.", hex(&raw.to_be_bytes())),
                float_said(raw),
            ],
            hints: vec![
                "The value is in the two registers of the response, bytes 3 to 6.".to_owned(),
                "Put the second register before the first one. Then: 1 bit sign, 8 bits exponent less 127, and 1 + fraction.".to_owned(),
                format!("In the usual order the four bytes are {}.", hex(&raw.to_be_bytes())),
            ],
            given: vec![Given::Telegram(request), Given::Telegram(response)],
            expected: Expected::Number(number),
        }
    },
    |random| {
        let set_speed = -(random.between(130, 2900) as i32);
        let entries = [("subindex", "1".to_owned()), ("content.set_speed", set_speed.to_string())];
        let job = asked(F5_PROFIBUS, 1, "profibus-parameter-channel", "write Set speed (Sy.52)", &entries);
        value(
            vec![job],
            "set_speed",
            true,
            "A job for the parameter channel of a KEB F5 on PROFIBUS. Which set speed (Sy.52) is written?",
        )
    },
    |random| {
        let parameters = [
            (0x0033_u16, "Status word (Sy.51)"),
            (0x0035, "Actual speed (Sy.53)"),
            (0x0034, "Set speed (Sy.52)"),
            (0x0032, "Control word (Sy.50)"),
        ];
        mapping(random, &parameters)
    },
    |random| {
        let transaction = word(random).to_be_bytes();
        let (unit, first) = (unit(random), address(random));
        let value_written = word(random);
        let mut bytes =
            [&transaction[..], &[0, 0, 0, 6, unit, 6], &first.to_be_bytes(), &value_written.to_be_bytes()]
                .concat();
        bytes[5] = 6;
        let request = Telegram::new(bytes, buslens::field::Direction::Request, protocol("modbus-tcp"));
        value(vec![request], "value", false, "A request of Modbus TCP. Which value is written, in decimal?")
    },
];

/// A function that reads registers.
fn reading(random: &mut Random) -> u8 {
    random.one_of(&[3, 4])
}

/// An address whose two bytes both count.
fn address(random: &mut Random) -> u16 {
    (random.between(1, 4) as u16) << 8 | random.between(16, 250) as u16
}

/// More than nine registers, so that hex and decimal differ.
fn quantity(random: &mut Random) -> u16 {
    random.between(10, 60) as u16
}

/// What is in a field of the last telegram.
fn value(telegrams: Vec<Telegram>, key: &str, named: bool, question: &str) -> Task {
    let field = telegrams.last().and_then(|telegram| field(telegram, key, named));
    of_field(telegrams, field, question)
}

fn of_field(telegrams: Vec<Telegram>, field: Option<Field>, question: &str) -> Task {
    let last = telegrams.last().zip(field);
    let (number, hints, working) = match &last {
        Some((telegram, field)) => (Number::of(field), hints(telegram, field), working(telegram, field)),
        None => (None, Vec::new(), Vec::new()),
    };
    Task {
        question: question.to_owned(),
        expected: Expected::Number(number.unwrap_or_else(|| Number::new("", 0, 1, Format::Decimal))),
        hints,
        working,
        given: telegrams.into_iter().map(Given::Telegram).collect(),
    }
}

/// Where to look, which rule, and the field.
pub fn hints(telegram: &Telegram, field: &Field) -> Vec<String> {
    let bytes = field.span.of(&telegram.bytes);
    let place = match field.spec.role {
        Role::Unit => "Who is meant stands at the very beginning.",
        Role::Function => "What is to be done stands right behind the address of the unit.",
        Role::Address if field.span.from == 0 => "Who is meant stands at the very beginning.",
        Role::Address => "Where to read or write stands right behind the function code.",
        Role::Count => "How many stands behind the address.",
        Role::Check => "The checksum is at the end.",
        _ if telegram.protocol.key == "modbus-tcp" => {
            "Six bytes of Modbus TCP come first, then unit and function, and only then the rest as on a serial line."
        }
        _ if telegram.protocol.key == "profibus-parameter-channel" => {
            "The job comes first, then subindex, index, and at last the value in four bytes."
        }
        _ if telegram.direction == buslens::field::Direction::Response => {
            "The values come behind the byte count, one register after the other."
        }
        _ => "What is written stands at the end, before the checksum.",
    };
    let rule = match (field.spec.format, bytes.len()) {
        (Format::Float, _) => {
            "A float: 1 bit sign, 8 bits exponent less 127, then 23 bits of fraction: (1 + fraction) × 2 to the exponent."
        }
        (Format::Signed, _) => {
            "High byte × 256 + low byte. From 32768 on the number is below 0: take 65536 off."
        }
        (_, 1) => "The first hex digit counts 16: C8h is 12 × 16 + 8.",
        (_, 2) => "Two bytes make one number: the first one × 256 + the second one.",
        _ => "The bytes make one number, the first one counting most.",
    };
    vec![place.to_owned(), rule.to_owned(), format!("It is in {}: {}.", bytes_said(field.span), hex(bytes))]
}

fn exception(random: &mut Random, request: Telegram) -> Task {
    const NAMES: [(u8, &str); 4] = [
        (1, "It does not know this function"),
        (2, "It has no such register"),
        (3, "It does not take this value or quantity"),
        (4, "Something failed in the device"),
    ];
    let right = random.below(NAMES.len());
    let code = NAMES[right].0;
    let answer = super::make::rejected(&request, code);
    let choices = NAMES.map(|(number, text)| {
        Choice::new(
            text,
            &format!("That is exception {number}. Look at the byte behind the function code again."),
        )
    });
    let function = request.bytes[1];
    Task {
        question: "A unit rejects what it is asked. Why?".to_owned(),
        hints: vec![
            "Compare the function code of the response with that of the request.".to_owned(),
            "80h is added to the function code when a request is rejected; one byte behind it says why."
                .to_owned(),
            format!("The code is in byte 2: {code:02X}."),
        ],
        working: vec![
            format!(
                "The response has function {:02X}h: {function:02X}h + 80h, an exception.",
                function | 0x80
            ),
            format!("Byte 2 says why: {code}."),
            format!("Exception {code}: {}.", buslens_name(&answer)),
        ],
        given: vec![Given::Telegram(request), Given::Telegram(answer)],
        expected: Expected::Choice { choices: choices.to_vec(), right },
    }
}

/// The name of an exception, as the standard has it.
fn buslens_name(answer: &Telegram) -> String {
    let code = answer.fields(false).into_iter().find(|field| field.spec.role == Role::Status);
    code.and_then(|field| field.meaning()).map_or(String::new(), |meaning| meaning.to_string())
}

fn quality(random: &mut Random, request: Telegram, response: Telegram, code: u8) -> Task {
    let all = [
        (0x80, "It is good"),
        (0x41, "It is uncertain, with a low limit"),
        (0x01, "The circuit is open: a wire is broken or loose"),
        (0x03, "The signal is too low"),
    ];
    let mut order: Vec<usize> = (0..all.len()).collect();
    random.shuffle(&mut order);
    let choices: Vec<Choice> = order
        .iter()
        .map(|at| {
            let (code, text) = all[*at];
            Choice::new(text, &format!("That would be {code:02X}h in the low byte of the status."))
        })
        .collect();
    let right = order.iter().position(|at| all[*at].0 == code).unwrap_or_default();
    let high = response.bytes[3];
    Task {
        question: "A Memograph answers the status register of a channel. What does it say of the value?".to_owned(),
        hints: vec![
            "The status is the register in the response: bytes 3 and 4.".to_owned(),
            "The low byte, the second one, is the quality: 80h good, 40h to 43h uncertain, 01h open circuit, 03h too low.".to_owned(),
            format!("The low byte is byte 4: {code:02X}."),
        ],
        working: vec![
            format!("Bytes 3 and 4: {high:02X} {code:02X}, the status."),
            format!("The high byte has a bit for each limit: {high:02X}h."),
            format!("The low byte is the quality: {code:02X}h, {}.", small(&choices[right].text)),
        ],
        given: vec![Given::Telegram(request), Given::Telegram(response)],
        expected: Expected::Choice { choices, right },
    }
}

fn coil(random: &mut Random, request: Telegram, response: Telegram, first: u16, bits: u8) -> Task {
    let on: Vec<u8> = (0..8).filter(|bit| bits >> bit & 1 == 1).collect();
    let off: Vec<u8> = (0..8).filter(|bit| bits >> bit & 1 == 0).collect();
    let right_bit = random.one_of(&on);
    let mut bits_asked = random.some_of(&off, 3);
    bits_asked.push(right_bit);
    random.shuffle(&mut bits_asked);
    let right = bits_asked.iter().position(|bit| *bit == right_bit).unwrap_or_default();
    let choices = bits_asked.iter().map(|bit| {
        let remark = format!(
            "Coil {} is bit {bit} of the byte, counted from the right and from 0. That bit is 0.",
            first + u16::from(*bit)
        );
        Choice::new(&format!("Coil {}", first + u16::from(*bit)), &remark)
    });
    Task {
        question: "Eight coils are read. Which of these is on?".to_owned(),
        hints: vec![
            format!("The request says from which coil on: {first}. The response has them in one byte."),
            "The first coil is the lowest bit, the one at the right; the next one is left of it.".to_owned(),
            format!("Byte 3 is {bits:02X}, in binary {bits:08b}."),
        ],
        working: vec![
            format!("The request asks for 8 coils from {first} on."),
            format!(
                "Byte 3 of the response: {bits:02X}h = {bits:08b}b; the bit at the right is coil {first}."
            ),
            format!("Bit {right_bit} is 1: coil {} is on.", first + u16::from(right_bit)),
        ],
        expected: Expected::Choice { choices: choices.collect(), right },
        given: vec![Given::Telegram(request), Given::Telegram(response)],
    }
}

fn mapping(random: &mut Random, parameters: &[(u16, &str)]) -> Task {
    let right = random.below(parameters.len());
    let (address, label) = parameters[right];
    let n = random.between(0, 40) as u16;
    let [high, low] = address.to_be_bytes();
    let unit = unit(random);
    let place = (0x5F32 + n).to_be_bytes();
    let body = [&[unit, 0x65], &place[..], &[0, 1, 4, high, low, 1, 1]].concat();
    let request = of_device(super::make::request(&body), F5);
    let choices = parameters
        .iter()
        .map(|(address, label)| Choice::new(label, &format!("That is parameter {address:04X}h.")))
        .collect();
    Task {
        question: format!(
            "An entry of a KEB F5's mapping list is written (list for reading, entry {n}). Which parameter will be behind the mapped register?"
        ),
        hints: vec![
            "The entry is the four bytes before the CRC.".to_owned(),
            "Its first two bytes are the address of the parameter, then the sets, then the length in words."
                .to_owned(),
            format!("The parameter's address is in bytes 7 and 8: {high:02X} {low:02X}."),
        ],
        working: vec![
            format!(
                "Function 65h (101) writes 32-bit registers; bytes 7 to 10 are the entry: {high:02X} {low:02X} 01 01."
            ),
            format!("Its first word is the address: {address:04X}h."),
            format!("The manual calls {address:04X}h {label}; set 0, one word."),
        ],
        given: vec![Given::Telegram(request)],
        expected: Expected::Choice { choices, right },
    }
}
