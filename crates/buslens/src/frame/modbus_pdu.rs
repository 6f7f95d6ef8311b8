//! A Modbus PDU by itself: function code and data, without address and check, as manuals and
//! programs' logs often show it. 1 to 253 bytes.
//!
//! Source: Modbus application protocol V1.1b3, section 4.1.

use super::modbus_serial::{PduFit, answer, pdu_fit};
use super::{Cargo, Content, Fit, Frame, Protocol, Speaker, Verdict};
use crate::field::Message;
use crate::message;
use crate::modbus::{EXCEPTION, Pdu, Server};
use crate::walk::{Telegram, Walk, Walker};

pub static PROTOCOL: Protocol = Protocol {
    key: "modbus-pdu",
    label: "Modbus PDU",
    fit: |bytes, settings| match pdu_fit(bytes, settings.dialect) {
        PduFit::Length => {
            Fit { bits: 6, reason: message!("function code and length fit a PDU without frame") }
        }
        _ => Fit { bits: 0, reason: message!("function code and length do not fit a PDU") },
    },
    verdict: |_| Verdict::NoCheck,
    first: <[u8]>::len,
    unit: |_| None,
    speaker: Speaker::Pdu(|bytes| (bytes, 0)),
    exchange: |bytes| bytes.first().map(|function| u64::from(function & !EXCEPTION)),
    waiting: 1,
    expect: |bytes, direction, settings| {
        let function = bytes.first().copied().unwrap_or_default();
        Box::new(Bare { pdu: Pdu::expect(function, direction, settings.dialect) })
    },
    characters: None,
    carry: |_, cargo| match cargo {
        Cargo::Modbus(pdu) => Some(Box::new(Bare { pdu })),
        Cargo::Profibus(..) => None,
    },
};

/// A PDU without a frame.
pub struct Bare {
    pub pdu: Pdu,
}

impl Telegram for Bare {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        self.pdu.walk(w)
    }
}

impl Frame for Bare {
    fn content(&self) -> Content<'_> {
        Content::Modbus { server: Server::Unsaid, pdu: &self.pdu }
    }

    fn meaning(&self) -> Message {
        self.pdu.body.meaning(Server::Unsaid)
    }

    fn answer(&mut self, request: &Content<'_>) {
        answer(&mut self.pdu, request);
    }

    fn pdu(&mut self) -> Option<&mut Pdu> {
        Some(&mut self.pdu)
    }

    fn back(&self, response: Cargo) -> Option<Box<dyn Frame>> {
        let Cargo::Modbus(pdu) = response else { return None };
        Some(Box::new(Self { pdu }))
    }
}
