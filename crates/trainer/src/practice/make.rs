//! What all kinds of practice make their tasks of: telegrams, and how a field comes about.

use std::fmt;

use buslens::field::{Direction, Field, Format, Order, Span, float, hex, hex_value, shortest};
use buslens::tool::steps::CHECKS;
use buslens::tool::{Change, Editor, Profile, Protocol, Settings, offers};

use crate::random::Random;
use crate::task::Telegram;

pub const MEMOGRAPH: &str = "memograph-rsg45";
pub const F5: &str = "keb-f5-modbus";
pub const F5_PROFIBUS: &str = "keb-f5-profibus";

/// The protocol with this key. All that are named here are there: a test makes every slot.
pub fn protocol(key: &str) -> &'static Protocol {
    Protocol::of(key).unwrap_or(buslens::tool::PROTOCOLS[0])
}

/// Unit and PDU with their CRC.
pub fn rtu(body: &[u8]) -> Vec<u8> {
    let check = CHECKS[0].wire(body) as u16;
    [body, &check.to_be_bytes()].concat()
}

/// A request of Modbus RTU.
pub fn request(body: &[u8]) -> Telegram {
    Telegram::new(rtu(body), Direction::Request, protocol("modbus-rtu"))
}

/// A response of Modbus RTU to `request`.
pub fn response(request: &Telegram, body: &[u8]) -> Telegram {
    Telegram {
        direction: Direction::Response,
        bytes: rtu(body),
        request: Some(request.bytes.clone()),
        ..request.clone()
    }
}

/// A request with function, address and another number: of registers, or what is written.
pub fn short(unit: u8, function: u8, address: u16, number: u16) -> Telegram {
    let (address, number) = (address.to_be_bytes(), number.to_be_bytes());
    request(&[&[unit, function], &address[..], &number[..]].concat())
}

/// What a unit answers that is asked for registers, or coils.
pub fn values(request: &Telegram, data: &[u8]) -> Telegram {
    let head = [request.bytes[0], request.bytes[1], data.len() as u8];
    response(request, &[&head[..], data].concat())
}

/// A request to write registers.
pub fn write(unit: u8, address: u16, data: &[u8]) -> Telegram {
    let (address, quantity) = (address.to_be_bytes(), (data.len() as u16 / 2).to_be_bytes());
    request(&[&[unit, 16], &address[..], &quantity[..], &[data.len() as u8], data].concat())
}

/// The confirmation of a write.
pub fn confirmed(request: &Telegram) -> Telegram {
    response(request, &request.bytes[..6])
}

/// A request that is rejected.
pub fn rejected(request: &Telegram, code: u8) -> Telegram {
    response(request, &[request.bytes[0], request.bytes[1] | 0x80, code])
}

/// The same as read with the words of a device's manual.
pub fn of_device(mut telegram: Telegram, device: &str) -> Telegram {
    telegram.options.device = Profile::of(device);
    telegram
}

/// What is asked of a device, in the words of its manual: the label of an offer, and what is filled in.
pub fn asked(
    device: &str,
    unit: u8,
    protocol_key: &str,
    label: &str,
    entries: &[(&str, String)],
) -> Telegram {
    let profile = Profile::of(device);
    let protocol = protocol(protocol_key);
    let offer = offers(profile).into_iter().find(|offer| offer.label().to_string() == label);
    let editor = offer.and_then(|offer| Editor::new(offer, unit, protocol, &Settings::default()).ok());
    let bytes = editor.and_then(|mut editor| {
        entries.iter().for_each(|(path, text)| editor.edit(path, Change::Enter(text)));
        editor.bytes().ok()
    });
    of_device(Telegram::new(bytes.unwrap_or_default(), Direction::Request, protocol), device)
}

/// A unit as plants have them.
pub fn unit(random: &mut Random) -> u8 {
    random.between(2, 31) as u8
}

/// A value of two bytes, neither of which is 0.
pub fn word(random: &mut Random) -> u16 {
    (random.between(1, 0x7E) as u16) << 8 | random.between(1, 0xFE) as u16
}

/// A float, written as the library writes it.
#[derive(Clone, Copy)]
pub struct Float(f32);

impl Float {
    pub fn to_bits(self) -> u32 {
        self.0.to_bits()
    }

