//! Telegrams that are not what they are taken for.

use super::crc::residue;
use super::{Cause, Hypothesis, Search};
use crate::frame::split::{Begins, Place, Splitter};
use crate::frame::{Protocol, Verdict, modbus_ascii, modbus_rtu, modbus_tcp};
use crate::modbus::STANDARD;

impl Search<'_> {
    /// Two telegrams in one, an echo in front, another protocol.
    pub(super) fn frames(&mut self) {
        let length = self.bytes.len();
        let splitter = Splitter::new(&STANDARD);
        let begins = |protocol: &'static Protocol, bytes: &[u8]| {
            splitter.begins(protocol, Place { bytes, last: true, in_step: false, waiting: None })
        };
        if let Some(request) = self.context.request
            && let Some(rest) = self.bytes.strip_prefix(request)
            && rest.len() >= modbus_rtu::RTU.shortest()
            && residue(rest) == 0
        {
            self.add(Cause::EchoInFront, request.len(), rest.to_vec(), Some(1));
        }
        if let Begins::Telegram(first) = begins(&modbus_rtu::PROTOCOL, self.bytes) {
            let rest = &self.bytes[first..];
            if rest.len() >= modbus_rtu::RTU.shortest() && residue(rest) == 0 {
                self.add(Cause::Joined, first, self.bytes[..first].to_vec(), Some(2));
            }
        }
        if begins(&modbus_tcp::PROTOCOL, self.bytes) == Begins::Telegram(length) {
            self.of_another(&modbus_tcp::PROTOCOL);
        }
        if modbus_ascii::ASCII.verdict(self.bytes) == Verdict::Right {
            let fits = splitter.sides(modbus_ascii::ASCII.pdu_bytes(self.bytes)) != [false; 2];
            if fits {
                self.of_another(&modbus_ascii::PROTOCOL);
            }
        }
    }

    fn of_another(&mut self, protocol: &'static Protocol) {
        let bytes = self.bytes.to_vec();
        let hypothesis = Hypothesis {
            cause: Cause::OtherProtocol,
            place: 0,
            bytes,
            // A check of one byte, or a header of which two bytes have to be zero.
            tries: Some(self.checks >> 8),
            protocol: Some(protocol),
            checks: self.checks,
        };
        self.found.push(hypothesis);
    }
}
