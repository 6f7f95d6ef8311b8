//! The Modbus TCP frame: the MBAP header and the PDU.
//!
//! Header: transaction identifier (2 bytes), protocol identifier (2, always 0), length of what
//! follows (2), unit identifier (1). 8 to 260 bytes; no check, since TCP has its own. Several
//! frames can come in one TCP segment.
//!
//! Source: Modbus messaging on TCP/IP V1.0b, section 3.1.3.

use super::modbus_rtu::RTU;
use super::modbus_serial::{PduFit, answer, check_length, pdu_fit};
use super::{Cargo, Content, Fit, Frame, Protocol, Settings, Speaker, Verdict};
use crate::field::{Direction, Message, Name, Role, Severity, Spec};
use crate::message;
use crate::modbus::{Dialect, LONGEST_PDU, Pdu, Server};
use crate::walk::{Telegram, Walk, Walker};

pub static PROTOCOL: Protocol = Protocol {
    key: "modbus-tcp",
    label: "Modbus TCP",
    fit,
    verdict: |_| Verdict::NoCheck,
    first,
    speaker: Speaker::Pdu(|bytes| (bytes.get(HEADER..).unwrap_or(&[]), HEADER)),
    unit: |bytes| bytes.get(HEADER - 1).copied(),
    exchange: |bytes| match bytes {
        [high, low, _, _, _, _, unit, function, ..] => {
            let function = function & !crate::modbus::EXCEPTION;
            Some([*high, *low, *unit, function].into_iter().fold(0, |key, byte| key << 8 | u64::from(byte)))
        }
        _ => None,
    },
    waiting: 64,
    expect: |bytes, direction, settings| Box::new(Tcp::expect(bytes, direction, settings.dialect)),
    characters: None,
    carry: |unit, cargo| match cargo {
        Cargo::Modbus(pdu) => Some(Box::new(Tcp { transaction: 1, protocol: 0, unit, pdu })),
        Cargo::Profibus(..) => None,
    },
};

/// The bytes of the header, which all come before the PDU.
pub const HEADER: usize = 7;

/// The most bytes of a frame.
pub const LONGEST: usize = HEADER + LONGEST_PDU;

/// Where the bytes begin that the length counts.
const COUNTED_FROM: usize = 6;

/// A Modbus TCP frame.
pub struct Tcp {
    pub transaction: u16,
    pub protocol: u16,
    pub unit: u8,
    pub pdu: Pdu,
}

impl Tcp {
    /// An empty frame to read `bytes` into.
    pub fn expect(bytes: &[u8], direction: Direction, dialect: &'static Dialect) -> Self {
        let function = bytes.get(HEADER).copied().unwrap_or_default();
        Self { transaction: 0, protocol: 0, unit: 255, pdu: Pdu::expect(function, direction, dialect) }
    }
}

/// The length that the header of `bytes` tells for the whole frame, if this can be a header.
fn told(bytes: &[u8]) -> Option<usize> {
    let [_, _, _, _, high, low, ..] = bytes else { return None };
    let counted = usize::from(u16::from_be_bytes([*high, *low]));
    (2..=LONGEST_PDU + 1).contains(&counted).then_some(COUNTED_FROM + counted)
}

/// Whether the protocol identifier is that of Modbus.
fn identified(bytes: &[u8]) -> bool {
    bytes.get(2..4) == Some(&[0, 0])
}

/// The first frame's length, where another header follows it.
fn first(bytes: &[u8]) -> usize {
    match told(bytes) {
        Some(length)
            if length < bytes.len()
                && identified(bytes)
                && identified(&bytes[length..])
                && told(&bytes[length..]).is_some() =>
        {
            length
        }
        _ => bytes.len(),
    }
}

