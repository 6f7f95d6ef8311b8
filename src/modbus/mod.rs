//! Modbus protocol data units: function code and data, without address and check.
//!
//! One file for each function code; [`KINDS`] lists them. A function code needs its file, its two
//! lines in [`KINDS`] and a vector in `tests/vectors`.
//!
//! Source: Modbus application protocol V1.1b3, sections 4 to 7; numbers are big-endian (4.2).

mod exception;
pub mod keb;
mod read_holding_registers;
mod read_input_registers;
mod registers;
mod unknown;
mod write_multiple_registers;
mod write_single_register;

pub use registers::Table;

use crate::field::{Direction, Message, Role, Spec};
use crate::message;
use crate::walk::{Telegram, Walk, Walker};

/// Every telegram that a function code has, requests before responses.
pub static KINDS: &[&Kind] = &[
    &read_holding_registers::REQUEST,
    &read_holding_registers::RESPONSE,
    &read_input_registers::REQUEST,
    &read_input_registers::RESPONSE,
    &write_single_register::REQUEST,
    &write_single_register::RESPONSE,
    &write_multiple_registers::REQUEST,
    &write_multiple_registers::RESPONSE,
    &keb::read_long_registers::REQUEST,
    &keb::read_long_registers::RESPONSE,
    &keb::write_long_registers::REQUEST,
    &keb::write_long_registers::RESPONSE,
];

/// The kinds that stand for many function codes: whatever is not in [`KINDS`].
pub static OTHER_KINDS: &[&Kind] = &[&exception::RESPONSE, &unknown::REQUEST, &unknown::RESPONSE];

/// Telegrams as the standard and the manuals lay them out.
pub static STANDARD: Dialect = Dialect {
    key: "standard",
    label: "as the manuals say",
    note: "Every telegram as its manual or the standard describes it.",
    kinds: &[],
};

/// The dialects that a device may speak, the standard first.
pub static DIALECTS: &[&Dialect] = &[&STANDARD];

/// The bit that a server sets in the function code to refuse a request.
pub const EXCEPTION: u8 = 0x80;

/// The most bytes a PDU can have (section 4.1: 256 of a serial frame less address and check).
pub const LONGEST_PDU: usize = 253;

/// One telegram of one function code, in one direction.
#[derive(Debug)]
pub struct Kind {
    pub function: u8,
    pub direction: Direction,
    /// What the telegram is called, and where it is described.
    pub spec: Spec,
    pub length: Length,
    /// An empty body of this kind.
    pub new: fn() -> Box<dyn Body>,
}

impl Kind {
    /// A PDU of this kind with nothing filled in.
    pub fn pdu(&'static self, dialect: &'static Dialect) -> Pdu {
        Pdu { function: self.function, direction: self.direction, dialect, kind: self, body: (self.new)() }
    }
}

/// Telegrams that some devices lay out in a way of their own.
#[derive(Debug)]
pub struct Dialect {
    /// Stable word of settings and exports.
    pub key: &'static str,
    pub label: &'static str,
    pub note: &'static str,
    /// What takes the place of the kinds of the same function code in [`KINDS`].
    pub kinds: &'static [&'static Kind],
}

/// How long a PDU is, told from its first bytes; the function code counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Length {
    Fixed(usize),
    /// The byte at `at` counts the bytes after it, of which there are some, a multiple of `unit`.
    Counted {
        at: usize,
        unit: usize,
    },
    /// Nothing tells.
    Open,
}

impl Length {
    /// The length that the PDU beginning with `bytes` must have, as far as its bytes tell.
    pub fn of(self, bytes: &[u8]) -> Option<usize> {
        match self {
            Self::Fixed(length) => Some(length),
            Self::Counted { at, .. } => bytes.get(at).map(|count| at + 1 + usize::from(*count)),
            Self::Open => None,
        }
    }

    /// Whether `bytes` can be a whole PDU of this length.
    pub fn fits(self, bytes: &[u8]) -> bool {
        match self {
            Self::Fixed(length) => bytes.len() == length,
            Self::Counted { at, unit } => {
                let counted = bytes.len().saturating_sub(at + 1);
                self.of(bytes) == Some(bytes.len()) && counted > 0 && counted.is_multiple_of(unit)
            }
            Self::Open => true,
        }
    }
}

/// What a function code's telegram can say beyond its fields.
pub trait Body: Telegram {
    /// The telegram in one sentence; `who` is the server.
    fn meaning(&self, who: Server) -> Message;

    /// The registers it is about, for exports, devices and pairing.
    fn access(&self) -> Option<Access<'_>> {
        None
    }

    /// The code of a refusal.
    fn exception(&self) -> Option<u8> {
        None
    }

    /// Takes from the request what a response does not repeat, before the response is read.
    fn answer(&mut self, _request: &Access<'_>) {}
}

/// Whom a request is for and a response is from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Server {
    Unit(u8),
    /// A PDU by itself does not say which.
    Unsaid,
    /// Every unit on the line listens, none answers.
    All,
}

impl Server {
    /// Its number on the line.
    pub const fn unit(self) -> Option<u8> {
        match self {
            Self::Unit(unit) => Some(unit),
            Self::Unsaid => None,
            Self::All => Some(0),
        }
    }

    /// "unit 5".
    pub fn name(self) -> Message {
        match self {
            Self::Unit(unit) => message!("unit {unit}", unit = unit),
            Self::Unsaid => message!("the server"),
            Self::All => message!("all units"),
        }
    }
}

/// The registers that a telegram reads or writes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Access<'a> {
    pub table: &'static Table,
    pub write: bool,
    /// Zero-based; a read response does not carry it.
    pub start: Option<u16>,
    pub count: usize,
    /// Empty where the telegram carries no values.
    pub values: &'a [u32],
}

/// A PDU: the function code and what belongs to it.
pub struct Pdu {
    /// As on the wire, with the exception bit.
    pub function: u8,
    pub direction: Direction,
    pub dialect: &'static Dialect,
    pub kind: &'static Kind,
    pub body: Box<dyn Body>,
}

impl Pdu {
    /// The kind that a PDU with `function` on the wire has.
    pub fn kind(function: u8, direction: Direction, dialect: &'static Dialect) -> &'static Kind {
        let mut known = dialect.kinds.iter().chain(KINDS);
        let listed = known.find(|kind| kind.function == function && kind.direction == direction);
        match (listed, direction) {
            (Some(kind), _) => kind,
            (None, Direction::Request) => &unknown::REQUEST,
            (None, Direction::Response) if function & EXCEPTION != 0 => &exception::RESPONSE,
            (None, Direction::Response) => &unknown::RESPONSE,
        }
    }

    /// An empty PDU to read a telegram of `function` into.
    pub fn expect(function: u8, direction: Direction, dialect: &'static Dialect) -> Self {
        Self { function, ..Self::kind(function, direction, dialect).pdu(dialect) }
    }
}

impl Telegram for Pdu {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        let (direction, dialect) = (self.direction, self.dialect);
        let function = w.select(&FUNCTION, 1, self.function.into(), &|function| {
            // One byte wide, so it fits.
            &Self::kind(function as u8, direction, dialect).spec
        })? as u8;
        if function != self.function {
            *self = Self::expect(function, direction, dialect);
        }
        self.body.walk(w)
    }
}

static FUNCTION: Spec = Spec::new("function", "Function code")
    .short("Function")
    .role(Role::Function)
    .note("What the server is to do. A server that refuses sends it back with 80h added.")
    .source("Modbus application protocol V1.1b3, 4.1");
