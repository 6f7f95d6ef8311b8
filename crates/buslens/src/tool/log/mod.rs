//! Whole logs: any layout, any size, read in pieces; what was said in them, and what went wrong.
//!
//! A [`Log`] keeps some eight bytes for each telegram, and of small files the telegram's own; those of large files
//! are read again. The tree of fields is made for those that somebody looks at, by [`Log::report`], which reads
//! their lines again. While a file is read, all that is settled can be looked at: see [`Log::look`].

mod bytes;
#[cfg(feature = "captures")]
mod capture_file;
mod digest;
mod excerpt;
mod filter;
mod findings;
mod format;
mod lanes;
mod list;
#[cfg(feature = "captures")]
mod packets;
mod pictures;
mod places;
#[cfg(feature = "captures")]
mod redact;
mod rows;
mod seen;
mod slices;
mod story;
mod sums;

pub use crate::dialogue::traffic::{Dialog, Entries, Entry, Lines, Minutes, Role, Statistics};
pub use crate::text::{LAYOUTS, Layout, Marks, Numbers, Place};
pub use bytes::Bytes;
#[cfg(feature = "captures")]
pub use capture_file::CaptureFile;
pub use excerpt::Excerpt;
pub use filter::{Filter, Wanted, is_error};
pub use findings::Finding;
pub use format::{Format, Refusal};
pub use lanes::{Lane, Lanes, Mark};
pub use list::{Overview, Row, State, Unit, brief};
pub use pictures::{Bucket, Held, Point, Timeline};
#[cfg(feature = "captures")]
pub use redact::{Hidden, Kind, Redacted, Replaced};
pub use seen::{Seen, seen};
pub use slices::{Division, Slice};
pub use story::time_text;

use slices::Passed;
use sums::Sums;

use std::cell::{Cell, OnceCell};
use std::collections::HashMap;

use super::Options;
use super::decode::Report;
#[cfg(feature = "captures")]
use crate::capture::{Capture, Fault, Segment};
use crate::dialogue::traffic::{Chunk, Hint, Traffic, Written, statistics};
use crate::dialogue::{self, Candidate, Choice};
#[cfg(feature = "captures")]
use crate::field::Facts;
use crate::frame::split::{Splitter, can_split};
use crate::frame::{PROTOCOLS, Protocol, Settings, modbus_ascii, modbus_pdu};
use crate::message;
use crate::text::{self, Event, Form, Reader, Sender};

/// How a log is to be read, where a person says so.
#[derive(Clone, Debug, Default)]
pub struct Reading {
    pub input: Input,
    /// How numbers are written.
    pub numbers: Option<Numbers>,
    /// What was marked in one line.
    pub marks: Option<Marks>,
}

/// What a file is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Input {
    /// Its beginning tells.
    #[default]
    Auto,
    Text,
    /// Bytes of a line without anything between them.
    Binary,
    /// A capture of a network.
    Capture,
}