    pub fn to_be_bytes(self) -> [u8; 4] {
        self.0.to_be_bytes()
    }
}

impl fmt::Display for Float {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&float(self.to_bits().into(), 4))
    }
}

/// A float of few digits, as people set it: from 8.25 to 511.75, in quarters that are no whole number.
pub fn quarters(random: &mut Random) -> Float {
    Float(random.between(8, 511) as f32 + [0.25, 0.5, 0.75][random.below(3)])
}

/// "byte 2", "bytes 2 and 3", "bytes 2 to 5".
pub fn bytes_said(span: Span) -> String {
    match span.len() {
        1 => format!("byte {}", span.from),
        2 => format!("bytes {} and {}", span.from, span.from + 1),
        _ => format!("bytes {} to {}", span.from, span.to - 1),
    }
}

/// A sentence that begins with a capital.
pub fn sentence(text: &str) -> String {
    let mut rest = text.chars();
    rest.next()
        .map_or(String::new(), |first| std::iter::once(first.to_ascii_uppercase()).chain(rest).collect())
}

/// A label within a sentence; abbreviations stay as they are.
pub fn small(label: &str) -> String {
    match label.get(..2) {
        Some(first) if first.bytes().all(|c| c.is_ascii_uppercase()) => label.to_owned(),
        _ => label.chars().take(1).map(|c| c.to_ascii_lowercase()).chain(label.chars().skip(1)).collect(),
    }
}

/// The first field with this key; the device's own words where `named`.
pub fn field(telegram: &Telegram, key: &str, named: bool) -> Option<Field> {
    telegram.fields(named).into_iter().find(|field| field.spec.key == key)
}

/// How a field's value comes about.
pub fn working(telegram: &Telegram, field: &Field) -> Vec<String> {
    let own = field.span.of(&telegram.bytes);
    let place = format!(
        "{}: {}, the {}.",
        sentence(&bytes_said(field.span)),
        hex(own),
        small(&field.label().to_string())
    );
    let raw = Order::Big.number(own);
    let whole = match *own {
        [byte] => format!("{byte:02X}h = {} × 16 + {} = {byte}.", byte >> 4, byte & 15),
        [high, low] => format!("{high:02X}h × 256 + {low:02X}h = {high} × 256 + {low} = {raw}."),
        _ => format!("{} = {raw}.", hex_value(raw, own.len())),
    };
    let last = match field.spec.format {
        Format::Float => return vec![place, float_said(raw as u32)],
        Format::Signed if own.len() == 2 && raw > 0x7FFF => {
            format!("The highest bit is set, so it is below 0: {raw} − 65536 = {}.", field.value_text())
        }
        Format::Signed if own.len() == 4 && raw > 0x7FFF_FFFF => {
            format!("The highest bit is set, so it is below 0: {}.", field.value_text())
        }
        _ => return vec![place, whole],
    };
    vec![place, whole, last]
}

/// A float taken apart.
pub fn float_said(raw: u32) -> String {
    let exponent = (raw >> 23 & 0xFF) as i32 - 127;
    let fraction = shortest(1.0 + f64::from(raw & 0x007F_FFFF) / 8_388_608.0);
    format!(
        "Sign {}, exponent {} − 127 = {exponent}, 1 + fraction = {fraction}: {fraction} × 2^{exponent} = {}.",
        if raw >> 31 == 0 { '+' } else { '−' },
        exponent + 127,
        float(raw.into(), 4)
    )
}

/// What each field of a telegram has to be, for the answer key: three lines at most for the values.
pub fn all_fields(telegram: &Telegram) -> Vec<String> {
    let line = |field: &Field| {
        let value = field.value_text();
        let meaning = field.meaning().map(|meaning| meaning.to_string()).filter(|text| *text != value);
        let said: Vec<String> = std::iter::once(value).chain(meaning).filter(|it| !it.is_empty()).collect();
        let bytes = hex(field.span.of(&telegram.bytes));
        match said.as_slice() {
            [] => format!("{}: {bytes}.", field.label()),
            said => format!("{}: {bytes} ({}).", field.label(), said.join(", ")),
        }
    };
    telegram.fields(true).iter().map(line).collect()
}