fn fit(bytes: &[u8], settings: &Settings) -> Fit {
    /// Small numbers with zeros before them are common: an RTU request for two registers from 0
    /// looks like a header, too. So the length proves something only together with the function
    /// code, and one that belongs on serial lines does little: two bytes of a CRC can be unit and
    /// such a code.
    const LENGTH: u32 = 12;
    const FUNCTION: u32 = 12;
    let length = told(bytes);
    let whole = length.is_some_and(|length| length == bytes.len() || first(bytes) < bytes.len());
    let to = length.filter(|_| whole).unwrap_or(bytes.len()).max(HEADER);
    let function = bytes.get(HEADER..to).map_or(PduFit::Nothing, |pdu| pdu_fit(pdu, settings.dialect));
    let certain = function == PduFit::Length && !serial_only(bytes, settings);
    let bits = match function {
        PduFit::Nothing => 0,
        _ if certain => FUNCTION,
        PduFit::Length | PduFit::Function => FUNCTION / 2,
    };
    let behind = bytes.get(COUNTED_FROM..).unwrap_or_default();
    match length {
        Some(_) if identified(bytes) && RTU.verdict(behind) == Verdict::Right => Fit {
            bits: LENGTH + FUNCTION,
            reason: message!(
                "behind a Modbus TCP header there is an RTU frame with its CRC, which TCP has not"
            ),
        },
        Some(_) if !identified(bytes) && whole => Fit {
            bits,
            reason: message!("it is laid out as Modbus TCP, though the protocol identifier is not 0"),
        },
        Some(_) if !identified(bytes) => {
            Fit { bits: 0, reason: message!("the protocol identifier is not that of Modbus TCP") }
        }
        Some(_) if whole => Fit {
            bits: if certain { LENGTH + bits } else { bits },
            reason: message!("it begins with a Modbus TCP header whose length counts the bytes behind it"),
        },
        Some(_) if bits > 0 => Fit {
            bits,
            reason: message!("it begins like a Modbus TCP header, though the length does not fit"),
        },
        _ => Fit { bits: 0, reason: message!("it does not begin with a Modbus TCP header") },
    }
}

/// Whether the function of `bytes` is for serial lines.
fn serial_only(bytes: &[u8], settings: &Settings) -> bool {
    Tcp::expect(bytes, Direction::Request, settings.dialect).pdu.kind.serial_only
}

impl Telegram for Tcp {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        let start = w.mark();
        w.u16(&TRANSACTION, &mut self.transaction)?;
        w.u16(&PROTOCOL_ID, &mut self.protocol)?;
        let (unit, pdu) = (&mut self.unit, &mut self.pdu);
        // The length's own two bytes are not counted.
        let length = w.ahead(2, &mut |w| {
            w.u8(&UNIT, unit)?;
            pdu.walk(w)
        });
        w.derived(&LENGTH, 2, length)?;
        w.u8(&UNIT, unit)?;
        let walk = pdu.walk(w);
        if pdu.kind.serial_only {
            w.remark(
                &UNIT,
                Severity::Warning,
                "serial-only",
                message!("this function is for serial lines: a TCP server need not know it"),
            );
        }
        let length = w.mark() - start;
        check_length(w, &LENGTH, length, LONGEST);
        walk
    }
}

impl Frame for Tcp {
    fn content(&self) -> Content<'_> {
        Content::Modbus { server: Server::Unit(self.unit), pdu: &self.pdu }
    }

    fn meaning(&self) -> Message {
        self.pdu.body.meaning(Server::Unit(self.unit))
    }

    fn answer(&mut self, request: &Content<'_>) {
        answer(&mut self.pdu, request);
    }

    fn pdu(&mut self) -> Option<&mut Pdu> {
        Some(&mut self.pdu)
    }

    fn back(&self, response: Cargo) -> Option<Box<dyn Frame>> {
        let Cargo::Modbus(pdu) = response else { return None };
        Some(Box::new(Self { transaction: self.transaction, protocol: self.protocol, unit: self.unit, pdu }))
    }
}

static TRANSACTION: Spec = Spec::new("transaction", "Transaction identifier")
    .short("Transaction")
    .role(Role::Count)
    .note("A number that the client chooses; the response repeats it, so that the two find each other.")
    .source(SOURCE);

static PROTOCOL_ID: Spec = Spec::new("protocol", "Protocol identifier")
    .short("Protocol")
    .role(Role::Count)
    .limits(0, 0)
    .names(&[Name { value: 0, label: "Modbus", note: "" }])
    .note("Always 0.")
    .source(SOURCE);

static LENGTH: Spec = Spec::new("length", "Length")
    .role(Role::Count)
    .note("How many bytes follow: unit identifier and PDU.")
    .source(SOURCE);

static UNIT: Spec = Spec::new("unit", "Unit identifier")
    .short("Unit")
    .role(Role::Unit)
    .note("Which unit behind a gateway is meant. 255 (or 0) where the server itself is.")
    .source(SOURCE)
    .names(&[
        Name { value: 255, label: "the server itself", note: "" },
        Name { value: 0, label: "the server itself", note: "255 is recommended." },
    ]);

const SOURCE: &str = "Modbus messaging on TCP/IP V1.0b, 3.1.3";
