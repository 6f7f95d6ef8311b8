//! Whole packets of a network as dumps in a text: what Wireshark and tcpdump print.

use crate::capture::{Capture, Fault, Segment, Shown};
use crate::text::{Event, Form, Reader};

/// Puts the rows of each packet together, and gives what its connection carries.
#[derive(Debug)]
pub(super) struct Packets {
    reader: Reader,
    capture: Capture,
    packet: Packet,
}

/// The packet whose rows are being read.
#[derive(Debug, Default)]
struct Packet {
    bytes: Vec<u8>,
    time: Option<i64>,
    line: u32,
    offset: u64,
}

/// What comes out: segments, and lines that are no rows of a packet, with their places.
pub(super) enum Found<'a> {
    Segment(Segment<'a>),
    Unread { line: u32, offset: u64 },
}

impl Packets {
    /// If nearly all dumps of `text` are packets.
    pub fn of(text: &[u8], form: &Form) -> Option<Self> {
        let mut dumps: Vec<Vec<u8>> = Vec::new();
        let mut collect = |event: Event<'_>| match event {
            Event::Piece(piece) if piece.facts.dumped => match dumps.last_mut() {
                Some(dump) if piece.joins => dump.extend_from_slice(piece.bytes),
                _ => dumps.push(piece.bytes.to_vec()),
            },
            _ => {}
        };
        let mut reader = Reader::new(form.clone());
        reader.push(text, &mut collect);
        reader.finish(&mut collect);
        // The last one may be cut.
        if dumps.len() > 1 {
            dumps.pop();
        }
        let packets = dumps.iter().filter(|dump| Capture::is_packet(dump)).count();
        (packets > 0 && packets * 10 >= dumps.len() * 9).then(|| Self {
            reader: Reader::new(form.clone()),
            capture: Capture::default(),
            packet: Packet::default(),
        })
    }

    /// Takes the next part of the file.
    pub fn push(&mut self, part: &[u8], sink: &mut dyn FnMut(Found<'_>)) {
        let Self { reader, capture, packet } = self;
        reader.push(part, &mut |event| packet.take(event, capture, sink));
    }

    /// The file ends.
    pub fn finish(&mut self, sink: &mut dyn FnMut(Found<'_>)) -> Result<(), Fault> {
        let Self { reader, capture, packet } = self;
        reader.finish(&mut |event| packet.take(event, capture, sink));
        packet.end(capture, sink);
        capture.finish(&mut |segment| sink(Found::Segment(segment)))
    }

    pub fn capture(&self) -> &Capture {
        &self.capture
    }

    /// How many lines were read.
    pub fn lines(&self) -> u32 {
        self.reader.lines()
    }
}

impl Packet {
    fn take(&mut self, event: Event<'_>, capture: &mut Capture, sink: &mut dyn FnMut(Found<'_>)) {
        match event {
            Event::Piece(piece) if piece.facts.dumped => {
                if !piece.joins {
                    self.end(capture, sink);
                    (self.time, self.line, self.offset) = (piece.time, piece.line, piece.offset);
                }
                self.bytes.extend_from_slice(piece.bytes);
            }
            Event::Piece(piece) => sink(Found::Unread { line: piece.line, offset: piece.offset }),
            Event::Unread { line, offset } => sink(Found::Unread { line, offset }),
        }
    }

    /// No more rows come.
    fn end(&mut self, capture: &mut Capture, sink: &mut dyn FnMut(Found<'_>)) {
        let Self { bytes, time, line, offset } = self;
        let shown = Shown { bytes, time: *time, line: *line, offset: *offset };
        capture.push_packet(shown, &mut |segment| sink(Found::Segment(segment)));
        bytes.clear();
    }
}
