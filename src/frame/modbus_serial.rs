//! What the two serial modes of Modbus have in common: unit address, PDU, and the rules of a line
//! with many units.
//!
//! Source: Modbus over serial line V1.02, section 2.2.

use super::{Content, Fit};
use crate::field::{Direction, Name, Role, Severity, Spec};
use crate::message;
use crate::modbus::{Dialect, EXCEPTION, KINDS, Pdu, Server};
use crate::walk::{Telegram, Walk, Walker};

/// The unit that everybody on the line listens to.
pub const BROADCAST: u8 = 0;

/// Unit and function code of a frame; what is not there is 0.
pub fn head(bytes: &[u8]) -> [u8; 2] {
    [0, 1].map(|at| bytes.get(at).copied().unwrap_or_default())
}

/// Walks unit and PDU, which leave `keep` bytes for the check behind them.
pub fn walk(w: &mut dyn Walker, unit: &mut u8, pdu: &mut Pdu, keep: usize) -> Walk {
    w.window(keep, &mut |w| {
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
    })
}

fn check_broadcast(w: &mut dyn Walker, unit: u8, pdu: &Pdu) {
    if unit != BROADCAST {
        return;
    }
    let reads = pdu.body.only_reads();
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
pub fn server(unit: u8) -> Server {
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
            reason: message!("function code and length fit, though the check does not match"),
        },
        PduFit::Function => {
            Fit { bits: KNOWN, reason: message!("the function code is known; check and length do not fit") }
        }
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
    .note("Which device is meant (older texts: slave address). 1 to 247; 0 speaks to all at once.")
    .source("Modbus over serial line V1.02, 2.2")
    .names(&[Name { value: 0, label: "all units (broadcast)", note: "Every unit obeys, none answers." }]);
