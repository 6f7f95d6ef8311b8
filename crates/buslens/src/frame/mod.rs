//! Frames: what carries a telegram over a line or a network, with address and check.
//!
//! One file for each; [`PROTOCOLS`] lists them.

pub mod modbus_ascii;
pub mod modbus_pdu;
pub mod modbus_rtu;
pub mod modbus_serial;
pub mod modbus_tcp;
pub mod modbus_unchecked;
mod profibus_bare;
pub mod profibus_fdl;
mod rules;
pub mod split;

use crate::field::{Direction, Message, Spec};
use crate::modbus::{Dialect, Pdu, STANDARD, Server};
use crate::profibus::{self, Body, Kind};
use crate::walk::Telegram;

/// Every protocol. Where bytes fit several equally well, the first one counts.
pub static PROTOCOLS: &[&Protocol] = &[
    &modbus_rtu::PROTOCOL,
    &modbus_tcp::PROTOCOL,
    &modbus_ascii::PROTOCOL,
    &modbus_pdu::PROTOCOL,
    &modbus_unchecked::PROTOCOL,
    &profibus_fdl::PROTOCOL,
    &profibus_bare::PARAMETER_CHANNEL,
    &profibus_bare::USER_DATA,
    &profibus_bare::SET_PRM,
    &profibus_bare::CHK_CFG,
    &profibus_bare::SLAVE_DIAG,
    &profibus_bare::GLOBAL_CONTROL,
];

/// A way to carry telegrams.
#[derive(Debug)]
pub struct Protocol {
    /// Stable word of exports and settings.
    pub key: &'static str,
    pub label: &'static str,
    /// How well bytes fit, and what speaks for it.
    pub fit: fn(&[u8], &Settings) -> Fit,
    /// What the check says.
    pub verdict: fn(&[u8]) -> Verdict,
    /// How many of `bytes` the first telegram takes, where several may come in one piece.
    pub first: fn(&[u8]) -> usize,
    /// The unit or station that is asked or answers.
    pub unit: fn(&[u8]) -> Option<u8>,
    /// What tells who speaks.
    pub speaker: Speaker,
    /// What request and response have in common; `None` for what nobody answers.
    pub exchange: fn(&[u8]) -> Option<u64>,
    /// How many requests can wait for their responses at a time.
    pub waiting: usize,
    /// An empty frame to read the bytes into.
    pub expect: fn(&[u8], Direction, &Settings) -> Box<dyn Frame>,
    /// The characters that stand on the line for the bytes; `None` where the bytes themselves do.
    pub characters: Option<fn(&[u8]) -> String>,
    /// A frame around what is to be sent to this unit; `None` where the protocol carries other things.
    pub carry: fn(u8, Cargo) -> Option<Box<dyn Frame>>,
}

/// What is to be sent.
pub enum Cargo {
    Modbus(Pdu),
    Profibus(&'static Kind, Box<dyn Body>),
}

impl Protocol {
    /// The protocol with this key.
    pub fn of(key: &str) -> Option<&'static Self> {
        PROTOCOLS.iter().copied().find(|protocol| protocol.key == key)
    }

    /// The bus that it is of.
    pub fn bus(&self) -> Bus {
        if self.key.starts_with("profibus") { Bus::Profibus } else { Bus::Modbus }
    }

    /// Whether it is this one.
    pub fn is(&self, other: &Self) -> bool {
        std::ptr::eq(self, other)
    }
}

/// What tells a request from a response.
#[derive(Clone, Copy, Debug)]
pub enum Speaker {
    /// Function code and length of the PDU: gives the PDU, and how many bytes are around it.
    Pdu(fn(&[u8]) -> (&[u8], usize)),
    /// The frame says it.
    Frame(fn(&[u8]) -> Option<Direction>),
    /// There is only one who says such a thing.
    Always(Direction),
    /// The two take turns. The number tells how much a telegram looks like a response (above 0) or a
    /// request (below 0).
    Turns(fn(&[u8]) -> i32),
}

/// The [`exchange`](Protocol::exchange) of a response that fits any request, since it says nothing
/// of it.
pub const ANY_EXCHANGE: u64 = u64::MAX;

/// How well bytes fit a protocol.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// How many bits of random bytes would have to come out right to look so: 16 for a CRC.
    pub bits: u32,
    /// What speaks for the protocol.
    pub reason: Message,
}

/// What a check says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "json", derive(serde::Serialize, serde::Deserialize))]
pub enum Verdict {
    Right,
    Wrong,
    /// Too short to have a check.
    Unchecked,
    /// The protocol has none: what is below it checks.
    NoCheck,
}

impl Verdict {
    /// What it says, in a few words.
    pub const fn words(self) -> &'static str {
        match self {
            Self::Right => "checksum valid",
            Self::Wrong => "checksum wrong",
            Self::Unchecked => "too short to check",
            Self::NoCheck => "no checksum of its own",
        }
    }
}

/// How devices are set up, as far as telegrams depend on it.
#[derive(Clone, Debug)]
pub struct Settings {
    pub dialect: &'static Dialect,
    pub profibus: profibus::Settings,
    /// What the device speaks, where one is chosen: telegrams are more likely of that.
    pub bus: Option<Bus>,
}

/// A family of protocols.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bus {
    Modbus,
    Profibus,
}

impl Default for Settings {
    fn default() -> Self {
        Self { dialect: &STANDARD, profibus: profibus::Settings::default(), bus: None }
    }
}

/// A telegram with all that carries it.
pub trait Frame: Telegram {
    /// What is carried.
    fn content(&self) -> Content<'_>;

    /// The telegram in one sentence.
    fn meaning(&self) -> Message;

    /// Takes from the request what a response does not repeat, before the response is read.
    fn answer(&mut self, request: &Content<'_>);

    /// Its PDU, if it carries one.
    fn pdu(&mut self) -> Option<&mut Pdu> {
        None
    }

    /// What carries `response` back from the one that this request is for; `None` if it cannot.
    fn back(&self, response: Cargo) -> Option<Box<dyn Frame>>;
}

/// What a frame carries.
pub enum Content<'a> {
    /// A PDU for a server or from it.
    Modbus { server: Server, pdu: &'a Pdu },
    /// A telegram of a service, for a slave or from it.
    Profibus { slave: Option<u8>, kind: &'static Kind, body: &'a dyn Body },
    /// Only the frame itself: a token, an acknowledgement.
    Nothing(&'static Spec),
}
