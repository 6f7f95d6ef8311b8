//! How every telegram is laid out: functions of Modbus, services of PROFIBUS, and what carries them.

use super::{About, Book, Chapter, Item, key_of, link_of, link_to};
use crate::field::{Direction, Spec, hex_value};
use crate::frame::profibus_fdl::{Fdl, SC, SD1, SD2, SD3, SD4};
use crate::frame::{Cargo, Settings, modbus_ascii, modbus_pdu, modbus_rtu, modbus_tcp, profibus_fdl};
use crate::modbus::{self, DIALECTS, Dialect, Pdu, STANDARD};
use crate::profibus::{self, Channel, Refusal, Service};
use crate::tool::link::Link;
use crate::tool::{Editor, Offer, Protocol};
use crate::walk::guide::{Row, guide};
use crate::walk::{self, Deviations, Telegram};

/// A function, a service or a frame, with its telegrams.
#[derive(Clone, Debug)]
pub struct Topic {
    subject: Subject,
    /// What a person calls it besides its label: "function 16, 10h", "access point 61".
    pub code: String,
    pub note: &'static str,
    pub source: &'static str,
}

#[derive(Clone, Debug)]
enum Subject {
    Function(Vec<&'static modbus::Kind>),
    Service(Vec<&'static profibus::Kind>),
    Channel,
    /// What carries a PDU.
    Around(&'static Protocol),
    /// A PROFIBUS frame, by its start delimiter.
    Frame(u8),
}

/// How a telegram is laid out.
#[derive(Clone, Debug, PartialEq)]
pub struct Layout {
    /// "Request", "Response".
    pub title: String,
    pub direction: Direction,
    pub note: &'static str,
    pub rows: Vec<Row>,
    /// What its first byte is, and which bits of that count, where that tells it from others.
    begins: Option<(u8, u8)>,
}

impl Topic {
    /// What can carry it, the usual one first; one where it does not matter.
    pub fn carriers(&self) -> Vec<&'static Protocol> {
        match &self.subject {
            Subject::Function(kinds) if kinds.iter().all(|kind| kind.serial_only) => {
                vec![&modbus_rtu::PROTOCOL, &modbus_ascii::PROTOCOL, &modbus_pdu::PROTOCOL]
            }
            Subject::Function(_) => vec![
                &modbus_rtu::PROTOCOL,
                &modbus_tcp::PROTOCOL,
                &modbus_ascii::PROTOCOL,
                &modbus_pdu::PROTOCOL,
            ],
            Subject::Service(_) => vec![&profibus_fdl::PROTOCOL],
            Subject::Channel => Protocol::of("profibus-parameter-channel").into_iter().collect(),
            Subject::Around(protocol) => vec![protocol],
            Subject::Frame(_) => vec![&profibus_fdl::PROTOCOL],
        }
    }

    /// How its telegrams are laid out, each by one `walk`: requests, responses, and what may be in their place.
    pub fn layouts(&self, carrier: &Protocol) -> Vec<Layout> {
        match &self.subject {
            Subject::Function(kinds) => {
                let mut layouts: Vec<Layout> = kinds
                    .iter()
                    .filter_map(|kind| {
                        let rows = carried(carrier, kind.pdu(&STANDARD))?;
                        Some(Layout::new(
                            direction_name(kind.direction),
                            kind.direction,
                            kind.spec.note,
                            rows,
                        ))
                    })
                    .collect();
                layouts.extend(other_layouts(carrier, kinds));
                layouts
            }
            Subject::Service(kinds) => kinds
                .iter()
                .map(|kind| {
                    // What is around it is the same for all: frames have pages of their own.
                    let mut body = (kind.new)(&profibus::Settings::default());
                    Layout::new(
                        direction_name(kind.direction),
                        kind.direction,
                        kind.spec.note,
                        guide(body.as_mut()),
                    )
                })
                .collect(),
            Subject::Channel => channel_layouts(),
            Subject::Around(protocol) => {
                let pdu = modbus::OTHER_KINDS.iter().find(|kind| kind.direction == Direction::Request);
                let rows = pdu.and_then(|kind| carried(protocol, kind.pdu(&STANDARD))).unwrap_or_default();
                vec![Layout::new("Request or response", Direction::Request, self.note, rows)]
            }
            Subject::Frame(start) => vec![frame_layout(*start)],
        }
    }

    /// The function code, without the bit of exceptions.
    pub fn function(&self) -> Option<u8> {
        match &self.subject {
            Subject::Function(kinds) => kinds.first().map(|kind| kind.function),
            _ => None,
        }
    }

    /// A telegram of it as Build begins with it.
    pub fn draft(&self) -> Option<Link> {
        let carrier = *self.carriers().first()?;
        let settings = crate::tool::Settings::default();
        let offer = match &self.subject {
            Subject::Function(kinds) => Offer::Telegram(kinds.first()?),
            Subject::Service(kinds) => Offer::Service(kinds.first()?),
            Subject::Channel => Offer::Service(&profibus::parameter_channel::REQUEST),
            Subject::Around(_) => Offer::Telegram(modbus::KINDS.iter().find(|kind| kind.function == 3)?),
            Subject::Frame(SD2) => Offer::Service(profibus::KINDS.iter().find(|kind| kind.sap == Some(60))?),
            Subject::Frame(start) => {
                let bytes = frame_bytes(*start);
                let direction = if *start == SC { Direction::Response } else { Direction::Request };
                return Some(link_to(bytes, carrier, direction));
            }
        };
        if let Offer::Telegram(kind) = offer
            && kind.function == modbus::EXCEPTION
        {
            let refusal = Pdu::expect(3, Direction::Request, &STANDARD).refusal(2);
            let mut frame = (carrier.carry)(1, Cargo::Modbus(refusal))?;
            return Some(link_to(&written(frame.as_mut()), carrier, Direction::Response));
        }
        Editor::new(offer, 1, carrier, &settings).ok().map(link_of)
    }
}

impl Layout {
    /// Whether `bytes`, a telegram of its topic, can be laid out so.
    pub fn fits(&self, bytes: &[u8]) -> bool {
        self.begins.is_none_or(|(value, mask)| bytes.first().is_some_and(|first| (first ^ value) & mask == 0))
    }

    fn new(title: &str, direction: Direction, note: &'static str, rows: Vec<Row>) -> Self {
        Self { title: title.to_owned(), direction, note, rows, begins: None }
    }
}

const fn direction_name(direction: Direction) -> &'static str {
    match direction {
        Direction::Request => "Request",
        Direction::Response => "Response",
    }
}

/// The layout of a PDU with what is around it.
fn carried(carrier: &Protocol, pdu: Pdu) -> Option<Vec<Row>> {
    (carrier.carry)(1, Cargo::Modbus(pdu)).map(|mut frame| guide(frame.as_mut()))
}

pub(super) fn written(telegram: &mut dyn Telegram) -> Vec<u8> {
    walk::write(telegram, &Deviations::default())
}

/// What else there is under these function codes: other MEI types, and the layouts that devices may have.
fn other_layouts(carrier: &Protocol, kinds: &[&'static modbus::Kind]) -> Vec<Layout> {
    let mut layouts = Vec::new();
    if let Some(kind) = kinds.iter().find(|kind| kind.function == 43) {
        let mut pdu = kind.pdu(&STANDARD);
        walk::fill(&mut pdu, &[43, 13]);
        let rows = carried(carrier, pdu).unwrap_or_default();
        layouts.push(Layout::new("CANopen, MEI type 13", Direction::Request, "", rows));
    }
    let others = DIALECTS
        .iter()
        .flat_map(|dialect: &&'static Dialect| dialect.kinds.iter().map(move |kind| (*dialect, *kind)));
    for (dialect, kind) in others.filter(|(_, kind)| kinds.iter().any(|own| own.function == kind.function)) {
        let Some(rows) = carried(carrier, kind.pdu(dialect)) else { continue };
        let title = format!("{}, where set so: {}", direction_name(kind.direction), dialect.label);
        layouts.push(Layout::new(&title, kind.direction, dialect.note, rows));
    }
    layouts
}

/// The parameter channel, whose last four bytes depend on what is asked and what comes of it.
fn channel_layouts() -> Vec<Layout> {
    let settings = profibus::Settings::default();
    let asked = |service, length| {
        let mut channel = Channel::new(Direction::Request, &settings);
        channel.ask(service, length, 1);
        channel
    };
    let answered = |request: &Channel, refusal| {
        let mut channel = Channel::new(Direction::Response, &settings);
        channel.confirm(request, refusal);
        channel
    };
    let (read, write) = (asked(Service::Read, 1), asked(Service::Write, 4));
    let refusal = Refusal::all().next().map(|(refusal, _)| refusal);
    let request = profibus::parameter_channel::REQUEST.spec.note;
    let response = profibus::parameter_channel::RESPONSE.spec.note;
    [
        ("Read, request", request, read.clone()),
        ("Read, response: the value", response, answered(&read, None)),
        ("Write, request: 4 bytes", request, write.clone()),
        ("Write, response", response, answered(&write, None)),
        ("Response with an error", response, answered(&write, refusal)),
    ]
    .into_iter()
    .map(|(title, note, mut channel)| {
        let direction = if title.contains("request") { Direction::Request } else { Direction::Response };
        // Service and error tell; of what is asked for, the length as well.
        let mask = if direction == Direction::Request { 0xB3 } else { 0x83 };
        let begins = Some((channel.control, mask));
        Layout { begins, ..Layout::new(title, direction, note, guide(&mut channel)) }
    })
    .collect()
}

/// A frame of each start delimiter, as the standard numbers them.
const fn frame_bytes(start: u8) -> &'static [u8] {
    match start {
        SD1 => &[0x10, 0x02, 0x01, 0x49, 0x4C, 0x16],
        SD3 => &[0xA2, 0x02, 0x01, 0x5D, 0x41, 0x00, 0x22, 0x00, 0x00, 0x00, 0x00, 0x00, 0xC3, 0x16],
        SD4 => &[0xDC, 0x02, 0x01],
        SC => &[0xE5],
        _ => &[0x68, 0x05, 0x05, 0x68, 0x81, 0x82, 0x6D, 0x3C, 0x3E, 0xEA, 0x16],
    }
}

fn frame_layout(start: u8) -> Layout {
    let bytes = frame_bytes(start);
    let direction = Fdl::direction(bytes).unwrap_or(Direction::Request);
    let mut frame = (profibus_fdl::PROTOCOL.expect)(bytes, direction, &Settings::default());
    walk::fill(frame.as_mut(), bytes);
    Layout::new("Frame", direction, "", guide(frame.as_mut()))
}

/// The telegrams of a bus.
pub(super) fn items(book: Book) -> Vec<Item> {
    match book {
        Book::Modbus => functions().into_iter().chain(around()).collect(),
        Book::Profibus => services().into_iter().chain(frames()).collect(),
        Book::Device(_) => Vec::new(),
    }
}

fn item(
    book: Book,
    key: String,
    number: String,
    label: &str,
    numbers: Vec<(u64, u64)>,
    topic: Topic,
) -> Item {
    Item {
        book,
        chapter: Chapter::Telegrams,
        key,
        number,
        label: label.to_owned(),
        numbers,
        names: topic.code.replace(", ", "\n"),
        notes: topic.note.to_owned(),
        folded: String::new(),
        about: About::Telegram(topic),
    }
}

fn functions() -> Vec<Item> {
    let mut groups: Vec<Vec<&'static modbus::Kind>> = Vec::new();
    for kind in modbus::KINDS.iter().chain(modbus::OTHER_KINDS) {
        match groups.last_mut() {
            Some(group) if group[0].function == kind.function => group.push(kind),
            _ => groups.push(vec![kind]),
        }
    }
    let of_group = |kinds: Vec<&'static modbus::Kind>| {
        let kind = kinds[0];
        let code = u64::from(kind.function);
        let (number, numbers) = match kind.function {
            0 => ("other".to_owned(), Vec::new()),
            modbus::EXCEPTION => ("+ 80h".to_owned(), vec![(code, code)]),
            _ => (code.to_string(), vec![(code, code)]),
        };
        let code = format!("function {code}, {}", hex_value(code, 1));
        let Spec { label, note, source, .. } = kind.spec;
        let code = if numbers.is_empty() { String::new() } else { code };
        let key = if numbers.is_empty() { key_of(label) } else { kind.function.to_string() };
        item(
            Book::Modbus,
            key,
            number,
            label,
            numbers,
            Topic { subject: Subject::Function(kinds), code, note, source },
        )
    };
    groups.into_iter().map(of_group).collect()
}

/// What carries a PDU.
fn around() -> Vec<Item> {
    let frames: [(&'static Protocol, &str, &str, &str); 3] = [
        (
            &modbus_rtu::PROTOCOL,
            "RTU",
            "A telegram on a serial line: unit, PDU, CRC. Between two telegrams the line is silent for 3.5 characters.",
            "Modbus over serial line V1.02, 2.5.1",
        ),
        (
            &modbus_tcp::PROTOCOL,
            "TCP",
            "A telegram on a network: a header of 7 bytes before the PDU, and no checksum of its own.",
            "Modbus messaging on TCP/IP V1.0b, 3.1",
        ),
        (
            &modbus_ascii::PROTOCOL,
            "ASCII",
            "A telegram on a serial line, each byte as two hex digits: a colon, unit, PDU, LRC, carriage return and line feed.",
            "Modbus over serial line V1.02, 2.5.2",
        ),
    ];
    let of_frame =
        |(protocol, short, note, source): (&'static Protocol, &str, &'static str, &'static str)| {
            let topic = Topic { subject: Subject::Around(protocol), code: "frame".to_owned(), note, source };
            item(Book::Modbus, key_of(short), short.to_owned(), protocol.label, Vec::new(), topic)
        };
    frames.into_iter().map(of_frame).collect()
}

fn services() -> Vec<Item> {
    let mut groups: Vec<Vec<&'static profibus::Kind>> = Vec::new();
    let listed = profibus::KINDS.iter().chain(profibus::OTHER_KINDS);
    for kind in listed.filter(|kind| kind.spec.label != profibus::parameter_channel::REQUEST.spec.label) {
        match groups.last_mut() {
            Some(group) if group[0].spec.label == kind.spec.label => group.push(kind),
            _ => groups.push(vec![kind]),
        }
    }
    let of_group = |kinds: Vec<&'static profibus::Kind>| {
        let kind = kinds[0];
        let Spec { label, short, note, source, .. } = kind.spec;
        let (number, numbers) = match kind.sap {
            Some(sap) => (sap.to_string(), vec![(u64::from(sap), u64::from(sap))]),
            None if kind.spec.label == profibus::KINDS[0].spec.label => ("no SAP".to_owned(), Vec::new()),
            None => ("other".to_owned(), Vec::new()),
        };
        let point = kind
            .sap
            .map_or(String::new(), |sap| format!("access point {sap} (SAP), {}", hex_value(sap.into(), 1)));
        let code = if short == label {
            point
        } else {
            [short, &point].into_iter().filter(|it| !it.is_empty()).collect::<Vec<_>>().join(", ")
        };
        item(
            Book::Profibus,
            key_of(label),
            number,
            label,
            numbers,
            Topic { subject: Subject::Service(kinds), code, note, source },
        )
    };
    let Spec { label, note, source, .. } = profibus::parameter_channel::REQUEST.spec;
    let topic =
        Topic { subject: Subject::Channel, code: "the first 8 bytes of user data".to_owned(), note, source };
    let channel = item(Book::Profibus, key_of(label), "no SAP".to_owned(), label, Vec::new(), topic);
    std::iter::once(channel).chain(groups.into_iter().map(of_group)).collect()
}

fn frames() -> Vec<Item> {
    let source = "EN 50170, volume 2, part 4 (FDL)";
    let of_frame = |(start, short, label, note): (u8, &str, &str, &'static str)| {
        let number = u64::from(start);
        let code = format!("start delimiter {}", hex_value(number, 1));
        let topic = Topic { subject: Subject::Frame(start), code, note, source };
        item(Book::Profibus, key_of(short), short.to_owned(), label, vec![(number, number)], topic)
    };
    [
        (SD1, "SD1", "Frame without data", "A frame that asks or answers without data."),
        (SD2, "SD2", "Frame with data of any length", "The usual frame: its length stands in it, twice."),
        (SD3, "SD3", "Frame with 8 bytes of data", "A frame whose data always have 8 bytes."),
        (SD4, "SD4", "Token", "Hands the right to ask to the next master. It has no checksum."),
        (
            SC,
            "SC",
            "Short acknowledgement",
            "One byte: the request was taken, and there is nothing to answer.",
        ),
    ]
    .map(of_frame)
    .into_iter()
    .collect()
}
