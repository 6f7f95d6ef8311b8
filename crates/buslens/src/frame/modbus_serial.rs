//! The Modbus frame of a serial line: unit address (1 byte), PDU, check. The two modes of the
//! standard, RTU and ASCII, differ in the check and in how bytes are put on the line.
//!
//! Source: Modbus over serial line V1.02, sections 2.2 and 2.5.

use super::{Cargo, Content, Fit, Frame, Verdict};
use crate::field::{Direction, Message, Name, Role, Severity, Span, Spec};
use crate::message;
use crate::modbus::{Dialect, EXCEPTION, KINDS, LONGEST_PDU, Pdu, Server};
use crate::walk::{Algorithm, Telegram, Walk, Walker};

/// The unit that everybody on the line listens to.
pub const BROADCAST: u8 = 0;

/// RTU or ASCII.
#[derive(Debug)]
pub struct Mode {
    pub check: Spec,
    pub algorithm: &'static Algorithm,
}

impl Mode {
    /// The bytes around the PDU: unit and check.
    pub const fn around(&self) -> usize {
        1 + self.algorithm.width
    }

    /// The fewest bytes of a frame: unit, function code, check.
    pub const fn shortest(&self) -> usize {
        1 + self.around()
    }

    /// The most bytes of a frame.
    pub const fn longest(&self) -> usize {
        LONGEST_PDU + self.around()
    }

    /// An empty frame to read `bytes` into.
    pub fn expect(&'static self, bytes: &[u8], direction: Direction, dialect: &'static Dialect) -> Serial {
        let [unit, function] = [0, 1].map(|at| bytes.get(at).copied().unwrap_or_default());
        Serial { mode: self, unit, pdu: Pdu::expect(function, direction, dialect) }
    }

    /// The bytes of the PDU in a frame of `bytes`; empty where the frame is too short for one.
    pub fn pdu_bytes<'a>(&self, bytes: &'a [u8]) -> &'a [u8] {
        if bytes.len() < self.shortest() {
            return &[];
        }
        Span::new(1, bytes.len() - self.algorithm.width).of(bytes)
    }

    /// What the check says.
    pub fn verdict(&self, bytes: &[u8]) -> Verdict {
        if bytes.len() < self.shortest() {
            return Verdict::Unchecked;
        }
        let (covered, check) = bytes.split_at(bytes.len() - self.algorithm.width);
        let found = check.iter().fold(0, |found, byte| found << 8 | u64::from(*byte));
        if self.algorithm.wire(covered) == found { Verdict::Right } else { Verdict::Wrong }
    }
}

/// A frame of a serial line.
pub struct Serial {
    pub mode: &'static Mode,
    pub unit: u8,
    pub pdu: Pdu,
}

impl Telegram for Serial {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        let start = w.mark();
        let Self { mode, unit, pdu } = self;
        w.window(mode.algorithm.width, &mut |w| walk_unit_and_pdu(w, unit, pdu))?;
        w.checksum(&self.mode.check, self.mode.algorithm, start)?;
        let length = w.mark() - start;
        check_length(w, &self.mode.check, length, self.mode.longest());
        Ok(())
    }
}

impl Frame for Serial {
    fn content(&self) -> Content<'_> {
        Content::Modbus { server: server(self.unit), pdu: &self.pdu }
    }

    fn meaning(&self) -> Message {
        self.pdu.body.meaning(server(self.unit))
    }

    fn answer(&mut self, request: &Content<'_>) {
        answer(&mut self.pdu, request);
    }

    fn pdu(&mut self) -> Option<&mut Pdu> {
        Some(&mut self.pdu)
    }

    fn back(&self, response: Cargo) -> Option<Box<dyn Frame>> {
        let Cargo::Modbus(pdu) = response else { return None };
        Some(Box::new(Self { mode: self.mode, unit: self.unit, pdu }))
    }
}

/// A frame of a serial line without its check.
pub struct Unchecked {
    pub unit: u8,
    pub pdu: Pdu,
}

impl Unchecked {
    /// An empty frame to read `bytes` into.
    pub fn expect(bytes: &[u8], direction: Direction, dialect: &'static Dialect) -> Self {
        let [unit, function] = [0, 1].map(|at| bytes.get(at).copied().unwrap_or_default());
        Self { unit, pdu: Pdu::expect(function, direction, dialect) }
    }
}

impl Telegram for Unchecked {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        walk_unit_and_pdu(w, &mut self.unit, &mut self.pdu)
    }
}