impl Input {
    /// The inputs with their stable words.
    pub const KEYS: [(&'static str, Self); 4] =
        [("auto", Self::Auto), ("text", Self::Text), ("binary", Self::Binary), ("pcap", Self::Capture)];

    /// The input with this key.
    pub fn of(key: &str) -> Option<Self> {
        Self::KEYS.into_iter().find(|(word, _)| *word == key).map(|(_, input)| input)
    }
}

/// Where a log's lines can be read again.
pub trait Source {
    /// Up to `length` bytes from `from` on.
    fn read(&self, from: u64, length: usize) -> Vec<u8>;
}

impl Source for &[u8] {
    fn read(&self, from: u64, length: usize) -> Vec<u8> {
        let from = usize::try_from(from).unwrap_or(usize::MAX).min(self.len());
        self[from..self.len().min(from + length)].to_vec()
    }
}

/// A log that is read, or was.
#[derive(Debug)]
pub struct Log {
    pub(super) options: Options,
    format: Format,
    form: Form,
    /// What most telegrams are, and why.
    choice: Choice,
    input: Way,
    traffic: Traffic,
    ports: Ports,
    lines: u32,
    taken: u64,
    full: bool,
    /// Of a log that can be read in slices.
    passed: Option<Passed>,
    /// A file in UTF-16, as it would be in UTF-8.
    transcoded: Option<Vec<u8>>,
    fault: Option<String>,
    statistics: Statistics,
    /// Some responses took much longer than others.
    some_slow: bool,
    sums: OnceCell<Sums>,
    /// The telegrams that set up what others mean.
    teaching: OnceCell<Vec<usize>>,
}

/// How the bytes come out of the file.
#[derive(Debug)]
enum Way {
    Text(Box<Reader>),
    Utf16 {
        reader: Box<Reader>,
        encoding: text::Encoding,
        odd: Vec<u8>,
    },
    Stream,
    #[cfg(feature = "captures")]
    Capture(Box<dyn Captured>),
    #[cfg(feature = "captures")]
    Packets(Box<packets::Packets>),
}

/// A capture that is read from its file. It stands behind a trait so that a program that never opens one does
/// without what reads the file: 10 kB of the page's first part.
#[cfg(feature = "captures")]
trait Captured: std::fmt::Debug + Send {
    fn push(&mut self, part: &[u8], sink: &mut dyn FnMut(Segment<'_>)) -> Result<(), Fault>;
    fn finish(&mut self, sink: &mut dyn FnMut(Segment<'_>)) -> Result<(), Fault>;
    fn capture(&self) -> &Capture;
}

#[cfg(feature = "captures")]
impl Captured for Capture {
    fn push(&mut self, part: &[u8], sink: &mut dyn FnMut(Segment<'_>)) -> Result<(), Fault> {
        self.push(part, sink)
    }

    fn finish(&mut self, sink: &mut dyn FnMut(Segment<'_>)) -> Result<(), Fault> {
        self.finish(sink)
    }

    fn capture(&self) -> &Capture {
        self
    }
}

/// Makes what reads the file of a capture.
type Captures = fn() -> Way;

#[cfg(feature = "captures")]
const CAPTURES: Option<Captures> = Some(|| Way::Capture(Box::new(Capture::default())));
#[cfg(not(feature = "captures"))]
const CAPTURES: Option<Captures> = None;

/// Reads a file that is in memory: a log, a capture, a stream, or plain lines of bytes, as pasted.
pub fn decode_file(file: &[u8], reading: &Reading, options: Options) -> Result<Report, Refusal> {
    report(Log::read(file, reading, options.clone()), file, options)
}

/// Reads a text that was typed or pasted as [`decode_file`] reads files. It is no file of a capture, though it
/// may show packets: a program that calls nothing else does without what reads those files.
pub fn decode_pasted(text: &str, options: Options) -> Result<Report, Refusal> {
    let log = Log::read_with(None, text.as_bytes(), &Reading::default(), options.clone());
    report(log, text.as_bytes(), options)
}

fn report(log: Result<Log, Refusal>, file: &[u8], options: Options) -> Result<Report, Refusal> {
    match log {
        // Nothing in it is nothing wrong.
        Err(Refusal::Empty) => Ok(Report::nothing("", options)),
        Err(refusal) => Err(refusal),
        // What a display shows is text, too.
        Ok(log) if log.entries().is_empty() && matches!(log.format, Format::Text { .. }) => {
            Ok(log.typed_report(&String::from_utf8_lossy(file)))
        }
        Ok(log) => Ok(log.whole_report(&file)),
    }
}

/// Reads a text that a person types or pastes, and says of each character that should be a byte and is none
/// what is wrong with it.
pub fn decode(text: &str, options: Options) -> Report {
    let reading = Reading { input: Input::Text, ..Reading::default() };
    match Log::read_with(None, text.as_bytes(), &reading, options.clone()) {
        Ok(log) => log.typed_report(text),
        Err(_) => Report::nothing(text, options),
    }
}

/// What a file's beginning must hold at least, where the file has so much, for [`Log::open`].
pub const BEGINNING: usize = 1 << 16;

/// Of files up to this size all bytes of telegrams are kept: it does no harm when they are written to meanwhile.
pub const SMALL: u64 = 32 << 20;

/// So much memory is tried for before the next part of a large file is taken. A device that does not have it has
/// just enough left to show what was read.
const SPARE: usize = 48 << 20;

fn has_room() -> bool {
    Vec::<u8>::new().try_reserve_exact(SPARE).is_ok()
}

impl Log {
    /// Begins to read a file of `size` bytes by its beginning, which is to be pushed all the same.
    pub fn open(beginning: &[u8], size: u64, reading: &Reading, options: Options) -> Result<Self, Refusal> {
        Self::open_with(CAPTURES, beginning, size, reading, options)
    }

    fn open_with(
        captures: Option<Captures>,
        beginning: &[u8],
        size: u64,
        reading: &Reading,
        mut options: Options,
    ) -> Result<Self, Refusal> {
        options.take_device();
        let format::Told { format, encoding, dumps } = format::tell(beginning, reading)?;
        let beginning = encoding.text(beginning);
        let numbers = reading.numbers.or(match format {
            Format::Text { numbers, .. } => numbers,
            _ => None,
        });
        let is_text = matches!(format, Format::Text { .. });
        let counted = is_text && text::counted(&beginning, numbers);
        let flow = if is_text && reading.marks.is_none() { text::flow(&beginning, numbers) } else { None };
        let quoted = is_text && text::quoted(&beginning);
        let form = Form { numbers, counted, quoted, flow, marks: reading.marks.clone() };
        #[cfg(feature = "captures")]
        let packets = if dumps { packets::Packets::of(&beginning, &form) } else { None };
        #[cfg(not(feature = "captures"))]
        let packets = None::<()>.filter(|()| dumps);
        let of_network = packets.is_some() || matches!(format, Format::Capture { .. });
        let choice = choose(&format, of_network, &beginning, &form, &options);
        let mut traffic = Traffic::new(choice.protocol, &options.settings.frame);
        if form.flow.is_some() {
            traffic.flow();
        }
        if options.protocol.is_some() && is_text {
            traffic.by_hand();
        }
        traffic.directed(options.direction);
        if size > SMALL {
            traffic.leave_in_file();
        }
        if !is_text {
            traffic.untyped();
        }
        let reader = || Box::new(Reader::new(form.clone()));
        let input = match format {
            Format::Text { .. } if encoding.is_utf16() => {
                Way::Utf16 { reader: reader(), encoding, odd: Vec::new() }
            }
            #[cfg(feature = "captures")]
            Format::Text { .. } if let Some(packets) = packets => Way::Packets(Box::new(packets)),
            Format::Text { .. } => Way::Text(reader()),
            Format::Stream => {
                traffic.stream();
                Way::Stream
            }
            Format::Capture { .. } => captures.ok_or(Refusal::NoCaptures)?(),
        };
        let transcoded = matches!(input, Way::Utf16 { .. }).then(Vec::new);
        Ok(Self {
            options,
            format,
            form,
            choice,
            input,
            traffic,
            ports: Ports::default(),
            lines: 0,
            taken: 0,
            full: false,
            passed: None,
            transcoded,
            fault: None,
            statistics: Statistics::default(),
            some_slow: false,
            sums: OnceCell::new(),
            teaching: OnceCell::new(),
        })
    }

    /// Reads a whole file that is in memory.
    pub fn read(file: &[u8], reading: &Reading, options: Options) -> Result<Self, Refusal> {
        Self::read_with(CAPTURES, file, reading, options)
    }

    fn read_with(
        captures: Option<Captures>,
        file: &[u8],
        reading: &Reading,
        options: Options,
    ) -> Result<Self, Refusal> {
        let beginning = &file[..file.len().min(BEGINNING)];
        let mut log = Self::open_with(captures, beginning, file.len() as u64, reading, options)?;
        log.push(file);
        log.finish();
        Ok(log)
    }

    /// Takes the next part of the file; `false` if no more can be kept.
    pub fn push(&mut self, mut part: &[u8]) -> bool {
        while part.len() >= self.before_mark() {
            let (before, behind) = part.split_at(self.before_mark());
            if !self.take_part(before) {
                return false;
            }
            if let Some(pass) = self.passed.as_ref().map(Passed::mark) {
                pass(self);
            }
            part = behind;
        }
        self.take_part(part)
    }

    /// Takes a part with no mark in it.
    fn take_part(&mut self, part: &[u8]) -> bool {
        let Self { input, traffic, ports, full, taken, transcoded, .. } = self;
        let mut room = *taken <= SMALL || has_room();
        let mut take = |event: Event<'_>| room &= self::take(event, traffic, ports);
        match input {
            Way::Text(reader) => reader.push(part, &mut take),
            Way::Utf16 { reader, encoding, odd } => {
                odd.extend_from_slice(part);
                let rest = odd.split_off(encoding.whole(odd));
                let whole = std::mem::replace(odd, rest);
                let transcoded = transcoded.get_or_insert_default();
                let text =
                    if transcoded.is_empty() { encoding.text(&whole) } else { encoding.further(&whole) };
                reader.push(&text, &mut take);
                transcoded.extend_from_slice(&text);
            }
            Way::Stream => {
                // Browsers make code quick between two calls of it, not within one.
                const PART: usize = 1 << 14;
                let mut before = *taken;
                for bytes in part.chunks(PART) {
                    let written = Some(Written { from: 0, step: 1 });
                    let chunk = Chunk { bytes, joins: true, offset: before, written, ..Chunk::default() };
                    room &= traffic.take(chunk);
                    before += bytes.len() as u64;
                }
            }
            #[cfg(feature = "captures")]
            Way::Capture(capture) => {
                let mut segment = |segment: Segment<'_>| {
                    room &= traffic.take(of_segment(&segment));
                };
                if let Err(problem) = capture.push(part, &mut segment) {
                    self.fault.get_or_insert(problem.to_string());
                    room = false;
                }
            }
            #[cfg(feature = "captures")]
            Way::Packets(packets) => {
                packets.push(part, &mut |found| room &= take_of_packet(found, traffic));
            }
        }
        *taken += part.len() as u64;
        *full |= !room;
        room
    }

    /// Counts what was settled so far, so that it can be looked at while the rest is read.
    pub fn look(&mut self) {
        self.statistics = statistics(&self.traffic);
        let mut dialogs = self.statistics.dialogs.iter();
        self.some_slow = dialogs.any(|dialog| dialog.worst.is_some_and(|worst| list::is_slow(dialog, worst)));
        self.sums.take();
        self.teaching.take();
        if let Way::Text(reader) | Way::Utf16 { reader, .. } = &self.input {
            self.lines = reader.lines();
        }
    }

    /// The file ends, or is not read any further.
    pub fn finish(&mut self) {
        self.end();
        self.look();
    }

    /// The same, but nothing is counted.
    fn end(&mut self) {
        let Self { input, traffic, ports, transcoded, .. } = self;
        let mut take = |event: Event<'_>| _ = self::take(event, traffic, ports);
        if let Way::Utf16 { reader, encoding, odd } = input {
            // Half a character at the very end.
            let text = encoding.further(odd);
            reader.push(&text, &mut take);
            transcoded.get_or_insert_default().extend_from_slice(&text);
        }
        match input {
            Way::Text(reader) | Way::Utf16 { reader, .. } => {
                reader.finish(&mut take);
            }
            Way::Stream => {}
            #[cfg(feature = "captures")]
            Way::Capture(capture) => {
                let mut segment = |segment: Segment<'_>| {
                    traffic.take(of_segment(&segment));
                };
                if let Err(problem) = capture.finish(&mut segment) {
                    self.fault.get_or_insert(problem.to_string());
                }
            }
            #[cfg(feature = "captures")]
            Way::Packets(packets) => {
                let end = packets.finish(&mut |found| _ = take_of_packet(found, traffic));
                self.lines = packets.lines();
                debug_assert!(end.is_ok(), "no file of packets was begun");
            }
        }
        self.traffic.finish();
    }

    /// How many directions of connections carry no telegrams.
    fn foreign(&self) -> usize {
        self.traffic.foreign()
    }

    /// How many connections of a capture were not read, since there are too many.
    fn left_out(&self) -> usize {
        #[cfg(feature = "captures")]
        if let Some(capture) = self.capture() {
            return capture.left_out();
        }
        0
    }

    /// The capture that is read, or that a text shows.
    #[cfg(feature = "captures")]
    fn capture(&self) -> Option<&Capture> {
        match &self.input {
            Way::Capture(capture) => Some(capture.capture()),
            Way::Packets(packets) => Some(packets.capture()),
            _ => None,
        }
    }

    /// What the file is.
    pub fn format(&self) -> &Format {
        &self.format
    }

    /// What most of its telegrams are.
    pub fn protocol(&self) -> &'static Protocol {
        self.choice.protocol
    }

    /// Its telegrams, as far as they are settled: all of them once it is [finished](Self::finish).
    pub fn entries(&self) -> &Entries {
        self.traffic.entries()
    }

    /// The telegram with this index. There must be one.
    pub fn entry(&self, index: usize) -> Entry {
        let entry = self.traffic.entries().get(index);
        entry.unwrap_or_else(|| panic!("telegram {index} of {}", self.entries().len()))
    }

    /// Unread lines: number and place in the file.
    pub fn unread(&self) -> &Lines {
        self.traffic.lines()
    }

    /// How many lines the file has.
    pub fn lines(&self) -> u32 {
        self.lines
    }

    pub fn statistics(&self) -> &Statistics {
        &self.statistics
    }

    /// What kept the file from being read to its end.
    pub fn fault(&self) -> Option<String> {
        let more = self.full && self.fault.is_none();
        self.fault.clone().or_else(|| {
            more.then(|| {
                "This device has not enough memory for all of the log: the rest was not read.".into()
            })
        })
    }

    /// What tells several lines or connections apart, in the order of [`Entry::port`].
    pub fn port_name(&self, port: u16) -> Option<String> {
        #[cfg(feature = "captures")]
        if let Some(capture) = self.capture() {
            let connection = capture.connections().get(usize::from(port).checked_sub(1)?)?;
            return Some(format!("{} – {}", connection.client, connection.server));
        }
        self.ports.names.get(usize::from(port).checked_sub(1)?).cloned()
    }

    /// How many bytes of memory it takes.
    pub fn memory(&self) -> usize {
        let transcoded = self.transcoded.as_ref().map_or(0, Vec::capacity);
        self.traffic.memory() + transcoded
    }
}

/// Whether a line is nothing but bytes, perhaps with a word who sends them, as a person types it.
fn is_typed(event: &Event<'_>) -> bool {
    /// So far from the beginning of its line at most.
    const LABEL: usize = 16;
    match event {
        Event::Piece(piece) => {
            let labelled = piece.facts.said
                && piece.time.is_none()
                && piece.places.first().is_none_or(|place| place.from < LABEL);
            piece.facts.column || piece.facts.bare || labelled || (piece.facts.slips && piece.time.is_none())
        }
        Event::Unread { .. } => false,
    }
}

/// Takes what was found in a text; `false` if no more telegrams can be kept.
fn take(event: Event<'_>, traffic: &mut Traffic, ports: &mut Ports) -> bool {
    if !is_typed(&event) {
        traffic.untyped();
    }
    let piece = match event {
        Event::Piece(piece) => piece,
        Event::Unread { line, offset } => {
            traffic.pass(line, offset);
            return true;
        }
    };
    traffic.take(Chunk {
        bytes: piece.bytes,
        time: piece.time,
        hint: hint(piece.sender),
        port: ports.number(piece.port),
        joins: piece.joins,
        both_ways: false,
        known_port: false,
        line: piece.line,
        offset: piece.offset,
        written: piece.pairs.and_then(|(from, step)| Some(Written { from: u32::try_from(from).ok()?, step })),
        facts: Some(piece.facts),
        decimal: piece.decimal,
        breaks: piece.breaks,
    })
}

/// Takes what was found in dumps of packets; `false` if no more telegrams can be kept.
#[cfg(feature = "captures")]
fn take_of_packet(found: packets::Found<'_>, traffic: &mut Traffic) -> bool {
    match found {
        packets::Found::Segment(segment) => traffic.take(of_segment(&segment)),
        packets::Found::Unread { line, offset } => {
            traffic.pass(line, offset);
            true
        }
    }
}

#[cfg(feature = "captures")]
fn of_segment<'a>(segment: &Segment<'a>) -> Chunk<'a> {
    use crate::field::Direction;
    /// The port of Modbus TCP.
    ///
    /// Source: Modbus messaging on TCP/IP V1.0b, section 4.3.1.
    const MODBUS: u16 = 502;
    if let Some(sent) = segment.serial {
        return Chunk {
            bytes: segment.bytes,
            time: segment.time,
            hint: sent.map_or(Hint::None, |sent| if sent { Hint::Logger } else { Hint::Other }),
            line: segment.line,
            offset: segment.offset,
            // Nothing stands in the packet but the telegram.
            facts: Some(Facts { bare: true, ..Facts::default() }),
            ..Chunk::default()
        };
    }
    let direction = if segment.from_client { Direction::Request } else { Direction::Response };
    Chunk {
        bytes: segment.bytes,
        time: segment.time,
        hint: Hint::Says(direction),
        // 0 is the line, as in texts.
        port: u16::try_from(segment.connection + 1).unwrap_or(u16::MAX),
        joins: !segment.gap && !segment.datagram,
        both_ways: true,
        known_port: segment.ports.contains(&MODBUS),
        line: segment.line,
        offset: segment.offset,
        ..Chunk::default()
    }
}

fn hint(sender: Option<Sender>) -> Hint {
    match sender {
        None => Hint::None,
        Some(Sender::Says(direction)) => Hint::Says(direction),
        Some(Sender::Logger) => Hint::Logger,
        Some(Sender::Other) => Hint::Other,
    }
}

/// The names that tell several lines and connections of a text apart, numbered from 1.
#[derive(Clone, Debug, Default)]
struct Ports {
    numbers: HashMap<Vec<u8>, u16>,
    names: Vec<String>,
    latest: u16,
}

impl Ports {
    /// The number of the port with this name. A line without one is of the port before it; 0 is where
    /// none was named yet.
    fn number(&mut self, name: Option<&[u8]>) -> u16 {
        /// More share the number of the last one.
        const MOST: usize = 1000;
        let Some(name) = name else { return self.latest };
        let before = usize::from(self.latest).checked_sub(1).and_then(|latest| self.names.get(latest));
        if before.is_some_and(|before| before.as_bytes() == name) {
            return self.latest;
        }
        if !self.numbers.contains_key(name) && self.names.len() < MOST {
            self.names.push(String::from_utf8_lossy(name).into_owned());
            self.numbers.insert(name.to_vec(), self.names.len() as u16);
        }
        self.latest = self.numbers.get(name).copied().unwrap_or(MOST as u16);
        self.latest
    }
}

/// What most telegrams of a file are, by its beginning.
fn choose(format: &Format, of_network: bool, text: &[u8], form: &Form, options: &Options) -> Choice {
    if let Some(protocol) = options.protocol {
        return Choice { protocol, reason: message!("set by hand"), others: Vec::new() };
    }
    if of_network {
        let reason = message!("captures of networks mostly hold it");
        return Choice { protocol: &crate::frame::modbus_tcp::PROTOCOL, reason, others: Vec::new() };
    }
    let settings = &options.settings.frame;
    let pieces = match format {
        Format::Text { .. } if form.flow.is_some() => {
            let bytes = pieces(text, form).into_iter().flat_map(|(bytes, _)| bytes).collect();
            vec![(bytes, false)]
        }
        Format::Text { .. } => pieces(text, form),
        Format::Stream | Format::Capture { .. } => vec![(text.to_vec(), false)],
    };
    // Where nothing parts the telegrams, the protocol that finds most of them is meant.
    let streams: Vec<&[u8]> = pieces
        .iter()
        .map(|(bytes, _)| bytes.as_slice())
        .filter(|bytes| form.flow.is_some() || bytes.len() > 300)
        .collect();
    if !streams.is_empty() {
        return fullest(&streams, settings).0;
    }
    let candidates: Vec<Candidate<'_>> = pieces
        .iter()
        .map(|(bytes, colon)| Candidate { bytes, written_as: colon.then_some(&modbus_ascii::PROTOCOL) })
        .collect();
    let choices = dialogue::protocols(&candidates, settings);
    let count = |choice: &Choice| choices.iter().filter(|other| other.protocol.is(choice.protocol)).count();
    let most =
        choices.iter().enumerate().max_by_key(|(index, choice)| (count(choice), std::cmp::Reverse(*index)));
    match most {
        Some((_, choice)) if choice.protocol.is(&modbus_pdu::PROTOCOL) => {
            // Perhaps each piece is a part of a telegram only.
            let joined = pieces.iter().flat_map(|(bytes, _)| bytes).copied().collect::<Vec<u8>>();
            let (whole, covered) = fullest(&[&joined], settings);
            if covered * 10 > joined.len() * 9 { whole } else { choice.clone() }
        }
        Some((_, choice)) => choice.clone(),
        None => Choice {
            protocol: PROTOCOLS[0],
            reason: message!("nothing else fits better"),
            others: Vec::new(),
        },
    }
}

/// The first pieces of a text, each joined with those that continue it, and whether a colon is
/// before it.
fn pieces(text: &[u8], form: &Form) -> Vec<(Vec<u8>, bool)> {
    const ENOUGH: usize = 300;
    /// So much is read at a time.
    const PART: usize = 1 << 11;
    let mut pieces: Vec<(Vec<u8>, bool)> = Vec::new();
    let mut reader = Reader::new(form.clone());
    let full = Cell::new(false);
    let mut take = |event: Event<'_>| {
        let Event::Piece(piece) = event else { return };
        let last = pieces.len();
        match pieces.last_mut() {
            _ if full.get() => {}
            Some((bytes, _)) if piece.joins => bytes.extend_from_slice(piece.bytes),
            _ if last == ENOUGH => full.set(true),
            _ if piece.facts.column => {}
            _ => pieces.push((piece.bytes.to_vec(), piece.facts.colon)),
        }
    };
    let mut parts = text.chunks(PART);
    while let Some(part) = parts.next().filter(|_| !full.get()) {
        reader.push(part, &mut take);
    }
    reader.finish(&mut take);
    // What is written as characters is told by the bytes that they stand for.
    for (bytes, colon) in &mut pieces {
        if let Some(decoded) = modbus_ascii::from_characters(bytes) {
            (*bytes, *colon) = (decoded, true);
        }
    }
    pieces
}

/// The protocol whose telegrams are most of `streams`, and how many bytes they are.
fn fullest(streams: &[&[u8]], settings: &Settings) -> (Choice, usize) {
    let splitter = Splitter::new(settings.dialect);
    let covered = |protocol: &'static Protocol| -> usize {
        streams.iter().map(|bytes| splitter.covered(protocol, &bytes[..bytes.len().min(1 << 15)])).sum()
    };
    let splitting = PROTOCOLS.iter().copied().filter(|protocol| can_split(protocol));
    let (covered, protocol) = splitting
        .map(|protocol| (covered(protocol), protocol))
        .reduce(|best, other| if other.0 > best.0 { other } else { best })
        .unwrap_or((0, PROTOCOLS[0]));
    let reason = message!("most of its bytes are telegrams of this protocol");
    (Choice { protocol, reason, others: Vec::new() }, covered)
}