impl Frame for Unchecked {
    fn content(&self) -> Content<'_> {
        Content::Modbus { server: server(self.unit), pdu: &self.pdu }
    }

    fn meaning(&self) -> Message {
        self.pdu.body.meaning(server(self.unit))
    }

    fn answer(&mut self, request: &Content<'_>) {
        answer(&mut self.pdu, request);
    }

    fn pdu(&mut self) -> Option<&mut Pdu> {
        Some(&mut self.pdu)
    }

    fn back(&self, response: Cargo) -> Option<Box<dyn Frame>> {
        let Cargo::Modbus(pdu) = response else { return None };
        Some(Box::new(Self { unit: self.unit, pdu }))
    }
}

/// What both kinds of frames have in common.
fn walk_unit_and_pdu(w: &mut dyn Walker, unit: &mut u8, pdu: &mut Pdu) -> Walk {
    w.u8(&UNIT, unit)?;
    if *unit > 247 {
        w.remark(
            &UNIT,
            Severity::Warning,
            "reserved-address",
            message!("unit {unit} is reserved: units have the numbers 1 to 247", unit = *unit),
        );
    }
    let walk = pdu.walk(w);
    check_broadcast(w, *unit, pdu);
    walk
}

fn check_broadcast(w: &mut dyn Walker, unit: u8, pdu: &Pdu) {
    if unit != BROADCAST {
        return;
    }
    let reads = pdu.body.only_reads() || pdu.body.access().is_some_and(|access| access.reads.is_some());
    if pdu.direction == Direction::Response {
        w.remark(
            &UNIT,
            Severity::Error,
            "broadcast-answered",
            message!("unit 0 is the broadcast address: nobody answers from it"),
        );
    } else if reads {
        w.remark(
            &UNIT,
            Severity::Error,
            "broadcast-read",
            message!("a broadcast can only write: no unit answers a read from all"),
        );
    }
}

/// Says of the check `spec` where a frame of `length` bytes is longer than `longest`.
pub fn check_length(w: &mut dyn Walker, spec: &'static Spec, length: usize, longest: usize) {
    if length > longest {
        w.remark(
            spec,
            Severity::Error,
            "frame-too-long",
            message!(
                "the frame has {length} bytes; in this protocol it has at most {longest}",
                length = length,
                longest = longest
            ),
        );
    }
}

/// Unit and function, which request and response have in common. Nobody answers a broadcast.
pub fn exchange(bytes: &[u8]) -> Option<u64> {
    let [unit, function, ..] = bytes else { return None };
    (*unit != BROADCAST).then(|| u64::from(*unit) << 8 | u64::from(function & !EXCEPTION))
}

/// Takes from the request what `pdu`, its response, does not repeat.
pub fn answer(pdu: &mut Pdu, request: &Content<'_>) {
    if let Content::Modbus { pdu: asked, .. } = request {
        pdu.answer(asked);
    }
}

/// Whom a frame with this address is for or from.
fn server(unit: u8) -> Server {
    match unit {
        BROADCAST => Server::All,
        unit => Server::Unit(unit),
    }
}

/// What the PDU of a frame without a right check says for the frame's protocol.
pub fn fit(pdu: &[u8], dialect: &'static Dialect) -> Fit {
    /// One function code in ten is known; a length that fits is as rare again.
    const KNOWN: u32 = 3;
    const LENGTH: u32 = 4;
    match pdu_fit(pdu, dialect) {
        PduFit::Length => Fit {
            bits: KNOWN + LENGTH,
            reason: message!("function code and length fit, but the checksum does not"),
        },
        PduFit::Function => Fit {
            bits: KNOWN,
            reason: message!("the function code is known, but checksum and length do not fit"),
        },
        PduFit::Nothing => Fit { bits: 0, reason: message!("nothing else fits better") },
    }
}

/// How far a PDU is like one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PduFit {
    Nothing,
    /// Its function code is known.
    Function,
    /// Its length is one that the function has.
    Length,
}

pub fn pdu_fit(pdu: &[u8], dialect: &'static Dialect) -> PduFit {
    let Some(function) = pdu.first().copied() else { return PduFit::Nothing };
    let known = |function| dialect.kinds.iter().chain(KINDS).any(|kind| kind.function == function);
    if !known(function & !EXCEPTION) {
        return PduFit::Nothing;
    }
    let fits = |direction| Pdu::kind(function, direction, dialect).length.fits(pdu);
    let exception = function & EXCEPTION != 0;
    if fits(Direction::Response) || (!exception && fits(Direction::Request)) {
        PduFit::Length
    } else {
        PduFit::Function
    }
}

static UNIT: Spec = Spec::new("unit", "Unit address")
    .short("Unit")
    .role(Role::Unit)
    .note("Address of the device (older texts: slave address), 1 to 247; 0 addresses all devices.")
    .source("Modbus over serial line V1.02, 2.2")
    .names(&[Name { value: 0, label: "all units (broadcast)", note: "All units act on it; none answers." }]);
